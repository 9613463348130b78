//! Cures where no motion exists.

use jred_file::number::rounding::short;
use jred_file::problem;
use jred_file::text::problem::Problem;

use super::NoMotion;
use crate::fastest::field::Binding;
use crate::fastest::settable_limit::option;

/// Cure for a limit of the force in a joint.
const LARGER_FORCE: &str =
    "allow a larger force in the joint (--max-reaction), or take weight or load off it";

impl NoMotion {
    /// The obstacle to a move, by its number if there are several.
    pub fn problem(&self, number: Option<usize>) -> Problem {
        let which = number.map_or_else(String::new, |number| format!("move {number}: "));
        problem!(help = self.cure(), "{which}{self}")
    }

    /// The cure.
    #[expect(clippy::too_many_lines, reason = "a cure for each variant")]
    pub fn cure(&self) -> String {
        match self {
            Self::Duty(fault) => fault.cure(),
            Self::Machine(_) => "give positions between which the mechanism can be assembled".to_owned(),
            Self::NoWay => "give two different positions".to_owned(),
            Self::NoTorqueLimit(unit) => format!(
                "take a motor with a peak {}, or give --torque",
                unit.vocabulary().torque
            ),
            Self::NoSpeedLimit => {
                "give --max-speed, or with --torque the --motor-speed".to_owned()
            }
            Self::SelfLocking => "take another gearbox".to_owned(),
            Self::Stops {
                eased: Some(eased),
                at_start: false,
                unit,
                ..
            } => format!(
                "raise the {} ({}), or take a motor with more {} at low speed or a larger gear ratio",
                eased.name(),
                option(*eased),
                unit.vocabulary().torque
            ),
            Self::Stops {
                limit,
                torques,
                unit,
                ..
            } => {
                let missing = short(torques[0] - torques[1]);
                let effort = unit.vocabulary().torque;
                let unit = unit.effort_unit();
                match limit {
                    Binding::GearboxTorque => format!(
                        "take a gearbox with {missing} {unit} more at its output, or start with more speed"
                    ),
                    Binding::Acceleration | Binding::Deceleration => {
                        "allow a larger deceleration".to_owned()
                    }
                    Binding::JointForce(_) => LARGER_FORCE.to_owned(),
                    _ => format!(
                        "take a motor with more {effort} at low speed ({missing} {unit} more would hold the machine there; less may do, as kinetic energy helps), a larger gear ratio, or start with more speed"
                    ),
                }
            }
            Self::RunsAway { limit, unit, .. } => match limit {
                Binding::Deceleration => "allow a larger deceleration".to_owned(),
                Binding::JointForce(_) => LARGER_FORCE.to_owned(),
                Binding::GearboxTorque => {
                    "take a gearbox with more torque, or balance the weight".to_owned()
                }
                _ => format!(
                    "take a motor with more {} where it brakes, a larger gear ratio, or balance the weight",
                    unit.vocabulary().torque
                ),
            },
            Self::Stiff { .. } => {
                "check viscous loads, which are very large for the inertia of the machine, and its masses and rotor_inertia".to_owned()
            }
            Self::StartTooFast { .. } => "start more slowly, or give a longer distance".to_owned(),
            Self::EndTooFast { .. } => "end more slowly, or give a longer distance".to_owned(),
            Self::NotAccurate { endless: true, .. } => {
                "limit the speed (--max-speed): the slower the turn, the more accurately it is computed".to_owned()
            }
            Self::TooLong { .. } | Self::NotAccurate { .. } => {
                "divide it: a start up to a speed (--to-speed), a run at that speed, and a stop from it (--from-speed); or limit the speed (--max-speed)".to_owned()
            }
            Self::LoadJumps { .. } => {
                "limit the jerk (--max-jerk) instead, or let the load rise over a distance".to_owned()
            }
            Self::RmsTooLarge { allowed, slow, .. } if slow >= allowed => {
                "take a motor with more continuous torque or a larger gear ratio, or balance the weight; more time at rest helps where the machine is held with less".to_owned()
            }
            Self::RmsTooLarge { stopped: true, .. } => {
                "allow slightly more, give the cycle more time at rest, or take a motor with more continuous torque".to_owned()
            }
            Self::RmsTooLarge { .. } => {
                "give the cycle more time at rest, or take a motor with more continuous torque".to_owned()
            }
            Self::TooWarm { endless: true, .. } => {
                "turn more slowly (--max-speed), take a motor with more continuous torque, or allow more (--max-winding-temperature)".to_owned()
            }
            Self::TooWarm { .. } => {
                "give the cycle more time at rest, limit the speed (--max-speed), take a motor with more continuous torque, or allow more (--max-winding-temperature)".to_owned()
            }
            Self::WindingUnknown => {
                "fill in the thermal figures of the motor in the catalogue, or limit the RMS torque (--max-rms)".to_owned()
            }
            Self::NotFound {
                limit: Some(limit),
                jerk,
                torque_rate,
                ..
            } => {
                // Without a rate limit a motion exists, no matter which other limit is in the way.
                let options = [
                    (Binding::Jerk, "a larger jerk (--max-jerk)"),
                    (Binding::TorqueRate, "a larger torque rate (--max-torque-rate)"),
                ];
                let asked = options.into_iter().zip([jerk, torque_rate]).filter(|(_, asked)| **asked);
                let mut cures: Vec<String> =
                    asked.map(|((_, words), _)| words.to_owned()).collect();
                if options.iter().all(|(rate, _)| rate != limit) {
                    cures.push(format!("a larger {}", limit.name()));
                }
                format!("allow {}, or give a longer distance", cures.join(" or "))
            }
            Self::NotFound { limit: None, .. } => {
                "give another limit: a slightly larger or smaller one may be found".to_owned()
            }
            Self::JointForce { .. } => LARGER_FORCE.to_owned(),
            Self::JointForceAlone => {
                "leave one of them out: joint forces can be limited without --max-jerk, --max-torque-rate, --max-rms and --max-winding-temperature".to_owned()
            }
            Self::Empty(place) => match [place.least.1, place.most.1] {
                [Binding::JointForce(_), Binding::JointForce(_)] => {
                    format!("{LARGER_FORCE}; or limit the speed (--max-speed)")
                }
                _ => "allow a larger acceleration or deceleration, or take a drive with more torque"
                    .to_owned(),
            },
        }
    }
}
