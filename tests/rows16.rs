//! Tables and ticks in 16 bits.

mod image;
mod integer;
mod number;
mod press;
mod read;
mod refused;
mod tick;

use crate::support::rows::Rows;
use jred::number::Quantity;
use jred::table::{CurveValues, Table};
use jred::{CurveSet, Model, Q15, Rows16, Scale, curves};

type Short = Rows<Rows16>;

/// Everything with curves.
const EVERY: CurveSet = curves::ALL | curves::RECIPROCAL;
/// Everything with constants.
const CONSTANT: CurveSet =
    curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB | curves::RECIPROCAL;

fn model<const SET: CurveSet>(rows: &Short) -> Model<'_, Rows16, SET> {
    rows.model(&rows.scale)
}

/// Words of a row.
const fn row_words(set: CurveSet) -> usize {
    jred::table::words_len::<Rows16>(1, set)
}

/// V from a table's values.
fn velocity(read: &CurveValues, scale: &Scale) -> f64 {
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    0.5 * read.inertia_slope * inertia * speed * speed / torque
}

/// The values of a table.
fn read_at(table: &Table<'_, Rows16>, phase: jred::Phase) -> [f64; 6] {
    let found = table.at(phase);
    [
        found.inertia,
        velocity(&found, table.scale()),
        found.load,
        found.viscous,
        found.coulomb,
        table.reciprocal(phase).unwrap_or(0.0),
    ]
}

/// Units of 2⁻¹⁵.
fn units(quantity: impl Quantity<Number = Q15>) -> f64 {
    f64::from(quantity.number().to_bits())
}

fn q15<Q: Quantity<Number = Q15>>(bits: i16) -> Q {
    Q::of(Q15::from_bits(bits))
}
