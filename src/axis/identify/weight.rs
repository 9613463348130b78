//! The test functions of the weak form: quintic B-splines with knots every few ticks.

use crate::curve::Circular;

/// Windows open at a time: the support of a quintic B-spline in knots.
pub(super) const WINDOWS: usize = 6;

/// Most ticks between two knots.
pub(super) const MOST_TICKS: usize = 8;

/// The weights of a sample in the windows, from the youngest to the oldest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Weights<T> {
    pub(super) plain: [T; WINDOWS],
    pub(super) first: [T; WINDOWS],
    pub(super) second: [T; WINDOWS],
    /// Of the torque, which acted a part of a tick before.
    pub(super) torque: [T; WINDOWS],
}

/// The cardinal B-spline of a degree at `x`, `x + 1`, … knots after its begin, 0 ≤ x < 1 (C. de Boor, *A Practical Guide to Splines*, 1978).
fn spline<T: Circular>(degree: u32, x: T) -> [T; WINDOWS] {
    let [zero, _, one] = T::CONSTANTS;
    let mut values = [one, zero, zero, zero, zero, zero];
    for d in 1..=degree {
        let degree = T::from_count(d);
        let (mut before, mut at) = (zero, x);
        for value in &mut values {
            let now = *value;
            *value = (at * now + (degree + one - at) * before) / degree;
            (before, at) = (now, at + one);
        }
    }
    values
}

/// Differences between neighbours: the derivative by the knot.
fn difference<T: Circular>(values: [T; WINDOWS]) -> [T; WINDOWS] {
    let [mut before, ..] = T::CONSTANTS;
    values.map(|now| {
        let difference = now - before;
        before = now;
        difference
    })
}

/// The weights of all ticks between two knots, times the period, and Σw·w of windows that are 0, 1, … knots apart. The torque acted `late`, a part of
/// a tick, before its sample.
pub(super) fn weights<T: Circular>(
    ticks: u32,
    period: T,
    late: T,
) -> ([Weights<T>; MOST_TICKS], [T; WINDOWS]) {
    let [zero, _, one] = T::CONSTANTS;
    let none = [zero; WINDOWS];
    let mut made = [Weights {
        plain: none,
        first: none,
        second: none,
        torque: none,
    }; MOST_TICKS];
    let mut products = none;
    let number = T::from_count(ticks);
    let knot = number * period;
    for (tick, weights) in (0..ticks).zip(&mut made) {
        let tick = T::from_count(tick);
        let times = |values: [T; WINDOWS], factor: T| values.map(|w| w * factor);
        weights.plain = times(spline(5, tick / number), period);
        let first = difference(spline(4, tick / number));
        weights.first = times(first, one / number);
        let second = difference(difference(spline(3, tick / number)));
        weights.second = times(second, one / (number * knot));
        let acts = (tick - late) / number;
        weights.torque = if acts < zero {
            // Before a knot: the younger neighbour's place.
            let mut before = zero;
            let shifted = spline(5, acts + one).map(|now| core::mem::replace(&mut before, now));
            times(shifted, period)
        } else {
            times(spline(5, acts), period)
        };
        for (apart, product) in products.iter_mut().enumerate() {
            let pairs = weights.plain.iter().zip(weights.plain.iter().skip(apart));
            *product = pairs.fold(*product, |sum, (a, b)| sum + *a * *b);
        }
    }
    (made, products)
}
