//! Why there is no table: data, whose sentences the report writes.

use jred::error::Error;
use jred::slider_crank::SliderCrankError;

use crate::choice::{LayoutName, Number};
use crate::place::Feature;
use jred_file::model::by_motion::ByMotion;

/// Why there is no table.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The machine cannot be tabulated.
    Machine(Error),
    /// No table meets the torque error.
    NotReached(NotReached),
    /// The request is impossible.
    Impossible(Impossible),
}

/// Why a request is impossible.
#[derive(Clone, Debug)]
pub enum Impossible {
    /// A part of the machine depends on the motion.
    ByMotion(ByMotion),
    /// Viscous friction depends on the direction of travel.
    ViscousByDirection {
        /// The position (rad, or m).
        at: f64,
    },
    /// Loads by direction drive the motion.
    DrivingLoads {
        /// The position (rad, or m).
        at: f64,
        /// How much less they take forwards than backwards, together with friction (N·m, or N).
        excess: f64,
    },
    /// The closed form does not hold the machine.
    NoClosedForm(NoClosedForm),
    /// A piece is too short.
    ShortPiece {
        /// Its ends (rad, or m).
        range: [f64; 2],
        /// The shortest possible one (rad, or m).
        shortest: f64,
    },
    /// The pieces have too many cells together.
    TooManyCells {
        /// Number of pieces.
        pieces: usize,
        /// Most cells of all pieces together.
        most: usize,
    },
    /// The pieces have no common machine units.
    PieceUnits,
    /// No table fits into the bytes.
    DoesNotFit {
        /// The most accurate table that fits, but does not meet the torque error.
        best: Option<BestFit>,
        /// Bytes of the smallest image.
        smallest: Option<usize>,
        /// Tables of other layouts and types that meet the request.
        alternatives: Vec<Alternative>,
    },
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

/// Why no table meets the torque error.
#[derive(Clone, Debug)]
pub enum NotReached {
    /// Harmonics or the closed form cannot hold the machine.
    Refused(Error),
    /// A larger number of cells than allowed would give a table of each requested layout.
    TooCoarse {
        /// The requested layouts.
        layouts: Vec<CoarseLayout>,
        /// Tables of other layouts and types that meet the request.
        alternatives: Vec<Alternative>,
    },
    /// The tables are less accurate than requested.
    Inaccurate(Inaccuracy),
}

/// A layout without a usable table of the allowed number of cells.
#[derive(Clone, Copy, Debug)]
pub struct CoarseLayout {
    /// The layout.
    pub layout: LayoutName,
    /// The error of its largest table.
    pub error: Error,
    /// A number of cells that is enough.
    pub cells: u32,
}

/// The errors of the requested layouts.
#[derive(Clone, Debug)]
pub struct Inaccuracy {
    /// The layouts, most accurate first.
    pub layouts: Vec<LeastError>,
    /// Position of the largest error of the most accurate one (rad, or m).
    pub worst: f64,
    /// The feature there.
    pub feature: Option<Feature>,
    /// Whether the largest error is at the feature only with more cells.
    pub finer: bool,
    /// Whether the table is cut into pieces.
    pub in_pieces: bool,
    /// Tables of other layouts and types that meet the request.
    pub alternatives: Vec<Alternative>,
}

/// The least error of a layout.
#[derive(Clone, Copy, Debug)]
pub struct LeastError {
    /// The layout.
    pub layout: LayoutName,
    /// Its number of cells.
    pub cells: u32,
    /// Its torque error (N·m, or N).
    pub error: f64,
    /// Range of the table with this error (rad, or m).
    pub range: [f64; 2],
    /// The obstacle to a smaller error.
    pub limit: AccuracyLimit,
}

/// Obstacles to a more accurate table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AccuracyLimit {
    /// The number type.
    Rounding,
    /// The number of cells, which hardly lower the error.
    Cells,
    /// The number of cells: the error falls with this power of it.
    Order(f64, CellsNeeded),
}

/// Number of cells for the requested error, if the error continues to fall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellsNeeded {
    /// Fewer than were tried: the error does not follow its order.
    Irregular,
    /// This number.
    Enough(u32),
    /// More than a table can have.
    TooMany,
}

/// The most accurate table that fits.
#[derive(Clone, Copy, Debug)]
pub struct BestFit {
    /// Layout.
    pub layout: LayoutName,
    /// Number of cells.
    pub cells: u32,
    /// Its torque error (N·m, or N).
    pub error: f64,
}

/// A table of another layout or type that meets the request.
#[derive(Clone, Copy, Debug)]
pub struct Alternative {
    /// Number type.
    pub number: Number,
    /// Layout.
    pub layout: LayoutName,
    /// Number of cells.
    pub cells: u32,
    /// Size of the image (bytes).
    pub bytes: usize,
}

/// Why a machine has no closed form.
#[derive(Clone, Debug)]
pub enum NoClosedForm {
    /// Another mechanism, by its name in machine files.
    Mechanism(&'static str),
    /// A part of the turn.
    Stroke,
    /// Loads that depend on the direction of travel.
    ByDirection,
    /// A curve over the position.
    Curve(String),
    /// A load or a spring that it does not support.
    Part(SliderCrankError),
}
