//! How exact a table of 16-bit rows is.

use super::Table;
use crate::machine::reduction::{Reducible, Reduction};
use crate::tabulate::{CHECKS_PER_CELL, Request, Tabulated, scan, torque_between};
use crate::{Error, Phase, Scale};

/// What the tick rounds away beside the curves, in units of the torque base: half a unit of the result, and half a unit of 2⁻¹⁶ of
/// V·ω + b.
pub(super) const TICK: f64 = 0.75 / 32_768.0;

/// The largest torque error of a table within the range of the request.
///
/// As [`tabulate::measure`](crate::tabulate::measure), and the roundings of the tick in addition, at most ¾ of a unit of 2⁻¹⁵ of the
/// torque base: with 16 bits they count. So at the places checked no tick within the range of the request, whose ω and α are numbers
/// of the type, is off by more.
///
/// # Errors
/// Those of the machine.
pub fn measure(
    machine: &impl Reducible,
    table: &Table<'_>,
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

/// As [`measure`], from `start` on round the range at so many places a cell; if `stop`, only up to the first that misses.
pub(super) fn measure_until(
    machine: &impl Reducible,
    table: &Table<'_>,
    request: &Request,
    scale: &Scale,
    from: (f64, u32),
    stop: bool,
) -> Result<Tabulated, Error> {
    let limit = stop.then_some(request.torque_error);
    let found = scan(machine.domain(), table.cells(), limit, from, |phase| {
        torque_error(machine, table, request, scale, phase)
    })?;
    Ok(Tabulated {
        scale: *scale,
        ..found
    })
}

/// The bound at one phase, and where that is.
fn torque_error(
    machine: &impl Reducible,
    table: &Table<'_>,
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
    let read = Reduction {
        inertia: [
            read.inertia * inertia,
            2.0 * read.velocity * torque / (speed * speed),
            0.0,
        ],
        process: read.load * torque,
        viscous: read.viscous * torque / speed,
        coulomb: read.coulomb * torque,
        ..Reduction::default()
    };
    Ok((torque_between(request, &read, &exact) + TICK * torque, phi))
}
