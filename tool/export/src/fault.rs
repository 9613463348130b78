//! Why no table meets the request: the result of each layout, the obstacle, and the cure.

use std::fmt::Write as _;

use jred::error::Error;
use jred::number::RangeError;
use jred::table::{MAX_CELLS, TableError};
use jred::{Cubic, Quadratic, Spline};

use crate::candidate::{Candidate, RangeTable, SearchResult};
use crate::choice::{LayoutName, Number};
use crate::pieces::Searches;
use crate::place::{Feature, feature};
use crate::search::Search;
use crate::task::{Failure, Task};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{rounded, short};

/// A search without a result.
pub(crate) struct SearchFailure<'f> {
    pub(crate) file: &'f MachineFile,
    pub(crate) coordinate: Coordinate,
    pub(crate) task: &'f Task,
    pub(crate) search: &'f Searches<'f>,
    pub(crate) answers: &'f [(Number, LayoutName, SearchResult)],
}

/// Obstacles to a more accurate table.
enum AccuracyLimit {
    /// The number type.
    Rounding,
    /// The number of cells: the error falls with this power of it, if it falls.
    Cells(Option<f64>),
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
            let text = format!("{error}; {}", error.cure());
            return Ok(Failure::NotReached(text));
        }
        if let Some(SearchResult::Refused(Error::Table(TableError::PieceUnits))) = own.first() {
            return Ok(Failure::Impossible {
                message: format!(
                    "the tables of pieces share their machine units, which for {} go with the width of a cell, and these edges \
                     leave no common width with up to {} cells",
                    self.task.number.name(),
                    self.task.max_cells
                ),
                help: "take --type f32 or --type i16, or edges at multiples of a simple part of the range, such as whole degrees"
                    .to_owned(),
            });
        }
        let misses = own.iter().filter_map(|answer| match answer {
            SearchResult::Misses(candidate) => Some(candidate.as_ref()),
            _ => None,
        });
        let mut misses: Vec<&Candidate> = misses.collect();
        misses.sort_by(|a, b| a.error().total_cmp(&b.error()));
        if let Some(most) = self.task.max_bytes {
            return Ok(self.none_fits(most, &own, misses.first().copied()));
        }
        let Some(best) = misses.first() else {
            if let Some(text) = self.too_coarse() {
                return Ok(Failure::NotReached(text));
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
        self.not_reached(&misses, best).map(Failure::NotReached)
    }

    fn error(&self, bound: f64) -> String {
        format!("{} {}", short(bound), self.coordinate.effort_unit())
    }

    fn effort(&self) -> &'static str {
        self.coordinate.vocabulary().torque.word
    }

    /// If a larger number of cells than allowed would give a table of each requested layout: which layouts, and how many cells.
    fn too_coarse(&self) -> Option<String> {
        let coarse = self.answers.iter().filter_map(|(number, layout, answer)| {
            let asked = *number == self.task.number && self.task.layout.allows(*layout);
            match answer {
                SearchResult::TooCoarse(error, cells) if asked => Some((layout, error, *cells)),
                _ => None,
            }
        });
        let coarse: Vec<_> = coarse.collect();
        let enough = coarse.iter().map(|(.., cells)| *cells).min()?;
        let mut text = format!(
            "no {} table of up to {} cells is usable: that is too coarse\n",
            self.task.number.name(),
            self.task.max_cells
        );
        for (layout, error, cells) in coarse {
            let _ = writeln!(
                text,
                "  {}: {error}, in the table, not in the machine; {cells} cells are enough",
                layout.name()
            );
        }
        let _ = write!(text, "use --max-cells {enough} or more");
        text += &self.cures();
        Some(text)
    }

    fn not_reached(&self, misses: &[&Candidate], best: &Candidate) -> Result<String, Error> {
        let allowed = self.task.torque_error.unwrap_or_default();
        let number = self.task.number.name();
        let mut text = format!(
            "no table meets a {} error of {} {}: type {number}, up to {} cells\n",
            self.effort(),
            rounded(allowed),
            self.coordinate.effort_unit(),
            self.task.max_cells
        );
        let mut most_cells = None;
        for candidate in misses {
            let Some(worst) = self.worst(candidate) else {
                continue;
            };
            let (cells, error) = (worst.table.found.cells, worst.table.error);
            let _ = write!(
                text,
                "  {}: {cells} {} reach {}{}",
                candidate.layout.name(),
                candidate.layout.counted(),
                self.error(error),
                self.piece(worst.table)
            );
            match worst.limit(self.task)? {
                AccuracyLimit::Rounding => {
                    let _ = write!(
                        text,
                        "; this is the rounding floor of {number}: more {} do not lower it",
                        candidate.layout.counted()
                    );
                }
                AccuracyLimit::Cells(Some(order)) => {
                    let _ = write!(
                        text,
                        "; the error falls with the number of cells to the power of {order:.1}"
                    );
                    let needed = f64::from(cells) * (error / allowed).powf(1.0 / order);
                    // If fewer cells than were tried would suffice by this, the error does not follow its order.
                    if round_up(needed.min(1e9)) <= self.task.max_cells {
                        text += " so far, but does not reach the error asked for";
                    } else if needed <= f64::from(MAX_CELLS) {
                        let needed = round_up(needed);
                        if most_cells.is_none_or(|most| needed < most) {
                            most_cells = Some(needed);
                        }
                        let _ =
                            write!(text, "; at this rate, --max-cells {needed} would be enough");
                    } else {
                        let _ = write!(text, "; at this rate, even {MAX_CELLS} are too few");
                    }
                }
                AccuracyLimit::Cells(None) => {
                    let _ = write!(
                        text,
                        "; more {} hardly lower it",
                        candidate.layout.counted()
                    );
                }
            }
            text.push('\n');
        }
        let Some(piece) = self.worst(best) else {
            return Ok(text);
        };
        let rounding = matches!(piece.limit(self.task)?, AccuracyLimit::Rounding);
        let (worst, cells) = (piece.table.found.worst, piece.table.found.cells);
        let _ = write!(
            text,
            "the largest error is at {}",
            self.coordinate.place(worst)
        );
        let mut found = None;
        if !rounding {
            found = self.feature(&piece, worst, cells)?;
            if let Some(found) = &found {
                let _ = write!(text, ": {}", found.words);
            } else {
                // With more cells the error decreases where the curve is smooth, so that a kink becomes visible.
                let finer = (4 * cells).min(MAX_CELLS);
                let (_, worst) = piece.without_rounding(finer)?;
                found = self.feature(&piece, worst, finer)?;
                if let Some(found) = &found {
                    let _ = write!(text, "; with more cells, it is where {}", found.words);
                }
            }
        }
        text += "\nincrease the allowed error";
        text += &self.cures();
        if let Some(cells) = most_cells {
            let _ = write!(text, ", or --max-cells {cells}");
        }
        if let Some(cure) = found.and_then(|found| found.cure) {
            text += ", or ";
            text += &cure;
        }
        if rounding {
            text += ", or give a smaller range with --omega and --alpha";
        }
        Ok(text)
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

    /// Names the piece of a table among several.
    fn piece(&self, table: &RangeTable) -> String {
        let [from, to] = table.range.map(|end| self.coordinate.place(end));
        match self.search.ranges.len() {
            1 => String::new(),
            _ => format!(" in the piece from {from} to {to}"),
        }
    }

    /// The feature within one and a half cells of a position.
    fn feature(
        &self,
        piece: &WorstRange<'_>,
        at: f64,
        cells: u32,
    ) -> Result<Option<Feature>, Error> {
        let near = 1.5 * piece.search.domain.span() / f64::from(cells);
        let found = feature(self.file, self.search.machine, self.coordinate, at, near)?;
        // For pieces, the cure is a cut there.
        let cure = |feature: Feature| match self.search.ranges.len() {
            1 => feature,
            _ => Feature {
                cure: None,
                ..feature
            },
        };
        Ok(found.map(cure))
    }

    /// Results of the other layouts and types; each was tried. Each begins with ", or take".
    fn cures(&self) -> String {
        let meets = |number: Number, layouts: bool| {
            let found = self
                .answers
                .iter()
                .filter_map(|(n, _, answer)| match answer {
                    SearchResult::Meets(c) if *n == number => Some(c.as_ref()),
                    _ => None,
                });
            let best = found.min_by_key(|candidate| candidate.bytes())?;
            let layout = if layouts {
                format!("--layout {}", best.layout.name())
            } else if self.task.layout.allows(best.layout) {
                format!("--type {}", number.name())
            } else {
                format!("--type {} --layout {}", number.name(), best.layout.name())
            };
            Some(format!(
                ", or take {layout} ({} cells, {} bytes)",
                best.cells(),
                best.bytes()
            ))
        };
        let own = meets(self.task.number, true);
        let others = Number::ALL.into_iter().filter(|n| *n != self.task.number);
        own.into_iter()
            .chain(others.filter_map(|number| meets(number, false)))
            .collect()
    }

    fn none_fits(&self, most: u32, own: &[&SearchResult], best: Option<&Candidate>) -> Failure {
        let number = self.task.number.name();
        let smallest = own.iter().filter_map(|answer| match answer {
            SearchResult::TooLarge(bytes) => Some(*bytes),
            _ => None,
        });
        let message = match (best, self.task.torque_error, smallest.min()) {
            (Some(best), Some(allowed), _) => format!(
                "no {number} table of {most} bytes meets a {} error of {} {}: the smallest error found in that size is {}, with layout {} and {} cells",
                self.effort(),
                rounded(allowed),
                self.coordinate.effort_unit(),
                self.error(best.error()),
                best.layout.name(),
                best.cells()
            ),
            (_, _, Some(smallest)) => format!(
                "no {number} table fits into {most} bytes: the smallest image takes {smallest} bytes"
            ),
            _ => format!("no {number} table of {most} bytes is usable: more cells are needed"),
        };
        let mut help = "allow more bytes".to_owned();
        if self.task.torque_error.is_some() {
            help += ", or a larger error";
        }
        help += &self.cures();
        Failure::Impossible { message, help }
    }
}

/// The range in which the tables of a layout exceed the error most.
struct WorstRange<'f> {
    search: &'f Search<'f>,
    table: &'f RangeTable,
    layout: LayoutName,
}

impl WorstRange<'_> {
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
                AccuracyLimit::Cells(None)
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
                sum += without(cells.max(4))?.ln();
            }
            Ok(sum / 4.0)
        };
        if cells < 16 {
            return Ok(AccuracyLimit::Cells(Some(3.0)));
        }
        let order = (mean(cells / 2)? - mean(cells)?) / 2f64.ln();
        Ok(AccuracyLimit::Cells((order > 0.25).then_some(order)))
    }
}

/// Two digits, rounded up.
fn round_up(cells: f64) -> u32 {
    let unit = 10f64.powf((cells.log10() - 1.0).floor()).max(1.0);
    (((cells / unit).ceil() * unit) as u32).min(MAX_CELLS)
}
