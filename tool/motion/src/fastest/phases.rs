//! The active limit of each part of a motion.

use std::convert::Infallible;

use jred_file::number::numerics::edge;

use super::field::{Binding, Field, speed};
use super::sweep::{SweepCurve, SweepPiece};
use super::track::{Ends, Track};

/// A part of the motion that follows one limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// The limit.
    pub limit: Binding,
    /// Positions of its start and end (rad, or m).
    pub phi: [f64; 2],
    /// Times of its start and end (s).
    pub t: [f64; 2],
    /// Speeds along the path (rad/s, or m/s).
    pub speed: [f64; 2],
}

/// Share of the total time below which a phase between two phases of one limit is dropped.
const SHORTEST_PHASE: f64 = 1e-6;

/// Share of z within which a motion is at a limit of its speed.
const LIMIT_TOLERANCE: f64 = 1e-6;

/// Whether z is at the tool's speed limit.
fn tool_limits(field: &Field, phi: f64, z: f64) -> bool {
    let tool = field.tool_speed(phi).unwrap_or(f64::INFINITY);
    z >= 0.5 * tool.powi(2) * (1.0 - LIMIT_TOLERANCE)
}

/// The phases of a motion.
pub(super) fn phases(
    field: &Field,
    ends: &Ends,
    track: &Track,
    pieces: &[SweepPiece],
    times: &[f64],
) -> Vec<Phase> {
    let mut phases: Vec<Phase> = Vec::new();
    let mut t = 0.0;
    let (_, top) = field.top();
    for (piece, time) in pieces.iter().zip(times) {
        let cell = &track.cells[piece.cell];
        let step = &piece.step;
        let width = step.u[1] - step.u[0];
        let z = |s: f64| step.hermite(s, width * cell.length);
        let binding = |s: f64| {
            let place = cell.spot(step.u[0] + s * width);
            match piece.along {
                SweepCurve::Side(side) => field.side_by(side, &place, z(s)).1,
                SweepCurve::Cap if tool_limits(field, place.phi, z(s)) => Binding::ToolSpeed,
                SweepCurve::Cap if cell.caps[1] < 0.5 * field.top().0.powi(2) => {
                    field.most_by(&place, z(s)).1
                }
                SweepCurve::Cap => top,
            }
        };
        // Inside the step, because two limits may be equal at its ends.
        let [first, last] = [binding(0.01), binding(0.99)];
        let mut add = |limit: Binding, from: f64, to: f64| {
            let phi = |s: f64| {
                let x = cell.x + (step.u[0] + s * width) * cell.length;
                ends.from + field.dynamics.direction * x
            };
            let end = (phi(to), t + to * time, speed(z(to)));
            if let Some(phase) = phases.last_mut().filter(|phase| phase.limit == limit) {
                (phase.phi[1], phase.t[1], phase.speed[1]) = end;
                return;
            }
            phases.push(Phase {
                limit,
                phi: [phi(from), end.0],
                t: [t + from * time, end.1],
                speed: [speed(z(from)), end.2],
            });
        };
        if first == last {
            add(first, 0.0, 1.0);
        } else {
            let Ok(change) = edge(|s| Ok::<_, Infallible>(binding(s) == first), 0.0, 1.0);
            add(first, 0.0, change);
            add(last, change, 1.0);
        }
        t += time;
    }
    without_blinks(phases, t)
}

/// Drops phases that are only rounding, as at a corner where the limits of the two sides differ in the last digits.
fn without_blinks(phases: Vec<Phase>, whole: f64) -> Vec<Phase> {
    let mut kept: Vec<Phase> = Vec::with_capacity(phases.len());
    for mut phase in phases {
        if let [.., before, blink] = kept.as_mut_slice()
            && blink.t[1] - blink.t[0] <= SHORTEST_PHASE * whole
        {
            if before.limit == phase.limit {
                (before.phi[1], before.t[1], before.speed[1]) =
                    (phase.phi[1], phase.t[1], phase.speed[1]);
                kept.pop();
                continue;
            }
            // At a dead centre the force in a joint changes from one side of its interval to the other.
            if matches!(phase.limit, Binding::JointForce(_)) {
                (phase.phi[0], phase.t[0], phase.speed[0]) =
                    (blink.phi[0], blink.t[0], blink.speed[0]);
                kept.pop();
            }
        }
        kept.push(phase);
    }
    kept
}
