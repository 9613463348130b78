//! An interior-point method for a sum of local terms under local limits.
//!
//! ```text
//! minimise Σ f(y)   subject to   c(y) + s = 0,  s ≥ 0
//! ```
//!
//! where each f and c depends on the values y of one piece. Newton's method on the conditions of optimality with s·λ = μ·weight, μ falling
//! to zero; slacks and multipliers are eliminated, so that the matrix has the band of the pieces. What bends a limit downwards is left out
//! of the matrix where it would not be positive definite. The start may violate limits.

use super::mesh::{Local, Mesh, VALUES};
use crate::fastest::field::Binding;
use crate::gentlest::mesh::Value;

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
    pub(super) bends: [(f64, Local); 2],
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
            bends: [(0.0, [0.0; VALUES]); 2],
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

/// Most steps.
const STEPS: u32 = 400;

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

/// Least slack at the start, and as a multiple of μ.
const SLACK: [f64; 2] = [1e-2, 10.0];

/// A point on the way: unknowns, slacks, terms and limits there.
struct Iterate {
    x: Vec<f64>,
    slacks: Vec<f64>,
    terms: Vec<Term>,
    rows: Vec<Term>,
}

/// A step of the unknowns, slacks and multipliers.
struct Steps {
    x: Vec<f64>,
    slacks: Vec<f64>,
    multipliers: Vec<f64>,
}

/// The minimum, from a point, with μ falling from one value to another. `None`: the method does not come to its end.
pub(super) fn minimise(
    programme: &impl Programme,
    start: &[f64],
    [first, last]: [f64; 2],
) -> Option<Point> {
    let mesh = programme.mesh();
    let mut mu = first;
    let mut at = Iterate::new(programme, start.to_vec())?;
    let least = SLACK[0].min(SLACK[1] * first);
    at.slacks = at
        .rows
        .iter()
        .map(|row| row.value.abs().max(least))
        .collect();
    let each = at.rows.iter().zip(&at.slacks);
    let mut lambda: Vec<f64> = each.map(|(row, s)| mu * row.weight / s).collect();
    let mut penalty = 1.0_f64;
    let mut idle = 0;
    for _ in 0..STEPS {
        let kkt = Kkt::new(mesh, &at, &lambda);
        loop {
            let missed = kkt.missed(&at, &lambda, mu);
            let done = mu <= last;
            let enough = if done {
                STATIONARY
            } else {
                (10.0 * mu).clamp(STATIONARY, 0.1)
            };
            if missed[0] > enough || missed[1] > mu.clamp(FEASIBLE, 1e-3) || missed[2] > GAP {
                break;
            }
            if done {
                return Some(at.point(lambda));
            }
            mu = (0.2 * mu).min(mu.powf(1.2)).max(last);
        }
        let steps = kkt.steps(mesh, &at, &lambda, mu)?;
        let dual = longest(&lambda, &steps.multipliers);
        let sums = lambda.iter().zip(&steps.multipliers).map(|(l, d)| l + d);
        let need = sums.fold(0.0, f64::max);
        if penalty < 1.5 * need {
            penalty = 2.0 * need;
        }
        // Near the solution of its μ Newton's step is right even where it bends out of a limit by more than it gains.
        let missed = kkt.missed(&at, &lambda, mu);
        let is_near = missed[0] < CLOSE[0] && missed[1] < CLOSE[1];
        let (next, gains) = at.after(programme, &steps, [mu, penalty], is_near)?;
        at = next;
        idle = if gains { 0 } else { idle + 1 };
        for (k, (l, d)) in lambda.iter_mut().zip(&steps.multipliers).enumerate() {
            *l += dual * d;
            // Not far from s·λ = μ·weight.
            let center = mu * at.rows[k].weight / at.slacks[k];
            *l = l.clamp(1e-8 * center, 1e8 * center);
        }
        if idle >= IDLE {
            if at.missed() > ROUNDED {
                return None;
            }
            if mu <= last {
                return Some(at.point(lambda));
            }
            mu = (0.2 * mu).max(last);
            idle = 0;
        }
    }
    None
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

    /// The largest share by which a limit with its slack is missed.
    fn missed(&self) -> f64 {
        let each = self.rows.iter().zip(&self.slacks);
        each.map(|(row, s)| row.value + s).fold(0.0, f64::max)
    }

    /// Cost, barrier, and what missed limits cost.
    fn merit(&self, [mu, penalty]: [f64; 2]) -> f64 {
        let cost: f64 = self.terms.iter().map(|term| term.value).sum();
        let each = self.rows.iter().zip(&self.slacks);
        let limits = each.map(|(row, s)| penalty * misses(row, *s) - mu * row.weight * s.ln());
        cost + limits.sum::<f64>()
    }

    /// What a step promises to the merit.
    fn promise(&self, mesh: &Mesh, steps: &Steps, [mu, penalty]: [f64; 2]) -> f64 {
        let terms = self.terms.iter().map(|term| along(mesh, term, &steps.x));
        let mut slope: f64 = terms.sum();
        for (k, row) in self.rows.iter().enumerate() {
            let s = self.slacks[k];
            slope -= mu * row.weight / s * steps.slacks[k] + penalty * misses(row, s);
        }
        slope
    }

    /// After as much of a step as lowers the merit, or, if it is taken as it is, as stays inside; and whether anything was gained.
    fn after(
        &self,
        programme: &impl Programme,
        steps: &Steps,
        barrier: [f64; 2],
        as_it_is: bool,
    ) -> Option<(Self, bool)> {
        let now = self.merit(barrier);
        let slope = self.promise(programme.mesh(), steps, barrier);
        let mut share =
            longest(&self.slacks, &steps.slacks).min(programme.reach(&self.x, &steps.x));
        for halvings in 0..=HALVINGS {
            let moved = self.x.iter().zip(&steps.x).map(|(x, d)| x + share * d);
            if let Some(mut next) = Self::new(programme, moved.collect()) {
                // A slack that is smaller than what the limit leaves only slows the method.
                let slacks = self.slacks.iter().zip(&steps.slacks).zip(&next.rows);
                next.slacks = slacks
                    .map(|((s, d), row)| (s + share * d).max(-row.value))
                    .collect();
                let least = now + 1e-4 * share * slope.min(0.0) + 1e-13 * now.abs();
                let gains = as_it_is || next.merit(barrier) <= least;
                if gains || halvings == HALVINGS {
                    return Some((next, gains));
                }
            }
            share *= 0.5;
        }
        None
    }
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

/// The slope of a term along a step.
fn along(mesh: &Mesh, term: &Term, step: &[f64]) -> f64 {
    let values = &mesh.elements[term.element].values;
    let each = values.iter().zip(term.gradient);
    each.map(|(value, slope)| match value {
        Value::Free(index) => slope * step[*index],
        Value::Fixed(_) => 0.0,
    })
    .sum()
}

/// The gradient of Lagrange's function, and what its size is measured by.
struct Kkt {
    gradient: Vec<f64>,
    size: Vec<f64>,
}

impl Kkt {
    fn new(mesh: &Mesh, at: &Iterate, lambda: &[f64]) -> Self {
        let mut own = Self {
            gradient: vec![0.0; mesh.unknowns],
            size: vec![f64::MIN_POSITIVE; mesh.unknowns],
        };
        let all = at.terms.iter().map(|term| (term, 1.0));
        for (term, factor) in all.chain(at.rows.iter().zip(lambda.iter().copied())) {
            let values = &mesh.elements[term.element].values;
            for (value, slope) in values.iter().zip(term.gradient) {
                if let Value::Free(index) = value {
                    own.gradient[*index] += factor * slope;
                    own.size[*index] += (factor * slope).abs();
                }
            }
        }
        own
    }

    /// By how much stationarity and limits are missed, and how often the sum of s·λ is that of μ·weight.
    fn missed(&self, at: &Iterate, lambda: &[f64], mu: f64) -> [f64; 3] {
        let each = self.gradient.iter().zip(&self.size);
        let stationary = each.fold(0.0, |most: f64, (g, size)| most.max(g.abs() / size));
        let gap: f64 = at.slacks.iter().zip(lambda).map(|(s, l)| s * l).sum();
        let aim: f64 = at.rows.iter().map(|row| mu * row.weight).sum();
        [stationary, at.missed(), gap / aim]
    }

    /// Newton's step.
    fn steps(&self, mesh: &Mesh, at: &Iterate, lambda: &[f64], mu: f64) -> Option<Steps> {
        let x = self.step(mesh, at, lambda, mu)?;
        let mut slacks = Vec::with_capacity(at.slacks.len());
        let mut multipliers = Vec::with_capacity(at.slacks.len());
        for ((row, s), l) in at.rows.iter().zip(&at.slacks).zip(lambda) {
            let d = -(row.value + s) - along(mesh, row, &x);
            slacks.push(d);
            multipliers.push(mu * row.weight / s - l - l / s * d);
        }
        Some(Steps {
            x,
            slacks,
            multipliers,
        })
    }

    /// That of the unknowns.
    fn step(&self, mesh: &Mesh, at: &Iterate, lambda: &[f64], mu: f64) -> Option<Vec<f64>> {
        let (rows, s) = (&at.rows, &at.slacks);
        let mut right: Vec<f64> = self.gradient.iter().map(|g| -g).collect();
        for (k, row) in rows.iter().enumerate() {
            let pull = mu * row.weight / s[k] - lambda[k] + lambda[k] / s[k] * (row.value + s[k]);
            let values = &mesh.elements[row.element].values;
            for (value, slope) in values.iter().zip(row.gradient) {
                if let Value::Free(index) = value {
                    right[*index] -= pull * slope;
                }
            }
        }
        let mut stiffness = 0.0;
        let mut bends_down = true;
        loop {
            let mut blocks = vec![[[0.0; VALUES]; VALUES]; mesh.elements.len()];
            let mut add = |element: usize, factor: f64, form: &Local| {
                if factor == 0.0 {
                    return;
                }
                let block = &mut blocks[element];
                for i in 0..VALUES {
                    let own = factor * form[i];
                    for j in 0..=i {
                        block[i][j] += own * form[j];
                    }
                }
            };
            for term in &at.terms {
                for (factor, form) in &term.bends {
                    add(term.element, *factor, form);
                }
            }
            for (k, row) in rows.iter().enumerate() {
                add(row.element, lambda[k] / s[k], &row.gradient);
                for (factor, form) in &row.bends {
                    if bends_down || *factor > 0.0 {
                        add(row.element, lambda[k] * factor, form);
                    }
                }
            }
            let mut matrix = mesh.matrix();
            for (element, block) in mesh.elements.iter().zip(&blocks) {
                for (i, row) in block.iter().enumerate() {
                    for (j, entry) in row.iter().enumerate().take(i + 1) {
                        if let [Value::Free(a), Value::Free(b)] =
                            [element.values[i], element.values[j]]
                        {
                            matrix.add(a, b, *entry);
                        }
                    }
                }
            }
            let diagonal: Vec<f64> = matrix.diagonal().collect();
            for (i, entry) in diagonal.iter().enumerate() {
                matrix.add(i, i, stiffness * entry.abs() + f64::MIN_POSITIVE);
            }
            if let Some((factors, 0)) = matrix.factor() {
                let mut step = right.clone();
                factors.solve(&mut step);
                if step.iter().all(|d| d.is_finite()) {
                    return Some(step);
                }
            }
            if bends_down {
                bends_down = false;
                continue;
            }
            stiffness = (stiffness * 100.0).max(1e-12);
            if stiffness > 1e3 {
                return None;
            }
        }
    }
}
