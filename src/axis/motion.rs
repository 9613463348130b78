//! Motions in machine units, and what a period of time does to them.

use core::marker::PhantomData;

use super::error::{positive, within};
use super::{AxisError, Tracked};
use crate::number::{Factor, Number, Real};
use crate::{Domain, Outcome, Phase, Scale};

/// Where a drive link is and how it moves, in the machine units of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Motion<N> {
    /// Its angle or position.
    pub phase: Phase,
    /// ω, or v.
    pub omega: N,
    /// α, or a.
    pub alpha: N,
}

/// A period of time, such as that of the tick or a lead time, for motions in the machine units of one model.
///
/// Fixed-point results that leave the number range are limited and flagged. Its factors have single precision: 2⁻²³ of a result, and in `Q15` a
/// unit.
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
    number: PhantomData<N>,
}

/// 2⁻³²
const UNIT: f32 = 1.0 / 4_294_967_296.0;

impl<N: Number> Period<N> {
    /// So many seconds, for a model with this range and these machine units.
    ///
    /// # Errors
    /// [`AxisError::NotPositive`], [`AxisError::NotFinite`]; [`AxisError::OutOfRange`]: so short or long that single precision does not hold its
    /// factors, or in fixed point so long that the speed base is a quarter of the range a period.
    pub fn new<R: Real>(seconds: f32, domain: Domain<R>, scale: &Scale) -> Result<Self, AxisError> {
        positive("the period", seconds)?;
        let span = domain.span().to_f32();
        let (speed, acceleration) = (scale.speed(), scale.acceleration());
        if N::FIXED {
            // The number 1 must be a speed at which the shorter way round is the way.
            let holds = speed * seconds <= 0.25 * span;
            let range = "short enough for a quarter of the range at the speed base";
            within("the period", (), holds, range)?;
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
                number: PhantomData,
            })
        };
        let range = "of a length whose factors are normal numbers in single precision";
        all().ok_or(AxisError::OutOfRange {
            what: "the period",
            range,
        })
    }

    /// The speed of what a [`Tracker`](super::Tracker) found in this period.
    #[inline]
    pub fn omega(&self, tracked: Tracked) -> Outcome<N> {
        N::of_count(tracked.speed, &self.speed)
    }

    /// The acceleration of what a [`Tracker`](super::Tracker) found in this period.
    #[inline]
    pub fn alpha(&self, tracked: Tracked) -> Outcome<N> {
        N::of_count(tracked.acceleration, &self.acceleration)
    }

    /// How far the drive link moves in the period at this speed: what to add to a phase. In fixed point to four units of 2⁻³² of the range.
    #[inline]
    pub fn moved(&self, omega: N) -> Phase {
        Phase::from_bits(omega.to_count(&self.moved).cast_unsigned())
    }

    /// The speed that it gains in the period at this acceleration.
    #[inline]
    pub fn gained(&self, alpha: N) -> Outcome<N> {
        alpha.times(&self.gained)
    }

    /// The acceleration that it needs to gain this speed in the period.
    #[inline]
    pub fn needed(&self, gain: N) -> Outcome<N> {
        gain.times(&self.needed)
    }

    /// The motion a period later, if the acceleration stays: φ + ω·τ + ½·α·τ², ω + α·τ.
    ///
    /// With a lead time as the period it makes up for the dead time of a drive: the torque is that of the time when it acts.
    #[inline]
    pub fn later(&self, motion: Motion<N>) -> Motion<N> {
        let omega = motion.omega.plus(self.gained(motion.alpha).value).value;
        let twice = self.moved(motion.omega) + self.moved(omega);
        let half = twice.to_bits().cast_signed() >> 1;
        Motion {
            phase: motion.phase + Phase::from_bits(half.cast_unsigned()),
            omega,
            alpha: motion.alpha,
        }
    }

    /// The motion in the middle of the period, of the speeds at its beginning and at its end: its torque, constant for the period, takes the machine
    /// from the one speed to the other.
    ///
    /// For firmware whose reference is a speed each tick, without an acceleration. The speed that is reached errs by the third power of the
    /// period; with the acceleration at the beginning and the curves there, by the second (test `the_middle_of_a_tick_is_one_order_better`).
    #[inline]
    pub fn between(&self, phase: Phase, from: N, to: N) -> Motion<N> {
        let rising = to.minus(from);
        let alpha = self.needed(rising.value).value;
        let quarter = |omega: N| self.moved(omega).to_bits().cast_signed() >> 2;
        let moved = quarter(from).wrapping_add(quarter(to));
        Motion {
            phase: phase + Phase::from_bits(moved.cast_unsigned()),
            omega: from.mean(to),
            alpha,
        }
    }
}
