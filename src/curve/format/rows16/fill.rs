//! Fills the rows of a table.

use super::row::{self, word};
use super::{RowConstants, fit};
use crate::curve::curves::{self, CurveSet, has};
use crate::curve::samples::{Sample, Samples};
use crate::curve::{TableError, unfold};
use crate::math;
use crate::number::error::RangeError;
use crate::number::spline::{control_points, fit_quadratic_bounded, fit_quadratic_periodic};

/// Fills `words`, and returns the table's constants.
pub(super) fn fill<E: From<TableError> + From<RangeError>>(
    samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
    scratch: &mut [f64],
    words: &mut [u32],
) -> Result<RowConstants, E> {
    let (set, cells) = (samples.set, samples.cells);
    let mut curves = Curves::split(scratch, cells, set, samples.periodic());
    let constants = curves.sample(samples)?.rounded(curves.shift()?)?;
    let base = f64::from(samples.scale.velocity_base());
    let factor = 0.5 * f64::from(cells) / samples.domain.span() * base;
    for (cell, row) in (0..cells).zip(words.chunks_exact_mut(row::length(set))) {
        curves.pack(cell, factor, constants.shift, row)?;
    }
    Ok(constants)
}

/// Control points and knots of the curves, in machine units.
struct Curves<'s> {
    cells: u32,
    set: CurveSet,
    periodic: bool,
    /// Control points of J in halves.
    inertia: &'s mut [f64],
    /// Control points of the load in halves.
    load: &'s mut [f64],
    /// b at the knots.
    viscous: &'s mut [f64],
    /// c at the knots, signed.
    coulomb: &'s mut [f64],
    /// Memory for samples.
    spare: &'s mut [f64],
}

/// b and c in machine units, if constant.
#[derive(Clone, Copy)]
struct Parts {
    viscous: f64,
    coulomb: f64,
}

impl Parts {
    /// Rounded to stored units.
    fn rounded(self, shift: u32) -> Result<RowConstants, TableError> {
        let rounded = |value: f64, unit: f64| {
            let scaled = math::rint(value * unit);
            (math::abs(scaled) < 2_147_483_648.0)
                .then_some(scaled as i32)
                .ok_or(TableError::Overflow {
                    base: "torque",
                    cell: 0,
                })
        };
        Ok(RowConstants {
            viscous: rounded(self.viscous, 1_073_741_824.0)?,
            coulomb: rounded(self.coulomb, 2_147_483_648.0)?,
            shift,
        })
    }
}

/// A number of a slice; 0 beyond its end.
fn at(numbers: &[f64], index: usize) -> f64 {
    numbers.get(index).copied().unwrap_or(0.0)
}

fn put(numbers: &mut [f64], index: usize, value: f64) {
    if let Some(slot) = numbers.get_mut(index) {
        *slot = value;
    }
}

/// p₀, p₁, p₂ of a cell, from control points in halves.
fn quadratic(control: &[f64], cell: usize) -> [f64; 3] {
    let [c0, c1, c2] = [0, 1, 2].map(|k| at(control, cell + k));
    [c0 + c1, 2.0 * (c1 - c0), (c2 - c1) - (c1 - c0)]
}

impl<'s> Curves<'s> {
    fn split(scratch: &'s mut [f64], cells: u32, set: CurveSet, periodic: bool) -> Self {
        let rows = control_points(cells as usize);
        let mut rest = scratch;
        let mut part = |wanted: bool| {
            let taken = core::mem::take(&mut rest);
            let (part, left) = taken.split_at_mut(if wanted { rows.min(taken.len()) } else { 0 });
            rest = left;
            part
        };
        Self {
            cells,
            set,
            periodic,
            inertia: part(true),
            spare: part(true),
            load: part(has(set, curves::LOAD)),
            viscous: part(has(set, curves::VISCOUS)),
            coulomb: part(has(set, curves::COULOMB)),
        }
    }

    fn sample<E: From<RangeError>>(
        &mut self,
        samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
    ) -> Result<Parts, E> {
        let periodic = self.periodic;
        let cells = f64::from(self.cells);
        let start = samples.at_cell(0.0)?;
        let part = |of: CurveSet, value: f64| if has(self.set, of) { value } else { 0.0 };
        let parts = Parts {
            viscous: part(curves::CONSTANT_VISCOUS, start.viscous),
            coulomb: part(curves::CONSTANT_COULOMB, start.coulomb),
        };
        if has(self.set, curves::VISCOUS | curves::COULOMB) {
            let knots = self.cells as usize + usize::from(!periodic);
            for knot in 0..knots {
                let point = samples.at_cell(knot as f64)?;
                put(self.viscous, knot, point.viscous);
                put(self.coulomb, knot, point.coulomb);
            }
            if let Some(coulomb) = self.coulomb.get_mut(..knots) {
                unfold(coulomb, periodic);
            }
            // The last knot of a turn is the first.
            if periodic {
                put(self.viscous, knots, at(self.viscous, 0));
                put(self.coulomb, knots, at(self.coulomb, 0));
            }
        }

        // In the middle of every cell, and at the ends of a stroke.
        let count = self.cells as usize + if periodic { 0 } else { 2 };
        for k in 0..count {
            let knot = if periodic {
                k as f64 + 0.5
            } else {
                (k as f64 - 0.5).clamp(0.0, cells)
            };
            let point = samples.at_cell(knot)?;
            put(self.inertia, k, point.inertia);
            put(self.load, k, point.load);
        }
        for control in [&mut *self.inertia, &mut *self.load] {
            if control.is_empty() {
                continue;
            }
            self.spare.copy_from_slice(control);
            let samples = self.spare.get(..count).unwrap_or_default();
            if periodic {
                fit_quadratic_periodic(samples, control)?;
            } else {
                fit_quadratic_bounded(samples, control)?;
            }
        }
        Ok(parts)
    }

    /// 1/J at a knot, lowered by half the height of the chord above 1/J in the middle of the neighbouring cells, on average.
    fn reciprocal(&self, knot: usize) -> f64 {
        let cells = self.cells as usize;
        let inverse = |cell: usize, u: f64| {
            let [p0, p1, p2] = quadratic(self.inertia, cell);
            1.0 / (p0 + u * (p1 + u * p2))
        };
        let above =
            |cell: usize| 0.5 * (inverse(cell, 0.0) + inverse(cell, 1.0)) - inverse(cell, 0.5);
        let (last, beyond) = (knot.min(cells - 1), knot == cells);
        let before = match knot.checked_sub(1) {
            Some(before) => before,
            None if self.periodic => cells - 1,
            None => 0,
        };
        let after = if self.periodic { knot % cells } else { last };
        let value = inverse(last, if beyond { 1.0 } else { 0.0 });
        value - 0.25 * (above(before) + above(after))
    }

    /// k of the units of 1/J: the largest value uses at least half of its range.
    fn shift(&self) -> Result<u32, TableError> {
        if !has(self.set, curves::RECIPROCAL) {
            return Ok(0);
        }
        let (mut most, mut place) = (0.0f64, 0);
        for knot in 0..=self.cells {
            let here = self.reciprocal(knot as usize);
            if here.is_nan() || here > most {
                (most, place) = (here, knot);
            }
        }
        // A unit below the end of the range, for the rounding.
        let shift = math::floor(math::log2(32_766.0 / most));
        if (0.0..=15.0).contains(&shift) {
            return Ok(shift as u32);
        }
        // A J so small relative to its base has an error of up to two units.
        let cell = place.min(self.cells - 1);
        Err(TableError::Reciprocal { cell })
    }

    /// Writes a row.
    fn pack(&self, cell: u32, factor: f64, shift: u32, row: &mut [u32]) -> Result<(), TableError> {
        const Q15: f64 = 32_768.0;
        const Q16: f64 = 65_536.0;
        let index = cell as usize;
        let inertia_base = TableError::Overflow {
            base: "inertia",
            cell,
        };
        let torque_base = TableError::Overflow {
            base: "torque",
            cell,
        };
        let mut set = |index: usize, word: u32| {
            if let Some(slot) = row.get_mut(index) {
                *slot = word;
            }
        };
        let mut load_start = 0;
        if has(self.set, curves::LOAD) {
            let load = quadratic(self.load, index).map(|p| -Q15 * p);
            let halves = fit::quadratic(load, 0.0).ok_or(torque_base)?;
            load_start = i16::try_from(halves.start)
                .map_err(|_| torque_base)?
                .cast_unsigned();
            set(0, halves.word);
        }
        let [p0, p1, p2] = quadratic(self.inertia, index).map(|p| Q16 * p);
        let halves = fit::quadratic([p0, p1, p2], f64::from(load_start) / Q16);
        let halves = halves.ok_or(inertia_base)?;
        let start = u16::try_from(halves.start).map_err(|_| inertia_base)?;
        set(row::inertia(self.set), halves.word);
        set(row::start(self.set), word(start, load_start));
        // From Q16 of the slope to Q15 of the torque.
        let slope = 0.5 * factor;
        let line = fit::line([slope * p1, slope * 2.0 * p2]).ok_or(torque_base)?;
        set(row::velocity(self.set), line);
        for (curve, index_in_row, knots) in [
            (curves::VISCOUS, row::viscous(self.set), &*self.viscous),
            (curves::COULOMB, row::coulomb(self.set), &*self.coulomb),
        ] {
            if has(self.set, curve) {
                let [start, end] = [0, 1].map(|k| Q15 * at(knots, index + k));
                set(
                    index_in_row,
                    fit::line([start, end - start]).ok_or(torque_base)?,
                );
            }
        }
        if has(self.set, curves::RECIPROCAL) {
            let unit = f64::from(1u32 << shift);
            let [start, end] = [0, 1].map(|k| unit * self.reciprocal(index + k));
            let line = fit::line([start, end - start]).ok_or(inertia_base)?;
            set(row::reciprocal(self.set), line);
        }
        Ok(())
    }
}
