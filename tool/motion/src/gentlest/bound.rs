//! A lower bound for all motions, by a verification function.
//!
//! For any functions P(u) and C(u) with P = C = 0 at ends at rest, and V = P·w + C·√w, every motion satisfies
//!
//! ```text
//! ∫ h(u, w, w′) du ≥ ∫ inf over w > 0, w′ of [h + λ/√w − dV/du] du − λ·T + V(1) − V(0),   dV/du = P′·w + C′·√w + (P + C/(2√w))·w′
//! ```
//!
//! because λ·∫du/√w = λ·T, and ∫dV/du du is known. This needs no convexity. Equality needs the right P, which at the optimum is the derivative of h
//! by w′: it is taken from the solution. C is free; with C = 0 the bound is that of the dual problem in the convex case. Where λ < 0, as with a
//! weight that must be held, C from the holding torque makes the bound finite. The integral uses the mesh. The infimum is over straight lines in w′,
//! with a search over w in a range of speeds of 1 : 10,000.

use jred_file::math;
use std::convert::Infallible;

use jred_file::number::numerics::golden_section;
use jred_file::number::quadrature::GAUSS_5;

use super::Fault;
use super::mesh::Mesh;
use super::solve::{Minimum, Problem, pace_at};
use crate::collocation::torque::Torque;
use pieces::pieces;

mod pieces;

/// Ends and thirds of an element, at which C is evaluated.
const THIRDS: [f64; 4] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];

/// w is searched from this share of the motion's own w up to its inverse, in n steps per power of ten.
const RANGE: i32 = 4;
const STEPS: i32 = 4;

/// Steps of the search by the golden section.
const GOLDEN: u32 = 40;

/// Share of the cost below which a gap cannot be closed further, because of the quadrature and the search over w.
const GAP_RESOLUTION: f64 = 1e-9;

/// A cost of this size, in the units of the problem, is rounding error.
const COST_ROUNDING: f64 = 1e-20;

/// The best of the bounds, in the units of the problem. The bound is of the exact problem, P of the one with rounded bends. `price` is λ: the
/// multiplier found, or the saving by waiting. `None` if the result exceeds the motion's own `cost`, and so is not a bound.
pub(super) fn value(
    problems: [&Problem; 2],
    found: &Minimum,
    cost: f64,
    price: f64,
) -> Result<Option<f64>, Fault> {
    let close = GAP_RESOLUTION * cost + COST_ROUNDING;
    let plain = with(problems, found, price, 0.0)?;
    if plain > cost + close {
        return Ok(None);
    }
    if plain >= cost - close {
        return Ok(Some(plain));
    }
    // With C the integral of dV/du also uses the mesh; where that is too coarse, the bound without C is left.
    let held = with(problems, found, price, 1.0)?;
    Ok(Some(if held > cost + close {
        plain
    } else {
        plain.max(held)
    }))
}

/// P and P′ at every station: P′ from stationarity, and P its integral. Over a whole move the integral closes, because the solution is stationary.
fn integrated(problem: &Problem, found: &Minimum) -> Vec<[f64; 2]> {
    let mesh = problem.mesh;
    let mut all = Vec::with_capacity(mesh.stations.len());
    let (mut before, mut missed) = (0.0, 0.0);
    for (index, element) in mesh.elements.iter().enumerate() {
        let h = element.span[1] - element.span[0];
        let mut slopes = [0.0; GAUSS_5.len()];
        let first = index * GAUSS_5.len();
        let mut own = [0.0; GAUSS_5.len()];
        for (k, slope) in slopes.iter_mut().enumerate() {
            [*slope, own[k]] = problem.pull(&found.x, first + k, found.multiplier);
        }
        for (k, [z, weight]) in GAUSS_5.into_iter().enumerate() {
            let p = before + h * integral(&slopes, z);
            missed += weight * h * (own[k] - p);
            all.push([p, slopes[k]]);
        }
        before += h * integral(&slopes, 1.0);
    }
    // At an end at rest P is zero, elsewhere it is the best fit. The remainder at the other end is rounding, and is spread over the path.
    let [starts, stops] = rests(mesh);
    if stops || mesh.is_ring() {
        for ([p, slope], station) in all.iter_mut().zip(&mesh.stations) {
            *p -= before
                * if starts || mesh.is_ring() {
                    station.u
                } else {
                    1.0
                };
            *slope -= before * f64::from(u8::from(starts || mesh.is_ring()));
        }
    }
    if mesh.is_ring() || !(starts || stops) {
        for [p, _] in &mut all {
            *p += missed;
        }
    }
    all
}

/// Which ends are at rest.
fn rests(mesh: &Mesh) -> [bool; 2] {
    [0.0, 1.0].map(|u| mesh.shape.at(u)[1].abs() < 1e-12)
}

/// The integral from 0 to z of the polynomial through values at Gauss points of (0, 1).
fn integral(values: &[f64; GAUSS_5.len()], z: f64) -> f64 {
    let mut sum = 0.0;
    for (k, [at, _]) in GAUSS_5.into_iter().enumerate() {
        // Coefficients of Lagrange's polynomial.
        let mut terms = [0.0; GAUSS_5.len()];
        terms[0] = 1.0;
        let mut size = 1.0;
        let others = GAUSS_5.into_iter().enumerate().filter(|(j, _)| *j != k);
        for (degree, (_, [other, _])) in others.enumerate() {
            for i in (0..=degree + 1).rev() {
                let lower = if i > 0 { terms[i - 1] } else { 0.0 };
                let own = if i <= degree { terms[i] } else { 0.0 };
                terms[i] = lower - other * own;
            }
            size *= at - other;
        }
        let mut power = z;
        for (degree, term) in terms.into_iter().enumerate() {
            sum += values[k] * term / size * power / (degree + 1) as f64;
            power *= z;
        }
    }
    sum
}

/// The bound with C from a share of the torque at rest.
fn with(
    [problem, rounded]: [&Problem; 2],
    found: &Minimum,
    price: f64,
    held: f64,
) -> Result<f64, Fault> {
    let mesh = problem.mesh;
    let last = mesh.elements.len() - 1;
    let mut all = vec![[0.0; 4]; last + 1];
    if held != 0.0 {
        for (index, element) in mesh.elements.iter().enumerate() {
            let [from, to] = element.span;
            for (k, z) in THIRDS.into_iter().enumerate() {
                // Evaluated inside, so that the load is that of the element.
                let u = from + (to - from) * z.clamp(1e-9, 1.0 - 1e-9);
                all[index][k] = held * of_rest(problem, u)?;
            }
        }
        // C is continuous, and zero at rest.
        for k in 0..last {
            let middle = 0.5 * (all[k][3] + all[k + 1][0]);
            (all[k][3], all[k + 1][0]) = (middle, middle);
        }
        let ends = if mesh.is_ring() {
            0.5 * (all[last][3] + all[0][0])
        } else {
            0.0
        };
        let [starts, stops] = rests(mesh);
        if starts || mesh.is_ring() {
            all[0][0] = ends;
        }
        if stops || mesh.is_ring() {
            all[last][3] = ends;
        }
    }
    let p = integrated(rounded, found);
    let mut sum = -price;
    for (index, (element, own)) in mesh.elements.iter().zip(&all).enumerate() {
        let [from, to] = element.span;
        let h = to - from;
        for (k, [z, _]) in GAUSS_5.into_iter().enumerate() {
            let station = index * GAUSS_5.len() + k;
            let [c, c1] = cubic(own, z, h);
            let [w, change] = mesh.pace(&found.x, &mesh.stations[station]);
            let root = w.sqrt();
            let [p, p1] = p[station];
            let line = StationBound {
                p: p - c / (2.0 * root),
                p1: p1 - c1 / (2.0 * root) + c * change / (4.0 * w * root),
                c,
                c1,
                multiplier: price,
            };
            let least = line.least(problem, &found.x, station);
            sum += mesh.stations[station].weight * least;
        }
    }
    // V at the ends: the part of P·w from C cancels half of C·√w.
    if !mesh.is_ring() {
        let at = |index: usize, u: f64, p: f64, k: usize| {
            let [w, ..] = pace_at(mesh, &found.x, index, u);
            p * w + 0.5 * all[index][k] * w.sqrt()
        };
        let [first, end] = ends_of(rounded, found, &p);
        let [starts, stops] = rests(mesh);
        if !stops {
            sum += at(last, 1.0, end, 3);
        }
        if !starts {
            sum -= at(0, 0.0, first, 0);
        }
    }
    Ok(if sum.is_nan() { f64::NEG_INFINITY } else { sum })
}

/// P at both ends.
fn ends_of(problem: &Problem, found: &Minimum, p: &[[f64; 2]]) -> [f64; 2] {
    let mesh = problem.mesh;
    let count = GAUSS_5.len();
    let part = |element: usize, z: f64| {
        let [from, to] = mesh.elements[element].span;
        let mut slopes = [0.0; GAUSS_5.len()];
        for (k, slope) in slopes.iter_mut().enumerate() {
            *slope = problem.pull(&found.x, element * count + k, found.multiplier)[0];
        }
        (to - from) * integral(&slopes, z)
    };
    let last = mesh.elements.len() - 1;
    let first = p[0][0] - part(0, GAUSS_5[0][0]);
    let end = p[last * count][0] + part(last, 1.0) - part(last, GAUSS_5[0][0]);
    [first, end]
}

/// The cubic through values at the thirds of an element of length h, and its derivative.
fn cubic(values: &[f64; 4], z: f64, h: f64) -> [f64; 2] {
    let [mut value, mut slope] = [0.0; 2];
    for (k, at) in THIRDS.into_iter().enumerate() {
        let (mut product, mut change) = (1.0, 0.0);
        for (_, other) in THIRDS.into_iter().enumerate().filter(|(j, _)| *j != k) {
            let part = (z - other) / (at - other);
            change = change * part + product / (at - other);
            product *= part;
        }
        value += values[k] * product;
        slope += values[k] * change;
    }
    [value, slope / h]
}

/// C from the holding torque at rest.
fn of_rest(problem: &Problem, u: f64) -> Result<f64, Fault> {
    let [g, slope, _] = problem.mesh.shape.at(u);
    let place = problem.place(g)?;
    let rest = Torque::exact(problem.dynamics, &place, 0.0, 0.0);
    let by_change = rest.by_acceleration * 0.5 * slope * problem.length
        / (problem.duration * problem.duration * problem.unit);
    let [_, at_rest, _] = problem.cost.torque(rest.value / problem.unit);
    Ok(2.0 * at_rest * by_change)
}

/// V and its change at a station.
struct StationBound {
    p: f64,
    p1: f64,
    c: f64,
    c1: f64,
    multiplier: f64,
}

impl StationBound {
    /// The infimum over all w and w′.
    fn least(&self, problem: &Problem, x: &[f64], station: usize) -> f64 {
        let [own, _] = problem.mesh.pace(x, &problem.mesh.stations[station]);
        let at = |power: f64| self.over_change(problem, station, own * math::pow(10.0, power));
        let (mut best, mut least) = (0, at(0.0));
        for k in -RANGE * STEPS..=RANGE * STEPS {
            let value = at(f64::from(k) / f64::from(STEPS));
            if value < least || value.is_nan() {
                (best, least) = (k, value);
            }
        }
        let place = |k: i32| f64::from(k) / f64::from(STEPS);
        let around = [place(best - 1), place(best + 1)];
        let sure = |power: f64| Ok::<_, Infallible>(at(power));
        let Ok([a, b]) = golden_section(sure, around, GOLDEN, |a, b| a < b, |_, _| false);
        least.min(a.1).min(b.1)
    }

    /// The infimum over w′ at a w.
    fn over_change(&self, problem: &Problem, station: usize, w: f64) -> f64 {
        let station = &problem.mesh.stations[station];
        let root = w.sqrt();
        let factor = self.p + self.c / (2.0 * root);
        let t2 = problem.duration * problem.duration;
        // a = free + per·w′
        let [slope, bend] = station.path;
        let (free, per) = (bend * w / t2, 0.5 * slope / t2);
        let speed = slope * root / problem.duration;
        let cost = |tau: f64| {
            let [c, ..] = problem.cost.torque(tau);
            let [m, ..] = problem.cost.drawn(tau);
            c / root + problem.cost.drawn * m * slope
        };
        // Over a: h − factor·(a − free)/per, in straight pieces of τ = start + rise·(a − at).
        let price = factor / per;
        let pieces = pieces(problem, &station.place, speed);
        let mut least = f64::INFINITY;
        for piece in pieces.iter() {
            if piece.rise.is_nan() {
                return f64::NEG_INFINITY;
            }
            let by_torque = price / piece.rise;
            // Stationary points with and without drawn power, and the point where the two meet.
            let quiet = 0.5 * by_torque * root;
            let drawing = 0.5 * (by_torque - problem.cost.drawn * slope) * root;
            for tau in [quiet.min(0.0), drawing.max(0.0), 0.0, quiet] {
                // A piece as short as a rounding error may end before it begins.
                let tau = tau.max(piece.torques[0]).min(piece.torques[1]);
                let a = piece.at + (tau - piece.start) / piece.rise;
                least = least.min(cost(tau) - price * (a - free));
            }
        }
        least + self.multiplier / root - self.p1 * w - self.c1 * root
    }
}
