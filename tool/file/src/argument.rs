//! Quantities on the command line, read like those of machine files.

use jred::Domain;

use crate::model::axis::At;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::number::rounding::rounded;
use crate::units::kind::{
    ACCELERATION, ANGLE, ANGULAR_ACCELERATION, ANGULAR_JERK, ANGULAR_SPEED, FORCE, FORCE_RATE,
    INERTIA, JERK, Kind, LENGTH, MASS, SHARE, TEMPERATURE, TORQUE, TORQUE_RATE, VELOCITY,
};
use crate::units::quantity;

/// Share of a stroke by which a position may lie beyond its ends: rounding.
const ROUNDING: f64 = 1e-9;

/// Reads a quantity of a turning or sliding drive link.
pub type Reader = fn(&str, Coordinate) -> Result<f64, String>;

/// A torque at the drive link greater than zero, such as "0.5 N m", or a force, "5 N", for a sliding one.
///
/// # Errors
/// A message for the command line.
pub fn drive_effort(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    positive(
        text,
        match coordinate {
            Coordinate::Angle => &TORQUE,
            Coordinate::Length => &FORCE,
        },
    )
}

/// A speed of the drive link greater than zero.
///
/// # Errors
/// A message for the command line.
pub fn largest_speed(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    above_zero(drive_speed(text, coordinate)?)
}

/// An acceleration of the drive link greater than zero.
///
/// # Errors
/// A message for the command line.
pub fn largest_acceleration(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    above_zero(drive_acceleration(text, coordinate)?)
}

/// A rate of the acceleration of the drive link greater than zero.
///
/// # Errors
/// A message for the command line.
pub fn largest_jerk(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    positive(
        text,
        match coordinate {
            Coordinate::Angle => &ANGULAR_JERK,
            Coordinate::Length => &JERK,
        },
    )
}

/// A rate of a torque greater than zero, such as "500 N m/s", or of a force, "5 kN/s".
///
/// # Errors
/// A message for the command line.
pub fn largest_effort_rate(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    positive(
        text,
        match coordinate {
            Coordinate::Angle => &TORQUE_RATE,
            Coordinate::Length => &FORCE_RATE,
        },
    )
}

/// An inertia greater than zero, such as "8.5 kg cm^2" (kg·m²).
///
/// # Errors
/// A message for the command line.
pub fn inertia_argument(text: &str) -> Result<f64, String> {
    positive(text, &INERTIA)
}

/// A temperature, such as "120 degC".
///
/// # Errors
/// A message for the command line.
pub fn temperature_argument(text: &str) -> Result<f64, String> {
    any(text, &TEMPERATURE)
}

/// A share from zero up to less than one, such as "10 %".
///
/// # Errors
/// A message for the command line.
pub fn reserve_argument(text: &str) -> Result<f64, String> {
    let share = share_argument(text)?;
    if (0.0..1.0).contains(&share) {
        Ok(share)
    } else {
        Err(
            "it must be at least 0 % and less than 100 %, such as \"10 %\", or \"rules\""
                .to_owned(),
        )
    }
}

/// A share, such as "10 %" or 0.1.
///
/// # Errors
/// A message for the command line.
pub fn share_argument(text: &str) -> Result<f64, String> {
    any(text, &SHARE)
}

/// A torque of either sign, such as "20 N m" (N·m).
///
/// # Errors
/// A message for the command line.
pub fn torque_argument(text: &str) -> Result<f64, String> {
    any(text, &TORQUE)
}

/// An angle of either sign, such as "90 deg" (rad).
///
/// # Errors
/// A message for the command line.
pub fn angle_argument(text: &str) -> Result<f64, String> {
    any(text, &ANGLE)
}

/// A mass greater than zero, such as "12 kg" (kg).
///
/// # Errors
/// A message for the command line.
pub fn mass_argument(text: &str) -> Result<f64, String> {
    positive(text, &MASS)
}

/// A length greater than zero, such as "250 mm" (m).
///
/// # Errors
/// A message for the command line.
pub fn length_argument(text: &str) -> Result<f64, String> {
    positive(text, &LENGTH)
}

/// A speed of the drive link of either sign, such as "-60 rpm", or "0.2 m/s" for a sliding one.
///
/// # Errors
/// A message for the command line.
pub fn drive_speed(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    any(text, speed_kind(coordinate))
}

/// An acceleration of the drive link of either sign, such as "120 rad/s^2", or "3 m/s^2" for a sliding one.
///
/// # Errors
/// A message for the command line.
pub fn drive_acceleration(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    any(text, acceleration_kind(coordinate))
}

/// A position of the drive link, which must lie within its stroke.
fn drive_position(part: &str, domain: Domain, coordinate: Coordinate) -> Result<f64, String> {
    let kind = position_kind(coordinate);
    let position = any(part.trim(), kind).map_err(|why| format!("{:?}: {why}", part.trim()))?;
    match domain {
        Domain::Stroke { from, to } if !(from..=to).contains(&position) => Err(format!(
            "{:?}: it must lie within the stroke, {} to {} {}",
            part.trim(),
            rounded(coordinate.shown(from)),
            rounded(coordinate.shown(to)),
            coordinate.unit()
        )),
        _ => Ok(position),
    }
}

/// The drive link's position (rad or m) for a position of the axis, such as "250 mm" of a carriage; it must lie within the stroke of the drive link.
///
/// # Errors
/// A message for the command line.
pub fn axis_position(text: &str, domain: Domain, axis: &Axis) -> Result<f64, String> {
    let phi = axis.drive_position(any(text.trim(), position_kind(axis.coordinate))?);
    let Domain::Stroke { from, to } = domain else {
        return Ok(phi);
    };
    let slack = ROUNDING * (to - from);
    if (from - slack..=to + slack).contains(&phi) {
        return Ok(phi.clamp(from, to));
    }
    let [from, to] = [from, to].map(|end| axis.shown(end));
    Err(format!(
        "it must lie within the stroke, {} to {} {}",
        rounded(from.min(to)),
        rounded(from.max(to)),
        axis.coordinate.unit()
    ))
}

const fn speed_kind(coordinate: Coordinate) -> &'static Kind {
    match coordinate {
        Coordinate::Angle => &ANGULAR_SPEED,
        Coordinate::Length => &VELOCITY,
    }
}

const fn acceleration_kind(coordinate: Coordinate) -> &'static Kind {
    match coordinate {
        Coordinate::Angle => &ANGULAR_ACCELERATION,
        Coordinate::Length => &ACCELERATION,
    }
}

const fn position_kind(coordinate: Coordinate) -> &'static Kind {
    match coordinate {
        Coordinate::Angle => &ANGLE,
        Coordinate::Length => &LENGTH,
    }
}

/// Positions of the drive link, each optionally followed by its speed and its acceleration, separated by commas, such as "30 deg, 60 deg" or "30 deg,
/// 60 rpm, 5 rad/s^2, 60 deg, 90 rpm". If the drive link turns but the axis is a length, lengths are accepted too: "250 mm, 0.5 m/s".
///
/// # Errors
/// A message for the command line.
pub fn drive_states(text: &str, domain: Domain, axis: [&Axis; 2]) -> Result<Vec<At>, String> {
    let [drive, spoken] = axis;
    // If the kinds are equal, all values are the drive link's.
    let other = (spoken.coordinate != drive.coordinate).then_some(spoken);
    let axes = std::iter::once(drive).chain(other);
    let read = |part: &str, kinds: fn(Coordinate) -> &'static Kind| {
        let mut found = axes.clone().filter_map(|axis| {
            let value = quantity::read(part.trim(), kinds(axis.coordinate)).ok()?;
            Some((axis, value.si))
        });
        found.next()
    };
    let mut rows: Vec<At> = Vec::new();
    // Number of known values of the last row: its position, its speed, its acceleration.
    let mut known = 0;
    for part in text.split(',') {
        let speed = read(part, speed_kind);
        let acceleration = read(part, acceleration_kind);
        if let (Some((axis, value)), 1, Some(row)) = (speed, known, rows.last_mut()) {
            row.state = Some([axis.drive_speed(value), 0.0]);
            known = 2;
        } else if let (Some((axis, value)), 2, Some(row)) = (acceleration, known, rows.last_mut()) {
            row.state = (row.state).map(|[omega, _]| [omega, axis.drive_speed(value)]);
            known = 3;
        } else if speed.is_some() || acceleration.is_some() {
            return Err(format!(
                "{:?} does not follow a position: write position, speed and acceleration in this order",
                part.trim()
            ));
        } else {
            let phi = position_of(part, domain, axis)?;
            rows.push(At { phi, state: None });
            known = 1;
        }
    }
    Ok(rows)
}

/// A position of the drive link, or of an axis of another kind.
fn position_of(part: &str, domain: Domain, [drive, spoken]: [&Axis; 2]) -> Result<f64, String> {
    let is_spoken = spoken.coordinate != drive.coordinate
        && quantity::read(part.trim(), position_kind(spoken.coordinate)).is_ok();
    if is_spoken {
        let read = axis_position(part, domain, spoken);
        return read.map_err(|why| format!("{:?}: {why}", part.trim()));
    }
    drive_position(part, domain, drive.coordinate)
}

/// Positions of the drive link, separated by commas, such as "60 deg, 75 deg", or "10 mm, 12 mm" for a sliding one; positions of an axis of another
/// kind are accepted too.
///
/// # Errors
/// A message for the command line: no position, one outside the stroke, or one that appears twice, as 60 deg and 420 deg do.
pub fn drive_positions(text: &str, domain: Domain, axis: [&Axis; 2]) -> Result<Vec<f64>, String> {
    let position = |part: &str| position_of(part, domain, axis);
    let parts: Vec<&str> = text.split(',').collect();
    let positions: Vec<f64> = parts
        .iter()
        .map(|part| position(part))
        .collect::<Result<_, _>>()?;
    let phases: Vec<_> = positions.iter().map(|place| domain.phase(*place)).collect();
    for (k, phase) in phases.iter().enumerate() {
        if let Some(first) = phases.iter().take(k).position(|earlier| earlier == phase) {
            let [first, again] = [first, k].map(|k| parts[k].trim());
            return Err(format!(
                "{again:?} is the same place as {first:?}; name each place once"
            ));
        }
    }
    Ok(positions)
}

fn positive(text: &str, kind: &'static Kind) -> Result<f64, String> {
    above_zero(any(text, kind)?)
}

fn above_zero(value: f64) -> Result<f64, String> {
    if value > 0.0 {
        Ok(value)
    } else {
        Err("it must be greater than zero".to_owned())
    }
}

fn any(text: &str, kind: &'static Kind) -> Result<f64, String> {
    quantity::read(text, kind)
        .map(|quantity| quantity.si)
        .map_err(|fault| format!("it {}; {}", fault.message, fault.help))
}
