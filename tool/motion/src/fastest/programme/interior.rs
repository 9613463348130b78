//! An interior-point method for a sum of local terms under local limits.
//!
//! ```text
//! minimise Σ f(y)   subject to   c(y) + s = 0,  s ≥ 0
//! ```
//!
//! where each f and c depends on the values y of one piece. Newton's method solves the optimality conditions with s·λ = μ·weight for slacks s and
//! multipliers λ, while μ falls to zero. Slacks and multipliers are eliminated, so that the matrix keeps the band of the pieces. Negative second
//! derivatives are omitted where the matrix would not be positive definite. A step is halved until its end violates limits less, or costs less, than
//! each earlier point (a filter; Fletcher and Leyffer, 2002). The start may violate limits.

use super::limits::MeshProblem;
use super::mesh::{Local, Mesh, VALUES};
use super::newton::{Kkt, Steps, along};
use crate::fastest::field::Binding;
use jred_file::math;

/// A function of the values of one piece at a point.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) element: usize,
    /// The limit, and its station.
    pub(super) limit: Option<Binding>,
    pub(super) station: usize,
    pub(super) value: f64,
    pub(super) gradient: Local,
    /// Second derivatives as factors of squares of linear forms.
    pub(super) bends: [(f64, Local); 4],
    /// Weight of its logarithm in the barrier.
    pub(super) weight: f64,
}

impl Term {
    /// A zero term, to be filled in.
    pub(super) const fn straight(element: usize, weight: f64) -> Self {
        Self {
            element,
            limit: None,
            station: 0,
            value: 0.0,
            gradient: [0.0; VALUES],
            bends: [(0.0, [0.0; VALUES]); 4],
            weight,
        }
    }
}

/// A point with the multipliers of the limits.
#[derive(Clone, Debug)]
pub(super) struct PrimalDual {
    pub(super) x: Vec<f64>,
    pub(super) multipliers: Vec<f64>,
}

/// Most steps with one μ.
const STEPS: u32 = 80;

/// Errors of the gradient and of the limits that are accepted after `STEPS` steps.
const BENT: [f64; 2] = [1e-2, 1e-6];

/// Most halvings of a step.
const HALVINGS: u32 = 30;

/// Largest share of the step that would make a slack or a multiplier zero.
const INSIDE: f64 = 0.995;

/// Accepted error of the gradient, as a share of its terms, and of the limits at the end.
const STATIONARY: f64 = 1e-6;
const FEASIBLE: f64 = 1e-9;

/// Errors of the gradient and of the limits below which Newton's step skips the filter.
const CLOSE: [f64; 2] = [1e-3, 1e-6];

/// μ falls when the sum of s·λ is at most this many times its target.
const GAP: f64 = 2.0;

/// Steps without gain after which a point that violates limits by less than this share counts as exact within rounding.
const IDLE: u32 = 3;
const ROUNDED: f64 = 1e-8;

/// Least gain of a step, as a share of the violation of limits.
const FILTER: f64 = 1e-5;

/// A slack is set to the distance from its limit if that exceeds this share of the slack after the step.
const KEPT: f64 = 0.1;

/// Least slack at the start: the smaller of a number and a multiple of μ.
const SLACK: [f64; 2] = [1e-2, 10.0];

/// An iterate: unknowns, slacks, terms and limits.
pub(super) struct Iterate {
    pub(super) x: Vec<f64>,
    pub(super) slacks: Vec<f64>,
    pub(super) terms: Vec<Term>,
    pub(super) rows: Vec<Term>,
}

/// A failure of the method: the most violated limit, its station, and the share.
#[derive(Clone, Copy, Debug)]
pub(super) struct StuckStation {
    pub(super) limit: Option<Binding>,
    pub(super) station: usize,
    pub(super) missed: f64,
}

/// The minimum, from a point, with μ falling from one value to another.
///
/// # Errors
/// The method does not converge.
pub(super) fn minimise(
    programme: &MeshProblem,
    start: &[f64],
    [first, last]: [f64; 2],
) -> Result<PrimalDual, StuckStation> {
    let mesh = programme.mesh;
    let mut mu = first;
    let nowhere = StuckStation {
        limit: None,
        station: 0,
        missed: 0.0,
    };
    let mut at = Iterate::new(programme, start.to_vec()).ok_or(nowhere)?;
    let least = SLACK[0].min(SLACK[1] * first);
    at.slacks = at
        .rows
        .iter()
        .map(|row| row.value.abs().max(least))
        .collect();
    let each = at.rows.iter().zip(&at.slacks);
    let mut lambda: Vec<f64> = each.map(|(row, s)| mu * row.weight / s).collect();
    let mut filter = Vec::new();
    let mut idle = 0;
    let mut steps_of_mu = 0;
    loop {
        let kkt = Kkt::new(mesh, &at, &lambda);
        loop {
            let missed = kkt.missed(&at, &lambda, mu);
            let done = mu <= last;
            let enough = if done {
                STATIONARY
            } else {
                (10.0 * mu).clamp(STATIONARY, 0.1)
            };
            let is_rounded = idle >= IDLE && at.missed() <= ROUNDED;
            // At a bend of the torque the gradient jumps. Steps across it gain nothing, but the remaining error is small.
            let is_bent = steps_of_mu >= STEPS && missed[0] < BENT[0] && missed[1] < BENT[1];
            if !(is_rounded || is_bent)
                && (missed[0] > enough || missed[1] > mu.clamp(FEASIBLE, 1e-3) || missed[2] > GAP)
            {
                break;
            }
            if done {
                return Ok(at.point(lambda));
            }
            mu = (0.2 * mu).min(math::pow(mu, 1.2)).max(last);
            (idle, steps_of_mu) = (0, 0);
            filter.clear();
        }
        if idle >= IDLE || steps_of_mu >= STEPS {
            return Err(at.stuck());
        }
        steps_of_mu += 1;
        let Some(steps) = kkt.steps(mesh, &at, &lambda, mu) else {
            return Err(at.stuck());
        };
        let dual = longest(&lambda, &steps.multipliers);
        // Near the solution for this μ Newton's step is right, even if it violates a curved limit by more than it gains.
        let missed = kkt.missed(&at, &lambda, mu);
        let is_near = missed[0] < CLOSE[0] && missed[1] < CLOSE[1];
        let Some((next, gains)) = at.after(programme, &steps, mu, &mut filter, is_near) else {
            return Err(at.stuck());
        };
        at = next;
        idle = if gains { 0 } else { idle + 1 };
        for (k, (l, d)) in lambda.iter_mut().zip(&steps.multipliers).enumerate() {
            *l += dual * d;
            // Keeps s·λ near μ·weight.
            let center = mu * at.rows[k].weight / at.slacks[k];
            *l = l.clamp(1e-8 * center, 1e8 * center);
        }
    }
}

impl Iterate {
    /// The slacks are still to be set.
    fn new(programme: &MeshProblem, x: Vec<f64>) -> Option<Self> {
        let [terms, rows] = programme.at(&x)?;
        Some(Self {
            x,
            slacks: Vec::new(),
            terms,
            rows,
        })
    }

    fn point(self, multipliers: Vec<f64>) -> PrimalDual {
        PrimalDual {
            x: self.x,
            multipliers,
        }
    }

    fn stuck(&self) -> StuckStation {
        let worst = (self.rows.iter()).max_by(|a, b| a.value.total_cmp(&b.value));
        StuckStation {
            limit: worst.and_then(|row| row.limit),
            station: worst.map_or(0, |row| row.station),
            missed: worst.map_or(0.0, |row| row.value),
        }
    }

    /// The largest value of c + s: the share by which a limit is violated, its slack included.
    pub(super) fn missed(&self) -> f64 {
        let each = self.rows.iter().zip(&self.slacks);
        each.map(|(row, s)| row.value + s).fold(0.0, f64::max)
    }

    /// The two values of the filter: the sum of |c + s|, and the cost with the barrier.
    fn merits(&self, mu: f64) -> [f64; 2] {
        let cost: f64 = self.terms.iter().map(|term| term.value).sum();
        let each = || self.rows.iter().zip(&self.slacks);
        let barrier: f64 = each().map(|(row, s)| mu * row.weight * math::ln(*s)).sum();
        [each().map(|(row, s)| misses(row, *s)).sum(), cost - barrier]
    }

    /// Slope of cost and barrier along a step.
    fn promise(&self, mesh: &Mesh, steps: &Steps, mu: f64) -> f64 {
        let terms = self.terms.iter().map(|term| along(mesh, term, &steps.x));
        let slacks = self.rows.iter().zip(&self.slacks).zip(&steps.slacks);
        terms.sum::<f64>()
            - slacks
                .map(|((row, s), d)| mu * row.weight / s * d)
                .sum::<f64>()
    }

    /// The point after the largest share of a step that is better than all points of the filter; `as_it_is`: after the largest share that keeps
    /// slacks and w positive. Also returns whether anything was gained.
    fn after(
        &self,
        programme: &MeshProblem,
        steps: &Steps,
        mu: f64,
        filter: &mut Vec<[f64; 2]>,
        as_it_is: bool,
    ) -> Option<(Self, bool)> {
        let now = self.merits(mu);
        let slope = self.promise(programme.mesh, steps, mu);
        let mut share =
            longest(&self.slacks, &steps.slacks).min(programme.reach(&self.x, &steps.x));
        for halvings in 0..=HALVINGS {
            let moved = self.x.iter().zip(&steps.x).map(|(x, d)| x + share * d);
            if let Some(mut next) = Self::new(programme, moved.collect()) {
                // A slack that differs from the distance to its limit counts as a violation. Setting it to that distance prevents that a distant
                // limit at a bend of its torque stops every step.
                let slacks = self.slacks.iter().zip(&steps.slacks).zip(&next.rows);
                next.slacks = slacks
                    .map(|((s, d), row)| {
                        let moved = s + share * d;
                        let left = -row.value;
                        if left > KEPT * moved { left } else { moved }
                    })
                    .collect();
                let then = next.merits(mu);
                // Where the violation is small against the expected saving, the cost must fall.
                let is_of_cost = slope < 0.0 && share * slope.powi(2) > now[0];
                let is_gain = if is_of_cost {
                    then[1] <= now[1] + 1e-4 * share * slope + 1e-13 * now[1].abs()
                } else {
                    is_better(then, now)
                };
                let gains = is_gain && filter.iter().all(|old| is_better(then, *old));
                if as_it_is || gains || halvings == HALVINGS {
                    if !is_of_cost {
                        filter.push(now);
                    }
                    if !gains {
                        filter.clear();
                    }
                    return Some((next, as_it_is || gains));
                }
            }
            share *= 0.5;
        }
        None
    }
}

/// Whether a point violates limits less than another, or costs less.
fn is_better(then: [f64; 2], now: [f64; 2]) -> bool {
    then[0] <= (1.0 - FILTER) * now[0] || then[1] <= now[1] - FILTER * now[0] + 1e-13 * now[1].abs()
}

/// |c + s|, or zero if that is only rounding.
fn misses(row: &Term, slack: f64) -> f64 {
    ((row.value + slack).abs() - FEASIBLE).max(0.0)
}

/// The largest share of a step, at most 1, that keeps all values positive.
fn longest(values: &[f64], steps: &[f64]) -> f64 {
    let shares = values.iter().zip(steps).filter(|(_, step)| **step < 0.0);
    shares.fold(1.0, |least: f64, (value, step)| {
        least.min(-INSIDE * value / step)
    })
}
