//! Tables of 16-bit rows, checked.

use super::check;
use super::kernel;
use super::row::{self, Rows, row_words};
use crate::Phase;
use crate::curve::{MAX_CELLS, MIN_CELLS, TableError, curves};

/// Words of a table: one row a cell, for a turn as for a stroke.
#[must_use]
pub const fn words_len(cells: u32, set: u8) -> usize {
    cells as usize * row_words(set)
}

/// What a table has beside its rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Constants {
    /// Added to b, in units of 2⁻³⁰. Only with [`curves::CONSTANT_VISCOUS`].
    pub viscous: i32,
    /// Added to c, in units of 2⁻³¹. Only with [`curves::CONSTANT_COULOMB`].
    pub coulomb: i32,
    /// k: 1/J is stored in units of 2⁻ᵏ, k = 0 … 15. Only with [`curves::RECIPROCAL`].
    pub shift: u32,
}

/// The curves of a reduced machine in rows of 16-bit numbers, in RAM or in flash, checked.
///
/// A row takes 12 bytes, and 4 more for each of load, b(φ), c(φ) and 1/J. The words of a row are listed in
/// `docs/table-image.md`.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a> {
    pub(super) rows: Rows<'a>,
    curves: u8,
    constants: Constants,
}

/// All curves at one phase in machine units, as the tick reads them; zero where the machine has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CurveValues {
    /// J_red
    pub inertia: f64,
    /// V = ½·dJ_red/dφ·ω_b²/T_b
    pub velocity: f64,
    /// −U′ + process
    pub load: f64,
    /// b
    pub viscous: f64,
    /// c
    pub coulomb: f64,
    /// 1/J_red
    pub reciprocal: f64,
}

impl<'a> Table<'a> {
    /// Checks `words`, the rows of this set of [`curves`] as [`fill`](super::fill()) makes them.
    ///
    /// # Errors
    /// - [`TableError::Curves`]: an unknown bit;
    /// - [`TableError::Cells`], [`TableError::Length`]: not [`MIN_CELLS`] to [`MAX_CELLS`] cells, or another number of words;
    /// - [`TableError::Range`]: the curve of this word of a row, or a constant of it, leaves the number range within the cell;
    /// - [`TableError::NoInertia`]: J is not above 0 everywhere in the cell;
    /// - [`TableError::TorqueRange`]: some speed and acceleration in the number range, −1 included, need a torque out of it;
    /// - [`TableError::Reciprocal`]: 1/J is off by more than 2 % of what J says, or its shift is above 15.
    ///
    /// With a table that passes, the tick cannot overflow at any phase.
    pub fn new(
        words: &'a [u32],
        constants: Constants,
        curves: u8,
        cells: u32,
    ) -> Result<Self, TableError> {
        if curves > curves::EVERY {
            return Err(TableError::Curves(curves));
        }
        if cells < MIN_CELLS as u32 || cells > MAX_CELLS {
            return Err(TableError::Cells(cells));
        }
        let (needed, given) = (words_len(cells, curves), words.len());
        if given != needed {
            return Err(TableError::Length {
                needed: needed as u32,
                given: given as u32,
            });
        }
        let table = Self {
            rows: Rows::new(words, curves),
            curves,
            constants,
        };
        check::all(&table)?;
        Ok(table)
    }

    /// Number of cells.
    pub fn cells(&self) -> u32 {
        self.rows.count(self.curves)
    }

    /// The set of [`curves`].
    pub const fn curves(&self) -> u8 {
        self.curves
    }

    /// The rows, as they are stored.
    pub fn words(&self) -> &'a [u32] {
        self.rows.words(self.curves)
    }

    /// What it has beside its rows.
    pub const fn constants(&self) -> Constants {
        self.constants
    }

    /// How far 1/J may be off what J says, as a part of it: a bound over all places of all cells, the rounding of the tick
    /// included. `None` without [`curves::RECIPROCAL`].
    pub fn reciprocal_error(&self) -> Option<f32> {
        row::has(self.curves, curves::RECIPROCAL).then(|| check::reciprocal_error(self))
    }

    /// All curves at `phase`, in the arithmetic of the tick. In double precision: for checks, not for the tick.
    pub fn at(&self, phase: Phase) -> CurveValues {
        const Q15: f64 = 1.0 / 32_768.0;
        const Q31: f64 = 1.0 / 2_147_483_648.0;
        let set = self.curves;
        let (index, u) = kernel::locate(phase, self.cells());
        let row = self.rows.get(index, set).unwrap_or_default();
        let word = |index| row::at(row, index);
        let line = |of: u8, index| {
            let value = if row::has(set, of) {
                kernel::line(word(index), u)
            } else {
                0
            };
            f64::from(value)
        };
        let start = word(row::start(set));
        let load = if row::has(set, curves::LOAD) {
            // Half a unit of 2⁻¹⁵ rounds the torque.
            32_768.0 - f64::from(kernel::minus_load(0, word(0), start, u))
        } else {
            0.0
        };
        let constant = |of: u8, number: i32| f64::from(if row::has(set, of) { number } else { 0 });
        let Constants {
            viscous,
            coulomb,
            shift,
        } = self.constants;
        let unit = f64::from(1u32 << shift.min(15));
        CurveValues {
            inertia: f64::from(kernel::inertia(word(row::inertia(set)), start, u)) / 65_536.0,
            velocity: f64::from(kernel::line(word(row::velocity(set)), u)) * Q15,
            load: load * Q31,
            viscous: line(curves::VISCOUS, row::viscous(set)) * Q15
                + 2.0 * constant(curves::CONSTANT_VISCOUS, viscous) * Q31,
            coulomb: line(curves::COULOMB, row::coulomb(set)).abs() * Q15
                + constant(curves::CONSTANT_COULOMB, coulomb) * Q31,
            reciprocal: line(curves::RECIPROCAL, row::reciprocal(set)) / unit,
        }
    }
}
