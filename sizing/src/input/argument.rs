//! Quantities on the command line, read as in machine files.

use super::kind::{
    ACCELERATION, ANGULAR_ACCELERATION, ANGULAR_SPEED, INERTIA, Kind, TORQUE, VELOCITY,
};
use super::quantity;
use crate::coordinate::Coordinate;

/// A torque greater than zero, such as "0.5 N m" (N·m).
///
/// # Errors
/// In words for the command line.
pub fn torque_argument(text: &str) -> Result<f64, String> {
    positive(text, &TORQUE)
}

/// A speed greater than zero, such as "90 rpm" (rad/s).
///
/// # Errors
/// In words for the command line.
pub fn speed_argument(text: &str) -> Result<f64, String> {
    positive(text, &ANGULAR_SPEED)
}

/// An angular acceleration greater than zero, such as "120 rad/s^2" (rad/s²).
///
/// # Errors
/// In words for the command line.
pub fn acceleration_argument(text: &str) -> Result<f64, String> {
    positive(text, &ANGULAR_ACCELERATION)
}

/// An inertia greater than zero, such as "8.5 kg cm^2" (kg·m²).
///
/// # Errors
/// In words for the command line.
pub fn inertia_argument(text: &str) -> Result<f64, String> {
    positive(text, &INERTIA)
}

/// A speed of the drive link of either sign, such as "-60 rpm", or "0.2 m/s" of one that slides.
///
/// # Errors
/// In words for the command line.
pub fn drive_speed(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    any(
        text,
        match coordinate {
            Coordinate::Angle => &ANGULAR_SPEED,
            Coordinate::Length => &VELOCITY,
        },
    )
}

/// An acceleration of the drive link of either sign, such as "120 rad/s^2", or "3 m/s^2" of one that slides.
///
/// # Errors
/// In words for the command line.
pub fn drive_acceleration(text: &str, coordinate: Coordinate) -> Result<f64, String> {
    any(
        text,
        match coordinate {
            Coordinate::Angle => &ANGULAR_ACCELERATION,
            Coordinate::Length => &ACCELERATION,
        },
    )
}

fn positive(text: &str, kind: &'static Kind) -> Result<f64, String> {
    let value = any(text, kind)?;
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
