//! Segments that turn back without a key that requires it: their law goes beyond the end of the move and comes back, or first moves the other way.

use std::convert::Infallible;

use super::piece::{MotionPiece, PieceKind};
use super::{Motion, ToolCoordinate};
use crate::model::coordinate::Coordinate;
use crate::number::numerics;
use crate::number::rounding::short;

/// Parts of a polynomial at whose ends the direction is evaluated.
const PARTS: u32 = 256;

/// A speed below this share of the largest one of the segment counts as rest.
const REST: f64 = 1e-12;

/// An acceleration at rest counts from this share of the largest speed per duration.
const REST_ACCELERATION: f64 = 1e-9;

/// A segment of polynomials that turns back, although it neither starts nor ends against its move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overshoot {
    /// Its index, from 0.
    pub segment: usize,
    /// Whether it prescribes the drive link, not the tool.
    pub of_drive: bool,
    /// Its time (s).
    pub span: [f64; 2],
    /// Its distance (rad, or m) without sign.
    pub distance: f64,
    /// Travel beyond its start on the other side, and beyond its end.
    pub by: [f64; 2],
    /// Total backward travel.
    pub back: f64,
    /// Whether the acceleration at rest at its start is against the move, and at its end with it: that alone makes it turn back.
    pub pushed: [bool; 2],
}

impl Overshoot {
    /// Whether it is a blemish of the law: a larger backward travel than the move itself is an intended motion.
    pub fn is_of_law(&self) -> bool {
        self.back < self.distance
    }

    /// Description for a motion of a machine with this drive link.
    pub fn says(&self, motion: &Motion, drive: Coordinate) -> String {
        let tool = motion.tool().filter(|_| !self.of_drive);
        let coordinate = tool.map_or(drive, ToolCoordinate::coordinate);
        let length = |way: f64| format!("{} {}", short(coordinate.shown(way)), coordinate.unit());
        let [before, beyond] = self.by;
        let away = format!("first goes {} the other way", length(before));
        let past = format!("goes {} beyond its end and comes back", length(beyond));
        let what = match [before > 0.0, beyond > 0.0] {
            [true, true] => format!("{away} and later {past}"),
            [true, false] => away,
            [false, true] => past,
            [false, false] => format!("goes back by {} on the way", length(self.back)),
        };
        format!("segment {} {what}", self.segment + 1)
    }
}

impl Motion {
    /// The segments whose law turns back; recorded motions are excluded, because their turns were recorded.
    pub fn overshoots(&self) -> Vec<Overshoot> {
        let segments = self.pieces.chunk_by(|a, b| a.segment == b.segment);
        segments.filter_map(overshoot).collect()
    }
}

fn overshoot(pieces: &[MotionPiece]) -> Option<Overshoot> {
    let [first, last] = [pieces.first()?, pieces.last()?];
    let polynomial = |piece: &MotionPiece| matches!(piece.kind, PieceKind::Polynomial { .. });
    if !pieces.iter().all(polynomial) {
        return None;
    }
    let [start, end] = [first.at(0.0), last.at(last.duration)];
    let way = end.phi - start.phi;
    let direction = way.signum();
    let time = |piece: &MotionPiece, k: u32| piece.duration * f64::from(k) / f64::from(PARTS);
    let speeds =
        (pieces.iter()).flat_map(|piece| (0..=PARTS).map(move |k| piece.at(time(piece, k)).omega));
    let largest = speeds.fold(0.0_f64, |most, omega| most.max(omega.abs()));
    let rest = REST * largest;
    let against = |omega: f64| direction * omega < -rest;
    if way == 0.0 || against(start.omega) || against(end.omega) {
        return None;
    }
    // Positions where the direction changes, measured along the move.
    let mut turns = vec![0.0];
    let mut back_now = false;
    for piece in pieces {
        for k in 0..PARTS {
            let [from, to] = [k, k + 1].map(|k| time(piece, k));
            if against(piece.at(to).omega) == back_now {
                continue;
            }
            let before = |t: f64| Ok::<_, Infallible>(against(piece.at(t).omega) == back_now);
            let Ok(turn) = numerics::edge(before, from, to);
            turns.push(direction * (piece.at(turn).phi - start.phi));
            back_now = !back_now;
        }
    }
    let distance = way.abs();
    turns.push(distance);
    let back = (turns.windows(2)).map(|pair| (pair[0] - pair[1]).max(0.0));
    let back: f64 = back.sum();
    if back <= 0.0 {
        return None;
    }
    let least = turns.iter().fold(0.0_f64, |least, way| least.min(*way));
    let most = turns.iter().fold(distance, |most, way| most.max(*way));
    let span = [first.start, last.end()];
    let pushes = REST_ACCELERATION * largest / (span[1] - span[0]);
    let at_rest = |omega: f64| omega.abs() <= rest;
    Some(Overshoot {
        segment: first.segment,
        of_drive: first.of_drive,
        span,
        distance,
        by: [-least, most - distance],
        back,
        pushed: [
            at_rest(start.omega) && direction * start.alpha < -pushes,
            at_rest(end.omega) && direction * end.alpha > pushes,
        ],
    })
}
