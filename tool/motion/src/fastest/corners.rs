//! Where the machine is not smooth along its path.

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{Mechanism as _, Reducible as _};
use jred_file::number::numerics::{edge, least};

use super::field::Field;
use super::joint_force::JointForce;

/// Places per turn, or over a shorter path, between which friction vanishes at most once.
const PLACES: f64 = 360.0;

/// Share of its largest value below which the friction of a load vanishes.
const ZERO_FRICTION: f64 = 1e-6;

/// Share of its largest value: if the slope of a limited force by the acceleration falls below it, cells may not cross that place.
const SINKS: f64 = 0.3;

/// Places per turn at which the machine is tested for change. The number shares no divisor with numbers of teeth.
const CHANGES: u32 = 61;

/// Share of its largest value by which a quantity must change to count as changing.
const LEAST_CHANGE: f64 = 1e-12;

/// Distances from the start, inside the path, at which the machine is not smooth.
///
/// They are its own edges, and places where the sliding partner of a friction load comes to rest and turns back, as a slider does at its dead
/// centres. On a path of several turns those of one turn are repeated.
///
/// # Errors
/// The mechanism cannot be placed somewhere on the path.
pub fn corners(field: &Field, from: f64, length: f64) -> Result<Vec<f64>, Error> {
    let turns = field.dynamics.file.machine.domain() == Domain::Turn;
    let mut found: Vec<f64> = edges(field, from);
    found.extend(reversals(field, from, length)?);
    found.extend(of_tool(field, from)?);
    found.extend(of_forces(field, from, length)?);
    if turns {
        for x in &mut found {
            *x = x.rem_euclid(TAU);
        }
        let more = |x: &f64| {
            let x = *x;
            let repeats = (1..).map(move |k| x + TAU * f64::from(k));
            repeats.take_while(move |x| *x < length)
        };
        let repeated: Vec<f64> = found.iter().flat_map(more).collect();
        found.extend(repeated);
    }
    found.retain(|x| *x > 0.0 && *x < length);
    Ok(found)
}

/// Number of corners of one turn, or of a stroke, that the machine itself names.
pub fn count(field: &Field) -> usize {
    let machine = &field.dynamics.file.machine;
    (0..).map_while(|k| machine.edge(k)).count()
}

/// Whether the machine changes within a turn; always true for a stroke.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub fn changes(field: &Field, from: f64) -> Result<bool, Error> {
    let limited = field.limits.tool.is_some() || field.limits.forces.is_some();
    if field.dynamics.file.machine.domain() != Domain::Turn || count(field) > 0 || limited {
        return Ok(true);
    }
    let torques = field.dynamics.actuator.torques(0.0).map(f64::abs);
    let torque = torques[0].max(torques[1]) * field.dynamics.motor_speed(1.0);
    let first = field.dynamics.place(from)?;
    for k in 0..CHANGES {
        let place = field
            .dynamics
            .place(from + TAU * f64::from(k) / f64::from(CHANGES))?;
        let same =
            |value: f64, other: f64, scale: f64| (value - other).abs() <= LEAST_CHANGE * scale;
        let is_same = same(place.inertia, first.inertia, first.inertia)
            && same(place.inertia_slope, 0.0, first.inertia)
            && same(place.load, first.load, torque)
            && same(place.viscous, first.viscous, first.viscous)
            && same(place.coulomb, first.coulomb, torque);
        if !is_same {
            return Ok(true);
        }
    }
    Ok(false)
}

fn edges(field: &Field, from: f64) -> Vec<f64> {
    let machine = &field.dynamics.file.machine;
    let edges = (0..).map_while(|k| machine.edge(k));
    edges
        .map(|phi| (phi - from) * field.dynamics.direction)
        .collect()
}

/// Ends of the parts in which the tool's speed is limited, and places where the active limit of the drive link's speed changes.
fn of_tool(field: &Field, from: f64) -> Result<Vec<f64>, Error> {
    let machine = &field.dynamics.file.machine;
    let mechanism = machine.mechanism();
    let (top, _) = field.top();
    let tools = &field.limits.tool;
    // The active limit at a position: the index of the tool's limit, or `None` for another one.
    let ruling = |phi: f64| -> Result<Option<usize>, Error> {
        let mut least = (top, None);
        for (k, tool) in tools.iter().enumerate() {
            let own = tool.at(mechanism, phi)?;
            if own < least.0 {
                least = (own, Some(k));
            }
        }
        Ok(least.1)
    };
    let mut found = Vec::new();
    for tool in tools.iter() {
        let places: Vec<f64> = tool.places(machine.domain(), PLACES as usize).collect();
        found.extend(places.first().into_iter().chain(places.last()));
        let inner = places.get(1..places.len() - 1).unwrap_or_default();
        for pair in inner.windows(2) {
            let first = ruling(pair[0])?;
            if first != ruling(pair[1])? {
                let same = |phi: f64| Ok::<_, Error>(ruling(phi)? == first);
                found.push(edge(same, pair[0], pair[1])?);
            }
        }
    }
    Ok((found.into_iter())
        .map(|phi| (phi - from) * field.dynamics.direction)
        .collect())
}

/// Distances from the start, in the path or in the first turn of a longer one, at which a quantity of the position has a local minimum of at most
/// this share of its largest value.
fn lows(
    field: &Field,
    from: f64,
    length: f64,
    share: f64,
    quantity: impl Fn(f64) -> Result<f64, Error>,
) -> Result<Vec<f64>, Error> {
    let whole = field.dynamics.file.machine.domain() == Domain::Turn && length > TAU;
    let length = if whole { TAU } else { length };
    let count = PLACES as usize;
    // A whole turn has no ends, so one place before and one after it is evaluated too.
    let outside = usize::from(whole);
    let place = |k: usize| length * (k as f64 - outside as f64) / PLACES;
    let at = |x: f64| quantity(from + field.dynamics.direction * x);
    let values: Vec<f64> = (0..=count + 2 * outside)
        .map(|k| at(place(k)))
        .collect::<Result<_, _>>()?;
    let largest = values.iter().copied().fold(0.0, f64::max);
    let mut found = Vec::new();
    for (k, three) in values.windows(3).enumerate() {
        if three[1] <= three[0] && three[1] < three[2] {
            let x = least(at, place(k), place(k + 2))?;
            if at(x)? <= share * largest {
                found.push(x);
            }
        }
    }
    Ok(found)
}

/// Places where the acceleration changes a limited force least: there the limit is (nearly) one of the speed alone.
fn of_forces(field: &Field, from: f64, length: f64) -> Result<Vec<f64>, Error> {
    let mut found = Vec::new();
    for k in 0..field.limits.forces.count() {
        let by_acceleration = |phi: f64| {
            let forces = field.forces(phi)?;
            Ok(forces.get(k).map_or(0.0, JointForce::by_acceleration))
        };
        found.extend(lows(field, from, length, SINKS, by_acceleration)?);
    }
    Ok(found)
}

/// Places where the friction of a load vanishes.
fn reversals(field: &Field, from: f64, length: f64) -> Result<Vec<f64>, Error> {
    let file = field.dynamics.file;
    let machine = &file.machine;
    let mut found = Vec::new();
    for load in file.machine_at(&field.dynamics.now(), from)?.loads() {
        let friction = |phi: f64| -> Result<f64, Error> {
            let frames = machine.mechanism().frames(phi)?;
            let frame = frames.get(load.link());
            Ok(frame.map_or(0.0, |frame| load.reduce(frame, phi).coulomb))
        };
        if load.has_fixed_direction() {
            continue;
        }
        found.extend(lows(field, from, length, ZERO_FRICTION, friction)?);
    }
    Ok(found)
}
