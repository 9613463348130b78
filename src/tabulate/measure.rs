//! How exact a table is.

use super::{CHECKS_PER_CELL, Request, Tabulated};
use crate::reduction::Reducible;
use crate::scalar::Scalar;
use crate::table::{Layout, Table};
use crate::{Error, Phase, Scale, math};

/// The largest torque error of a table within the range of the request.
///
/// # Errors
/// Those of the machine.
pub fn measure<S: Scalar, L: Layout>(
    machine: &impl Reducible,
    table: &Table<'_, S, L>,
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
pub(super) fn measure_until<S: Scalar, L: Layout>(
    machine: &impl Reducible,
    table: &Table<'_, S, L>,
    request: &Request,
    scale: &Scale,
    (start, checks): (f64, u32),
    stop: bool,
) -> Result<Tabulated, Error> {
    let cells = table.cells();
    let places = u64::from(cells) * u64::from(checks);
    let first = u64::from(machine.domain().phase(start).cell(cells).0) * u64::from(checks);
    let mut found = Tabulated {
        cells,
        torque_error: 0.0,
        bound: 0.0,
        worst: start,
        scale: *scale,
    };
    let mut before: heapless::Deque<f64, 2> = heapless::Deque::new();
    let mut curvature = 0.0f64;
    for k in 0..places {
        // In the middle of a piece, as exactly as a phase can say it.
        let place = 2 * ((first + k) % places) + 1;
        let phase = Phase::from_bits(((place << 31) / places) as u32);
        let (error, phi) = torque_error(machine, table, request, scale, phase)?;
        if error > found.torque_error {
            found.torque_error = error;
            found.worst = phi;
            if stop && error > request.torque_error {
                break;
            }
        }
        if let (Some(two), Some(one)) = (before.pop_front(), before.front()) {
            curvature = curvature.max(math::abs(error - 2.0 * one + two));
        }
        // Cannot overflow: at most one is left.
        let _ = before.push_back(error);
    }
    // Between two places a parabola is higher than both by an eighth of the second difference at most.
    found.bound = found.torque_error + 0.125 * curvature;
    Ok(found)
}

/// The bound of the module's head, at one phase, and where that is.
fn torque_error<S: Scalar, L: Layout>(
    machine: &impl Reducible,
    table: &Table<'_, S, L>,
    request: &Request,
    scale: &Scale,
    phase: Phase,
) -> Result<(f64, f64), Error> {
    let domain = machine.domain();
    let phi = domain.position(f64::from(phase.to_bits()) / 4_294_967_296.0);
    let exact = machine.reduction(phi)?;
    let read = table.at(phase);
    let (torque, speed, inertia) = (
        f64::from(scale.torque()),
        f64::from(scale.speed()),
        f64::from(scale.inertia()),
    );
    let per_position = f64::from(table.cells()) / domain.span();
    let slope = read.inertia_slope.to_f64() * inertia * per_position;
    let error = [
        (read.inertia.to_f64() * inertia - exact.inertia[0]) * request.alpha,
        0.5 * (slope - exact.inertia[1]) * request.omega * request.omega,
        read.load.to_f64() * torque - exact.load_torque(),
        (read.viscous.to_f64() * torque / speed - exact.viscous) * request.omega,
        read.coulomb.to_f64() * torque - exact.coulomb,
    ]
    .iter()
    .map(|part| math::abs(*part))
    .sum();
    Ok((error, phi))
}
