//! Q31: random words of one cell, of each format.

use super::holds;
use crate::support::budget::{self, Proven, Q31_UNIT};
use crate::support::exact::place_bits;
use crate::support::rows::{Fixed, Rows};
use crate::support::scale_of;
use jred::{Acceleration, Cubic, CurveSet, Domain, Phase, Q31, Quadratic, Speed, Spline, curves};

const ALL: CurveSet = curves::ALL;
const CELLS: u32 = 4;
/// Phase, speed, acceleration; then up to four words of each of four curves.
const GENES: usize = 3 + 16;

/// A word of a curve of up to this many bits.
fn word(gene: u32, bits: u32) -> i32 {
    gene.cast_signed() >> (31 - bits)
}

/// The first cell's words; the other cells are valid.
fn words<L: Fixed>(genes: &[u32]) -> Vec<i32> {
    let part = |curve: usize, k: usize| genes[4 * curve + k];
    match L::NAME {
        "spline" => (0..CELLS as usize + 3)
            .flat_map(|row| (0..4).map(move |curve| word(part(curve, row.min(3)), 24)))
            .collect(),
        name => {
            let count = if name == "cubic" { 4 } else { 3 };
            let row = (0..4 * count).map(|index| {
                let (curve, k) = (index / count, index % count);
                let middle = if index == 0 { 1 << 28 } else { 0 };
                middle + word(part(curve, k), 26)
            });
            row.collect::<Vec<_>>().repeat(CELLS as usize)
        }
    }
}

/// Tick minus exact, in units of 2⁻³¹ of the torque base.
fn error<L: Fixed>(genes: &[u32], whole: f64) -> Option<f64> {
    let domain = Domain::stroke(0.0, 2.0).unwrap();
    let (state, genes) = genes.split_at(3);
    let mut rows = Rows::<L>::plain(words::<L>(genes), ALL, CELLS, domain);
    // ½·cells/span is 1.
    rows.scale = scale_of(1.0, 1.0, whole as f32);
    if L::NAME == "spline" {
        rows.constants.inertia = 1 << 28;
    }
    let model = rows.try_model::<ALL>(&rows.scale).ok()?;
    let phase = Phase::from_bits(state[0] / CELLS);
    let [omega, alpha] = [state[1], state[2]].map(u32::cast_signed);
    let (speed, acceleration) = (
        Speed::<Q31>::from_bits(omega),
        Acceleration::<Q31>::from_bits(alpha),
    );
    let found = model.torque(phase, speed, acceleration).to_bits();
    let exact = rows.exact(phase, place_bits::<L>());
    let [w, a] = [omega, alpha].map(|x| f64::from(x) * Q31_UNIT);
    let torque = exact.inertia * a + (whole * exact.inertia_slope * w + exact.viscous) * w
        - exact.load
        + exact.coulomb * f64::from(omega.signum());
    Some(f64::from(found) - torque / Q31_UNIT)
}

fn keeps<L: Fixed>(proven: &Proven) {
    for whole in [1.0, 3.0] {
        let what = format!("{} in Q31, {whole}", L::NAME);
        holds(&what, proven, whole, GENES, |genes| {
            error::<L>(genes, whole)
        });
    }
}

#[test]
fn q31_spline_keeps_the_proven_bound() {
    keeps::<Spline<Q31>>(&budget::Q31_SPLINE);
}

#[test]
fn q31_cubic_keeps_the_proven_bound() {
    keeps::<Cubic<Q31>>(&budget::Q31_CUBIC);
}

#[test]
fn q31_quadratic_keeps_the_proven_bound() {
    keeps::<Quadratic<Q31>>(&budget::Q31_QUADRATIC);
}
