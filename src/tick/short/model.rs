//! The tick over 16-bit rows.

#![allow(
    clippy::inline_always,
    reason = "inlined later, each function has been optimised for itself: loads move out of branches and past fences"
)]

use super::kernel;
use super::row::{self, has};
use super::{Table, check};
use crate::curve::{TableError, curves};
use crate::number::Outcome;
use crate::tick::AccelerationRange;
use crate::{Domain, Phase, Q15, Scale};

/// A reduced machine ready for the tick, over a table of 16-bit rows in RAM or in flash.
///
/// Everything was checked when it was built: [`torque`](Self::torque), [`acceleration`](Self::acceleration) and
/// [`acceleration_range`](Self::acceleration_range) neither fail nor panic nor allocate.
#[derive(Clone, Copy, Debug)]
pub struct Model<'a, const CURVES: u8> {
    table: Table<'a>,
    /// Constant part of b, Q30, and half a unit to round (V·ω + b).
    viscous: i32,
    /// Constant part of c, Q31.
    coulomb: i32,
    shift: Shift,
}

/// 0 to 15: the compiler knows that it is less than 32, so that shifting by it costs one instruction.
#[derive(Clone, Copy, Debug)]
#[repr(u32)]
#[rustfmt::skip]
enum Shift { S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15 }

impl Shift {
    #[rustfmt::skip]
    fn new(shift: u32) -> Option<Self> {
        use Shift::{S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15};
        let all = [S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12, S13, S14, S15];
        all.get(shift as usize).copied()
    }
}

impl<'a, const CURVES: u8> Model<'a, CURVES> {
    /// A model over `table`, whose range is `span` (2π, or the stroke in m) and whose machine units are `scale`.
    ///
    /// # Errors
    /// [`TableError::Curves`]: the table has another set. [`TableError::Slope`]: V is not the slope of J in these machine units:
    /// not the table's span or scale.
    pub fn new(table: Table<'a>, span: f32, scale: &Scale) -> Result<Self, TableError> {
        if table.curves() != CURVES {
            return Err(TableError::Curves(table.curves()));
        }
        check::velocity(&table, span, scale)?;
        let constants = table.constants();
        let constant = |of: u8, value: i32| if has(CURVES, of) { value } else { 0 };
        let shift = if has(CURVES, curves::RECIPROCAL) {
            constants.shift
        } else {
            0
        };
        Ok(Self {
            table,
            viscous: constant(curves::CONSTANT_VISCOUS, constants.viscous).saturating_add(1 << 13),
            coulomb: constant(curves::CONSTANT_COULOMB, constants.coulomb),
            shift: Shift::new(shift).ok_or(TableError::Reciprocal { cell: 0 })?,
        })
    }

    /// As [`new`](Self::new), with the range of the machine that the table was made from.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn for_domain(table: Table<'a>, domain: Domain, scale: &Scale) -> Result<Self, TableError> {
        Self::new(table, domain.to_f32().span(), scale)
    }

    /// The table.
    pub const fn table(&self) -> &Table<'a> {
        &self.table
    }

    /// How far forward and inverse dynamics disagree at most, as a part of the acceleration, beside the roundings of torques: see
    /// [`Table::reciprocal_error`]. 0 for a model that divides.
    pub fn reciprocal_error(&self) -> f32 {
        self.table.reciprocal_error().unwrap_or(0.0)
    }

    /// Inverse dynamics: the torque on the drive link that the motion needs. It never saturates.
    ///
    /// Against the curves that the table holds it is off by at most ¾ of a unit of 2⁻¹⁵ (test
    /// `torque_is_that_of_the_curves`).
    #[inline]
    pub fn torque(&self, phase: Phase, omega: Q15, alpha: Q15) -> Q15 {
        let rows = &self.table.rows;
        match row::row_words(CURVES) {
            3 => self.torque_of(rows.three, phase, omega, alpha),
            4 => self.torque_of(rows.four, phase, omega, alpha),
            5 => self.torque_of(rows.five, phase, omega, alpha),
            6 => self.torque_of(rows.six, phase, omega, alpha),
            _ => self.torque_of(rows.seven, phase, omega, alpha),
        }
    }

    #[inline(always)]
    fn torque_of<const W: usize>(
        &self,
        rows: &[[u32; W]],
        phase: Phase,
        omega: Q15,
        alpha: Q15,
    ) -> Q15 {
        let (index, u) = kernel::locate(phase, rows.len() as u32);
        let Some(row) = rows.get(index) else {
            return Q15::default();
        };
        let start = row::at(row, row::start(CURVES));
        let of_inertia = |sum: i32| {
            let inertia = kernel::inertia(row::at(row, row::inertia(CURVES)), start, u);
            sum.wrapping_add(inertia.wrapping_mul(i32::from(alpha.to_bits())))
        };
        if has(CURVES, curves::COULOMB | curves::CONSTANT_COULOMB) {
            let sum = self.of_speed(row, u, omega);
            return kernel::torque(Self::with_load(of_inertia(sum), row, start, u));
        }
        let sum = Self::with_load(0, row, start, u);
        let sum = of_inertia(sum);
        // V and b are not read before J·α is done with its registers.
        kernel::fence();
        kernel::torque(sum.wrapping_add(self.of_speed(row, u, omega)))
    }

    /// Inverse dynamics of many samples: `torques[k]` becomes the torque at `phases[k]`, `omegas[k]`, `alphas[k]`. As many as
    /// the shortest slice has; their number is returned.
    pub fn torques(
        &self,
        phases: &[Phase],
        omegas: &[Q15],
        alphas: &[Q15],
        torques: &mut [Q15],
    ) -> usize {
        let samples = phases.iter().zip(omegas).zip(alphas).zip(torques);
        samples
            .map(|(((phase, omega), alpha), torque)| *torque = self.torque(*phase, *omega, *alpha))
            .count()
    }

    /// Forward dynamics: the acceleration that a torque on the drive link gives.
    ///
    /// With [`curves::RECIPROCAL`] one multiplication; without it one division of 32 bits, which processors without a divider
    /// do in software.
    #[inline]
    pub fn acceleration(&self, phase: Phase, omega: Q15, torque: Q15) -> Outcome<Q15> {
        self.forward(phase, omega, |resisting, inertia| {
            self.outcome(torque, resisting, inertia)
        })
    }

    /// The accelerations that torques from `least` to `greatest` can give: the limits for whatever plans the motion.
    #[inline]
    pub fn acceleration_range(
        &self,
        phase: Phase,
        omega: Q15,
        least: Q15,
        greatest: Q15,
    ) -> AccelerationRange<Q15> {
        self.forward(phase, omega, |resisting, inertia| AccelerationRange {
            least: self.outcome(least, resisting, inertia),
            greatest: self.outcome(greatest, resisting, inertia),
        })
    }

    /// What `then` makes of the torque that resists (Q15), and of 1/J or J.
    #[inline(always)]
    fn forward<R: Default>(&self, phase: Phase, omega: Q15, then: impl FnOnce(i32, i32) -> R) -> R {
        let rows = &self.table.rows;
        match row::row_words(CURVES) {
            3 => self.forward_of(rows.three, phase, omega, then),
            4 => self.forward_of(rows.four, phase, omega, then),
            5 => self.forward_of(rows.five, phase, omega, then),
            6 => self.forward_of(rows.six, phase, omega, then),
            _ => self.forward_of(rows.seven, phase, omega, then),
        }
    }

    #[inline(always)]
    fn forward_of<const W: usize, R: Default>(
        &self,
        rows: &[[u32; W]],
        phase: Phase,
        omega: Q15,
        then: impl FnOnce(i32, i32) -> R,
    ) -> R {
        let (index, u) = kernel::locate(phase, rows.len() as u32);
        let Some(row) = rows.get(index) else {
            // Or both ways out share their last instructions, and every tick takes more of them.
            kernel::fence();
            return R::default();
        };
        let start = row::at(row, row::start(CURVES));
        let resisting = if CURVES & !curves::RECIPROCAL == curves::INERTIA {
            let velocity = kernel::line(row::at(row, row::velocity(CURVES)), u);
            kernel::of_speed_alone(velocity, i32::from(omega.to_bits()))
        } else {
            let resisting = self.of_speed(row, u, omega);
            Self::with_load(resisting, row, start, u) >> 16
        };
        let inertia = if has(CURVES, curves::RECIPROCAL) {
            kernel::line(row::at(row, row::reciprocal(CURVES)), u)
        } else {
            kernel::inertia(row::at(row, row::inertia(CURVES)), start, u)
        };
        then(resisting, inertia)
    }

    /// (torque − resisting)/J, of 1/J or J.
    #[inline(always)]
    fn outcome(&self, torque: Q15, resisting: i32, inertia: i32) -> Outcome<Q15> {
        let net = i32::from(torque.to_bits()).wrapping_sub(resisting);
        if has(CURVES, curves::RECIPROCAL) {
            kernel::limited(inertia.wrapping_mul(net) >> (self.shift as u32))
        } else {
            kernel::quotient(net, inertia)
        }
    }

    /// (V·ω + b)·ω + c·sgn ω in Q31
    #[inline(always)]
    fn of_speed(&self, row: &[u32], u: i32, omega: Q15) -> i32 {
        let omega = i32::from(omega.to_bits());
        let mut b = self.viscous;
        if has(CURVES, curves::VISCOUS) {
            b = b.wrapping_add(kernel::line(row::at(row, row::viscous(CURVES)), u) << 15);
        }
        let velocity = kernel::line(row::at(row, row::velocity(CURVES)), u);
        let sum = kernel::of_speed(velocity, b, omega);
        if has(CURVES, curves::COULOMB) {
            let c = kernel::line(row::at(row, row::coulomb(CURVES)), u).wrapping_abs() << 16;
            return kernel::add_signed(sum, || c.wrapping_add(self.coulomb), omega);
        }
        if has(CURVES, curves::CONSTANT_COULOMB) {
            return kernel::add_signed(sum, || self.coulomb, omega);
        }
        sum
    }

    /// sum − load, and half a unit of the result to round it: that of a load is in the table.
    #[inline(always)]
    fn with_load(sum: i32, row: &[u32], start: u32, u: i32) -> i32 {
        if has(CURVES, curves::LOAD) {
            kernel::minus_load(sum, row::at(row, 0), start, u)
        } else {
            sum.wrapping_add(1 << 15)
        }
    }
}
