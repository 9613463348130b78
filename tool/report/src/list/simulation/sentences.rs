//! Events of a simulated motion, one sentence each.

use jred_analysis::simulate::{BRIEFEST_FLIGHT, Rest, Stop, beside_name};
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{short, shown};
use jred_file::units::RPM;
use jred_motion::drive_simulation::{Loads, Peak};

use super::SimulationView;
use crate::answer::{Answer, Block};
use crate::list::driven::{Turns, driven};

impl SimulationView<'_> {
    /// Adds the events, one sentence each.
    pub(super) fn sentences(&self, answer: &mut Answer) {
        let axis = self.machines.first.axis();
        let effort = self.effort_unit();
        let mut lines: Vec<Block> = self.by_motion().into_iter().map(Block::Sentence).collect();
        if let Some(stuck) = self.found.missing {
            let missing = (stuck.missing.needed - stuck.missing.given).abs();
            lines.push(Block::Sentence(format!(
                "the motor does not drive the machine beyond {}, at {} s: at rest it gives {} {effort} there, {} {effort} are needed, {} {effort} are missing",
                axis.place(stuck.missing.phi),
                self.time(stuck.time),
                short(stuck.missing.given.abs()),
                short(stuck.missing.needed.abs()),
                short(missing)
            )));
        }
        lines.extend(self.reached(&axis).map(Block::Sentence));
        lines.extend(self.effort().map(Block::Sentence));
        lines.extend(self.torque_limit(&axis).map(Block::Warning));
        if let Some(following) = self.found.following {
            lines.push(Block::Sentence(format!(
                "largest following error: {} {} at {} s, {}",
                self.way(&axis, following.error),
                axis.coordinate.unit(),
                self.time(following.time),
                axis.place(following.position)
            )));
        }
        if let Some((_, loads)) = self.drive {
            lines.extend(drive_sentences(loads, &axis, self.machines.first));
        }
        lines.extend(self.driven().map(Block::Warning));
        lines.extend(self.impacts(&axis).map(Block::Warning));
        lines.extend(self.rest(&axis).map(Block::Sentence));
        lines.extend(self.worst_stop(&axis));
        answer.blocks.extend(lines);
    }

    /// An instant (s); 0 below the rounding error of the whole time.
    fn time(&self, t: f64) -> String {
        shown(t, self.simulation.duration)
    }

    /// The longest of the stops over a cycle.
    fn worst_stop(&self, axis: &Axis) -> Option<Block> {
        let stops = self.stops?;
        let count = stops.len();
        let unit = axis.coordinate.unit();
        let from = |stop: &Stop| {
            format!(
                "switched off at {} s, {}",
                self.time(stop.time),
                axis.place(stop.position)
            )
        };
        if let Some(moving) = stops.iter().find(|stop| stop.rest.is_none()) {
            return Some(Block::Warning(format!(
                "of {count} instants over the cycle before, {} the machine has not come to rest by the end",
                from(moving)
            )));
        }
        let longest = |of: fn(&Rest) -> f64| {
            let rests = stops.iter().filter_map(|stop| Some((stop, stop.rest?)));
            rests.max_by(|a, b| of(&a.1).total_cmp(&of(&b.1)))
        };
        let (far, way) = longest(|rest| rest.way.abs())?;
        let (slow, time) = longest(|rest| rest.time)?;
        Some(Block::Sentence(format!(
            "of {count} instants over the cycle before, the longest distance to rest is {} {unit}, in {} s, {}; the longest time {} s, {} {unit}, {}",
            self.way(axis, way.way),
            self.time(way.time),
            from(far),
            self.time(time.time),
            self.way(axis, time.way),
            from(slow)
        )))
    }

    /// Loads, payloads and carriages of each machine that follow the clock of `[motion]`.
    pub(super) fn by_motion(&self) -> Vec<String> {
        let duration = self.simulation.duration;
        let machines = self.machines.all().enumerate();
        let lines = machines.flat_map(|(k, machine)| {
            let prefix = k.checked_sub(1);
            let prefix = prefix.map_or_else(String::new, |k| format!("{}: ", beside_name(k)));
            let lines = machine.file.by_the_clock(duration);
            lines
                .map(move |line| format!("{prefix}{line}"))
                .collect::<Vec<_>>()
        });
        lines.collect()
    }

    /// The magnitude of a distance; 0 below the rounding error of the whole motion.
    fn way(&self, axis: &Axis, way: f64) -> String {
        let positions = self.found.states.iter().map(|[phi, ..]| *phi);
        let first = positions.clone().next().unwrap_or(0.0);
        let most = positions.fold(0.0f64, |most, phi| most.max((phi - first).abs()));
        shown(axis.shown_way(way).abs(), axis.shown_way(most))
    }

    /// Time and distance to the requested speed.
    fn reached(&self, axis: &Axis) -> Option<String> {
        let speed = self.simulation.to_speed?;
        let unit = axis.coordinate.speed_unit();
        let speed = if axis.coordinate == Coordinate::Angle {
            format!("{} rpm", short(speed / RPM))
        } else {
            format!("{} {unit}", short(axis.rate(speed)))
        };
        Some(match self.found.reached {
            Some(reached) => format!(
                "{speed} are reached {} s and {} {} after the start",
                self.time(reached.time),
                self.way(axis, reached.way),
                axis.coordinate.unit()
            ),
            None if self.found.ended.is_some() => {
                format!("{speed} are not reached before the run ends")
            }
            None => format!(
                "{speed} are not reached in {} s",
                short(self.simulation.duration)
            ),
        })
    }

    /// The largest torque and power of the motor.
    fn effort(&self) -> Option<String> {
        let effort = self.found.effort?;
        let unit = self.effort_unit();
        let speed = if self.slides() {
            format!("{} m/s", short(effort.speed[0]))
        } else {
            format!("{} rpm", short(effort.speed[0] / RPM))
        };
        let until = if self.found.halted_at.is_some() {
            " until it is switched off"
        } else {
            ""
        };
        let speed = if effort.speed[0] == 0.0 {
            "it does not turn".to_owned()
        } else {
            format!(
                "its largest speed is {speed} at {} s",
                self.time(effort.speed[1])
            )
        };
        let [torque, at] = effort.torque;
        if torque == 0.0 {
            let what = if self.slides() { "force" } else { "torque" };
            return Some(format!("the motor gives no {what}{until}; {speed}"));
        }
        let power = match effort.power {
            [0.0, _] => "no power".to_owned(),
            [power, at] => format!("up to {} W at {} s", short(power), self.time(at)),
        };
        Some(format!(
            "the motor gives up to {} {unit} at {} s, RMS {} {unit}{until}, and {power}; {speed}",
            short(torque),
            self.time(at),
            short(effort.rms)
        ))
    }

    /// A warning where the process loads drive the machine over its whole turns.
    fn driven(&self) -> Option<String> {
        let turned = self.found.turned?;
        let works = [turned.motor, turned.process, turned.losses, turned.kinetic];
        let [motor, process, losses, kinetic] = works.map(|work| work / turned.turns.abs());
        let driven = driven(&Turns {
            works: [motor, process, losses],
            kinetic,
            is_backwards: turned.turns < 0.0,
        })?;
        Some(format!("the process loads {driven}"))
    }

    fn torque_limit(&self, axis: &Axis) -> Option<String> {
        let limit = self.found.torque_limit?;
        let times = match limit.count {
            1 => "once".to_owned(),
            count => format!("{count} times"),
        };
        Some(format!(
            "the motor is at the limit of its torque {times}, for {} s in all; first at {} s, {}",
            short(limit.duration),
            self.time(limit.time),
            axis.place(limit.position)
        ))
    }

    /// The sentence about end stops.
    fn impacts(&self, axis: &Axis) -> Option<String> {
        let impacts = self.found.impacts?;
        let all = match impacts.count {
            1 => String::new(),
            count if impacts.settled => format!(
                "; {count} impacts in all until it rests: flights shorter than {} µs are not counted",
                short(BRIEFEST_FLIGHT * 1e6)
            ),
            count => format!("; {count} impacts in all"),
        };
        Some(format!(
            "the drive link hits its end stop, {}, at {} s with {} {}{all}",
            axis.place(impacts.position),
            self.time(impacts.time),
            short(axis.rate(impacts.speed)),
            axis.coordinate.speed_unit()
        ))
    }

    /// The sentence about the stop.
    fn rest(&self, axis: &Axis) -> Option<String> {
        let Some(halt) = self.simulation.halt else {
            let held = self.found.held.filter(|_| self.found.missing.is_none())?;
            return Some(format!(
                "the machine comes to rest {} s and {} {} after the start, and friction holds it",
                self.time(held.time),
                self.way(axis, held.way),
                axis.coordinate.unit()
            ));
        };
        let off = format!("the motor is switched off at {} s", self.time(halt.time));
        if self.found.halted_at.is_none() {
            return Some(format!("the run ends before {off}"));
        }
        let later = |rest: Rest| {
            let way = short(axis.shown_way(rest.way));
            format!(
                "{} s and {way} {} later",
                short(rest.time),
                axis.coordinate.unit()
            )
        };
        Some(match (self.found.turned_back, self.found.rest) {
            (None, Some(rest)) => format!("{off}; the machine comes to rest {}", later(rest)),
            (None, None) => format!("{off}; the machine has not come to rest by the end"),
            (Some(first), Some(rest)) => format!(
                "{off}; the machine stands still {}, turns back, and comes to rest {}",
                later(first),
                later(rest)
            ),
            (Some(first), None) => format!(
                "{off}; warning: the machine stands still {}, but nothing holds it there: it turns back, and has not come to rest by the end; a brake holds it (brake_torque in `stop`)",
                later(first)
            ),
        })
    }
}

/// Limits of the drive that are exceeded, and the temperature rise.
fn drive_sentences(loads: &Loads, axis: &Axis, file: &MachineFile) -> Vec<Block> {
    let place = |peak: &Peak| format!("at {} s, {}", short(peak.time), axis.place(peak.phi));
    let mut lines = Vec::new();
    if let Some(peak) = loads.gearbox_torque.filter(Peak::exceeds) {
        lines.push(Block::Warning(format!(
            "the gearbox carries up to {} N m, {}; its acceleration torque is {} N m",
            short(peak.value),
            place(&peak),
            short(peak.allowed.unwrap_or_default())
        )));
    }
    if loads.motor_speed.exceeds() {
        let peak = loads.motor_speed;
        lines.push(Block::Warning(format!(
            "the motor turns the gearbox with up to {} rpm, {}; its largest input speed is {} rpm",
            short(peak.value / RPM),
            place(&peak),
            short(peak.allowed.unwrap_or_default() / RPM)
        )));
    }
    if let Some(heat) = loads.heat {
        let peak = heat.hottest;
        let block = if peak.exceeds() {
            Block::Warning
        } else {
            Block::Sentence
        };
        let ambient = file.site.surroundings.ambient;
        let (value, allowed) = if heat.relative {
            let percent = |share: f64| format!("{} % of its rated rise", short(100.0 * share));
            (percent(peak.value), peak.allowed.map(percent))
        } else {
            let degrees = |rise: f64| format!("{} °C", short(ambient + rise));
            (degrees(peak.value), peak.allowed.map(degrees))
        };
        let allowed =
            allowed.map_or_else(String::new, |allowed| format!("; {allowed} are allowed"));
        lines.push(block(format!(
            "the motor, cold at the start, reaches {value}, {}{allowed}",
            place(&peak)
        )));
    }
    lines
}
