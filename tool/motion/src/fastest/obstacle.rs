//! Why there is no motion, and where.

mod cure;
mod words;

use jred::Error;
use jred_machine::analysis::duty;
use jred_machine::model::axis::Axis;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;

use jred_sizing::catalogue::MotorKind;
use jred_sizing::select::fit::input_kind;

use super::field::{Binding, Field, speed};
use super::joint_force::{JointForce, Spot};
use super::slowed::Slowing;
use super::sweep::Obstacle;
use super::track::Track;

/// Why there is no motion.
#[derive(Clone, Debug, PartialEq)]
pub enum NoMotion {
    /// The mechanism cannot be placed somewhere.
    Machine(Error),
    /// The duty of a motion is not known.
    Duty(Box<duty::Fault>),
    /// Start and end are one, or not numbers.
    NoWay,
    /// The motor's peak torque is not known; its unit is N of a motor that slides.
    NoTorqueLimit(Coordinate),
    /// Nothing limits the speed of a motion that goes on for ever.
    NoSpeedLimit,
    /// The gearbox does not turn when its output drives.
    SelfLocking,
    /// Even with the largest acceleration the machine stops on the way, or does not start.
    Stops {
        /// Position (rad, or m).
        phi: f64,
        /// Whether it is the start.
        at_start: bool,
        /// What limits the acceleration there.
        limit: Binding,
        /// In words, with the joint whose force it is.
        name: Box<str>,
        /// A limit of speed or acceleration that keeps the machine from taking the kinetic energy that would carry it on.
        eased: Option<Slowing>,
        /// Torque that keeps the machine moving there (N·m), and that the limit gives.
        torques: [f64; 2],
        /// Their unit: N of a motor that slides.
        unit: Coordinate,
        /// In whose words it is said.
        axis: Axis,
    },
    /// The machine follows its friction, or the motor's curve, so closely that too many steps would be needed.
    Stiff {
        /// Position up to which the motion was followed (rad, or m).
        phi: f64,
        /// In whose words it is said.
        axis: Axis,
    },
    /// Even with the largest deceleration the machine is too fast.
    RunsAway {
        /// Position (rad, or m).
        phi: f64,
        /// Whether it is the end.
        at_end: bool,
        /// What limits the deceleration there.
        limit: Binding,
        /// In words, with the joint whose force it is.
        name: Box<str>,
        /// Torque that would hold the speed there (N·m), and that the limit gives; both negative: they brake.
        torques: [f64; 2],
        /// Their unit: N of a motor that slides.
        unit: Coordinate,
        /// In whose words it is said.
        axis: Axis,
    },
    /// The start is faster than the way allows: the speed, and the largest one (rad/s, or m/s).
    StartTooFast {
        /// Largest speed at the start.
        most: f64,
        /// In whose words it is said.
        axis: Axis,
    },
    /// The end is faster than can be reached.
    EndTooFast {
        /// Largest speed at the end.
        most: f64,
        /// In whose words it is said.
        axis: Axis,
    },
    /// The way has more turns than can be computed of a machine that changes within a turn.
    TooLong {
        /// Turns.
        turns: f64,
        /// The most.
        most: f64,
    },
    /// With the most cells limits are exceeded, or the time is not settled.
    NotAccurate {
        /// Share by which a limit is exceeded.
        excess: f64,
        /// Position where it is exceeded most (rad, or m).
        phi: f64,
        /// Share by which the time changed with the last number of cells.
        change: f64,
        /// Whether the motion goes on for ever.
        endless: bool,
        /// In whose words it is said.
        axis: Axis,
    },
    /// A load jumps, where the rate of the torque is limited.
    LoadJumps {
        /// Position (rad, or m).
        phi: f64,
        /// Torque of the motor before and after (N·m, or N).
        torques: [f64; 2],
        /// Their unit: N of a motor that slides.
        unit: Coordinate,
        /// In whose words it is said.
        axis: Axis,
    },
    /// Even slow motions take more RMS torque than allowed.
    RmsTooLarge {
        /// Least RMS torque (N·m, or N) that was found.
        rms: f64,
        /// What it may be.
        allowed: f64,
        /// Least torque (N·m, or N) of the machine when it moves slowly, anywhere on the way.
        slow: f64,
        /// Whether the search for motions with less did not come to its end.
        stopped: bool,
        /// Their unit: N of a motor that slides.
        unit: Coordinate,
    },
    /// The winding gets warmer than allowed in every motion that was found.
    TooWarm {
        /// The greatest temperature (°C) of the coolest one; infinite: without bound.
        greatest: f64,
        /// What it may be.
        limit: f64,
        /// That of the surroundings.
        ambient: f64,
        /// Whether the motion turns for ever, without a pause.
        endless: bool,
    },
    /// The temperature of the motor's winding is not known.
    WindingUnknown,
    /// No motion within limits of jerk, torque rate or RMS torque was found.
    NotFound {
        /// Time (s) of the fastest motion without these limits.
        bound: f64,
        /// The limit at which the search ended, if it is one.
        limit: Option<Binding>,
        /// Where (rad, or m).
        phi: f64,
        /// Share of the limit by which it is exceeded there.
        missed: f64,
        /// Whether jerk and torque rate are limited.
        rates: [bool; 2],
        /// Unit of the torque: N of a motor that slides.
        unit: Coordinate,
        /// In whose words it is said.
        axis: Axis,
    },
    /// The force in a joint exceeds its limit in a machine that moves slowly.
    JointForce {
        /// Name of the joint.
        joint: String,
        /// Position where it exceeds the limit most (rad, or m).
        phi: f64,
        /// Force (N), and its limit.
        forces: [f64; 2],
        /// Whether it stands there for a while.
        stands: bool,
        /// In whose words it is said.
        axis: Axis,
    },
    /// Forces in joints are limited beside jerk, torque rate or RMS torque.
    JointForceAlone,
    /// No acceleration is left.
    Empty(Box<Empty>),
}

/// Where limits leave no acceleration.
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
    /// Both limits in words, with the joint whose force it is.
    names: [Box<str>; 2],
    /// In whose words it is said.
    axis: Axis,
}

impl From<Error> for NoMotion {
    fn from(error: Error) -> Self {
        Self::Machine(error)
    }
}

impl From<duty::Fault> for NoMotion {
    fn from(fault: duty::Fault) -> Self {
        match fault {
            duty::Fault::Machine(error) => Self::Machine(error),
            fault => Self::Duty(Box::new(fault)),
        }
    }
}

/// Whether the motor of a machine turns or slides.
pub(super) fn input(file: &MachineFile) -> Coordinate {
    match input_kind(file) {
        MotorKind::Rotary => Coordinate::Angle,
        MotorKind::Linear => Coordinate::Length,
    }
}

/// A limit in words; that of a force with its joint.
fn in_words(limit: Binding, field: &Field) -> Box<str> {
    let name = limit.name_in(field.way.file);
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

    /// At a place and speed that leave no acceleration.
    pub(super) fn empty(field: &Field, place: &Spot, z: f64) -> Self {
        let [least, most] = [field.least_by(place, z), field.most_by(place, z)];
        Self::Empty(Box::new(Empty {
            phi: place.phi,
            speed: speed(z),
            least,
            most,
            names: [least, most].map(|(_, limit)| in_words(limit, field)),
            axis: field.way.file.axis(),
        }))
    }

    /// `eased`: a limit without which the machine does not stop.
    pub(super) fn at(
        field: &Field,
        track: &Track,
        obstacle: Obstacle,
        eased: Option<Slowing>,
    ) -> Self {
        let axis = field.way.file.axis();
        let unit = input(field.way.file);
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
