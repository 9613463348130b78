//! The smooth stretches of a motion: cut where its law bends, where the drive link passes an edge of a load or a cam, and where a load
//! begins or ends in time or with the direction of travel, or a payload is picked up or set down.

use jred::{Domain, Reducible as _};

use super::{INSIDE, Sampling};
use crate::model::machine::MachineFile;
use crate::model::motion::Motion;
use crate::model::schedule::Now;

/// On which side of an edge the drive link is at φ; on a turn, after how many of its passages.
fn side(file: &MachineFile, phi: f64, edge: f64) -> i64 {
    let beyond = phi - edge;
    if file.machine.domain() == Domain::Turn {
        (beyond / std::f64::consts::TAU).floor() as i64
    } else {
        i64::from(beyond >= 0.0)
    }
}

/// Positions at which a load begins or ends, or a cam's segments meet.
fn edges(file: &MachineFile) -> Vec<f64> {
    (0..).map_while(|k| file.machine.edge(k)).collect()
}

/// How often the drive link passes an edge, at least: there and back within a piece of the motion is not counted.
pub(crate) fn passages(file: &MachineFile, motion: &Motion) -> u64 {
    let edges = edges(file);
    let sides = |t: f64| {
        let phi = motion.at(t).phi;
        edges.iter().map(move |&edge| side(file, phi, edge))
    };
    let passed = motion.stretches().into_iter().flat_map(|(from, to)| {
        let sides = sides(from).zip(sides(to));
        sides.map(|(from, to)| from.abs_diff(to))
    });
    passed.fold(0, u64::saturating_add)
}

/// Adds the times at which the side of an edge changes, by bisection; between them a step may hold any number of turns. `from` and
/// `to` are times with their sides.
fn crossings(
    side: &impl Fn(f64) -> i64,
    [from, to]: [(f64, i64); 2],
    least: f64,
    cuts: &mut Vec<f64>,
) {
    if from.1 == to.1 {
        return;
    }
    let middle = 0.5 * (from.0 + to.0);
    if to.0 - from.0 <= least || middle <= from.0 || middle >= to.0 {
        cuts.push(to.0);
        return;
    }
    let middle = (middle, side(middle));
    crossings(side, [from, middle], least, cuts);
    crossings(side, [middle, to], least, cuts);
}

/// The stretches of the motion, also cut where the drive link passes an edge of a load's window, so that a short load has
/// its own instants, and where the machine changes by its schedule.
pub(crate) fn smooth_stretches(
    file: &MachineFile,
    motion: &Motion,
    steps: usize,
) -> Vec<(f64, f64)> {
    let edges = edges(file);
    let least = 1e-13 * motion.duration();
    let mut stretches = Vec::new();
    for (from, to) in motion.stretches() {
        if edges.is_empty() && file.schedule.is_empty() {
            stretches.push((from, to));
            continue;
        }
        let n = ((steps as f64 * (to - from) / motion.duration()).ceil() as usize).max(16);
        let mut cuts = file.schedule.times();
        let machine_at = |t: f64| {
            // At its end a stretch still belongs to itself.
            let inside = t.clamp(from, (to - least).max(from));
            file.schedule
                .number(&Now::of(inside, motion.at(inside).omega)) as i64
        };
        let place = |k: usize| {
            let t = from + (to - from) * k as f64 / n as f64;
            (t, motion.at(t).phi)
        };
        let mut start = place(0);
        for k in 1..=n {
            let end = place(k);
            for &edge in &edges {
                let step = [start, end].map(|(t, phi)| (t, side(file, phi, edge)));
                let at = |t: f64| side(file, motion.at(t).phi, edge);
                crossings(&at, step, least, &mut cuts);
            }
            let step = [start.0, end.0].map(|t| (t, machine_at(t)));
            crossings(&machine_at, step, least, &mut cuts);
            start = end;
        }
        cuts.sort_by(f64::total_cmp);
        let shortest = 1e-9 * motion.duration();
        let mut start = from;
        for cut in cuts {
            if cut - start > shortest && to - cut > shortest {
                stretches.push((start, cut));
                start = cut;
            }
        }
        stretches.push((start, to));
    }
    stretches
}

/// Fewest steps of a smooth stretch; of a part of one, which is short, two.
const FEWEST: f64 = 16.0;

/// Share of what a peak of the torque may be missed by, by which the acceleration of a part may differ from a parabola.
const OF_MISSED: f64 = 0.1;

/// Most of a part's share by which its ends are taken from inside.
const MOST_INSIDE: f64 = 1e-3;

/// A part of the motion with equal steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Its ends (s).
    pub(super) from: f64,
    pub(super) to: f64,
    /// An even number.
    pub(super) steps: usize,
    /// Share of it by which its ends are taken from inside: that of its stretch, as in less time there is no speed but a rounding.
    pub(super) inside: f64,
}

/// The parts of the motion, one after another: its smooth stretches, and those of a profile of states cut at the rows where its acceleration
/// bends. A parabola through three instants around a corner is higher than the corner, by more the longer the steps.
pub(super) fn parts(file: &MachineFile, motion: &Motion, sampling: Sampling) -> Vec<Part> {
    let Sampling { steps, missed } = sampling;
    let stretches = smooth_stretches(file, motion, steps);
    let cuts = motion.cut_at_bends(&stretches, OF_MISSED * missed);
    let mut parts = Vec::with_capacity(stretches.len());
    for ((from, to), cuts) in stretches.into_iter().zip(cuts) {
        let pairs = (steps as f64 * (to - from) / motion.duration() / 2.0).max(FEWEST / 2.0);
        for ends in cuts.windows(2) {
            let share = (ends[1] - ends[0]) / (to - from);
            let pairs = (pairs * share).ceil().max(1.0);
            parts.push(Part {
                from: ends[0],
                to: ends[1],
                steps: 2 * pairs as usize,
                inside: (INSIDE / share).min(MOST_INSIDE),
            });
        }
    }
    parts
}
