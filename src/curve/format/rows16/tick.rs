//! The tick over 16-bit rows.

#![allow(
    clippy::inline_always,
    reason = "inlined later, each function has been optimised for itself: loads move out of branches and past fences"
)]

use super::kernel;
use super::row::{self, Rows};
use crate::curve::curves::{self, Set, has};
use crate::curve::{Table, TableError};
use crate::number::Outcome;
use crate::{Phase, Q15};

/// What a tick takes of a table.
#[derive(Clone, Copy, Debug)]
pub struct Tick<'a> {
    rows: Rows<'a>,
    /// A constant b, Q30, and half a unit to round (V·ω + b).
    viscous: i32,
    /// A constant c, Q31.
    coulomb: i32,
    shift: Shift,
}

/// 0 to 15: the compiler knows that it is less than 32, so that shifting by it costs one instruction.
#[derive(Clone, Copy, Debug)]
#[repr(u32)]
#[rustfmt::skip]
pub(super) enum Shift { S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15 }

impl Shift {
    #[rustfmt::skip]
    pub(super) fn new(shift: u32) -> Option<Self> {
        use Shift::{S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15};
        let all = [S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15];
        all.get(shift as usize).copied()
    }
}

impl<'a> Tick<'a> {
    pub(super) fn new(table: &Table<'a, super::Rows16>) -> Result<Self, TableError> {
        let (set, constants) = (table.set(), table.constants());
        let constant = |of: Set, value: i32| if has(set, of) { value } else { 0 };
        let shift = if has(set, curves::RECIPROCAL) {
            constants.shift
        } else {
            0
        };
        Ok(Self {
            rows: Rows::new(table.words(), set),
            viscous: constant(curves::CONSTANT_VISCOUS, constants.viscous).saturating_add(1 << 13),
            coulomb: constant(curves::CONSTANT_COULOMB, constants.coulomb),
            shift: Shift::new(shift).ok_or(TableError::Reciprocal { cell: 0 })?,
        })
    }

    #[inline(always)]
    pub(super) fn torque(&self, set: Set, phase: Phase, omega: Q15, alpha: Q15) -> Q15 {
        let rows = &self.rows;
        match row::length(set) {
            3 => self.torque_of(rows.three, set, phase, omega, alpha),
            4 => self.torque_of(rows.four, set, phase, omega, alpha),
            5 => self.torque_of(rows.five, set, phase, omega, alpha),
            6 => self.torque_of(rows.six, set, phase, omega, alpha),
            _ => self.torque_of(rows.seven, set, phase, omega, alpha),
        }
    }

    #[inline(always)]
    fn torque_of<const W: usize>(
        &self,
        rows: &[[u32; W]],
        set: Set,
        phase: Phase,
        omega: Q15,
        alpha: Q15,
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
        if has(set, curves::COULOMB | curves::CONSTANT_COULOMB) {
            let sum = self.of_speed(set, row, u, omega);
            return kernel::torque(Self::with_load(set, of_inertia(sum), row, start, u));
        }
        let sum = Self::with_load(set, 0, row, start, u);
        let sum = of_inertia(sum);
        // V and b are not read before J·α is done with its registers.
        kernel::fence();
        kernel::torque(sum.wrapping_add(self.of_speed(set, row, u, omega)))
    }

    /// Forward dynamics.
    #[inline(always)]
    pub(super) fn accelerations<const N: usize>(
        &self,
        set: Set,
        phase: Phase,
        omega: Q15,
        torques: [Q15; N],
    ) -> [Outcome<Q15>; N] {
        let rows = &self.rows;
        match row::length(set) {
            3 => self.accelerations_of(rows.three, set, phase, omega, torques),
            4 => self.accelerations_of(rows.four, set, phase, omega, torques),
            5 => self.accelerations_of(rows.five, set, phase, omega, torques),
            6 => self.accelerations_of(rows.six, set, phase, omega, torques),
            _ => self.accelerations_of(rows.seven, set, phase, omega, torques),
        }
    }

    #[inline(always)]
    fn accelerations_of<const W: usize, const N: usize>(
        &self,
        rows: &[[u32; W]],
        set: Set,
        phase: Phase,
        omega: Q15,
        torques: [Q15; N],
    ) -> [Outcome<Q15>; N] {
        let (index, u) = kernel::locate(phase, rows.len() as u32);
        let Some(row) = rows.get(index) else {
            // Or both ways out share their last instructions, and every tick takes more of them.
            kernel::fence();
            return [Outcome::default(); N];
        };
        let start = row::at(row, row::start(set));
        let resisting = if set & !curves::RECIPROCAL == curves::INERTIA {
            let velocity = kernel::line(row::at(row, row::velocity(set)), u);
            kernel::of_speed_alone(velocity, i32::from(omega.to_bits()))
        } else {
            let resisting = self.of_speed(set, row, u, omega);
            Self::with_load(set, resisting, row, start, u) >> 16
        };
        let inertia = if has(set, curves::RECIPROCAL) {
            kernel::line(row::at(row, row::reciprocal(set)), u)
        } else {
            kernel::inertia(row::at(row, row::inertia(set)), start, u)
        };
        torques.map(|torque| self.outcome(set, torque, resisting, inertia))
    }

    /// (torque − resisting)/J, of 1/J or J.
    #[inline(always)]
    fn outcome(&self, set: Set, torque: Q15, resisting: i32, inertia: i32) -> Outcome<Q15> {
        let net = i32::from(torque.to_bits()).wrapping_sub(resisting);
        if has(set, curves::RECIPROCAL) {
            kernel::limited(inertia.wrapping_mul(net) >> (self.shift as u32))
        } else {
            kernel::quotient(net, inertia)
        }
    }

    /// (V·ω + b)·ω + c·sgn ω in Q31
    #[inline(always)]
    fn of_speed(&self, set: Set, row: &[u32], u: i32, omega: Q15) -> i32 {
        let omega = i32::from(omega.to_bits());
        let mut b = self.viscous;
        if has(set, curves::VISCOUS) {
            b = b.wrapping_add(kernel::line(row::at(row, row::viscous(set)), u) << 15);
        }
        let velocity = kernel::line(row::at(row, row::velocity(set)), u);
        let sum = kernel::of_speed(velocity, b, omega);
        if has(set, curves::COULOMB) {
            let c = kernel::line(row::at(row, row::coulomb(set)), u).wrapping_abs() << 16;
            return kernel::add_signed(sum, || c, omega);
        }
        if has(set, curves::CONSTANT_COULOMB) {
            return kernel::add_signed(sum, || self.coulomb, omega);
        }
        sum
    }

    /// sum − load, and half a unit of the result to round it: that of a load is in the table.
    #[inline(always)]
    fn with_load(set: Set, sum: i32, row: &[u32], start: u32, u: i32) -> i32 {
        if has(set, curves::LOAD) {
            kernel::minus_load(sum, row::at(row, 0), start, u)
        } else {
            sum.wrapping_add(1 << 15)
        }
    }
}
