//! How a table's curves lie in memory, and how they are evaluated.
//!
//! The polynomial formats have in each cell
//!
//! ```text
//! f(u) = p0 + u·(p1 + u·(p2 + u·p3)),   u in [0, 1) within the cell
//! ```
//!
//! whose value and slope come from the same coefficients. All curves of a cell are stored side by side: one index, one
//! contiguous read.
//!
//! | format | words a curve and cell | continuous | for |
//! |---|---|---|---|
//! | [`Spline`] | 1 | value, slope, curvature | the smallest table |
//! | [`Spline16`] | ½ | as [`Spline`] | less than half of that, to about 1e-4 |
//! | [`Cubic`] | 4 | as the curve it was made from | the fastest tick |
//! | [`Quadratic`] | 3, rows padded to 4 | value, slope | the fastest tick without a long multiplication |
//! | [`Rows16`] | 1, and 2 a cell | value, slope, but for the rounding of 16 bits | processors without a long multiplication |
//!
//! [`Harmonic`] holds no cells, but a short Fourier series of each curve; `SliderCrankForm` (feature `micromath`) the lengths and masses of a
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

use super::curves::Set;
use super::samples::{Sample, Samples};
use super::table::{CellCurves, CurveValues, Table};
use super::{MAX_CELLS, TableError, Usage};
use crate::number::error::RangeError;
use crate::number::spline::MIN_CELLS;
use crate::number::{Number, Sliding};
use crate::{Outcome, Phase, Scale};

/// Words of the image's header for the constants of a table.
pub(crate) const CONSTANTS: usize = 11;

/// A way to store and evaluate curves. Sealed: [`Spline`], [`Spline16`], [`Cubic`], [`Quadratic`], [`Rows16`], [`Harmonic`], and
/// with feature `micromath` `SliderCrankForm`.
///
/// A program can be generic over it, for any number that the format has:
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
/// Splines have no numbers of 16 bits, harmonics no fixed point, and nobody can add a format:
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
/// # use jred::{Outcome, Phase, Scale, Set, table::{CurveValues, Format, Table, TableError, Usage}};
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Mine;
/// impl Format for Mine {}
/// ```
pub trait Format: crate::sealed::Sealed + Copy + core::fmt::Debug + PartialEq + 'static {
    /// Numbers that a tick takes and gives, as [`SpeedOf`], [`AccelerationOf`] and [`TorqueOf`] this format.
    type Number: Number;
    /// A word of the table.
    type Word: bytemuck::Pod + Default + core::fmt::Debug + PartialEq;
    /// Constants of a table, in addition to its rows.
    type Constants: Copy + core::fmt::Debug + Default + PartialEq;
    /// What a tick needs in addition to the table: made once, by [`prepare`](Self::prepare).
    #[doc(hidden)]
    type Tick<'a>: Copy + core::fmt::Debug;

    /// Name as the command line writes it.
    const NAME: &'static str;
    /// Codes of number type and format in the image's header; `None`: not stored in images.
    #[doc(hidden)]
    const CODES: Option<[u8; 2]>;
    /// Whether its set of curves has terms of harmonics in its upper half.
    #[doc(hidden)]
    const TERMS: bool = false;
    /// How many words a table has.
    #[doc(hidden)]
    const SIZE: Size;
    /// Fewest and most cells.
    #[doc(hidden)]
    const CELLS: [u32; 2] = [MIN_CELLS as u32, MAX_CELLS];
    /// Whether the machine units must suit the number of cells ([`Scale::for_cells`]).
    const WHOLE_FACTOR: bool;
    /// Rounding of a tick in addition to that of the curves, in units of the torque base, if it counts.
    #[doc(hidden)]
    const TICK_ROUNDING: f64 = 0.0;

    /// Whether a table of this format can have this set of [`curves`](crate::curves).
    fn accepts(set: Set) -> bool;
    /// Whether the words are sound: checked once, when the table is built.
    #[doc(hidden)]
    fn check(table: &Table<'_, Self>) -> Result<(), TableError>;
    /// All curves in machine units, the slope by rad (or m).
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
    /// The curves of one cell as polynomials in SI units; `None` of a format without cells.
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
    /// What of 1/J is not that of J, of a table that has it.
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
    fn base(curve: u8, set: Set) -> &'static str;

    /// The constants as words of the image's header, and back.
    #[doc(hidden)]
    fn header(constants: &Self::Constants, set: Set) -> [u32; CONSTANTS];
    #[doc(hidden)]
    fn from_header(header: &[u32; CONSTANTS]) -> Self::Constants;
    /// The set of a table, of the lower bits that the header has of every format.
    #[doc(hidden)]
    fn set(_: &[u32; CONSTANTS], set: Set) -> Set {
        set
    }

    /// What a table uses of the number range.
    ///
    /// # Errors
    /// The first cell in which something does not fit.
    #[doc(hidden)]
    fn usage(table: &Table<'_, Self>) -> Result<Usage, TableError>;
    /// Checks that a table can be ticked, and makes what a tick needs in addition to it.
    #[doc(hidden)]
    fn prepare<'a>(table: &Table<'a, Self>) -> Result<Self::Tick<'a>, TableError>;
    /// The same for the same table, whose words lie in another place or are borrowed anew; its set is `set`.
    #[doc(hidden)]
    fn moved<'a>(tick: &Self::Tick<'_>, table: &Table<'a, Self>, set: Set) -> Self::Tick<'a>;
    /// Inverse dynamics, of a table whose set is `set`: a model knows it when it is compiled.
    #[doc(hidden)]
    fn torque(
        table: &Table<'_, Self>,
        tick: &Self::Tick<'_>,
        set: Set,
        phase: Phase,
        motion: [Self::Number; 2],
        sliding: Sliding<Self::Number>,
    ) -> Self::Number;
    /// J·α, ½·J′·ω², −load, b·ω and c·sgn ω: the terms of [`torque`](Self::torque).
    #[doc(hidden)]
    fn contributions(
        table: &Table<'_, Self>,
        tick: &Self::Tick<'_>,
        set: Set,
        phase: Phase,
        motion: [Self::Number; 2],
        sliding: Sliding<Self::Number>,
    ) -> [Self::Number; 5];
    /// Forward dynamics for several torques, as [`torque`](Self::torque).
    #[doc(hidden)]
    fn accelerations(
        table: &Table<'_, Self>,
        tick: &Self::Tick<'_>,
        set: Set,
        phase: Phase,
        omega: Self::Number,
        sliding: Sliding<Self::Number>,
        torques: [Self::Number; 2],
    ) -> [Outcome<Self::Number>; 2];
}

/// What a model of this format takes for a speed: `f32` of `f32`, [`Speed<Q31>`](crate::Speed) of `Q31`.
pub type SpeedOf<F> = <<F as Format>::Number as Number>::Speed;

/// What a model of this format takes for an acceleration, and gives: `f32` of `f32`, [`Acceleration<Q31>`](crate::Acceleration) of `Q31`.
pub type AccelerationOf<F> = <<F as Format>::Number as Number>::Acceleration;

/// What a model of this format takes for a torque, and gives: `f32` of `f32`, [`Torque<Q31>`](crate::Torque) of `Q31`.
pub type TorqueOf<F> = <<F as Format>::Number as Number>::Torque;

/// A torque on the motor's shaft, behind a [`Transmission`](crate::axis::Transmission) of such a model: `f32` of `f32`, [`MotorTorque<Q31>`](crate::MotorTorque) of `Q31`.
pub type MotorTorqueOf<F> = <<F as Format>::Number as Number>::MotorTorque;

/// The bases of torque, speed and inertia in double precision.
pub(crate) fn bases(scale: &Scale) -> [f64; 3] {
    [scale.torque(), scale.speed(), scale.inertia()].map(f64::from)
}
