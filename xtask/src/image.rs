//! Table images of the example machine, made by the library from its own mechanism.

use anyhow::{Result, anyhow, bail};
use jred::image::{Validity, encode, image_len};
use jred::slider_crank::form;
use jred::table::{Format, Shape, Table, words_len};
use jred::tabulate::{fill, scratch_len};
use jred::{CurveSet, Q31, Scale, SliderCrankForm, curves};

use crate::data::Words;
use crate::machine::{ALPHA, Example, OMEGA};
use crate::number::Number;

/// Format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    Spline,
    Cubic,
    Quadratic,
    /// [`jred::Spline16`]
    Spline16,
    /// [`jred::Rows16`]
    Rows16,
    /// [`jred::SliderCrankForm`]
    SliderCrank,
}

/// Load, and constant friction of the drive link.
pub(crate) const FULL: CurveSet =
    curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// Only the inertia.
pub(crate) const BARE: CurveSet = curves::INERTIA;
/// With a seed of 1/J instead of a division.
pub(crate) const SEED: CurveSet = curves::RECIPROCAL;

/// The image for a kernel with `number`; floating point in SI units, fixed point in those of `scale`.
pub(crate) fn image(
    example: &Example,
    number: Number,
    layout: Layout,
    set: CurveSet,
    cells: u32,
    scale: &Scale,
) -> Result<Words> {
    use Layout::{Cubic, Quadratic, Rows16, Spline, Spline16};
    let make = match (number, layout) {
        (Number::PhaseF32, Spline) => make::<jred::Spline<f32>>,
        (Number::PhaseF32, Cubic) => make::<jred::Cubic<f32>>,
        (Number::PhaseF32, Quadratic) => make::<jred::Quadratic<f32>>,
        (Number::PhaseF32, Layout::SliderCrank) => return crank(example, set),
        (Number::PhaseQ31, Spline) => make::<jred::Spline<Q31>>,
        (Number::PhaseQ31, Cubic) => make::<jred::Cubic<Q31>>,
        (Number::PhaseQ31, Quadratic) => make::<jred::Quadratic<Q31>>,
        (Number::PhaseQ31, Spline16) => make::<jred::Spline16>,
        (Number::PhaseQ15, Rows16) => make::<jred::Rows16>,
        _ => bail!("no image of {number:?}"),
    };
    let scale = if number == Number::PhaseF32 {
        &Scale::SI
    } else {
        scale
    };
    make(example, set, cells, scale)
}

fn make<F: Format>(example: &Example, set: CurveSet, cells: u32, scale: &Scale) -> Result<Words> {
    let failed = |error| anyhow!("the example machine: {error}");
    let machine = example.mechanism().map_err(failed)?;
    let mut scratch = vec![0.0; scratch_len(cells, set)];
    let mut numbers = vec![F::Word::default(); words_len::<F>(cells, set)];
    let table =
        fill::<F>(&machine, set, cells, scale, &mut scratch, &mut numbers).map_err(failed)?;
    encoded(&table)
}

/// The closed form: with friction of the drive link as loads of the crank, or only the inertia.
fn crank(example: &Example, set: CurveSet) -> Result<Words> {
    let failed = |error| anyhow!("the example machine: {error}");
    let machine = example.crank(set != BARE).map_err(failed)?;
    let mut numbers = vec![0.0; words_len::<SliderCrankForm>(0, set)];
    form(&machine, set, &mut numbers).map_err(failed)?;
    let table = Table::new(&numbers, Shape::slider_crank(set));
    encoded(&table.map_err(|error| anyhow!("the example machine: {error}"))?)
}

fn encoded<F: Format>(table: &Table<'_, F>) -> Result<Words> {
    let mut words = vec![0; image_len::<F>(table.cells(), table.set())];
    encode(table, VALIDITY, &mut words).map_err(|error| anyhow!("the example machine: {error}"))?;
    Ok(Words {
        words,
        table_bytes: size_of_val(table.words()),
    })
}

/// Unused here.
const VALIDITY: Validity = Validity {
    max_speed: OMEGA as f32,
    max_acceleration: ALPHA as f32,
    torque_error: 1.0,
};
