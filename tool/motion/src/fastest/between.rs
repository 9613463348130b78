//! Checks whether a motion satisfies its limits between its nodes.

use jred::machine::motion::State;
use jred_file::math;

use super::NoMotion;
use super::field::Field;
use super::sweep::SweepPiece;
use super::track::{Ends, Survey, Track};
use crate::trace::{Node, Trace};

/// Most parts of a cell in the next round.
const MOST_PARTS: f64 = 8.0;

/// Shares of the step between two nodes at which limits are checked.
pub(super) const BETWEEN_NODES: [f64; 3] = [0.21, 0.5, 0.79];

/// The same for a motion made by sweeps, with the nodes: there it leaves a speed limit by the interpolated values of the machine. Between these
/// shares an excess, with its slopes at the ends, is less than a third above the nearest checked value.
const BETWEEN_SWEPT_NODES: [f64; 7] = [0.0, 0.21, 0.35, 0.5, 0.65, 0.79, 1.0];

/// Parts of a cell. A motion is checked at their borders next to the shares above, because the machine is known there from the previous round.
const GRID: f64 = 1024.0;

/// A step that covers fewer parts of the grid is checked at its own positions.
const FEWEST_IN_STEP: f64 = 16.0;

/// Share of a cell within which two places count as one.
const PLACE_TOLERANCE: f64 = 1e-12;

/// Most Newton steps to a place.
const MOST_TRIALS: u32 = 6;

/// Share of the allowed excess that is used at the checked places.
const USED_EXCESS: f64 = 0.75;

/// Rounding errors of a speed, in units of the last place, by which the sweep may miss it.
const ROUNDINGS: f64 = 1e4;

/// The state at a share of a step. In a step so short that rounding of the speeds changes the acceleration, it interpolates the accelerations of the
/// nodes.
pub(super) fn within_step(a: &Node, b: &Node, share: f64) -> State<f64> {
    felt(a, b, share, ROUNDINGS)
}

/// The same with n rounding errors of the speeds.
fn felt(a: &Node, b: &Node, share: f64, roundings: f64) -> State<f64> {
    let state = b.after(a, share);
    let rounding = f64::EPSILON * (a.omega.abs() + b.omega.abs()) / b.step;
    let alpha = a.alpha[1] + share * (b.alpha[0] - a.alpha[1]);
    if (state.alpha - alpha).abs() <= roundings * rounding {
        return State { alpha, ..state };
    }
    state
}

/// Rounding errors of a speed within a sweep: of a step that was integrated, not cut where two curves meet.
const STEP_ROUNDINGS: f64 = 64.0;

/// Where the limits leave no acceleration on a motion.
pub(super) struct BlockedMotion {
    /// The first such place, as an error.
    pub(super) why: NoMotion,
    /// Distances at which cells must be split so that the machine is known better there.
    pub(super) places: Vec<f64>,
}

/// The share of a step near `near` at which a function vanishes, by Newton's method on [value, slope]; the end of the step if it vanishes beyond.
fn passes(near: f64, f: impl Fn(f64) -> [f64; 2]) -> f64 {
    let mut share = near;
    for _ in 0..MOST_TRIALS {
        let [value, slope] = f(share);
        if slope <= 0.0 {
            return near;
        }
        let next = (share - value / slope).clamp(0.0, 1.0);
        if (next - share).abs() <= f64::EPSILON {
            break;
        }
        share = next;
    }
    share
}

fn is_near(x: f64, other: f64, length: f64) -> bool {
    (x - other).abs() <= PLACE_TOLERANCE * length
}

/// Limits must leave an acceleration everywhere on the path: below the speeds where they do, the motion may have come from above.
///
/// At the largest speed that joint forces allow, one acceleration is left. Between the places of a cell it is known about as well as the forces,
/// whose own limits are checked at the end.
pub(super) fn check(
    field: &Field,
    ends: &Ends,
    track: &Track,
    pieces: &[SweepPiece],
) -> Result<(), Box<BlockedMotion>> {
    if !field.may_be_empty() {
        return Ok(());
    }
    let forces = field.limits.forces.is_some();
    let mut closed: Option<BlockedMotion> = None;
    for SweepPiece { cell, step, .. } in pieces {
        let cell = &track.cells[*cell];
        for end in [0, 1] {
            let (place, z) = (cell.spot(step.u[end]), step.z[end]);
            let [low, high] = [field.least_by(&place, z).0, field.most_by(&place, z).0];
            let rounding = 1e-9 * (low.abs() + high.abs());
            let known = if forces {
                1e-3 * (z / ends.length + low.abs() + high.abs())
            } else {
                rounding
            };
            if low <= high + known {
                continue;
            }
            let found = closed.get_or_insert_with(|| BlockedMotion {
                why: NoMotion::empty(field, &place, z),
                places: Vec::new(),
            });
            let middle = cell.x + 0.5 * cell.length;
            if found.places.last() != Some(&middle) {
                found.places.push(middle);
            }
        }
    }
    match closed {
        None => Ok(()),
        Some(closed) => Err(Box::new(closed)),
    }
}

/// The largest share by which a limit is exceeded between the nodes and its position, and the distances at which cells must be split to keep it
/// within `within`. The machine itself is evaluated at each place, and each step in its own time, however short.
pub(super) fn largest_excess(
    survey: &Survey,
    ends: &Ends,
    track: &Track,
    pieces: &[SweepPiece],
    trace: &Trace,
    within: f64,
) -> Result<((f64, f64), Vec<f64>), NoMotion> {
    let field = survey.field;
    let direction = field.dynamics.direction;
    let mut largest = (0.0_f64, ends.from);
    let mut places = Vec::new();
    if within.is_infinite() {
        return Ok((largest, places));
    }
    for (pair, piece) in trace.nodes().windows(2).zip(pieces) {
        let [a, b] = [&pair[0], &pair[1]];
        let cell = &track.cells[piece.cell];
        // A place at a corner has the values of its own side.
        let inside = ends.inside(cell.length);
        let within_cell = |x: f64| x.clamp(cell.x + inside, cell.x + cell.length - inside);
        let distance = |state: &State<f64>| (state.phi - ends.from) * direction;
        // The excess, and the part of it that finer cells can reduce.
        let (mut most, mut curable) = (0.0_f64, 0.0_f64);
        let passed = (b.phi - a.phi) * direction;
        let has_grid = passed * GRID > FEWEST_IN_STEP * cell.length;
        for mut share in BETWEEN_SWEPT_NODES {
            let mut x = distance(&b.after(a, share));
            if has_grid {
                let grid = ((x - cell.x) / cell.length * GRID).round() / GRID;
                let on_grid = within_cell(cell.x + grid * cell.length);
                // The share of the step at which it passes that position; the end of the step if it does not reach it.
                share = passes(share, |share| {
                    let state = b.after(a, share);
                    [distance(&state) - on_grid, state.omega * direction * b.step]
                });
                x = distance(&b.after(a, share));
                if is_near(x, on_grid, cell.length) {
                    x = on_grid;
                }
            }
            let state = b.after(a, share);
            let seen = survey.seen(within_cell(x))?;
            let excess = |alpha: f64| {
                let (v, alpha) = (state.omega * direction, alpha * direction);
                field.excess_by(&seen, v, alpha).0
            };
            let own = excess(state.alpha);
            most = most.max(own);
            if own > USED_EXCESS * within {
                curable = curable.max(excess(felt(a, b, share, STEP_ROUNDINGS).alpha));
            }
        }
        if most > largest.0 {
            largest = (most, a.phi);
        }
        if curable > USED_EXCESS * within {
            // The error falls with the third power of the step.
            let parts = math::cbrt(curable / (USED_EXCESS * within))
                .ceil()
                .clamp(2.0, MOST_PARTS) as usize;
            let [from, to] = [a, b].map(|node| (node.phi - ends.from) * direction);
            let place = |k: usize| from + (to - from) * k as f64 / parts as f64;
            places.extend((1..parts).map(place));
        }
    }
    Ok((largest, places))
}
