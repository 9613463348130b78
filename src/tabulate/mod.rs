//! From a machine to the smallest table that meets a torque error.
//!
//! In the data flow it comes between a [`Reduction`](crate::machine::Reduction) and a [`Table`](crate::table::Table): on the host, or in firmware
//! after a change of payload.
//!
//! At every position checked, the error of the drive torque of a table is bounded by the sum of its curves' errors at the ends of the stated range:
//!
//! ```text
//! |δT| ≤ |δJ|·α_max + ½·|δJ′|·ω_max² + |δload| + |δb|·ω_max + |δc|
//! ```
//!
//! δ is the table's value in its own arithmetic (with quantisation and rounding) minus the exact reduction, at [`CHECKS_PER_CELL`] places of every
//! cell, at both ends of a stroke, and at and between the [edges](edge_places) of loads and cam segments.

mod buffer;
mod fill;
pub(crate) mod harmonic;
mod measure;
mod near;
mod part;
mod search;
#[cfg(feature = "micromath")]
pub(crate) mod slider_crank;
mod units;

pub use buffer::TableBuffer;
pub use fill::fill;
pub use measure::{edge_places, measure, torque_between};
pub use part::Part;
pub use search::{growing, smallest, tabulate};

use crate::curve::MAX_CELLS;
use crate::curve::curves::{self, CurveSet};
use crate::error::Error;
use crate::machine::Reducible;
use crate::number::error::positive;
use crate::number::spline::{MIN_CELLS, control_points};
use crate::tick::Validity;
use crate::{Scale, math};

/// Places in each cell at which a table is compared with the exact curves.
pub const CHECKS_PER_CELL: u32 = 64;
/// Places in each cell in the first check of a candidate.
const COARSE_CHECKS: u32 = 8;

/// All sizes up to this one are tried.
pub const EXHAUSTIVE: u32 = 128;

/// Requirements for a table.
///
/// ```
/// # use jred::tabulate::Request;
/// let request = Request::new(0.01).with_max_speed(60.0).with_max_acceleration(400.0).with_max_cells(128);
/// ```
///
/// Later versions may add fields, so that a program cannot list them:
///
/// ```compile_fail,E0639
/// # use jred::tabulate::Request;
/// let request = Request { torque_error: 0.01, max_speed: 60.0, max_acceleration: 400.0, max_cells: 128 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Request {
    /// Largest error of the drive torque (N·m).
    pub torque_error: f64,
    /// Largest speed (rad/s).
    pub max_speed: f64,
    /// Largest acceleration (rad/s²).
    pub max_acceleration: f64,
    /// Greatest number of cells or harmonics to try.
    pub max_cells: u32,
}

impl Request {
    /// An error of the drive torque of at most `torque_error` (N·m). Add the range of the motion: [`with_max_speed`](Self::with_max_speed),
    /// [`with_max_acceleration`](Self::with_max_acceleration).
    #[must_use]
    pub const fn new(torque_error: f64) -> Self {
        Self {
            torque_error,
            max_speed: 0.0,
            max_acceleration: 0.0,
            max_cells: MAX_CELLS,
        }
    }

    /// Sets the largest speed (rad/s).
    #[must_use]
    pub const fn with_max_speed(self, max_speed: f64) -> Self {
        Self { max_speed, ..self }
    }

    /// Sets the largest acceleration (rad/s²).
    #[must_use]
    pub const fn with_max_acceleration(self, max_acceleration: f64) -> Self {
        Self {
            max_acceleration,
            ..self
        }
    }

    /// Sets the greatest number of cells or harmonics.
    #[must_use]
    pub const fn with_max_cells(self, max_cells: u32) -> Self {
        Self { max_cells, ..self }
    }

    /// Greatest number of cells that is tried.
    fn most_cells(&self) -> u32 {
        self.max_cells.clamp(MIN_CELLS as u32, MAX_CELLS)
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        positive("torque error", self.torque_error)?;
        positive("largest speed", self.max_speed)?;
        positive("largest acceleration", self.max_acceleration)?;
        Ok(())
    }
}

/// The figures of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct TableFigures {
    /// Number of cells.
    pub cells: u32,
    /// Largest error of the drive torque (N·m) at the places checked: of curves and words; for 16 bits also the rounding of the tick's sums; without
    /// the rounding of the bases ([`Model::torque`](crate::Model::torque) gives both).
    pub torque_error: f64,
    /// The same including the range between the places (N·m), **estimated, not proven**: an eighth of the largest second difference of the error is
    /// added, by which a parabola through three places exceeds them. On a host `jred export --prove` proves it. Only the machine knows its curves
    /// between the places, so that a peak narrower than [`spacing`](Self::spacing) may be missed. For the machine files of the project the search of
    /// the test `hardly_any_place_errs_more_than_the_bound` exceeds it by at most 0.7 %, at corners of the error of tables with an edge inside, and
    /// nowhere without an edge.
    pub bound: f64,
    /// Resolution of `bound`: the distance of the checked places (rad, or m), except at the edges of the machine. 0 if the distances were not equal.
    pub spacing: f64,
    /// Position of the largest error (rad).
    pub worst: f64,
    /// Machine units of the table: the requested ones, in fixed point changed by [`Scale::for_cells`].
    pub scale: Scale,
}

impl TableFigures {
    /// The validity for the header of an image.
    #[must_use]
    pub fn validity(&self, request: &Request) -> Validity {
        Validity {
            max_speed: request.max_speed as f32,
            max_acceleration: request.max_acceleration as f32,
            torque_error: self.torque_error as f32,
        }
    }
}

/// Numbers of `f64` scratch for tables of up to `cells` cells.
#[must_use]
pub const fn scratch_len(cells: u32, set: CurveSet) -> usize {
    (curves::width(set) + 1) * control_points(cells as usize)
}

/// The set of the machine's curves: those that are not zero at all of `positions` places and of the [`edge_places`]. Viscous or Coulomb friction that
/// is the same at all of them becomes a constant instead of a curve.
///
/// # Errors
/// The machine's errors.
pub fn curves_in_use(machine: &impl Reducible, positions: u32) -> Result<CurveSet, Error> {
    // Rounding of sums over links.
    const SAME: f64 = 1e-12;
    let mut set = curves::INERTIA;
    let mut first = None;
    for phi in measure::sampled(machine, positions) {
        let point = machine.reduction(phi)?;
        let start = *first.get_or_insert(point);
        if point.load_torque() != 0.0 {
            set |= curves::LOAD;
        }
        for (curve, constant, value, before) in [
            (
                curves::VISCOUS,
                curves::CONSTANT_VISCOUS,
                point.viscous,
                start.viscous,
            ),
            (
                curves::COULOMB,
                curves::CONSTANT_COULOMB,
                point.coulomb,
                start.coulomb,
            ),
        ] {
            if math::abs(value - before) > SAME * math::abs(before) {
                set |= curve;
            }
            if value != 0.0 {
                set |= constant;
            }
        }
    }
    for (curve, constant) in [
        (curves::VISCOUS, curves::CONSTANT_VISCOUS),
        (curves::COULOMB, curves::CONSTANT_COULOMB),
    ] {
        if set & curve != 0 {
            set &= !constant;
        }
    }
    Ok(set)
}
