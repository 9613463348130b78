//! The fastest motion, for reading, as CSV and as JSON.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::table::output::{Format, json_parts, parts};
use crate::table::sheet::Reading;
use jred::Error;
use jred_machine::model::axis::Axis;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::mechanism::AnyMechanism;
use jred_machine::number::columns::{Column, Columns, Quantity};
use jred_machine::number::rounding::{percent, short, shown};
use jred_machine::number::words::counted;
use jred_machine::units::RPM;
use jred_motion::fastest::cycle::{Cost, Cycle, MORE, Made};
use jred_motion::fastest::{Binding, Phase, Reserve};
use jred_motion::way::{Actuator, BothWays};
use jred_sizing::study::cell::Cell;

/// Name and version of the form in JSON.
const SCHEMA: &str = "jred-fastest/1";

/// Durations that differ by a smaller share are shown as the same.
const SAME: f64 = 5e-4;

/// Share of the largest speed that is a rounding error: speeds are roots of energies.
const STANDS: f64 = 1e-8;

/// Share of a move's time below which a phase is none.
const LEAST_PHASE: f64 = 1e-9;

/// What a motion is refined to: less is chance.
const LEAST_EXCESS: f64 = 1e-9;

/// The fastest motion of a machine with a drive.
pub struct Answer<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Name of the drive.
    pub drive: &'a str,
    /// What moves the machine.
    pub actuator: &'a Actuator,
    /// The motion.
    pub cycle: &'a Cycle,
    /// What was asked for, option by option.
    pub asked: Vec<String>,
    /// What it leaves unused of motor and gearbox.
    pub reserve: Reserve,
    /// Whether the drive is one of the catalogue, which `jred size` can judge.
    pub of_catalogue: bool,
    /// Instants of the course.
    pub instants: usize,
}

impl Answer<'_> {
    /// In one of the formats, part by part; CSV is the course alone, a table has no course.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn write(&self, format: Format) -> Result<Box<dyn Iterator<Item = String>>, Error> {
        if format == Format::Table {
            return Ok(Box::new(std::iter::once(self.text())));
        }
        let course = self.course()?;
        let text: Vec<String> = match format {
            Format::Csv => parts(&course, Format::Csv, "").collect(),
            Format::Table | Format::Json => json_parts(&course, self.json(), Map::new()).collect(),
        };
        Ok(Box::new(text.into_iter()))
    }

    /// The motion over the time, with the torque and speed of the motor.
    fn course(&self) -> Result<Columns, Error> {
        let axis = self.file.axis();
        let coordinate = axis.coordinate;
        let [speed, acceleration] = coordinate.rates();
        let [effort, motor_speed] = self.motor_units();
        let mut columns = Columns::new([
            Column::new(Quantity::Time, "t", "s"),
            coordinate.column(),
            speed,
            acceleration,
            Column::new(Quantity::MotorEffort, "motor torque", effort),
            Column::other("motor speed", motor_speed),
        ]);
        let ways = BothWays::new(self.file, self.actuator);
        let trace = &self.cycle.trace;
        let last = self.instants.max(2) - 1;
        for k in 0..=last {
            let t = trace.duration() * k as f64 / last as f64;
            let state = trace.at(t);
            let torque = ways.torque(&state, trace.heading(t))?;
            let motor_speed = ways.forwards().motor_speed(state.omega);
            let state = axis.state(&state);
            let position = coordinate.shown(state.phi);
            columns.push([t, position, state.omega, state.alpha, torque, motor_speed]);
        }
        Ok(columns)
    }

    /// Units of effort and speed of the motor.
    fn motor_units(&self) -> [&'static str; 2] {
        let direct = self.file.drive_train.stages().is_empty();
        let linear = self.cycle.trace.coordinate == Coordinate::Length && direct;
        if linear {
            ["N", "m/s"]
        } else {
            ["N m", "rad/s"]
        }
    }

    /// As the terminal shows it.
    pub(crate) fn text(&self) -> String {
        let cycle = self.cycle;
        let mut text = format!(
            "{}: fastest motion with {}\n\n",
            self.file.title, self.drive
        );
        let whole = cycle.trace.duration();
        let moves = counted(cycle.moves.len(), "move", "moves");
        let moving: f64 = cycle.moves.iter().map(|made| made.fastest.time).sum();
        let mut says = format!("{} s: {moves} in {} s", short(whole), short(moving));
        if cycle.dwells > 0.0 {
            let _ = write!(says, ", {} s at rest", short(cycle.dwells));
        }
        if let Some(before) = cycle.before {
            let _ = write!(says, "; {} s in the file, ", short(before));
            let share = whole / before - 1.0;
            if share.abs() < SAME {
                says += "the same";
            } else {
                let side = if share < 0.0 { "less" } else { "more" };
                let _ = write!(says, "{} {side}", percent(share.abs()));
            }
        }
        line(&mut text, "duration", &says);
        if !self.asked.is_empty() {
            line(&mut text, "asked for", &self.asked.join("; "));
        }
        self.motor(&mut text);
        line(&mut text, "reserve", &self.reserve());
        let worst = cycle.moves.iter().map(|made| made.fastest.excess);
        let error = cycle.moves.iter().map(|made| made.fastest.error);
        let error = error.sum::<f64>();
        let error = error.max(1e-12 * whole);
        let worst = worst.fold(LEAST_EXCESS, f64::max);
        let says = format!(
            "duration within {error:.0e} s; limits satisfied within {worst:.0e} between the nodes"
        );
        line(&mut text, "accuracy", &says);
        let bounds = cycle.moves.iter().map(|made| made.fastest.bound);
        if let Some(bounds) = bounds.collect::<Option<Vec<f64>>>() {
            let least: f64 = bounds.iter().sum();
            let says = format!(
                "no motion near it is faster; without limits of jerk, torque rate and RMS torque the moves take {} s, and none takes less",
                short(least)
            );
            line(&mut text, "optimum", &says);
        }
        for (k, made) in cycle.moves.iter().enumerate() {
            text.push('\n');
            text += &self.one_move(k + 1, made);
        }
        text
    }

    /// What the motor does, and the pause that it needs.
    fn motor(&self, text: &mut String) {
        let [effort, speed_unit] = self.motor_units();
        // A motor that turns is spoken of in rpm.
        let (speed_unit, per_speed) = match speed_unit {
            "rad/s" => ("rpm", RPM),
            other => (other, 1.0),
        };
        let load = &self.cycle.load;
        let continuous = if load.continuous.is_finite() {
            format!(
                ", S1 torque {} {effort} at the mean speed{}",
                short(load.continuous),
                if load.allowed < load.continuous {
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
        let holding = if self.is_endless() {
            String::new()
        } else {
            let holding = shown(load.holding, load.peaks[0]);
            format!("; {holding} {effort} to hold the end")
        };
        line(
            text,
            "motor torque",
            &format!(
                "RMS {} {effort}{continuous}; peak {} {effort}{holding}",
                short(load.rms),
                short(load.peaks[0])
            ),
        );
        line(
            text,
            "motor speed",
            &format!(
                "peak {} {speed_unit}, mean {} {speed_unit}",
                short(load.peaks[1] / per_speed),
                short(load.mean_speed / per_speed)
            ),
        );
        let what = if load.allowed < load.continuous {
            format!(
                "{} of the S1 torque",
                percent(load.allowed / load.continuous)
            )
        } else {
            "the S1 torque".to_owned()
        };
        match load.pause {
            Some(0.0) => {}
            _ if self.is_endless() => line(
                text,
                "warning",
                &format!(
                    "the RMS torque exceeds {what}, and a motion that turns for ever has no pause: take a larger drive, or a slower motion"
                ),
            ),
            Some(pause) => line(
                text,
                "warning",
                &format!(
                    "the RMS torque exceeds {what}: repeated, the motion needs {} s more at rest each time",
                    short(pause)
                ),
            ),
            None => line(
                text,
                "warning",
                &format!(
                    "the RMS torque exceeds {what}, and no pause helps: holding the machine alone takes more than that"
                ),
            ),
        }
    }

    /// Whether the motion turns for ever.
    fn is_endless(&self) -> bool {
        self.cycle.moves.iter().any(|made| made.task.endless)
    }

    fn reserve(&self) -> String {
        let shares = |reserve: &Reserve| {
            let shares = [
                (reserve.torque, "motor torque"),
                (reserve.speed, "motor speed"),
                (reserve.gearbox_torque, "gearbox torque"),
                (reserve.gearbox_speed, "gearbox speed"),
                (reserve.rms, "S1 torque"),
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
                "none; `jred size` keeps {}: --reserve rules leaves that unused",
                shares(&asked)
            );
        }
        "none".to_owned()
    }

    fn one_move(&self, number: usize, made: &Made) -> String {
        let axis = self.file.axis();
        let unit = axis.coordinate.unit();
        let ends = [made.task.from, made.task.to].map(|phi| axis.shown(phi).abs());
        let farthest = ends[0].max(ends[1]);
        let position = |phi: f64| shown(axis.shown(phi), farthest);
        let mut text = format!(
            "move {number}: {} {unit} to {} {unit} in {} s",
            position(made.task.from),
            position(made.task.to),
            short(made.fastest.time)
        );
        if let Some(before) = made.before {
            let _ = write!(text, " ({} s in the file)", short(before));
        }
        text.push('\n');
        let columns = [
            "at its limit".to_owned(),
            format!("from {} [{unit}]", axis.symbol()),
            "to".to_owned(),
            "from t [s]".to_owned(),
            "to".to_owned(),
            format!("speed from [{}]", axis.coordinate.speed_unit()),
            "to".to_owned(),
        ];
        let speeds = made.fastest.phases.iter().flat_map(|phase| phase.speed);
        let fastest = axis.rate(speeds.fold(0.0, f64::max));
        let mechanism = self.file.machine.mechanism();
        let row = |phase: &Phase| -> Vec<Cell> {
            let mut cells = vec![Cell::from(&*phase.limit.name_in(mechanism))];
            let positions = phase.phi.map(&position);
            let times = phase.t.map(|t| shown(t, made.fastest.time));
            let speeds = phase.speed.map(|v| {
                let speed = axis.rate(v);
                short(if speed <= STANDS * fastest {
                    0.0
                } else {
                    speed
                })
            });
            let texts = positions.into_iter().chain(times).chain(speeds);
            cells.extend(texts.map(|text| Cell::from(text.as_str())));
            cells
        };
        // Where a turn closes a phase may have no length.
        let least = LEAST_PHASE * made.fastest.time;
        let phases = made.fastest.phases.iter();
        let phases = phases.filter(|phase| phase.t[1] - phase.t[0] > least);
        let rows: Vec<Vec<Cell>> = phases.map(row).collect();
        text += &Reading::table(&columns, &rows, 7);
        for cost in &made.costs {
            let saved = made.fastest.time - cost.time;
            let _ = writeln!(
                text,
                "{}: {} s, {} s less",
                eased(cost, mechanism),
                short(cost.time),
                short(saved.max(0.0))
            );
        }
        text
    }

    fn json(&self) -> Map<String, Value> {
        let cycle = self.cycle;
        let load = &cycle.load;
        let mut map = Map::new();
        map.insert("schema".into(), SCHEMA.into());
        map.insert("title".into(), self.file.title.clone().into());
        map.insert("drive".into(), self.drive.into());
        map.insert("asked".into(), json!(self.asked));
        map.insert("duration".into(), cycle.trace.duration().into());
        map.insert("duration_before".into(), json!(cycle.before));
        map.insert("at_rest".into(), cycle.dwells.into());
        let reserve = &self.reserve;
        map.insert(
            "reserve".into(),
            json!({
                "torque": reserve.torque,
                "speed": reserve.speed,
                "gearbox_torque": reserve.gearbox_torque,
                "gearbox_speed": reserve.gearbox_speed,
                "s1_torque": reserve.rms,
            }),
        );
        let known = Some(load.continuous).filter(|torque| torque.is_finite());
        map.insert(
            "motor".into(),
            json!({
                "rms_torque": load.rms,
                "peak_torque": load.peaks[0],
                "peak_speed": load.peaks[1],
                "mean_speed": load.mean_speed,
                "holding_torque": load.holding,
                "s1_torque": known,
                "rms_allowed": known.map(|_| load.allowed),
                "pause_needed": load.pause,
            }),
        );
        let axis = self.file.axis();
        map.insert("unit".into(), axis.coordinate.per().into());
        let moves: Vec<Value> = (cycle.moves.iter())
            .map(|made| move_json(made, &axis, self.file.machine.mechanism()))
            .collect();
        map.insert("moves".into(), moves.into());
        map
    }
}

/// A line: its name, and what it says.
fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<13} {says}");
}

/// Without a limit, or with more of the motor's own.
fn eased(cost: &Cost, mechanism: &AnyMechanism) -> String {
    match cost.limit {
        Binding::Driving | Binding::Braking => {
            format!("with {} more motor torque", percent(MORE))
        }
        Binding::MotorSpeed => format!("with {} more motor speed", percent(MORE)),
        limit @ Binding::JointForce(_) => {
            format!("without a limit of the {}", limit.name_in(mechanism))
        }
        limit => format!("without the {}", limit.name()),
    }
}

fn move_json(made: &Made, axis: &Axis, mechanism: &AnyMechanism) -> Value {
    let phases = made.fastest.phases.iter().map(|phase| {
        json!({
            "limit": phase.limit.name_in(mechanism),
            "from": axis.position(phase.phi[0]),
            "to": axis.position(phase.phi[1]),
            "from_time": phase.t[0],
            "to_time": phase.t[1],
            "from_speed": axis.rate(phase.speed[0]),
            "to_speed": axis.rate(phase.speed[1]),
        })
    });
    let costs = made
        .costs
        .iter()
        .map(|cost| json!({ "limit": cost.limit.name_in(mechanism), "eased": eased(cost, mechanism), "time": cost.time }));
    json!({
        "from": axis.position(made.task.from),
        "to": axis.position(made.task.to),
        "from_speed": axis.rate(made.task.speeds[0]),
        "to_speed": axis.rate(made.task.speeds[1]),
        "time": made.fastest.time,
        "time_before": made.before,
        "error": made.fastest.error,
        "bound": made.fastest.bound,
        "excess": made.fastest.excess,
        "phases": phases.collect::<Vec<_>>(),
        "costs": costs.collect::<Vec<_>>(),
    })
}
