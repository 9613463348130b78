//! A motion planned on a host: a table over time, followed by a tick.
//!
//! [`Plan`] reads an image written by `jred fastest --plan` or `jred gentlest --plan`; [`encode()`] writes one. `docs/table-image.md` documents the
//! layout word by word.

mod encode;
mod error;
mod image;
mod inside;
mod row;

use core::marker::PhantomData;

pub use encode::{Knot, encode, image_len, with_ramp};
pub use error::PlanError;
pub use image::{HEADER_WORDS, VERSION};

use super::{AxisError, MotionState};
use crate::number::{Factor, Number, Quantity as _, Real as _};
use crate::tick::MachineUnits;
use crate::{Domain, Outcome, Phase};
use image::Header;
pub(super) use row::shifted;
use row::{Row, RowState, TIME_BITS, Words};

/// Tolerance of a rounded position or speed, in units.
const NEAR: u64 = 16;

/// 2⁻³²
const UNIT: f32 = 1.0 / 4_294_967_296.0;

/// A planned motion, in place in its image: position, speed and acceleration at any time.
///
/// Between two rows the position is the polynomial of degree five through their positions, speeds and accelerations; speed and acceleration are its
/// derivatives. Where the motion's acceleration jumps, a row begins with the acceleration after the jump. So the three are always consistent:
///
/// ```text
/// φ(u) = φ₀ + ω₀·H·u + H²·u²·(c₂ + c₃·u + c₄·u² + c₅·u³),   u = (t − t₀)/H
/// ```
///
/// A tick finds its row by bisection, and computes with integers only, for every number type of the model: the same bits on every processor. The
/// image is checked once; then no read can fail.
///
/// On a stroke a row that leaves it between its ends is refused, too.
///
/// Accuracy: the error against the original motion is in the header ([`errors`](Self::errors)). The arithmetic adds at most 2⁻²⁶ of the greatest sum
/// of the polynomials' terms in the plan, for a position in its row. Positions of rows are rounded to 2⁻³² of the range, and the time in a row to
/// 2⁻³¹ of H (tests `a_plan_follows_its_polynomials`, `a_long_row_is_exact`). Against the row's own words that is −10 … 0 units of the coefficients
/// in the position, −8 … 0 in the speed and −7 … 0 in the acceleration, as Gappa proves (`tests/proofs/plan.g`, test
/// `a_plan_keeps_the_proven_bounds`), and one unit of position or speed for each shift. The factors to machine units have single precision.
///
/// ```
/// use jred::axis::{FeedForward, Override, Plan, PlanFollower, PlanState};
/// use jred::number::FrictionSign;
/// use jred::{CurveSet, Image, Model, Spline, curves, include_image};
///
/// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// # fn main() -> Result<(), jred::FirmwareError> {
/// // Once.
/// let image = Image::from_bytes(include_image!("../../../examples/data/press_f32.jred"))?;
/// let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
/// let feed_forward = FeedForward::new(press, image.validity());
/// let plan = Plan::from_bytes(include_image!("../../../examples/data/press_plan.jred"), &press)?;
/// let mut follower = PlanFollower::new(plan, 0.001, 0.1, &press)?; // a tick and a change of the rate from 0 to 100 % (s)
/// follower.start();
///
/// // Every tick.
/// let mut ticks = 0;
/// loop {
///     let planned = follower.next(Override::FULL);
///     let needed = feed_forward.at_reference(planned.motion, FrictionSign::OfSpeed(planned.motion.omega));
///     assert!(needed.status.is_valid());
///     if planned.state == PlanState::Done {
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
    /// Factors from speeds and accelerations to machine units.
    speed: Factor,
    acceleration: Factor,
    number: PhantomData<N>,
}

/// Greatest errors of a plan against the motion that it was made from.
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

/// The state of a plan at a time, in machine units, and whole turns since φ = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PlanPoint<N: Number> {
    /// Position, speed and acceleration.
    pub motion: MotionState<N>,
    /// Whole turns; 0 on a stroke. Counted within the plan: each repeat of a plan that advances by whole turns starts with the same turns again.
    pub turns: i32,
}

impl<'a, N: Number> Plan<'a, N> {
    /// Checks a plan given as words, for a model with its range and machine units.
    ///
    /// # Errors
    /// As [`PlanError`] lists; in fixed point also a speed or an acceleration beyond its base.
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
    /// As [`new`](Self::new); also bytes that are not on a 4-byte boundary ([`include_image!`](crate::include_image) aligns them).
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

    /// The same, if it is for the machine with this identifier, which table images have, too.
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

    /// The shortest ramp of the rate (s), from 0 to 100 %, with which the drive has the plan's torque at every place and rate; 0 if the drive was
    /// unknown. Infinite: the plan uses all of the torque, and every change of the rate exceeds it.
    #[must_use]
    pub const fn least_ramp(&self) -> f32 {
        self.header.ramp
    }

    /// The identifier of the machine, or 0.
    #[must_use]
    pub const fn machine(&self) -> u32 {
        self.header.machine
    }

    /// Errors against the motion that it was made from.
    #[must_use]
    pub const fn errors(&self) -> Errors {
        self.header.errors
    }

    /// Greatest magnitude of its speed (rad/s, or m/s): of its polynomials, to single precision (test
    /// `the_greatest_rates_are_those_of_the_polynomials`).
    #[must_use]
    pub const fn max_speed(&self) -> f32 {
        let [speed, _] = self.header.most;
        speed
    }

    /// Greatest magnitude of its acceleration (rad/s², or m/s²), likewise.
    #[must_use]
    pub const fn max_acceleration(&self) -> f32 {
        let [_, acceleration] = self.header.most;
        acceleration
    }

    /// Number of rows, including the end.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Duration (s).
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

    /// Whether the end has the position of the start, or whole turns from it, and the same speed, so that the plan can be repeated.
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

    /// Position, speed and acceleration at a time after the start (units of 2⁻⁴⁰ s); after the end, position and speed of the end, with
    /// acceleration 0. Flagged if in fixed point a number was limited.
    ///
    /// For a program's own time, such as the position of a line shaft; [`PlanFollower`](super::PlanFollower) counts ticks.
    #[inline]
    #[must_use]
    pub fn at(&self, time: u64) -> Outcome<PlanPoint<N>> {
        let state = self.state(time);
        let alpha = N::of_count(state.acceleration, &self.acceleration);
        self.place(state, alpha)
    }

    /// The same in units of the plan.
    #[inline]
    pub(super) fn state(&self, time: u64) -> RowState {
        let units = self.header.units;
        let whole = time >> (TIME_BITS.saturating_sub(units.time) & 63);
        let whole = u32::try_from(whole).unwrap_or(u32::MAX);
        let begun = |row: &Words| {
            let [start, ..] = *row;
            start <= whole
        };
        // Bisection, one step for each bit of the number of rows.
        let mut k = 0;
        let mut step = self.header.half;
        while step > 0 {
            let next = self.rows.get(k + step);
            k += if next.is_some_and(begun) { step } else { 0 };
            step /= 2;
        }
        let Some(words) = self.rows.get(k) else {
            return RowState::default();
        };
        let row = Row::read(words);
        match self.rows.get(k + 1) {
            Some([next, ..]) => row.at(time, next.wrapping_sub(row.start), units),
            None => RowState {
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

    /// Factor from accelerations in units of the plan to machine units.
    #[inline]
    pub(super) const fn of_acceleration(&self) -> &Factor {
        &self.acceleration
    }

    /// A state in machine units, with this acceleration.
    #[inline]
    pub(super) fn place(&self, state: RowState, alpha: Outcome<N>) -> Outcome<PlanPoint<N>> {
        let omega = N::of_count(state.speed, &self.speed);
        let (phase, turns) = match self.header.domain {
            Domain::Turn => (state.position as u32, (state.position >> 32) as i32),
            // Every row has been checked to stay within the stroke, to some units.
            Domain::Stroke { .. } if state.position < 0 => (0, 0),
            Domain::Stroke { .. } => (u32::try_from(state.position).unwrap_or(u32::MAX), 0),
        };
        Outcome {
            value: PlanPoint {
                motion: MotionState {
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
