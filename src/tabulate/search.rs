//! The smallest table that meets a torque error.

use super::measure::{measure, measure_until};
use super::near::{Look, meets_near, search_near};
use super::{CHECKS_PER_CELL, COARSE_CHECKS, EXHAUSTIVE, Request, TableFigures, fill};
use crate::Scale;
use crate::curve::{CurveSet, Format, Table};
use crate::error::Error;
use crate::machine::Reducible;
use crate::number::spline::MIN_CELLS;

/// Finds the table with the fewest cells that meets the request, fills `words` with it, and returns its figures.
///
/// Sizes are tried as in [`smallest`], every one up to [`EXHAUSTIVE`] cells. A candidate is rejected at the first position that exceeds the request;
/// the check starts where the previous candidate had its largest error. The bisection checks only the cells near that position; the resulting size is
/// checked at all places, and larger ones follow if it fails. In fixed point [`TableFigures::scale`] has the machine units of the table.
///
/// # Errors
/// [`Error::TorqueErrorNotReached`] if no size up to `max_cells` meets the request, with the best of them; [`Error::Table`] if the largest does not
/// form a fixed-point model; otherwise as [`fill`](fill()).
pub fn tabulate<F: Format>(
    machine: &impl Reducible,
    set: CurveSet,
    request: &Request,
    scale: &Scale,
    scratch: &mut [f64],
    words: &mut [F::Word],
) -> Result<TableFigures, Error> {
    request.check()?;
    let (mut worst, mut near) = (0.0, None);
    let found = search_near(request, |cells, look| {
        let Ok(table) = candidate::<F>(machine, set, cells, scale, scratch, words) else {
            return Ok(None);
        };
        // Where 16-bit rounding dominates the error, the worst place changes from size to size.
        if look == Look::Near && cells > EXHAUSTIVE && F::TICK_ROUNDING == 0.0 {
            return meets_near(machine, &table, request, &mut near);
        }
        meets(request, &mut worst, |from| {
            measure_until(machine, &table, request, from, true)
        })
    })?;
    let Some(found) = found else {
        return Err(not_reached(request, |cells| {
            let table = candidate::<F>(machine, set, cells, scale, scratch, words)?;
            measure(machine, &table, request)
        }));
    };
    candidate::<F>(machine, set, found.cells, scale, scratch, words)?;
    Ok(found)
}

/// The table of `cells` cells, in suitable machine units, if it forms a model.
fn candidate<'w, F: Format>(
    machine: &impl Reducible,
    set: CurveSet,
    cells: u32,
    scale: &Scale,
    scratch: &mut [f64],
    words: &'w mut [F::Word],
) -> Result<Table<'w, F>, Error> {
    let mut scale = *scale;
    if F::WHOLE_FACTOR {
        scale = scale.for_cells(cells, machine.domain().span());
    }
    let table = fill::<F>(machine, set, cells, &scale, scratch, words)?;
    F::prepare(&table).map_err(Error::Table)?;
    Ok(table)
}

/// Sizes of a table from the smallest on, each a quarter larger; `most` is the last.
pub fn growing(most: u32) -> impl Iterator<Item = u32> {
    core::iter::successors(Some((MIN_CELLS as u32).min(most)), move |cells| {
        (*cells < most).then(|| (cells + cells.div_ceil(4)).min(most))
    })
}

/// The smallest size up to `most` cells for which `meets` returns a value, and that value.
///
/// First tries [growing] sizes until one meets; then the smaller ones: every size up to `exhaustive` cells, and larger ones by bisection,
/// which assumes that the error falls with the number of cells.
///
/// # Errors
/// The errors of `meets`.
pub fn smallest<T, E>(
    most: u32,
    exhaustive: u32,
    mut meets: impl FnMut(u32) -> Result<Option<T>, E>,
) -> Result<Option<(u32, T)>, E> {
    let (mut below, mut best) = (0, None);
    for cells in growing(most) {
        best = meets(cells)?.map(|found| (cells, found));
        if best.is_some() {
            break;
        }
        below = cells; // the largest size known to miss
    }
    let end = best.as_ref().map_or(most, |(cells, _)| cells - 1);
    let every = exhaustive.min(end);
    for cells in MIN_CELLS as u32..=every {
        if let Some(found) = meets(cells)? {
            return Ok(Some((cells, found)));
        }
    }
    let Some(mut best) = best else {
        return Ok(None);
    };
    below = below.max(every);
    while below + 1 < best.0 {
        let middle = below.midpoint(best.0);
        match meets(middle)? {
            Some(found) => best = (middle, found),
            None => below = middle,
        }
    }
    Ok(Some(best))
}

/// The figures of a candidate if it meets the request. `measure` checks few places first, from the previous candidate's worst place on.
fn meets(
    request: &Request,
    worst: &mut f64,
    measure: impl Fn((f64, u32)) -> Result<TableFigures, Error>,
) -> Result<Option<TableFigures>, Error> {
    let mut found = TableFigures::default();
    for checks in [COARSE_CHECKS, CHECKS_PER_CELL] {
        found = measure((*worst, checks))?;
        *worst = found.worst;
        if found.torque_error > request.torque_error {
            return Ok(None);
        }
    }
    Ok(Some(found))
}

/// The best of the growing sizes, or why the largest does not form a table.
fn not_reached(
    request: &Request,
    mut measured: impl FnMut(u32) -> Result<TableFigures, Error>,
) -> Error {
    let mut best = TableFigures {
        torque_error: f64::INFINITY,
        ..TableFigures::default()
    };
    let mut refused = None;
    for cells in growing(request.most_cells()) {
        // A coarse curve may dip below zero or overshoot, which more cells cure: only the error of the largest size is reported.
        refused = match measured(cells) {
            Ok(found) => {
                if found.torque_error < best.torque_error {
                    best = found;
                }
                None
            }
            Err(error) => Some(error),
        };
    }
    refused.unwrap_or(Error::TorqueErrorNotReached {
        asked: request.torque_error,
        reached: best.torque_error,
        cells: best.cells,
    })
}
