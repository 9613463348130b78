//! One cell of a table and the place in it: its curves, and the terms of the equation of motion.

use super::{Constants, Fraction, Layout, More, Raw, Word};
use crate::Phase;
use crate::curve::curves::{self, CurveSet, has};
use crate::curve::format::bases;
use crate::curve::{CellCurves, Table};
use crate::number::{FrictionSign, Kernel, Ring, Role};

/// One cell's words and the place in it.
pub(super) struct Cell<'a, L: Layout> {
    words: &'a [Word<L>],
    set: CurveSet,
    constants: &'a Constants<Word<L>>,
    u: Fraction<L>,
}

impl<'a, L: Layout> Cell<'a, L> {
    /// The cell around `phase` of a table whose set is `set`, which a model knows at compile time. Always `Some`: the length was checked when the
    /// table was created. The check costs a compare, not a panic path.
    #[inline(always)]
    pub(super) fn of(
        table: &'a Table<'_, L>,
        rows: &L::Rows<'a>,
        phase: Phase,
        set: CurveSet,
    ) -> Option<Self> {
        let (index, u) = L::locate(phase.to_bits(), L::cells(rows, table, set));
        Some(Self {
            words: L::cell(rows, index as usize, set)?,
            set,
            constants: table.constants(),
            u,
        })
    }

    /// One cell of a table, without a model.
    pub(super) fn at(table: &'a Table<'_, L>, phase: Phase) -> Option<Self> {
        let rows = L::rows(table.words(), table.set());
        Self::of(table, &rows, phase, table.set())
    }

    /// Coefficients of a curve of the set.
    #[inline(always)]
    fn coefficients(&self, role: Role, column: usize) -> [Raw<L>; 4] {
        let more = self.constants.more::<L>(role);
        L::coefficients(self.words, column, self.set, more, L::Number::raw)
    }

    /// J, and its slope per cell times the layout's step.
    #[inline(always)]
    pub(super) fn inertia(&self) -> (Raw<L>, Raw<L>) {
        L::value_and_slope(self.coefficients(Role::Inertia, 0), self.u)
    }

    /// A curve of the table, if present.
    #[inline(always)]
    pub(super) fn curve(&self, role: Role) -> Option<Raw<L>> {
        let column = role.column(self.set)?;
        Some(L::value(self.coefficients(role, column), self.u))
    }

    /// b
    #[inline(always)]
    pub(super) fn viscous(&self) -> Option<Raw<L>> {
        if has(self.set, curves::CONSTANT_VISCOUS) {
            return Some(L::Number::raw(self.constants.viscous));
        }
        self.curve(Role::Viscous)
    }

    /// c, with any sign.
    #[inline(always)]
    pub(super) fn coulomb(&self) -> Option<Raw<L>> {
        if has(self.set, curves::CONSTANT_COULOMB) {
            return Some(L::Number::raw(self.constants.coulomb));
        }
        self.curve(Role::Coulomb)
    }

    /// ½·J′·ω + b
    #[inline(always)]
    pub(super) fn speed_coefficient(
        &self,
        slope: Raw<L>,
        factor: <L::Number as Kernel>::Factor,
        omega: L::Number,
    ) -> Raw<L> {
        let velocity = L::Number::velocity(slope, factor, omega);
        self.viscous().map_or(velocity, |b| velocity + b)
    }

    /// J·α, ½·J′·ω², −load, b·ω and c·sgn ω.
    #[inline(always)]
    pub(super) fn torque_terms(
        &self,
        factor: <L::Number as Kernel>::Factor,
        omega: L::Number,
        alpha: L::Number,
        friction: FrictionSign<L::Number>,
    ) -> [L::Number; 5] {
        let zero = Raw::<L>::default();
        let (inertia, slope) = self.inertia();
        let velocity = L::Number::velocity(slope, factor, omega);
        let speed = |b| L::Number::product(b, omega);
        [
            L::Number::product(inertia, alpha),
            speed(velocity),
            self.curve(Role::Load).map_or(zero, |load| zero - load),
            self.viscous().map_or(zero, speed),
            self.coulomb()
                .map_or(zero, |c| L::Number::add_sliding(zero, c, friction)),
        ]
        .map(L::Number::torque)
    }

    /// sum − load, if the machine has one.
    #[inline(always)]
    pub(super) fn with_load(&self, sum: Raw<L>) -> Raw<L> {
        self.curve(Role::Load).map_or(sum, |load| sum - load)
    }

    /// sum + |c|·sgn ω, if the machine has friction.
    #[inline(always)]
    pub(super) fn with_friction(&self, sum: Raw<L>, friction: FrictionSign<L::Number>) -> Raw<L> {
        let coulomb = self.coulomb();
        coulomb.map_or(sum, |c| L::Number::add_sliding(sum, c, friction))
    }
}

impl<W: Copy> Constants<W> {
    #[inline(always)]
    const fn gain(&self, role: Role) -> u16 {
        let [inertia, load, viscous, coulomb, reciprocal] = self.gains;
        match role {
            Role::Inertia => inertia,
            Role::Load => load,
            Role::Viscous => viscous,
            Role::Coulomb => coulomb,
            Role::Reciprocal => reciprocal,
        }
    }

    #[inline(always)]
    fn more<L: Layout>(&self, role: Role) -> More<Raw<L>>
    where
        L::Number: Kernel<Word = W>,
    {
        More {
            offset: matches!(role, Role::Inertia).then(|| L::Number::raw(self.inertia)),
            gain: Ring::whole(self.gain(role)),
        }
    }
}

/// Coefficients of a curve of the set, in double precision.
pub(super) fn wide<L: Layout>(
    table: &Table<'_, L>,
    cell: u32,
    role: Role,
) -> [<L::Number as Kernel>::Wide; 4] {
    let set = table.set();
    let rows = L::rows(table.words(), set);
    let words = L::cell(&rows, cell as usize, set).unwrap_or_default();
    let column = role.column(set).unwrap_or(0);
    let more = table.constants().more::<L>(role);
    let more = More {
        offset: more.offset.map(L::Number::widen),
        gain: L::Number::widen(more.gain),
    };
    let read = |word| L::Number::widen(L::Number::raw(word));
    L::coefficients(words, column, set, more, read)
}

/// The curves of a cell as polynomials in SI units, computed in double precision from the words.
pub(super) fn curves<L: Layout>(
    table: &Table<'_, L>,
    cell: u32,
    cells_per_position: f64,
) -> Option<CellCurves> {
    let (set, constants) = (table.set(), table.constants());
    let rows = L::rows(table.words(), set);
    let words = L::cell(&rows, cell as usize, set)?;
    let exact = |role, word| L::Number::exact(role, L::Number::raw(word));
    let curve = |role: Role, base: f64| {
        let Some(column) = role.column(set) else {
            return [0.0; 4];
        };
        let more = constants.more::<L>(role);
        let more = More {
            offset: more.offset.map(|offset| L::Number::exact(role, offset)),
            gain: f64::from(constants.gain(role)),
        };
        let stored: [f64; 4] = L::coefficients(words, column, set, more, |word| exact(role, word));
        let mut step = 1.0;
        stored.map(|coefficient| {
            let unscaled = coefficient / step * base;
            step *= f64::from(L::STEP);
            unscaled
        })
    };
    let constant = |of: CurveSet, role, word, base: f64| {
        if has(set, of) {
            [exact(role, word) * base, 0.0, 0.0, 0.0]
        } else {
            curve(role, base)
        }
    };
    let [torque, speed, inertia_base] = bases(table.scale());
    let inertia = curve(Role::Inertia, inertia_base);
    let [_, p1, p2, p3] = inertia;
    Some(CellCurves {
        centre: L::CENTRE,
        inertia,
        inertia_slope: [p1, 2.0 * p2, 3.0 * p3, 0.0].map(|slope| slope * cells_per_position),
        load: curve(Role::Load, torque),
        viscous: constant(
            curves::CONSTANT_VISCOUS,
            Role::Viscous,
            constants.viscous,
            torque / speed,
        ),
        coulomb: constant(
            curves::CONSTANT_COULOMB,
            Role::Coulomb,
            constants.coulomb,
            torque,
        ),
        offset: exact(Role::Inertia, constants.inertia) * inertia_base,
    })
}

/// p0…p3 of a curve of the set in machine units, in single precision.
pub(super) fn polynomial<L: Layout>(table: &Table<'_, L>, cell: u32, role: Role) -> [f32; 4] {
    let mut scale = 1.0;
    let centred = wide(table, cell, role).map(|coefficient| {
        let unscaled = L::Number::approximate(role, coefficient) / scale;
        scale *= f32::from(L::STEP);
        unscaled
    });
    super::about(centred, -L::CENTRE as f32)
}
