//! Tables: words and their meaning, checked.

use super::curves::{self, CurveSet};
use super::{Format, TableError};
use crate::number::Number;
use crate::{Domain, Phase, Scale};

/// Greatest number of cells of a table: an index has 16 bits.
pub const MAX_CELLS: u32 = 65_535;

/// Words of a table of `cells` cells, for buffers whose length is known at compile time.
#[must_use]
pub const fn words_len<F: Format>(cells: u32, set: CurveSet) -> usize {
    F::SIZE.words(cells as usize, set)
}

/// The meaning of a table's words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape<F: Format> {
    /// The set of [`curves`].
    pub set: CurveSet,
    /// Number of cells.
    pub cells: u32,
    /// Range of the drive link.
    pub domain: Domain<<F::Number as Number>::Real>,
    /// Machine units.
    pub scale: Scale,
    /// Constants of a table, in addition to its rows.
    pub constants: F::Constants,
}

/// The curves of a reduced machine, in RAM or in flash, checked.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a, F: Format> {
    words: &'a [F::Word],
    shape: Shape<F>,
}

/// All curves at one phase; 0 for absent curves.
///
/// In double precision: for checks, not for the tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct CurveValues {
    /// J_red
    pub inertia: f64,
    /// dJ_red/dφ
    pub inertia_slope: f64,
    /// −U′ + process
    pub load: f64,
    /// b
    pub viscous: f64,
    /// c
    pub coulomb: f64,
}

/// The curves of one cell as polynomials in SI units, each Σ cₖ·(u − centre)ᵏ of the place u in the cell, 0 to 1: the exact values of the table's
/// words. 0 for absent curves.
///
/// In double precision, with roundings below 1e-14 of the largest coefficient: for proofs on a host, not for the tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct CellCurves {
    /// The centre of the polynomials, in the cell.
    pub centre: f64,
    /// J_red
    pub inertia: [f64; 4],
    /// dJ_red/dφ
    pub inertia_slope: [f64; 4],
    /// −U′ + process
    pub load: [f64; 4],
    /// b
    pub viscous: [f64; 4],
    /// c with its sign in the table; the tick uses its magnitude.
    pub coulomb: [f64; 4],
    /// Constant added to every J, stored separately.
    pub offset: f64,
}

impl<'a, F: Format> Table<'a, F> {
    /// Checks `words` made by [`tabulate`](crate::tabulate).
    ///
    /// # Errors
    /// As [`TableError`] lists. A table that passes can be read at any phase.
    pub fn new(words: &'a [F::Word], shape: Shape<F>) -> Result<Self, TableError> {
        if !F::accepts(shape.set) {
            return Err(TableError::Curves(shape.set));
        }
        let [fewest, most] = F::CELLS;
        if shape.cells < fewest || shape.cells > most {
            return Err(TableError::Cells(shape.cells));
        }
        let (needed, given) = (words_len::<F>(shape.cells, shape.set), words.len());
        if given != needed {
            return Err(TableError::Length {
                needed: needed as u32,
                given: given as u32,
            });
        }
        let table = Self { words, shape };
        F::check(&table)?;
        Ok(table)
    }

    /// The same table over the same words, borrowed again or moved.
    #[inline(always)]
    pub(crate) const fn moved<'b>(&self, words: &'b [F::Word]) -> Table<'b, F> {
        Table {
            words,
            shape: self.shape,
        }
    }

    /// The meaning of the words.
    pub const fn shape(&self) -> Shape<F> {
        self.shape
    }

    /// Number of cells.
    pub const fn cells(&self) -> u32 {
        self.shape.cells
    }

    /// The set of [`curves`].
    pub const fn set(&self) -> CurveSet {
        self.shape.set
    }

    /// Range of the drive link.
    pub const fn domain(&self) -> Domain<<F::Number as Number>::Real> {
        self.shape.domain
    }

    /// Machine units.
    pub const fn scale(&self) -> &Scale {
        &self.shape.scale
    }

    /// Its constants.
    pub const fn constants(&self) -> &F::Constants {
        &self.shape.constants
    }

    /// The stored rows.
    pub const fn words(&self) -> &'a [F::Word] {
        self.words
    }

    /// All curves at `phase` in machine units, in the arithmetic of the tick; the slope is per rad (or m).
    pub fn at(&self, phase: Phase) -> CurveValues {
        F::read(self, phase)
    }

    /// All curves at `phase` in SI units. `domain` is the range in double precision; the table itself has it only in its own precision.
    pub fn si(&self, phase: Phase, domain: Domain) -> CurveValues {
        F::si(self, phase, f64::from(self.cells()) / domain.span())
    }

    /// The curves of one cell as polynomials, for proofs on a host. `domain` is the range in double precision, as for [`si`](Self::si). `None` for a
    /// format without cells, and beyond the last cell.
    pub fn cell_curves(&self, cell: u32, domain: Domain) -> Option<CellCurves> {
        let cells_per_position = f64::from(self.cells()) / domain.span();
        (cell < self.cells()).then(|| F::cell_curves(self, cell, cells_per_position))?
    }

    /// 1/J_red at `phase` in machine units; `None` without [`curves::RECIPROCAL`].
    pub fn reciprocal(&self, phase: Phase) -> Option<f64> {
        curves::has(self.set(), curves::RECIPROCAL).then(|| F::reciprocal(self, phase))?
    }

    /// The difference between forward and inverse dynamics, as a share of the acceleration: the error of the curve of 1/J. 0 without
    /// [`curves::RECIPROCAL`], where forward dynamics divides.
    ///
    /// Accuracy: for [`Rows16`](crate::Rows16) a bound, by Bézier points; otherwise the largest error at four places of every cell. Between them it
    /// may be half as much again, plus roundings (test `the_inconsistency_is_what_is_stated`).
    pub fn reciprocal_error(&self) -> f32 {
        if curves::has(self.set(), curves::RECIPROCAL) {
            F::reciprocal_error(self)
        } else {
            0.0
        }
    }
}
