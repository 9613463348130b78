//! The unknowns, their bounds, and their conversion to bodies and springs.

use jred::machine::Element;
use jred_file::math;
use jred_file::model::machine::MachineFile;
use jred_file::model::with_mass::AttachedMass;

use super::barrier::{Bound, QuadraticProgram};
use super::rows::{DesignMatrix, product};
use super::{BalanceError, BalanceGoal, BalanceRequest, Counterweight, largest};

/// Largest torque of an unknown, in terms of the machine's largest torque: it bounds springs, whose stiffness is otherwise unbounded where
/// they have no effect.
const MOST_TORQUE: f64 = 1e3;

/// Largest free length of a spring, in terms of its longest length.
const MOST_FREE: f64 = 3.0;

/// Share of the goal below which a change is ignored.
const IGNORED_CHANGE: f64 = 1e-5;

/// Gap at which the search ends, as a share of the square (or of the peak) without counterweights and springs.
const GAP: f64 = 1e-13;

/// Excess of a peak over its bound, as a share of the peak without counterweights and springs.
const PEAK_GAP: f64 = 1e-7;

/// Most rounds of a search for the least peak: each adds the samples at which the last result exceeds it.
const MOST_ROUNDS: usize = 100;

/// The goal and the unknowns, each in its own unit.
struct ScaledProblem {
    base: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl ScaledProblem {
    fn values(&self, x: &[f64]) -> Vec<f64> {
        let mut values = self.base.clone();
        for (column, x) in self.columns.iter().zip(x) {
            for (value, entry) in values.iter_mut().zip(column) {
                *value += x * entry;
            }
        }
        values
    }
}

/// Samples above a bound at which the magnitude is a local maximum.
fn highest(values: &[f64], bound: f64) -> Vec<usize> {
    let size = |k: usize| values.get(k).map_or(0.0, |v| v.abs());
    let above = (0..values.len()).filter(|&k| size(k) > bound);
    let tops = above.filter(|&k| size(k) >= size(k.wrapping_sub(1)) && size(k) > size(k + 1));
    tops.collect()
}

/// Penalty for a body as large as allowed, or a spring as stiff as allowed, relative to the torque that it relieves.
const SIZE_PENALTY: f64 = 1e-10;

/// A length below this share of its reference length is residue of the search and becomes zero.
const LENGTH_RESIDUE: f64 = 1e-6;

/// Bodies and springs, in the order of the request; `None`: no body or spring.
pub(super) struct BalanceParts {
    pub(super) masses: Vec<Option<AttachedMass>>,
    pub(super) springs: Vec<Option<Element>>,
}

/// The unknowns and their units: x is p divided by its unit.
pub(super) struct Unknowns<'a> {
    request: &'a BalanceRequest,
    units: Vec<f64>,
    /// Largest free length or free angle of each spring; `None`: unbounded in both directions.
    free: Vec<Option<f64>>,
    springs: Vec<Element>,
}

impl<'a> Unknowns<'a> {
    pub(super) fn new(
        file: &MachineFile,
        request: &'a BalanceRequest,
        rows: &DesignMatrix,
        scale: f64,
    ) -> Result<Self, BalanceError> {
        let most: Vec<f64> = rows.columns.iter().map(|c| largest(c)).collect();
        let bodies = request.counterweights.iter();
        let mut units: Vec<f64> = bodies.flat_map(Counterweight::most).collect();
        for column in &most[units.len()..] {
            units.push(if *column > 0.0 { scale / column } else { 1.0 });
        }
        let effect = most
            .iter()
            .zip(&units)
            .fold(0.0, |m: f64, (c, u)| m.max(c * u));
        if effect <= 1e-9 * scale {
            return Err(BalanceError::NoEffect);
        }
        let found = request.springs.iter().filter_map(|k| file.elements.get(*k));
        let springs: Vec<Element> = found.map(|named| named.element).collect();
        let free = springs.iter().zip(&rows.longest);
        let free = free.map(|(e, longest)| (!e.is_torsional()).then_some(MOST_FREE * longest));
        Ok(Self {
            request,
            units,
            free: free.collect(),
            springs,
        })
    }

    /// The best x, and a lower bound of the minimum in terms of `scale` or its square.
    pub(super) fn least(
        &self,
        goal: BalanceGoal,
        rows: &DesignMatrix,
        scale: f64,
    ) -> (Vec<f64>, f64) {
        let scaled = ScaledProblem {
            base: rows.base.iter().map(|v| v / scale).collect(),
            columns: (rows.columns.iter().zip(&self.units))
                .map(|(column, unit)| column.iter().map(|v| v * unit / scale).collect())
                .collect(),
        };
        match goal {
            BalanceGoal::Peak => self.least_peak(&scaled),
            _ => self.least_squares(&scaled, &rows.weights),
        }
    }

    /// Penalty of each unknown. Of several equal optima it selects the lightest body and the softest spring.
    fn dislike(&self) -> impl Iterator<Item = f64> {
        let bodies = self.request.counterweights.iter();
        let bodies = bodies.flat_map(|_| [SIZE_PENALTY, 0.0, 0.0, SIZE_PENALTY]);
        let springs = self.springs.iter();
        bodies.chain(springs.flat_map(|_| [SIZE_PENALTY / MOST_TORQUE, 0.0]))
    }

    /// Largest possible penalty.
    fn most_disliked(&self) -> f64 {
        SIZE_PENALTY * (2 * self.request.counterweights.len() + self.springs.len()) as f64
    }

    fn least_squares(&self, scaled: &ScaledProblem, weights: &[f64]) -> (Vec<f64>, f64) {
        let (bounds, start) = self.bounds();
        let ScaledProblem { base, columns } = scaled;
        let weighted = |a: &[f64], b: &[f64]| 2.0 * product(weights, a, b);
        let row = |a: &Vec<f64>| columns.iter().map(|b| weighted(a, b)).collect();
        let problem = QuadraticProgram {
            curvature: columns.iter().map(row).collect(),
            slope: (columns
                .iter()
                .map(|c| weighted(c, base))
                .zip(self.dislike()))
            .map(|(slope, dislike)| slope + dislike)
            .collect(),
            bounds,
        };
        let (x, gap) = problem.least(start, GAP);
        // f omits the mean square of the base.
        let least = product(weights, base, base) + problem.value(&x) - gap - self.most_disliked();
        (x, least.max(0.0))
    }

    /// The peak is one more unknown, which no torque may exceed. At first only a few samples are constrained; samples that exceed the peak are added
    /// in rounds. The minimum over some samples is a lower bound for all.
    fn least_peak(&self, scaled: &ScaledProblem) -> (Vec<f64>, f64) {
        let n = self.units.len();
        let (bounds, start) = self.bounds();
        let mut problem = QuadraticProgram {
            curvature: vec![vec![0.0; n + 1]; n + 1],
            slope: self.dislike().collect(),
            bounds,
        };
        problem.slope.push(1.0);
        let (mut best, mut bound) = ((f64::INFINITY, start.clone()), 0.0f64);
        let mut x = start.clone();
        for _ in 0..MOST_ROUNDS {
            let torques = scaled.values(&x);
            let peak = largest(&torques);
            if peak < best.0 {
                best = (peak, x);
            }
            if best.0 <= bound + PEAK_GAP {
                break;
            }
            for k in highest(&torques, bound) {
                let sign = torques[k].signum();
                let columns = scaled.columns.iter().enumerate();
                let mut a: Vec<_> = columns.map(|(j, column)| (j, sign * column[k])).collect();
                a.push((n, -1.0));
                problem
                    .bounds
                    .push(Bound::Linear(-sign * scaled.base[k], a));
            }
            let highest = largest(&scaled.values(&start));
            let mut from = start.clone();
            from.push(1.0 + highest);
            let (found, gap) = problem.least(from, GAP);
            bound = bound.max(problem.value(&found) - gap - self.most_disliked());
            x = found;
            x.truncate(n);
        }
        (best.1, bound)
    }

    /// The bounds of bodies and springs, and a point within them.
    fn bounds(&self) -> (Vec<Bound>, Vec<f64>) {
        let (mut bounds, mut start) = (Vec::new(), Vec::new());
        for _ in &self.request.counterweights {
            let [m, u, v, theta] = [0, 1, 2, 3].map(|k| start.len() + k);
            bounds.push(Bound::Linear(0.0, vec![(m, -1.0)]));
            bounds.push(Bound::Linear(1.0, vec![(m, 1.0)]));
            bounds.push(Bound::Linear(0.0, vec![(m, -1.0), (theta, 1.0)]));
            bounds.push(Bound::Cone([m, u, v, theta]));
            start.extend([0.5, 0.0, 0.0, 0.25]);
        }
        for free in &self.free {
            let [k, product] = [0, 1].map(|k| start.len() + k);
            bounds.push(Bound::Linear(0.0, vec![(k, -1.0)]));
            bounds.push(Bound::Linear(MOST_TORQUE, vec![(k, 1.0)]));
            let [by_k, by_product] = [k, product].map(|k| self.units[k]);
            if let Some(most) = free {
                bounds.push(Bound::Linear(0.0, vec![(product, -1.0)]));
                let longest = most * by_k / by_product;
                bounds.push(Bound::Linear(0.0, vec![(product, 1.0), (k, -longest)]));
                start.extend([0.5, 0.25 * longest]);
            } else {
                bounds.push(Bound::Linear(MOST_TORQUE, vec![(product, 1.0)]));
                bounds.push(Bound::Linear(MOST_TORQUE, vec![(product, -1.0)]));
                start.extend([0.5, 0.0]);
            }
        }
        (bounds, start)
    }

    /// Bodies and springs of a point x.
    pub(super) fn made(
        &self,
        x: &[f64],
        rows: &DesignMatrix,
    ) -> Result<BalanceParts, BalanceError> {
        let p: Vec<f64> = x
            .iter()
            .zip(&self.units)
            .map(|(x, unit)| x * unit)
            .collect();
        let (bodies, springs) = p.split_at(4 * self.request.counterweights.len());
        let counterweights = self
            .request
            .counterweights
            .iter()
            .zip(rows.columns.chunks(4));
        let acts = |columns: &[Vec<f64>], p: &[f64]| {
            let effect = |k: usize| {
                let all = columns.iter().zip(p);
                all.map(|(column, p)| column.get(k).map_or(0.0, |v| v * p))
                    .sum::<f64>()
            };
            let most = (0..rows.base.len()).fold(0.0, |most: f64, k| most.max(effect(k).abs()));
            most > IGNORED_CHANGE * largest(&rows.base)
        };
        let masses = counterweights
            .zip(bodies.chunks(4))
            .map(|((bound, columns), p)| {
                acts(columns, p).then(|| body(bound, columns, p)).flatten()
            });
        let masses = masses.collect();
        let made = |(element, longest): (&Element, &f64), p: &[f64], columns: &[Vec<f64>]| {
            let [k, product] = p else { return Ok(None) };
            if !acts(columns, p) {
                return Ok(None);
            }
            // A free length that is small against the spring is residue of the search.
            let free = product / k;
            let free = if free.abs() < LENGTH_RESIDUE * longest {
                0.0
            } else {
                free
            };
            let between = element.between();
            let spring = if element.is_torsional() {
                Element::torsion_spring(between, *k, free)
            } else {
                Element::spring(between, *k, free)
            };
            Ok::<_, BalanceError>(Some(spring?))
        };
        let pairs = self.springs.iter().zip(&rows.longest);
        let pairs = pairs.zip(springs.chunks(2));
        let pairs = pairs.zip(rows.columns[bodies.len()..].chunks(2));
        Ok(BalanceParts {
            masses,
            springs: pairs
                .map(|((spring, p), columns)| made(spring, p, columns))
                .collect::<Result<_, _>>()?,
        })
    }
}

/// The body with these moments and this inertia. Mass, moments or inertia may have no effect: only the inertia acts on a link that turns about the
/// origin of its frame, only the mass on one that slides. Then it is the lightest body with the other values.
fn body(bound: &Counterweight, columns: &[Vec<f64>], p: &[f64]) -> Option<AttachedMass> {
    let &[mass, along, across, inertia] = p else {
        return None;
    };
    let acts = |k: usize| columns.get(k).is_some_and(|c| c.iter().any(|v| *v != 0.0));
    let (along, across) = if acts(1) || acts(2) {
        (along, across)
    } else {
        (0.0, 0.0)
    };
    let moment = math::hypot(along, across);
    let (mass, inertia) = match (acts(0), acts(3)) {
        (true, true) => (mass, inertia),
        (true, false) => (mass, moment * moment / mass),
        (false, true) => {
            let reach = bound.reach * bound.reach;
            ((moment * moment / inertia).max(inertia / reach), inertia)
        }
        (false, false) => (moment / bound.reach, moment * bound.reach),
    };
    if mass.is_nan() || mass <= 0.0 {
        return None;
    }
    let own = inertia - moment * moment / mass;
    // A coordinate that is small against the reach is residue of the search.
    let coordinate = |moment: f64| {
        let at = moment / mass;
        if at.abs() < LENGTH_RESIDUE * bound.reach {
            0.0
        } else {
            at
        }
    };
    Some(AttachedMass {
        link: bound.link,
        at: [coordinate(along), coordinate(across)],
        mass,
        // The residue of the search at the edge of the cone.
        inertia: if own > 1e-4 * inertia { own } else { 0.0 },
    })
}
