//! Why there is no motion, and where.

mod cure;

use std::fmt;

use jred::Error;
use jred_machine::model::axis::Axis;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;
use jred_machine::number::rounding::short;

use super::field::{Binding, Field, speed};
use super::joint_force::JointForce;
use super::sweep::Obstacle;
use super::track::Track;

/// Why there is no motion.
#[derive(Clone, Debug, PartialEq)]
pub enum NoMotion {
    /// The mechanism cannot be placed somewhere.
    Machine(Error),
    /// Start and end are one, or not numbers.
    NoWay,
    /// The motor's peak torque is not known.
    NoTorqueLimit,
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
        /// Torque that keeps the machine moving there (N·m), and that the limit gives.
        torques: [f64; 2],
        /// Their unit: N of a motor that slides.
        unit: Coordinate,
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
        /// Torque of the motor before and after (N·m).
        torques: [f64; 2],
        /// In whose words it is said.
        axis: Axis,
    },
    /// Even slow motions take more RMS torque than allowed.
    RmsTooLarge {
        /// Least RMS torque (N·m) that was found.
        rms: f64,
        /// What it may be.
        allowed: f64,
    },
    /// The winding gets warmer than allowed in every motion that was found.
    TooWarm {
        /// The greatest temperature (°C) of the coolest one; infinite: without bound.
        greatest: f64,
        /// What it may be.
        limit: f64,
        /// That of the surroundings.
        ambient: f64,
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
    Empty {
        /// Position (rad, or m).
        phi: f64,
        /// Speed (rad/s, or m/s).
        speed: f64,
        /// The least acceleration and its limit.
        least: (f64, Binding),
        /// The largest acceleration, which is smaller, and its limit.
        most: (f64, Binding),
    },
}

impl From<Error> for NoMotion {
    fn from(error: Error) -> Self {
        Self::Machine(error)
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

    pub(super) fn at(field: &Field, track: &Track, obstacle: Obstacle) -> Self {
        let axis = field.way.file.axis();
        let stages = field.way.file.drive_train.stages();
        let unit = if stages.is_empty() {
            field.way.coordinate()
        } else {
            Coordinate::Angle
        };
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

impl NoMotion {
    /// Which limits leave nothing at a place.
    fn at_a_place(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::JointForce {
                joint,
                phi,
                forces: [force, limit],
                stands,
                axis,
            } => {
                let slowly = if *stands {
                    "while the machine stands there in a pause; its limit is"
                } else {
                    "in a machine that moves slowly; a motion that keeps the limit by its speed alone is not computed, and the limit is"
                };
                write!(
                    f,
                    "the force in joint \"{joint}\" is {} N at {} {slowly} {} N",
                    short(*force),
                    axis.place(*phi),
                    short(*limit)
                )
            }
            Self::Empty {
                phi,
                speed,
                least,
                most,
            } => write!(
                f,
                "no acceleration is left at position {} (rad or m) and speed {} (per s): the {} asks for at least {}, the {} allows at most {} (per s^2)",
                short(*phi),
                short(*speed),
                least.1.name(),
                short(least.0),
                most.1.name(),
                short(most.0)
            ),
            _ => Ok(()),
        }
    }

    /// Why a motion that may exist is not computed.
    fn not_computed(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong { turns, most } => write!(
                f,
                "the way of {} turns is too long: of a machine that changes within a turn, the fastest motion is computed over at most {} turns",
                short(*turns),
                short(most.floor())
            ),
            Self::NotAccurate {
                excess,
                phi,
                change,
                axis,
                ..
            } => {
                let place = axis.place(*phi);
                write!(
                    f,
                    "the way is too long, or the machine changes too much on it, for an accurate motion: at {place} a limit is exceeded by {excess:.0e} of itself, and the duration is known within {change:.0e} of itself"
                )
            }
            Self::LoadJumps {
                phi,
                torques: [before, after],
                axis,
            } => write!(
                f,
                "the torque rate cannot be limited: at {} a load jumps, and the motor torque at constant speed with it from {} to {} N m",
                axis.place(*phi),
                short(*before),
                short(*after)
            ),
            Self::RmsTooLarge { rms, allowed } => write!(
                f,
                "no motion with an RMS torque of {} N m or less was found: the search met {} N m at the least. A slower motion may have less, and weight and friction may keep it above the limit",
                short(*allowed),
                short(*rms)
            ),
            Self::TooWarm {
                greatest,
                limit,
                ambient,
            } => {
                let greatest = if greatest.is_finite() {
                    format!("reaches {} °C", short(*greatest))
                } else {
                    "heats up without end".to_owned()
                };
                write!(
                    f,
                    "no motion with a winding of {} °C or less was found: in the coolest one the winding {greatest}, in surroundings of {} °C",
                    short(*limit),
                    short(*ambient)
                )
            }
            Self::WindingUnknown => {
                write!(f, "the temperature of the motor's winding is not known")
            }
            Self::NotFound {
                bound,
                limit,
                phi,
                missed,
                axis,
            } => {
                match limit {
                    Some(limit) => write!(
                        f,
                        "no motion within the limits was found: the {} is exceeded by {} % at {}",
                        limit.name(),
                        short(100.0 * missed),
                        axis.place(*phi)
                    )?,
                    None => write!(
                        f,
                        "the search for a motion within the limits of jerk, torque rate or RMS torque did not come to its end, though no limit is exceeded where it stopped"
                    )?,
                }
                write!(
                    f,
                    "; without limits of jerk, torque rate and RMS torque the fastest motion takes {} s",
                    short(*bound)
                )
            }
            Self::JointForceAlone => write!(
                f,
                "a limit of the force in a joint goes neither with limits of jerk and torque rate nor with one of the RMS torque or of the winding's temperature that binds: that motion is not computed"
            ),
            Self::NoTorqueLimit => write!(
                f,
                "the motor's peak torque is not known, so nothing limits the acceleration"
            ),
            Self::NoSpeedLimit => write!(
                f,
                "nothing limits the speed of a motion that turns for ever: the motor's largest speed is not known"
            ),
            Self::SelfLocking => write!(
                f,
                "the gearbox is self-locking: its load cannot be braked by the motor, and the motion under it is not determined"
            ),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for NoMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine(error) => write!(f, "the way cannot be gone: {error}"),
            Self::NoWay => write!(f, "start and end are the same place: there is no way to go"),
            Self::Stops {
                phi,
                at_start,
                limit,
                name,
                torques: [needed, given],
                unit,
                axis,
            } => {
                let place = axis.place(*phi);
                let [needed, given] = [needed, given].map(|torque| short(*torque));
                let unit = unit.effort_unit();
                let what = if *at_start {
                    "the machine cannot start at"
                } else {
                    "with the largest acceleration all the way, the machine still stops at"
                };
                match limit {
                    Binding::Acceleration | Binding::Deceleration | Binding::JointForce(_) => {
                        write!(f, "{what} {place}: the {name} is in the way")
                    }
                    Binding::GearboxTorque => write!(
                        f,
                        "{what} {place}: {needed} {unit} are needed at the gearbox output to keep moving, its limit is {given} {unit}"
                    ),
                    _ => write!(
                        f,
                        "{what} {place}: {needed} {unit} are needed at the motor to keep moving, it gives {given} {unit}"
                    ),
                }
            }
            Self::RunsAway {
                phi,
                at_end,
                limit,
                name,
                torques: [needed, given],
                unit,
                axis,
            } => {
                let place = axis.place(*phi);
                let [needed, given] = [needed, given].map(|torque| short(torque.abs()));
                let unit = unit.effort_unit();
                let what = if *at_end {
                    "the machine cannot be stopped at"
                } else {
                    "the machine cannot be braked in time: it runs away at"
                };
                match limit {
                    Binding::JointForce(_) => {
                        write!(f, "{what} {place}: the {name} is in the way")
                    }
                    Binding::Deceleration | Binding::Acceleration => write!(
                        f,
                        "{what} {place}: its loads brake harder than the {name} allows"
                    ),
                    _ => write!(
                        f,
                        "{what} {place}: {needed} {unit} of braking are needed to hold its speed, the {} is {given} {unit}",
                        limit.name()
                    ),
                }
            }
            Self::StartTooFast { most, axis } => write!(
                f,
                "the start is too fast: the end and the limits on the way can be met from at most {} {}",
                short(axis.rate(*most)),
                axis.coordinate.speed_unit()
            ),
            Self::EndTooFast { most, axis } => write!(
                f,
                "the speed of the end cannot be reached: at most {} {}",
                short(axis.rate(*most)),
                axis.coordinate.speed_unit()
            ),
            Self::NoTorqueLimit
            | Self::NoSpeedLimit
            | Self::SelfLocking
            | Self::TooLong { .. }
            | Self::NotAccurate { .. }
            | Self::LoadJumps { .. }
            | Self::RmsTooLarge { .. }
            | Self::TooWarm { .. }
            | Self::WindingUnknown
            | Self::JointForceAlone
            | Self::NotFound { .. } => self.not_computed(f),
            Self::JointForce { .. } | Self::Empty { .. } => self.at_a_place(f),
        }
    }
}
