//! Rows of 16-bit numbers, for processors without a long multiplication (Cortex-M0, M0+).
//!
//! The common equation in per-unit numbers [`Q15`]:
//!
//! ```text
//! inverse:  T = J(φ)·α + (V(φ)·ω + b(φ))·ω − load(φ) + c(φ)·sgn ω,      V = ½·J′·ω_b²/T_b
//! forward:  α = (T − (V(φ)·ω + b(φ))·ω + load(φ) − c(φ)·sgn ω)/J(φ)
//! ```
//!
//! J and load are quadratics in every cell, from uniform quadratic splines, and V is proportional to the slope of J: all three are continuous except
//! for the rounding of their numbers (test `value_and_slope_hardly_step_at_knots`). b, c and 1/J are linear between the knots. A
//! [`Scale::limited_to`](crate::Scale::limited_to) makes the best use of 16 bits.

mod check;
mod fill;
mod fit;
#[deny(clippy::float_arithmetic)]
mod kernel;
#[deny(clippy::float_arithmetic)]
mod row;
#[deny(clippy::float_arithmetic)]
mod tick;

use super::{CONSTANTS, Format, Row, Size, bases};
use crate::curve::curves::{self, CurveSet, has};
use crate::curve::samples::{Sample, Samples};
use crate::curve::{CellCurves, CurveValues, Table, TableError, Usage};
use crate::number::FrictionSign;
use crate::number::error::RangeError;
use crate::{Outcome, Phase, Q15};

/// Rows of packed 16-bit numbers: 12 bytes per cell, and 4 more for each of load, b(φ), c(φ) and 1/J. `docs/table-image.md` lists the words of a row.
///
/// The error has a floor of some units of 2⁻¹⁵ of the torque base: more cells make the numbers of a cell smaller, but not the error. For the example
/// press it stays above 1.2e-4 of the peak torque (test `the_floor_is_the_stated_one`). Forward dynamics needs one multiplication with
/// [`curves::RECIPROCAL`], without it one 32-bit division, which processors without a divider do in software.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rows16;

/// Constants of a table of [`Rows16`], in addition to its rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RowConstants {
    /// b in units of 2⁻³⁰. Only with [`curves::CONSTANT_VISCOUS`].
    pub viscous: i32,
    /// c in units of 2⁻³¹. Only with [`curves::CONSTANT_COULOMB`].
    pub coulomb: i32,
    /// k: 1/J is stored in units of 2⁻ᵏ, k = 0 … 15. Only with [`curves::RECIPROCAL`].
    pub shift: u32,
}

const ROW: Row = Row {
    head: 2,
    halves: 2,
    padded: false,
    more: 0,
};

const ONE_Q15: f64 = 1.0 / 32_768.0;
const ONE_Q31: f64 = 1.0 / 2_147_483_648.0;

/// The words of a cell.
fn row_of<'a>(table: &Table<'a, Rows16>, cell: u32) -> &'a [u32] {
    let words = row::length(table.set()).max(1);
    let mut rows = table.words().chunks_exact(words);
    rows.nth(cell as usize).unwrap_or_default()
}

/// The value of a line of the row at `phase`, if the set has this curve.
fn line(table: &Table<'_, Rows16>, phase: Phase, curve: CurveSet, index: usize) -> f64 {
    if !has(table.set(), curve) {
        return 0.0;
    }
    let (cell, u) = kernel::locate(phase, table.cells());
    f64::from(kernel::line(row::at(row_of(table, cell as u32), index), u))
}

/// V
fn velocity(table: &Table<'_, Rows16>, phase: Phase) -> f64 {
    let (cell, u) = kernel::locate(phase, table.cells());
    let word = row::at(row_of(table, cell as u32), row::velocity(table.set()));
    f64::from(kernel::line(word, u)) * ONE_Q15
}

impl Format for Rows16 {
    type Number = Q15;
    type Word = u32;
    type Constants = RowConstants;
    type Tick<'a> = tick::Tick<'a>;

    const NAME: &'static str = "rows";
    const CODES: Option<[u8; 2]> = Some([3, 5]);
    const SIZE: Size = Size::Rows(ROW);
    const WHOLE_FACTOR: bool = false;
    /// Half a unit of the result, and half a unit of 2⁻¹⁶ of V·ω + b (`tests/proofs/q15_rows.g`).
    const TICK_ROUNDING: f64 = 0.75 / 32_768.0;

    fn accepts(set: CurveSet) -> bool {
        curves::is_known(set)
    }

    fn check(table: &Table<'_, Self>) -> Result<(), TableError> {
        check::all(table)
    }

    fn read(table: &Table<'_, Self>, phase: Phase) -> CurveValues {
        let set = table.set();
        let (cell, u) = kernel::locate(phase, table.cells());
        let row = row_of(table, cell as u32);
        let word = |index| row::at(row, index);
        let start = word(row::start(set));
        let load = if has(set, curves::LOAD) {
            // The word contains half a unit of 2⁻¹⁵ to round the torque.
            32_768.0 - f64::from(kernel::minus_load(0, word(0), start, u))
        } else {
            0.0
        };
        let constant = |of: CurveSet, number: i32| f64::from(if has(set, of) { number } else { 0 });
        let constants = table.constants();
        let [torque, speed, inertia] = bases(table.scale());
        CurveValues {
            inertia: f64::from(kernel::inertia(word(row::inertia(set)), start, u)) / 65_536.0,
            inertia_slope: 2.0 * velocity(table, phase) * torque / (speed * speed) / inertia,
            load: load * ONE_Q31,
            viscous: line(table, phase, curves::VISCOUS, row::viscous(set)) * ONE_Q15
                + 2.0 * constant(curves::CONSTANT_VISCOUS, constants.viscous) * ONE_Q31,
            coulomb: line(table, phase, curves::COULOMB, row::coulomb(set)).abs() * ONE_Q15
                + constant(curves::CONSTANT_COULOMB, constants.coulomb) * ONE_Q31,
        }
    }

    fn si(table: &Table<'_, Self>, phase: Phase, _: f64) -> CurveValues {
        let read = Self::read(table, phase);
        let [torque, speed, inertia] = bases(table.scale());
        CurveValues {
            inertia: read.inertia * inertia,
            inertia_slope: 2.0 * velocity(table, phase) * torque / (speed * speed),
            load: read.load * torque,
            viscous: read.viscous * torque / speed,
            coulomb: read.coulomb * torque,
        }
    }

    fn cell_curves(table: &Table<'_, Self>, cell: u32, _: f64) -> Option<CellCurves> {
        let (set, constants) = (table.set(), table.constants());
        let word = |index| row::at(row_of(table, cell), index);
        // The line of a word, in units of its upper half, to which the lower half adds its fraction.
        let line = |index| {
            let word: u32 = word(index);
            [
                f64::from(word.cast_signed()) / 65_536.0,
                f64::from(word as i16),
            ]
        };
        let [torque, speed, inertia] = bases(table.scale());
        let start = word(row::start(set));
        let [j1, j2] = line(row::inertia(set));
        let j0 = f64::from(start) / 65_536.0;
        let slope = 2.0 * torque / (speed * speed);
        let [v0, v1] = line(row::velocity(set));
        let load = if has(set, curves::LOAD) {
            let [g1, g2] = line(0);
            // The word contains half a unit of 2⁻¹⁵ to round the torque.
            [0.5 - f64::from(start as i16), -g1, -g2, 0.0]
        } else {
            [0.0; 4]
        };
        let friction = |curve, constant, index, number: i32, units: f64| {
            if has(set, curve) {
                let [start, rise] = line(index);
                [start, rise, 0.0, 0.0]
            } else if has(set, constant) {
                [f64::from(number) / units, 0.0, 0.0, 0.0]
            } else {
                [0.0; 4]
            }
        };
        let viscous = friction(
            curves::VISCOUS,
            curves::CONSTANT_VISCOUS,
            row::viscous(set),
            constants.viscous,
            32_768.0,
        );
        let coulomb = friction(
            curves::COULOMB,
            curves::CONSTANT_COULOMB,
            row::coulomb(set),
            constants.coulomb,
            65_536.0,
        );
        Some(CellCurves {
            centre: 0.0,
            inertia: [j0, j1, j2, 0.0].map(|j| j / 65_536.0 * inertia),
            inertia_slope: [v0, v1, 0.0, 0.0].map(|v| v * ONE_Q15 * slope),
            load: load.map(|g| g * ONE_Q15 * torque),
            viscous: viscous.map(|b| b * ONE_Q15 * torque / speed),
            coulomb: coulomb.map(|c| c * ONE_Q15 * torque),
            offset: 0.0,
        })
    }

    fn reciprocal(table: &Table<'_, Self>, phase: Phase) -> Option<f64> {
        let index = row::reciprocal(table.set());
        let unit = f64::from(1u32 << table.constants().shift.min(15));
        Some(line(table, phase, curves::RECIPROCAL, index) / unit)
    }

    fn reciprocal_error(table: &Table<'_, Self>) -> f32 {
        check::reciprocal_error(table)
    }

    fn fill<E: From<TableError> + From<RangeError>>(
        samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
        scratch: &mut [f64],
        words: &mut [u32],
    ) -> Result<RowConstants, E> {
        fill::fill(samples, scratch, words)
    }

    fn base(curve: u8, set: CurveSet) -> &'static str {
        if usize::from(curve) == row::inertia(set) {
            "inertia"
        } else {
            "torque"
        }
    }

    fn header(constants: &RowConstants, _: CurveSet) -> [u32; CONSTANTS] {
        let [viscous, coulomb] = [constants.viscous, constants.coulomb].map(i32::cast_unsigned);
        [constants.shift, viscous, coulomb, 0, 0, 0, 0, 0, 0, 0, 0]
    }

    fn from_header(&[shift, viscous, coulomb, ..]: &[u32; CONSTANTS]) -> RowConstants {
        RowConstants {
            viscous: viscous.cast_signed(),
            coulomb: coulomb.cast_signed(),
            shift,
        }
    }

    fn usage(table: &Table<'_, Self>) -> Result<Usage, TableError> {
        Ok(check::usage(table))
    }

    fn prepare<'a>(table: &Table<'a, Self>) -> Result<tick::Tick<'a>, TableError> {
        check::velocity(table)?;
        tick::Tick::new(table)
    }

    #[inline(always)]
    fn moved<'a>(tick: &tick::Tick<'_>, table: &Table<'a, Self>, set: CurveSet) -> tick::Tick<'a> {
        tick.moved(table, set)
    }

    #[inline(always)]
    fn torque(
        _: &Table<'_, Self>,
        tick: &tick::Tick<'_>,
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        alpha: Q15,
        friction: FrictionSign<Q15>,
    ) -> Q15 {
        tick.torque(set, phase, omega, alpha, friction)
    }

    fn torque_terms(
        table: &Table<'_, Self>,
        tick: &tick::Tick<'_>,
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        alpha: Q15,
        friction: FrictionSign<Q15>,
    ) -> [Q15; 5] {
        let (cell, u) = kernel::locate(phase, table.cells());
        tick.torque_terms(set, row_of(table, cell as u32), u, omega, alpha, friction)
    }

    #[inline(always)]
    fn accelerations(
        _: &Table<'_, Self>,
        tick: &tick::Tick<'_>,
        set: CurveSet,
        phase: Phase,
        omega: Q15,
        friction: FrictionSign<Q15>,
        torques: [Q15; 2],
    ) -> [Outcome<Q15>; 2] {
        tick.accelerations(set, phase, omega, friction, torques)
    }
}
