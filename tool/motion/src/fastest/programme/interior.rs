//! An interior-point method for a sum of local terms under local limits.
//!
//! ```text
//! minimise Σ f(y)   subject to   c(y) + s = 0,  s ≥ 0
//! ```
//!
//! where each f and c depends on the values y of one piece. Newton's method on the conditions of optimality with s·λ = μ·weight, μ falling
//! to zero; slacks and multipliers are eliminated, so that the matrix has the band of the pieces. What bends downwards is left out
//! of the matrix where it would not be positive definite. A step is as long as it leads to a point that misses limits less, or costs less, than
//! each point before (a filter; Fletcher and Leyffer, 2002). The start may violate limits.

use super::mesh::{Local, Mesh, VALUES};
use super::newton::{Kkt, Steps, along};
use crate::fastest::field::Binding;

/// A function of the values of one piece at a point.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) element: usize,
    /// Which limit it is, and at which station.
    pub(super) limit: Option<Binding>,
    pub(super) station: usize,
    pub(super) value: f64,
    pub(super) gradient: Local,
    /// Second derivatives as factors of squares of linear forms.
    pub(super) bends: [(f64, Local); 4],
    /// Share in the barrier.
    pub(super) weight: f64,
}

impl Term {
    /// Zero everywhere.
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

/// What is minimised.
pub(super) trait Programme {
    /// The pieces.
    fn mesh(&self) -> &Mesh;
    /// Terms of the objective and limits at a point; always the same in number. `None`: the point means no motion.
    fn at(&self, x: &[f64]) -> Option<[Vec<Term>; 2]>;
    /// The largest share of a step that leaves a motion.
    fn reach(&self, x: &[f64], step: &[f64]) -> f64;
}

/// A point with slacks and multipliers of the limits.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) x: Vec<f64>,
    pub(super) multipliers: Vec<f64>,
}

/// Most steps with one μ.
const STEPS: u32 = 80;

/// Shares by which stationarity and limits may be missed after so many.
const BENT: [f64; 2] = [1e-2, 1e-6];

/// Most halvings of a step.
const HALVINGS: u32 = 30;

/// Share of the way to a limit that a step goes at most.
const INSIDE: f64 = 0.995;

/// Share by which conditions of optimality, and limits, may be missed at the end.
const STATIONARY: f64 = 1e-6;
const FEASIBLE: f64 = 1e-9;

/// Shares by which stationarity and limits are missed where Newton's step is taken as it is.
const CLOSE: [f64; 2] = [1e-3, 1e-6];

/// How often the sum of s·λ may be the one that is aimed at before μ falls.
const GAP: f64 = 2.0;

/// Steps that gain nothing, after which a point that misses limits by less than a share is the best that rounding leaves.
const IDLE: u32 = 3;
const ROUNDED: f64 = 1e-8;

/// Share of what limits are missed by that a step must gain.
const FILTER: f64 = 1e-5;

/// Share of a slack that its limit must leave for the slack to become what the limit leaves.
const KEPT: f64 = 0.1;

/// Least slack at the start, and as a multiple of μ.
const SLACK: [f64; 2] = [1e-2, 10.0];

/// A point on the way: unknowns, slacks, terms and limits there.
pub(super) struct Iterate {
    pub(super) x: Vec<f64>,
    pub(super) slacks: Vec<f64>,
    pub(super) terms: Vec<Term>,
    pub(super) rows: Vec<Term>,
}

/// Where the method came to no end: the limit that is missed most there, at which station and by which share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stuck {
    pub(super) limit: Option<Binding>,
    pub(super) station: usize,
    pub(super) missed: f64,
}

/// The minimum, from a point, with μ falling from one value to another.
///
/// # Errors
/// The method does not come to its end.
pub(super) fn minimise(
    programme: &impl Programme,
    start: &[f64],
    [first, last]: [f64; 2],
) -> Result<Point, Stuck> {
    let mesh = programme.mesh();
    let mut mu = first;
    let nowhere = Stuck {
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
            // Where a torque bends the gradient jumps: steps across the bend lead nowhere, and what is left there is small.
            let is_bent = steps_of_mu >= STEPS && missed[0] < BENT[0] && missed[1] < BENT[1];
            if !(is_rounded || is_bent)
                && (missed[0] > enough || missed[1] > mu.clamp(FEASIBLE, 1e-3) || missed[2] > GAP)
            {
                break;
            }
            if done {
                return Ok(at.point(lambda));
            }
            mu = (0.2 * mu).min(mu.powf(1.2)).max(last);
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
        // Near the solution of its μ Newton's step is right even where it bends out of a limit by more than it gains.
        let missed = kkt.missed(&at, &lambda, mu);
        let is_near = missed[0] < CLOSE[0] && missed[1] < CLOSE[1];
        let Some((next, gains)) = at.after(programme, &steps, mu, &mut filter, is_near) else {
            return Err(at.stuck());
        };
        at = next;
        idle = if gains { 0 } else { idle + 1 };
        for (k, (l, d)) in lambda.iter_mut().zip(&steps.multipliers).enumerate() {
            *l += dual * d;
            // Not far from s·λ = μ·weight.
            let center = mu * at.rows[k].weight / at.slacks[k];
            *l = l.clamp(1e-8 * center, 1e8 * center);
        }
    }
}

impl Iterate {
    /// With slacks that are still to be set.
    fn new(programme: &impl Programme, x: Vec<f64>) -> Option<Self> {
        let [terms, rows] = programme.at(&x)?;
        Some(Self {
            x,
            slacks: Vec::new(),
            terms,
            rows,
        })
    }

    fn point(self, multipliers: Vec<f64>) -> Point {
        Point {
            x: self.x,
            multipliers,
        }
    }

    fn stuck(&self) -> Stuck {
        let worst = (self.rows.iter()).max_by(|a, b| a.value.total_cmp(&b.value));
        Stuck {
            limit: worst.and_then(|row| row.limit),
            station: worst.map_or(0, |row| row.station),
            missed: worst.map_or(0.0, |row| row.value),
        }
    }

    /// The largest share by which a limit with its slack is missed.
    pub(super) fn missed(&self) -> f64 {
        let each = self.rows.iter().zip(&self.slacks);
        each.map(|(row, s)| row.value + s).fold(0.0, f64::max)
    }

    /// By how much limits with their slacks are missed, and cost with barrier.
    fn merits(&self, mu: f64) -> [f64; 2] {
        let cost: f64 = self.terms.iter().map(|term| term.value).sum();
        let each = || self.rows.iter().zip(&self.slacks);
        let barrier: f64 = each().map(|(row, s)| mu * row.weight * s.ln()).sum();
        [each().map(|(row, s)| misses(row, *s)).sum(), cost - barrier]
    }

    /// What a step promises to cost and barrier.
    fn promise(&self, mesh: &Mesh, steps: &Steps, mu: f64) -> f64 {
        let terms = self.terms.iter().map(|term| along(mesh, term, &steps.x));
        let slacks = self.rows.iter().zip(&self.slacks).zip(&steps.slacks);
        terms.sum::<f64>()
            - slacks
                .map(|((row, s), d)| mu * row.weight / s * d)
                .sum::<f64>()
    }

    /// After as much of a step as is better than all points of the filter, or, if it is taken as it is, as stays inside; and whether anything
    /// was gained.
    fn after(
        &self,
        programme: &impl Programme,
        steps: &Steps,
        mu: f64,
        filter: &mut Vec<[f64; 2]>,
        as_it_is: bool,
    ) -> Option<(Self, bool)> {
        let now = self.merits(mu);
        let slope = self.promise(programme.mesh(), steps, mu);
        let mut share =
            longest(&self.slacks, &steps.slacks).min(programme.reach(&self.x, &steps.x));
        for halvings in 0..=HALVINGS {
            let moved = self.x.iter().zip(&steps.x).map(|(x, d)| x + share * d);
            if let Some(mut next) = Self::new(programme, moved.collect()) {
                // A slack that differs from what its limit leaves counts as a limit that is missed. It becomes what is left, or a limit that is far
                // away, and whose torque bends, would stop every step.
                let slacks = self.slacks.iter().zip(&steps.slacks).zip(&next.rows);
                next.slacks = slacks
                    .map(|((s, d), row)| {
                        let moved = s + share * d;
                        let left = -row.value;
                        if left > KEPT * moved { left } else { moved }
                    })
                    .collect();
                let then = next.merits(mu);
                // Where the step promises much of the cost against what is missed, the cost must fall.
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

/// Whether a point misses limits less than another, or costs less.
fn is_better(then: [f64; 2], now: [f64; 2]) -> bool {
    then[0] <= (1.0 - FILTER) * now[0] || then[1] <= now[1] - FILTER * now[0] + 1e-13 * now[1].abs()
}

/// By how much a limit with its slack is missed; less than what rounding leaves is nothing.
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
