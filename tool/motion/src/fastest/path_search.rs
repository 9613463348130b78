//! A path cut into cells, refined until the time of the fastest motion has converged and its limits are satisfied between the nodes.

use std::cell::Cell;

use crate::path_dynamics::PathDynamics;
use crate::trace::{Node, Trace};

use super::field::{Field, speed};
use super::leg::Step;
use super::sweep::{self, Obstacle, SweepPiece};
use super::track::{Ends, Survey, Track};
use super::{
    Fastest, NoMotion, Task, between, corners, joint_force, least_cells, phases, settable_limit,
    tiny_steps,
};

/// First and largest number of cells.
pub(super) const CELLS: [usize; 2] = [128, 131_072];

/// Relative change of the time on doubling the cells at which it counts as converged. With a method of order 4, a fifteenth of it is left.
const SETTLED: f64 = 1e-9;

/// Share by which a torque, speed or acceleration may exceed its limit between the nodes of the motion.
pub(super) const SWEEP_EXCESS: f64 = 1e-9;

/// Most rounds of refinement.
const ROUNDS: u32 = 24;

/// Most rounds in a row without the excess falling below this share of the least so far. The rest is rounding of the machine's terms, which finer
/// cells do not reduce. The round with the least excess is used.
const IDLE: u32 = 12;
const FALLS: f64 = 0.5;

/// Largest relative excess after all rounds, and largest relative change of the time with the last number of cells. A less accurate motion is
/// rejected.
pub(super) const MOST_EXCESS: f64 = 1e-6;
const MOST_CHANGE: f64 = 1e-6;

/// Cells from which contradicting limits count as proven.
const ENOUGH: usize = 4096;

/// A path with its limits, for motions with different end speeds.
pub(super) struct PathSearch<'f, 'w, 'a> {
    survey: Survey<'f, 'w, 'a>,
    from: f64,
    length: f64,
    corners: Vec<f64>,
    /// First number of cells for the next motion: half of the number with which the last one converged.
    first: Cell<usize>,
}

impl<'f, 'w, 'a> PathSearch<'f, 'w, 'a> {
    /// The path of a task.
    ///
    /// # Errors
    /// It is too long, or the mechanism cannot be placed somewhere.
    pub(super) fn new(field: &'f Field<'w, 'a>, task: &Task) -> Result<Self, NoMotion> {
        let length = (task.to - task.from).abs();
        let [first, _] = CELLS;
        Ok(Self {
            survey: Survey::new(field, task.from),
            from: task.from,
            length,
            corners: corners::corners(field, task.from, length)?,
            first: Cell::new(first.max(least_cells(field, task.from, length)?)),
        })
    }

    /// Doubles the number of cells until the time has converged, then refines the cells in which limits are exceeded by more than `within`.
    pub(super) fn fastest(&self, speeds: [f64; 2], within: f64) -> Result<Fastest, NoMotion> {
        let field = self.survey.field;
        let (dynamics, limits, file) = (field.dynamics, &field.limits, field.dynamics.file);
        let [_, most] = CELLS;
        let mut count = self.first.get();
        let ends = Ends {
            from: self.from,
            length: self.length,
            speeds,
            corners: self.corners.clone(),
        };
        let z = ends.speeds.map(|v| 0.5 * v * v);
        let mut before: Option<f64> = None;
        let mut end: Option<f64> = None;
        let mut settled = f64::INFINITY;
        let mut finer: Vec<f64> = Vec::new();
        let mut best = Best::default();
        for round in 0.. {
            let track = Track::new(&self.survey, &ends, count, &finer)?;
            if let Some((phi, force)) = joint_force::without_motion(&track) {
                return Err(NoMotion::of_force(file, phi, &force));
            }
            let may_go_on = track.cells.len() < most && round < ROUNDS;
            let pieces = match sweep::fastest(field, &track, z) {
                Ok(pieces) => pieces,
                Err(Obstacle::StartTooFast(most) | Obstacle::EndTooFast(most))
                    if count < ENOUGH
                        && finer.is_empty()
                        && may_go_on
                        && end
                            .replace(most)
                            .is_none_or(|end| (most - end).abs() > SETTLED * most) =>
                {
                    // The largest end speed is only as accurate as the cells.
                    count *= 2;
                    continue;
                }
                Err(obstacle) => {
                    let eased = match obstacle {
                        Obstacle::Stops(..) => settable_limit::by(field, &ends, count)?,
                        _ => None,
                    };
                    return Err(NoMotion::at(field, &track, obstacle, eased));
                }
            };
            if let Err(closed) = between::check(field, &ends, &track, &pieces) {
                // Between the places of a cell two limits that meet at the largest speed may cross: everywhere, or only at a dead centre.
                if !(limits.forces.is_some() && may_go_on) {
                    return Err(closed.why);
                }
                if finer.is_empty() && count < ENOUGH {
                    count *= 2;
                } else {
                    finer.extend(closed.places);
                }
                continue;
            }
            let times = sweep::times(&track, &pieces);
            let time: f64 = times.iter().sum();
            if settled.is_infinite() {
                let change = before.map_or(f64::INFINITY, |before| (time - before).abs());
                before = Some(time);
                if change > SETTLED * time && may_go_on {
                    count *= 2;
                    continue;
                }
                settled = change;
                self.first.set(self.first.get().max(count / 2));
            }
            let (pieces, times) = tiny_steps::without(&track, pieces, &times);
            let trace = trace(dynamics, &ends, &track, &pieces, &times);
            let ((excess, phi), places) =
                between::largest_excess(&self.survey, &ends, &track, &pieces, &trace, within)?;
            let idle = best.take(Round {
                track,
                pieces,
                times,
                trace,
                time,
                excess,
                phi,
            });
            if places.is_empty() || !may_go_on || idle >= IDLE {
                let round = best.round.ok_or(NoMotion::NoWay)?;
                return round.answer(field, &ends, settled);
            }
            finer.extend(places);
        }
        Err(NoMotion::NoWay)
    }
}

/// The motion of a round.
struct Round {
    track: Track,
    pieces: Vec<SweepPiece>,
    times: Vec<f64>,
    trace: Trace,
    time: f64,
    /// The largest share by which it exceeds a limit, and the position.
    excess: f64,
    phi: f64,
}

/// The round with the least excess.
#[derive(Default)]
struct Best {
    round: Option<Round>,
    /// Rounds since the excess last fell notably.
    idle: u32,
}

impl Best {
    /// Takes the motion of a round; returns the rounds since the excess fell.
    fn take(&mut self, next: Round) -> u32 {
        let least = self
            .round
            .as_ref()
            .map_or(f64::INFINITY, |round| round.excess);
        self.idle = if next.excess < FALLS * least {
            0
        } else {
            self.idle + 1
        };
        if next.excess < least {
            self.round = Some(next);
        }
        self.idle
    }
}

impl Round {
    /// The motion, if it is accurate enough; the time changed by `settled` with the last number of cells.
    fn answer(self, field: &Field, ends: &Ends, settled: f64) -> Result<Fastest, NoMotion> {
        let change = settled / self.time;
        if self.excess > MOST_EXCESS || change > MOST_CHANGE {
            return Err(NoMotion::NotAccurate {
                excess: self.excess,
                phi: self.phi,
                change,
                endless: false,
                axis: field.dynamics.file.axis(),
            });
        }
        Ok(Fastest {
            time: self.time,
            error: settled / 15.0,
            phases: phases::phases(field, ends, &self.track, &self.pieces, &self.times),
            trace: self.trace,
            excess: self.excess,
            cells: self.track.cells.len(),
            bound: None,
        })
    }
}

/// The motion over time.
fn trace(
    dynamics: &PathDynamics,
    ends: &Ends,
    track: &Track,
    pieces: &[SweepPiece],
    times: &[f64],
) -> Trace {
    let mut nodes: Vec<Node> = Vec::with_capacity(pieces.len() + 1);
    let mut t = 0.0;
    let mut push = |t: f64, step: f64, piece: &SweepPiece, end: usize| {
        let Step { u, z, a, .. } = &piece.step;
        let cell = &track.cells[piece.cell];
        let alpha = a[end] * dynamics.direction;
        if let Some(node) = nodes.last_mut().filter(|_| end == 0) {
            node.alpha[1] = alpha;
            return;
        }
        nodes.push(Node {
            t,
            step,
            phi: ends.from + dynamics.direction * (cell.x + u[end] * cell.length),
            omega: speed(z[end]) * dynamics.direction,
            alpha: [if t == 0.0 { 0.0 } else { alpha }, alpha],
        });
    };
    for (piece, time) in pieces.iter().zip(times) {
        push(t, 0.0, piece, 0);
        t += time;
        push(t, *time, piece, 1);
    }
    if let Some(last) = nodes.last_mut() {
        last.alpha[1] = 0.0;
        last.phi = ends.from + dynamics.direction * ends.length;
    }
    Trace::new(dynamics.coordinate(), nodes)
}
