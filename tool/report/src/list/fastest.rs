//! The fastest motion.

mod data;
mod drive;
mod moves;
mod rules;

use std::borrow::Cow;
use std::fmt::Write as _;

use super::contact::of_fastest;
use crate::answer::Answer;
use crate::list::kept;
use crate::table::output::Format;
use jred::error::Error;
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::{Column, ColumnQuantity, Columns};
use jred_file::number::rounding::{percent, short};
use jred_file::number::words::counted;
use jred_file::units::Vocabulary;
use jred_motion::contact::ContactLimits;
use jred_motion::fastest::Reserve;
use jred_motion::fastest::cycle::Cycle;
use jred_motion::fastest::joint_force::JointForcePeak;
use jred_motion::fastest::ruled::Judgement;
use jred_motion::moves::Chain;
use jred_motion::path_dynamics::{Actuator, BothDirections};
use jred_motion::trace::Node;
use jred_sizing::select::fit::input_kind;

pub(crate) use data::FastestData;
pub use drive::WindingHeat;

/// Durations that differ by a smaller share are shown as the same.
const DURATION_TOLERANCE: f64 = 5e-4;

/// Duration ratios from this one on are printed as a multiple.
const MANY: f64 = 3.0;

/// Tolerance of the refinement; a smaller excess is chance.
const LEAST_EXCESS: f64 = 1e-9;

/// The fastest motion of a machine with a drive.
pub struct FastestView<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Name of the drive.
    pub drive: &'a str,
    /// The motor or the drive.
    pub actuator: &'a Actuator,
    /// The motion.
    pub cycle: &'a Cycle,
    /// The parts of the file's motion, if its cycle was requested.
    pub chain: Option<&'a Chain>,
    /// Temperatures of the winding, if they are limited.
    pub warmth: Option<&'a WindingHeat>,
    /// The largest forces in the joints whose force is limited.
    pub forces: &'a [JointForcePeak],
    /// The contact that the motion loses.
    pub broken: Option<&'a ContactLimits>,
    /// The request, option by option.
    pub asked: Vec<String>,
    /// Shares of motor and gearbox that the motion leaves unused.
    pub reserve: Reserve,
    /// Verdicts of the rules, if they were applied.
    pub judged: Option<&'a Judgement>,
    /// Whether the drive is from the catalogue, so that `jred size` can judge it.
    pub of_catalogue: bool,
    /// Number of instants of the course.
    pub instants: usize,
}

impl FastestView<'_> {
    /// The motion over the time, with the torque and speed of the motor.
    fn course(&self) -> Result<Columns, Error> {
        let axis = self.file.axis();
        let coordinate = axis.coordinate;
        let [speed, acceleration] = coordinate.rates();
        let words = self.words();
        let motor_effort = format!("motor {}", words.torque);
        let mut columns = Columns::new([
            Column::new(ColumnQuantity::Time, "t", "s"),
            coordinate.column(),
            speed,
            acceleration,
            Column::new(
                ColumnQuantity::MotorEffort,
                &motor_effort,
                words.torque.unit,
            ),
            Column::other("motor speed", words.speed_si),
        ]);
        let ways = BothDirections::new(self.file, self.actuator);
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

    /// The duration, the load of the drive, then each move. The course, which only CSV and JSON contain, is not computed for text.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn answer(&self, format: Format) -> Result<Answer<'static>, Error> {
        let title = format!("{}: fastest motion with {}", self.file.title, self.drive);
        let mut answer = Answer::new(self.file.title.clone(), &self.data()).titled(title);
        self.describe(&mut answer);
        if format != Format::Table {
            answer.course(Cow::Owned(self.course()?));
        }
        Ok(answer)
    }

    fn describe(&self, answer: &mut Answer) {
        let cycle = self.cycle;
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
            if share.abs() < DURATION_TOLERANCE {
                says += "the same";
            } else {
                let _ = write!(says, "{}", more_or_less(whole / before));
            }
        }
        answer.fact("duration", says);
        if !self.asked.is_empty() {
            answer.fact("requested", self.asked.join("; "));
        }
        if let Some(chain) = self.chain {
            for (name, says) in kept::lines(self.file, chain) {
                answer.fact(name, says);
            }
            if let Some(says) = kept::limits(self.file, Some(&self.asked)) {
                answer.fact("limits", says);
            }
        }
        for part in &self.cycle.kept {
            self.exceeded(part, answer);
        }
        self.motor(answer);
        if let Some(warmth) = self.warmth {
            self.winding(warmth, answer);
        }
        for force in self.forces {
            answer.fact("joint force", self.force(force));
        }
        if let Some(broken) = self.broken {
            let says = of_fastest(broken, &self.file.axis());
            answer.warning(says);
        }
        answer.fact("reserve", self.reserve());
        if let Some(judged) = self.judged {
            self.rules(judged, answer);
        }
        let worst = cycle.moves.iter().map(|made| made.fastest.excess);
        let error = cycle.moves.iter().map(|made| made.fastest.error);
        let error = error.sum::<f64>();
        let error = error.max(1e-12 * whole);
        let worst = worst.fold(LEAST_EXCESS, f64::max);
        let says = format!(
            "duration within {error:.0e} s; limits satisfied within {worst:.0e} between the nodes"
        );
        answer.fact("accuracy", says);
        let bounds = cycle.moves.iter().map(|made| made.fastest.bound);
        if let Some(bounds) = bounds.collect::<Option<Vec<f64>>>() {
            let least: f64 = bounds.iter().sum();
            let torque = self.words().torque;
            let binds = self.warmth.is_some_and(|warmth| warmth.bound.is_some());
            // A limit of the temperature is applied as a limit of the RMS torque.
            let (near, rms) = if binds {
                let near = format!(
                    "no nearby motion with the same RMS {torque} is faster; one with another distribution of losses over the cycle may be"
                );
                (near, format!(", RMS {torque} and winding temperature"))
            } else {
                (
                    "no nearby motion is faster".to_owned(),
                    format!(" and RMS {torque}"),
                )
            };
            let says = format!(
                "{near}; without limits of jerk, {torque} rate{rms} the moves take {} s, a lower bound",
                short(least)
            );
            answer.fact("optimum", says);
        }
        for (k, made) in cycle.moves.iter().enumerate() {
            self.one_move(k + 1, made, answer);
        }
    }

    /// Whether the motion turns endlessly without a rest.
    fn is_endless(&self) -> bool {
        let mut nodes = self.cycle.trace.nodes().iter();
        self.chain.is_some() && nodes.all(|node| node.omega != 0.0)
    }

    /// Whether this is a single move that ends in motion, and whether it begins or ends in motion; such a move is not repeated.
    fn passes(&self) -> [bool; 2] {
        let nodes = self.cycle.trace.nodes();
        let moves = |node: Option<&Node>| node.is_some_and(|node| node.omega != 0.0);
        let [begins, ends] = [moves(nodes.first()), moves(nodes.last())];
        [ends, begins || ends].map(|passes| passes && self.chain.is_none())
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

/// A ratio with three digits, or an integer with thousands separators.
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
