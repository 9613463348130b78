//! The fastest motion, for reading, as CSV and as JSON.

mod drive;
mod moves;
mod rules;

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::contact::of_fastest;
use crate::list::kept;
use crate::table::output::{Format, json_parts, parts};
use jred::Error;
use jred_machine::model::machine::MachineFile;
use jred_machine::number::columns::{Column, Columns, Quantity};
use jred_machine::number::rounding::{percent, short};
use jred_machine::number::words::counted;
use jred_machine::units::Vocabulary;
use jred_motion::contact::Broken;
use jred_motion::fastest::Reserve;
use jred_motion::fastest::cycle::Cycle;
use jred_motion::fastest::joint_force::Reached;
use jred_motion::fastest::ruled::Judged;
use jred_motion::moves::Chain;
use jred_motion::trace::Node;
use jred_motion::way::{Actuator, BothWays};
use jred_sizing::select::fit::input_kind;

pub use drive::Warmth;
use drive::winding_json;
use moves::move_json;
use rules::rules_json;

/// Name and version of the form in JSON.
const SCHEMA: &str = "jred-fastest/1";

/// Durations that differ by a smaller share are shown as the same.
const SAME: f64 = 5e-4;

/// Durations from so many times another one on are spoken of as a multiple.
const MANY: f64 = 3.0;

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
    /// What the motion of the file is made of, if that was asked for.
    pub chain: Option<&'a Chain>,
    /// Temperatures of the winding, where they are limited.
    pub warmth: Option<&'a Warmth>,
    /// The largest forces in the joints whose force is limited.
    pub forces: &'a [Reached],
    /// The contact that the motion loses.
    pub broken: Option<&'a Broken>,
    /// What was asked for, option by option.
    pub asked: Vec<String>,
    /// What it leaves unused of motor and gearbox.
    pub reserve: Reserve,
    /// How the rules judge it, where they are kept.
    pub judged: Option<&'a Judged>,
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
        let kept: f64 = cycle.kept.iter().map(|part| part.kept.duration).sum();
        if kept > 0.0 {
            let _ = write!(says, ", {} s kept", short(kept));
        }
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
        if let Some(chain) = self.chain {
            for (name, says) in kept::lines(self.file, chain) {
                line(&mut text, name, &says);
            }
            if let Some(says) = kept::limits(self.file, Some(&self.asked)) {
                line(&mut text, "limits", &says);
            }
        }
        for part in &self.cycle.kept {
            self.exceeded(part, &mut text);
        }
        self.motor(&mut text);
        if let Some(warmth) = self.warmth {
            self.winding(warmth, &mut text);
        }
        for force in self.forces {
            line(&mut text, "joint force", &self.force(force));
        }
        if let Some(broken) = self.broken {
            let says = of_fastest(broken, &self.file.axis());
            line(&mut text, "warning", &says);
        }
        line(&mut text, "reserve", &self.reserve());
        if let Some(judged) = self.judged {
            self.rules(judged, &mut text);
        }
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
            let torque = self.words().torque;
            let binds = self.warmth.is_some_and(|warmth| warmth.bound.is_some());
            // A limit of the temperature is kept as one of the RMS torque.
            let (near, rms) = if binds {
                let near = format!(
                    "no motion near it with its RMS {torque} is faster; one that spreads its losses otherwise over the cycle may be"
                );
                (near, format!(", RMS {torque} and winding temperature"))
            } else {
                (
                    "no motion near it is faster".to_owned(),
                    format!(" and RMS {torque}"),
                )
            };
            let says = format!(
                "{near}; without limits of jerk, {torque} rate{rms} the moves take {} s, and none takes less",
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

    /// Whether the motion turns for ever without rest.
    fn is_endless(&self) -> bool {
        let mut nodes = self.cycle.trace.nodes().iter();
        self.chain.is_some() && nodes.all(|node| node.omega != 0.0)
    }

    /// Whether it is one move that ends in motion, and whether it is one that begins or ends so: such a move is not repeated.
    fn passes(&self) -> [bool; 2] {
        let nodes = self.cycle.trace.nodes();
        let moves = |node: Option<&Node>| node.is_some_and(|node| node.omega != 0.0);
        let [begins, ends] = [moves(nodes.first()), moves(nodes.last())];
        [ends, begins || ends].map(|passes| passes && self.chain.is_none())
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
        if let Some(judged) = self.judged {
            map.insert("rules".into(), rules_json(judged));
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
        let broken = self.broken.map(|broken| of_fastest(broken, &axis));
        map.insert("contact_lost".into(), json!(broken));
        map.insert("unit".into(), axis.coordinate.per().into());
        let moves: Vec<Value> = (cycle.moves.iter())
            .map(|made| move_json(made, &axis, self.file))
            .collect();
        map.insert("moves".into(), moves.into());
        if let Some(chain) = self.chain {
            map.insert("kept".into(), kept::json(self.file, chain));
        }
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

/// A line: its name, and what it says.
fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<13} {says}");
}
