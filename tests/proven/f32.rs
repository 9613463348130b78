//! Single precision: random words of one cell, of each format with cells, within the ranges of the proof.

use super::holds;
use crate::support::budget::{self, Proven};
use crate::support::rows::Rows;
use crate::support::scale_of;
use jred::table::{Constants, Format};
use jred::{Cubic, CurveSet, Domain, Phase, Quadratic, Spline, curves};

const ALL: CurveSet = curves::ALL;
const CELLS: u32 = 4;
/// Phase, speed, acceleration, factor, mean of J; then up to four words of each of four curves.
const GENES: usize = 5 + 16;

/// A number from −1 to 1.
fn one(gene: u32) -> f32 {
    f64::from(gene.cast_signed()) as f32 / 2_147_483_648.0
}

/// Tick minus exact, in units of 2⁻²⁴.
fn error<F>(genes: &[u32]) -> Option<f64>
where
    F: Format<Number = f32, Word = f32, Constants = Constants<f32>>,
{
    let (state, genes) = genes.split_at(5);
    let part = |curve: usize, k: usize| one(genes[4 * curve + k]);
    let words = match F::NAME {
        "spline" => (0..CELLS as usize + 3)
            .flat_map(|row| (0..4).map(move |curve| part(curve, row.min(3)) / 8.0))
            .collect(),
        name => {
            let count = if name == "cubic" { 4 } else { 3 };
            let row = (0..4 * count).map(|index| part(index / count, index % count));
            row.collect::<Vec<_>>().repeat(CELLS as usize)
        }
    };
    let mut rows = Rows::<F>::plain(words, ALL, CELLS, Domain::stroke(0.0, 2.0).unwrap());
    if F::NAME == "spline" {
        rows.constants.inertia = one(state[4] >> 1);
    }
    // ½·cells/span is 1.
    let factor = one(state[3] >> 1);
    if factor <= 0.0 {
        return None;
    }
    rows.scale = scale_of(1.0, 1.0, factor);
    let model = rows.try_model::<ALL>(&rows.scale).ok()?;
    // A position of 24 bits in the first cell.
    let phase = Phase::from_bits((state[0] & !0xff) / CELLS);
    let [omega, alpha] = [state[1], state[2]].map(one);
    let found = model.torque(phase, omega, alpha);
    let exact = rows.exact(phase, !0);
    let [w, a] = [omega, alpha].map(f64::from);
    let sign = if w == 0.0 { 0.0 } else { w.signum() };
    let torque = exact.inertia * a
        + (f64::from(factor) * exact.inertia_slope * w + exact.viscous) * w
        - exact.load
        + exact.coulomb * sign;
    Some((f64::from(found) - torque) * 16_777_216.0)
}

fn keeps<F>(proven: &Proven)
where
    F: Format<Number = f32, Word = f32, Constants = Constants<f32>>,
{
    let what = format!("{} in f32", F::NAME);
    holds(&what, proven, 0.0, GENES, error::<F>);
}

#[test]
fn f32_spline_keeps_the_proven_bound() {
    keeps::<Spline<f32>>(&budget::F32_SPLINE);
}

#[test]
fn f32_rows_keep_the_proven_bound() {
    keeps::<Cubic<f32>>(&budget::F32_ROWS);
    keeps::<Quadratic<f32>>(&budget::F32_ROWS);
}
