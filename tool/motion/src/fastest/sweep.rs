//! The two sweeps: backwards for the speeds from which the end can still be met, forwards for the fastest motion below them.
//!
//! With z = ½·v² a motion is a curve z(x) whose slope is its acceleration, between the least and the largest value that the limits allow. Two curves
//! of one field do not cross. A motion that satisfies the limits and meets the end therefore stays below
//!
//! - *upper*: the speed limit; where that falls faster than the motor can brake, or at the end of the path, the curve of least acceleration that
//!   leads there, followed backwards;
//! - the curve of largest acceleration from the start.
//!
//! The lower of both is itself such a motion, so it is the fastest. If it comes to rest on the path, every other motion does, too.

mod upper_curve;

use std::convert::Infallible;

use jred_file::number::numerics::zero;

use super::field::Field;
use super::leg::{Leg, MOST_STEPS, PhasePoint, Stall, Step};
use super::track::{PathCell, Track};
use upper_curve::UpperCurve;

/// Relative difference of z below which two curves coincide.
const CURVE_TOLERANCE: f64 = 1e-12;

/// Accuracy of a crossing as a share of its place.
const CROSSING_TOLERANCE: f64 = 1e-15;

/// Most changes of the state within a cell. More are rounding where two curves touch; then the motion stays on the upper curve.
const MOST_CHANGES: u32 = 16;

/// An end of the interval of accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The largest acceleration.
    Most,
    /// The least acceleration.
    Least,
}

/// The curve that a piece of the motion follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepCurve {
    /// The largest or the least acceleration.
    Side(Side),
    /// The speed limit.
    Cap,
}

/// A step of a curve in a cell.
#[derive(Clone, Copy, Debug)]
pub struct SweepPiece {
    /// Index of the cell.
    pub cell: usize,
    /// The step.
    pub step: Step,
    /// The curve that it follows.
    pub along: SweepCurve,
}

/// Where the motion is blocked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// Even the largest acceleration comes to rest at this share of a cell.
    Stops(usize, f64),
    /// Even the least acceleration is too large here to meet the end, or the speed limit.
    RunsAway(usize, f64),
    /// From here on the machine follows its friction so closely that too many steps are needed.
    Stiff(usize, f64),
    /// The speed at the start is larger than this z.
    StartTooFast(f64),
    /// At the end z is at most this.
    EndTooFast(f64),
}

/// The fastest motion between two values of z.
///
/// # Errors
/// No motion exists: the obstacle.
pub fn fastest(
    field: &Field<'_, '_>,
    track: &Track,
    ends: [f64; 2],
) -> Result<Vec<SweepPiece>, Obstacle> {
    let upper = upper(field, track, ends[1])?;
    let first = upper.last().map_or(0.0, |piece| piece.step.z[0]);
    if ends[0] > first * (1.0 + CURVE_TOLERANCE) {
        return Err(Obstacle::StartTooFast(first));
    }
    forwards(field, track, &upper, ends)
}

/// The time (s) of each piece.
pub fn times(track: &Track, pieces: &[SweepPiece]) -> Vec<f64> {
    let time = |piece: &SweepPiece| piece.step.time(track.cells[piece.cell].length);
    pieces.iter().map(time).collect()
}

fn zero_of(f: impl Fn(f64) -> f64, between: [f64; 2], values: [f64; 2]) -> f64 {
    let sure = |u: f64| Ok::<_, Infallible>(f(u));
    let Ok(u) = zero(sure, between, values, CROSSING_TOLERANCE);
    u
}

/// Largest ratio by which the limit of z may change in one piece along it.
const MOST_RATIO: f64 = 1.5;

/// The pieces along the speed limit from one share of a cell to a larger one. Between their ends z is a cubic, which would fall below zero if the
/// limit grew many times in one piece.
fn along_cap(cell: &PathCell, index: usize, [from, to]: [f64; 2], pieces: &mut Vec<SweepPiece>) {
    let u = [from, to];
    let z = u.map(|u| cell.cap(u));
    let middle = from.midpoint(to);
    let is_steep = z[0].max(z[1]) > MOST_RATIO * z[0].min(z[1]);
    if is_steep && from < middle && middle < to {
        along_cap(cell, index, [from, middle], pieces);
        along_cap(cell, index, [middle, to], pieces);
        return;
    }
    pieces.push(SweepPiece {
        cell: index,
        step: Step {
            u,
            z,
            a: u.map(|u| cell.cap_slope(u)),
            time: None,
        },
        along: SweepCurve::Cap,
    });
}

/// Where `f` becomes positive between `from` and `to`: at the start, inside, or not at all.
fn first_positive(f: impl Fn(f64) -> f64, from: f64, to: f64) -> Option<f64> {
    let mut last = (from, f(from));
    if last.1 > 0.0 {
        return Some(from);
    }
    for u in [from.midpoint(to), to] {
        let value = f(u);
        if value > 0.0 {
            return Some(zero_of(&f, [last.0, u], [last.1, value]));
        }
        last = (u, value);
    }
    None
}

/// The largest speeds from which limits and the end can be met: pieces from the end to the start.
fn upper(field: &Field, track: &Track, end: f64) -> Result<Vec<SweepPiece>, Obstacle> {
    let mut pieces = Vec::with_capacity(track.cells.len() + 64);
    let mut steps = Vec::new();
    let mut z = end;
    let mut border: Option<PhasePoint> = None;
    for (index, cell) in track.cells.iter().enumerate().rev() {
        let leg = Leg {
            field,
            side: Side::Least,
            cell,
        };
        let mut u = 1.0;
        let mut on_cap = z >= cell.caps[2];
        if on_cap {
            z = cell.caps[2];
        }
        let mut start = border.take().filter(|_| !on_cap);
        let mut changes = 0;
        while u > 0.0 {
            changes += 1;
            if on_cap {
                let falls = |u: f64| leg.at(u, cell.cap(u)) - cell.cap_slope(u);
                let to = if changes > MOST_CHANGES {
                    0.0
                } else {
                    first_positive(falls, u, 0.0).unwrap_or(0.0)
                };
                if to < u {
                    let first = pieces.len();
                    along_cap(cell, index, [to, u], &mut pieces);
                    pieces[first..].reverse();
                }
                (u, z, on_cap) = (to, cell.cap(to), false);
                continue;
            }
            steps.clear();
            let from = start.take().unwrap_or_else(|| leg.point(u, z));
            let reached = leg.go(from, 0.0, &mut steps);
            if let Some((k, crossing)) = above_cap(cell, &leg, &steps) {
                push_up_to(&mut pieces, index, &leg, &steps[..=k], 1, crossing);
                (u, z, on_cap) = (crossing, cell.cap(crossing), true);
                continue;
            }
            let point = reached.map_err(|why| match why {
                Stall::AtRest(at) => Obstacle::RunsAway(index, at),
                Stall::Stiff(at) => Obstacle::Stiff(index, at),
            })?;
            push(&mut pieces, index, steps.drain(..), leg.side);
            if pieces.len() > MOST_STEPS {
                return Err(Obstacle::Stiff(index, 0.0));
            }
            (u, z) = (0.0, point.z);
            border = Some(PhasePoint { u: 1.0, ..point }).filter(|_| cell.goes_on);
        }
    }
    Ok(pieces)
}

fn push(pieces: &mut Vec<SweepPiece>, cell: usize, steps: impl Iterator<Item = Step>, side: Side) {
    let along = SweepCurve::Side(side);
    pieces.extend(steps.map(|step| SweepPiece { cell, step, along }));
}

/// Adds the steps of a leg, of which the last only up to a crossing; `start` is the end at which it begins.
fn push_up_to(
    pieces: &mut Vec<SweepPiece>,
    cell: usize,
    leg: &Leg,
    steps: &[Step],
    start: usize,
    crossing: f64,
) {
    let Some((last, whole)) = steps.split_last() else {
        return;
    };
    push(pieces, cell, whole.iter().copied(), leg.side);
    let from = leg.point(last.u[start], last.z[start]);
    let mut part = Vec::new();
    if (crossing - from.u).abs() > 0.0 && leg.go(from, crossing, &mut part).is_ok() {
        push(pieces, cell, part.into_iter(), leg.side);
    }
}

/// The first step (backwards) that rises above the speed limit, and where it does.
fn above_cap(cell: &PathCell, leg: &Leg, steps: &[Step]) -> Option<(usize, f64)> {
    let is_above = |u: f64, z: f64| z > cell.cap(u) * (1.0 + CURVE_TOLERANCE);
    let k = steps
        .iter()
        .position(|step| is_above(step.u[0], step.z[0]))?;
    let step = steps[k];
    let right = leg.point(step.u[1], step.z[1]);
    let above = |u: f64| follow(leg, right, u) - cell.cap(u);
    let ends = [step.u[1], step.u[0]];
    let values = [
        step.z[1] - cell.cap(step.u[1]),
        step.z[0] - cell.cap(step.u[0]),
    ];
    if values[0] >= 0.0 {
        return Some((k, step.u[1]));
    }
    Some((k, zero_of(above, ends, values)))
}

/// z of the curve through a point at another share of the cell.
fn follow(leg: &Leg, from: PhasePoint, to: f64) -> f64 {
    if (to - from.u).abs() <= 0.0 {
        return from.z;
    }
    let mut steps = Vec::new();
    leg.go(from, to, &mut steps).map_or(0.0, |point| point.z)
}

/// The fastest motion below `upper`.
fn forwards(
    field: &Field,
    track: &Track,
    upper: &[SweepPiece],
    ends: [f64; 2],
) -> Result<Vec<SweepPiece>, Obstacle> {
    let mut pieces = Vec::with_capacity(upper.len() + 64);
    let mut rest = upper;
    let mut z = ends[0];
    let mut steps = Vec::new();
    let mut border: Option<PhasePoint> = None;
    for (index, cell) in track.cells.iter().enumerate() {
        let count = rest
            .iter()
            .rev()
            .take_while(|piece| piece.cell == index)
            .count();
        let (before, own) = rest.split_at(rest.len() - count);
        rest = before;
        let above = UpperCurve { field, cell, own };
        let leg = Leg {
            field,
            side: Side::Most,
            cell,
        };
        let mut u = 0.0;
        let mut on_upper = z >= above.z(0.0) * (1.0 - CURVE_TOLERANCE);
        let mut start = border.take().filter(|_| !on_upper);
        let mut changes = 0;
        while u < 1.0 {
            changes += 1;
            if on_upper {
                let (to, stays) = above.along(u, &leg, changes <= MOST_CHANGES, index, &mut pieces);
                (u, z, on_upper) = (to, above.z(to), stays);
                continue;
            }
            steps.clear();
            let from = start.take().unwrap_or_else(|| leg.point(u, z));
            let reached = leg.go(from, 1.0, &mut steps);
            if let Some((k, crossing)) = above.crossed(&leg, &steps) {
                push_up_to(&mut pieces, index, &leg, &steps[..=k], 0, crossing);
                (u, on_upper) = (crossing, true);
                continue;
            }
            let point = reached.map_err(|why| match why {
                Stall::AtRest(at) => Obstacle::Stops(index, at),
                Stall::Stiff(at) => Obstacle::Stiff(index, at),
            })?;
            push(&mut pieces, index, steps.drain(..), leg.side);
            if pieces.len() > MOST_STEPS {
                return Err(Obstacle::Stiff(index, 1.0));
            }
            (u, z) = (1.0, point.z);
            let next = track.cells.get(index + 1);
            border = next
                .filter(|next| next.goes_on)
                .map(|_| PhasePoint { u: 0.0, ..point });
        }
    }
    // A speed slightly below that of the end is rounding; otherwise the path is too short to reach it.
    if z < ends[1] * (1.0 - 1e-9) {
        return Err(Obstacle::EndTooFast(z));
    }
    Ok(pieces)
}
