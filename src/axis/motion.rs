//! Motions in machine units, and what a period of time does to them.

use core::marker::PhantomData;

use super::error::{positive, within};
use super::{AxisError, Tracked};
use crate::number::{Factor, Number, Quantity as _, Real as _};
use crate::{Domain, MachineUnits, Outcome, Phase};

/// Where a drive link is and how it moves, in the machine units of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Motion<N: Number> {
    /// Its angle or position.
    pub phase: Phase,
    /// ω, or v.
    pub omega: N::Speed,
    /// α, or a.
    pub alpha: N::Acceleration,
}

/// A period of time, such as that of the tick or a lead time, for motions in the machine units of one model.
///
/// Fixed-point results that leave the number range are limited and flagged. Its factors have single precision: 2⁻²³ of a result, and six units of
/// 2⁻³¹, in `Q15` one of 2⁻¹⁵.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Period<N> {
    /// Of counts a period to speeds, and back.
    speed: Factor,
    moved: Factor,
    /// Of counts a period squared to accelerations.
    acceleration: Factor,
    /// Of accelerations to what a speed gains, and back.
    gained: Factor,
    needed: Factor,
    /// Phases do not wrap.
    stroke: bool,
    number: PhantomData<N>,
}

/// 2⁻³²
const UNIT: f32 = 1.0 / 4_294_967_296.0;

impl<N: Number> Period<N> {
    /// So many seconds, for a model with its range and machine units.
    ///
    /// # Errors
    /// [`AxisError::NotPositive`], [`AxisError::NotFinite`]; [`AxisError::OutOfRange`]: so short or long that single precision does not hold its
    /// factors, or in fixed point so long that the speed base is a quarter of the range a period.
    pub fn new(seconds: f32, model: &impl MachineUnits<Number = N>) -> Result<Self, AxisError> {
        positive("the period", seconds)?;
        let (domain, scale) = (model.domain(), model.scale());
        let span = domain.span().to_f32();
        let (speed, acceleration) = (scale.speed(), scale.acceleration());
        if N::FIXED {
            // The number 1 must be a speed at which the shorter way round is the way.
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
                acceleration: Factor::of_count(
                    span / seconds / seconds * (UNIT / 256.0) / acceleration,
                )?,
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

    /// The speed of what a [`Tracker`](super::Tracker) found in this period.
    #[inline]
    pub fn omega(&self, tracked: Tracked) -> Outcome<N::Speed> {
        N::of_count(tracked.speed, &self.speed).map(N::Speed::of)
    }

    /// The acceleration of what a [`Tracker`](super::Tracker) found in this period. Flagged, too, if it was limited there.
    #[inline]
    pub fn alpha(&self, tracked: Tracked) -> Outcome<N::Acceleration> {
        let Outcome { value, saturated } =
            N::of_count(tracked.acceleration, &self.acceleration).map(N::Acceleration::of);
        Outcome {
            value,
            saturated: saturated || matches!(tracked.acceleration, i32::MIN | i32::MAX),
        }
    }

    /// How far the drive link moves in the period at this speed: what to add to a phase. In fixed point to six units of 2⁻³² of the range, and 2⁻²³ of the way.
    /// Limited to half of the range; 0 at NaN.
    #[inline]
    pub fn moved(&self, omega: N::Speed) -> Phase {
        Phase::from_bits(omega.number().to_count(&self.moved).cast_unsigned())
    }

    /// The speed that it gains in the period at this acceleration; NaN of NaN.
    #[inline]
    pub fn gained(&self, alpha: N::Acceleration) -> Outcome<N::Speed> {
        alpha.times(&self.gained)
    }

    /// The acceleration that it needs to gain this speed in the period; NaN of NaN.
    #[inline]
    pub fn needed(&self, gain: N::Speed) -> Outcome<N::Acceleration> {
        gain.times(&self.needed)
    }

    /// The motion a period later, if the acceleration stays: φ + ω·τ + ½·α·τ², ω + α·τ. On a stroke limited to its ends. Flagged, if the speed was limited.
    ///
    /// With a lead time as the period it makes up for the dead time of a drive: the torque is that of the time when it acts. The drive link
    /// must move less than half of its range in it. NaN and infinity stay in the speed, where the status of [`FeedForward`](super::FeedForward) finds them; of NaN the way is 0.
    #[inline]
    pub fn later(&self, motion: Motion<N>) -> Outcome<Motion<N>> {
        let gained = self.gained(motion.alpha);
        let omega = motion.omega.plus(gained.value);
        let half = |omega| self.moved(omega).to_bits().cast_signed() >> 1;
        let moved = half(motion.omega).wrapping_add(half(omega.value));
        Outcome {
            value: Motion {
                phase: self.advanced(motion.phase, moved),
                omega: omega.value,
                alpha: motion.alpha,
            },
            saturated: gained.saturated || omega.saturated,
        }
    }

    /// The motion in the middle of the period, of the speeds at its beginning and at its end: its torque, constant for the period, takes the machine
    /// from the one speed to the other. On a stroke limited to its ends. Flagged, if the acceleration was limited.
    ///
    /// For firmware whose reference is a speed each tick, without an acceleration. The speed that is reached errs by the third power of the
    /// period; with the acceleration at the beginning and the curves there, by the second (test `the_middle_of_a_tick_is_one_order_better`). NaN and infinity stay in speed and acceleration.
    #[inline]
    pub fn between(&self, phase: Phase, from: N::Speed, to: N::Speed) -> Outcome<Motion<N>> {
        let gain = to.minus(from);
        let alpha = self.needed(gain.value);
        let quarter = |omega| self.moved(omega).to_bits().cast_signed() >> 2;
        let moved = quarter(from).wrapping_add(quarter(to));
        Outcome {
            value: Motion {
                phase: self.advanced(phase, moved),
                omega: from.mean(to),
                alpha: alpha.value,
            },
            saturated: gain.saturated || alpha.saturated,
        }
    }

    /// The phase so many units of 2⁻³² farther on.
    #[inline]
    fn advanced(&self, phase: Phase, by: i32) -> Phase {
        Phase::from_bits(if self.stroke {
            phase.to_bits().saturating_add_signed(by)
        } else {
            phase.to_bits().wrapping_add_signed(by)
        })
    }
}
