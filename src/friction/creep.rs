//! The creeping contact: two shafts coupled only by the force that slip causes.

use super::stage::slip_share;
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::positive;

/// The limit where a contact begins to slide.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CreepLimit {
    /// Slip at the limit.
    pub slip: f64,
    /// Torque at the limit, on the second shaft (N·m).
    pub torque: f64,
}

impl CreepLimit {
    /// A slip in [0, 1) at a positive torque.
    pub(super) fn check(&self) -> Result<(), RangeError> {
        slip_share(self.slip)?;
        positive("torque limit of the contact", self.torque)?;
        Ok(())
    }
}

/// A friction contact whose torque grows with its slip up to the limit of friction:
///
/// ```text
/// s = (i·ω₁ − ω₂)/max(|i·ω₁|, |ω₂|)          L = limit·clamp(s/s₁, −1, 1)
/// J₂·ω̇₂ = L + M₂          J₁·ω̇₁ = M₁ − i·L          loss = L·(i·ω₁ − ω₂) ≥ 0
/// ```
///
/// Both speeds are states: the machine has one more degree of freedom, without a constraint. Where shaft 1 drives, s is the ε of
/// [`Flow::FirstDrives`](super::Flow::FirstDrives); where shaft 2 drives, −s is the ε of (III.12) as printed. So the contact changes over by itself
/// when power reverses, and it never supplies power. Beyond the limit it slides with constant torque.
///
/// At standstill s is undefined: below [`SLOW`](Self::SLOW) the speed difference itself is used, which is a viscous contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreepContact(CreepLimit);

/// State of a contact at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Traction {
    /// Torque L on the second shaft (N·m).
    pub torque: f64,
    /// Slip s.
    pub slip: f64,
    /// Power lost (W).
    pub loss: f64,
}

impl CreepContact {
    /// The circumferential speed, as an angular speed of the second shaft (rad/s), below which the contact is viscous.
    pub const SLOW: f64 = 1.0;

    /// A contact that slides beyond this limit, s₁ and L.
    ///
    /// # Errors
    /// A slip outside (0, 1), or a torque that is not positive.
    pub fn new(limit: CreepLimit) -> Result<Self, RangeError> {
        limit.check()?;
        positive("slip", limit.slip)?;
        Ok(Self(limit))
    }

    /// The limit where it begins to slide.
    #[must_use]
    pub const fn limit(&self) -> CreepLimit {
        self.0
    }

    /// The torque at the speed i·ω₁ of the first surface and ω₂ of the second, both as angular speeds of the second shaft (rad/s).
    #[must_use]
    pub fn traction(&self, first: f64, second: f64) -> Traction {
        let CreepLimit { slip, torque } = self.0;
        Self::traction_by(first, second, |s| torque * (s / slip).clamp(-1.0, 1.0))
    }

    /// The same for a contact whose torque L (N·m) is another function of its slip s, such as a measured curve. L must have the sign of s, so that
    /// the contact loses power and never supplies it.
    #[must_use]
    pub fn traction_by(first: f64, second: f64, torque: impl FnOnce(f64) -> f64) -> Traction {
        let fastest = math::abs(first).max(math::abs(second)).max(Self::SLOW);
        let slip = (first - second) / fastest;
        let torque = torque(slip);
        Traction {
            torque,
            slip,
            loss: torque * (first - second),
        }
    }
}
