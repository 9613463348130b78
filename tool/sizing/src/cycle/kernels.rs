//! The loops over all stretches of the [front](super::front), compiled once for each vector width of processors.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for the processor's vectors"
)]

use pulp::NullaryFnOnce;

use super::front::{Front, WIDTH};
use crate::cycle::form::LOADS;

/// The kernel of [`Front::bounds`].
pub(super) struct Bounds<'a> {
    pub(super) front: &'a Front,
    pub(super) c: &'a [f64; LOADS],
    pub(super) found: &'a mut [f64; WIDTH],
}

impl NullaryFnOnce for Bounds<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { front, c, found } = self;
        let magnitude = c.map(f64::abs);
        for (k, bound) in found.iter_mut().enumerate() {
            *bound = bound_on(front, c, &magnitude, k);
        }
    }
}

/// The kernel of [`Front::most_above`].
pub(super) struct Above<'a> {
    pub(super) front: &'a Front,
    pub(super) c: &'a [f64; LOADS],
    pub(super) line: [f64; 2],
}

impl NullaryFnOnce for Above<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { front, c, line } = self;
        let magnitude = c.map(f64::abs);
        let [start, slope] = line;
        let speeds = front.speeds_of_least(slope);
        let mut above = [0.0f64; WIDTH];
        for (k, above) in above.iter_mut().enumerate() {
            *above = bound_on(front, c, &magnitude, k) - (start + slope * speeds[k]);
        }
        let larger = |a: f64, b: &f64| if *b > a { *b } else { a };
        above.iter().fold(f64::NEG_INFINITY, larger)
    }
}

/// The kernel of [`Front::against_speed`]: the least T·sgn n at an end of a stretch, and a lower bound on each stretch.
pub(super) struct Signs<'a> {
    pub(super) front: &'a Front,
    pub(super) c: &'a [f64; LOADS],
    pub(super) least: &'a mut [f64; WIDTH],
}

impl NullaryFnOnce for Signs<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { front, c, least } = self;
        let magnitude = c.map(f64::abs);
        let [first, last] = &front.directions;
        let mut ends = [0.0f64; WIDTH];
        for (k, (least, end)) in least.iter_mut().zip(&mut ends).enumerate() {
            let (middle, half) = (form(c, &front.middle, k), form(c, &front.half, k));
            *end = (first[k] * (middle - half)).min(last[k] * (middle + half));
            *least = front.direction[k] * middle - half.abs() - form(&magnitude, &front.reach, k);
        }
        ends.iter().fold(0.0, |lowest, end| lowest.min(*end))
    }
}

/// Upper bound of |c·x| on a stretch: the larger magnitude of middle ± half is the sum of both magnitudes.
#[inline(always)]
fn bound_on(front: &Front, c: &[f64; LOADS], magnitude: &[f64; LOADS], k: usize) -> f64 {
    form(c, &front.middle, k).abs()
        + form(c, &front.half, k).abs()
        + form(magnitude, &front.reach, k)
}

#[inline(always)]
fn form(c: &[f64; LOADS], x: &[[f64; WIDTH]; LOADS], k: usize) -> f64 {
    c[0] * x[0][k] + (c[1] * x[1][k] + c[2] * x[2][k]) + (c[3] * x[3][k] + c[4] * x[4][k])
}
