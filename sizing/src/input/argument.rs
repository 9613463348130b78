//! Quantities on the command line, read as in machine files.

use super::kind::{ANGULAR_ACCELERATION, ANGULAR_SPEED, INERTIA, Kind, TORQUE};
use super::quantity;

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

fn positive(text: &str, kind: &'static Kind) -> Result<f64, String> {
    let quantity = quantity::read(text, kind)
        .map_err(|fault| format!("it {}; {}", fault.message, fault.help))?;
    if quantity.si > 0.0 {
        Ok(quantity.si)
    } else {
        Err("it must be greater than zero".to_owned())
    }
}
