//! The torque of a drive's motor as a linear form in the loads of an instant.

use serde::Serialize;

use crate::catalogue::Drive;
use jred_analysis::duty::Instant;
pub use jred_file::model::motor::{Coefficients, LOADS, loads_of};
use jred_file::number::figures::Figures;

/// The five loads of an instant: α, τ₊, τ₋, n, sgn n.
pub fn loads(instant: &Instant) -> [f64; LOADS] {
    loads_of(
        instant.input_alpha,
        instant.input_torque,
        instant.input_speed,
    )
}

/// Torque and speed of the motor at one instant.
#[derive(Clone, Copy, Debug)]
pub struct MotorPoint {
    /// Torque (N·m).
    pub torque: f64,
    /// Speed (rad/s).
    pub speed: f64,
}

/// The duty at the motor.
#[derive(Clone, Copy, Debug, Serialize, schemars::JsonSchema)]
pub struct MotorDuty {
    /// Motor torque (N·m).
    #[serde(rename = "torque [N m]")]
    pub torque: Figures,
    /// Motor speed (rad/s).
    #[serde(rename = "speed [rad/s]")]
    pub speed: Figures,
    /// Mean of the speed's magnitude (rad/s).
    #[serde(rename = "mean |speed| [rad/s]")]
    pub mean_speed: f64,
    /// Mechanical power at the motor shaft (W).
    #[serde(rename = "power [W]")]
    pub power: Figures,
    /// Energy supplied by the motor over a cycle (J).
    #[serde(rename = "motoring energy [J]")]
    pub motoring_energy: f64,
    /// Energy that flows back to the motor over a cycle (J).
    #[serde(rename = "regenerative energy [J]")]
    pub regenerative_energy: f64,
    /// Inertia ratio λ = (load and gearbox at the motor)/(rotor), over the cycle.
    #[serde(rename = "inertia ratio")]
    pub inertia_ratio: Figures,
}

impl Drive<'_> {
    /// The motor torque as a linear form in the loads.
    pub fn coefficients(&self) -> Coefficients {
        let motor = self.motor;
        let rotor = self.rotor();
        let [coulomb, viscous] = motor.friction;
        match self.gearbox {
            None => Coefficients([rotor, 1.0, 1.0, viscous, coulomb]),
            Some(g) => Coefficients([
                (rotor + g.inertia) * g.ratio,
                1.0 / (g.ratio * g.efficiency),
                g.back_efficiency / g.ratio,
                viscous * g.ratio,
                coulomb + g.no_load_torque,
            ]),
        }
    }

    /// State of the motor at an instant.
    pub fn motor_point(&self, instant: &Instant) -> MotorPoint {
        MotorPoint {
            torque: self.coefficients().torque(&loads(instant)),
            speed: instant.input_speed * self.ratio(),
        }
    }

    /// λ for an inertia at the gearbox output: (J/i² + J_G)/J_M, where J_M is the rotor with its brake.
    pub fn inertia_ratio(&self, inertia: f64) -> f64 {
        let ratio = self.ratio();
        let gearbox = self.gearbox.map_or(0.0, |g| g.inertia);
        (inertia / (ratio * ratio) + gearbox) / self.rotor()
    }
}
