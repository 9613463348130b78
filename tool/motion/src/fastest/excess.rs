//! By how much a motion exceeds its limits between its nodes, with the machine itself.

use jred::machine::motion::State;

use super::NoMotion;
use super::field::Field;
use super::sweep::Piece;
use super::track::{Ends, Track};
use crate::trace::{Node, Trace};

/// Most parts of a cell in the next round.
const MOST_PARTS: f64 = 8.0;

/// Share of what a limit may be exceeded by that rounding may make of it.
pub(super) const ROUNDED: f64 = 1e-3;

/// Places between two nodes at which that is looked at.
pub(super) const LOOKS: [f64; 3] = [0.21, 0.5, 0.79];

/// The state at a share of a step that must be right within a share of itself. Of a step so short that rounding of the speeds makes another
/// acceleration, that of the nodes counts.
pub(super) fn within_step(a: &Node, b: &Node, share: f64, within: f64) -> State<f64> {
    let state = b.after(a, share);
    let rounding = f64::EPSILON * (a.omega.abs() + b.omega.abs()) / b.step;
    if rounding > ROUNDED * within.min(1.0) * (a.alpha[1].abs() + b.alpha[0].abs()) {
        let alpha = a.alpha[1] + share * (b.alpha[0] - a.alpha[1]);
        return State { alpha, ..state };
    }
    state
}

/// The largest share by which a limit is exceeded between the nodes, with the machine itself at each place, and where; and the distances at
/// which cells must meet so that it is no more than `within`. Each step is looked at in its own time, however short it is.
pub(super) fn excess(
    field: &Field,
    ends: &Ends,
    (track, pieces): (&Track, &[Piece]),
    trace: &Trace,
    within: f64,
) -> Result<((f64, f64), Vec<f64>), NoMotion> {
    let way = field.way;
    let direction = way.direction;
    let mut largest = (0.0_f64, ends.from);
    let mut places = Vec::new();
    for (pair, piece) in trace.nodes().windows(2).zip(pieces) {
        let [a, b] = [&pair[0], &pair[1]];
        let cell = &track.cells[piece.cell];
        let inside = ends.inside(cell.length);
        let mut most = 0.0_f64;
        for share in LOOKS {
            let state = within_step(a, b, share, within);
            // A place at a corner has the values of its own side.
            let x = (state.phi - ends.from) * direction;
            let x = x.clamp(cell.x + inside, cell.x + cell.length - inside);
            let place = way.place(ends.from + direction * x)?;
            let (v, alpha) = (state.omega * direction, state.alpha * direction);
            most = most.max(field.excess_by(&place, v, alpha)?.0);
        }
        if most > largest.0 {
            largest = (most, a.phi);
        }
        if most > within {
            // The error falls with the third power of the step.
            let parts = (most / within).cbrt().ceil().clamp(2.0, MOST_PARTS) as usize;
            let [from, to] = [a, b].map(|node| (node.phi - ends.from) * direction);
            let place = |k: usize| from + (to - from) * k as f64 / parts as f64;
            places.extend((1..parts).map(place));
        }
    }
    Ok((largest, places))
}
