//! The error of a table.

use super::{CHECKS_PER_CELL, Request, TableFigures};
use crate::curve::{CurveValues, Format, Table};
use crate::error::Error;
use crate::machine::reducible::Reducible;
use crate::machine::reduction::Reduction;
use crate::{Domain, Phase, math};

/// The largest torque error of a table within the range of the request. With 16 bits the rounding of the tick is significant and is added: at most ¾
/// of a unit of 2⁻¹⁵ of the torque base (`tests/proofs/q15_rows.g`). So at the places checked no tick within the range of the request, with ω and α
/// representable, has a larger error.
///
/// # Errors
/// The machine's errors.
pub fn measure<F: Format>(
    machine: &impl Reducible,
    table: &Table<'_, F>,
    request: &Request,
) -> Result<TableFigures, Error> {
    measure_until(machine, table, request, (0.0, CHECKS_PER_CELL), false)
}

/// Number of parts between two edges.
const PARTS: usize = 8;

/// The edges of a machine (rad, or m; [`Reducible::edge`]) and seven places between each and the next, so that a search for the largest error of a
/// table does not step over a narrow load.
pub fn edge_places(machine: &impl Reducible) -> impl Iterator<Item = f64> {
    let mut next = machine.edge(0);
    let intervals = (1..).map_while(move |k| {
        let edge = next?;
        next = machine.edge(k);
        Some([edge, next.unwrap_or(edge)])
    });
    intervals.flat_map(|[edge, next]| {
        let step = (next - edge) / PARTS as f64;
        (0..PARTS).map(move |part| edge + step * part as f64)
    })
}

/// Positions at which a machine is sampled: `positions` at equal distances, and the [`edge_places`].
pub(super) fn sampled(machine: &impl Reducible, positions: u32) -> impl Iterator<Item = f64> {
    let even = (0..positions).map(move |k| {
        let place = f64::from(k) / f64::from(positions);
        machine.domain().position(place)
    });
    even.chain(edge_places(machine))
}

/// As [`measure`], from `start` on around the range, with `checks` places per cell; if `stop`, only up to the first place that exceeds the request.
pub(super) fn measure_until<F: Format>(
    machine: &impl Reducible,
    table: &Table<'_, F>,
    request: &Request,
    from: (f64, u32),
    stop: bool,
) -> Result<TableFigures, Error> {
    let limit = stop.then_some(request.torque_error);
    let look = |phase| torque_error(machine, table, request, phase);
    let mut found = scan(machine.domain(), table.cells(), limit, from, look)?;
    let within = |found: &TableFigures| limit.is_none_or(|limit| found.torque_error <= limit);
    let mut before = [(f64::NAN, f64::NAN); 2];
    for (k, place) in edge_places(machine).enumerate() {
        // The request is exceeded already.
        if !within(&found) {
            break;
        }
        let (error, phi) = look(machine.domain().phase(place))?;
        if error > found.torque_error {
            (found.torque_error, found.worst) = (error, phi);
        }
        let mut bound = error;
        // Only places closer than those of the cells, and three between the same edges.
        if k % PARTS >= 2 && place - before[1].0 < found.spacing {
            bound += 0.125 * math::abs(error - 2.0 * before[1].1 + before[0].1);
        }
        found.bound = found.bound.max(bound);
        before = [before[1], (place, error)];
    }
    Ok(TableFigures {
        scale: *table.scale(),
        ..found
    })
}

/// The largest of the errors that `torque_error` returns (with their positions) at `checks` places of every cell, from `start` on around the range;
/// if `limit` is given, only up to the first error beyond it.
pub(crate) fn scan(
    domain: Domain,
    cells: u32,
    limit: Option<f64>,
    (start, checks): (f64, u32),
    torque_error: impl Fn(Phase) -> Result<(f64, f64), Error>,
) -> Result<TableFigures, Error> {
    let places = Places {
        first: domain.phase(start).cell(cells).0,
        cells,
        checks,
    };
    let found = scan_places(domain, cells, limit, places, torque_error)?;
    // No place was worst: there is no error at all.
    let worst = if found.torque_error > 0.0 {
        found.worst
    } else {
        start
    };
    Ok(TableFigures { worst, ..found })
}

/// Places of a table where its error is evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    /// The first cell; after the table's last cell follows its first.
    pub(super) first: u32,
    /// Number of cells.
    pub(super) cells: u32,
    /// Places in each cell.
    pub(super) checks: u32,
}

/// As [`scan`], for a table of `cells` cells. It also checks the ends of a stroke: no neighbour makes them continuous, so that the slope has its
/// largest error there.
pub(super) fn scan_places(
    domain: Domain,
    cells: u32,
    limit: Option<f64>,
    places: Places,
    torque_error: impl Fn(Phase) -> Result<(f64, f64), Error>,
) -> Result<TableFigures, Error> {
    let checks = u64::from(places.checks);
    let first = u64::from(places.first) * checks;
    let count = u64::from(places.cells) * checks;
    let all = u64::from(cells) * checks;
    let mut found = TableFigures {
        cells,
        torque_error: 0.0,
        bound: 0.0,
        spacing: domain.span() / all.max(1) as f64,
        ..TableFigures::default()
    };
    let mut find = |phase: Phase| -> Result<(f64, bool), Error> {
        let (error, phi) = torque_error(phase)?;
        if error > found.torque_error {
            found.torque_error = error;
            found.worst = phi;
        }
        Ok((error, limit.is_some_and(|limit| error > limit)))
    };
    if domain != Domain::Turn {
        for end in [0, u32::MAX] {
            if find(Phase::from_bits(end))?.1 {
                return Ok(found);
            }
        }
    }
    let mut before = [f64::NAN; 2];
    let mut curvature = 0.0f64;
    for k in 0..count {
        // The places include the knots, where a quadratic's slope has its largest error.
        let place = (first + k) % all;
        if place == 0 && domain != Domain::Turn {
            // The start of a stroke is not adjacent to its end.
            before = [f64::NAN; 2];
        }
        let phase = Phase::from_bits(((place << 32) / all) as u32);
        let (error, stop) = find(phase)?;
        if stop {
            break;
        }
        // Before the third place the difference is NaN, and `max` ignores it.
        curvature = curvature.max(math::abs(error - 2.0 * before[1] + before[0]));
        before = [before[1], error];
    }
    // Between two places a parabola exceeds both by at most an eighth of the second difference.
    found.bound = found.torque_error + 0.125 * curvature;
    Ok(found)
}

/// The bound of the [module](super)'s head at one phase, and its position.
pub(super) fn torque_error<F: Format>(
    machine: &impl Reducible,
    table: &Table<'_, F>,
    request: &Request,
    phase: Phase,
) -> Result<(f64, f64), Error> {
    let domain = machine.domain();
    let phi = domain.position(f64::from(phase.to_bits()) / 4_294_967_296.0);
    let exact = machine.reduction(phi)?;
    let read = table.si(phase, domain);
    let rounding = F::TICK_ROUNDING * f64::from(table.scale().torque());
    Ok((torque_between(request, &read, &exact) + rounding, phi))
}

/// Bound of the difference between the drive torques of a table and of the machine within the range of the request, as in the [module](super)'s head.
pub fn torque_between(request: &Request, read: &CurveValues, exact: &Reduction) -> f64 {
    [
        (read.inertia - exact.inertia) * request.max_acceleration,
        0.5 * (read.inertia_slope - exact.inertia_slope) * request.max_speed * request.max_speed,
        read.load - exact.load_torque(),
        (read.viscous - exact.viscous) * request.max_speed,
        read.coulomb - exact.coulomb,
    ]
    .iter()
    .map(|part| math::abs(*part))
    .sum()
}
