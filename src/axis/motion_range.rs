//! The motions that a table was made for, and the status of one that it was not made for.

use super::Motion;
use crate::number::{Number, Quantity as _, Sliding};
use crate::{Scale, Validity};

/// Of the validity.
const MARGIN: f32 = 1.01;
/// Of a base: less than the largest number of 16 bits.
const BELOW_BASE: f32 = 0.9999;

/// What is wrong with a motion: nothing, or the speed, the acceleration, or both are beyond what the table was made for, or no numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Status {
    /// The speed is; or that of the set-point, or that which friction is against; or its share is no number from −1 to 1.
    pub speed_beyond: bool,
    /// The acceleration is.
    pub acceleration_beyond: bool,
}

impl Status {
    /// The motion is one that the table was made for.
    #[must_use]
    pub const fn is_valid(self) -> bool {
        !(self.speed_beyond || self.acceleration_beyond)
    }
}

/// The speeds and accelerations that a table was made for, in its machine units, and a hundredth more: so that the motion that a table was made for
/// is valid when it is measured, too. The error of the torque grows by a fiftieth at most there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MotionRange<N: Number> {
    omega: N::Speed,
    alpha: N::Acceleration,
}

impl<N: Number> MotionRange<N> {
    /// Of what an image says ([`Image::validity`](crate::Image::validity)), in its machine units. In fixed point what was limited to the range of its numbers
    /// is beyond, wherever the range ends. A validity that is NaN allows rest alone.
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
        let alpha = within(validity.alpha, scale.acceleration());
        Self {
            omega: scale.omega(within(validity.omega, scale.speed())).value,
            alpha: scale.alpha(alpha).value,
        }
    }

    /// The greatest speed.
    #[must_use]
    pub const fn omega(&self) -> N::Speed {
        self.omega
    }

    /// The greatest acceleration.
    #[must_use]
    pub const fn alpha(&self) -> N::Acceleration {
        self.alpha
    }

    /// Whether the table was made for these: |ω| and |α| within the range. NaN and infinity are not.
    #[inline]
    pub fn status(&self, omega: N::Speed, alpha: N::Acceleration) -> Status {
        Status {
            speed_beyond: omega.exceeds(self.omega),
            acceleration_beyond: alpha.exceeds(self.alpha),
        }
    }

    /// Whether friction is against a speed, or a share, that it was not made for.
    #[inline]
    pub(super) fn is_beyond(&self, sliding: Sliding<N>) -> bool {
        match sliding {
            Sliding::Against(omega) => omega.exceeds(self.omega),
            Sliding::Share(share) => !N::FIXED && share.exceeds(N::per_unit(1.0, 1.0).value),
        }
    }

    /// The nearest motion and friction that the table was made for; of what is no number, rest and no friction.
    #[cold]
    #[inline]
    pub fn nearest(&self, motion: Motion<N>, sliding: Sliding<N>) -> (Motion<N>, Sliding<N>) {
        let speeds = [self.omega.negated(), self.omega];
        let nearest = Motion {
            phase: motion.phase,
            omega: motion.omega.within(speeds),
            alpha: motion.alpha.within([self.alpha.negated(), self.alpha]),
        };
        let sliding = match sliding {
            Sliding::Against(omega) => Sliding::Against(omega.within(speeds)),
            Sliding::Share(share) => Sliding::Share(share.to_unit()),
        };
        (nearest, sliding)
    }
}
