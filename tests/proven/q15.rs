//! Q15: random rows of 16 bits.

use super::holds;
use crate::support::budget;
use crate::support::rows::Rows;
use crate::support::scale_of;
use jred::table::RowConstants;
use jred::{Acceleration, CurveSet, Domain, Phase, Q15, Rows16, Speed, curves};

const ALL: CurveSet = curves::ALL;
const CELLS: u32 = 4;
/// Phase, speed, acceleration; then two halves of each word of a row.
const GENES: usize = 3 + 12;

/// A half of up to this many bits and the sign.
fn half(gene: u32, bits: u32) -> u16 {
    (gene.cast_signed() >> (31 - bits)) as u16
}

/// A word as a line: its start and its rise over the cell, in units of its upper half.
fn line(word: u32) -> [f64; 2] {
    let start = f64::from(word.cast_signed()) / 65_536.0;
    [start, f64::from(word as i16)]
}

/// Tick minus exact, in units of 2⁻¹⁵ of the torque base.
fn error(genes: &[u32]) -> Option<f64> {
    let (state, genes) = genes.split_at(3);
    let word = |index: usize, bits: [u32; 2]| {
        let [upper, lower] = [0, 1].map(|k| half(genes[2 * index + k], bits[k]));
        u32::from(upper) << 16 | u32::from(lower)
    };
    let [load, j] = [word(0, [11, 10]), word(1, [12, 11])];
    // V is half of the slope, up to its permitted error.
    let [slope, rise] = line(j).map(|x| 0.5 * x);
    let near = |x: f64, gene: u32| (x as i16).wrapping_add((gene % 7) as i16 - 3) as u16;
    let v = u32::from(near(slope, genes[4])) << 16 | u32::from(near(2.0 * rise, genes[5]));
    let start = word(3, [13, 11]).wrapping_add(1 << 31);
    let [b, c] = [word(4, [11, 10]), word(5, [11, 10])];
    let row = [load, j, v, start, b, c];
    // ½·cells/span is 1.
    let domain = Domain::stroke(0.0, 2.0).unwrap();
    let mut rows = Rows::<Rows16>::plain(row.repeat(CELLS as usize), ALL, CELLS, domain);
    rows.constants = RowConstants::default();
    rows.scale = scale_of(1.0, 1.0, 1.0);
    let model = rows.try_model::<ALL>(&rows.scale).ok()?;
    let place = state[0] >> 16;
    let u = f64::from(place) / 65_536.0;
    let phase = Phase::from_bits(place << 14);
    let [omega, alpha] = [state[1], state[2]].map(|gene| (gene >> 16) as i16);
    let [w, a] = [omega, alpha].map(|x| f64::from(x) / 32_768.0);
    let at = |word: u32| {
        let [start, rise] = line(word);
        start + rise * u
    };
    // J in units of 2⁻¹⁶; half a unit for the last floor is part of the stored load.
    let inertia = f64::from(start) / 65_536.0 + at(j) * u;
    let minus_load = f64::from(start as i16) + at(load) * u - 0.5;
    let torque = inertia * a / 2.0
        + (at(v) * w + at(b)) * w
        + minus_load
        + at(c).abs() * f64::from(omega.signum());
    let (omega, alpha) = (
        Speed::<Q15>::from_bits(omega),
        Acceleration::<Q15>::from_bits(alpha),
    );
    Some(f64::from(model.torque(phase, omega, alpha).to_bits()) - torque)
}

#[test]
fn q15_rows_keep_the_proven_bound() {
    holds("rows in Q15", &budget::Q15_ROWS, 0.0, GENES, error);
}
