//! The smallest table of 16-bit rows that meets a torque error.

use super::fill::fill;
use super::measure::{measure, measure_until};
use crate::machine::reduction::Reducible;
use crate::tabulate::{self, Request, Tabulated};
use crate::{Error, Scale};

/// Finds the table with the fewest cells that meets the request, fills `words` with it, and says how exact it is: as
/// [`crate::tabulate::tabulate`], with the error of [`measure`](super::measure()).
///
/// 16 bits cannot go below an error of about three units of 2⁻¹⁵ of the torque base, see `docs/table-image.md`; with more cells the
/// numbers of a cell become smaller, and the error does not.
///
/// # Errors
/// As [`crate::tabulate::tabulate`].
pub fn tabulate(
    machine: &impl Reducible,
    set: u8,
    request: &Request,
    scale: &Scale,
    scratch: &mut [f64],
    words: &mut [u32],
) -> Result<Tabulated, Error> {
    request.check()?;
    let mut worst = 0.0;
    let best = tabulate::search(request, |cells| {
        let Ok(table) = fill(machine, set, cells, scale, scratch, words) else {
            return Ok(None);
        };
        tabulate::meets(request, &mut worst, |from| {
            measure_until(machine, &table, request, scale, from, true)
        })
    })?;
    if let Some(best) = best {
        fill(machine, set, best.cells, scale, scratch, words)?;
        return Ok(best);
    }
    Err(tabulate::not_reached(request, |cells| {
        let table = fill(machine, set, cells, scale, scratch, words)?;
        measure(machine, &table, request, scale)
    }))
}
