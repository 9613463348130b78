//! The error of one cell of a table on a part of a stretch.

use jred::table::CellCurves;

use crate::curves::Curves;
use crate::interval::Interval;
use crate::series::REMAINDER;
use crate::taylor_form::TaylorForm;

/// Weight of each curve in a drive torque: J, J′, load, b, c.
pub(crate) const fn weights([omega, alpha]: [f64; 2]) -> [f64; 5] {
    [alpha, 0.5 * omega * omega, 1.0, omega, 1.0]
}

/// A cell's polynomials and the curves of the machine.
pub(crate) struct Difference<'c> {
    pub(crate) curves: &'c Curves,
    pub(crate) cell: &'c CellCurves,
    pub(crate) weights: [f64; 5],
    /// Cells per rad, or m.
    pub(crate) steepness: Interval,
    /// The place of the stretch's middle in the cell, from the centre of its polynomials.
    pub(crate) place: Interval,
}

/// Bounds of the error of the drive torque on a part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// Upper bound everywhere.
    pub(crate) most: f64,
    /// Lower bound in the middle.
    pub(crate) least: f64,
}

impl Difference<'_> {
    /// Bounds between two distances from the middle of the stretch.
    pub(crate) fn bounds(&self, [from, to]: [f64; 2]) -> Bounds {
        let middle = from.midpoint(to);
        let radius = Interval::of(to.max(from) - middle)
            .hull(Interval::of(middle - from))
            .size()
            .next_up();
        let mut bounds = Bounds {
            most: 0.0,
            least: 0.0,
        };
        let (curves, cell) = (self.curves, self.cell);
        let pairs = [
            (&curves.inertia, &cell.inertia),
            (&curves.inertia_slope, &cell.inertia_slope),
            (&curves.load, &cell.load),
            (&curves.viscous, &cell.viscous),
        ];
        let rest = Interval::between(from, to).power(REMAINDER);
        for ((form, polynomial), weight) in pairs.into_iter().zip(self.weights) {
            let exact = shifted(form, middle, rest);
            let found = largest(&exact, &self.polynomial(polynomial, middle), radius);
            bounds.add(found, weight);
        }
        // The tick uses the magnitude of c, and so does the machine: either sign bounds their difference.
        let exact = shifted(&curves.coulomb, middle, rest);
        let table = self.polynomial(&cell.coulomb, middle);
        let [same, other] = [table, table.map(|p| -p)].map(|p| largest(&exact, &p, radius));
        let nearer = Bounds {
            most: same.most.min(other.most),
            least: same.least.min(other.least),
        };
        bounds.add(nearer, self.weights[4]);
        bounds
    }

    /// A polynomial of the cell in powers of the distance from a position.
    fn polynomial(&self, coefficients: &[f64; 4], middle: f64) -> [Interval; 4] {
        let place = self.place + self.steepness * middle;
        // The rounding stated by `CellCurves`.
        let size = coefficients
            .iter()
            .fold(0.0_f64, |most, p| most.max(p.abs()));
        let mut terms = coefficients.map(|p| Interval::around(p, 1e-14 * size));
        shift(&mut terms, place);
        let mut power = Interval::ONE;
        terms.map(|term| {
            let term = term * power;
            power = power * self.steepness;
            term
        })
    }
}

impl Bounds {
    fn add(&mut self, other: Self, weight: f64) {
        self.most = (self.most + (other.most * weight).next_up()).next_up();
        self.least = (self.least + other.least * weight) * (1.0 - 1e-15);
    }
}

/// Σ aₖ·(x + t)ᵏ as a polynomial in t.
fn shift(terms: &mut [Interval], x: Interval) {
    for first in 0..terms.len() {
        for k in (first..terms.len() - 1).rev() {
            terms[k] = terms[k] + terms[k + 1] * x;
        }
    }
}

/// A form in powers of the distance from a position, with its remainder in the first coefficient.
fn shifted(form: &TaylorForm, middle: f64, rest: Interval) -> [Interval; REMAINDER] {
    let mut terms = [Interval::ZERO; REMAINDER];
    terms.copy_from_slice(&form.at.0[..REMAINDER]);
    shift(&mut terms, Interval::of(middle));
    terms[0] = terms[0] + form.over.0[REMAINDER] * rest;
    terms
}

/// The largest difference of two polynomials within `radius` of their centre.
fn largest(exact: &[Interval; REMAINDER], table: &[Interval; 4], radius: f64) -> Bounds {
    let difference = |k: usize| exact[k] - table.get(k).copied().unwrap_or_default();
    let middle = difference(0);
    let radius = Interval::of(radius);
    let (mut sum, mut power) = (Interval::of(middle.size()), Interval::ONE);
    for k in 1..REMAINDER {
        power = power * radius;
        sum = sum + Interval::of(difference(k).size()) * power;
    }
    Bounds {
        most: sum.hi(),
        least: middle.least_size(),
    }
}
