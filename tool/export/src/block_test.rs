//! A block that tests the tick in the PLC itself, against the library.

use jred::Phase;

use crate::export::Export;
use crate::function_block::{DINT, TEST};
use crate::name::Name;
use crate::structured_text::{Block, Kind, Use, number, numbers, real, variable};
use crate::wide_table::Wide;

/// Rows of the test.
const ROWS: u32 = 24;

/// Largest difference that it accepts, as a share of the largest value: roundings of the PLC's own arithmetic.
const SHARE: f64 = 1e-12;

impl Export {
    /// A block that compares the first with torques computed here by the library, and its accelerations, as torques, with those that
    /// gave them.
    pub(crate) fn test_block(&self, wide: &Wide, Name(name): &Name) -> Option<Block> {
        let [drive, required, _] = self.effort();
        let model = wide.model()?;
        let mut rows = Vec::new();
        let mut torques = 0.0f64;
        for k in 0..ROWS {
            // Spread over the range, with speeds and accelerations of both signs.
            let phase = Phase::from_bits(k.wrapping_mul(2_654_435_769).wrapping_add(1 << 20));
            let share = |step: u32| f64::from((k * step) % ROWS) / f64::from(ROWS) * 2.0 - 1.0;
            let (omega, alpha) = (self.task.omega * share(5), self.task.alpha * share(7));
            let position = self
                .domain
                .position(f64::from(phase.to_bits()) / 4_294_967_296.0);
            let torque = model.torque(phase, omega, alpha);
            torques = torques.max(torque.abs());
            rows.extend([position, omega, alpha, torque]);
        }
        let about = format!(
            "Call it once in the PLC: Passed becomes TRUE if {name} gives the {} values that jred computed.",
            2 * ROWS
        );
        let outputs = vec![
            variable("Passed", "every value is right").of(Kind::Elementary("BOOL")),
            variable(
                "Worst",
                "largest difference, as a share of the largest torque or force",
            ),
        ];
        let locals = vec![
            variable("Tick", "the block under test").of(Kind::Block(name.clone())),
            variable("K", "row").of(DINT),
        ];
        let what = "position, speed, acceleration and torque or force of each row, in SI units";
        let constants = vec![
            number("LARGEST_EFFORT", torques, "of the rows"),
            numbers("ROWS", &rows, what),
        ];
        let body = format!(
            "Worst := 0.0;\n\
             Passed := TRUE;\n\
             FOR K := 0 TO {} BY 4 DO\n\
             \x20   Tick(Position := ROWS[K], Speed := ROWS[K + 1], Acceleration := ROWS[K + 2], {drive} := ROWS[K + 3], Unit := 1.0);\n\
             \x20   Worst := MAX(Worst, ABS(Tick.{required} - ROWS[K + 3]) / LARGEST_EFFORT);\n\
             \x20   Worst := MAX(Worst, ABS(Tick.ResultingAcceleration - ROWS[K + 2]) * Tick.Inertia / LARGEST_EFFORT);\n\
             \x20   IF Tick.Status <> 0 THEN\n\
             \x20       Passed := FALSE;\n\
             \x20   END_IF;\n\
             END_FOR;\n\
             IF NOT (Worst < {}) THEN\n\
             \x20   Passed := FALSE;\n\
             END_IF;\n",
            4 * (ROWS - 1),
            real(SHARE)
        );
        Some(Block {
            name: [name, TEST].concat(),
            about,
            lists: vec![
                (Use::Output, outputs),
                (Use::Local, locals),
                (Use::Constant, constants),
            ],
            body,
        })
    }
}
