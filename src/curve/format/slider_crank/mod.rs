//! A slider-crank in closed form: its lengths and masses instead of cells.
//!
//! ```text
//! λ = r/l,  τ = e/l − λ·sin φ = sin ψ,  q = 1/√(1 − τ²) = 1/cos ψ
//! X = sin φ − τ·q·cos φ  (x_B′ = −r·X),   Ψ = q·cos φ  (ψ′ = −λ·Ψ),   Ψ² = 1 + X² − 2·X·sin φ
//! J = J₀ + a·X² + s·X·sin φ + c·X·cos φ
//! ```
//!
//! Every mass of any link, with its centre anywhere, gives a J of this form; every weight and constant force a load in X, sin φ, cos φ; viscous
//! friction a b like J. docs/closed-form.md derives it. For a slider on the left, λ and e/l change their signs.

#[allow(clippy::indexing_slicing, reason = "lengths known at compile time")]
mod coefficient;
mod tick;

#[cfg(feature = "mechanics")]
pub(crate) use coefficient::COEFFICIENTS;
pub(crate) use coefficient::words;
pub use coefficient::{Coefficient, terms};
pub(super) use tick::Crank;
pub use tick::STEEPEST;

use coefficient::is_known;
use tick::Values;

use super::{CONSTANTS, Format, Size};
use crate::curve::curves::{CurveSet, has};
use crate::curve::samples::{Sample, Samples};
use crate::curve::{CurveValues, Shape, Table, TableError, Usage, curves};
use crate::number::error::RangeError;
use crate::number::{FrictionSign, Kernel as _};
use crate::{Domain, Outcome, Phase, Scale};

/// A slider-crank in closed form, `f32`, SI units: no cells, 20 to 72 bytes, with an accuracy of single precision.
///
/// Order of the words: [`Coefficient::ALL`], as far as the set has them; the upper bits of the set are [`terms`].
/// [`slider_crank::form`](crate::slider_crank::form) computes them from a machine.
///
/// The inverse square root is `micromath`'s, refined by three steps of Newton's iteration; sine and cosine are those of
/// [`Harmonic`](crate::Harmonic).
///
/// **Accuracy**: the torque to 1e-6 of the sum of its terms' largest magnitudes for (r + |e|)/l ≤ 0.5, 3e-6 up to [`STEEPEST`] (test
/// `the_tick_rounds_as_stated`). Cost: 101 instructions on a Cortex-M4F with a load and constant friction, for every argument; docs/closed-form.md.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SliderCrankForm;

impl Shape<SliderCrankForm> {
    /// The shape of a slider-crank with this set of curves and terms.
    #[must_use]
    pub const fn slider_crank(set: CurveSet) -> Self {
        Self {
            set,
            cells: 0,
            domain: Domain::Turn,
            scale: Scale::SI,
            constants: (),
        }
    }
}

fn crank(table: &Table<'_, SliderCrankForm>) -> Crank {
    Crank::new(table.words(), table.set())
}

/// sum + c·sgn ω, if the machine has friction.
#[inline(always)]
fn with_friction(sum: f32, values: &Values, set: CurveSet, friction: FrictionSign<f32>) -> f32 {
    if has(set, curves::COULOMB | curves::CONSTANT_COULOMB) {
        f32::add_sliding(sum, values.coulomb, friction)
    } else {
        sum
    }
}

impl Format for SliderCrankForm {
    type Number = f32;
    type Word = f32;
    type Constants = ();
    type Tick<'a> = Crank;

    const NAME: &'static str = "slider-crank";
    const CODES: Option<[u8; 2]> = Some([1, 7]);
    const TERMS: bool = true;
    const SIZE: Size = Size::SliderCrank;
    const CELLS: [u32; 2] = [0, 0];
    const WHOLE_FACTOR: bool = false;

    fn accepts(set: CurveSet) -> bool {
        is_known(set)
    }

    fn check(table: &Table<'_, Self>) -> Result<(), TableError> {
        if table.domain() != Domain::Turn {
            return Err(TableError::Stroke);
        }
        // If J·ω² is not in the unit of torque, the tick would need a factor.
        let factor = table.scale().velocity_base();
        if !(factor > 1.0 - 1e-6 && factor < 1.0 + 1e-6) {
            return Err(TableError::SpeedBase);
        }
        let present = Coefficient::ALL
            .into_iter()
            .filter(|part| part.is_in(table.set()));
        for (part, word) in present.zip(table.words()) {
            if !(*word < 1e30 && *word > -1e30) {
                let (curve, cell) = (part.curve(), 0);
                return Err(TableError::Range { curve, cell });
            }
        }
        Ok(())
    }

    fn read(table: &Table<'_, Self>, phase: Phase) -> CurveValues {
        let values = crank(table).at(table.set(), phase);
        CurveValues {
            inertia: values.inertia.into(),
            inertia_slope: values.slope.into(),
            load: values.load.into(),
            viscous: values.viscous.into(),
            coulomb: values.coulomb.into(),
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
        _: &mut [f32],
    ) -> Result<(), E> {
        // The coefficients come from a mechanism: `slider_crank::form`.
        Err(TableError::SliderCrank.into())
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
        let crank = crank(table);
        crank.check_lengths()?;
        Ok(crank.usage())
    }

    fn prepare<'a>(table: &Table<'a, Self>) -> Result<Self::Tick<'a>, TableError> {
        let crank = crank(table);
        crank.check_lengths()?;
        crank.check_inertia(table.set())?;
        // Below this no sum of a tick overflows at any phase. A comparison with NaN is false.
        if crank.usage().torque < 1e30 {
            Ok(crank)
        } else {
            Err(TableError::TorqueRange { cell: 0 })
        }
    }

    #[inline(always)]
    fn moved(tick: &Crank, _: &Table<'_, Self>, _: CurveSet) -> Crank {
        *tick
    }

    #[inline(always)]
    fn torque(
        _: &Table<'_, Self>,
        tick: &Crank,
        set: CurveSet,
        phase: Phase,
        omega: f32,
        alpha: f32,
        friction: FrictionSign<f32>,
    ) -> f32 {
        let values = tick.at(set, phase);
        values.inertia * alpha
            + with_friction(
                Crank::resisting(&values, set, omega),
                &values,
                set,
                friction,
            )
    }

    fn torque_terms(
        _: &Table<'_, Self>,
        tick: &Crank,
        set: CurveSet,
        phase: Phase,
        omega: f32,
        alpha: f32,
        friction: FrictionSign<f32>,
    ) -> [f32; 5] {
        let values = tick.at(set, phase);
        [
            values.inertia * alpha,
            Crank::velocity(&values, omega),
            -values.load,
            values.viscous * omega,
            with_friction(0.0, &values, set, friction),
        ]
    }

    #[inline(always)]
    fn accelerations(
        _: &Table<'_, Self>,
        tick: &Crank,
        set: CurveSet,
        phase: Phase,
        omega: f32,
        friction: FrictionSign<f32>,
        torques: [f32; 2],
    ) -> [Outcome<f32>; 2] {
        let values = tick.at(set, phase);
        let resisting = Crank::resisting(&values, set, omega);
        let resisting = with_friction(resisting, &values, set, friction);
        // Floating point represents every acceleration.
        let outcome = |torque| Outcome::exact((torque - resisting) / values.inertia);
        [outcome(torques[0]), outcome(torques[1])]
    }
}
