//! A move solved on successive meshes, in scaled numbers.

use std::rc::Rc;

use jred::Domain;
use jred::machine::Reducible as _;

use super::cost::Cost;
use super::mesh::Mesh;
use super::scale::Scale;
use super::solve::{self, Minimum, Problem};
use super::{FIRST, Fault, MOST, Objective, PEAK_POWER, Travel};
use crate::memo::Memo;
use crate::path_dynamics::{PathDynamics, Place};

/// Search for the best time: most steps down to times that are too short, the factor of each, the number of evaluations, and halvings after that.
const LONGEST: u32 = 60;
const STEP: f64 = 0.8;
const SHORTS: u32 = 4;
const HALVINGS: u32 = 24;

/// Relative accuracy of the time.
const TIME_TOLERANCE: f64 = 1e-7;

/// Successive ranges of the loads over which bends are rounded, as shares of the largest load.
const RANGES: [f64; 2] = [1e-1, 1e-2];

/// The least power whose mean approximates the peak.
const LEAST_POWER: i32 = 8;

/// Successive ranges of the torque over which the bend of the drawn power is rounded, as shares of the torque's unit.
const ROUNDINGS: [f64; 3] = [1e-1, 1e-2, 1e-3];

/// The least energy may stay in a bend for long, as a coasting motion does. With drawn power both are therefore rounded less at the end, if the
/// search still converges.
const SHARP: [f64; 2] = [1e-3, 1e-4];

/// The square of the torque.
const PLAIN: Cost = Cost {
    power: 2,
    drawn: 0.0,
    rounding: 0.0,
};

/// Shares of the path, without its ends, at which a load begins or ends or a cam's segments meet.
pub(super) fn edges(dynamics: &PathDynamics, travel: &Travel) -> Vec<f64> {
    let machine = &dynamics.file.machine;
    let mut shares = Vec::new();
    for edge in (0..).map_while(|k| machine.edge(k)) {
        let share = |place: f64| (place - travel.start) / travel.distance;
        if machine.domain() != Domain::Turn {
            shares.push(share(edge));
            continue;
        }
        let turn = std::f64::consts::TAU;
        let [low, high] =
            [0.0, travel.distance].map(|dynamics| (travel.start + dynamics - edge) / turn);
        let (first, last) = (low.min(high).floor() as i64, low.max(high).ceil() as i64);
        // With more passages than elements, no cuts.
        for k in (first..=last).take(MOST) {
            shares.push(share(edge + k as f64 * turn));
        }
    }
    shares.retain(|share| *share > 1e-9 && *share < 1.0 - 1e-9);
    shares
}

/// The unknowns interpolated on a finer mesh.
fn refined(mesh: &Mesh, x: &[f64], finer: &Mesh) -> Vec<f64> {
    finer.sample(|element, u| {
        // Evaluated inside the finer element, so that an edge has the slope of its own side.
        let [from, to] = finer.elements[element].span;
        let inside = 0.5 * (from + to);
        let at = mesh.elements.partition_point(|e| e.span[1] <= inside);
        let at = at.min(mesh.elements.len() - 1);
        let [w, slope, _] = solve::pace_at(mesh, x, at, u);
        [w, slope]
    })
}

/// A move with its objective.
#[derive(Clone)]
pub(super) struct EffortTask<'a> {
    pub(super) dynamics: &'a PathDynamics<'a>,
    pub(super) travel: &'a Travel,
    pub(super) objective: Objective,
    pub(super) edges: Vec<f64>,
    /// Shares of the path's parameter over which the acceleration rises at the start and falls at the end; 0: it jumps.
    pub(super) ramps: [f64; 2],
    /// The machine at places evaluated before: another time needs the same places.
    pub(super) places: Rc<Memo<u64, Place>>,
}

/// One of the problems that are solved in succession; the last is the exact goal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage {
    pub(super) cost: Cost,
    /// Share of the largest load.
    pub(super) range: f64,
}

impl Stage {
    /// Whether its rounding is the last but the sharp one.
    fn is_narrow(&self) -> bool {
        self.cost.rounding <= ROUNDINGS[2] && self.range <= RANGES[1]
    }
}

/// A solution on a mesh.
pub(super) struct Solution<'t> {
    pub(super) task: &'t EffortTask<'t>,
    /// s
    pub(super) moving: f64,
    pub(super) scale: Scale,
    pub(super) stage: Stage,
    pub(super) mesh: Mesh,
    pub(super) found: Minimum,
}

/// A solution of the same or another time, on another mesh, as the start of a search.
#[derive(Clone)]
pub(super) struct Start {
    moving: f64,
    scale: Scale,
    mesh: Mesh,
    x: Vec<f64>,
}

impl Solution<'_> {
    /// The solution as the start of another search.
    pub(super) fn start(&self) -> Start {
        Start {
            moving: self.moving,
            scale: self.scale,
            mesh: self.mesh.clone(),
            x: self.found.x.clone(),
        }
    }
}

impl EffortTask<'_> {
    /// Torques (N·m) that hold the machine at rest at both ends, as the duty counts them in a dwell: friction is not deducted. Infinite at a moving
    /// end, where it cannot wait.
    pub(super) fn held(&self) -> Result<[f64; 2], Fault> {
        let rest = self.travel.ends().rest;
        let torque = |end: usize, phi: f64| {
            if rest[end] {
                self.dynamics.holding_at(phi)
            } else {
                Ok(f64::INFINITY)
            }
        };
        let Travel {
            start, distance, ..
        } = *self.travel;
        Ok([torque(0, start)?, torque(1, start + distance)?])
    }

    /// The motion in the time beyond which waiting is better than moving: one more second of motion costs as much as a second of holding.
    pub(super) fn shorter(&self, held: &[f64; 2]) -> Result<Solution<'_>, Fault> {
        let is_short = |solved: &Solution| solved.cost_above_holding(held) <= 0.0;
        // Down to times that are too short, where only one motion exists: in a long time the search may be caught in a crawling one.
        let mut time = self.travel.duration;
        let mut last: Option<Solution> = None;
        let mut shorts = 0;
        for _ in 0..LONGEST {
            time *= STEP;
            // A short one is not a crawling one.
            let start = last.as_ref().map(Solution::start);
            let solved = self.solve(time, FIRST, start.as_ref())?;
            let short = solved.filter(is_short);
            shorts = if short.is_some() { shorts + 1 } else { 0 };
            last = short.or(last);
            if shorts == SHORTS {
                break;
            }
        }
        let Some(mut found) = last else {
            return Err(Fault::NotFound);
        };
        // Up from there, then bisection.
        let mut high = self.travel.duration;
        let mut is_bracketed = false;
        for _ in 0..LONGEST + HALVINGS {
            let next = if is_bracketed {
                (found.moving * high).sqrt()
            } else {
                (found.moving / STEP).min(high)
            };
            if high - found.moving <= TIME_TOLERANCE * high {
                break;
            }
            if let Some(solved) = self
                .solve(next, FIRST, Some(&found.start()))?
                .filter(is_short)
            {
                found = solved;
            } else {
                (high, is_bracketed) = (next, true);
            }
        }
        Ok(found)
    }

    /// The final cost, in scaled numbers.
    fn goal(&self, scale: &Scale, moving: f64) -> Result<Stage, Fault> {
        let cost = match self.objective {
            Objective::Rms => PLAIN,
            Objective::Energy { copper } => {
                if !(copper > 0.0 && copper.is_finite()) {
                    return Err(Fault::Figure("copper loss", copper));
                }
                Cost {
                    drawn: self.dynamics.motor_speed(1.0) / (copper * scale.unit * moving),
                    rounding: SHARP[1],
                    ..PLAIN
                }
            }
            Objective::Peak => Cost {
                power: PEAK_POWER,
                ..PLAIN
            },
        };
        let range = match self.objective {
            _ if !self.dynamics.bends() => 0.0,
            Objective::Energy { .. } => SHARP[1],
            Objective::Rms | Objective::Peak => RANGES[1],
        };
        Ok(Stage { cost, range })
    }

    pub(super) fn problem<'p>(
        &'p self,
        mesh: &'p Mesh,
        moving: f64,
        scale: &Scale,
        stage: &Stage,
    ) -> Problem<'p> {
        Problem {
            dynamics: self.dynamics,
            mesh,
            duration: moving,
            unit: scale.unit,
            cost: stage.cost,
            range: stage.range * scale.load,
            length: self.travel.distance.abs(),
            course: [self.travel.start, self.travel.distance],
        }
    }

    /// The solution on a mesh, started from another mesh if there is one; `None` if the method did not converge.
    pub(super) fn solve<'t>(
        &'t self,
        moving: f64,
        parts: usize,
        from: Option<&Start>,
    ) -> Result<Option<Solution<'t>>, Fault> {
        let travel = Travel {
            duration: moving,
            ..*self.travel
        };
        let place = |phi: f64| self.places.of(phi.to_bits(), || self.dynamics.place(phi));
        let mesh = Mesh::new(place, &travel, self.ramps, &self.edges, parts)?;
        // All meshes for one time use the same scale, because their costs are compared.
        let same = from.filter(|from| from.moving.total_cmp(&moving).is_eq());
        let scale = match same {
            Some(from) => from.scale,
            None => Scale::new(self.dynamics, &travel, &mesh)?,
        };
        let goal = self.goal(&scale, moving)?;
        let at = |stage: &Stage, x: &[f64]| self.problem(&mesh, moving, &scale, stage).minimise(x);
        let mut kept = from
            .and_then(|from| at(&goal, &refined(&from.mesh, &from.x, &mesh)))
            .filter(|found| found.converged)
            .map(|found| (goal, found));
        // For the peak any motion better than a constant pace is accepted, even if the search did not converge.
        let mut rough: Option<(f64, Stage, Minimum)> = None;
        if kept.is_none() {
            let mut x = mesh.sample(|_, _| [1.0, 0.0]);
            let stages = self.stages(&goal);
            let last = stages.len() - 1;
            for (number, stage) in stages.into_iter().enumerate() {
                let Some(found) = at(&stage, &x) else {
                    continue;
                };
                if self.objective == Objective::Peak {
                    let peak = self.problem(&mesh, moving, &scale, &stage).peak(&found.x);
                    if rough.as_ref().is_none_or(|(least, ..)| peak < *least) {
                        rough = Some((peak, stage, found.clone()));
                    }
                }
                // The next power starts from the result, or anew.
                if found.converged || stage.cost.power == goal.cost.power {
                    x.clone_from(&found.x);
                }
                if found.converged && (number == last || self.serves(&stage)) {
                    kept = Some((stage, found));
                }
            }
        }
        let rough = rough.map(|(_, stage, found)| {
            let converged = false;
            (stage, Minimum { converged, ..found })
        });
        Ok(kept.or(rough).map(|(stage, found)| Solution {
            task: self,
            moving,
            scale,
            stage,
            mesh,
            found,
        }))
    }

    /// Whether an earlier stage may replace one that does not converge: the mean of a lower power is near the peak too, and wider rounding is near
    /// the least energy.
    fn serves(&self, stage: &Stage) -> bool {
        match self.objective {
            Objective::Rms => false,
            Objective::Energy { .. } => stage.is_narrow(),
            Objective::Peak => stage.cost.power >= LEAST_POWER,
        }
    }

    /// From the easiest problem to the final one.
    fn stages(&self, goal: &Stage) -> Vec<Stage> {
        let mut stages = Vec::new();
        let plain = Cost {
            power: 2,
            ..goal.cost
        };
        let ranges = if self.dynamics.bends() {
            &RANGES[..]
        } else {
            &[0.0]
        };
        for &range in ranges {
            let cost = Cost {
                rounding: 1e-1,
                ..plain
            };
            stages.push(Stage { cost, range });
        }
        if goal.cost.drawn > 0.0 {
            let range = ranges[ranges.len() - 1];
            for rounding in ROUNDINGS {
                let cost = Cost { rounding, ..plain };
                stages.push(Stage { cost, range });
            }
            for sharp in SHARP {
                let cost = Cost {
                    rounding: sharp,
                    ..plain
                };
                let range = range.min(sharp);
                stages.push(Stage { cost, range });
            }
        }
        let mut power = 2;
        while power < goal.cost.power {
            power *= 2;
            let cost = Cost { power, ..goal.cost };
            stages.push(Stage { cost, ..*goal });
        }
        stages
    }
}

impl Solution<'_> {
    /// Whether it replaces the solution of a coarser mesh.
    pub(super) fn follows(&self, before: &Self) -> bool {
        let peak = |solved: &Self| {
            let problem =
                (solved.task).problem(&solved.mesh, solved.moving, &solved.scale, &solved.stage);
            problem.peak(&solved.found.x)
        };
        match [before, self].map(|solved| solved.found.converged) {
            [true, false] => false,
            [_, true] => {
                self.stage.cost.power >= before.stage.cost.power || !before.found.converged
            }
            [false, false] => peak(self) < peak(before),
        }
    }

    /// Cost of one more second above a second of holding, in scaled numbers.
    fn cost_above_holding(&self, held: &[f64; 2]) -> f64 {
        let least = held.map(f64::abs).into_iter().fold(f64::INFINITY, f64::min);
        let [holding, ..] = self.stage.cost.torque(least / self.scale.unit);
        -self.found.multiplier - holding
    }

    /// Whether waiting is better than this time in motion. For the peak it never is: a slower motion has the lower peak, and the integral of the 64th
    /// power says nothing about pauses.
    pub(super) fn waits(&self, held: &[f64; 2]) -> bool {
        self.task.objective != Objective::Peak
            && self.cost_above_holding(held) > 1e-6 * self.found.cost
    }
}
