//! Why no motion exists, and where.

mod cure;
mod words;

use jred::error::Error;
use jred_analysis::duty;
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

use jred_sizing::catalogue::MotorKind;
use jred_sizing::select::fit::input_kind;

use super::field::{Binding, Field, speed};
use super::joint_force::{JointForce, Spot};
use super::sweep::Obstacle;
use super::track::Track;

/// Why no motion exists or none was computed.
#[derive(Clone, Debug, PartialEq)]
pub enum NoMotion {
    /// The mechanism cannot be placed somewhere.
    Machine(Error),
    /// The duty of a motion cannot be computed.
    Duty(Box<duty::DutyError>),
    /// Start and end are equal, or not finite.
    NoWay,
    /// The motor's peak torque is missing; a linear motor has a force (N).
    NoTorqueLimit(Coordinate),
    /// Nothing limits the speed of a motion that repeats endlessly.
    NoSpeedLimit,
    /// The gearbox is self-locking.
    SelfLocking,
    /// Even with the largest acceleration the machine stops on the path, or does not start.
    Stops {
        /// Position (rad, or m).
        phi: f64,
        /// Whether it is the start.
        at_start: bool,
        /// The limit of the acceleration there.
        limit: Binding,
        /// Its name, with the joint of a force.
        name: Box<str>,
        /// A limit of speed or acceleration that denies the machine the kinetic energy to go on.
        eased: Option<Binding>,
        /// Torque that keeps the machine moving there (N·m), and the torque that the limit gives.
        torques: [f64; 2],
        /// Their unit: N for a linear motor.
        unit: Coordinate,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// The machine follows its friction, or the motor's curve, so closely that too many steps are needed.
    Stiff {
        /// Position up to which the motion was followed (rad, or m).
        phi: f64,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// Even with the largest deceleration the machine is too fast.
    RunsAway {
        /// Position (rad, or m).
        phi: f64,
        /// Whether it is the end.
        at_end: bool,
        /// The limit of the deceleration there.
        limit: Binding,
        /// Its name, with the joint of a force.
        name: Box<str>,
        /// Torque that holds the speed there (N·m), and the torque that the limit gives; both negative: they brake.
        torques: [f64; 2],
        /// Their unit: N for a linear motor.
        unit: Coordinate,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// The start is faster than the path allows: the speed, and the largest one (rad/s, or m/s).
    StartTooFast {
        /// Largest speed at the start.
        most: f64,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// The end is faster than can be reached.
    EndTooFast {
        /// Largest speed at the end.
        most: f64,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// The path has too many turns for a machine that changes within a turn.
    TooLong {
        /// Turns.
        turns: f64,
        /// Largest number of turns.
        most: f64,
    },
    /// Even with the most cells, limits are exceeded or the time has not converged.
    NotAccurate {
        /// Share by which a limit is exceeded.
        excess: f64,
        /// Position where it is exceeded most (rad, or m).
        phi: f64,
        /// Relative change of the time with the last number of cells.
        change: f64,
        /// Whether the motion repeats endlessly.
        endless: bool,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// A load jumps while the torque rate is limited.
    LoadJumps {
        /// Position (rad, or m).
        phi: f64,
        /// Torque of the motor before and after (N·m, or N).
        torques: [f64; 2],
        /// Their unit: N for a linear motor.
        unit: Coordinate,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// Even slow motions exceed the RMS torque.
    RmsTooLarge {
        /// Least RMS torque found (N·m, or N).
        rms: f64,
        /// Its limit.
        allowed: f64,
        /// Least torque (N·m, or N) of the slowly moving machine, anywhere on the path.
        slow: f64,
        /// Whether the search for less stopped before it converged.
        stopped: bool,
        /// Their unit: N for a linear motor.
        unit: Coordinate,
    },
    /// The winding exceeds its temperature limit in every motion found.
    TooWarm {
        /// Largest temperature (°C) of the coolest motion; infinite: unbounded.
        greatest: f64,
        /// Its limit.
        limit: f64,
        /// Temperature of the surroundings.
        ambient: f64,
        /// Whether the motion turns endlessly, without a pause.
        endless: bool,
    },
    /// The winding's temperature cannot be computed: data missing.
    WindingUnknown,
    /// The search found no motion within the limits of jerk, torque rate or RMS torque.
    NotFound {
        /// Time (s) of the fastest motion without these limits.
        bound: f64,
        /// The limit at which the search ended, if any.
        limit: Option<Binding>,
        /// Position (rad, or m).
        phi: f64,
        /// Share of the limit by which it is exceeded there.
        missed: f64,
        /// Whether the jerk is limited.
        jerk: bool,
        /// Whether the torque rate is limited.
        torque_rate: bool,
        /// Unit of the torque: N for a linear motor.
        unit: Coordinate,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// The force in a joint exceeds its limit even in a slowly moving machine.
    JointForce {
        /// Name of the joint.
        joint: String,
        /// Position where it exceeds the limit most (rad, or m).
        phi: f64,
        /// Force (N), and its limit.
        forces: [f64; 2],
        /// Whether the machine rests there for a while.
        stands: bool,
        /// Axis in which the message gives positions and speeds.
        axis: Axis,
    },
    /// Limits of joint forces are combined with limits of jerk, torque rate or RMS torque.
    JointForceAlone,
    /// The limits leave no acceleration.
    Empty(Box<Empty>),
}

/// A place and speed at which limits leave no acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct Empty {
    /// Position (rad, or m).
    pub phi: f64,
    /// Speed (rad/s, or m/s).
    pub speed: f64,
    /// The least acceleration and its limit.
    pub least: (f64, Binding),
    /// The largest acceleration, which is smaller, and its limit.
    pub most: (f64, Binding),
    /// Names of both limits, with the joint of a force.
    names: [Box<str>; 2],
    /// Axis in which the message gives positions and speeds.
    axis: Axis,
}

impl From<Error> for NoMotion {
    fn from(error: Error) -> Self {
        Self::Machine(error)
    }
}

impl From<duty::DutyError> for NoMotion {
    fn from(fault: duty::DutyError) -> Self {
        match fault {
            duty::DutyError::Machine(error) => Self::Machine(error),
            fault => Self::Duty(Box::new(fault)),
        }
    }
}

/// Whether the motor of a machine is rotary or linear.
pub(super) fn input(file: &MachineFile) -> Coordinate {
    match input_kind(file) {
        MotorKind::Rotary => Coordinate::Angle,
        MotorKind::Linear => Coordinate::Length,
    }
}

/// Name of a limit; for a force with its joint.
fn in_words(limit: Binding, field: &Field) -> Box<str> {
    let name = limit.name_in(field.dynamics.file);
    if let Binding::JointForce(_) = limit {
        format!("limit of the {name}").into()
    } else {
        name.into()
    }
}

impl NoMotion {
    pub(super) fn of_force(file: &MachineFile, phi: f64, force: &JointForce) -> Self {
        let names = file.machine.mechanism().joint_names();
        Self::JointForce {
            joint: names.get(force.joint).cloned().unwrap_or_default(),
            phi,
            forces: [force.at(0.0, 0.0), force.limit],
            stands: false,
            axis: file.axis(),
        }
    }

    /// The error for a place and speed without an allowed acceleration.
    pub(super) fn empty(field: &Field, place: &Spot, z: f64) -> Self {
        let [least, most] = [field.least_by(place, z), field.most_by(place, z)];
        Self::Empty(Box::new(Empty {
            phi: place.phi,
            speed: speed(z),
            least,
            most,
            names: [least, most].map(|(_, limit)| in_words(limit, field)),
            axis: field.dynamics.file.axis(),
        }))
    }

    /// `eased`: a limit without which the machine would not stop.
    pub(super) fn at(
        field: &Field,
        track: &Track,
        obstacle: Obstacle,
        eased: Option<Binding>,
    ) -> Self {
        let axis = field.dynamics.file.axis();
        let unit = input(field.dynamics.file);
        let place = |index: usize, u: f64| track.cells[index].spot(u);
        match obstacle {
            Obstacle::Stops(index, u) => {
                let place = place(index, u);
                let (_, limit) = field.most_by(&place, 0.0);
                Self::Stops {
                    phi: place.phi,
                    at_start: index == 0 && u == 0.0,
                    limit,
                    name: in_words(limit, field),
                    eased,
                    torques: field.needed_and_given(&place, limit, false),
                    unit,
                    axis,
                }
            }
            Obstacle::RunsAway(index, u) => {
                let place = place(index, u);
                let (_, limit) = field.least_by(&place, 0.0);
                Self::RunsAway {
                    phi: place.phi,
                    at_end: index + 1 == track.cells.len() && u >= 1.0,
                    limit,
                    name: in_words(limit, field),
                    torques: field.needed_and_given(&place, limit, true),
                    unit,
                    axis,
                }
            }
            Obstacle::Stiff(index, u) => Self::Stiff {
                phi: place(index, u).phi,
                axis,
            },
            Obstacle::StartTooFast(z) => Self::StartTooFast {
                most: speed(z),
                axis,
            },
            Obstacle::EndTooFast(z) => Self::EndTooFast {
                most: speed(z),
                axis,
            },
        }
    }
}
