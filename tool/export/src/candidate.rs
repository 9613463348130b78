//! Results of a search: the table of one range, and the tables of a machine, one for each of its pieces.

use jred::error::Error;
use jred::table::Usage;
use jred::tabulate::TableFigures;
use jred::{CurveSet, Scale};
use jred_enclosure::{Proof, ProofError};

use crate::choice::{LayoutName, Number};
use crate::ticks::Ticks;

/// The table of one range, with its image.
#[derive(Clone, Debug)]
pub struct RangeTable {
    /// Start and end of its range (rad, or m).
    pub range: [f64; 2],
    /// Set of [`curves`](jred::curves).
    pub curves: CurveSet,
    /// Accuracy of its curves.
    pub found: TableFigures,
    /// The largest error of the drive torque (N·m, or N): of the curves and of the ticks.
    pub error: f64,
    /// Its torque error at the places of the search only (N·m, or N).
    pub looked: f64,
    /// Accuracy of its ticks.
    pub ticks: Ticks,
    /// Share of the number range that each quantity uses.
    pub usage: Usage,
    /// Its machine units.
    pub scale: Scale,
    /// Bytes of its rows.
    pub row_bytes: usize,
    /// The proof of its error, if requested.
    pub proof: Option<Result<Proof, ProofError>>,
    /// The image.
    pub words: Vec<u32>,
}

impl RangeTable {
    /// Bytes of the image.
    pub fn bytes(&self) -> usize {
        4 * self.words.len()
    }
}

/// The tables of one number type and layout: one, or one for each piece of the range.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Number type.
    pub number: Number,
    /// Layout.
    pub layout: LayoutName,
    /// The tables, in the order of their ranges.
    pub tables: Vec<RangeTable>,
}

impl Candidate {
    /// Cells of all tables.
    pub fn cells(&self) -> u32 {
        self.tables.iter().map(|table| table.found.cells).sum()
    }

    /// Bytes of all rows.
    pub fn row_bytes(&self) -> usize {
        self.tables.iter().map(|table| table.row_bytes).sum()
    }

    /// Bytes of all images.
    pub fn bytes(&self) -> usize {
        self.tables.iter().map(RangeTable::bytes).sum()
    }

    /// The largest error of the drive torque (N·m, or N): of the curves and of the ticks.
    pub fn error(&self) -> f64 {
        self.largest(|table| table.error)
    }

    /// The largest error of the curves (N·m, or N), and its position (rad, or m).
    pub fn curve_error(&self) -> (f64, f64) {
        let tables = self
            .tables
            .iter()
            .map(|table| (table.found.bound, table.found.worst));
        tables
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or_default()
    }

    /// Accuracy of the ticks.
    pub fn ticks(&self) -> Ticks {
        let all = self.tables.iter().map(|table| table.ticks);
        all.fold(Ticks::default(), Ticks::or_worse)
    }

    /// Largest share of the number range that each quantity uses.
    pub fn usage(&self, quantity: fn(&Usage) -> f32) -> f32 {
        let all = self.tables.iter().map(|table| quantity(&table.usage));
        all.fold(0.0, f32::max)
    }

    /// Set of [`curves`](jred::curves), common to all tables.
    pub fn curves(&self) -> CurveSet {
        self.tables.first().map_or(0, |table| table.curves)
    }

    /// The machine units, common to all tables.
    pub fn scale(&self) -> Scale {
        self.tables.first().map_or(Scale::SI, |table| table.scale)
    }

    fn largest(&self, of: impl Fn(&RangeTable) -> f64) -> f64 {
        self.tables.iter().map(of).fold(0.0, f64::max)
    }
}

/// Result for one number type and layout: of one range, or of all pieces.
#[derive(Clone, Debug)]
pub enum SearchResult<T = Candidate> {
    /// Meets the request.
    Meets(Box<T>),
    /// Even the best table does not meet the request.
    Misses(Box<T>),
    /// No size gives a usable table; the reason at the last one.
    Refused(Error),
    /// No allowed size gives a usable table: the reason at the last one, and a larger number of cells that does.
    TooCoarse(Error, u32),
    /// The smallest image does not fit; its size in bytes.
    TooLarge(usize),
}

impl SearchResult<RangeTable> {
    /// The result of all pieces together: a failure of one piece is a failure of all.
    ///
    /// # Errors
    /// Those of a piece.
    pub(crate) fn together(
        pieces: impl Iterator<Item = Result<Self, Error>>,
        number: Number,
        layout: LayoutName,
    ) -> Result<SearchResult, Error> {
        let (mut tables, mut meets) = (Vec::new(), true);
        for piece in pieces {
            match piece? {
                Self::Meets(made) => tables.push(*made),
                Self::Misses(made) => {
                    meets = false;
                    tables.push(*made);
                }
                Self::Refused(error) => return Ok(SearchResult::Refused(error)),
                Self::TooCoarse(error, cells) => return Ok(SearchResult::TooCoarse(error, cells)),
                Self::TooLarge(bytes) => return Ok(SearchResult::TooLarge(bytes)),
            }
        }
        let all = Box::new(Candidate {
            number,
            layout,
            tables,
        });
        Ok(if meets {
            SearchResult::Meets(all)
        } else {
            SearchResult::Misses(all)
        })
    }
}
