//! Tables of the reduced machine's curves: value and slope from one continuously differentiable curve.
//!
//! A table is a run of words in RAM or in flash; its [`Layout`] says what a word is, its set of [`curves`] which curves a row
//! holds.

pub mod curves;
mod error;
mod layout;
mod spline;

pub use curves::Role;
pub use error::TableError;
pub use layout::{Cubic, Layout, Quadratic, Spline, Spline16};
pub(crate) use layout::{More, cubic};
pub use spline::{
    CubicSpline, MIN_CELLS, control_points, fit_bounded, fit_periodic, fit_quadratic_bounded,
    fit_quadratic_periodic,
};

use core::marker::PhantomData;

use crate::Phase;
use crate::number::{Kernel, Scalar};

/// Most cells of a table: an index has 16 bits.
pub const MAX_CELLS: u32 = 65_535;

/// What a table has beside its rows; in machine units, zero where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constants<W> {
    /// Added to every J of a [`Spline`], so that its control points are small and lose little to rounding.
    pub inertia: W,
    /// Added to b.
    pub viscous: W,
    /// Added to c.
    pub coulomb: W,
    /// What the points of J, load, b, c and 1/J are multiplied by in a [`Spline16`].
    pub gains: [W; 5],
}

impl<W: Copy> Constants<W> {
    #[inline]
    fn more<S: Kernel<Word = W>>(&self, role: Role) -> More<S::Raw> {
        let [inertia, load, viscous, coulomb, reciprocal] = self.gains;
        let gain = match role {
            Role::Inertia => inertia,
            Role::Load => load,
            Role::Viscous => viscous,
            Role::Coulomb => coulomb,
            Role::Reciprocal => reciprocal,
        };
        More {
            offset: match role {
                Role::Inertia => S::raw(self.inertia),
                _ => S::Raw::default(),
            },
            gain: S::raw(gain),
        }
    }
}

/// The curves of a reduced machine, in RAM or in flash, checked.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a, S: Scalar, L: Layout = Spline> {
    words: &'a [S::Word],
    curves: u8,
    cells: u32,
    constants: Constants<S::Word>,
    layout: PhantomData<L>,
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

impl<'a, S: Scalar, L: Layout> Table<'a, S, L> {
    /// Checks `words`, the rows of this set of [`curves`] as [`tabulate`](crate::tabulate) makes them; `periodic` for a turn.
    ///
    /// # Errors
    /// What [`TableError`] lists. A table that passes can be read at any phase.
    pub fn new(
        words: &'a [S::Word],
        curves: u8,
        cells: u32,
        periodic: bool,
    ) -> Result<Self, TableError> {
        let zero = <S::Word as bytemuck::Zeroable>::zeroed();
        let constants = Constants {
            inertia: zero,
            viscous: zero,
            coulomb: zero,
            gains: [zero; 5],
        };
        Self::with_constants(words, constants, curves, cells, periodic)
    }

    /// As [`new`](Self::new), of a table with constants.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_constants(
        words: &'a [S::Word],
        constants: Constants<S::Word>,
        curves: u8,
        cells: u32,
        periodic: bool,
    ) -> Result<Self, TableError> {
        if curves > curves::EVERY || (!S::FIXED && (curves & curves::RECIPROCAL != 0 || L::HALVES))
        {
            return Err(TableError::Curves(curves));
        }
        if cells < MIN_CELLS as u32 || cells > MAX_CELLS {
            return Err(TableError::Cells(cells));
        }
        let needed = L::words(cells as usize, curves);
        if words.len() != needed {
            return Err(TableError::Length {
                needed: needed as u32,
                given: words.len() as u32,
            });
        }
        let table = Self {
            words,
            curves,
            cells,
            constants,
            layout: PhantomData,
        };
        for role in [Role::Viscous, Role::Coulomb] {
            // Friction does not drive. NaN is not from zero on, either.
            let constant = S::approximate(role, table.constant(role));
            if !(0.0..1e30).contains(&constant) {
                return Err(TableError::Constant);
            }
        }
        for cell in 0..cells {
            for (column, role) in curves::roles(curves) {
                let curve = column as u8;
                let coefficients @ [p0, more @ ..] = table.wide(cell, role);
                let [p1, p2, p3] = more;
                // Where a curve has both signs, the constant adds to its magnitude.
                let constant = table.constant(role);
                let raised = [p0 + constant, p1, p2, p3];
                let lowered = [p0 - constant, p1, p2, p3];
                if ![coefficients, raised, lowered].into_iter().all(S::is_sound) {
                    return Err(TableError::Range { curve, cell });
                }
            }
            if !is_positive(table.polynomial(cell, Role::Inertia)) {
                return Err(TableError::NoInertia { cell });
            }
        }
        if periodic {
            table.check_closed()?;
        }
        Ok(table)
    }

    /// What adds to b or c, wide; zero for another role.
    fn constant(&self, role: Role) -> S::Wide {
        match role {
            Role::Viscous => S::widen(S::raw(self.constants.viscous)),
            Role::Coulomb => S::widen(S::raw(self.constants.coulomb)),
            _ => S::Wide::default(),
        }
    }

    /// Rows beyond the cells repeat the first ones.
    fn check_closed(&self) -> Result<(), TableError> {
        let pitch = L::pitch(self.curves);
        let end = self.cells as usize * pitch;
        for k in 0..L::MORE_ROWS * pitch {
            if self.words.get(k) != self.words.get(end + k) {
                let curve = (k % pitch * if L::HALVES { 2 } else { 1 }) as u8;
                return Err(TableError::NotClosed { curve });
            }
        }
        Ok(())
    }

    /// Number of cells.
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// The set of [`curves`].
    pub const fn curves(&self) -> u8 {
        self.curves
    }

    /// Curves in a row.
    pub const fn width(&self) -> usize {
        curves::width(self.curves)
    }

    /// The rows, as they are stored.
    pub const fn words(&self) -> &'a [S::Word] {
        self.words
    }

    /// What it has beside its rows.
    pub const fn constants(&self) -> Constants<S::Word> {
        self.constants
    }

    /// All curves at `phase`.
    #[inline]
    pub fn at(&self, phase: Phase) -> CurveValues<S> {
        let Some(cell) = self.cell(phase, self.curves) else {
            return CurveValues::default();
        };
        let (inertia, slope) = cell.inertia();
        let number = |role, raw: Option<S::Raw>| raw.map_or(S::default(), |r| S::number(role, r));
        CurveValues {
            inertia: S::number(Role::Inertia, inertia),
            inertia_slope: S::slope_number(slope, L::step::<S>()),
            load: number(Role::Load, cell.load()),
            viscous: number(Role::Viscous, cell.viscous()),
            coulomb: number(Role::Coulomb, cell.coulomb()),
        }
    }

    /// The cell around `phase`, of a table whose set is `curves`: a model knows it when it is compiled. Always `Some`: the
    /// length was checked when the table was built, but saying so costs a compare, not a panic path.
    #[inline]
    pub(crate) fn cell(&self, phase: Phase, curves: u8) -> Option<Cell<'_, S, L>> {
        let (index, u) = L::locate::<S>(phase.to_bits(), self.cells);
        let words = L::cell(self.words, index as usize, curves)?;
        Some(Cell {
            words,
            curves,
            constants: &self.constants,
            u,
            layout: PhantomData,
        })
    }

    /// Coefficients of a curve of the set, wide.
    fn wide(&self, cell: u32, role: Role) -> [S::Wide; 4] {
        let set = self.curves;
        let words = L::cell(self.words, cell as usize, set).unwrap_or_default();
        let column = role.column(self.curves).unwrap_or(0);
        let more = self.constants.more::<S>(role);
        let more = More {
            offset: S::widen(more.offset),
            gain: S::widen(more.gain),
        };
        L::coefficients::<S, _>(words, column, set, more, |word| S::widen(S::raw(word)))
    }

    /// p0…p3 of a curve of the set in machine units, in single precision.
    pub(crate) fn polynomial(&self, cell: u32, role: Role) -> [f32; 4] {
        let mut scale = 1.0;
        let centred = self.wide(cell, role).map(|coefficient| {
            let unscaled = S::approximate(role, coefficient) / scale;
            scale *= f32::from(L::step::<S>());
            unscaled
        });
        layout::about(centred, -L::centre::<S>() as f32)
    }
}

/// Whether the cubic of a cell is positive throughout, by its Bézier points (sufficient; the tabulator adds cells
/// until it holds).
fn is_positive(polynomial: [f32; 4]) -> bool {
    let hull = bezier(polynomial);
    // Above the roundings of these sums, so that no cell passes that dips below zero by a few units.
    let rounding = 1e-6 * hull.iter().fold(0.0f32, |most, b| most.max(b.abs()));
    hull.iter().all(|b| *b > rounding)
}

/// The Bézier points of a cubic: it stays within them.
pub(crate) fn bezier([p0, p1, p2, p3]: [f32; 4]) -> [f32; 4] {
    [
        p0,
        p0 + p1 / 3.0,
        p0 + (2.0 * p1 + p2) / 3.0,
        p0 + p1 + p2 + p3,
    ]
}

/// One cell's words and the place in it.
pub(crate) struct Cell<'a, S: Scalar, L: Layout> {
    words: &'a [S::Word],
    curves: u8,
    constants: &'a Constants<S::Word>,
    u: S::Fraction,
    layout: PhantomData<L>,
}

impl<S: Scalar, L: Layout> Cell<'_, S, L> {
    /// Coefficients of a curve of the set.
    #[inline]
    fn coefficients(&self, role: Role, column: usize) -> [S::Raw; 4] {
        let more = self.constants.more::<S>(role);
        L::coefficients::<S, _>(self.words, column, self.curves, more, S::raw)
    }

    /// J, and its slope a cell times the layout's step.
    #[inline]
    pub(crate) fn inertia(&self) -> (S::Raw, S::Raw) {
        L::value_and_slope::<S>(self.coefficients(Role::Inertia, 0), self.u)
    }

    /// A curve that the table may have.
    #[inline]
    fn curve(&self, role: Role) -> Option<S::Raw> {
        let column = role.column(self.curves)?;
        Some(L::value::<S>(self.coefficients(role, column), self.u))
    }

    #[inline]
    pub(crate) fn load(&self) -> Option<S::Raw> {
        self.curve(Role::Load)
    }

    /// b, its constant part included.
    #[inline]
    pub(crate) fn viscous(&self) -> Option<S::Raw> {
        let constant = S::raw(self.constants.viscous);
        match (
            self.curve(Role::Viscous),
            self.curves & curves::CONSTANT_VISCOUS != 0,
        ) {
            (Some(curve), true) => Some(curve + constant),
            (None, true) => Some(constant),
            (curve, false) => curve,
        }
    }

    /// |c|, its constant part included.
    #[inline]
    pub(crate) fn coulomb(&self) -> Option<S::Raw> {
        let constant = S::raw(self.constants.coulomb);
        let curve = self.curve(Role::Coulomb).map(S::magnitude);
        match (curve, self.curves & curves::CONSTANT_COULOMB != 0) {
            (Some(curve), true) => Some(curve + constant),
            (None, true) => Some(constant),
            (curve, false) => curve,
        }
    }

    #[inline]
    pub(crate) fn reciprocal(&self) -> Option<S::Raw> {
        self.curve(Role::Reciprocal)
    }
}
