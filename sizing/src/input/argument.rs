//! Quantities on the command line, read as in machine files.

use super::kind::{ANGULAR_SPEED, Kind, TORQUE};
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

fn positive(text: &str, kind: &'static Kind) -> Result<f64, String> {
    let quantity = quantity::read(text, kind)
        .map_err(|fault| format!("it {}; {}", fault.message, fault.help))?;
    if quantity.si > 0.0 {
        Ok(quantity.si)
    } else {
        Err("it must be greater than zero".to_owned())
    }
}
