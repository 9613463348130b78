//! A simulated motion, for reading and as JSON.

use serde_json::{Map, Value, json};

use crate::table::output::{Format, json_parts, parts};
use jred_machine::analysis::simulate::{Effort, Rest, Simulated, Stop, Together, beside_name};
use jred_machine::model::axis::Axis;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::simulation::Simulation;
use jred_machine::number::rounding::{short, shown};
use jred_machine::units::RPM;
use jred_motion::driven::{Loads, Peak};

/// A simulated motion.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'s> {
    /// The machines on the motor's shaft.
    pub machines: &'s Together<'s>,
    /// What was asked for.
    pub simulation: &'s Simulation,
    /// The motion.
    pub found: &'s Simulated,
    /// Stops at instants over a cycle.
    pub stops: Option<&'s [Stop]>,
    /// The drive of the catalogue: its name, and what it bears.
    pub drive: Option<(&'s str, &'s Loads)>,
}

impl<'s> Shown<'s> {
    /// The motion in one of the formats, part by part; CSV is the rows alone.
    pub fn write(&self, format: Format) -> Box<dyn Iterator<Item = String> + 's> {
        let columns = &self.found.columns;
        match format {
            Format::Csv => parts(columns, format, ""),
            Format::Table => {
                let title = std::iter::once(self.title()).chain(self.sentences());
                parts(columns, format, &title.collect::<Vec<_>>().join("\n"))
            }
            Format::Json => {
                let mut before = Map::new();
                before.insert("title".into(), self.title().into());
                Box::new(json_parts(columns, before, self.figures()))
            }
        }
    }

    fn kind(&self) -> &'static str {
        if self.simulation.control.is_some() {
            "motion under its controller"
        } else {
            "free motion"
        }
    }

    /// What a page is about, below the title of the first machine.
    pub(crate) fn about(&self) -> String {
        let motor = self.drive.map_or_else(
            || "the motor of the machine file".to_owned(),
            |(name, _)| format!("the drive {name}"),
        );
        let beside = self.machines.beside_in_words();
        format!("{} with {motor}{beside}", self.kind())
    }

    /// A title, and below it what happened.
    pub(crate) fn summary(&self) -> String {
        [self.title(), self.sentences().join("\n")].join("\n\n")
    }

    fn title(&self) -> String {
        let simulation = self.simulation;
        let kind = self.kind();
        let drive = self
            .drive
            .map_or_else(String::new, |(name, _)| format!(" with the drive {name}"));
        format!(
            "{}: {kind}{drive}, Dormand-Prince 8(5,3), tolerance {:e}",
            self.machines.title(),
            simulation.tolerance
        )
    }

    /// What happened on the way, sentence by sentence.
    fn sentences(&self) -> Vec<String> {
        let axis = self.machines.first.axis();
        let effort = self.effort_unit();
        let mut lines = self.by_motion();
        if let Some(stuck) = self.found.missing {
            let missing = (stuck.missing.needed - stuck.missing.given).abs();
            lines.push(format!(
                "the motor does not drive the machine beyond {}, at {} s: at rest it gives {} {effort} there, {} {effort} are needed, {} {effort} are missing",
                axis.place(stuck.missing.phi),
                short(stuck.time),
                short(stuck.missing.given.abs()),
                short(stuck.missing.needed.abs()),
                short(missing)
            ));
        }
        lines.extend(self.reached(&axis));
        lines.extend(self.effort());
        lines.extend(self.torque_limit(&axis));
        if let Some(following) = self.found.following {
            lines.push(format!(
                "largest following error: {} {} at {} s, {}",
                self.way(&axis, following.error),
                axis.coordinate.unit(),
                short(following.time),
                axis.place(following.position)
            ));
        }
        if let Some((_, loads)) = self.drive {
            lines.extend(drive_sentences(loads, &axis, self.machines.first));
        }
        lines.extend(self.impacts(&axis));
        lines.extend(self.rest(&axis));
        lines.extend(self.worst_stop(&axis));
        lines
    }

    /// The longest of the stops over a cycle.
    fn worst_stop(&self, axis: &Axis) -> Option<String> {
        let stops = self.stops?;
        let count = stops.len();
        let unit = axis.coordinate.unit();
        let from = |stop: &Stop| {
            format!(
                "switched off at {} s, {}",
                short(stop.time),
                axis.place(stop.position)
            )
        };
        if let Some(moving) = stops.iter().find(|stop| stop.rest.is_none()) {
            return Some(format!(
                "warning: of {count} instants over the cycle before, {} the machine has not come to rest by the end",
                from(moving)
            ));
        }
        let longest = |of: fn(&Rest) -> f64| {
            let rests = stops.iter().filter_map(|stop| Some((stop, stop.rest?)));
            rests.max_by(|a, b| of(&a.1).total_cmp(&of(&b.1)))
        };
        let (far, way) = longest(|rest| rest.way.abs())?;
        let (slow, time) = longest(|rest| rest.time)?;
        Some(format!(
            "of {count} instants over the cycle before, the longest way to rest is {} {unit}, in {} s, {}; the longest time {} s, {} {unit}, {}",
            self.way(axis, way.way),
            short(way.time),
            from(far),
            short(time.time),
            self.way(axis, time.way),
            from(slow)
        ))
    }

    /// What acts, is carried and moves by the clock of `[motion]`, of each machine.
    fn by_motion(&self) -> Vec<String> {
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

    /// The size of a way; zero if it is only a rounding error compared with the way of the whole motion.
    fn way(&self, axis: &Axis, way: f64) -> String {
        let positions = self.found.states.iter().map(|[phi, ..]| *phi);
        let first = positions.clone().next().unwrap_or(0.0);
        let most = positions.fold(0.0f64, |most, phi| most.max((phi - first).abs()));
        shown(axis.shown_way(way).abs(), axis.shown_way(most))
    }

    /// When the speed that was asked for is reached.
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
                short(reached.time),
                self.way(axis, reached.way),
                axis.coordinate.unit()
            ),
            None => format!(
                "{speed} are not reached in {} s",
                short(self.simulation.duration)
            ),
        })
    }

    /// What the motor gives at most.
    fn effort(&self) -> Option<String> {
        let effort = self.found.effort?;
        let unit = self.effort_unit();
        let speed = if self.slides() {
            format!("{} m/s", short(effort.speed[0]))
        } else {
            format!("{} rpm", short(effort.speed[0] / RPM))
        };
        let until = if self.simulation.halt.is_some() {
            " until it is switched off"
        } else {
            ""
        };
        Some(format!(
            "the motor gives up to {} {unit} at {} s, RMS {} {unit}{until}, and up to {} W at {} s; its largest speed is {speed} at {} s",
            short(effort.torque[0]),
            short(effort.torque[1]),
            short(effort.rms),
            short(effort.power[0]),
            short(effort.power[1]),
            short(effort.speed[1]),
        ))
    }

    fn effort_unit(&self) -> &'static str {
        if self.slides() { "N" } else { "N m" }
    }

    fn slides(&self) -> bool {
        self.simulation.drives_a_slide(self.machines.first)
    }

    fn torque_limit(&self, axis: &Axis) -> Option<String> {
        let limit = self.found.torque_limit?;
        let times = match limit.count {
            1 => "once".to_owned(),
            count => format!("{count} times"),
        };
        Some(format!(
            "warning: the motor is at the limit of its torque {times}, for {} s in all; first at {} s, {}",
            short(limit.duration),
            short(limit.time),
            axis.place(limit.position)
        ))
    }

    /// The same for JSON.
    fn figures(&self) -> Map<String, Value> {
        let axis = self.machines.first.axis();
        let unit = axis.coordinate.unit();
        let (position, speed, way) = (
            format!("position [{unit}]"),
            format!("speed [{}]", axis.coordinate.speed_unit()),
            format!("way [{unit}]"),
        );
        let mut after = Map::new();
        let mut add = |key: &str, value: Value| after.insert(key.to_owned(), value);
        let by_motion = self.by_motion();
        if !by_motion.is_empty() {
            add("by_motion", json!(by_motion));
        }
        if let Some(impacts) = self.found.impacts {
            let first = json!({
                "time [s]": impacts.time,
                &position: axis.shown(impacts.position),
                speed: axis.rate(impacts.speed),
            });
            add("impacts", json!({ "count": impacts.count, "first": first }));
        }
        if self.simulation.halt.is_some() {
            let rest = (self.found.rest).map(
                |rest| json!({ "time [s]": rest.time, way.as_str(): axis.shown_way(rest.way) }),
            );
            add("rest", json!(rest));
        }
        if let Some(stops) = self.stops {
            let stop = |stop: &Stop| {
                json!({
                    "time [s]": stop.time,
                    &position: axis.shown(stop.position),
                    "to rest [s]": stop.rest.map(|rest| rest.time),
                    way.as_str(): stop.rest.map(|rest| axis.shown_way(rest.way)),
                })
            };
            let all: Vec<Value> = stops.iter().map(stop).collect();
            add("stops_over_the_cycle", all.into());
        }
        if let Some(held) = self.found.held {
            let held = json!({ "time [s]": held.time, way.as_str(): axis.shown_way(held.way) });
            add("held", held);
        }
        if self.simulation.to_speed.is_some() {
            let reached = self.found.reached.map(
                |reached| json!({ "time [s]": reached.time, way.as_str(): axis.shown_way(reached.way) }),
            );
            add("reached", json!(reached));
        }
        if let Some(effort) = self.found.effort {
            add("motor", self.motor(&effort));
        }
        if let Some(stuck) = self.found.missing {
            let effort = self.effort_unit();
            add(
                "stops",
                json!({
                    "time [s]": stuck.time,
                    &position: axis.shown(stuck.missing.phi),
                    format!("given [{effort}]"): stuck.missing.given,
                    format!("needed [{effort}]"): stuck.missing.needed,
                }),
            );
        }
        if let Some(limit) = self.found.torque_limit {
            let first = json!({ "time [s]": limit.time, &position: axis.shown(limit.position) });
            add(
                "torque_limit",
                json!({ "count": limit.count, "duration [s]": limit.duration, "first": first }),
            );
        }
        if let Some(following) = self.found.following {
            add(
                "following_error",
                json!({
                    "time [s]": following.time,
                    &position: axis.shown(following.position),
                    format!("error [{unit}]"): axis.shown_way(following.error),
                }),
            );
        }
        if let Some((name, loads)) = self.drive {
            add("drive", self.drive_figures(&axis, name, loads));
        }
        if let Some(error) = &self.found.ended {
            add("ended", error.to_string().into());
        }
        after
    }

    /// What the motor gives, for JSON.
    fn motor(&self, effort: &Effort) -> Value {
        let unit = self.effort_unit();
        let most = |[value, time]: [f64; 2], scale: f64, unit: &str| json!({ format!("largest [{unit}]"): value * scale, "time [s]": time });
        let (scale, speed) = if self.slides() {
            (1.0, "m/s")
        } else {
            (1.0 / RPM, "rpm")
        };
        json!({
            "effort": most(effort.torque, 1.0, unit),
            format!("RMS [{unit}]"): effort.rms,
            "power": most(effort.power, 1.0, "W"),
            "speed": most(effort.speed, scale, speed),
        })
    }

    /// What the drive bears, for JSON.
    fn drive_figures(&self, axis: &Axis, name: &str, loads: &Loads) -> Value {
        let position = format!("position [{}]", axis.coordinate.unit());
        let peak = |peak: &Peak, scale: f64, unit: &str| {
            json!({
                "time [s]": peak.time,
                &position: axis.shown(peak.phi),
                format!("largest [{unit}]"): peak.value * scale,
                format!("allowed [{unit}]"): peak.allowed.map(|allowed| allowed * scale),
            })
        };
        let (scale, unit) = if self.slides() {
            (1.0, "m/s")
        } else {
            (1.0 / RPM, "rpm")
        };
        let mut drive = Map::new();
        drive.insert("name".into(), name.into());
        drive.insert("motor_speed".into(), peak(&loads.motor_speed, scale, unit));
        if let Some(torque) = &loads.gearbox_torque {
            drive.insert("gearbox_torque".into(), peak(torque, 1.0, "N m"));
        }
        if let Some(heat) = &loads.heat {
            let (scale, unit) = if heat.relative {
                (100.0, "% of the rated rise")
            } else {
                (1.0, "K")
            };
            drive.insert("rise".into(), peak(&heat.hottest, scale, unit));
        }
        drive.into()
    }

    /// The sentence about end stops.
    fn impacts(&self, axis: &Axis) -> Option<String> {
        let impacts = self.found.impacts?;
        let all = match impacts.count {
            1 => String::new(),
            count => format!("; {count} impacts in all"),
        };
        Some(format!(
            "warning: the drive link hits its end stop, {}, at {} s with {} {}{all}",
            axis.place(impacts.position),
            short(impacts.time),
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
                short(held.time),
                self.way(axis, held.way),
                axis.coordinate.unit()
            ));
        };
        let off = format!("the motor is switched off at {} s", short(halt.time));
        Some(match self.found.rest {
            Some(rest) => format!(
                "{off}; the machine comes to rest {} s and {} {} later",
                short(rest.time),
                short(axis.shown_way(rest.way)),
                axis.coordinate.unit()
            ),
            None => format!("{off}; the machine has not come to rest by the end"),
        })
    }
}

/// What the drive bears more than it may, and how warm it gets.
fn drive_sentences(loads: &Loads, axis: &Axis, file: &MachineFile) -> Vec<String> {
    let place = |peak: &Peak| format!("at {} s, {}", short(peak.time), axis.place(peak.phi));
    let mut lines = Vec::new();
    if let Some(peak) = loads.gearbox_torque.filter(Peak::exceeds) {
        lines.push(format!(
            "warning: the gearbox carries up to {} N m, {}; its acceleration torque is {} N m",
            short(peak.value),
            place(&peak),
            short(peak.allowed.unwrap_or_default())
        ));
    }
    if loads.motor_speed.exceeds() {
        let peak = loads.motor_speed;
        lines.push(format!(
            "warning: the motor turns the gearbox with up to {} rpm, {}; its largest input speed is {} rpm",
            short(peak.value / RPM),
            place(&peak),
            short(peak.allowed.unwrap_or_default() / RPM)
        ));
    }
    if let Some(heat) = loads.heat {
        let peak = heat.hottest;
        let over = if peak.exceeds() { "warning: " } else { "" };
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
        lines.push(format!(
            "{over}the motor, cold at the start, reaches {value}, {}{allowed}",
            place(&peak)
        ));
    }
    lines
}
