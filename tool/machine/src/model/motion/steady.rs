//! Stretches of a motion at constant speed: where a machine does its work.

use super::Motion;
use super::piece::{Kind, Piece};

/// A stretch at constant speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady {
    /// Number of its segment, from 0 on.
    pub segment: usize,
    /// Its time (s).
    pub span: [f64; 2],
    /// The speed (rad/s, or m/s) of what is prescribed, with its sign.
    pub speed: f64,
    /// Whether the segment is nothing else: a constant speed that is prescribed, not one that a limit leaves.
    pub whole: bool,
}

impl Steady {
    /// How long it lasts (s).
    pub fn duration(&self) -> f64 {
        self.span[1] - self.span[0]
    }
}

impl Motion {
    /// The stretches of polynomials at constant speed, one after another.
    pub fn steady(&self) -> Vec<Steady> {
        let mut found = Vec::new();
        for pieces in self.pieces.chunk_by(|a, b| a.segment == b.segment) {
            let whole = pieces.iter().all(|piece| constant(piece).is_some());
            for piece in pieces {
                found.extend(constant(piece).map(|speed| Steady {
                    segment: piece.segment,
                    span: [piece.start, piece.end()],
                    speed,
                    whole,
                }));
            }
        }
        found
    }
}

/// The speed of a piece that has only one, not zero.
fn constant(piece: &Piece) -> Option<f64> {
    let Kind::Polynomial { course, .. } = &piece.kind else {
        return None;
    };
    let [start, end] = [0.0, piece.duration].map(|t| course.at(t));
    let bends = [start, end]
        .iter()
        .any(|[_, _, a, j]| *a != 0.0 || *j != 0.0);
    (start[1] != 0.0 && !bends).then_some(start[1])
}
