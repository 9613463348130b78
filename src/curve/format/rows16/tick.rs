//! The tick over 16-bit rows.

use super::kernel;
use super::row::{self, Rows};
use crate::curve::curves::{self, CurveSet, has};
use crate::curve::format::Runs;
use crate::curve::{Table, TableError};
use crate::number::{FrictionSign, Outcome, fence};
use crate::{Phase, Q15};

/// Values that a tick reads from a table.
#[derive(Clone, Copy, Debug)]
pub struct Tick<'a> {
    rows: Rows<'a>,
    /// A constant b, Q30, plus half a unit to round (V·ω + b).
    viscous: i32,
    /// A constant c, Q31.
    coulomb: i32,
    shift: Shift,
}

/// 0 to 15: the compiler knows that it is less than 32, so that a shift by it costs one instruction.
#[derive(Clone, Copy, Debug)]
#[repr(u32)]
#[rustfmt::skip]
pub(super) enum Shift { S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15 }

impl Shift {
    #[rustfmt::skip]
    pub(super) fn new(shift: u32) -> Option<Self> {
        use Shift::{S0, S1, S10, S11, S12, S13, S14, S15, S2, S3, S4, S5, S6, S7, S8, S9};
        let all = [S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15];
        all.get(shift as usize).copied()
    }
}

impl<'a> Tick<'a> {
    pub(super) fn new(table: &Table<'a, super::Rows16>) -> Result<Self, TableError> {
        let (set, constants) = (table.set(), table.constants());
        let constant = |of: CurveSet, value: i32| if has(set, of) { value } else { 0 };
        let shift = if has(set, curves::RECIPROCAL) {
            constants.shift
        } else {
            0
        };
        Ok(Self {
            rows: Rows::new(table.words(), row::length(set)),
            viscous: constant(curves::CONSTANT_VISCOUS, constants.viscous).saturating_add(1 << 13),
            coulomb: constant(curves::CONSTANT_COULOMB, constants.coulomb),
            shift: Shift::new(shift).ok_or(TableError::Reciprocal { cell: 0 })?,
        })
    }

    #[inline(always)]
    pub(super) fn moved<'b>(&self, table: &Table<'b, super::Rows16>, set: CurveSet) -> Tick<'b> {
        Tick {
            rows: Rows::counted(table.words(), row::length(set), table.cells()),
            viscous: self.viscous,
            coulomb: self.coulomb,
            shift: self.shift,
        }
    }

    #[inline(always)]
    pub(super) fn torque(
        &self,
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        alpha: Q15,
        friction: FrictionSign<Q15>,
    ) -> Q15 {
        let rows = &self.rows;
        match row::length(set) {
            3 => self.torque_of(rows.a, set, phase, omega, alpha, friction),
            4 => self.torque_of(rows.b, set, phase, omega, alpha, friction),
            5 => self.torque_of(rows.c, set, phase, omega, alpha, friction),
            6 => self.torque_of(rows.d, set, phase, omega, alpha, friction),
            _ => self.torque_of(rows.e, set, phase, omega, alpha, friction),
        }
    }

    #[inline(always)]
    fn torque_of<const W: usize>(
        &self,
        rows: &[[u32; W]],
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        alpha: Q15,
        friction: FrictionSign<Q15>,
    ) -> Q15 {
        let (index, u) = kernel::locate(phase, rows.len() as u32);
        let Some(row) = rows.get(index) else {
            return Q15::default();
        };
        let start = row::at(row, row::start(set));
        let of_inertia = |sum: i32| {
            let inertia = kernel::inertia(row::at(row, row::inertia(set)), start, u);
            sum.wrapping_add(inertia.wrapping_mul(i32::from(alpha.to_bits())))
        };
        let sum = self.of_speed(set, row, u, omega);
        let sum = self.with_coulomb(set, sum, row, u, friction);
        kernel::torque(Self::with_load(set, of_inertia(sum), row, start, u))
    }

    /// Forward dynamics.
    #[inline(always)]
    pub(super) fn accelerations(
        &self,
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        friction: FrictionSign<Q15>,
        torques: [Q15; 2],
    ) -> [Outcome<Q15>; 2] {
        let rows = &self.rows;
        match row::length(set) {
            3 => self.accelerations_of(rows.a, set, phase, omega, friction, torques),
            4 => self.accelerations_of(rows.b, set, phase, omega, friction, torques),
            5 => self.accelerations_of(rows.c, set, phase, omega, friction, torques),
            6 => self.accelerations_of(rows.d, set, phase, omega, friction, torques),
            _ => self.accelerations_of(rows.e, set, phase, omega, friction, torques),
        }
    }

    #[inline(always)]
    fn accelerations_of<const W: usize>(
        &self,
        rows: &[[u32; W]],
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        friction: FrictionSign<Q15>,
        torques: [Q15; 2],
    ) -> [Outcome<Q15>; 2] {
        let (index, u) = kernel::locate(phase, rows.len() as u32);
        let Some(row) = rows.get(index) else {
            // Without the fence both exits share their last instructions, and every tick needs more of them.
            fence();
            return [Outcome::default(); 2];
        };
        let start = row::at(row, row::start(set));
        let resisting = if set & !curves::RECIPROCAL == curves::INERTIA {
            let velocity = kernel::line(row::at(row, row::velocity(set)), u);
            kernel::of_speed_alone(velocity, i32::from(omega.to_bits()))
        } else {
            let resisting = self.of_speed(set, row, u, omega);
            let resisting = self.with_coulomb(set, resisting, row, u, friction);
            Self::with_load(set, resisting, row, start, u) >> 16
        };
        let inertia = if has(set, curves::RECIPROCAL) {
            kernel::line(row::at(row, row::reciprocal(set)), u)
        } else {
            kernel::inertia(row::at(row, row::inertia(set)), start, u)
        };
        let outcome = |torque| self.outcome(set, torque, resisting, inertia);
        // Not by `map`: it may become a loop.
        [outcome(torques[0]), outcome(torques[1])]
    }

    /// (torque − resisting)/J, by 1/J or J.
    #[inline(always)]
    fn outcome(&self, set: CurveSet, torque: Q15, resisting: i32, inertia: i32) -> Outcome<Q15> {
        let net = i32::from(torque.to_bits()).wrapping_sub(resisting);
        if has(set, curves::RECIPROCAL) {
            kernel::limited(inertia.wrapping_mul(net) >> (self.shift as u32))
        } else {
            kernel::quotient(net, inertia)
        }
    }

    /// (V·ω + b)·ω in Q31
    #[inline(always)]
    fn of_speed(&self, set: CurveSet, row: &[u32], u: i32, omega: Q15) -> i32 {
        let omega = i32::from(omega.to_bits());
        let b = self.viscous(set, row, u);
        let velocity = kernel::line(row::at(row, row::velocity(set)), u);
        kernel::of_speed(velocity, b, omega)
    }

    /// J·α, ½·J′·ω², −load, b·ω and c·sgn ω, from the row of a cell and the place in it.
    pub(super) fn torque_terms(
        &self,
        set: CurveSet,
        row: &[u32],
        u: i32,
        omega: Q15,
        alpha: Q15,
        friction: FrictionSign<Q15>,
    ) -> [Q15; 5] {
        let half = 1 << 15;
        let start = row::at(row, row::start(set));
        let inertia = kernel::inertia(row::at(row, row::inertia(set)), start, u);
        let velocity = kernel::line(row::at(row, row::velocity(set)), u);
        let omega = i32::from(omega.to_bits());
        let coulomb = self.with_coulomb(set, half, row, u, friction);
        [
            inertia
                .wrapping_mul(i32::from(alpha.to_bits()))
                .wrapping_add(half),
            kernel::of_speed(velocity, 1 << 13, omega).wrapping_add(half),
            Self::with_load(set, 0, row, start, u),
            kernel::of_speed(0, self.viscous(set, row, u), omega).wrapping_add(half),
            coulomb,
        ]
        .map(kernel::torque)
    }

    /// b in Q30, plus half a unit to round (V·ω + b).
    #[inline(always)]
    fn viscous(&self, set: CurveSet, row: &[u32], u: i32) -> i32 {
        if has(set, curves::VISCOUS) {
            let b = kernel::line(row::at(row, row::viscous(set)), u) << 15;
            return self.viscous.wrapping_add(b);
        }
        self.viscous
    }

    /// sum + |c|·sgn ω in Q31
    #[inline(always)]
    fn with_coulomb(
        &self,
        set: CurveSet,
        sum: i32,
        row: &[u32],
        u: i32,
        friction: FrictionSign<Q15>,
    ) -> i32 {
        if has(set, curves::COULOMB) {
            let c = kernel::line(row::at(row, row::coulomb(set)), u);
            return kernel::add_sliding(sum, c, friction);
        }
        if has(set, curves::CONSTANT_COULOMB) {
            return kernel::add_constant(sum, self.coulomb, friction);
        }
        sum
    }

    /// sum − load, plus half a unit of the result for rounding, which the table of a load contains.
    #[inline(always)]
    fn with_load(set: CurveSet, sum: i32, row: &[u32], start: u32, u: i32) -> i32 {
        if has(set, curves::LOAD) {
            kernel::minus_load(sum, row::at(row, 0), start, u)
        } else {
            sum.wrapping_add(1 << 15)
        }
    }
}
