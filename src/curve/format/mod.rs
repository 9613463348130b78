//! Table formats: memory layout and evaluation of curves.
//!
//! The polynomial formats have in each cell
//!
//! ```text
//! f(u) = p0 + u·(p1 + u·(p2 + u·p3)),   u in [0, 1) within the cell
//! ```
//!
//! whose value and slope use the same coefficients. All curves of a cell are stored side by side: one index, one contiguous read.
//!
//! | format | words per curve and cell | continuous | for |
//! |---|---|---|---|
//! | [`Spline`] | 1 | value, slope, curvature | the smallest table |
//! | [`Spline16`] | ½ | as [`Spline`] | less than half of that, down to an error of about 1e-4 |
//! | [`Cubic`] | 4 | as the original curve | the fastest tick |
//! | [`Quadratic`] | 3, rows padded to 4 | value, slope | the fastest tick without a long multiplication |
//! | [`Rows16`] | 1, plus 2 per cell | value, slope, except for 16-bit rounding | processors without a long multiplication |
//!
//! Without cells: [`Harmonic`] stores a short Fourier series of each curve, `SliderCrankForm` (feature `micromath`) the lengths and masses of a
//! slider-crank.

mod harmonic;
mod layout;
mod row;
mod rows16;
#[cfg(feature = "micromath")]
mod slider_crank;

#[cfg(feature = "mechanics")]
pub(crate) use harmonic::in_use;
pub use harmonic::{Circular, Coefficient, Curve, Harmonic, Kind, MAX_HARMONICS, terms};
pub use layout::{Constants, Cubic, Quadratic, Spline, Spline16};
pub(crate) use row::{Row, Rows, Runs, Size};
pub use rows16::{RowConstants, Rows16};
#[cfg(all(feature = "mechanics", feature = "micromath"))]
pub(crate) use slider_crank::COEFFICIENTS;
#[cfg(feature = "micromath")]
pub use slider_crank::{
    Coefficient as CrankCoefficient, STEEPEST, SliderCrankForm, terms as crank_terms,
};

use super::curves::CurveSet;
use super::samples::{Sample, Samples};
use super::table::{CellCurves, CurveValues, Table};
use super::{MAX_CELLS, TableError, Usage};
use crate::number::error::RangeError;
use crate::number::spline::MIN_CELLS;
use crate::number::{FrictionSign, Number};
use crate::{Outcome, Phase, Scale};

/// Words of the image's header for the constants of a table.
pub(crate) const CONSTANTS: usize = 11;

/// A way to store and evaluate curves. Sealed: [`Spline`], [`Spline16`], [`Cubic`], [`Quadratic`], [`Rows16`], [`Harmonic`], and with feature
/// `micromath` `SliderCrankForm`.
///
/// A program can be generic over it, for any number type of the format:
///
/// ```
/// # use jred::table::{Format, words_len};
/// # use jred::{Cubic, Harmonic, Q31, Rows16, Spline, curves};
/// const fn bytes<F: Format>(cells: u32) -> usize {
///     words_len::<F>(cells, curves::LOAD) * size_of::<F::Word>()
/// }
/// let all = [bytes::<Spline<f32>>(64), bytes::<Cubic<Q31>>(64), bytes::<Rows16>(64), bytes::<Harmonic<f32>>(64)];
/// ```
///
/// Splines have no 16-bit numbers, harmonics no fixed point, and other crates cannot add a format:
///
/// ```compile_fail,E0277
/// # use jred::{Q15, Spline, curves, table::words_len};
/// let words = words_len::<Spline<Q15>>(64, curves::LOAD);
/// ```
///
/// ```compile_fail,E0277
/// # use jred::{Harmonic, Q31, curves, table::words_len};
/// let words = words_len::<Harmonic<Q31>>(64, curves::LOAD);
/// ```
///
/// ```compile_fail,E0277
/// # use jred::{CurveSet, Outcome, Phase, Scale, table::{CurveValues, Format, Table, TableError, Usage}};
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Mine;
/// impl Format for Mine {}
/// ```
pub trait Format: crate::sealed::Sealed + Copy + core::fmt::Debug + PartialEq + 'static {
    /// Numbers of a tick, as [`SpeedOf`], [`AccelerationOf`] and [`TorqueOf`] this format.
    type Number: Number;
    /// A word of the table.
    type Word: bytemuck::Pod + Default + core::fmt::Debug + PartialEq;
    /// Constants of a table, in addition to its rows.
    type Constants: Copy + core::fmt::Debug + Default + PartialEq;
    /// Values that a tick needs in addition to the table, computed once by [`prepare`](Self::prepare).
    #[doc(hidden)]
    type Tick<'a>: Copy + core::fmt::Debug;

    /// Name in the command line.
    const NAME: &'static str;
    /// Codes of number type and format in the image's header; `None` if images do not store it.
    #[doc(hidden)]
    const CODES: Option<[u8; 2]>;
    /// Whether the upper half of its set of curves has terms of harmonics.
    #[doc(hidden)]
    const TERMS: bool = false;
    /// Number of words of a table.
    #[doc(hidden)]
    const SIZE: Size;
    /// Least and greatest number of cells.
    #[doc(hidden)]
    const CELLS: [u32; 2] = [MIN_CELLS as u32, MAX_CELLS];
    /// Whether the machine units depend on the number of cells ([`Scale::for_cells`]).
    const WHOLE_FACTOR: bool;
    /// Rounding of a tick in addition to the curves' rounding, in units of the torque base, if it is significant.
    #[doc(hidden)]
    const TICK_ROUNDING: f64 = 0.0;

    /// Whether a table of this format can have this set of [`curves`](crate::curves).
    fn accepts(set: CurveSet) -> bool;
    /// Checks the words, once, when the table is created.
    #[doc(hidden)]
    fn check(table: &Table<'_, Self>) -> Result<(), TableError>;
    /// All curves in machine units, the slope per rad (or m).
    #[doc(hidden)]
    fn read(table: &Table<'_, Self>, phase: Phase) -> CurveValues;
    /// All curves in SI units.
    #[doc(hidden)]
    fn si(table: &Table<'_, Self>, phase: Phase, _cells_per_position: f64) -> CurveValues {
        let read = Self::read(table, phase);
        let [torque, speed, inertia] = bases(table.scale());
        CurveValues {
            inertia: read.inertia * inertia,
            inertia_slope: read.inertia_slope * inertia,
            load: read.load * torque,
            viscous: read.viscous * torque / speed,
            coulomb: read.coulomb * torque,
        }
    }
    /// The curves of one cell as polynomials in SI units; `None` for a format without cells.
    #[doc(hidden)]
    fn cell_curves(
        _: &Table<'_, Self>,
        _cell: u32,
        _cells_per_position: f64,
    ) -> Option<CellCurves> {
        None
    }
    /// 1/J in machine units.
    #[doc(hidden)]
    fn reciprocal(table: &Table<'_, Self>, phase: Phase) -> Option<f64>;
    /// Error of 1/J against J, for a table that has 1/J.
    #[doc(hidden)]
    fn reciprocal_error(table: &Table<'_, Self>) -> f32;

    /// Fills all words of a table, and returns its constants.
    #[doc(hidden)]
    fn fill<E: From<TableError> + From<RangeError>>(
        samples: &Samples<impl Fn(f64) -> Result<Sample, E>>,
        scratch: &mut [f64],
        words: &mut [Self::Word],
    ) -> Result<Self::Constants, E>;
    /// The base to enlarge when this curve of a row does not fit.
    #[doc(hidden)]
    fn base(curve: u8, set: CurveSet) -> &'static str;

    /// The constants as words of the image's header, and the inverse.
    #[doc(hidden)]
    fn header(constants: &Self::Constants, set: CurveSet) -> [u32; CONSTANTS];
    #[doc(hidden)]
    fn from_header(header: &[u32; CONSTANTS]) -> Self::Constants;
    /// The set of a table, from the lower bits, which the header of every format has.
    #[doc(hidden)]
    fn set(_: &[u32; CONSTANTS], set: CurveSet) -> CurveSet {
        set
    }

    /// Used share of the number range.
    ///
    /// # Errors
    /// The first cell in which a quantity does not fit.
    #[doc(hidden)]
    fn usage(table: &Table<'_, Self>) -> Result<Usage, TableError>;
    /// Checks that a table can be ticked, and prepares the tick.
    #[doc(hidden)]
    fn prepare<'a>(table: &Table<'a, Self>) -> Result<Self::Tick<'a>, TableError>;
    /// The same for the same table, whose words were moved or borrowed again; its set is `set`.
    #[doc(hidden)]
    fn moved<'a>(tick: &Self::Tick<'_>, table: &Table<'a, Self>, set: CurveSet) -> Self::Tick<'a>;
    /// Inverse dynamics for a table whose set is `set`, which a model knows at compile time.
    #[doc(hidden)]
    fn torque(
        table: &Table<'_, Self>,
        tick: &Self::Tick<'_>,
        set: CurveSet,
        phase: Phase,
        omega: Self::Number,
        alpha: Self::Number,
        friction: FrictionSign<Self::Number>,
    ) -> Self::Number;
    /// J·α, ½·J′·ω², −load, b·ω and c·sgn ω: the terms of [`torque`](Self::torque).
    #[doc(hidden)]
    fn torque_terms(
        table: &Table<'_, Self>,
        tick: &Self::Tick<'_>,
        set: CurveSet,
        phase: Phase,
        omega: Self::Number,
        alpha: Self::Number,
        friction: FrictionSign<Self::Number>,
    ) -> [Self::Number; 5];
    /// Forward dynamics for two torques, as [`torque`](Self::torque).
    #[doc(hidden)]
    fn accelerations(
        table: &Table<'_, Self>,
        tick: &Self::Tick<'_>,
        set: CurveSet,
        phase: Phase,
        omega: Self::Number,
        friction: FrictionSign<Self::Number>,
        torques: [Self::Number; 2],
    ) -> [Outcome<Self::Number>; 2];
}

/// The speed type of this format's models: `f32` for `f32`, [`Speed<Q31>`](crate::Speed) for `Q31`.
pub type SpeedOf<F> = <<F as Format>::Number as Number>::Speed;

/// The acceleration type of this format's models: `f32` for `f32`, [`Acceleration<Q31>`](crate::Acceleration) for `Q31`.
pub type AccelerationOf<F> = <<F as Format>::Number as Number>::Acceleration;

/// The torque type of this format's models: `f32` for `f32`, [`Torque<Q31>`](crate::Torque) for `Q31`.
pub type TorqueOf<F> = <<F as Format>::Number as Number>::Torque;

/// The type of torques on the motor's shaft, after a [`Transmission`](crate::axis::Transmission) of such a model: `f32` for `f32`,
/// [`MotorTorque<Q31>`](crate::MotorTorque) for `Q31`.
pub type MotorTorqueOf<F> = <<F as Format>::Number as Number>::MotorTorque;

/// The bases of torque, speed and inertia in double precision.
pub(crate) fn bases(scale: &Scale) -> [f64; 3] {
    [scale.torque(), scale.speed(), scale.inertia()].map(f64::from)
}
