//! A move: its phases, each at one limit, and the cost of each limit.

use std::fmt::Write as _;

use crate::table::reading::Reading;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{percent, short, shown, told_apart};
use jred_motion::fastest::cycle::{Cost, FastestMove, MORE};
use jred_motion::fastest::{Binding, Phase};
use jred_sizing::cell::Cell;
use jred_sizing::select::fit::input_kind;

use super::FastestView;
use crate::answer::Answer;

/// Share of the largest speed below which a speed is a rounding error: speeds are roots of energies.
const REST_SPEED: f64 = 1e-8;

/// Relative drop of the speed within a phase from which it is shown.
const DIP: f64 = 5e-4;

/// Phases shorter than this share of the move's time are dropped.
const LEAST_PHASE: f64 = 1e-9;

impl FastestView<'_> {
    pub(super) fn one_move(&self, number: usize, made: &FastestMove, answer: &mut Answer) {
        let axis = self.file.axis();
        let unit = axis.coordinate.unit();
        let ends = [made.task.from, made.task.to].map(|phi| axis.shown(phi).abs());
        let farthest = ends[0].max(ends[1]);
        let position = |phi: f64| shown(axis.shown(phi), farthest);
        let ends = [made.task.from, made.task.to];
        let [mut from, mut to] = ends.map(position);
        if from == to {
            [from, to] = told_apart(ends.map(|phi| axis.shown(phi)));
        }
        let mut text = format!(
            "move {number}: {from} {unit} to {to} {unit} in {} s",
            short(made.fastest.time)
        );
        if let Some(before) = made.before {
            let _ = write!(text, " ({} s in the file)", short(before));
        }
        answer.heading(text);
        // Where a turn closes, a phase may have no duration.
        let least = LEAST_PHASE * made.fastest.time;
        let phases = made.fastest.phases.iter();
        let phases: Vec<&Phase> = phases
            .filter(|phase| phase.t[1] - phase.t[0] > least)
            .collect();
        let dips = phases.iter().any(|phase| dip(made, phase).is_some());
        let mut columns = vec![
            "at its limit".to_owned(),
            format!("from {} [{unit}]", axis.symbol()),
            "to".to_owned(),
            "from t [s]".to_owned(),
            "to".to_owned(),
            format!("speed from [{}]", axis.coordinate.speed_unit()),
            "to".to_owned(),
            "greatest".to_owned(),
        ];
        columns.extend(dips.then(|| "least".to_owned()));
        let speeds = made.fastest.phases.iter().flat_map(|phase| phase.speed);
        let fastest = axis.rate(speeds.fold(0.0, f64::max));
        let file = self.file;
        let row = |phase: &Phase| -> Vec<Cell> {
            let mut cells = vec![Cell::from(&*phase.limit.name_in(file))];
            let positions = phase.phi.map(&position);
            let times = phase.t.map(|t| shown(t, made.fastest.time));
            let [from, to] = phase.speed;
            let speed = |v: f64| {
                let speed = axis.rate(v);
                short(if speed <= REST_SPEED * fastest {
                    0.0
                } else {
                    speed
                })
            };
            let speeds = [from, to, greatest(made, phase)].map(speed);
            let texts = positions.into_iter().chain(times).chain(speeds);
            cells.extend(texts.map(|text| Cell::from(text.as_str())));
            if dips {
                let least = dip(made, phase).map_or_else(String::new, speed);
                cells.push(Cell::from(least.as_str()));
            }
            cells
        };
        let rows: Vec<Vec<Cell>> = phases.iter().map(|phase| row(phase)).collect();
        let whole = columns.len();
        answer.table(Reading::new(columns, rows, whole));
        unlimited(made, &phases, answer);
        for cost in &made.costs {
            let saved = made.fastest.time - cost.time;
            // Limits of the whole motion, whose own duration is printed above.
            let alone = match cost.limit {
                Binding::RmsTorque | Binding::WindingTemperature => "this move alone takes ",
                _ => "",
            };
            answer.sentence(format!(
                "{}: {alone}{} s, {} s less",
                eased(cost, file),
                short(cost.time),
                short(saved.max(0.0))
            ));
        }
    }
}

/// The change of the limit: removed, or raised for those of the motor.
pub(super) fn eased(cost: &Cost, file: &MachineFile) -> String {
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
pub(super) fn greatest(made: &FastestMove, phase: &Phase) -> f64 {
    let [from, to] = phase.t;
    let nodes = made.fastest.trace.nodes().iter();
    let inside = nodes.filter(|node| node.t > from && node.t < to);
    let speeds = inside.map(|node| node.omega.abs());
    phase.speed.into_iter().chain(speeds).fold(0.0, f64::max)
}

/// The least speed (rad/s, or m/s) in a phase, where it is lower than at both ends.
fn dip(made: &FastestMove, phase: &Phase) -> Option<f64> {
    let [from, to] = phase.t;
    let nodes = made.fastest.trace.nodes().iter();
    let inside = nodes.filter(|node| node.t > from && node.t < to);
    let least = inside
        .map(|node| node.omega.abs())
        .fold(f64::INFINITY, f64::min);
    let ends = phase.speed[0].min(phase.speed[1]);
    (least < ends * (1.0 - DIP)).then_some(least)
}

/// Reports the times before the first and after the last phase, in which no limit is active.
fn unlimited(made: &FastestMove, phases: &[&Phase], answer: &mut Answer) {
    let whole = made.fastest.time;
    for (time, place) in [
        (phases.first().map_or(0.0, |phase| phase.t[0]), "first"),
        (
            phases.last().map_or(0.0, |phase| whole - phase.t[1]),
            "last",
        ),
    ] {
        if time > LEAST_PHASE * whole {
            answer.sentence(format!("in the {place} {} s no limit is met", short(time)));
        }
    }
}
