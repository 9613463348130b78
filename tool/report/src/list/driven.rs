//! The words for process loads that drive a machine, for every listing that knows what they do in a turn.

use jred_file::number::rounding::short;

/// Share of the energy turned over from which the work of process loads drives the machine.
const DRIVING: f64 = 1e-3;

/// Share of the kinetic energy below which a work is the error of an integration.
const ROUNDING: f64 = 1e-6;

/// What is done in a turn.
pub(super) struct Turns {
    /// Of the motor, of the process loads, and lost (J).
    pub(super) works: [f64; 3],
    /// Kinetic energy (J).
    pub(super) kinetic: f64,
    /// Whether φ falls.
    pub(super) is_backwards: bool,
}

/// How process loads that do more work on the machine than they take drive it, and what to do if they should not.
pub(super) fn driven(turns: &Turns) -> Option<String> {
    let [motor, process, losses] = turns.works;
    let turned_over = motor.abs().max(losses.abs());
    if process <= (DRIVING * turned_over).max(ROUNDING * turns.kinetic) {
        return None;
    }
    let why = if turns.is_backwards {
        "φ falls, and a load keeps the sign of its file: give a motor torque of the other sign, or, if the load should resist this way, turn its sign"
    } else {
        "if they should resist, turn their sign"
    };
    Some(format!(
        "drive the machine, by {} J a turn; {why}",
        short(process)
    ))
}
