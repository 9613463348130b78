//! Fills a table of 16-bit rows of a given size.

use super::row::{self, has, word};
use super::table::words_len;
use super::{Constants, Table, fit};
use crate::curve::{
    MAX_CELLS, MIN_CELLS, TableError, control_points, curves, fit_quadratic_bounded,
    fit_quadratic_periodic,
};
use crate::machine::reduction::{Reducible, Reduction};
use crate::tabulate::unfold;
use crate::{Domain, Error, Scale, math};

/// Numbers of `f64` scratch that tables of up to `cells` cells need.
#[must_use]
pub const fn scratch_len(cells: u32, set: u8) -> usize {
    let curves = (set & curves::ALL).count_ones() as usize;
    (2 + curves) * control_points(cells as usize)
}

/// Fills `words` with the table of exactly `cells` cells and of this set of [`curves`], and returns it.
///
/// A constant of the set is the machine's value at the start of its range; a curve beside it is what is left. For Coulomb
/// friction, whose curve is read as a magnitude, a constant beside a curve is the least value; the curve is stored with a sign that
/// changes where its magnitude has a kink at zero (see [`curves::COULOMB`]).
///
/// # Errors
/// Those of the machine; curves that do not repeat with the turn of the drive link; buffers too short; a curve outside the
/// number range of `scale`; as [`Table::new`].
pub fn fill<'w>(
    machine: &impl Reducible,
    set: u8,
    cells: u32,
    scale: &Scale,
    scratch: &mut [f64],
    words: &'w mut [u32],
) -> Result<Table<'w>, Error> {
    if set > curves::EVERY {
        return Err(Error::Table(TableError::Curves(set)));
    }
    if cells < MIN_CELLS as u32 || cells > MAX_CELLS {
        return Err(Error::Table(TableError::Cells(cells)));
    }
    let (given, needed) = (scratch.len(), scratch_len(cells, set));
    let too_short = Error::BufferTooShort { needed, given };
    let scratch = scratch.get_mut(..needed).ok_or(too_short)?;
    let (given, needed) = (words.len(), words_len(cells, set));
    let too_short = Error::BufferTooShort { needed, given };
    let words = words.get_mut(..needed).ok_or(too_short)?;

    let domain = machine.domain();
    if domain == Domain::Turn {
        machine.check_repeats()?;
    }
    let mut curves = Curves::split(scratch, cells, set);
    let constants = curves.sample(machine, scale)?;
    let constants = constants.rounded(curves.shift(domain)?)?;
    let factor = 0.5 * f64::from(cells) / domain.span() * f64::from(scale.velocity_base());
    for (cell, row) in (0..cells).zip(words.chunks_exact_mut(row::row_words(set))) {
        curves.pack(cell, factor, constants.shift, domain, row)?;
    }
    let table = Table::new(words, constants, set, cells);
    table.map_err(|error| match error {
        TableError::Range { curve, cell } => Error::Overflow {
            base: if usize::from(curve) == row::inertia(set) {
                "inertia"
            } else {
                "torque"
            },
            cell,
        },
        TableError::NoInertia { cell } => Error::NoInertia {
            phi: domain.position(f64::from(cell) / f64::from(cells)),
        },
        other => Error::Table(other),
    })
}

/// Control points and knots of the curves, in machine units.
struct Curves<'s> {
    cells: u32,
    set: u8,
    /// Control points of J in halves.
    inertia: &'s mut [f64],
    /// Control points of the load in halves.
    load: &'s mut [f64],
    /// b at the knots.
    viscous: &'s mut [f64],
    /// c at the knots, signed.
    coulomb: &'s mut [f64],
    /// For samples.
    spare: &'s mut [f64],
}

/// Constant parts of b and c in machine units.
#[derive(Clone, Copy)]
struct Parts {
    viscous: f64,
    coulomb: f64,
}

impl Parts {
    /// As they are stored.
    fn rounded(self, shift: u32) -> Result<Constants, Error> {
        let rounded = |value: f64, unit: f64| {
            let scaled = math::rint(value * unit);
            (math::abs(scaled) < 2_147_483_648.0)
                .then_some(scaled as i32)
                .ok_or(Error::Overflow {
                    base: "torque",
                    cell: 0,
                })
        };
        Ok(Constants {
            viscous: rounded(self.viscous, 1_073_741_824.0)?,
            coulomb: rounded(self.coulomb, 2_147_483_648.0)?,
            shift,
        })
    }
}

/// One of a slice's numbers; 0 beyond its end.
fn at(numbers: &[f64], index: usize) -> f64 {
    numbers.get(index).copied().unwrap_or(0.0)
}

fn put(numbers: &mut [f64], index: usize, value: f64) {
    if let Some(slot) = numbers.get_mut(index) {
        *slot = value;
    }
}

/// p₀, p₁, p₂ of a cell, of control points in halves.
fn quadratic(control: &[f64], cell: usize) -> [f64; 3] {
    let [c0, c1, c2] = [0, 1, 2].map(|k| at(control, cell + k));
    [c0 + c1, 2.0 * (c1 - c0), (c2 - c1) - (c1 - c0)]
}

impl<'s> Curves<'s> {
    fn split(scratch: &'s mut [f64], cells: u32, set: u8) -> Self {
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
            inertia: part(true),
            spare: part(true),
            load: part(has(set, curves::LOAD)),
            viscous: part(has(set, curves::VISCOUS)),
            coulomb: part(has(set, curves::COULOMB)),
        }
    }

    fn sample(&mut self, machine: &impl Reducible, scale: &Scale) -> Result<Parts, Error> {
        let domain = machine.domain();
        let periodic = domain == Domain::Turn;
        let cells = f64::from(self.cells);
        let (torque, speed) = (f64::from(scale.torque()), f64::from(scale.speed()));
        let viscous = |point: &Reduction| point.viscous * speed / torque;
        let coulomb = |point: &Reduction| point.coulomb / torque;

        let start = machine.reduction(domain.position(0.0))?;
        let part = |of: u8, value: f64| if has(self.set, of) { value } else { 0.0 };
        let mut parts = Parts {
            viscous: part(curves::CONSTANT_VISCOUS, viscous(&start)),
            coulomb: part(curves::CONSTANT_COULOMB, coulomb(&start)),
        };
        let mut least = f64::INFINITY;
        if has(self.set, curves::VISCOUS | curves::COULOMB) {
            for knot in 0..=self.cells {
                let place = f64::from(knot) / cells;
                // The last knot of a turn is the first.
                let place = if periodic && knot == self.cells {
                    0.0
                } else {
                    place
                };
                let point = machine.reduction(domain.position(place))?;
                put(self.viscous, knot as usize, viscous(&point) - parts.viscous);
                put(self.coulomb, knot as usize, coulomb(&point));
                least = least.min(coulomb(&point));
            }
            if has(self.set, curves::COULOMB) {
                parts.coulomb = part(curves::CONSTANT_COULOMB, least);
                self.coulomb.iter_mut().for_each(|c| *c -= parts.coulomb);
                let knots = self.cells as usize + usize::from(!periodic);
                unfold(self.coulomb.get_mut(..knots).unwrap_or_default(), periodic);
                if periodic {
                    put(self.coulomb, knots, at(self.coulomb, 0));
                }
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
            let point = machine.reduction(domain.position(knot / cells))?;
            put(
                self.inertia,
                k,
                point.inertia[0] / f64::from(scale.inertia()),
            );
            put(self.load, k, point.load_torque() / torque);
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

    /// 1/J at a knot, lowered by half of what a straight line lies above 1/J in the cells beside it.
    fn reciprocal(&self, knot: usize, domain: Domain) -> f64 {
        let cells = self.cells as usize;
        let inverse = |cell: usize, u: f64| {
            let [p0, p1, p2] = quadratic(self.inertia, cell);
            1.0 / (p0 + u * (p1 + u * p2))
        };
        let above =
            |cell: usize| 0.5 * (inverse(cell, 0.0) + inverse(cell, 1.0)) - inverse(cell, 0.5);
        let (last, beyond) = (knot.min(cells - 1), knot == cells);
        let before = match (knot.checked_sub(1), domain) {
            (Some(before), _) => before,
            (None, Domain::Turn) => cells - 1,
            (None, Domain::Stroke { .. }) => 0,
        };
        let after = match domain {
            Domain::Turn => knot % cells,
            Domain::Stroke { .. } => last,
        };
        let value = inverse(last, if beyond { 1.0 } else { 0.0 });
        value - 0.25 * (above(before) + above(after))
    }

    /// k of the units of 1/J: the largest of them uses half of its range or more.
    fn shift(&self, domain: Domain) -> Result<u32, Error> {
        if !has(self.set, curves::RECIPROCAL) {
            return Ok(0);
        }
        let (mut most, mut place) = (0.0f64, 0);
        for knot in 0..=self.cells {
            let here = self.reciprocal(knot as usize, domain);
            if here.is_nan() || here > most {
                (most, place) = (here, knot);
            }
        }
        // A unit below the end of the range, for the rounding.
        let shift = math::floor(math::log2(32_766.0 / most));
        if (0.0..=15.0).contains(&shift) {
            return Ok(shift as u32);
        }
        // So small a J, of its base, is known to less than two units.
        let cell = place.min(self.cells - 1);
        Err(Error::Table(TableError::Reciprocal { cell }))
    }

    /// Writes a row.
    fn pack(
        &self,
        cell: u32,
        factor: f64,
        shift: u32,
        domain: Domain,
        row: &mut [u32],
    ) -> Result<(), Error> {
        const Q15: f64 = 32_768.0;
        const Q16: f64 = 65_536.0;
        let index = cell as usize;
        let inertia_base = Error::Overflow {
            base: "inertia",
            cell,
        };
        let torque_base = Error::Overflow {
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
        // Q16 of the slope to Q15 of the torque.
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
            let [start, end] = [0, 1].map(|k| unit * self.reciprocal(index + k, domain));
            let line = fit::line([start, end - start]).ok_or(inertia_base)?;
            set(row::reciprocal(self.set), line);
        }
        Ok(())
    }
}
