//! A plan compared with its motion: the polynomials of its rows and of the motion's steps over their common time.

use jred::Domain;
use jred::axis::plan::HEADER_WORDS;
use jred_file::math;

use super::polynomial::{apart, most_above, moved, slope, stays};
use super::rows::{RANGE, span};
use crate::trace::Node;

/// Words per row.
const ROW: usize = 8;

/// Relative rounding of a factor from counts to a speed or an acceleration.
const FACTOR: f64 = 1.0 / 16_777_216.0;

/// Position, speed and acceleration as polynomials in a share of a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct MotionPolynomial {
    pub(super) position: [f64; 6],
    pub(super) speed: [f64; 5],
    pub(super) acceleration: [f64; 4],
}

impl MotionPolynomial {
    /// A position over a time (s), with its derivatives.
    fn of(position: [f64; 6], length: f64) -> Self {
        let speed: [f64; 5] = slope(&position).map(|c: f64| c / length);
        Self {
            position,
            speed,
            acceleration: slope(&speed).map(|c: f64| c / length),
        }
    }

    /// The quintic from one node to another, its position relative to the first.
    pub(super) fn between(first: &Node, last: &Node) -> Self {
        let length = last.t - first.t;
        let (speed, raised) = (length * first.omega, length * length * first.alpha[1]);
        let way = last.phi - first.phi - speed - 0.5 * raised;
        let gained = length * last.omega - speed - raised;
        let more = length * length * last.alpha[0] - raised;
        let position = [
            0.0,
            speed,
            0.5 * raised,
            10.0 * way - 4.0 * gained + 0.5 * more,
            -15.0 * way + 7.0 * gained - more,
            6.0 * way - 3.0 * gained + 0.5 * more,
        ];
        Self::of(position, length)
    }

    /// A step of a motion, its position relative to the node before.
    pub(super) fn step(before: &Node, after: &Node) -> Self {
        let step = after.step;
        let [first, last] = [before.alpha[1], after.alpha[0]];
        let [rest, missed] = after.missed_since(before);
        let bend = step * (last - first);
        // The part of the missed speed that the motion itself contains: zero where it is rounding.
        let felt = (after.after(before, 0.5).alpha - 0.5 * (first + last)) / 1.5;
        Self {
            position: [
                0.0,
                step * before.omega,
                0.5 * step * step * first,
                step * (bend / 6.0 + missed) + 10.0 * rest,
                -0.5 * step * missed - 15.0 * rest,
                6.0 * rest,
            ],
            speed: [
                before.omega,
                step * first,
                0.5 * bend + 3.0 * missed,
                -2.0 * missed,
                0.0,
            ],
            acceleration: [first, last - first + 6.0 * felt, -6.0 * felt, 0.0],
        }
    }

    /// The same over a part of it, with an offset of the position.
    pub(super) fn part(&self, from: f64, width: f64, beyond: f64) -> Self {
        let mut position = self.position;
        position[0] += beyond;
        Self {
            position: moved(position, from, width),
            speed: moved(self.speed, from, width),
            acceleration: moved(self.acceleration, from, width),
        }
    }
}

impl MotionPolynomial {
    /// Largest difference of position, speed and acceleration from another course over the same time, and about where, if it exceeds `known`.
    pub(super) fn beside(&self, other: &Self, known: [f64; 3]) -> [Option<[f64; 2]>; 3] {
        [
            most_above(apart(self.position, other.position), known[0]),
            most_above(apart(self.speed, other.speed), known[1]),
            most_above(apart(self.acceleration, other.acceleration), known[2]),
        ]
    }

    /// Whether all three stay within bounds of another course.
    pub(super) fn keeps_to(&self, other: &Self, bounds: [f64; 3]) -> bool {
        stays(apart(self.acceleration, other.acceleration), bounds[2])
            && stays(apart(self.speed, other.speed), bounds[1])
            && stays(apart(self.position, other.position), bounds[0])
    }
}

/// A row of an image.
pub(super) struct PlanRow {
    /// Start and end time (s).
    pub(super) t: [f64; 2],
    /// Start position (rad, or m).
    pub(super) position: f64,
    /// Its window (s); the course is over a share of it.
    pub(super) window: f64,
    pub(super) course: MotionPolynomial,
    /// Additional errors of firmware: the time in the row is rounded, and sums are rounded down (tests `a_plan_keeps_the_proven_bounds`).
    pub(super) rounding: [f64; 3],
}

/// The greatest speed and acceleration of a written image.
pub(super) fn greatest(words: &[u32]) -> [f32; 2] {
    [8, 9].map(|word| words.get(word).map_or(0.0, |bits| f32::from_bits(*bits)))
}

/// The rows of a written image, by docs/table-image.md.
pub(super) fn rows(words: &[u32], domain: Domain) -> Vec<PlanRow> {
    let [_, p, x, y] = words.get(3).map_or([0; 4], |word| word.to_le_bytes());
    let units = [i32::from(p), x.cast_signed().into(), y.cast_signed().into()];
    let begin = match domain {
        Domain::Turn => 0.0,
        Domain::Stroke { from, .. } => from,
    };
    let (rows, _) = words
        .get(HEADER_WORDS..)
        .unwrap_or_default()
        .as_chunks::<ROW>();
    let most = greatest(words).map(f64::from);
    let unit = span(domain) / RANGE;
    let row = |pair: &[[u32; ROW]]| row([&pair[0], &pair[1]], units, most, [unit, begin]);
    rows.windows(2).map(row).collect()
}

/// A row of a plan with these greatest rates, the unit of its positions and their origin.
fn row(
    [own, next]: [&[u32; ROW]; 2],
    [p, x, y]: [i32; 3],
    most: [f64; 2],
    [unit, begin]: [f64; 2],
) -> PlanRow {
    let [start, low, upper, speed, coefficients @ ..] = *own;
    let (finer, turns) = ((upper & 0xff).cast_signed(), upper.cast_signed() >> 8);
    let exponent = 32 - (next[0].wrapping_sub(start)).leading_zeros().cast_signed() - p;
    let window = power(exponent);
    let speed = f64::from(speed.cast_signed()) * unit * power(x);
    let fine = unit * power(y - finer);
    let c = coefficients.map(|c| f64::from(c.cast_signed()) * fine);
    let position = begin + unit * (f64::from(turns) * RANGE + f64::from(low));
    let square = window * window;
    let powers = [
        0.0,
        window * speed,
        square * c[0],
        square * c[1],
        square * c[2],
        square * c[3],
    ];
    let sum =
        |factors: [f64; 4]| -> f64 { c.iter().zip(factors).map(|(c, by)| c.abs() * by).sum() };
    // One unit of the time in the row, for its speed and for the rest.
    let (even, odd) = match exponent + 8 {
        ..0 => (0.0, 0.0),
        0 => (0.0, power(-31) * window),
        _ => (power(-32) * window, power(-31) * window),
    };
    let [raised, gained] = [
        sum([2.0, 6.0, 12.0, 20.0]),
        window * sum([2.0, 3.0, 4.0, 5.0]),
    ];
    PlanRow {
        t: [start, next[0]].map(|t| f64::from(t) * power(-p)),
        position,
        window,
        course: MotionPolynomial::of(powers, window),
        rounding: [
            even * speed.abs() + odd * gained + 10.0 * square * fine + 2.0 * unit,
            odd * raised + 8.0 * window * fine + unit * power(x) + FACTOR * most[0],
            odd * sum([0.0, 6.0, 24.0, 60.0]) / window + 7.0 * unit * power(y) + FACTOR * most[1],
        ],
    }
}

fn power(n: i32) -> f64 {
    math::exp2(f64::from(n))
}
