//! Quantities on the command line, read like those of machine files.

use jred::Domain;

use crate::model::axis::Axis;
use crate::model::axis::DrivePoint;
use crate::model::coordinate::Coordinate;
use crate::number::rounding::rounded;
use crate::text::key::{ACCELERATIONS, Kinds, POSITION, SPEED, ValueRange};
use crate::units::kind::Kind;
use crate::units::quantity;

/// Share of a stroke by which a position may lie beyond its ends: rounding.
const ROUNDING: f64 = 1e-9;

/// A quantity: its kinds, where the coordinate is an angle and where it is a length, and its sign.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    kinds: Kinds,
    range: ValueRange,
}

impl Argument {
    /// Of either sign.
    pub const fn any(kinds: Kinds) -> Self {
        Self {
            kinds,
            range: ValueRange::Any,
        }
    }

    /// Greater than zero.
    pub const fn positive(kinds: Kinds) -> Self {
        Self {
            kinds,
            range: ValueRange::Positive,
        }
    }

    /// Its value in SI.
    ///
    /// # Errors
    /// A message for the command line.
    pub fn read(self, text: &str, coordinate: Coordinate) -> Result<f64, String> {
        let quantity = quantity::read(text, of(self.kinds, coordinate));
        let value = quantity.map_err(|fault| format!("it {}; {}", fault.message, fault.help))?;
        match self.range {
            ValueRange::Positive if value.si <= 0.0 => {
                Err("it must be greater than zero".to_owned())
            }
            ValueRange::NotNegative if value.si < 0.0 => Err("it must be zero or more".to_owned()),
            _ => Ok(value.si),
        }
    }
}

/// Reads a quantity of either sign in SI.
pub fn any(kind: &'static Kind) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| Argument::any([kind; 2]).read(text, Coordinate::Angle)
}

/// Reads a quantity greater than zero in SI.
pub fn positive(kind: &'static Kind) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| Argument::positive([kind; 2]).read(text, Coordinate::Angle)
}

/// Reads a quantity of zero or more in SI.
pub fn not_negative(kind: &'static Kind) -> impl Fn(&str) -> Result<f64, String> + Clone {
    let argument = Argument {
        kinds: [kind; 2],
        range: ValueRange::NotNegative,
    };
    move |text| argument.read(text, Coordinate::Angle)
}

const fn of(kinds: Kinds, coordinate: Coordinate) -> &'static Kind {
    coordinate.pick(kinds[0], kinds[1])
}

/// A position of the drive link, which must lie within its stroke.
fn drive_position(part: &str, domain: Domain, coordinate: Coordinate) -> Result<f64, String> {
    let position = Argument::any(POSITION).read(part.trim(), coordinate);
    let position = position.map_err(|why| format!("{:?}: {why}", part.trim()))?;
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
    let phi = axis.drive_position(Argument::any(POSITION).read(text.trim(), axis.coordinate)?);
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

/// Positions of the drive link, each optionally followed by its speed and its acceleration, separated by commas, such as "30 deg, 60 deg" or "30 deg,
/// 60 rpm, 5 rad/s^2, 60 deg, 90 rpm". If the drive link turns but the axis is a length, lengths are accepted too: "250 mm, 0.5 m/s".
///
/// # Errors
/// A message for the command line.
pub fn drive_states(
    text: &str,
    domain: Domain,
    axis: [&Axis; 2],
) -> Result<Vec<DrivePoint>, String> {
    let [drive, spoken] = axis;
    // If the kinds are equal, all values are the drive link's.
    let other = (spoken.coordinate != drive.coordinate).then_some(spoken);
    let axes = std::iter::once(drive).chain(other);
    let read = |part: &str, kinds: Kinds| {
        let mut found = axes.clone().filter_map(|axis| {
            let value = quantity::read(part.trim(), of(kinds, axis.coordinate)).ok()?;
            Some((axis, value.si))
        });
        found.next()
    };
    let mut rows: Vec<DrivePoint> = Vec::new();
    // Number of known values of the last row: its position, its speed, its acceleration.
    let mut known = 0;
    for part in text.split(',') {
        let speed = read(part, SPEED);
        let acceleration = read(part, ACCELERATIONS);
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
            rows.push(DrivePoint { phi, state: None });
            known = 1;
        }
    }
    Ok(rows)
}

/// A position of the drive link, or of an axis of another kind.
fn position_of(part: &str, domain: Domain, [drive, spoken]: [&Axis; 2]) -> Result<f64, String> {
    let is_spoken = spoken.coordinate != drive.coordinate
        && quantity::read(part.trim(), of(POSITION, spoken.coordinate)).is_ok();
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
