//! Proofs about a table when it is created: every number stays in its range in a tick.
//!
//! A line is greatest at an end of its cell, and a quadratic stays within its Bézier points, so that the bounds apply everywhere in a cell. They are
//! integers, for arguments −1 … 1, both ends included, and include every rounding of the tick.

use super::row;
use super::{Rows16, row_of};
use crate::curve::curves::{self, has};
use crate::curve::{Table, TableError, Usage};
use crate::number::Kernel;

/// One unit of the upper half of a word.
const UNIT: i64 = 1 << 16;

/// A word as a line: its start and rise over the cell, in units of 2⁻¹⁶ of the upper half's.
fn line(word: u32) -> [i64; 2] {
    [i64::from(word as i32), i64::from(word as i16) << 16]
}

/// The smallest and the largest value of a line in the tick, if within `range`.
fn line_range(word: u32, range: [i64; 2]) -> Option<[i64; 2]> {
    let [start, rise] = line(word);
    let ends = [start >> 16, (start + rise) >> 16];
    let [least, most] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    (least >= range[0] && most <= range[1]).then_some([least, most])
}

/// The Bézier points of a quadratic start + (line + difference·u)·u.
fn bezier(start: i64, word: u32) -> [i64; 3] {
    let [slope, rise] = line(word);
    [start, start + slope / 2, start + slope + rise]
}

fn largest(points: &[i64]) -> i64 {
    points.iter().fold(0, |most, p| most.max(p.abs()))
}

const SIGNED: [i64; 2] = [-32_768, 32_767];

/// The largest size of each quantity in a cell.
#[derive(Clone, Copy)]
struct CellMaxima {
    /// Q16
    inertia: i64,
    /// Q15
    velocity: i64,
    /// Q31
    load: i64,
    /// Q30
    viscous: i64,
    /// Q31
    coulomb: i64,
}

impl CellMaxima {
    /// The largest torque, Q31.
    fn torque(&self) -> i64 {
        // (V·ω + b) is rounded to Q16 by adding half a unit and flooring.
        let of_speed = (((self.velocity << 15) + self.viscous + (1 << 13)) >> 14) + 1;
        // Half a unit of 2⁻¹⁵ is added to round the torque.
        (self.inertia << 15) + (of_speed << 15) + self.load + self.coulomb + (1 << 15)
    }

    fn usage(&self) -> Usage {
        let per_unit = |most: i64, bits: u32| most as f32 / (1u64 << bits) as f32;
        Usage {
            inertia: per_unit(self.inertia, 16),
            velocity: per_unit(self.velocity, 15),
            load: per_unit(self.load, 31),
            viscous: per_unit(self.viscous, 30),
            coulomb: per_unit(self.coulomb, 31),
            torque: per_unit(self.torque(), 31),
        }
    }

    fn of(table: &Table<'_, Rows16>, cell: u32) -> Result<Self, TableError> {
        let set = table.set();
        let constants = table.constants();
        let row = row_of(table, cell);
        let word = |index| row::at(row, index);
        let range = |index: usize| TableError::Range {
            curve: index as u8,
            cell,
        };
        let signed = |index| {
            let range = line_range(word(index), SIGNED).ok_or(range(index))?;
            Ok::<_, TableError>(largest(&range))
        };
        let start = word(row::start(set));

        signed(row::inertia(set))?;
        let points = bezier(i64::from(start), word(row::inertia(set)));
        // The tick's floors subtract up to a unit of Q16.
        if points.iter().any(|p| *p < 2 * UNIT) {
            return Err(TableError::NoInertia { cell });
        }
        let inertia = largest(&points);
        if inertia >= 1 << 32 {
            return Err(range(row::inertia(set)));
        }

        let mut load = 0;
        if has(set, curves::LOAD) {
            signed(0)?;
            load = largest(&bezier(i64::from(start as i16) << 16, word(0))) + UNIT;
        }
        let mut viscous = 0;
        if has(set, curves::VISCOUS) {
            viscous = signed(row::viscous(set))? << 15;
        } else if has(set, curves::CONSTANT_VISCOUS) {
            viscous = i64::from(constants.viscous).abs();
        }
        let mut coulomb = 0;
        if has(set, curves::COULOMB) {
            coulomb = signed(row::coulomb(set))? << 16;
        } else if has(set, curves::CONSTANT_COULOMB) {
            coulomb = i64::from(constants.coulomb).abs();
        }
        Ok(Self {
            inertia: (inertia >> 16) + 1,
            velocity: signed(row::velocity(set))?,
            load,
            viscous,
            coulomb,
        })
    }
}

/// Checks every cell, for [`Table::new`].
pub(super) fn all(table: &Table<'_, Rows16>) -> Result<(), TableError> {
    // Limit of the error of 1/J, in addition to the tick's rounding where J is large.
    const RECIPROCAL: f32 = 0.02;
    let set = table.set();
    for cell in 0..table.cells() {
        if CellMaxima::of(table, cell)?.torque() > i64::from(i32::MAX) {
            return Err(TableError::TorqueRange { cell });
        }
        if has(set, curves::RECIPROCAL) {
            let refused = TableError::Reciprocal { cell };
            let error = reciprocal_error_in(table, cell).ok_or(refused)?;
            if error.is_nan() || error >= RECIPROCAL {
                return Err(refused);
            }
        }
    }
    Ok(())
}

/// A bound on |J·(1/J) − 1| in a cell, by the Bézier points of that cubic; `None` if 1/J is out of range.
fn reciprocal_error_in(table: &Table<'_, Rows16>, cell: u32) -> Option<f32> {
    const UNSIGNED: [i64; 2] = [1, 32_767];
    let set = table.set();
    let row = row_of(table, cell);
    let word = row::at(row, row::reciprocal(set));
    let [least, _] = line_range(word, UNSIGNED)?;
    let unit = match table.constants().shift {
        shift @ 0..=15 => (UNIT << shift) as f32,
        _ => return None,
    };
    let [start, rise] = line(word);
    let [r0, r1] = [start, start + rise].map(|r| r as f32 / unit);
    let points = bezier(
        i64::from(row::at(row, row::start(set))),
        row::at(row, row::inertia(set)),
    );
    let [j0, j1, j2] = points.map(|j| j as f32 / 4_294_967_296.0);
    let product = [
        j0 * r0,
        (j0 * r1 + 2.0 * j1 * r0) / 3.0,
        (2.0 * j1 * r1 + j2 * r0) / 3.0,
        j2 * r1,
    ];
    let off = product
        .iter()
        .fold(0.0f32, |most, p| most.max((p - 1.0).abs()));
    // The tick floors both.
    let smallest = j0.min(j1).min(j2) * 65_536.0;
    Some(off + 1.0 / least as f32 + 1.0 / smallest)
}

/// The largest error of all cells.
pub(super) fn reciprocal_error(table: &Table<'_, Rows16>) -> f32 {
    (0..table.cells())
        .filter_map(|cell| reciprocal_error_in(table, cell))
        .fold(0.0, f32::max)
}

/// Checks that V matches the slope of J in these machine units, except for rounding.
pub(super) fn velocity(table: &Table<'_, Rows16>) -> Result<(), TableError> {
    let (set, span, scale) = (table.set(), table.domain().span(), table.scale());
    let factor = <f32 as Kernel>::velocity_factor(table.cells(), span, scale, 1)
        .ok_or(TableError::SpeedBase)?;
    // Two numbers of J, one of them counted twice, and two of V, each to a unit and a half.
    let limit = 4.5 * factor / 65_536.0 + 3.0 / 32_768.0;
    for cell in 0..table.cells() {
        let row = row_of(table, cell);
        let [slope, twice] = line(row::at(row, row::inertia(set)));
        let [start, rise] = line(row::at(row, row::velocity(set)));
        for (slope, velocity) in [(slope, start), (slope + 2 * twice, start + rise)] {
            let expected = factor * (slope as f32 / 4_294_967_296.0);
            let off = (velocity as f32 / 2_147_483_648.0 - expected).abs();
            if off.is_nan() || off > limit {
                return Err(TableError::Slope { cell });
            }
        }
    }
    Ok(())
}

/// Largest used share of the number range for each quantity of a table.
pub(super) fn usage(table: &Table<'_, Rows16>) -> Usage {
    // Every cell was checked when the table was created.
    (0..table.cells())
        .filter_map(|cell| CellMaxima::of(table, cell).ok())
        .fold(Usage::default(), |all, most| all.or(most.usage()))
}
