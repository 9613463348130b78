//! Inputs and results of a friction drive's equation of motion.

use super::drive::MAX_SHAFTS;
use crate::machine::MAX_STAGES;
use crate::machine::reduction::Reduction;
use crate::math;

/// Inertia and torques of a shaft.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shaft {
    /// Inertia J (kg·m²) and its derivative with respect to the shaft's angle (kg·m²/rad).
    pub inertia: [f64; 2],
    /// Torque in the positive direction (N·m): a motor's is positive, a brake's negative.
    pub torque: f64,
    /// b in −b·ω_k (N·m·s/rad).
    pub viscous: f64,
    /// c in −c·sgn ω_k (N·m).
    pub coulomb: f64,
}

impl Shaft {
    /// A plain rotor with a torque on it.
    #[must_use]
    pub const fn new(inertia: f64, torque: f64) -> Self {
        Self {
            inertia: [inertia, 0.0],
            torque,
            viscous: 0.0,
            coulomb: 0.0,
        }
    }

    /// The same with an additional inertia (kg·m²).
    #[must_use]
    pub fn with_inertia(mut self, more: f64) -> Self {
        self.inertia[0] += more;
        self
    }

    /// Torque at the shaft's speed, without the torque of its inertia.
    pub(super) fn external(&self, omega: f64) -> f64 {
        self.torque - self.viscous * omega - self.coulomb * math::sign(omega)
    }
}

/// The drive link of a machine at the position of the reduction: any mechanism behind a friction drive.
impl From<Reduction> for Shaft {
    fn from(reduction: Reduction) -> Self {
        Self {
            inertia: [reduction.inertia, reduction.inertia_slope],
            torque: reduction.load_torque(),
            viscous: reduction.viscous,
            coulomb: reduction.coulomb,
        }
    }
}

/// State of the drive: time (s), angle of every shaft (rad), and speed ω of shaft 1 (rad/s).
///
/// Angles are separate states: with a ratio that varies over time there is no function α_k(α₁). Their rates are the shafts' speeds in [`Motion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<'a> {
    /// t (s)
    pub t: f64,
    /// α₁, α₂, … (rad)
    pub angles: &'a [f64],
    /// ω of shaft 1 (rad/s)
    pub omega: f64,
}

/// One shaft in motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ShaftMotion {
    /// Velocity coefficient j_k = ω_k/ω and its rate dj_k/dt (1/s).
    pub coefficient: [f64; 2],
    /// Speed ω_k (rad/s): the rate of the shaft's angle.
    pub omega: f64,
    /// Acceleration j_k·ω̇ + j̇_k·ω (rad/s²).
    pub alpha: f64,
    /// External torque (N·m), on shaft 1 including the drive's.
    pub torque: f64,
}

/// One contact in motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ContactMotion {
    /// Torque L on the second shaft (N·m).
    pub torque: f64,
    /// Slip ε.
    pub slip: f64,
    /// Power lost (W), L·(f − j)·ω of the first shaft. Negative where power flows against the stage's [`Flow`](super::Flow): a slip that does not
    /// reverse with the load would then supply power, which no real contact does.
    pub loss: f64,
}

/// The drive in motion.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Motion {
    /// Acceleration of shaft 1 (rad/s²).
    pub alpha: f64,
    /// Torque of the drive on shaft 1, in addition to the torque in its [`Shaft`] (N·m).
    pub drive: f64,
    /// J = Σ J_k·j_k² (kg·m²).
    pub inertia: f64,
    /// dJ/dt (kg·m²/s).
    pub inertia_rate: f64,
    /// Power lost in all contacts (W).
    pub loss: f64,
    /// The shafts.
    pub shafts: heapless::Vec<ShaftMotion, MAX_SHAFTS>,
    /// The contacts, one per stage.
    pub contacts: heapless::Vec<ContactMotion, MAX_STAGES>,
}

impl Motion {
    /// Power of all external torques, including the drive's (W): d(½Jω²)/dt = power − loss.
    #[must_use]
    pub fn power(&self) -> f64 {
        self.shafts.iter().map(|s| s.torque * s.omega).sum()
    }

    /// ½·J·ω² (J).
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        let omega = self.shafts.first().map_or(0.0, |s| s.omega);
        0.5 * self.inertia * omega * omega
    }
}
