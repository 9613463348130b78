//! The torque over the acceleration, in straight pieces that meet where the power at a stage changes direction.

use crate::gentlest::solve::Problem;
use crate::path_dynamics::Place;

/// Most straight pieces of a torque.
const PIECES: usize = 16;

/// Most evaluations between two lines in search of further lines.
const MOST_LOOKS: usize = 8 * PIECES;

/// A straight piece of the torque over the acceleration, in units of the problem.
#[derive(Clone, Copy, Debug)]
pub(super) struct TorquePiece {
    pub(super) at: f64,
    pub(super) start: f64,
    pub(super) rise: f64,
    /// Range of torques.
    pub(super) torques: [f64; 2],
}

/// A few pieces, without heap memory.
pub(super) struct Pieces {
    all: [TorquePiece; PIECES],
    count: usize,
}

impl Pieces {
    pub(super) fn iter(&self) -> impl Iterator<Item = &TorquePiece> {
        self.all[..self.count].iter()
    }
}

/// The torque over the acceleration at a speed: convex, so two of its lines meet above it or at the bend between them.
pub(super) fn pieces(problem: &Problem, place: &Place, speed: f64) -> Pieces {
    let line = |a: f64| {
        let demand = problem.dynamics.demand(place, speed, a);
        TorquePiece {
            at: a,
            start: demand.torque / problem.unit,
            rise: demand.per_acceleration / problem.unit,
            torques: [f64::NEG_INFINITY, f64::INFINITY],
        }
    };
    let middle = line(0.0);
    let mut pieces = Pieces {
        all: [middle; PIECES],
        count: 1,
    };
    if !problem.dynamics.bends() {
        return pieces;
    }
    // Far enough on both sides to be beyond every bend.
    let far = 1e6 * (1.0 + middle.start.abs() + (place.load / problem.unit).abs()) / middle.rise;
    let mut lines = Vec::with_capacity(PIECES);
    lines.extend([line(-far), line(far)]);
    let (mut k, mut looked) = (0, 0);
    while k + 1 < lines.len() && lines.len() < PIECES {
        looked += 1;
        if looked > MOST_LOOKS {
            // Not convex, or bent within rounding: NaN makes the bound invalid.
            pieces.all[0].rise = f64::NAN;
            return pieces;
        }
        let [left, right] = [lines[k], lines[k + 1]];
        if right.rise - left.rise <= 1e-9 * right.rise {
            lines.remove(k + 1);
            continue;
        }
        let meet = (right.start - left.start + left.rise * left.at - right.rise * right.at)
            / (left.rise - right.rise);
        let there = line(meet);
        let expected = left.start + left.rise * (meet - left.at);
        let own = |side: TorquePiece| (there.rise - side.rise).abs() <= 1e-9 * side.rise;
        if own(left)
            || own(right)
            || (there.start - expected).abs() <= 1e-9 * (1.0 + expected.abs())
        {
            k += 1;
        } else {
            lines.insert(k + 1, there);
        }
    }
    let mut from = f64::NEG_INFINITY;
    pieces.count = 0;
    for (k, own) in lines.iter().enumerate() {
        let to = lines.get(k + 1).map_or(f64::INFINITY, |next| {
            let meet = (next.start - own.start + own.rise * own.at - next.rise * next.at)
                / (own.rise - next.rise);
            own.start + own.rise * (meet - own.at)
        });
        pieces.all[pieces.count] = TorquePiece {
            torques: [from, to],
            ..*own
        };
        pieces.count += 1;
        from = to;
    }
    pieces
}
