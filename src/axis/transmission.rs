//! The motor's side of a gearbox.

use super::AxisError;
use super::error::{positive, within};
use crate::number::{Factor, Number};
use crate::{Outcome, Scale};

/// A gearbox between motor and drive link, and the motor's rotor.
///
/// ```text
/// T_M = i·J_M·α + T/(i·η)      the motor drives: T and ω have the same sign
/// T_M = i·J_M·α + T·η/i        the machine drives the motor
/// ```
///
/// The rotor is *not* part of the machine's reduced inertia then: its torque does not go through the gearbox.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gearbox {
    /// i: turns of the motor a turn of the drive link (for a stroke rad/m).
    pub ratio: f32,
    /// η, 0 to 1.
    pub efficiency: f32,
    /// J_M of the rotor and all that turns with it (kg·m²).
    pub rotor: f32,
}

impl Gearbox {
    /// The same, if it can be.
    pub(super) fn checked(self) -> Result<Self, AxisError> {
        positive("the ratio of the gearbox", self.ratio)?;
        let holds = (0.01..=1.0).contains(&self.efficiency);
        within("the efficiency of the gearbox", holds, "from 0.01 to 1")?;
        let holds = (0.0..1e30).contains(&self.rotor);
        within("the inertia of the rotor", holds, "zero or positive")?;
        Ok(self)
    }
}

/// A [`Gearbox`] in the machine units of a model: the torque on the motor's shaft of that on the drive link.
///
/// Motor torques are in N·m where the model's are, and per unit in fixed point: 1 is [`base`](Self::base), T_b/(i·η).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Transmission {
    base: f32,
    driving: Factor,
    driven: Factor,
    rotor: Factor,
}

impl Transmission {
    /// Of a gearbox, for a model of numbers `N` in these machine units.
    ///
    /// # Errors
    /// A ratio that is not positive, an efficiency outside 0.01 to 1, a negative inertia, or one that single precision does not hold in machine units.
    pub fn new<N: Number>(gearbox: Gearbox, scale: &Scale) -> Result<Self, AxisError> {
        let Gearbox {
            ratio,
            efficiency,
            rotor,
        } = gearbox.checked()?;
        let torque = scale.torque();
        let driving = 1.0 / (ratio * efficiency);
        let base = if N::FIXED { torque * driving } else { 1.0 };
        let of_rotor = ratio * rotor * scale.acceleration() / base;
        let all = || {
            Some(Self {
                base,
                driving: Factor::new(torque * driving / base)?,
                driven: Factor::new(torque * efficiency / ratio / base)?,
                rotor: if rotor > 0.0 {
                    Factor::new(of_rotor)?
                } else {
                    Factor::default()
                },
            })
        };
        let range = "such that torques on both sides are normal numbers in single precision";
        all().ok_or(AxisError::OutOfRange {
            what: "the ratio of the gearbox",
            range,
        })
    }

    /// Torque of the motor that the number 1 means (N·m).
    #[must_use]
    pub const fn base(&self) -> f32 {
        self.base
    }

    /// The torque on the motor's shaft for `torque` on the drive link, which accelerates with `alpha` and moves (or is to move) with `omega`. At rest the
    /// motor is taken to drive.
    #[inline]
    pub fn motor<N: Number>(&self, torque: N, omega: N, alpha: N) -> Outcome<N> {
        let rest = N::default();
        let driven = (torque < rest && omega > rest) || (torque > rest && omega < rest);
        let side = if driven { &self.driven } else { &self.driving };
        let through = torque.times(side);
        let rotor = alpha.times(&self.rotor);
        let sum = through.value.plus(rotor.value);
        Outcome {
            value: sum.value,
            saturated: sum.saturated || through.saturated || rotor.saturated,
        }
    }
}
