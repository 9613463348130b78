//! Text about process loads that drive a machine, for every listing with the works of a turn.

use jred_file::number::rounding::short;

/// Share of the energy turned over from which the work of process loads drives the machine.
const DRIVING_SHARE: f64 = 1e-3;

/// Share of the kinetic energy below which a work is an integration error.
const ROUNDING: f64 = 1e-6;

/// Works over one turn.
pub(super) struct Turns {
    /// Works of the motor, of the process loads, and the losses (J).
    pub(super) works: [f64; 3],
    /// Kinetic energy (J).
    pub(super) kinetic: f64,
    /// Whether φ falls.
    pub(super) is_backwards: bool,
}

/// Work by which process loads drive the machine, and the cure; `None` if they do not.
pub(super) fn driven(turns: &Turns) -> Option<String> {
    let [motor, process, losses] = turns.works;
    let turned_over = motor.abs().max(losses.abs());
    if process <= (DRIVING_SHARE * turned_over).max(ROUNDING * turns.kinetic) {
        return None;
    }
    let why = if turns.is_backwards {
        "φ falls, and loads keep the sign of the file: reverse the sign of the motor torque, or that of the load if it should resist in this direction"
    } else {
        "if they should resist, reverse their sign"
    };
    Some(format!(
        "drive the machine with {} J per turn; {why}",
        short(process)
    ))
}
