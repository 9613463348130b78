//! The fastest motion, for reading, as CSV and as JSON.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::table::output::{Format, json_parts, parts};
use crate::table::sheet::Reading;
use jred::Error;
use jred_machine::model::axis::Axis;
use jred_machine::model::machine::MachineFile;
use jred_machine::number::columns::{Column, Columns, Quantity};
use jred_machine::number::rounding::{percent, short, shown};
use jred_machine::number::words::counted;
use jred_machine::units::Vocabulary;
use jred_motion::fastest::cycle::{Cost, Cycle, MORE, Made};
use jred_motion::fastest::joint_force::Reached;
use jred_motion::fastest::winding::Temperatures;
use jred_motion::fastest::{Binding, Phase, Reserve};
use jred_motion::way::{Actuator, BothWays};
use jred_sizing::select::fit::input_kind;
use jred_sizing::study::cell::Cell;

/// Name and version of the form in JSON.
const SCHEMA: &str = "jred-fastest/1";

/// Durations that differ by a smaller share are shown as the same.
const SAME: f64 = 5e-4;

/// Durations from so many times another one on are spoken of as a multiple.
const MANY: f64 = 3.0;

/// Share of the largest speed that is a rounding error: speeds are roots of energies.
const STANDS: f64 = 1e-8;

/// Share of a move's time below which a phase is none.
const LEAST_PHASE: f64 = 1e-9;

/// What a motion is refined to: less is chance.
const LEAST_EXCESS: f64 = 1e-9;

/// How warm the winding of the motor gets.
pub struct Warmth {
    /// Temperature (°C) of the surroundings.
    pub ambient: f64,
    /// Its temperatures.
    pub temperatures: Temperatures,
    /// The limit (°C).
    pub limit: f64,
    /// Where that binds: the length (s) of the motion without it, and the RMS torque (N·m) to which it comes.
    pub bound: Option<[f64; 2]>,
}

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
    /// Temperatures of the winding, where they are limited.
    pub warmth: Option<&'a Warmth>,
    /// The largest forces in the joints whose force is limited.
    pub forces: &'a [Reached],
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
        let words = self.words();
        let motor_effort = format!("motor {}", words.torque);
        let mut columns = Columns::new([
            Column::new(Quantity::Time, "t", "s"),
            coordinate.column(),
            speed,
            acceleration,
            Column::new(Quantity::MotorEffort, &motor_effort, words.torque.unit),
            Column::other("motor speed", words.speed_si),
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

    /// Words and units of the motor.
    fn words(&self) -> &'static Vocabulary {
        input_kind(self.file).vocabulary()
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
                let _ = write!(says, "{}", more_or_less(whole / before));
            }
        }
        line(&mut text, "duration", &says);
        if !self.asked.is_empty() {
            line(&mut text, "asked for", &self.asked.join("; "));
        }
        self.motor(&mut text);
        if let Some(warmth) = self.warmth {
            self.winding(warmth, &mut text);
        }
        for force in self.forces {
            line(&mut text, "joint force", &self.force(force));
        }
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
                "no motion near it is faster; without limits of jerk, {torque} rate and RMS {torque} the moves take {} s, and none takes less",
                short(least),
                torque = self.words().torque
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
        let Vocabulary { torque, speed, .. } = self.words();
        let effort = torque.unit;
        let load = &self.cycle.load;
        let continuous = if load.continuous.is_finite() {
            format!(
                ", S1 {torque} {} {effort} at the mean speed{}",
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
            &format!("motor {torque}"),
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
                "peak {} {unit}, mean {} {unit}",
                short(load.peaks[1] / speed.scale),
                short(load.mean_speed / speed.scale),
                unit = speed.unit
            ),
        );
        let what = if load.allowed < load.continuous {
            format!(
                "{} of the S1 {torque}",
                percent(load.allowed / load.continuous)
            )
        } else {
            format!("the S1 {torque}")
        };
        match load.pause {
            Some(0.0) => {}
            _ if self.is_endless() => line(
                text,
                "warning",
                &format!(
                    "the RMS {torque} exceeds {what}, and a motion that turns for ever has no pause: take a larger drive, or a slower motion"
                ),
            ),
            Some(pause) => line(
                text,
                "warning",
                &format!(
                    "the RMS {torque} exceeds {what}: repeated, the motion needs {} s more at rest each time",
                    short(pause)
                ),
            ),
            None => line(
                text,
                "warning",
                &format!(
                    "the RMS {torque} exceeds {what}, and no pause helps: holding the machine alone takes more than that"
                ),
            ),
        }
    }

    /// The largest force in a joint, and where.
    fn force(&self, force: &Reached) -> String {
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

    /// How warm the winding gets, and what its limit costs.
    fn winding(&self, warmth: &Warmth, text: &mut String) {
        let Warmth {
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
        line(text, "winding", &says);
        let says = match bound {
            None => "does not bind".to_owned(),
            Some([free, rms]) => {
                let whole = self.cycle.trace.duration();
                format!(
                    "binds: it comes to an RMS of {} {effort}; without it {} s, {} less",
                    short(*rms),
                    short(*free),
                    percent(1.0 - free / whole)
                )
            }
        };
        line(text, "its limit", &says);
    }

    /// Whether the motion turns for ever.
    fn is_endless(&self) -> bool {
        self.cycle.moves.iter().any(|made| made.task.endless)
    }

    fn reserve(&self) -> String {
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
            "greatest".to_owned(),
        ];
        let speeds = made.fastest.phases.iter().flat_map(|phase| phase.speed);
        let fastest = axis.rate(speeds.fold(0.0, f64::max));
        let file = self.file;
        let row = |phase: &Phase| -> Vec<Cell> {
            let mut cells = vec![Cell::from(&*phase.limit.name_in(file))];
            let positions = phase.phi.map(&position);
            let times = phase.t.map(|t| shown(t, made.fastest.time));
            let [from, to] = phase.speed;
            let speeds = [from, to, greatest(made, phase)].map(|v| {
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
        text += &Reading::table(&columns, &rows, 8);
        for cost in &made.costs {
            let saved = made.fastest.time - cost.time;
            let _ = writeln!(
                text,
                "{}: {} s, {} s less",
                eased(cost, file),
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
        if let Some(warmth) = self.warmth {
            map.insert("winding".into(), winding_json(warmth));
        }
        let axis = self.file.axis();
        let forces = self.forces.iter().map(|force| {
            json!({
                "joint": force.name(self.file),
                "force": force.force,
                "limit": force.limit,
                "at": axis.position(force.phi),
                "time": force.t,
                "at_rest": force.stands,
            })
        });
        map.insert("joint_forces".into(), forces.collect());
        map.insert("unit".into(), axis.coordinate.per().into());
        let moves: Vec<Value> = (cycle.moves.iter())
            .map(|made| move_json(made, &axis, self.file))
            .collect();
        map.insert("moves".into(), moves.into());
        map
    }
}

/// `12 % less` than before, `30 % more`, or `12,000 times as much`.
fn more_or_less(ratio: f64) -> String {
    if ratio >= MANY {
        return format!("{} times as much", thousands(ratio));
    }
    let side = if ratio < 1.0 { "less" } else { "more" };
    format!("{} {side}", percent((ratio - 1.0).abs()))
}

/// A ratio with three digits, or whole, its thousands apart.
fn thousands(ratio: f64) -> String {
    if !(1e3..1e15).contains(&ratio) {
        return short(ratio);
    }
    let digits = format!("{ratio:.0}");
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Temperatures in °C; what is without bound has no number.
fn winding_json(warmth: &Warmth) -> Value {
    let Temperatures {
        greatest,
        mean,
        ref heating,
        ..
    } = warmth.temperatures;
    json!({
        "greatest": Some(greatest).filter(|t| t.is_finite()),
        "mean": mean.map(|[mean, _]| mean),
        "ripple": mean.map(|[_, ripple]| ripple),
        "limit": warmth.limit,
        "ambient": warmth.ambient,
        "estimated": heating.relative,
        "ripple_followed": heating.ripple,
        "binds": warmth.bound.is_some(),
        "rms_torque": warmth.bound.map(|[_, rms]| rms),
        "duration_without": warmth.bound.map(|[free, _]| free),
    })
}

/// A line: its name, and what it says.
fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<13} {says}");
}

/// Without a limit, or with more of the motor's own.
fn eased(cost: &Cost, file: &MachineFile) -> String {
    let more = percent(MORE);
    match cost.limit {
        Binding::Driving | Binding::Braking => {
            let torque = input_kind(file).vocabulary().torque;
            format!("with {more} more motor {torque}")
        }
        Binding::MotorSpeed => format!("with {more} more motor speed"),
        limit @ (Binding::JointForce(_)
        | Binding::GearboxTorque
        | Binding::GearboxSpeed
        | Binding::WindingTemperature) => {
            format!("without a limit of the {}", limit.name_in(file))
        }
        limit => format!("without the {}", limit.name_in(file)),
    }
}

/// The greatest speed (rad/s, or m/s) in a phase.
fn greatest(made: &Made, phase: &Phase) -> f64 {
    let [from, to] = phase.t;
    let nodes = made.fastest.trace.nodes().iter();
    let inside = nodes.filter(|node| node.t > from && node.t < to);
    let speeds = inside.map(|node| node.omega.abs());
    phase.speed.into_iter().chain(speeds).fold(0.0, f64::max)
}

fn move_json(made: &Made, axis: &Axis, file: &MachineFile) -> Value {
    let phases = made.fastest.phases.iter().map(|phase| {
        json!({
            "limit": phase.limit.name_in(file),
            "from": axis.position(phase.phi[0]),
            "to": axis.position(phase.phi[1]),
            "from_time": phase.t[0],
            "to_time": phase.t[1],
            "from_speed": axis.rate(phase.speed[0]),
            "to_speed": axis.rate(phase.speed[1]),
            "greatest_speed": axis.rate(greatest(made, phase)),
        })
    });
    let costs = made
        .costs
        .iter()
        .map(|cost| json!({ "limit": cost.limit.name_in(file), "eased": eased(cost, file), "time": cost.time }));
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
