//! Messages of [`NoMotion`].

use crate::fastest::leg::MOST_STEPS;
use std::fmt;

use jred_file::number::rounding::{short, told_apart};

use super::super::field::Binding;
use super::{Empty, NoMotion};

impl fmt::Display for Empty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { axis, names, .. } = self;
        let [asks, allows] = names;
        let unit = axis.coordinate.speed_unit();
        let rate = |rate: f64| short(axis.rate(rate));
        let [least, most] = told_apart([self.least.0, self.most.0].map(|rate| axis.rate(rate)));
        write!(
            f,
            "no acceleration is left at {} and {} {unit}: the {asks} requires at least {} {unit}^2, the {allows} allows at most {}",
            axis.place(self.phi),
            rate(self.speed),
            least,
            most
        )
    }
}

impl fmt::Display for NoMotion {
    #[expect(clippy::too_many_lines, reason = "a message for each variant")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine(error) => write!(f, "the move is not possible: {error}"),
            Self::Duty(fault) => fault.fmt(f),
            Self::NoWay => write!(f, "start and end are the same position"),
            Self::Stops {
                phi,
                at_start,
                limit,
                name,
                eased,
                torques,
                unit,
                axis,
            } => {
                let place = axis.place(*phi);
                let [needed, given] = told_apart(*torques);
                let unit = unit.effort_unit();
                let what = match eased {
                    _ if *at_start => "the machine cannot start at".to_owned(),
                    Some(eased) => format!(
                        "the {} leaves the machine too little kinetic energy to pass; it stops at",
                        eased.name()
                    ),
                    None => "with the largest acceleration all the way, the machine still stops at"
                        .to_owned(),
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
            Self::Stiff { phi, axis } => write!(
                f,
                "viscous friction is so large for the inertia that the motion would need more than {MOST_STEPS} steps: it was computed up to {}",
                axis.place(*phi)
            ),
            Self::RunsAway {
                phi,
                at_end,
                limit,
                name,
                torques,
                unit,
                axis,
            } => {
                let place = axis.place(*phi);
                let [needed, given] = told_apart(torques.map(f64::abs));
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
                        "{what} {place}: {needed} {unit} of braking are needed to hold its speed, the {name} is {given} {unit}"
                    ),
                }
            }
            Self::StartTooFast { most, axis } => write!(
                f,
                "the start is too fast: the end and the limits before it can be met from at most {} {}",
                short(axis.rate(*most)),
                axis.coordinate.speed_unit()
            ),
            Self::EndTooFast { most, axis } => write!(
                f,
                "the speed of the end cannot be reached: at most {} {}",
                short(axis.rate(*most)),
                axis.coordinate.speed_unit()
            ),
            Self::TooLong { turns, most } => write!(
                f,
                "the move of {} turns is too long: for a machine that varies within a turn, the fastest motion is computed over at most {} turns",
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
                    "the move is too long, or the machine varies too much over it, for an accurate motion: at {place} a limit is exceeded by {excess:.0e} (relative), and the relative error of the duration is up to {change:.0e}"
                )
            }
            Self::LoadJumps {
                phi,
                torques: [before, after],
                unit,
                axis,
            } => write!(
                f,
                "the {effort} rate cannot be limited: at {} a load jumps, and the motor {effort} at constant speed with it from {} to {} {}",
                axis.place(*phi),
                short(*before),
                short(*after),
                unit.effort_unit(),
                effort = unit.vocabulary().torque.word
            ),
            Self::WindingUnknown => {
                write!(f, "the temperature of the motor's winding is not known")
            }
            Self::JointForceAlone => write!(
                f,
                "limits of joint forces cannot be combined with limits of jerk or torque rate, nor with an active limit of the RMS torque or of the winding temperature"
            ),
            Self::NoTorqueLimit(unit) => write!(
                f,
                "the motor's peak {} is not known, so nothing limits the acceleration",
                unit.vocabulary().torque
            ),
            Self::NoSpeedLimit => write!(
                f,
                "nothing limits the speed of an endless motion: the motor's largest speed is not known"
            ),
            Self::SelfLocking => write!(
                f,
                "the gearbox is self-locking: its load cannot be braked by the motor, and the motion under it is not determined"
            ),
            Self::RmsTooLarge {
                rms,
                allowed,
                slow,
                stopped,
                unit,
            } => {
                let u = unit.effort_unit();
                let [least, most] = told_apart([*rms, *allowed]);
                write!(
                    f,
                    "no motion with an RMS {effort} of {most} {u} or less was found: the smallest one found was {least} {u}. ",
                    effort = unit.vocabulary().torque.word,
                )?;
                if slow >= allowed {
                    let [slow, _] = told_apart([*slow, *allowed]);
                    write!(
                        f,
                        "Weight, loads and friction take {slow} {u} or more all the way, however slowly the machine moves"
                    )
                } else if *stopped {
                    write!(
                        f,
                        "The search for slower motions, which may have less, did not converge"
                    )
                } else {
                    write!(
                        f,
                        "A slower motion may have less, and weight and friction may keep it above the limit"
                    )
                }
            }
            Self::TooWarm {
                greatest,
                limit,
                ambient,
                ..
            } => {
                let greatest = if greatest.is_finite() {
                    format!("reaches {} °C", short(*greatest))
                } else {
                    "heats up without end".to_owned()
                };
                write!(
                    f,
                    "no motion with a winding of {} °C or less was found: in the coolest one the winding {greatest}, at an ambient temperature of {} °C",
                    short(*limit),
                    short(*ambient)
                )
            }
            Self::NotFound {
                bound,
                limit,
                phi,
                missed,
                unit,
                axis,
                ..
            } => {
                let words = unit.vocabulary().torque;
                match limit {
                    Some(limit) => write!(
                        f,
                        "no motion within the limits was found: the {} is exceeded by {} % at {}",
                        unit.vocabulary().effort_in(limit.name()),
                        short(100.0 * missed),
                        axis.place(*phi)
                    )?,
                    None => write!(
                        f,
                        "the search for a motion within the limits of jerk, {words} rate or RMS {words} did not converge, though no limit is exceeded where it stopped"
                    )?,
                }
                write!(
                    f,
                    "; without limits of jerk, {words} rate and RMS {words} the fastest motion takes {} s",
                    short(*bound)
                )
            }
            Self::JointForce {
                joint,
                phi,
                forces: [force, limit],
                stands,
                axis,
            } => {
                let slowly = if *stands {
                    "while the machine rests there in a pause; its limit is"
                } else {
                    "in a slowly moving machine; motions that satisfy the limit only by their speed are not computed, and the limit is"
                };
                write!(
                    f,
                    "the force in joint \"{joint}\" is {} N at {} {slowly} {} N",
                    short(*force),
                    axis.place(*phi),
                    short(*limit)
                )
            }
            Self::Empty(place) => place.fmt(f),
        }
    }
}
