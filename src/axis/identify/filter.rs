//! Angle, speed and acceleration without delay, by polynomials of fourth degree through the samples on both sides.

use crate::curve::Circular;

/// Filters of A. Savitzky and M. Golay (*Analytical Chemistry* 36, 1964): a wide one, and a narrow one for the speed alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Filter<T> {
    /// Samples on each side.
    pub(super) wide: usize,
    narrow: usize,
    radian: T,
    step: T,
    angle: [T; 3],
    alpha: [T; 3],
    omega: [T; 2],
    narrow_omega: [T; 2],
    /// Variance of the narrow one's speed.
    pub(super) variance: T,
}

/// The motion in the middle of the samples.
pub(super) struct Filtered<T> {
    /// Smoothed angle less the measured one (rad).
    pub(super) angle: T,
    pub(super) omega: T,
    pub(super) alpha: T,
    pub(super) narrow_omega: T,
}

/// Σ uᵖ over all samples, p = 0, 2, … 8, u = t·step.
fn sums<T: Circular>(samples: u32, step: T) -> [T; 5] {
    let [zero, _, one] = T::CONSTANTS;
    let mut sums = [one, zero, zero, zero, zero];
    for t in 1..=samples {
        let u = T::from_count(t) * step;
        let mut power = one + one;
        for sum in &mut sums {
            *sum = *sum + power;
            power = power * u * u;
        }
    }
    sums
}

/// Factors of Σu·d and Σu³·d in the first coefficient.
fn slope<T: Circular>(samples: u32, step: T) -> [T; 2] {
    let [_, second, fourth, sixth, _] = sums(samples, step);
    let determinant = second * sixth - fourth * fourth;
    [sixth / determinant, -fourth / determinant]
}

impl<T: Circular> Filter<T> {
    pub(super) fn new(wide: u32, narrow: u32, period: T, angle_noise: T) -> Self {
        let [zero, _, one] = T::CONSTANTS;
        let step = one / T::from_count(wide);
        let [a, b, c, d, e] = sums(wide, step);
        // Inverse of [[a b c] [b c d] [c d e]]: its first two rows.
        let [x, y, z] = [c * e - d * d, c * d - b * e, b * d - c * c];
        let determinant = a * x + b * y + c * z;
        let square = [y, a * e - c * c, b * c - a * d];
        let rate = step / period;
        let narrow_omega = slope(narrow, step).map(|factor| factor * rate);
        let [first, third] = narrow_omega;
        let mut variance = zero;
        for t in 1..=narrow {
            let u = T::from_count(t) * step;
            let noise = (first + third * u * u) * u * angle_noise;
            variance = variance + (one + one) * noise * noise;
        }
        Self {
            wide: wide as usize,
            narrow: narrow as usize,
            radian: T::from_f64(core::f64::consts::TAU / 4_294_967_296.0),
            step,
            angle: [x, y, z].map(|factor| factor / determinant),
            alpha: square.map(|factor| (one + one) * factor / determinant * rate * rate),
            omega: slope(wide, step).map(|factor| factor * rate),
            narrow_omega,
            variance,
        }
    }

    /// An angle in phases, in radians.
    #[inline]
    pub(super) fn radians(&self, phases: i32) -> T {
        let size = T::from_count(phases.unsigned_abs()) * self.radian;
        if phases < 0 { -size } else { size }
    }

    /// The motion at a sample `wide` before the newest one, `at` in the ring.
    #[inline]
    pub(super) fn at<const RING: usize>(&self, ring: &[u32; RING], at: usize) -> Filtered<T> {
        let read = |at: usize| ring.get(at % RING).copied().unwrap_or(0);
        let [zero, ..] = T::CONSTANTS;
        let here = read(at);
        let (mut even, mut odd, mut near) = ([zero; 3], [zero; 2], [zero; 2]);
        let mut u = zero;
        for t in 1..=self.wide {
            u = u + self.step;
            let after = read(at.wrapping_add(t)).wrapping_sub(here) as i32;
            let before = read(at.wrapping_add(RING).wrapping_sub(t)).wrapping_sub(here) as i32;
            let sum = self.radians(after.wrapping_add(before));
            let difference = self.radians(after.wrapping_sub(before)) * u;
            let square = u * u;
            let [zeroth, second, fourth] = even;
            let share = sum * square;
            even = [zeroth + sum, second + share, fourth + share * square];
            let [first, third] = odd;
            odd = [first + difference, third + difference * square];
            if t == self.narrow {
                near = odd;
            }
        }
        Filtered {
            angle: dot(self.angle, even),
            omega: dot(self.omega, odd),
            alpha: dot(self.alpha, even),
            narrow_omega: dot(self.narrow_omega, near),
        }
    }
}

fn dot<T: Circular, const N: usize>(a: [T; N], b: [T; N]) -> T {
    let [zero, ..] = T::CONSTANTS;
    a.into_iter().zip(b).fold(zero, |sum, (a, b)| sum + a * b)
}
