//! From a machine to the smallest table that meets a torque error.
//!
//! The error of the drive torque that a table causes is bounded, at every position checked, by the sum of what its
//! curves contribute at the ends of the stated range:
//!
//! ```text
//! |δT| ≤ |δJ|·α_max + ½·|δJ′|·ω_max² + |δload| + |δb|·ω_max + |δc|
//! ```
//!
//! δ is the table's own value, read in its own arithmetic (quantisation and rounding included), against the exact
//! reduction, at [`CHECKS_PER_CELL`] places of every cell, and at both ends of a stroke.

mod fill;
mod measure;
mod near;
mod rounding;
mod unfold;

pub use fill::fill;
pub use measure::measure;
pub(crate) use measure::{scan, torque_between};
pub(crate) use unfold::unfold;

use measure::measure_until;
use near::{Look, meets_near, search_near};

use crate::curve::{Layout, MAX_CELLS, Table, control_points, curves};
use crate::error::positive;
use crate::machine::reduction::Reducible;
use crate::number::Scalar;
use crate::{Error, Scale, Validity, math};

/// Places in each cell at which a table is compared with the exact curves.
pub const CHECKS_PER_CELL: u32 = 64;
/// Places at which a candidate is looked at first.
const COARSE_CHECKS: u32 = 8;

/// Sizes up to this one are all tried.
pub const EXHAUSTIVE: u32 = 128;

/// What a table is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Largest error of the drive torque (N·m).
    pub torque_error: f64,
    /// Largest speed (rad/s).
    pub omega: f64,
    /// Largest acceleration (rad/s²).
    pub alpha: f64,
    /// Most cells to try.
    pub max_cells: u32,
}

impl Request {
    pub(crate) fn check(&self) -> Result<(), Error> {
        positive("torque error", self.torque_error)?;
        positive("largest speed", self.omega)?;
        positive("largest acceleration", self.alpha)?;
        Ok(())
    }
}

/// A table found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Tabulated {
    /// Number of cells.
    pub cells: u32,
    /// Largest error of the drive torque (N·m) at the places checked.
    pub torque_error: f64,
    /// The same between the places as well, by the second differences of the error (N·m): for the exhaustive check of a
    /// table that was found.
    pub bound: f64,
    /// Where it is (rad).
    pub worst: f64,
    /// Machine units of the table: those asked for, in fixed point as [`Scale::for_cells`] makes them.
    pub scale: Scale,
}

impl Tabulated {
    /// What the image says about itself.
    #[must_use]
    pub fn validity(&self, request: &Request) -> Validity {
        Validity {
            omega: request.omega as f32,
            alpha: request.alpha as f32,
            torque_error: self.torque_error as f32,
        }
    }
}

/// Numbers of `f64` scratch that tables of up to `cells` cells need.
#[must_use]
pub const fn scratch_len(cells: u32, set: u8) -> usize {
    (curves::width(set) + 1) * control_points(cells as usize)
}

/// Words that a table of `cells` cells has.
#[must_use]
pub fn words_len<L: Layout>(cells: u32, set: u8) -> usize {
    L::words(cells as usize, set)
}

/// The set of curves that the machine has: those that are not zero at all of `positions` places. Viscous and Coulomb friction
/// that is the same at all of them is one number instead of a curve.
///
/// # Errors
/// Those of the machine.
pub fn curves_in_use(machine: &impl Reducible, positions: u32) -> Result<u8, Error> {
    // Roundings of sums over links.
    const SAME: f64 = 1e-12;
    let mut set = curves::INERTIA;
    let mut first = None;
    for k in 0..positions {
        let place = f64::from(k) / f64::from(positions);
        let point = machine.reduction(machine.domain().position(place))?;
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

/// Finds the table with the fewest cells that meets the request, fills `words` with it, and says how exact it is.
///
/// Sizes that grow by a quarter each are tried until one meets the request; then the sizes below it: every one of them from
/// the smallest on, up to [`EXHAUSTIVE`] cells, and beyond by bisection, which takes for granted that more cells err less. A
/// candidate is dropped at its first position that misses, which is looked for first where the one before it was worst. In the
/// bisection only the cells near the worst position are looked at; the size that comes out is checked at all places, and
/// larger ones after it if it misses. In fixed point the machine units of the table are those in [`Tabulated::scale`].
///
/// # Errors
/// [`Error::TorqueErrorNotReached`] if none of the growing sizes up to `max_cells` does, with the best of them;
/// [`Error::Table`] if a fixed-point model cannot be made of the largest; otherwise as [`fill`](fill()).
pub fn tabulate<S: Scalar, L: Layout>(
    machine: &impl Reducible,
    set: u8,
    request: &Request,
    scale: &Scale,
    scratch: &mut [f64],
    words: &mut [S::Word],
) -> Result<Tabulated, Error> {
    request.check()?;
    let (mut worst, mut near) = (0.0, None);
    let found = search_near(request, |cells, look| {
        let Ok((table, scale)) = candidate::<S, L>(machine, set, cells, scale, scratch, words)
        else {
            return Ok(None);
        };
        if look == Look::Near && cells > EXHAUSTIVE {
            return meets_near(machine, &table, request, &scale, &mut near);
        }
        meets(request, &mut worst, |from| {
            measure_until(machine, &table, request, &scale, from, true)
        })
    })?;
    let Some(found) = found else {
        return Err(not_reached(request, |cells| {
            let (table, scale) = candidate::<S, L>(machine, set, cells, scale, scratch, words)?;
            measure(machine, &table, request, &scale)
        }));
    };
    candidate::<S, L>(machine, set, found.cells, scale, scratch, words)?;
    Ok(found)
}

/// The table of so many cells, and its machine units, if a model can be made of it.
fn candidate<'w, S: Scalar, L: Layout>(
    machine: &impl Reducible,
    set: u8,
    cells: u32,
    scale: &Scale,
    scratch: &mut [f64],
    words: &'w mut [S::Word],
) -> Result<(Table<'w, S, L>, Scale), Error> {
    let domain = machine.domain();
    let scale = scale.suiting::<S>(cells, domain.span());
    let table = fill::<S, L>(machine, set, cells, &scale, scratch, words)?;
    crate::tick::check(&table, S::span(domain), &scale).map_err(Error::Table)?;
    Ok((table, scale))
}

/// The sizes of a table from few cells to `request.max_cells`, growing by a quarter.
fn sizes(request: &Request) -> impl Iterator<Item = u32> {
    let least = crate::curve::MIN_CELLS as u32;
    let most = request.max_cells.clamp(least, MAX_CELLS);
    core::iter::successors(Some(least), move |cells| {
        (*cells < most).then(|| (cells + cells.div_ceil(4)).min(most))
    })
}

/// The smallest size that `meets` says yes to, as [`tabulate`] looks for it.
pub(crate) fn search(
    request: &Request,
    mut meets: impl FnMut(u32) -> Result<Option<Tabulated>, Error>,
) -> Result<Option<Tabulated>, Error> {
    let mut below = 0; // the largest size known to miss
    let mut best = None;
    for cells in sizes(request) {
        best = meets(cells)?;
        if best.is_some() {
            break;
        }
        below = cells;
    }
    let Some(mut best) = best else {
        return Ok(None);
    };
    for cells in crate::curve::MIN_CELLS as u32..best.cells.min(EXHAUSTIVE) {
        if let Some(found) = meets(cells)? {
            return Ok(Some(found));
        }
    }
    below = below.max(EXHAUSTIVE.min(best.cells) - 1);
    while below + 1 < best.cells {
        let middle = below.midpoint(best.cells);
        match meets(middle)? {
            Some(found) => best = found,
            None => below = middle,
        }
    }
    Ok(Some(best))
}

/// What `measure` says of a candidate that meets the request, looked at first in few places, and where the one before it was
/// worst.
pub(crate) fn meets(
    request: &Request,
    worst: &mut f64,
    measure: impl Fn((f64, u32)) -> Result<Tabulated, Error>,
) -> Result<Option<Tabulated>, Error> {
    let mut found = Tabulated::default();
    for checks in [COARSE_CHECKS, CHECKS_PER_CELL] {
        found = measure((*worst, checks))?;
        *worst = found.worst;
        if found.torque_error > request.torque_error {
            return Ok(None);
        }
    }
    Ok(Some(found))
}

/// The best that any of the growing sizes reaches, or why the largest is no table at all.
pub(crate) fn not_reached(
    request: &Request,
    mut measured: impl FnMut(u32) -> Result<Tabulated, Error>,
) -> Error {
    let mut best = Tabulated {
        torque_error: f64::INFINITY,
        ..Tabulated::default()
    };
    let mut refused = None;
    for cells in sizes(request) {
        // A coarse curve may dip below zero or overshoot: more cells cure it. What the largest size says counts.
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
