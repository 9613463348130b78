//! Fills a table of a given size.

use super::scratch_len;
use crate::curve::{
    CurveSet, Format, MAX_CELLS, Sample, Samples, Shape, Table, TableError, words_len,
};
use crate::error::Error;
use crate::machine::Reducible;
use crate::machine::error::PoseError;
use crate::number::error::RangeError;
use crate::number::spline::MIN_CELLS;
use crate::{Domain, Scale};

/// Fills `words` with a table of exactly `cells` cells and this set of [`curves`](crate::curves), and returns it.
///
/// A constant of the set has the machine's value at the start of its range. Coulomb friction is stored with a sign that changes where its magnitude
/// has a kink at zero (see [`curves::COULOMB`](crate::curves::COULOMB)).
///
/// # Errors
/// The machine's errors; curves that are not periodic over a turn of the drive link; buffers too short; a curve outside the number range of `scale`;
/// a set that the format cannot have; as [`Table::new`].
pub fn fill<'w, F: Format>(
    machine: &impl Reducible,
    set: CurveSet,
    cells: u32,
    scale: &Scale,
    scratch: &mut [f64],
    words: &'w mut [F::Word],
) -> Result<Table<'w, F>, Error> {
    if !F::accepts(set) {
        return Err(Error::Table(TableError::Curves(set)));
    }
    if cells < MIN_CELLS as u32 || cells > MAX_CELLS {
        return Err(Error::Table(TableError::Cells(cells)));
    }
    let (given, needed) = (scratch.len(), scratch_len(cells, set));
    let too_short = RangeError::BufferTooShort { needed, given };
    let scratch = scratch.get_mut(..needed).ok_or(too_short)?;
    let (given, needed) = (words.len(), words_len::<F>(cells, set));
    let too_short = RangeError::BufferTooShort { needed, given };
    let words = words.get_mut(..needed).ok_or(too_short)?;

    let domain = machine.domain();
    if domain == Domain::Turn {
        machine.check_repeats()?;
    }
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let samples = Samples {
        set,
        cells,
        domain,
        scale: *scale,
        at: |place| {
            let point = machine.reduction(domain.position(place))?;
            Ok::<_, Error>(Sample {
                inertia: point.inertia / inertia,
                load: point.load_torque() / torque,
                viscous: point.viscous * speed / torque,
                coulomb: point.coulomb / torque,
            })
        },
    };
    let shape = Shape {
        set,
        cells,
        domain: domain.to(),
        scale: *scale,
        constants: F::fill(&samples, scratch, words)?,
    };
    Table::new(words, shape).map_err(|error| match error {
        TableError::Range { curve, cell } => Error::Table(TableError::Overflow {
            base: F::base(curve, set),
            cell,
        }),
        TableError::NoInertia { cell } => PoseError::NoInertia {
            phi: domain.position(f64::from(cell) / f64::from(cells)),
        }
        .into(),
        other => Error::Table(other),
    })
}
