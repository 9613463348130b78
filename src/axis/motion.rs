//! Motions in machine units, and their changes over a period of time.

use core::marker::PhantomData;

use super::error::{positive, within};
use super::{AxisError, TrackerOutput};
use crate::number::{Factor, Number, Quantity as _, Real as _};
use crate::tick::MachineUnits;
use crate::{Domain, Outcome, Phase};

/// Position, speed and acceleration of a drive link, in the machine units of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionState<N: Number> {
    /// Its angle or position.
    pub phase: Phase,
    /// ω, or v.
    pub omega: N::Speed,
    /// α, or a.
    pub alpha: N::Acceleration,
}

/// A period of time, such as the tick or a lead time, for motions in the machine units of one model.
///
/// Fixed-point results outside the number range are limited and flagged. Accuracy: 2⁻²³ of a result (its factors have single precision), plus six
/// units of 2⁻³¹, in `Q15` one of 2⁻¹⁵ (test `the_middle_of_a_tick_is_the_mean`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Period<N> {
    /// Factors from counts per period to speeds, and back.
    speed: Factor,
    moved: Factor,
    /// Factor from counts per period squared to accelerations.
    acceleration: Factor,
    /// Factors from accelerations to gained speeds, and back.
    gained: Factor,
    needed: Factor,
    /// On a stroke phases do not wrap.
    stroke: bool,
    number: PhantomData<N>,
}

/// 2⁻³²
const UNIT: f32 = 1.0 / 4_294_967_296.0;

/// The acceleration of one count of [`TrackerOutput::acceleration`], in machine units.
pub(super) fn per_square<N: Number>(seconds: f32, model: &impl MachineUnits<Number = N>) -> f32 {
    let span = model.domain().span().to_f32();
    span / seconds / seconds * (UNIT / 256.0) / model.scale().acceleration()
}

impl<N: Number> Period<N> {
    /// A period of `seconds`, for a model with its range and machine units.
    ///
    /// # Errors
    /// [`AxisError::NotPositive`], [`AxisError::NotFinite`]; [`AxisError::OutOfRange`]: so short or long that its factors exceed single precision, or
    /// in fixed point so long that the speed base exceeds a quarter of the range per period.
    pub fn new(seconds: f32, model: &impl MachineUnits<Number = N>) -> Result<Self, AxisError> {
        positive("the period", seconds)?;
        let (domain, scale) = (model.domain(), model.scale());
        let span = domain.span().to_f32();
        let (speed, acceleration) = (scale.speed(), scale.acceleration());
        if N::FIXED {
            // At the number 1 the shorter way round must be the true one.
            let holds = speed * seconds <= 0.25 * span;
            let range = "short enough for a quarter of the range at the speed base";
            within("the period", seconds, holds, range)?;
        }
        let per_count = span / seconds * UNIT / speed;
        let gained = acceleration / speed * seconds;
        let all = || {
            Some(Self {
                speed: Factor::of_count(per_count)?,
                moved: Factor::to_count(1.0 / per_count)?,
                acceleration: Factor::of_count(per_square(seconds, model))?,
                gained: Factor::new(gained)?,
                needed: Factor::new(1.0 / gained)?,
                stroke: matches!(domain, Domain::Stroke { .. }),
                number: PhantomData,
            })
        };
        let range = "between a microsecond and a second, or so";
        all().ok_or(AxisError::OutOfRange {
            what: "the period",
            value: seconds,
            range,
        })
    }

    /// Whether phases do not wrap.
    #[inline]
    pub(super) const fn on_stroke(&self) -> bool {
        self.stroke
    }

    /// The speed that a [`Tracker`](super::Tracker) found in this period.
    #[inline]
    pub fn omega(&self, tracked: TrackerOutput) -> Outcome<N::Speed> {
        N::of_count(tracked.speed, &self.speed).map(N::Speed::of)
    }

    /// The acceleration that a [`Tracker`](super::Tracker) found in this period. Flagged, too, if the tracker limited it.
    #[inline]
    pub fn alpha(&self, tracked: TrackerOutput) -> Outcome<N::Acceleration> {
        let Outcome { value, saturated } =
            N::of_count(tracked.acceleration, &self.acceleration).map(N::Acceleration::of);
        Outcome {
            value,
            saturated: saturated || matches!(tracked.acceleration, i32::MIN | i32::MAX),
        }
    }

    /// The distance in the period at this speed, to be added to a phase; limited to half of the range, 0 at NaN. Accuracy in fixed point: six units
    /// of 2⁻³² of the range, and 2⁻²³ of the distance.
    #[inline]
    pub fn moved(&self, omega: N::Speed) -> Phase {
        Phase::from_bits(omega.number().to_count(&self.moved).cast_unsigned())
    }

    /// The speed gained in the period at this acceleration; NaN stays NaN.
    #[inline]
    pub fn gained(&self, alpha: N::Acceleration) -> Outcome<N::Speed> {
        alpha.times(&self.gained)
    }

    /// The acceleration needed to gain this speed in the period; NaN stays NaN.
    #[inline]
    pub fn needed(&self, gain: N::Speed) -> Outcome<N::Acceleration> {
        gain.times(&self.needed)
    }

    /// The motion a period later, at constant acceleration: φ + ω·τ + ½·α·τ², ω + α·τ. On a stroke limited to its ends. Flagged if the speed was
    /// limited.
    ///
    /// With a lead time as the period it compensates the dead time of a drive: the torque is that of the time when it acts. The drive link must move
    /// less than half of its range in the period. NaN and infinity stay in the speed, where the status of [`FeedForward`](super::FeedForward) reports
    /// them; at NaN the distance is 0.
    #[inline]
    pub fn later(&self, motion: MotionState<N>) -> Outcome<MotionState<N>> {
        let gained = self.gained(motion.alpha);
        let omega = motion.omega.plus(gained.value);
        let half = |omega| self.moved(omega).to_bits().cast_signed() >> 1;
        let moved = half(motion.omega).wrapping_add(half(omega.value));
        Outcome {
            value: MotionState {
                phase: self.advanced(motion.phase, moved),
                omega: omega.value,
                alpha: motion.alpha,
            },
            saturated: gained.saturated || omega.saturated,
        }
    }

    /// The motion in the middle of the period, from the speeds at its start and end: its torque, constant for the period, takes the machine from one
    /// speed to the other. On a stroke limited to its ends. Flagged if the acceleration was limited.
    ///
    /// For firmware whose reference is a speed per tick, without an acceleration. The error of the reached speed is of third order in the period;
    /// with acceleration and curves at the start of the period, of second order (test `the_middle_of_a_tick_is_one_order_better`). NaN and infinity
    /// stay in speed and acceleration.
    #[inline]
    pub fn between(&self, phase: Phase, from: N::Speed, to: N::Speed) -> Outcome<MotionState<N>> {
        let gain = to.minus(from);
        let alpha = self.needed(gain.value);
        let quarter = |omega| self.moved(omega).to_bits().cast_signed() >> 2;
        let moved = quarter(from).wrapping_add(quarter(to));
        Outcome {
            value: MotionState {
                phase: self.advanced(phase, moved),
                omega: from.mean(to),
                alpha: alpha.value,
            },
            saturated: gain.saturated || alpha.saturated,
        }
    }

    /// The phase advanced by `by` units of 2⁻³².
    #[inline]
    fn advanced(&self, phase: Phase, by: i32) -> Phase {
        Phase::from_bits(if self.stroke {
            phase.to_bits().saturating_add_signed(by)
        } else {
            phase.to_bits().wrapping_add_signed(by)
        })
    }
}
