//! The moves of a motion: from rest to rest.

use crate::duty::Instant;

/// Share of the largest speed below which the drive link is at rest: at the ends of a move the instants lie just inside.
const AT_REST: f64 = 1e-6;

/// A stretch in one direction that stays below this share of the largest speed is not a move: a curve through recorded positions oscillates slightly
/// where the machine was at rest.
const SWING: f64 = 1e-2;

/// Number of moves and duration of the shortest one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moves {
    /// Number of moves that begin at rest or with a reversal.
    pub(super) count: u32,
    /// Time of the shortest of them (s).
    pub(super) shortest: Option<f64>,
}

/// A stretch in one direction.
struct Run {
    from: f64,
    to: f64,
    fastest: f64,
}

impl Moves {
    /// The moves among the instants. A cyclic motion continues from its end at its start.
    pub(super) fn of(instants: &[Instant], duration: f64, cyclic: bool) -> Self {
        let peak = instants.iter().map(|i| i.omega.abs()).fold(0.0, f64::max);
        let direction = |instant: &Instant| {
            let is_end = instant.weight == 0.0 && instant.omega.abs() <= AT_REST * peak;
            if instant.omega == 0.0 || is_end {
                0i8
            } else {
                instant.omega.signum() as i8
            }
        };
        let mut runs: Vec<Run> = Vec::new();
        let (mut was, mut at) = (0, 0.0);
        for instant in instants {
            let now = direction(instant);
            let t = instant.t;
            // The motion reversed between two instants of opposite directions.
            let turned = if was == 0 { at } else { 0.5 * (at + t) };
            if let Some(run) = runs.last_mut().filter(|_| was != 0) {
                run.to = if now == was || now == 0 { t } else { turned };
            }
            if now != 0 && now != was {
                runs.push(Run {
                    from: turned,
                    to: t,
                    fastest: 0.0,
                });
            }
            if let Some(run) = runs.last_mut().filter(|_| now != 0) {
                run.fastest = run.fastest.max(instant.omega.abs());
            }
            (was, at) = (now, t);
        }
        let ends = instants
            .first()
            .map(direction)
            .zip(instants.last().map(direction));
        if cyclic && ends.is_some_and(|(first, last)| first != 0 && first == last) {
            if runs.len() == 1 {
                // No instant at rest.
                runs.clear();
            } else if let Some(last) = runs.pop()
                && let Some(first) = runs.first_mut()
            {
                first.from = last.from - duration;
                first.fastest = first.fastest.max(last.fastest);
            }
        }
        runs.retain(|run| run.fastest > SWING * peak);
        Self {
            count: runs.len() as u32,
            shortest: runs.iter().map(|run| run.to - run.from).reduce(f64::min),
        }
    }
}
