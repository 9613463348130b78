//! One smooth piece of a motion.

use jred::machine::motion::{Move, Polynomial, State};

use super::nodes::{Node, NodeCurve, step_at};
use crate::number::spline::Spline;

#[derive(Clone, Debug)]
pub(super) struct MotionPiece {
    /// Index of its segment.
    pub(super) segment: usize,
    /// Whether it prescribes the drive link although the motion is of the tool.
    pub(super) of_drive: bool,
    pub(super) start: f64,
    pub(super) duration: f64,
    pub(super) kind: PieceKind,
}

#[derive(Clone, Debug)]
pub(super) enum PieceKind {
    Polynomial {
        start: f64,
        course: Polynomial,
    },
    Move(Move<f64>),
    /// φ is the sum of the curve and a steady advance.
    Positions {
        curve: Spline,
        /// rad/s
        advance: f64,
        /// Speed (rad/s) below which it is at rest.
        standstill: f64,
    },
    /// ω is the sum of the curve and a constant; φ its integral.
    Speeds {
        curve: Spline,
        start: f64,
        /// rad/s
        advance: f64,
        standstill: f64,
    },
    /// At least two, at the times of the motion.
    Nodes {
        nodes: Vec<Node>,
        curve: NodeCurve,
    },
}

impl MotionPiece {
    pub(super) fn end(&self) -> f64 {
        self.start + self.duration
    }

    /// Whether it is a curve through recorded rows.
    pub(super) const fn is_recorded(&self) -> bool {
        matches!(
            self.kind,
            PieceKind::Positions { .. } | PieceKind::Speeds { .. } | PieceKind::Nodes { .. }
        )
    }

    /// Adds the times of the motion's rows strictly between two times.
    pub(super) fn rows_between(&self, [from, to]: [f64; 2], rows: &mut Vec<f64>) {
        match &self.kind {
            PieceKind::Polynomial { .. } | PieceKind::Move(_) => {}
            PieceKind::Positions { curve, .. } | PieceKind::Speeds { curve, .. } => {
                let within = [from - self.start, to - self.start];
                rows.extend(curve.knots_between(within).map(|knot| self.start + knot));
            }
            PieceKind::Nodes { nodes, .. } => {
                let first = nodes.partition_point(|node| node.t <= from);
                let after = nodes.iter().skip(first).map(|node| node.t);
                rows.extend(after.take_while(|t| *t < to));
            }
        }
    }

    /// The third derivative at `t` (s) after its start; `None` if the acceleration jumps within the piece or at its ends.
    pub(super) fn jerk(&self, t: f64) -> Option<f64> {
        match &self.kind {
            PieceKind::Polynomial { course, .. } => Some(course.at(t)[3]),
            PieceKind::Move(step) => {
                step.law().characteristic().jerk?;
                let duration = step.duration();
                Some(step.distance() / duration.powi(3) * step.law().jerk(t / duration))
            }
            PieceKind::Positions { curve, .. } => Some(curve.at(t)[3]),
            PieceKind::Speeds { curve, .. } => Some(curve.at(t)[2]),
            PieceKind::Nodes { nodes, curve } => {
                let ([before, after], share) = step_at(nodes, self.start + t)?;
                Some(after.jerk_at_share(before, share, *curve))
            }
        }
    }

    /// The prescribed state at `t` (s) after its start, clamped to it.
    pub(super) fn at(&self, t: f64) -> State<f64> {
        let t = t.clamp(0.0, self.duration);
        match &self.kind {
            PieceKind::Polynomial { start, course } => {
                let [way, omega, alpha, _] = course.at(t);
                State {
                    phi: start + way,
                    omega,
                    alpha,
                }
            }
            PieceKind::Move(step) => step.at(t),
            PieceKind::Positions {
                curve,
                advance,
                standstill,
            } => {
                // The end of a period is its start, a cycle later.
                let [value, d1, d2, _] = curve.at(t);
                State {
                    phi: value + advance * t,
                    omega: moving(d1 + advance, *standstill),
                    alpha: d2,
                }
            }
            PieceKind::Speeds {
                curve,
                start,
                advance,
                standstill,
            } => {
                let [speed, alpha, ..] = curve.at(t);
                State {
                    phi: start + curve.integral(t) + advance * t,
                    omega: moving(speed + advance, *standstill),
                    alpha,
                }
            }
            PieceKind::Nodes { nodes, curve } => step_at(nodes, self.start + t)
                .map_or(State::default(), |([before, after], share)| {
                    after.at_share(before, share, *curve)
                }),
        }
    }
}

/// A speed, or zero below `standstill`.
fn moving(speed: f64, standstill: f64) -> f64 {
    if speed.abs() > standstill { speed } else { 0.0 }
}
