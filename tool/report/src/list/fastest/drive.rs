//! Load of the drive in a motion: torque, speed, winding temperature, joint forces, and the reserve.

use std::fmt::Write as _;

use jred_file::number::rounding::{percent, short, shown};
use jred_file::units::Vocabulary;
use jred_motion::fastest::joint_force::JointForcePeak;
use jred_motion::fastest::winding::Temperatures;
use jred_motion::fastest::{KeptPart, Reserve};

use super::FastestView;
use crate::answer::Answer;

/// Relative difference below which two S1 torques are the same.
const TORQUE_TOLERANCE: f64 = 1e-5;

/// Temperatures of the motor winding.
pub struct WindingHeat {
    /// Ambient temperature (°C).
    pub ambient: f64,
    /// Its temperatures.
    pub temperatures: Temperatures,
    /// The limit (°C).
    pub limit: f64,
    /// If the limit binds: duration (s) of the motion without it, and the RMS torque (N·m) that it allows.
    pub bound: Option<[f64; 2]>,
}

impl FastestView<'_> {
    /// The load of the motor, and the pause that it needs.
    pub(super) fn motor(&self, answer: &mut Answer) {
        let Vocabulary { torque, speed, .. } = self.words();
        let effort = torque.unit;
        let load = &self.cycle.load;
        // Without a reserve, too, the allowed torque is slightly below S1.
        let is_less = load.allowed < (1.0 - TORQUE_TOLERANCE) * load.continuous;
        let continuous = if load.continuous.is_finite() {
            format!(
                ", S1 {torque} {} {effort} at the mean speed{}",
                short(load.continuous),
                if is_less {
                    format!(
                        ", {} of it with the reserve",
                        percent(load.allowed / load.continuous)
                    )
                } else {
                    String::new()
                }
            )
        } else {
            String::new()
        };
        let [ends_in_motion, passes] = self.passes();
        let holding = if self.is_endless() || ends_in_motion {
            String::new()
        } else {
            let holding = shown(load.holding, load.peaks[0]);
            let nodes = self.cycle.trace.nodes();
            let place = match nodes.last() {
                Some(node) if node.omega != 0.0 => "it where it rests",
                _ => "the end",
            };
            format!("; {holding} {effort} to hold {place}")
        };
        answer.fact(
            format!("motor {torque}"),
            format!(
                "RMS {} {effort}{continuous}; peak {} {effort}{holding}",
                short(load.rms),
                short(load.peaks[0])
            ),
        );
        answer.fact(
            "motor speed",
            format!(
                "peak {} {unit}, mean {} {unit}",
                short(load.peaks[1] / speed.scale),
                short(load.mean_speed / speed.scale),
                unit = speed.unit
            ),
        );
        let what = if is_less {
            format!(
                "{} of the S1 {torque}",
                percent(load.allowed / load.continuous)
            )
        } else {
            format!("the S1 {torque}")
        };
        match load.pause {
            Some(0.0) => {}
            _ if passes => {}
            _ if self.is_endless() => answer.warning(format!(
                    "the RMS {torque} exceeds {what}, and an endless motion has no pause: take a larger drive, or a slower motion"
                ),
            ),
            Some(pause) => answer.warning(format!(
                    "the RMS {torque} exceeds {what}: when repeated, the motion needs {} s more rest each time",
                    short(pause)
                ),
            ),
            None => answer.warning(format!(
                    "the RMS {torque} exceeds {what}, and no pause helps: holding the machine alone takes more than that"
                ),
            ),
        }
    }

    /// Warns if a kept part exceeds a limit.
    pub(super) fn exceeded(&self, part: &KeptPart, answer: &mut Answer) {
        let (share, limit) = part.excess;
        if part.exceeds() {
            let says = format!(
                "segment {} exceeds the limit of the {} by {}",
                part.kept.segment + 1,
                limit.name_in(self.file),
                percent(share)
            );
            answer.warning(says);
        }
    }

    /// The largest force in a joint, and where.
    pub(super) fn force(&self, force: &JointForcePeak) -> String {
        format!(
            "{}: {} N at the most, at {} after {} s{}; limit {} N",
            force.name(self.file),
            short(force.force),
            self.file.axis().place(force.phi),
            shown(force.t, self.cycle.trace.duration()),
            if force.stands { ", at rest" } else { "" },
            short(force.limit)
        )
    }

    /// The temperature of the winding, and the cost of its limit.
    pub(super) fn winding(&self, warmth: &WindingHeat, answer: &mut Answer) {
        let WindingHeat {
            ambient,
            temperatures,
            limit,
            bound,
        } = warmth;
        let torque = self.words().torque;
        let effort = torque.unit;
        let mut says = format!("{} °C at the most", short(temperatures.greatest));
        if let Some([mean, ripple]) = temperatures.mean {
            let _ = write!(
                says,
                ", mean {} °C, ripple {} K over the cycle",
                short(mean),
                short(ripple)
            );
        }
        let _ = write!(
            says,
            "; limit {} °C, surroundings {} °C",
            short(*limit),
            short(*ambient)
        );
        let mut notes = temperatures.heating.notes(torque);
        if temperatures.whole && !temperatures.heating.relative && temperatures.heating.ripple {
            notes.push("the motor as a whole".to_owned());
        }
        for note in notes {
            says += "; ";
            says += &note;
        }
        answer.fact("winding", says);
        let says = match bound {
            None => "not active".to_owned(),
            Some([free, rms]) => {
                let whole = self.cycle.trace.duration();
                format!(
                    "active: it limits the RMS to {} {effort}; without it the whole motion takes {} s, {} less",
                    short(*rms),
                    short(*free),
                    percent(1.0 - free / whole)
                )
            }
        };
        answer.fact("its limit", says);
    }

    pub(super) fn reserve(&self) -> String {
        let torque = self.words().torque;
        let shares = |reserve: &Reserve| {
            let shares = [
                (reserve.torque, format!("motor {torque}")),
                (reserve.speed, "motor speed".to_owned()),
                (reserve.gearbox_torque, "gearbox torque".to_owned()),
                (reserve.gearbox_speed, "gearbox speed".to_owned()),
                (reserve.rms, format!("S1 {torque}")),
            ];
            let given = shares.into_iter().filter(|(share, _)| *share > 0.0);
            let all: Vec<String> = given
                .map(|(share, of)| format!("{} of the {of}", percent(share)))
                .collect();
            all.join(", ")
        };
        let asked = Reserve::of(&self.file.rules);
        if self.reserve.is_some() {
            return shares(&self.reserve);
        }
        if self.of_catalogue && asked.is_some() {
            return format!(
                "none; the rules of `jred size` require {}: give --reserve rules",
                shares(&asked)
            );
        }
        "none".to_owned()
    }
}
