//! Tables of the reduced machine's curves: value and slope from one twice continuously differentiable curve.
//!
//! Rows of control points lie one after another; a row holds one control point of every curve of the machine, so
//! that one index and one contiguous read of four rows serve them all. See [`CubicSpline`] for the interpolant.

mod spline;

pub use spline::{CubicSpline, MIN_CELLS, control_points, fit_bounded, fit_periodic};

use core::fmt;

use crate::Phase;
use crate::scalar::Scalar;

/// Which curves a table has beside the reduced inertia, as a bit set.
///
/// The set is part of a table's type: curves that a machine does not have cost neither memory nor instructions.
pub mod curves {
    /// Only J_red.
    pub const INERTIA: u8 = 0;
    /// The part of the reduced torque that does not depend on ω: −U′ + process.
    pub const LOAD: u8 = 1;
    /// b in −b·ω.
    pub const VISCOUS: u8 = 2;
    /// c in −c·sgn ω.
    pub const COULOMB: u8 = 4;
    /// Every curve.
    pub const ALL: u8 = LOAD | VISCOUS | COULOMB;

    /// Control points a row: J_red and one for each curve of the set.
    #[must_use]
    pub const fn width(set: u8) -> usize {
        1 + (set & ALL).count_ones() as usize
    }
}

/// Most cells of a table.
pub const MAX_CELLS: u32 = 1 << 16;

/// Why rows of control points are not a usable table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TableError {
    /// Fewer than [`MIN_CELLS`] or more than [`MAX_CELLS`] cells.
    Cells(u32),
    /// Not the number of words that the cells and curves need.
    Length {
        /// Words needed.
        needed: u32,
        /// Words given.
        given: u32,
    },
    /// A cell of this curve holds a number that is not finite, or leaves the fixed-point range.
    Range {
        /// Position of the curve in a row.
        curve: u8,
        /// Index of the cell.
        cell: u32,
    },
    /// The reduced inertia is not positive everywhere in this cell.
    NoInertia {
        /// Index of the cell.
        cell: u32,
    },
    /// A periodic curve does not close: its last three rows are not its first three.
    NotClosed {
        /// Position of the curve in a row.
        curve: u8,
    },
    /// The torque ½·J′·ω² leaves the fixed-point range in this cell at the speed base: a larger torque base or a
    /// smaller speed base is needed.
    VelocityTorque {
        /// Index of the cell.
        cell: u32,
    },
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Cells(cells) => write!(
                f,
                "a table of {cells} cells: {MIN_CELLS} to {MAX_CELLS} are possible"
            ),
            Self::Length { needed, given } => {
                write!(f, "the table has {given} words, but needs {needed}")
            }
            Self::Range { curve, cell } => write!(
                f,
                "curve {curve} of the table leaves the number range in cell {cell}"
            ),
            Self::NoInertia { cell } => write!(
                f,
                "the reduced inertia is not positive everywhere in cell {cell}: use more cells"
            ),
            Self::NotClosed { curve } => {
                write!(f, "curve {curve} of the table does not close after a turn")
            }
            Self::VelocityTorque { cell } => write!(
                f,
                "the torque of J' leaves the number range in cell {cell}: \
                 choose a larger torque base or a smaller speed base"
            ),
        }
    }
}

impl core::error::Error for TableError {}

/// The curves of a reduced machine, in RAM or in flash, checked.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a, S: Scalar, const CURVES: u8> {
    words: &'a [S::Word],
    cells: u32,
}

/// All curves at one phase, in machine units; zero where the machine has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveValues<S> {
    /// J_red
    pub inertia: S,
    /// dJ_red/dφ·(range/cells): the slope per cell
    pub inertia_slope: S,
    /// −U′ + process
    pub load: S,
    /// b
    pub viscous: S,
    /// c
    pub coulomb: S,
}

impl<'a, S: Scalar, const CURVES: u8> Table<'a, S, CURVES> {
    /// Control points a row.
    pub const WIDTH: usize = curves::width(CURVES);

    /// Checks `words`: (cells + 3) rows of control points, as `tabulate` makes them; `periodic` for a turn.
    ///
    /// # Errors
    /// What [`TableError`] lists. A table that passes can be read at any phase.
    pub fn new(words: &'a [S::Word], cells: u32, periodic: bool) -> Result<Self, TableError> {
        const { assert!(CURVES <= curves::ALL, "unknown curve in the set") };
        if cells < MIN_CELLS as u32 || cells > MAX_CELLS {
            return Err(TableError::Cells(cells));
        }
        let needed = control_points(cells as usize) * Self::WIDTH;
        if words.len() != needed {
            return Err(TableError::Length {
                needed: needed as u32,
                given: words.len() as u32,
            });
        }
        let table = Self { words, cells };
        for cell in 0..cells {
            for curve in 0..Self::WIDTH {
                let points = table.points(cell, curve);
                if !S::cell_is_sound(points) {
                    let curve = curve as u8;
                    return Err(TableError::Range { curve, cell });
                }
            }
            if !is_positive(table.points(cell, 0)) {
                return Err(TableError::NoInertia { cell });
            }
        }
        for curve in 0..Self::WIDTH {
            let (first, last) = (table.points(0, curve), table.points(cells - 1, curve));
            if periodic && first.get(..3) != last.get(1..) {
                let curve = curve as u8;
                return Err(TableError::NotClosed { curve });
            }
        }
        Ok(table)
    }

    /// Number of cells.
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// The rows, as they are stored.
    pub const fn words(&self) -> &'a [S::Word] {
        self.words
    }

    /// All curves at `phase`.
    #[inline]
    pub fn at(&self, phase: Phase) -> CurveValues<S> {
        let Some(cell) = self.cell(phase) else {
            return CurveValues::default();
        };
        let inertia = cell.cubic(0);
        CurveValues {
            inertia: S::value(inertia, cell.u),
            inertia_slope: S::slope(inertia, cell.u),
            load: cell.curve(curves::LOAD),
            viscous: cell.curve(curves::VISCOUS),
            coulomb: cell.curve(curves::COULOMB),
        }
    }

    /// The four rows around `phase`. Always `Some`: the length was checked when the table was built, but saying so
    /// costs a compare, not a panic path.
    #[inline]
    pub(crate) fn cell(&self, phase: Phase) -> Option<Cell<'a, S, CURVES>> {
        let (index, fraction) = phase.cell(self.cells);
        let start = index as usize * Self::WIDTH;
        let rows = self.words.get(start..)?.get(..4 * Self::WIDTH)?;
        Some(Cell {
            rows,
            u: S::fraction(fraction),
        })
    }

    /// Four control points of one curve, by cell.
    pub(crate) fn points(&self, cell: u32, curve: usize) -> [S; 4] {
        let start = cell as usize * Self::WIDTH + curve;
        let mut points = [S::default(); 4];
        for (point, word) in points
            .iter_mut()
            .zip(self.words.iter().skip(start).step_by(Self::WIDTH))
        {
            *point = S::from_word(*word);
        }
        points
    }
}

/// Whether the cubic of a cell is positive throughout, by its Bézier points (sufficient; the tabulator adds cells
/// until it holds).
fn is_positive<S: Scalar>(points: [S; 4]) -> bool {
    let [c0, c1, c2, c3] = points.map(S::to_wide_f32);
    let ends = [c0 + 4.0 * c1 + c2, c1 + 4.0 * c2 + c3];
    let inner = [4.0 * c1 + 2.0 * c2, 2.0 * c1 + 4.0 * c2];
    // Above the roundings of these sums, so that no cell passes that dips below zero by a few units.
    let rounding = 1e-5
        * [c0, c1, c2, c3]
            .iter()
            .fold(0.0f32, |most, c| most.max(c.abs()));
    ends.iter().chain(&inner).all(|b| *b > rounding)
}

/// One cell's rows and the place in it.
pub(crate) struct Cell<'a, S: Scalar, const CURVES: u8> {
    rows: &'a [S::Word],
    pub(crate) u: S::Fraction,
}

impl<S: Scalar, const CURVES: u8> Cell<'_, S, CURVES> {
    #[inline]
    pub(crate) fn cubic(&self, position: usize) -> [S; 4] {
        let width = curves::width(CURVES);
        let point = |row: usize| {
            let word = self.rows.get(row * width + position);
            word.map_or(S::default(), |w| S::from_word(*w))
        };
        S::cubic([point(0), point(1), point(2), point(3)])
    }

    /// Value of a curve that the table may have; zero if it has not.
    #[inline]
    pub(crate) fn curve(&self, curve: u8) -> S {
        if CURVES & curve == 0 {
            return S::default();
        }
        // Curves of a row stand in the order of their bits, after the inertia.
        let before = (CURVES & (curve - 1)).count_ones() as usize;
        S::value(self.cubic(1 + before), self.u)
    }
}
