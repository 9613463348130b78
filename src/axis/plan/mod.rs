//! A motion that was planned on a host, as a table over the time that a tick follows.
//!
//! [`Plan`] reads an image that `jred fastest --plan` or `jred retime --plan` wrote; [`encode()`] writes one. The layout is documented word by
//! word in `docs/table-image.md`.

mod encode;
mod error;
mod image;
mod inside;
mod row;

use core::marker::PhantomData;

pub use encode::{Knot, encode, image_len, with_ramp};
pub use error::PlanError;
pub use image::{HEADER_WORDS, VERSION};

use super::{AxisError, Motion};
use crate::number::{Factor, Number, Quantity as _, Real as _};
use crate::{Domain, MachineUnits, Outcome, Phase};
use image::Header;
pub(super) use row::shifted;
use row::{Row, State, TIME_BITS, Words};

/// Units that a rounded position or speed may be off by.
const NEAR: u64 = 16;

/// 2⁻³²
const UNIT: f32 = 1.0 / 4_294_967_296.0;

/// A planned motion, in place in its image: position, speed and acceleration at any time of it.
///
/// Between two rows the position is the polynomial of the fifth degree through positions, speeds and accelerations of both; speed and acceleration are its
/// derivatives, and where the motion's acceleration jumps, a row begins with the acceleration behind the jump. So the three always belong together:
///
/// ```text
/// φ(u) = φ₀ + ω₀·H·u + H²·u²·(c₂ + c₃·u + c₄·u² + c₅·u³),   u = (t − t₀)/H
/// ```
///
/// A tick finds its row by bisection, and computes with integers alone, whatever the numbers of the model are: the same bits on every processor.
/// The image is checked once; then no read can fail.
///
/// On a stroke a row that leaves it between its ends is refused, too.
///
/// Accuracy: beside the motion that it was made of, what its header says ([`errors`](Self::errors)). The arithmetic is off by 2⁻²⁶ of the greatest sum of the
/// polynomials' terms in the plan at most, of a position in its row; positions of rows are rounded to 2⁻³² of the range, and the time in a row to 2⁻³¹ of H (tests
/// `a_plan_follows_its_polynomials`, `a_long_row_is_exact`). Beside the row's own words that is −10 … 0 units of the coefficients in the position, −8 … 0 in the speed and −7 … 0 units in the acceleration, as Gappa
/// proves (`tests/proofs/plan.g`, test `a_plan_keeps_the_proven_bounds`), and a unit of the positions or speeds themselves for each shift. The factors to machine units have single
/// precision.
///
/// ```
/// use jred::axis::{FeedForward, Follower, Plan, Rate, Stage};
/// use jred::number::Sliding;
/// use jred::{Image, Model, Set, Spline, curves, include_image};
///
/// const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // Once.
/// let image = Image::from_bytes(include_image!("../../../examples/data/press_f32.jred"))?;
/// let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
/// let feed_forward = FeedForward::new(press, image.validity());
/// let plan = Plan::from_bytes(include_image!("../../../examples/data/press_plan.jred"), &press)?;
/// let mut follower = Follower::new(plan, 0.001, 0.1, &press)?; // a tick and a change of the rate from 0 to 100 % (s)
/// follower.start();
///
/// // Every tick.
/// let mut ticks = 0;
/// loop {
///     let planned = follower.next(Rate::FULL);
///     let needed = feed_forward.at_reference(planned.motion, Sliding::Against(planned.motion.omega));
///     assert!(needed.status.is_valid());
///     if planned.stage == Stage::Done {
///         break;
///     }
///     ticks += 1;
/// }
/// assert_eq!(ticks, (plan.duration() / 0.001).ceil() as u32);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan<'a, N> {
    rows: &'a [Words],
    header: Header,
    /// Of speeds and accelerations to machine units.
    speed: Factor,
    acceleration: Factor,
    number: PhantomData<N>,
}

/// What a plan is off by at most, beside the motion that it was made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Errors {
    /// Position (rad, or m).
    pub position: f32,
    /// Speed (rad/s, or m/s).
    pub speed: f32,
    /// Acceleration (rad/s², or m/s²).
    pub acceleration: f32,
}

/// Where a plan is, in machine units, and whole turns since φ = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Place<N: Number> {
    /// Position, speed and acceleration.
    pub motion: Motion<N>,
    /// Whole turns; 0 on a stroke. Counted within the plan: the next repeat of a plan that goes on by whole turns begins with those of its start again.
    pub turns: i32,
}

impl<'a, N: Number> Plan<'a, N> {
    /// Checks a plan given as words, for a model with its range and machine units.
    ///
    /// # Errors
    /// What [`PlanError`] lists; in fixed point a speed or an acceleration beyond its base, too.
    pub fn new(words: &'a [u32], model: &impl MachineUnits<Number = N>) -> Result<Self, PlanError> {
        let (header, rows) = image::checked(words)?;
        let (domain, scale) = (model.domain().to::<f32>(), model.scale());
        if domain != header.domain {
            return Err(PlanError::Range);
        }
        let factor = |what, most: f32, base: f32, exponent: i32| {
            if N::FIXED && most > base {
                return Err(AxisError::BeyondBase {
                    what,
                    value: most,
                    base,
                });
            }
            let factor = Factor::of_count(unit(domain, exponent) / base);
            factor.ok_or(AxisError::OutOfRange {
                what,
                value: most,
                range: "such that single precision holds it in machine units",
            })
        };
        let [speed, acceleration] = header.most;
        Ok(Self {
            rows,
            speed: factor(
                "the greatest speed of the plan",
                speed,
                scale.speed(),
                header.units.speed,
            )?,
            acceleration: factor(
                "the greatest acceleration of the plan",
                acceleration,
                scale.acceleration(),
                header.units.acceleration,
            )?,
            header,
            number: PhantomData,
        })
    }

    /// Checks a plan given as bytes, such as `include_image!` or a flash region.
    ///
    /// # Errors
    /// As [`new`](Self::new); the bytes must lie on a 4-byte boundary ([`include_image!`](crate::include_image) sees to it).
    pub fn from_bytes(
        bytes: &'a [u8],
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, PlanError> {
        let words = bytemuck::try_cast_slice(bytes);
        Self::new(
            words.map_err(|_| crate::tick::ImageError::Misaligned)?,
            model,
        )
    }

    /// The same, if it is of the machine with this identifier, which table images have, too.
    ///
    /// # Errors
    /// [`ImageError::Machine`](crate::ImageError::Machine).
    pub const fn of_machine(self, machine: u32) -> Result<Self, PlanError> {
        if self.header.machine == machine {
            Ok(self)
        } else {
            Err(PlanError::Image(crate::tick::ImageError::Machine {
                found: self.header.machine,
                expected: machine,
            }))
        }
    }

    /// The shortest ramp of the rate (s), from 0 to 100 %, with which the plan keeps the torque of its drive at every place and rate; 0 if its writer did not know the
    /// drive. Infinite: it uses all of that torque, and no change of the rate keeps it.
    #[must_use]
    pub const fn least_ramp(&self) -> f32 {
        self.header.ramp
    }

    /// The identifier of the machine; 0 if it has none.
    #[must_use]
    pub const fn machine(&self) -> u32 {
        self.header.machine
    }

    /// What it is off by, beside the motion that it was made of.
    #[must_use]
    pub const fn errors(&self) -> Errors {
        self.header.errors
    }

    /// Its greatest speed (rad/s, or m/s) and acceleration (rad/s², or m/s²), as magnitudes: those of its polynomials, to single precision (test
    /// `the_greatest_rates_are_those_of_the_polynomials`).
    #[must_use]
    pub const fn most(&self) -> [f32; 2] {
        self.header.most
    }

    /// Rows, with that of its end.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.rows.len()
    }

    /// How long it takes (s).
    #[must_use]
    pub fn duration(&self) -> f32 {
        self.end() as f32 * (UNIT / 256.0)
    }

    /// The same in units of 2⁻⁴⁰ s.
    #[inline]
    #[must_use]
    pub const fn end(&self) -> u64 {
        (self.header.last as u64) << ((TIME_BITS - self.header.units.time) & 63)
    }

    /// Whether the end is the start, or whole turns from it, with the same speed: it can be repeated.
    pub(super) fn closes(&self) -> bool {
        let [first, .., last] = self.rows else {
            return false;
        };
        let [first, last] = [first, last].map(Row::read);
        let apart = last.position.wrapping_sub(first.position);
        let apart = match self.header.domain {
            // Whole turns apart.
            Domain::Turn => i64::from(apart as i32),
            Domain::Stroke { .. } => apart,
        };
        let faster = last.speed.wrapping_sub(first.speed);
        apart.unsigned_abs() <= NEAR && u64::from(faster.unsigned_abs()) <= NEAR
    }

    /// Position, speed and acceleration at a time after the start (units of 2⁻⁴⁰ s): behind the end those of the end, with its acceleration 0. Flagged, if in fixed point a
    /// number was limited.
    ///
    /// For a time of one's own, such as that of a line shaft; [`Follower`](super::Follower) counts ticks.
    #[inline]
    #[must_use]
    pub fn at(&self, time: u64) -> Outcome<Place<N>> {
        let state = self.state(time);
        let alpha = N::of_count(state.acceleration, &self.acceleration);
        self.place(state, alpha)
    }

    /// The same in units of the plan.
    #[inline]
    pub(super) fn state(&self, time: u64) -> State {
        let units = self.header.units;
        let whole = time >> (TIME_BITS.saturating_sub(units.time) & 63);
        let whole = u32::try_from(whole).unwrap_or(u32::MAX);
        let begun = |row: &Words| {
            let [start, ..] = *row;
            start <= whole
        };
        // Bisection: as many steps as the number of rows has bits.
        let mut k = 0;
        let mut step = self.header.half;
        while step > 0 {
            let next = self.rows.get(k + step);
            k += if next.is_some_and(begun) { step } else { 0 };
            step /= 2;
        }
        let Some(words) = self.rows.get(k) else {
            return State::default();
        };
        let row = Row::read(words);
        match self.rows.get(k + 1) {
            Some([next, ..]) => row.at(time, next.wrapping_sub(row.start), units),
            None => State {
                position: row.position,
                speed: row.speed,
                acceleration: 0,
            },
        }
    }

    /// The unit of its speeds (rad/s, or m/s).
    pub(super) fn speed_unit(&self) -> f32 {
        unit(self.header.domain, self.header.units.speed)
    }

    /// From accelerations in units of the plan to machine units.
    #[inline]
    pub(super) const fn of_acceleration(&self) -> &Factor {
        &self.acceleration
    }

    /// In machine units, with this acceleration.
    #[inline]
    pub(super) fn place(&self, state: State, alpha: Outcome<N>) -> Outcome<Place<N>> {
        let omega = N::of_count(state.speed, &self.speed);
        let (phase, turns) = match self.header.domain {
            Domain::Turn => (state.position as u32, (state.position >> 32) as i32),
            // Every row has been shown to stay within the stroke, to some units.
            Domain::Stroke { .. } if state.position < 0 => (0, 0),
            Domain::Stroke { .. } => (u32::try_from(state.position).unwrap_or(u32::MAX), 0),
        };
        Outcome {
            value: Place {
                motion: Motion {
                    phase: Phase::from_bits(phase),
                    omega: N::Speed::of(omega.value),
                    alpha: N::Acceleration::of(alpha.value),
                },
                turns,
            },
            saturated: omega.saturated || alpha.saturated,
        }
    }
}

/// 2ⁿ·2⁻³² of a range.
fn unit(domain: Domain<f32>, n: i32) -> f32 {
    domain.span().to_f32() * UNIT * power_of_two(n)
}

/// 2ⁿ, −126 ≤ n ≤ 127
pub(super) fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32 & 0xff) << 23)
}
