//! The smallest table of one range, number type and layout that meets a torque error, or the best one for its bytes.
//!
//! A size is evaluated in two steps: against exact curves computed once, which rejects nearly all insufficient sizes; then by [`tabulate::measure`]
//! and by ticking its image. A size that passes both gives a table.

use std::collections::HashMap;

use jred::error::Error;
use jred::machine::{PoseError, Reducible as _};
use jred::number::RangeError;
use jred::table::{Format, MAX_CELLS, MIN_CELLS, TableError};
use jred::tabulate::{self, Request};
use jred::{CurveSet, Domain, Scale};

use crate::candidate::{RangeTable, SearchResult};
use crate::reference::{KnotCache, Range, Reference};
use size::{Buffers, Size, bytes};

mod size;

pub(crate) use size::rounded_up;

/// All sizes up to this one are tried.
pub const EXHAUSTIVE: u32 = 512;

/// The request.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TableRequirements {
    /// Largest error of the drive torque (N·m); without it, the least possible one.
    pub(crate) torque_error: Option<f64>,
    /// Largest speed and acceleration.
    pub(crate) range: [f64; 2],
    /// Largest number of cells to try.
    pub(crate) max_cells: u32,
    /// Most bytes of the image.
    pub(crate) max_bytes: Option<usize>,
    /// Whether fixed-point tables get the curve of 1/J.
    pub(crate) reciprocal: bool,
}

/// Searches for tables of one range.
pub(crate) struct Search<'m> {
    pub(crate) machine: Range<'m>,
    pub(crate) knots: KnotCache<Range<'m>>,
    pub(crate) domain: Domain,
    pub(crate) reference: Reference,
    pub(crate) goal: TableRequirements,
    pub(crate) set: CurveSet,
}

impl<'m> Search<'m> {
    /// A search over a range of a machine with known curves in use, with a cache of at most this many knots.
    pub(crate) fn new(
        machine: Range<'m>,
        set: CurveSet,
        goal: TableRequirements,
        most_knots: usize,
    ) -> Result<Self, Error> {
        Ok(Self {
            machine,
            knots: KnotCache::new(machine, most_knots),
            domain: machine.domain(),
            reference: Reference::new(&machine)?,
            goal,
            set,
        })
    }

    /// The table of one format with these curves, in machine units of this scale. If other pieces share the units, its number of cells is a multiple
    /// of `shared`, for whose width the units are made.
    ///
    /// # Errors
    /// Errors of the machine.
    pub(crate) fn run<F: Format>(
        &self,
        set: CurveSet,
        scale: Scale,
        shared: Option<u32>,
    ) -> Result<SearchResult<RangeTable>, Error> {
        let mut attempt = Attempt::<F> {
            search: self,
            set,
            scale,
            shared,
            buffers: Buffers::default(),
            worst: 0,
            least: HashMap::new(),
            refused: None,
        };
        attempt.run()
    }

    /// The torque error of a table of this format in double precision, and its position.
    pub(crate) fn without_rounding<F: Format>(&self, cells: u32) -> Result<(f64, f64), Error> {
        let size = Size {
            search: self,
            set: self.set,
            cells,
            scale: Scale::SI,
        };
        size.without_rounding::<F>()
    }
}

struct Attempt<'s, F: Format> {
    search: &'s Search<'s>,
    set: CurveSet,
    scale: Scale,
    /// Common divisor of all numbers of cells, if the machine units are shared.
    shared: Option<u32>,
    buffers: Buffers<F>,
    /// Index of the place with the largest error of the last table, where the next evaluation begins.
    worst: usize,
    /// Lower bounds of the errors of evaluated sizes.
    least: HashMap<u32, f64>,
    /// Why the last rejected size was rejected.
    refused: Option<Error>,
}

impl<'s, F: Format> Attempt<'s, F> {
    fn run(&mut self) -> Result<SearchResult<RangeTable>, Error> {
        let goal = self.search.goal;
        let Some(most) = self.most_cells() else {
            return Ok(SearchResult::TooLarge(self.bytes(MIN_CELLS as u32)));
        };
        if self.shared.is_some_and(|step| most < step) {
            return Ok(SearchResult::Refused(TableError::PieceUnits.into()));
        }
        if let Some(allowed) = goal.torque_error
            && let Some((_, candidate)) =
                tabulate::smallest(most, EXHAUSTIVE, |cells| self.make(cells, allowed))?
        {
            return Ok(SearchResult::Meets(Box::new(candidate)));
        }
        let Some(candidate) = self.best(most)? else {
            let why = self.why_refused();
            return Ok(match self.finer(most)? {
                Some(cells) => SearchResult::TooCoarse(why, cells),
                None => SearchResult::Refused(why),
            });
        };
        let candidate = Box::new(candidate);
        Ok(match goal.torque_error {
            Some(allowed) if candidate.error > allowed => SearchResult::Misses(candidate),
            _ => SearchResult::Meets(candidate),
        })
    }

    /// Why the last rejected size was rejected.
    fn why_refused(&self) -> Error {
        let sound = RangeError::NotFinite("torque error of the table");
        self.refused.unwrap_or(sound.into())
    }

    fn bytes(&self, cells: u32) -> usize {
        bytes::<F>(cells, self.set)
    }

    /// The most cells that may be tried; `None` if even the fewest do not fit.
    fn most_cells(&self) -> Option<u32> {
        let goal = &self.search.goal;
        let most = goal.max_cells.min(MAX_CELLS);
        let fits = |cells: u32| goal.max_bytes.is_none_or(|most| self.bytes(cells) <= most);
        let (mut fitting, mut above) = (MIN_CELLS as u32, most + 1);
        if !fits(fitting) {
            return None;
        }
        while fitting + 1 < above {
            let middle = fitting.midpoint(above);
            if fits(middle) {
                fitting = middle;
            } else {
                above = middle;
            }
        }
        Some(fitting)
    }

    /// The least of growing sizes beyond `most` that gives a sound table.
    fn finer(&mut self, most: u32) -> Result<Option<u32>, Error> {
        for cells in tabulate::growing(MAX_CELLS).filter(|cells| *cells > most) {
            if self.look(cells, f64::INFINITY)?.is_some() {
                return Ok(Some(cells));
            }
        }
        Ok(None)
    }

    /// The most accurate table of up to `most` cells: of all sizes up to [`EXHAUSTIVE`], and of growing ones beyond. If an error is required and
    /// missed, it only shows how far the layout comes: then growing sizes are enough up to three quarters of the largest small size.
    fn best(&mut self, most: u32) -> Result<Option<RangeTable>, Error> {
        let largest = most.min(EXHAUSTIVE);
        let from = match self.search.goal.torque_error {
            Some(_) => (largest / 4 * 3).max(MIN_CELLS as u32),
            None => MIN_CELLS as u32,
        };
        let all = (from..=largest).rev();
        let beyond = tabulate::growing(most).filter(|cells| *cells > largest || *cells < from);
        let mut sizes: Vec<(f64, u32)> = Vec::new();
        let mut least = f64::INFINITY;
        for cells in beyond.chain(all) {
            if let Some(error) = self.look(cells, least)? {
                least = error;
                sizes.push((error, cells));
            }
        }
        // The last is the best; if its image is refused, the ones before it are tried.
        while let Some((_, cells)) = sizes.pop() {
            if let Some(found) = self.make(cells, f64::INFINITY)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    fn size(&self, cells: u32) -> Size<'s> {
        let mut scale = self.scale;
        if F::WHOLE_FACTOR && self.shared.is_none() {
            scale = scale.for_cells(cells, self.search.domain.span());
        }
        Size {
            search: self.search,
            set: self.set,
            cells,
            scale,
        }
    }

    /// The bound of the torque error of this size at the places of the reference; `None` if it is above `limit`, or if the size gives no sound table.
    fn look(&mut self, cells: u32, limit: f64) -> Result<Option<f64>, Error> {
        let cells = cells.next_multiple_of(self.shared.unwrap_or(1));
        if self.least.get(&cells).is_some_and(|error| *error > limit) {
            return Ok(None);
        }
        let size = self.size(cells);
        match size.look(&mut self.buffers, self.worst, limit) {
            Ok((error, worst)) => {
                self.worst = worst;
                self.least.insert(cells, error);
                Ok((error <= limit).then_some(error))
            }
            Err(error) => self.refuse(cells, error),
        }
    }

    /// The table of at least this many cells, if it meets the limit everywhere.
    fn make(&mut self, cells: u32, limit: f64) -> Result<Option<RangeTable>, Error> {
        let cells = cells.next_multiple_of(self.shared.unwrap_or(1));
        let Some(looked) = self.look(cells, limit)? else {
            return Ok(None);
        };
        let [omega, alpha] = self.search.goal.range;
        let request = Request::new(limit)
            .with_max_speed(omega)
            .with_max_acceleration(alpha)
            .with_max_cells(cells);
        let size = self.size(cells);
        match size.make(&mut self.buffers, &request, looked) {
            Ok(made) => {
                if made.is_none() {
                    self.least.insert(cells, limit.next_up());
                }
                Ok(made)
            }
            Err(error) => self.refuse(cells, error),
        }
    }

    /// A coarse curve may fall below zero or leave the range; more cells cure that. Any other error is an error of the machine.
    fn refuse<T>(&mut self, cells: u32, error: Error) -> Result<Option<T>, Error> {
        match error {
            Error::Pose(PoseError::NoInertia { .. }) | Error::Table(_) => {
                self.least.insert(cells, f64::INFINITY);
                self.refused = Some(error);
                Ok(None)
            }
            error => Err(error),
        }
    }
}
