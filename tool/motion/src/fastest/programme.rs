//! The fastest motion under limits of jerk or torque rate, or at a price of the motor's heat.
//!
//! Two sweeps do not find it: with a rate limit, the possible accelerations depend on the previous one. Here the motion is written as w(u), the
//! square of the pace du/dt along a path ([`mesh`]). Its time is a convex integral of w. The [`limits`] must be satisfied at seven stations of every
//! piece.
//!
//! 1. An interior-point method ([`interior`]) finds a locally fastest motion.
//! 2. Pieces are halved where the active limit changes, until the time no longer changes.
//! 3. The motion over time is checked between the stations with the machine itself. Where it exceeds a limit, that limit gets a margin in its piece,
//!    and the search is repeated.
//!
//! Without limits of jerk and torque rate the motion can only be faster: the time of the sweeps is a lower bound.
//!
//! Terms: a *bend* of the torque is where power changes direction in a stage with losses, so that the torque's slope by the load jumps. The method
//! needs smooth functions, so a bend is *rounded* over a *range* of the load. μ is the weight of the barrier that keeps the motion away from its
//! limits; it falls to almost zero. The limits are *eased* when those of jerk and torque rate are multiplied by a factor.

mod borders;
mod effort;
mod interior;
mod limits;
mod mesh;
mod newton;
mod outcome;
mod rate;
mod refine;
mod starts;

use crate::collocation::pieces::dot;
use crate::collocation::shape::Parametrization;
use jred_file::math;

use super::field::{Binding, Field, MoveLimits};
use super::obstacle::input;
use super::track::Ends;
use super::{Fastest, NoMotion};
use interior::{PrimalDual, StuckStation, minimise};
pub use limits::Price;
use limits::{Margins, MeshProblem};
use mesh::{Border, BoundaryConditions, Mesh};
use outcome::{LargestExcess, widen};

/// Number of pieces of the first mesh, and the largest number.
const PIECES: [usize; 2] = [24, 1500];

/// Least and largest share of u at each end along which the path has constant jerk.
const RAMP: [f64; 2] = [1e-6, 0.25];

/// Constant paces as starts of the search, as shares of the pace of the fastest motion without rate limits, and of the pace that just meets these
/// limits.
const STARTS: [f64; 3] = [0.25, 0.05, 0.7];

/// Slowest pace, as a share of the fastest motion's pace, at which rate limits may be met, and the accuracy of that pace as a difference of
/// logarithms.
const SLOWEST: f64 = 1e-12;
const CLOSELY: f64 = 0.01;

/// Factor from one constant pace to the next in the search for the cheapest one, where heat has a price.
const SLOWER: f64 = 0.8;

/// μ at the start and at the end: on the first mesh, on later meshes, and on the last. The relative error of the time is about 10·μ (too long).
const ROUGH: [f64; 2] = [0.1, 1e-5];
const FINER: [f64; 2] = [1e-2, 1e-8];
const LAST: [f64; 2] = [1e-3, 1e-10];

/// Relative excess from which a limit is reported as the one that no motion satisfies.
const FEASIBLE: f64 = 1e-6;

/// Range over which bends of the torque are rounded, as a share of the largest load of the motion: at the start of the search, and at its end.
const RANGES: [f64; 2] = [1e-1, 4e-3];

/// Factors by which the range is widened in the last search, in order, until a motion is found.
const WIDER: [f64; 3] = [1.0, 4.0, 16.0];

/// Share by which a limit may be exceeded between the nodes, and how often margins may be widened to achieve it.
const PROGRAMME_EXCESS: f64 = 2e-7;
const WIDENED: u32 = 24;

pub(super) struct MoveRequest<'a> {
    pub(super) field: &'a Field<'a, 'a>,
    pub(super) ends: &'a Ends,
    /// Time (s) of the fastest motion without rate limits and without a price of heat.
    pub(super) bound: f64,
    /// Unit of time (s) of the search.
    pub(super) unit: f64,
    /// Time in which the accelerations at the ends of that motion would rise under the rate limits, as a share of `bound`; 0: no such limits.
    pub(super) rise: f64,
    /// The objective.
    pub(super) price: Price,
}

/// A motion on a mesh.
#[derive(Clone, Debug)]
struct MeshMotion {
    mesh: Mesh,
    point: PrimalDual,
    time: f64,
    /// Range (N·m) over which bends of the torque are rounded, and its share of the largest load of the motion.
    range: f64,
    share: f64,
}

/// A motion as the start of a search with another price.
#[derive(Clone, Debug)]
pub struct WarmStart {
    borders: Vec<Border>,
    found: MeshMotion,
    margins: Vec<Margins>,
    /// Relative change of the time at the last refinement.
    change: f64,
}

/// Start of the search.
#[derive(Clone, Copy, Debug)]
pub enum Start<'w> {
    /// Constant paces.
    Nothing,
    /// Another motion, with new pieces.
    Near(&'w WarmStart),
    /// Another motion on its own pieces, so that a small change of the price changes the motion little.
    Beside(&'w WarmStart),
}

impl MoveRequest<'_> {
    /// The motion.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere, a load jumps under a limit of the torque rate, or no motion was found.
    pub(super) fn solve(&self, start: Start) -> Result<(Fastest, WarmStart), NoMotion> {
        self.refuse_jumps()?;
        let found = self.solve_from(start, true);
        // On coarse pieces, eased limits may lead to a fast motion that does not exist on finer ones.
        match (start, &found) {
            (Start::Nothing, Err(NoMotion::NotFound { .. })) if self.limits().has_rates() => {
                self.solve_from(start, false).or(found)
            }
            _ => found,
        }
    }

    /// The same; `eased`: whether motions under eased limits are starts too.
    fn solve_from(&self, start: Start, eased: bool) -> Result<(Fastest, WarmStart), NoMotion> {
        let shape = self.shape();
        let beside = match start {
            Start::Beside(warm) => self.beside(&shape, warm)?,
            _ => None,
        };
        let mut warm = match (beside, start) {
            (Some(warm), _) => warm,
            (None, Start::Nothing) => self.refined(&shape, None, eased)?,
            (None, Start::Near(warm) | Start::Beside(warm)) => {
                self.refined(&shape, Some(warm), eased)?
            }
        };
        let mut trace = self.trace(&shape, &warm.found);
        let mut worst = LargestExcess::NONE;
        for round in 0..WIDENED {
            // With margins the loads of the motion change, so its previous range may be too narrow.
            let mut next = None;
            for factor in WIDER {
                let range = [warm.found.range, warm.found.share].map(|range| factor * range);
                let (borders, margins) = (&warm.borders, &warm.margins);
                let found = self.next(&shape, borders, &warm.found, margins, LAST, range)?;
                next = found.ok();
                if next.is_some() || range[0] == 0.0 {
                    break;
                }
            }
            // In the first round there are no margins, so the previous motion is still valid.
            match next {
                Some(next) => warm.found = next,
                None if round > 0 => break,
                None => {}
            }
            trace = self.trace(&shape, &warm.found);
            let each;
            (worst, each) = self.exceeded(&trace, warm.margins.len())?;
            if worst.excess <= PROGRAMME_EXCESS {
                break;
            }
            if !self.divide(&mut warm, &each) {
                widen(&mut warm.margins, &each, 2 * round > WIDENED);
            }
        }
        if worst.excess > super::path_search::MOST_EXCESS {
            return Err(self.not_found(worst.limit, worst.phi, worst.excess));
        }
        let time = trace.duration();
        if !time.is_finite() {
            return Err(self.not_found(worst.limit, worst.phi, 0.0));
        }
        let fastest = Fastest {
            time,
            error: warm.change.min(1.0) * time,
            phases: self.phases(&warm.found, &trace),
            trace,
            excess: worst.excess,
            cells: warm.found.mesh.elements.len(),
            bound: Some(self.bound),
        };
        Ok((fastest, warm))
    }

    fn not_found(&self, limit: Option<Binding>, phi: f64, missed: f64) -> NoMotion {
        NoMotion::NotFound {
            bound: self.bound,
            limit,
            phi,
            missed,
            jerk: self.limits().jerk.is_some(),
            torque_rate: self.limits().torque_rate.is_some(),
            unit: input(self.field.dynamics.file),
            axis: self.field.dynamics.file.axis(),
        }
    }

    fn limits(&self) -> &MoveLimits {
        &self.field.limits
    }

    /// Share of u at each end along which the acceleration rises.
    fn ramp(&self) -> f64 {
        self.rise.clamp(RAMP[0], RAMP[1])
    }

    /// Whether each end is at rest.
    fn rest(&self) -> [bool; 2] {
        self.ends.speeds.map(|speed| speed == 0.0)
    }

    /// The path, shaped for its ends.
    fn shape(&self) -> Parametrization {
        let ramp = if self.limits().level_ends {
            self.ramp()
        } else {
            0.0
        };
        Parametrization::new(self.rest(), ramp)
    }

    /// Start and signed length of the path.
    fn course(&self) -> [f64; 2] {
        [
            self.ends.from,
            self.ends.length * self.field.dynamics.direction,
        ]
    }

    fn mesh(&self, shape: &Parametrization, borders: &[Border]) -> Result<Mesh, NoMotion> {
        let [start, distance] = self.course();
        let pace = |end: usize| {
            let [_, slope, ..] = shape.series(end as f64, end as f64);
            (self.ends.speeds[end] * self.unit / (distance.abs() * slope)).powi(2)
        };
        let rest = self.rest();
        let form = BoundaryConditions {
            rest,
            pace: [0, 1].map(|end| if rest[end] { 0.0 } else { pace(end) }),
            level: self.limits().level_ends,
            smooth: self.limits().has_rates(),
        };
        Ok(Mesh::new(
            self.field,
            [start, distance],
            shape,
            form,
            borders,
        )?)
    }

    fn problem<'m>(
        &'m self,
        mesh: &'m Mesh,
        margins: &'m [Margins],
        range: f64,
    ) -> MeshProblem<'m> {
        MeshProblem {
            field: self.field,
            mesh,
            unit: self.unit,
            pace: self.ends.length / self.unit,
            price: self.price,
            range,
            ease: 1.0,
            lines: [true, false].map(|braking| self.field.torque_lines(braking)),
            margins,
        }
    }

    /// The same with a unit of time in which a constant pace of 1 just meets the rate limits, or costs least. The motion may be many times slower
    /// than without these limits, and the method works best with numbers near 1.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub(super) fn in_own_unit(mut self) -> Result<Self, NoMotion> {
        let shape = self.shape();
        let mesh = self.mesh(&shape, &self.first_borders(&shape))?;
        let margins = vec![Margins::default(); mesh.elements.len()];
        let even = |pace: f64| {
            let x = mesh.even(pace * pace);
            let problem = self.problem(&mesh, &margins, 0.0).ranged(&x, RANGES[0]);
            (problem.keeps_rates(&x), problem.whole_cost(&x))
        };
        let mut pace = 1.0;
        if self.limits().has_rates() && !even(1.0).0 && even(SLOWEST).0 {
            let [mut low, mut high] = [math::ln(SLOWEST), 0.0];
            while high - low > CLOSELY {
                let middle = f64::midpoint(low, high);
                if even(math::exp(middle)).0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            pace = math::exp(low);
        }
        if self.price.heat > 0.0 {
            let mut least = even(pace).1;
            while pace > SLOWEST {
                let cost = even(SLOWER * pace).1;
                if cost >= least {
                    break;
                }
                (least, pace) = (cost, SLOWER * pace);
            }
        }
        self.unit = self.bound / pace;
        Ok(self)
    }

    fn found(&self, mesh: Mesh, point: PrimalDual, range: f64, share: f64) -> MeshMotion {
        let time = self.time(&mesh, &point.x);
        MeshMotion {
            mesh,
            point,
            time,
            range,
            share,
        }
    }

    /// The motion on these borders, started from a motion on other borders; an empty slice of margins means no margins.
    fn next(
        &self,
        shape: &Parametrization,
        borders: &[Border],
        before: &MeshMotion,
        margins: &[Margins],
        barrier: [f64; 2],
        [range, share]: [f64; 2],
    ) -> Result<Result<MeshMotion, StuckStation>, NoMotion> {
        let mesh = self.mesh(shape, borders)?;
        let none = vec![Margins::default(); mesh.elements.len()];
        let margins = if margins.is_empty() { &none } else { margins };
        let problem = self.problem(&mesh, margins, range);
        let mut start = mesh.refined(&before.mesh, &before.point.x);
        if problem.at(&start).is_none() {
            start = mesh.levelled(&before.mesh, &before.point.x);
        }
        let point = minimise(&problem, &start, barrier)
            .or_else(|_| minimise(&problem, &start, [ROUGH[0], barrier[1]]));
        Ok(point.map(|point| self.found(mesh, point, range, share)))
    }

    /// Duration (s).
    fn time(&self, mesh: &Mesh, x: &[f64]) -> f64 {
        let each = mesh.stations.iter().map(|station| {
            let values = mesh.values(x, station.element);
            station.weight / dot(&station.basis[0], &values).sqrt()
        });
        self.unit * each.sum::<f64>()
    }

    /// Refuses a load that jumps while the torque rate is limited: there the torque or the acceleration would jump.
    fn refuse_jumps(&self) -> Result<(), NoMotion> {
        if self.limits().torque_rate.is_none() {
            return Ok(());
        }
        let dynamics = self.field.dynamics;
        let scale = self.field.motor_torques(0.0).map(f64::abs)[1];
        let near = self.ends.inside(1e-3 * self.ends.length);
        for x in &self.ends.corners {
            let place = |x: f64| dynamics.place(self.ends.from + dynamics.direction * x);
            let sides = [place(x - near)?, place(x + near)?];
            let speed = self.ends.length / self.bound;
            let [before, after] = sides.map(|place| dynamics.demand(&place, speed, 0.0).torque);
            if (after - before).abs() > 1e-6 * scale {
                return Err(NoMotion::LoadJumps {
                    phi: self.ends.from + dynamics.direction * x,
                    torques: [before, after],
                    unit: input(dynamics.file),
                    axis: dynamics.file.axis(),
                });
            }
        }
        Ok(())
    }
}
