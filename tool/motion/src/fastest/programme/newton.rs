//! Newton's step for the optimality conditions (Karush, Kuhn and Tucker), with slacks and multipliers eliminated.

use super::interior::{Iterate, Term};
use super::mesh::{Local, Mesh, VALUES};
use crate::collocation::pieces::Value;

/// A step of the unknowns, slacks and multipliers.
pub(super) struct Steps {
    pub(super) x: Vec<f64>,
    pub(super) slacks: Vec<f64>,
    pub(super) multipliers: Vec<f64>,
}

/// The slope of a term along a step.
pub(super) fn along(mesh: &Mesh, term: &Term, step: &[f64]) -> f64 {
    let values = &mesh.elements[term.element].values;
    let each = values.iter().zip(term.gradient);
    each.map(|(value, slope)| match value {
        Value::Free(index) => slope * step[*index],
        Value::Fixed(_) => 0.0,
    })
    .sum()
}

/// The gradient of the Lagrangian, and for each unknown the sum of the magnitudes of its terms, the scale of its error.
pub(super) struct Kkt {
    gradient: Vec<f64>,
    size: Vec<f64>,
}

impl Kkt {
    pub(super) fn new(mesh: &Mesh, at: &Iterate, lambda: &[f64]) -> Self {
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

    /// Errors of the gradient and of the limits, and the sum of s·λ divided by the sum of μ·weight.
    pub(super) fn missed(&self, at: &Iterate, lambda: &[f64], mu: f64) -> [f64; 3] {
        let each = self.gradient.iter().zip(&self.size);
        let stationary = each.fold(0.0, |most: f64, (g, size)| most.max(g.abs() / size));
        let gap: f64 = at.slacks.iter().zip(lambda).map(|(s, l)| s * l).sum();
        let aim: f64 = at.rows.iter().map(|row| mu * row.weight).sum();
        [stationary, at.missed(), gap / aim]
    }

    /// Newton's step.
    pub(super) fn steps(
        &self,
        mesh: &Mesh,
        at: &Iterate,
        lambda: &[f64],
        mu: f64,
    ) -> Option<Steps> {
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

    /// The step of the unknowns. If the matrix is not positive definite, negative second derivatives are omitted, then its diagonal is enlarged.
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
                    if bends_down || *factor > 0.0 {
                        add(term.element, *factor, form);
                    }
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
