//! Table images of the example machine, made by the library from its own mechanism.

use anyhow::{Result, anyhow, bail};
use jred::table::{self, curves};
use jred::tabulate::{fill, scratch_len, words_len};
use jred::{Domain, Q31, Scalar, Scale, Validity, encode, image_words, short};

use crate::data::Words;
use crate::machine::{ALPHA, Example, OMEGA};
use crate::number::Number;

/// Layout of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    Spline,
    Cubic,
    Quadratic,
    /// [`table::Spline16`]
    Spline16,
    /// [`jred::short`]
    Rows16,
}

/// Load, and friction of the drive link that does not depend on the angle.
pub(crate) const FULL: u8 = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// The inertia alone.
pub(crate) const BARE: u8 = curves::INERTIA;
/// With a seed of 1/J instead of a division.
pub(crate) const SEED: u8 = curves::RECIPROCAL;

/// The image for a kernel that computes with `number`; floating point in SI units, fixed point in those of `scale`.
pub(crate) fn image(
    example: &Example,
    number: Number,
    layout: Layout,
    set: u8,
    cells: u32,
    scale: &Scale,
) -> Result<Words> {
    use Layout::{Cubic, Quadratic, Rows16, Spline, Spline16};
    let make = match (number, layout) {
        (Number::PhaseF32, Spline) => make::<f32, table::Spline>,
        (Number::PhaseF32, Cubic) => make::<f32, table::Cubic>,
        (Number::PhaseF32, Quadratic) => make::<f32, table::Quadratic>,
        (Number::PhaseQ31, Spline) => make::<Q31, table::Spline>,
        (Number::PhaseQ31, Cubic) => make::<Q31, table::Cubic>,
        (Number::PhaseQ31, Quadratic) => make::<Q31, table::Quadratic>,
        (Number::PhaseQ31, Spline16) => make::<Q31, table::Spline16>,
        (Number::PhaseQ15, Rows16) => make_short,
        _ => bail!("no image of {number:?}"),
    };
    let scale = if number == Number::PhaseF32 {
        &Scale::SI
    } else {
        scale
    };
    make(example, set, cells, scale)
}

fn make<S: Scalar, L: table::Layout>(
    example: &Example,
    set: u8,
    cells: u32,
    scale: &Scale,
) -> Result<Words> {
    let failed = |error| anyhow!("the example machine: {error}");
    let machine = example.mechanism().map_err(failed)?;
    let mut scratch = vec![0.0; scratch_len(cells, set)];
    let mut numbers = vec![S::word_from_bits(0); words_len::<L>(cells, set)];
    let table =
        fill::<S, L>(&machine, set, cells, scale, &mut scratch, &mut numbers).map_err(failed)?;
    let table_bytes = size_of_val(table.words());
    let mut words = vec![0; image_words::<S, L>(cells, set)];
    encode(&table, Domain::Turn, scale, VALIDITY, &mut words).map_err(failed)?;
    Ok(Words { words, table_bytes })
}

fn make_short(example: &Example, set: u8, cells: u32, scale: &Scale) -> Result<Words> {
    let failed = |error| anyhow!("the example machine: {error}");
    let machine = example.mechanism().map_err(failed)?;
    let mut scratch = vec![0.0; short::scratch_len(cells, set)];
    let mut rows = vec![0; short::words_len(cells, set)];
    let table =
        short::fill(&machine, set, cells, scale, &mut scratch, &mut rows).map_err(failed)?;
    let table_bytes = size_of_val(table.words());
    let mut words = vec![0; short::image_words(cells, set)];
    short::encode(&table, Domain::Turn, scale, VALIDITY, &mut words).map_err(failed)?;
    Ok(Words { words, table_bytes })
}

/// Nothing reads these three here.
const VALIDITY: Validity = Validity {
    omega: OMEGA as f32,
    alpha: ALPHA as f32,
    torque_error: 1.0,
};
