//! Finds large tables without checking every place of every candidate.
//!
//! The place of a table's largest error hardly changes from one size to the next. So for sizes beyond [`EXHAUSTIVE`] the search checks only the cells
//! near that place: a table that fails there is rejected. Only the resulting size is checked at all places. If it fails there, which is possible
//! where rounding dominates the error, larger sizes are checked at all places.

use super::measure::{Places, measure_until, scan_places, torque_error};
use super::search::smallest;
use super::{CHECKS_PER_CELL, COARSE_CHECKS, EXHAUSTIVE, Request, TableFigures};
use crate::curve::{Format, Table};
use crate::error::Error;
use crate::machine::reducible::Reducible;

/// Cells on each side of the worst place that are checked.
const NEIGHBOURS: u32 = 8;

/// Places of a candidate to check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Look {
    /// All of them.
    All,
    /// For sizes beyond [`EXHAUSTIVE`] only those near the worst.
    Near,
}

/// As [`smallest`], for a `meets` that can check fewer places.
pub(super) fn search_near(
    request: &Request,
    mut meets: impl FnMut(u32, Look) -> Result<Option<TableFigures>, Error>,
) -> Result<Option<TableFigures>, Error> {
    let most = request.most_cells();
    let near = smallest(most, EXHAUSTIVE, |cells| meets(cells, Look::Near))?;
    let Some((guess, found)) = near else {
        return Ok(None);
    };
    if guess <= EXHAUSTIVE {
        return Ok(Some(found));
    }
    if let Some(found) = meets(guess, Look::All)? {
        return Ok(Some(found));
    }
    let larger = smallest(most, EXHAUSTIVE, |cells| {
        if cells <= guess {
            return Ok(None);
        }
        meets(cells, Look::All)
    })?;
    Ok(larger.map(|(_, found)| found))
}

/// Place of a table's largest error, and its number of cells.
pub(super) type Worst = Option<(f64, u32)>;

/// The error of a table near its worst place, if it meets the request there. The worst place is searched around the whole range, at few places per
/// cell, in the first table, and again in a much larger one that meets the request.
pub(super) fn meets_near<F: Format>(
    machine: &impl Reducible,
    table: &Table<'_, F>,
    request: &Request,
    worst: &mut Worst,
) -> Result<Option<TableFigures>, Error> {
    let (domain, cells) = (machine.domain(), table.cells());
    let meets = |found: &TableFigures| found.torque_error <= request.torque_error;
    let survey = || measure_until(machine, table, request, (0.0, COARSE_CHECKS), false);
    let around = |place: f64| {
        let first = domain.phase(place).cell(cells).0 + cells - NEIGHBOURS;
        let places = Places {
            first: first % cells,
            cells: 2 * NEIGHBOURS + 1,
            checks: CHECKS_PER_CELL,
        };
        scan_places(domain, cells, Some(request.torque_error), places, |phase| {
            torque_error(machine, table, request, phase)
        })
    };
    if let Some((place, of)) = *worst {
        let found = around(place)?;
        if !meets(&found) {
            return Ok(None);
        }
        if cells <= of + of / 4 {
            return Ok(Some(found));
        }
    }
    let found = survey()?;
    *worst = Some((found.worst, cells));
    if !meets(&found) {
        return Ok(None);
    }
    let found = around(found.worst)?;
    Ok(meets(&found).then_some(found))
}

#[cfg(test)]
mod tests {
    use super::{Look, search_near};
    use crate::tabulate::{EXHAUSTIVE, Request, TableFigures};

    /// Result of a search where sizes from `near` on pass the check near the worst place, and those from `all` on pass every check; and the number of
    /// checks at all places of sizes beyond [`EXHAUSTIVE`].
    fn found(near: u32, all: u32, max_cells: u32) -> (Option<u32>, u32) {
        let request = Request::new(1.0)
            .with_max_speed(1.0)
            .with_max_acceleration(1.0)
            .with_max_cells(max_cells);
        let mut looks = 0;
        let found = search_near(&request, |cells, look| {
            let near_only = look == Look::Near && cells > EXHAUSTIVE;
            looks += u32::from(!near_only && cells > EXHAUSTIVE);
            let enough = if near_only { near } else { all };
            Ok((cells >= enough).then(|| TableFigures {
                cells,
                ..TableFigures::default()
            }))
        });
        (found.ok().flatten().map(|found| found.cells), looks)
    }

    #[test]
    fn finds_the_smallest_size_with_one_look_at_all_places() {
        for size in [EXHAUSTIVE + 1, EXHAUSTIVE + 2, 200, 2946, 16_384] {
            assert_eq!(found(size, size, 16_384), (Some(size), 1));
        }
        for size in [4, 5, 77, EXHAUSTIVE - 1, EXHAUSTIVE] {
            assert_eq!(found(size, size, 16_384), (Some(size), 0));
        }
    }

    #[test]
    fn finds_it_where_the_worst_place_is_elsewhere() {
        for (near, all) in [(129, 130), (200, 1000), (2945, 2946), (4, 300)] {
            let (size, looks) = found(near, all, 16_384);
            assert_eq!(size, Some(all), "{near}");
            assert!(looks > 1 && looks < 40, "{looks}");
        }
        assert_eq!(found(4, 80, 16_384).0, Some(80));
        assert_eq!(found(300, 401, 400).0, None);
        assert_eq!(found(401, 401, 400), (None, 0));
    }
}
