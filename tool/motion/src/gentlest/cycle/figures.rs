//! The load of the motor in a motion, and the goal to minimise.

use jred_file::number::rounding::of_terms;
use jred_sizing::catalogue::Drive;
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::winding::CurrentCurve;

use super::Request;
use crate::path_dynamics::Actuator;

/// Temperature of the winding (°C) for the copper loss.
pub const WINDING: f64 = 20.0;

jred_file::words! {
    /// Quantity to minimise over the cycle.
    pub enum Goal default Rms {
        /// RMS torque: the heat in the motor.
        Rms = "rms",
        /// Copper loss and the mechanical work that the motor delivers; what flows back is not deducted.
        Energy = "energy",
        /// Largest torque.
        Peak = "peak",
    }
}

/// Copper loss per square of the torque of a drive's motor (W/(N·m)²), with the winding at 20 °C, up to the torque where the iron saturates. `None`
/// if resistance or torque constant is not given.
pub fn copper(drive: &Drive) -> Option<f64> {
    let constant = CurrentCurve::of(drive.motor)?.torque_constant();
    let resistance = drive.motor.winding.loss_resistance(WINDING)?;
    Some(resistance / (constant * constant))
}

/// Load of the motor, or of the input of the drive train, in a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// RMS torque over the cycle (N·m).
    pub rms: f64,
    /// Largest magnitude of the torque (N·m).
    pub peak: f64,
    /// Mechanical work that the motor delivers in a cycle (J); returned energy is not deducted.
    pub drawn: f64,
    /// Copper loss in a cycle (J).
    pub copper: Option<f64>,
    /// Largest speed (rad/s).
    pub speed: f64,
    /// Largest share of the drive's short-time torque; infinite beyond its largest speed.
    pub used: f64,
    /// RMS torque as a share of the S1 torque at the mean speed; 0 without data.
    pub rms_used: f64,
    /// Largest speed as a share of the motor's; 0 without data.
    pub speed_used: f64,
}

impl Figures {
    /// The figure that a goal minimises.
    pub fn of(&self, goal: Goal) -> f64 {
        match goal {
            Goal::Rms => self.rms,
            Goal::Peak => self.peak,
            Goal::Energy => self.drawn + self.copper.unwrap_or(0.0),
        }
    }
}

impl Request {
    pub(crate) fn figures(&self, cycle: &Cycle) -> Figures {
        let Actuator {
            coefficients,
            ratio,
            envelope,
        } = &self.actuator;
        let speed = cycle.peak_speed() * ratio;
        // The torque is a sum of terms as large as ½·J′·ω², the work a sum of torques times their speeds.
        let [_, driving, ..] = coefficients.0;
        let peak = cycle.peak_torque(coefficients);
        let inertial = driving * cycle.inertia().max * cycle.peak_speed().powi(2);
        let peak = of_terms(peak, inertial);
        let rms = of_terms(cycle.rms_torque(coefficients), inertial);
        let [drawn, _] = cycle.energies(coefficients, *ratio);
        let drawn = of_terms(drawn, (inertial + peak) * speed * cycle.duration());
        let continuous = envelope.continuous_torque(cycle.mean_speed() * ratio);
        Figures {
            rms_used: rms / continuous,
            speed_used: speed / envelope.max_speed(),
            rms,
            peak,
            drawn,
            copper: (self.copper).map(|copper| copper * rms * rms * cycle.duration()),
            speed,
            used: cycle.peak(coefficients, *ratio, envelope).used,
        }
    }
}
