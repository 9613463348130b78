//! Stretches of a motion at constant speed, in which a machine does its work.

use super::Motion;
use super::piece::{MotionPiece, PieceKind};

/// A stretch at constant speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady {
    /// Index of its segment, from 0.
    pub segment: usize,
    /// Its time (s).
    pub span: [f64; 2],
    /// The speed (rad/s, or m/s) of the prescribed coordinate, with its sign.
    pub speed: f64,
    /// Whether the whole segment has constant speed because it is prescribed, not because of a limit.
    pub whole: bool,
}

impl Steady {
    /// Duration (s).
    pub fn duration(&self) -> f64 {
        self.span[1] - self.span[0]
    }
}

impl Motion {
    /// The stretches of polynomials at constant speed, in order.
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

/// The speed of a piece with constant nonzero speed.
fn constant(piece: &MotionPiece) -> Option<f64> {
    let PieceKind::Polynomial { course, .. } = &piece.kind else {
        return None;
    };
    let [start, end] = [0.0, piece.duration].map(|t| course.at(t));
    let bends = [start, end]
        .iter()
        .any(|[_, _, a, j]| *a != 0.0 || *j != 0.0);
    (start[1] != 0.0 && !bends).then_some(start[1])
}
