//! Why no table meets the request: the result of each layout, the obstacle, and other tables that do.

use jred::error::Error;
use jred::number::RangeError;
use jred::table::{MAX_CELLS, TableError};
use jred::{Cubic, Quadratic, Spline};
use jred_file::math;

use crate::candidate::{Candidate, RangeTable, SearchResult};
use crate::choice::{LayoutName, Number};
use crate::failure::{
    AccuracyLimit, Alternative, BestFit, CellsNeeded, CoarseLayout, Failure, Impossible,
    Inaccuracy, LeastError, NotReached,
};
use crate::pieces::Searches;
use crate::place::{Feature, feature};
use crate::search::Search;
use crate::task::Task;
use jred_file::model::machine::MachineFile;

/// A search without a result.
pub(crate) struct SearchFailure<'f> {
    pub(crate) file: &'f MachineFile,
    pub(crate) task: &'f Task,
    pub(crate) search: &'f Searches<'f>,
    pub(crate) answers: &'f [(Number, LayoutName, SearchResult)],
}

impl SearchFailure<'_> {
    pub(crate) fn failure(&self) -> Result<Failure, Error> {
        let own: Vec<&SearchResult> = self
            .answers
            .iter()
            .filter(|(number, layout, _)| {
                *number == self.task.number && self.task.layout.allows(*layout)
            })
            .map(|(_, _, answer)| answer)
            .collect();
        // Harmonics have their own messages.
        if let [
            SearchResult::Refused(
                error @ (Error::Harmonic(_) | Error::Table(TableError::ShortRod)),
            ),
        ] = own[..]
        {
            return Ok(Failure::NotReached(NotReached::Refused(*error)));
        }
        if let Some(SearchResult::Refused(Error::Table(TableError::PieceUnits))) = own.first() {
            return Ok(Failure::Impossible(Impossible::PieceUnits));
        }
        let misses = own.iter().filter_map(|answer| match answer {
            SearchResult::Misses(candidate) => Some(candidate.as_ref()),
            _ => None,
        });
        let mut misses: Vec<&Candidate> = misses.collect();
        misses.sort_by(|a, b| a.error().total_cmp(&b.error()));
        if self.task.max_bytes.is_some() {
            return Ok(self.none_fits(&own, misses.first().copied()));
        }
        let Some(best) = misses.first() else {
            if let Some(coarse) = self.too_coarse() {
                return Ok(Failure::NotReached(coarse));
            }
            // All are refused.
            let refused = own.iter().find_map(|answer| match answer {
                SearchResult::Refused(error) => Some(*error),
                _ => None,
            });
            return Ok(Failure::Machine(refused.unwrap_or(
                RangeError::NotFinite("torque error of the table").into(),
            )));
        };
        let inaccuracy = self.inaccuracy(&misses, best)?;
        Ok(Failure::NotReached(NotReached::Inaccurate(inaccuracy)))
    }

    fn too_coarse(&self) -> Option<NotReached> {
        let layouts = self.answers.iter().filter_map(|(number, layout, answer)| {
            let asked = *number == self.task.number && self.task.layout.allows(*layout);
            match answer {
                SearchResult::TooCoarse(error, cells) if asked => Some(CoarseLayout {
                    layout: *layout,
                    error: *error,
                    cells: *cells,
                }),
                _ => None,
            }
        });
        let layouts: Vec<_> = layouts.collect();
        (!layouts.is_empty()).then(|| NotReached::TooCoarse {
            layouts,
            alternatives: self.alternatives(),
        })
    }

    fn inaccuracy(&self, misses: &[&Candidate], best: &Candidate) -> Result<Inaccuracy, Error> {
        let layouts = misses
            .iter()
            .filter_map(|candidate| self.worst(candidate))
            .map(|range| range.least_error(self.task))
            .collect::<Result<Vec<_>, Error>>()?;
        let mut found = Inaccuracy {
            layouts,
            worst: best.curve_error().1,
            feature: None,
            finer: false,
            in_pieces: self.search.ranges.len() > 1,
            alternatives: self.alternatives(),
        };
        let Some(piece) = self.worst(best) else {
            return Ok(found);
        };
        let cells = piece.table.found.cells;
        found.worst = piece.table.found.worst;
        if found.layouts.first().map(|least| least.limit) == Some(AccuracyLimit::Rounding) {
            return Ok(found);
        }
        found.feature = self.feature(&piece, found.worst, cells)?;
        if found.feature.is_none() {
            // With more cells the error decreases where the curve is smooth, so that a kink becomes visible.
            let finer = (4 * cells).min(MAX_CELLS);
            let (_, worst) = piece.without_rounding(finer)?;
            found.feature = self.feature(&piece, worst, finer)?;
            found.finer = true;
        }
        Ok(found)
    }

    /// The range with the largest excess.
    fn worst<'a>(&'a self, candidate: &'a Candidate) -> Option<WorstRange<'a>> {
        let ranges = self.search.ranges.iter().zip(&candidate.tables);
        let (search, table) = ranges.max_by(|a, b| a.1.error.total_cmp(&b.1.error))?;
        Some(WorstRange {
            search,
            table,
            layout: candidate.layout,
        })
    }

    /// The feature within one and a half cells of a position.
    fn feature(
        &self,
        piece: &WorstRange<'_>,
        at: f64,
        cells: u32,
    ) -> Result<Option<Feature>, Error> {
        let near = 1.5 * piece.search.domain.span() / f64::from(cells);
        feature(self.file, self.search.machine, at, near)
    }

    /// The best table of each number type; the requested type first.
    fn alternatives(&self) -> Vec<Alternative> {
        let meets = |number: Number| {
            let found = self
                .answers
                .iter()
                .filter_map(|(n, _, answer)| match answer {
                    SearchResult::Meets(c) if *n == number => Some(c.as_ref()),
                    _ => None,
                });
            let best = found.min_by_key(|candidate| candidate.bytes())?;
            Some(Alternative {
                number,
                layout: best.layout,
                cells: best.cells(),
                bytes: best.bytes(),
            })
        };
        let own = self.task.number;
        let others = Number::ALL.into_iter().filter(|number| *number != own);
        [own].into_iter().chain(others).filter_map(meets).collect()
    }

    fn none_fits(&self, own: &[&SearchResult], best: Option<&Candidate>) -> Failure {
        let smallest = own.iter().filter_map(|answer| match answer {
            SearchResult::TooLarge(bytes) => Some(*bytes),
            _ => None,
        });
        Failure::Impossible(Impossible::DoesNotFit {
            best: best.map(|best| BestFit {
                layout: best.layout,
                cells: best.cells(),
                error: best.error(),
            }),
            smallest: smallest.min(),
            alternatives: self.alternatives(),
        })
    }
}

/// The range in which the tables of a layout exceed the error most.
struct WorstRange<'f> {
    search: &'f Search<'f>,
    table: &'f RangeTable,
    layout: LayoutName,
}

impl WorstRange<'_> {
    fn least_error(&self, task: &Task) -> Result<LeastError, Error> {
        Ok(LeastError {
            layout: self.layout,
            cells: self.table.found.cells,
            error: self.table.error,
            range: self.table.range,
            limit: self.limit(task)?,
        })
    }

    /// The number of cells for the requested error, if the error falls with this power of it.
    fn cells_needed(&self, task: &Task, order: f64) -> CellsNeeded {
        let allowed = task.torque_error.unwrap_or_default();
        let cells = f64::from(self.table.found.cells);
        let needed = cells * math::pow(self.table.error / allowed, 1.0 / order);
        if round_up(needed.min(1e9)) <= task.max_cells {
            CellsNeeded::Irregular
        } else if needed <= f64::from(MAX_CELLS) {
            CellsNeeded::Enough(round_up(needed))
        } else {
            CellsNeeded::TooMany
        }
    }

    /// The torque error in double precision, and its position.
    fn without_rounding(&self, cells: u32) -> Result<(f64, f64), Error> {
        match self.layout {
            // Harmonics and closed forms are excluded: see `limit`.
            LayoutName::Spline
            | LayoutName::Spline16
            | LayoutName::Harmonic
            | LayoutName::SliderCrank => self.search.without_rounding::<Spline<f64>>(cells),
            LayoutName::Cubic => self.search.without_rounding::<Cubic<f64>>(cells),
            LayoutName::Quadratic | LayoutName::Rows => {
                self.search.without_rounding::<Quadratic<f64>>(cells)
            }
        }
    }

    fn limit(&self, task: &Task) -> Result<AccuracyLimit, Error> {
        // Share of the actual or of the allowed error from which rounding is the obstacle.
        const SHARE: f64 = 0.5;
        if self.layout == LayoutName::SliderCrank {
            return Ok(AccuracyLimit::Rounding);
        }
        // With any number of coefficients: their ticks are too inaccurate, or there is an edge.
        if self.layout == LayoutName::Harmonic {
            let ticks = self.table.looked <= task.torque_error.unwrap_or_default();
            return Ok(if ticks {
                AccuracyLimit::Rounding
            } else {
                AccuracyLimit::Cells
            });
        }
        let without = |cells| self.without_rounding(cells).map(|(error, _)| error);
        let cells = self.table.found.cells;
        let (bound, error) = (self.table.looked, without(cells)?);
        // More cells were tried and were worse, although the curves themselves are closer.
        let larger = cells + cells.div_ceil(4) <= task.max_cells;
        let closer = larger && without(task.max_cells)? < SHARE * bound;
        if closer || error < SHARE * bound {
            return Ok(AccuracyLimit::Rounding);
        }
        // The largest error of a curve with a kink fluctuates with the place of the kink in its cell: the mean of a few sizes.
        let mean = |cells: u32| -> Result<f64, Error> {
            let sizes = [
                cells,
                cells - cells / 24,
                cells - cells / 12,
                cells - cells / 8,
            ];
            let mut sum = 0.0;
            for cells in sizes {
                sum += math::ln(without(cells.max(4))?);
            }
            Ok(sum / 4.0)
        };
        let order = if cells < 16 {
            3.0
        } else {
            (mean(cells / 2)? - mean(cells)?) / std::f64::consts::LN_2
        };
        Ok(if order > 0.25 {
            AccuracyLimit::Order(order, self.cells_needed(task, order))
        } else {
            AccuracyLimit::Cells
        })
    }
}

/// Two digits, rounded up.
fn round_up(cells: f64) -> u32 {
    let unit = 10f64
        .powi((math::log10(cells) - 1.0).floor() as i32)
        .max(1.0);
    (((cells / unit).ceil() * unit) as u32).min(MAX_CELLS)
}
