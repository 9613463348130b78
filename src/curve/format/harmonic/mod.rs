//! Harmonics: short Fourier series instead of cells.
//!
//! ```text
//! J(φ)  = a₀ + Σ aₖ·cos kφ + bₖ·sin kφ,   k = 1 … n
//! J′(φ) =      Σ k·(bₖ·cos kφ − aₖ·sin kφ)
//! ```
//!
//! and likewise load, viscous and Coulomb coefficient, as far as the machine has them; φ is the angle of a drive link that turns fully. The slope is
//! that of the same series, so that a free machine keeps its energy. cos kφ and sin kφ come from one sine and cosine by rotation:
//!
//! ```text
//! cos (k+1)φ = cos kφ·cos φ − sin kφ·sin φ,   sin (k+1)φ = sin kφ·cos φ + cos kφ·sin φ
//! ```
//!
//! One such pair serves all curves, and its error grows only with k. The recurrence of C. W. Clenshaw (*Math. Comp.* 9, 1955) needs a pass for each
//! curve and each kind, and near φ = 0 and π its error grows with k².

#[allow(clippy::indexing_slicing, reason = "lengths known at compile time")]
mod coefficient;
mod series;
mod sine;

#[cfg(feature = "mechanics")]
pub(crate) use coefficient::in_use;
pub use coefficient::{Coefficient, Curve, Kind, terms};
pub(crate) use coefficient::{means, row};

pub use sine::Circular;

use series::{Series, Values, pair, size};

use core::marker::PhantomData;

use super::{CONSTANTS, Format, Size};
use crate::curve::curves::{self, CurveSet};
use crate::curve::samples::{Sample, Samples};
use crate::curve::{CurveValues, Shape, Table, TableError, Usage};
use crate::number::error::RangeError;
use crate::number::{FrictionSign, Kernel, Number};
use crate::{Domain, Outcome, Phase, Scale};

/// Greatest number of harmonics of a series.
pub const MAX_HARMONICS: u32 = 256;

/// Harmonics, `f32` or `f64`, instead of cells: for a smooth machine that turns, a few replace a table of many cells.
///
/// The set contains the cosines and sines of each curve ([`terms`]) in addition to the curves themselves. The number of cells is the number of
/// harmonics, 0 to [`MAX_HARMONICS`]. Order of the words, as in [`Coefficient::of_word`](crate::harmonic::Coefficient::of_word): the means, then
/// harmonic after harmonic.
///
/// **Accuracy** for up to eleven harmonics: J and load to 4e-7 of the sum of their coefficients' magnitudes in `f32`, J′ with each magnitude times
/// its order; 4e-15 in `f64` (test `evaluation_rounds_as_stated`).
///
/// **Cost** of a tick: one sine and cosine, then six operations per harmonic, two for each of its coefficients, and two or three more for each of J's
/// (J′). A division only in `acceleration`. `docs/harmonics.md` has the instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Harmonic<T>(PhantomData<T>);

impl<F: Format> Shape<F> {
    /// The shape of this number of harmonics, in SI units.
    #[must_use]
    pub fn harmonics(harmonics: u32, set: CurveSet) -> Self {
        Self {
            set,
            cells: harmonics,
            domain: Domain::Turn,
            scale: Scale::SI,
            constants: F::Constants::default(),
        }
    }
}

/// Checks that words are numbers that can be summed.
fn check<T: Circular>(words: &[T], set: CurveSet) -> Result<(), TableError> {
    let most = T::from_f64(1e30);
    let Some(word) = words.iter().position(|&w| !(w < most && w > -most)) else {
        return Ok(());
    };
    let coefficient = Coefficient::of_word(word, set);
    let (curve, cell) = coefficient.map_or((0, 0), |found| match found.kind {
        Kind::Mean => (found.curve as u8, 0),
        Kind::Cosine(k) | Kind::Sine(k) => (found.curve as u8, k),
    });
    Err(TableError::Range { curve, cell })
}

/// Largest magnitudes of the curves, as sums of their coefficients' magnitudes.
fn usage<T: Circular>(series: &Series<'_, T>, set: CurveSet) -> Usage {
    let [zero, _, one] = T::CONSTANTS;
    let mut sums = series.means.map(size);
    let (mut slope, mut order) = (zero, one);
    for row in series.rows(set) {
        let mut words = row.iter().copied();
        for (curve, sum) in (0..4).zip(&mut sums) {
            for x in pair(&mut words, set, curve).into_iter().flatten() {
                *sum = *sum + size(x);
                if curve == 0 {
                    slope = slope + order * size(x);
                }
            }
        }
        order = order + one;
    }
    let [inertia, load, viscous, coulomb, constant] = sums.map(T::to_f32);
    let velocity = (slope * series.velocity).to_f32();
    Usage {
        inertia,
        velocity,
        load,
        viscous,
        coulomb: coulomb + constant,
        torque: inertia + velocity + load + viscous + coulomb + constant,
    }
}

/// sum + c·sgn ω, if the machine has friction.
#[inline(always)]
fn with_friction<T: Kernel<Raw = T>>(
    sum: T,
    values: &Values<T>,
    set: CurveSet,
    friction: FrictionSign<T>,
) -> T {
    if Curve::Coulomb.is_in(set) || Curve::Constant.is_in(set) {
        T::add_sliding(sum, values.coulomb, friction)
    } else {
        sum
    }
}

macro_rules! harmonic {
    ($number:ident, $codes:expr) => {
        impl Format for Harmonic<$number> {
            type Number = $number;
            type Word = $number;
            type Constants = ();
            type Tick<'a> = Series<'a, $number>;

            const NAME: &'static str = "harmonic";
            const CODES: Option<[u8; 2]> = $codes;
            const TERMS: bool = true;
            const SIZE: Size = Size::Harmonics;
            const CELLS: [u32; 2] = [0, MAX_HARMONICS];
            const WHOLE_FACTOR: bool = false;

            fn accepts(set: CurveSet) -> bool {
                let known = curves::ALL | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
                set & !(known | terms::ALL) == 0
            }

            fn check(table: &Table<'_, Self>) -> Result<(), TableError> {
                if table.domain() != Domain::Turn {
                    return Err(TableError::Stroke);
                }
                check(table.words(), table.set())
            }

            fn read(table: &Table<'_, Self>, phase: Phase) -> CurveValues {
                let series = Series::new(table.words(), table.set(), table.scale());
                let values = series.at(table.set(), phase);
                let number = <$number as Number>::to_f64;
                CurveValues {
                    inertia: number(values.inertia),
                    inertia_slope: number(values.slope),
                    load: number(values.load),
                    viscous: number(values.viscous),
                    coulomb: number(values.coulomb),
                }
            }

            fn reciprocal(_: &Table<'_, Self>, _: Phase) -> Option<f64> {
                None
            }

            fn reciprocal_error(_: &Table<'_, Self>) -> f32 {
                0.0
            }

            fn fill<E: From<TableError> + From<RangeError>>(
                _: &Samples<impl Fn(f64) -> Result<Sample, E>>,
                _: &mut [f64],
                _: &mut [$number],
            ) -> Result<(), E> {
                // Harmonics come from the spectrum of the curves: `harmonic::fit`.
                Err(TableError::Harmonics.into())
            }

            fn base(_: u8, _: CurveSet) -> &'static str {
                "torque"
            }

            fn header((): &(), set: CurveSet) -> [u32; CONSTANTS] {
                [(set >> 8).into(), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]
            }

            fn from_header(_: &[u32; CONSTANTS]) {}

            fn set(&[terms, ..]: &[u32; CONSTANTS], set: CurveSet) -> CurveSet {
                set | (terms as CurveSet) << 8
            }

            fn usage(table: &Table<'_, Self>) -> Result<Usage, TableError> {
                let series = Series::new(table.words(), table.set(), table.scale());
                Ok(usage(&series, table.set()))
            }

            fn prepare<'a>(table: &Table<'a, Self>) -> Result<Self::Tick<'a>, TableError> {
                let series = Series::new(table.words(), table.set(), table.scale());
                series.check_inertia(table.set())?;
                // Below this no sum of a tick overflows at any phase. A comparison with NaN is false.
                if usage(&series, table.set()).torque < 1e30 {
                    Ok(series)
                } else {
                    Err(TableError::TorqueRange { cell: 0 })
                }
            }

            #[inline(always)]
            fn moved<'a>(
                tick: &Self::Tick<'_>,
                table: &Table<'a, Self>,
                set: CurveSet,
            ) -> Self::Tick<'a> {
                tick.moved(table.words(), set)
            }

            #[inline(always)]
            fn torque(
                _: &Table<'_, Self>,
                tick: &Self::Tick<'_>,
                set: CurveSet,
                phase: Phase,
                omega: $number,
                alpha: $number,
                friction: FrictionSign<$number>,
            ) -> $number {
                let values = tick.at(set, phase);
                values.inertia * alpha
                    + with_friction(tick.resisting(&values, set, omega), &values, set, friction)
            }

            fn torque_terms(
                _: &Table<'_, Self>,
                tick: &Self::Tick<'_>,
                set: CurveSet,
                phase: Phase,
                omega: $number,
                alpha: $number,
                friction: FrictionSign<$number>,
            ) -> [$number; 5] {
                let values = tick.at(set, phase);
                [
                    values.inertia * alpha,
                    tick.velocity(&values, omega),
                    -values.load,
                    values.viscous * omega,
                    with_friction(0.0, &values, set, friction),
                ]
            }

            #[inline(always)]
            fn accelerations(
                _: &Table<'_, Self>,
                tick: &Self::Tick<'_>,
                set: CurveSet,
                phase: Phase,
                omega: $number,
                friction: FrictionSign<$number>,
                torques: [$number; 2],
            ) -> [Outcome<$number>; 2] {
                let values = tick.at(set, phase);
                let resisting = tick.resisting(&values, set, omega);
                let resisting = with_friction(resisting, &values, set, friction);
                // Floating point represents every acceleration.
                let outcome = |torque| Outcome::exact((torque - resisting) / values.inertia);
                [outcome(torques[0]), outcome(torques[1])]
            }
        }
    };
}

harmonic!(f32, Some([1, 6]));
harmonic!(f64, None);
