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
//! reduction, at [`CHECKS_PER_CELL`] places of every cell.

use crate::error::positive;
use crate::reduction::Reducible;
use crate::scalar::Scalar;
use crate::table::{Table, TableError, control_points, curves, fit_bounded, fit_periodic};
use crate::{Domain, Error, Scale, Validity, math};

/// Places in each cell at which a table is compared with the exact curves. Between them the error may be larger by
/// less than 1 in 1000.
pub const CHECKS_PER_CELL: u32 = 64;
/// Places at which a candidate is looked at first.
const COARSE_CHECKS: u32 = 8;

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

/// A table found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Tabulated {
    /// Number of cells.
    pub cells: u32,
    /// Largest error of the drive torque (N·m) at the places checked.
    pub torque_error: f64,
    /// Where it is (rad).
    pub worst: f64,
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

/// The set of curves that the machine has: those that are not zero at all of `positions` places.
///
/// # Errors
/// Those of the machine.
pub fn curves_in_use(machine: &impl Reducible, positions: u32) -> Result<u8, Error> {
    let mut set = curves::INERTIA;
    for k in 0..positions {
        let place = f64::from(k) / f64::from(positions);
        let point = machine.reduction(machine.domain().position(place))?;
        for (curve, value) in [
            (curves::LOAD, point.load_torque()),
            (curves::VISCOUS, point.viscous),
            (curves::COULOMB, point.coulomb),
        ] {
            if value != 0.0 {
                set |= curve;
            }
        }
    }
    Ok(set)
}

/// Fills `words` with the table of exactly `cells` cells and returns it.
///
/// # Errors
/// Those of the machine; curves that do not repeat with the turn of the drive link; buffers too short; a curve outside the
/// number range of `scale`.
pub fn fill<'w, S: Scalar, const CURVES: u8>(
    machine: &impl Reducible,
    cells: u32,
    scale: &Scale,
    scratch: &mut [f64],
    words: &'w mut [S::Word],
) -> Result<Table<'w, S, CURVES>, Error> {
    let width = curves::width(CURVES);
    let rows = control_points(cells as usize);
    let (given, needed) = (scratch.len(), scratch_len(cells, CURVES));
    let too_short = Error::BufferTooShort { needed, given };
    let (samples, control) = scratch
        .get_mut(..needed)
        .and_then(|s| s.split_at_mut_checked(width * rows))
        .ok_or(too_short)?;
    let (given, needed) = (words.len(), width * rows);
    let too_short = Error::BufferTooShort { needed, given };
    let words = words.get_mut(..needed).ok_or(too_short)?;

    let domain = machine.domain();
    let periodic = domain == Domain::Turn;
    if periodic {
        machine.check_repeats()?;
    }
    let knots = if periodic { cells } else { cells + 1 } as usize;
    for k in 0..knots {
        let place = k as f64 / f64::from(cells);
        let values = machine_units::<CURVES>(machine, domain.position(place), scale)?;
        for (curve, value) in values.into_iter().take(width).enumerate() {
            if let Some(slot) = samples.get_mut(curve * rows + k) {
                *slot = value;
            }
        }
    }
    for curve in 0..width {
        let samples = samples.get(curve * rows..).and_then(|s| s.get(..knots));
        let samples = samples.unwrap_or_default();
        if periodic {
            fit_periodic(samples, control)?;
        } else {
            fit_bounded(samples, control)?;
        }
        for (k, value) in control.iter().enumerate() {
            let cell = k.saturating_sub(1) as u32;
            let number = S::from_f64(*value).ok_or(Error::Overflow {
                base: base_name(curve),
                cell,
            })?;
            if let Some(slot) = words.get_mut(k * width + curve) {
                *slot = number.to_word();
            }
        }
    }
    Table::new(words, cells, periodic).map_err(|error| match error {
        TableError::Range { curve, cell } => Error::Overflow {
            base: base_name(curve as usize),
            cell,
        },
        TableError::NoInertia { cell } => Error::NoInertia {
            phi: domain.position(f64::from(cell) / f64::from(cells)),
        },
        other => Error::Table(other),
    })
}

/// Finds the table with the fewest cells that meets the request, fills `words` with it, and says how exact it is.
///
/// Sizes that grow by a quarter each are tried until one meets the request; then every size from 4 up to that one, so
/// that there is no smaller table. A candidate is dropped at its first position that misses, which is looked for first
/// where the one before it was worst.
///
/// # Errors
/// [`Error::TorqueErrorNotReached`] if none of the growing sizes up to `max_cells` does, with the best of them;
/// otherwise as [`fill`].
pub fn tabulate<S: Scalar, const CURVES: u8>(
    machine: &impl Reducible,
    request: &Request,
    scale: &Scale,
    scratch: &mut [f64],
    words: &mut [S::Word],
) -> Result<Tabulated, Error> {
    positive("torque error", request.torque_error)?;
    positive("largest speed", request.omega)?;
    positive("largest acceleration", request.alpha)?;
    let least = crate::table::MIN_CELLS as u32;
    let most = request.max_cells.max(least);
    let mut best = Tabulated {
        cells: 0,
        torque_error: f64::INFINITY,
        worst: 0.0,
    };
    let mut cells = least;
    while best.torque_error > request.torque_error {
        let last = cells >= most;
        match fill::<S, CURVES>(machine, cells, scale, scratch, words) {
            // A coarse curve may dip below zero or overshoot: more cells cure it.
            Err(Error::NoInertia { .. } | Error::Overflow { .. }) if !last => {}
            table => {
                let found = measure(machine, &table?, request, scale)?;
                if found.torque_error < best.torque_error {
                    best = found;
                }
            }
        }
        if last && best.torque_error > request.torque_error {
            return Err(Error::TorqueErrorNotReached {
                asked: request.torque_error,
                reached: best.torque_error,
                cells: best.cells,
            });
        }
        cells = (cells + cells.div_ceil(4)).min(most);
    }
    let mut worst = best.worst;
    for cells in least..best.cells {
        let Ok(table) = fill::<S, CURVES>(machine, cells, scale, scratch, words) else {
            continue;
        };
        let mut found = Tabulated { worst, ..best };
        for checks in [COARSE_CHECKS, CHECKS_PER_CELL] {
            found = measure_until(machine, &table, request, scale, (worst, checks), true)?;
            worst = found.worst;
            if found.torque_error > request.torque_error {
                break;
            }
        }
        if found.torque_error <= request.torque_error {
            return Ok(found);
        }
    }
    fill::<S, CURVES>(machine, best.cells, scale, scratch, words)?;
    Ok(best)
}

/// The largest torque error of a table within the range of the request.
///
/// # Errors
/// Those of the machine.
pub fn measure<S: Scalar, const CURVES: u8>(
    machine: &impl Reducible,
    table: &Table<'_, S, CURVES>,
    request: &Request,
    scale: &Scale,
) -> Result<Tabulated, Error> {
    measure_until(
        machine,
        table,
        request,
        scale,
        (0.0, CHECKS_PER_CELL),
        false,
    )
}

/// As [`measure`], from `start` on round the range at so many places a cell; if `stop`, only up to the first that
/// misses.
fn measure_until<S: Scalar, const CURVES: u8>(
    machine: &impl Reducible,
    table: &Table<'_, S, CURVES>,
    request: &Request,
    scale: &Scale,
    (start, checks): (f64, u32),
    stop: bool,
) -> Result<Tabulated, Error> {
    let domain = machine.domain();
    let cells = table.cells();
    let places = u64::from(cells) * u64::from(checks);
    let first = u64::from(domain.phase(start).cell(cells).0) * u64::from(checks);
    let mut found = Tabulated {
        cells,
        torque_error: 0.0,
        worst: start,
    };
    for k in 0..places {
        let place = ((first + k) % places) as f64 + 0.5;
        let phi = domain.position(place / places as f64);
        let error = torque_error(machine, table, request, scale, phi)?;
        if error > found.torque_error {
            found.torque_error = error;
            found.worst = phi;
            if stop && error > request.torque_error {
                break;
            }
        }
    }
    Ok(found)
}

/// The bound of the module's head, at one position.
fn torque_error<S: Scalar, const CURVES: u8>(
    machine: &impl Reducible,
    table: &Table<'_, S, CURVES>,
    request: &Request,
    scale: &Scale,
    phi: f64,
) -> Result<f64, Error> {
    let domain = machine.domain();
    let exact = machine.reduction(phi)?;
    let read = table.at(domain.phase(phi));
    let (torque, speed, inertia) = (
        f64::from(scale.torque()),
        f64::from(scale.speed()),
        f64::from(scale.inertia()),
    );
    let per_position = f64::from(table.cells()) / domain.span();
    let slope = read.inertia_slope.to_f64() * inertia * per_position;
    Ok([
        (read.inertia.to_f64() * inertia - exact.inertia[0]) * request.alpha,
        0.5 * (slope - exact.inertia[1]) * request.omega * request.omega,
        read.load.to_f64() * torque - exact.load_torque(),
        (read.viscous.to_f64() * torque / speed - exact.viscous) * request.omega,
        read.coulomb.to_f64() * torque - exact.coulomb,
    ]
    .iter()
    .map(|part| math::abs(*part))
    .sum())
}

/// The curves of the set at `phi` in machine units, packed in the order of a row.
fn machine_units<const CURVES: u8>(
    machine: &impl Reducible,
    phi: f64,
    scale: &Scale,
) -> Result<heapless::Vec<f64, 4>, Error> {
    let point = machine.reduction(phi)?;
    let (torque, speed) = (f64::from(scale.torque()), f64::from(scale.speed()));
    let mut row = heapless::Vec::new();
    // Cannot overflow: one inertia and three curves.
    let _ = row.push(point.inertia[0] / f64::from(scale.inertia()));
    for (curve, value) in [
        (curves::LOAD, point.load_torque() / torque),
        (curves::VISCOUS, point.viscous * speed / torque),
        (curves::COULOMB, point.coulomb / torque),
    ] {
        if CURVES & curve != 0 {
            let _ = row.push(value);
        }
    }
    Ok(row)
}

/// The base to enlarge when a curve does not fit.
fn base_name(position: usize) -> &'static str {
    if position == 0 { "inertia" } else { "torque" }
}
