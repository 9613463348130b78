//! Torques on the motor's side of a gearbox.

use core::marker::PhantomData;

use super::AxisError;
use super::error::{positive, within};
use crate::Outcome;
use crate::number::{Factor, Number, Quantity as _};
use crate::tick::MachineUnits;

/// A gearbox between motor and drive link, and the motor's rotor.
///
/// ```text
/// T_M = i·J_M·α + T/(i·η)      the motor drives: T and ω have the same sign
/// T_M = i·J_M·α + T·η/i        the machine drives the motor
/// ```
///
/// Then the rotor is *not* part of the machine's reduced inertia: its torque does not go through the gearbox.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Gearbox {
    /// i: turns of the motor per turn of the drive link (for a stroke rad/m).
    pub ratio: f32,
    /// η, 0 to 1.
    pub efficiency: f32,
    /// J_M of the rotor and everything that turns with it (kg·m²).
    pub rotor: f32,
}

impl Gearbox {
    /// The same, if its values are in range.
    pub(super) fn checked(self) -> Result<Self, AxisError> {
        positive("the ratio of the gearbox", self.ratio)?;
        let holds = (0.01..=1.0).contains(&self.efficiency);
        within(
            "the efficiency of the gearbox",
            self.efficiency,
            holds,
            "from 0.01 to 1",
        )?;
        let holds = (0.0..1e30).contains(&self.rotor);
        within(
            "the inertia of the rotor",
            self.rotor,
            holds,
            "zero or positive",
        )?;
        Ok(self)
    }
}

/// A [`Gearbox`] in the machine units of a model: converts torques on the drive link to torques on the motor's shaft.
///
/// Motor torques are in N·m where the model's are. In fixed point they are per unit: 1 is [`base`](Self::base), T_b/(i·η), so that a
/// [`MotorTorque`](crate::MotorTorque) is not a [`Torque`](crate::Torque).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Transmission<N> {
    base: f32,
    driving: Factor,
    driven: Factor,
    rotor: Factor,
    number: PhantomData<N>,
}

impl<N: Number> Transmission<N> {
    /// Creates the transmission of a gearbox, for a model in its machine units.
    ///
    /// # Errors
    /// A ratio that is not positive, an efficiency outside 0.01 to 1, a negative inertia, or an inertia that exceeds single precision in machine
    /// units.
    pub fn new(gearbox: Gearbox, model: &impl MachineUnits<Number = N>) -> Result<Self, AxisError> {
        let Gearbox {
            ratio,
            efficiency,
            rotor,
        } = gearbox.checked()?;
        let scale = model.scale();
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
                number: PhantomData,
            })
        };
        let range = "such that torques on both sides are normal numbers in single precision";
        all().ok_or(AxisError::OutOfRange {
            what: "the ratio of the gearbox",
            value: ratio,
            range,
        })
    }

    /// Motor torque of the number 1 (N·m).
    #[must_use]
    pub const fn base(&self) -> f32 {
        self.base
    }

    /// A torque on the motor's shaft (N·m) in its machine units. In fixed point limited and flagged, NaN becomes 0 and is flagged; in floating point
    /// unchanged.
    pub fn to_torque(&self, torque: f32) -> Outcome<N::MotorTorque> {
        N::MotorTorque::from_si(torque, self.base)
    }

    /// A torque on the motor's shaft, from its machine units to N·m.
    pub fn torque_si(&self, torque: N::MotorTorque) -> f32 {
        torque.to_si(self.base)
    }

    /// The motor torque for `torque` on the drive link, which accelerates with `alpha` and moves (or is to move) with `omega`. At rest, and at a
    /// speed that is NaN, the motor is assumed to drive. A torque or acceleration that is NaN gives NaN, which [`TorqueLimits`](super::TorqueLimits)
    /// makes 0.
    #[inline]
    pub fn motor(
        &self,
        torque: N::Torque,
        omega: N::Speed,
        alpha: N::Acceleration,
    ) -> Outcome<N::MotorTorque> {
        let (none, rest) = (N::Torque::default(), N::Speed::default());
        let driven = (torque < none && omega > rest) || (torque > none && omega < rest);
        let side = if driven { &self.driven } else { &self.driving };
        let through: Outcome<N::MotorTorque> = torque.times(side);
        let rotor = alpha.times(&self.rotor);
        let sum = through.value.plus(rotor.value);
        Outcome {
            value: sum.value,
            saturated: sum.saturated || through.saturated || rotor.saturated,
        }
    }
}
