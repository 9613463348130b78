//! The motions that a table is valid for, and the status of other motions.

use super::MotionState;
use crate::Scale;
use crate::number::{FrictionSign, Number, Quantity as _};
use crate::tick::Validity;

/// Factor on the validity.
const MARGIN: f32 = 1.01;
/// Limit in terms of a base: less than the largest 16-bit number.
const BELOW_BASE: f32 = 0.9999;

/// Which of speed and acceleration lie outside the table's validity. NaN counts as outside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Status {
    /// The speed, the set-point's speed or the speed in [`FrictionSign`] is outside, or the share in it is not from −1 to 1.
    pub speed_beyond: bool,
    /// The acceleration is outside.
    pub acceleration_beyond: bool,
}

impl Status {
    /// The table is valid for the motion.
    #[must_use]
    pub const fn is_valid(self) -> bool {
        !(self.speed_beyond || self.acceleration_beyond)
    }
}

/// The greatest speed and acceleration of a table's validity, in its machine units, plus one hundredth, so that a measured motion at the limit is
/// still valid. The error of the torque grows by at most one fiftieth there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionRange<N: Number> {
    max_speed: N::Speed,
    max_acceleration: N::Acceleration,
}

impl<N: Number> MotionRange<N> {
    /// The range of an image's validity ([`Image::validity`](crate::Image::validity)), in its machine units. In fixed point a value that was limited
    /// to the number range is outside in any case. A validity that is NaN allows only rest.
    #[must_use]
    pub fn new(validity: Validity, scale: &Scale) -> Self {
        let within = |most: f32, base: f32| {
            let most = if most > 0.0 {
                (most * MARGIN).min(f32::MAX)
            } else {
                0.0
            };
            if N::FIXED {
                most.min(base * BELOW_BASE)
            } else {
                most
            }
        };
        let alpha = within(validity.max_acceleration, scale.acceleration());
        Self {
            max_speed: scale.omega(within(validity.max_speed, scale.speed())).value,
            max_acceleration: scale.alpha(alpha).value,
        }
    }

    /// The greatest speed.
    #[must_use]
    pub const fn max_speed(&self) -> N::Speed {
        self.max_speed
    }

    /// The greatest acceleration.
    #[must_use]
    pub const fn max_acceleration(&self) -> N::Acceleration {
        self.max_acceleration
    }

    /// Whether the table is valid for this motion: |ω| and |α| within the range. NaN and infinity are not.
    #[inline]
    pub fn status(&self, omega: N::Speed, alpha: N::Acceleration) -> Status {
        Status {
            speed_beyond: omega.exceeds(self.max_speed),
            acceleration_beyond: alpha.exceeds(self.max_acceleration),
        }
    }

    /// Whether the speed or share in `friction` is outside the range.
    #[inline]
    pub(super) fn is_beyond(&self, friction: FrictionSign<N>) -> bool {
        match friction {
            FrictionSign::OfSpeed(omega) => omega.exceeds(self.max_speed),
            FrictionSign::Scaled(share) => !N::FIXED && share.exceeds(N::per_unit(1.0, 1.0).value),
        }
    }

    /// The nearest valid motion and friction; NaN becomes rest, and no friction.
    #[cold]
    #[inline]
    pub fn nearest(
        &self,
        motion: MotionState<N>,
        friction: FrictionSign<N>,
    ) -> (MotionState<N>, FrictionSign<N>) {
        let speeds = [self.max_speed.negated(), self.max_speed];
        let nearest = MotionState {
            phase: motion.phase,
            omega: motion.omega.within(speeds),
            alpha: motion
                .alpha
                .within([self.max_acceleration.negated(), self.max_acceleration]),
        };
        let friction = match friction {
            FrictionSign::OfSpeed(omega) => FrictionSign::OfSpeed(omega.within(speeds)),
            FrictionSign::Scaled(share) => FrictionSign::Scaled(share.to_unit()),
        };
        (nearest, friction)
    }
}
