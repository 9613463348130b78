//! `[simulation]`: the motor of a free motion, its controller, and its stop.

use jred::Domain;
use jred::machine::Reducible as _;

use crate::model::characteristic::Characteristic;
use crate::model::coordinate::Coordinate;
use crate::model::machine::MachineFile;
use crate::model::motor::OwnMotor;

/// Where a torque acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shaft {
    /// At the motor, in front of the drive train.
    Motor,
    /// At the drive link.
    DriveLink,
}

/// A free motion under a motor torque.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// φ at the start (rad, or m of a sliding link).
    pub start_angle: f64,
    /// ω of the drive link at the start (rad/s).
    pub start_speed: f64,
    /// Duration (s).
    pub duration: f64,
    /// Time between output points (s).
    pub output_step: f64,
    /// Torque of the motor over its speed, both at `at`. Under a controller it is the limit, equal in both directions. `None`: the motor belongs to a
    /// drive.
    pub torque: Option<Characteristic>,
    /// The winding of that motor, if the delay of its current is modelled. Without a controller.
    pub winding: Option<Winding>,
    /// The controller that commands the torque, if any.
    pub control: Option<Control>,
    /// A stop in the middle of the motion.
    pub halt: Option<Halt>,
    /// A speed of the drive link (rad/s, or m/s), by magnitude, that is reported when it is reached.
    pub to_speed: Option<f64>,
    /// The end stops of the drive link's travel.
    pub end_stops: Option<EndStops>,
    /// Where the torque acts.
    pub at: Shaft,
    /// Inertia of the motor's rotor, at the motor shaft (kg·m²).
    pub rotor_inertia: f64,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
}

impl Simulation {
    /// Defaults if only the motor is given: at the motor shaft, without a rotor, from position 0 and from rest, for one second.
    pub const fn of_motor(torque: Characteristic) -> Self {
        Self {
            start_angle: 0.0,
            start_speed: 0.0,
            duration: 1.0,
            output_step: 0.01,
            torque: Some(torque),
            winding: None,
            control: None,
            halt: None,
            to_speed: None,
            end_stops: None,
            at: Shaft::Motor,
            rotor_inertia: 0.0,
            tolerance: 1e-12,
        }
    }

    /// The motor of the file, if it gives one.
    pub fn own_motor(&self) -> Option<OwnMotor<'_>> {
        let characteristic = self.torque.as_ref()?;
        Some(OwnMotor {
            characteristic,
            rotor_inertia: self.rotor_inertia,
        })
    }

    /// The ends of the drive link's travel: its end stops, or the ends of the stroke.
    pub fn ends(&self, file: &MachineFile) -> Option<[f64; 2]> {
        match (self.end_stops, file.machine.domain()) {
            (Some(stops), _) => Some([stops.from, stops.to]),
            (None, Domain::Stroke { from, to }) => Some([from, to]),
            (None, Domain::Turn) => None,
        }
    }

    /// Whether the motor drives a sliding link without a rotating stage: its torque is then a force.
    pub fn drives_a_slide(&self, file: &MachineFile) -> bool {
        let coordinate = file.machine.mechanism().coordinate();
        let direct = self.at == Shaft::DriveLink || file.drive_train.stages().is_empty();
        coordinate == Coordinate::Length && direct
    }
}

/// The winding of a DC motor at a constant voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winding {
    /// Voltage at the terminals (V); its sign is the driving direction.
    pub voltage: f64,
    /// Resistance (Ω).
    pub resistance: f64,
    /// Inductance (H).
    pub inductance: f64,
    /// Torque per current (N·m/A), and voltage per speed (V·s/rad).
    pub constant: f64,
}

/// A cascade of controllers as in servo amplifiers, at the shaft where the torque acts: position, then speed.
///
/// ```text
/// n* = n_ref + K_v·(φ_ref − φ)·i
/// T* = T_ff + K·(n* − n) + z,   z′ = (K·(n* − n) + T − T*)/t_i,   T = T* within the motor's limits
/// ```
///
/// The reference is the motion of the file. Where the torque is limited, the last term prevents windup of the integral z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// K_v (1/s); 0: only the speed is controlled.
    pub position_gain: f64,
    /// K (N·m·s/rad), positive.
    pub speed_gain: f64,
    /// t_i (s); infinite: no integral.
    pub integral_time: f64,
    /// T_ff.
    pub feed_forward: FeedForward,
}

/// The torque that a controller adds before there is an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedForward {
    /// None.
    None,
    /// The torque of the mean inertia at the acceleration of the reference, as in most drives.
    MeanInertia,
    /// The full torque of the reference: J(φ), J′(φ), loads, friction and losses.
    Model,
}

/// A stop in the middle of the motion: the motor is switched off, and a brake may close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Halt {
    /// Time at which the motor is switched off (s).
    pub time: f64,
    /// Torque of the brake at the motor shaft (N·m), against the motion; 0: the machine coasts.
    pub brake_torque: f64,
    /// Delay of the brake (s).
    pub brake_delay: f64,
}

/// Rigid stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndStops {
    /// The lower one (rad, or m).
    pub from: f64,
    /// The upper one.
    pub to: f64,
    /// Speed after over speed before an impact, below 1.
    pub restitution: f64,
}
