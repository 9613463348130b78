//! The tick as a function block of Structured Text, in double precision.

use std::fmt::Write as _;

use jred::{Domain, curves};

use crate::export::Export;
use crate::name::{Name, PlcNames};
use crate::structured_text::{
    Block, Initial, Kind, Use, Variable, number, numbers, real, variable,
};
use crate::wide_table::Wide;

/// Names of the blocks: 32 characters are the limit of the strictest PLCs, and the second block has a suffix.
pub const BLOCK_NAMES: PlcNames = PlcNames {
    longest: 32 - TEST.len(),
    taken: "position speed acceleration drivetorque driveforce unit requiredtorque requiredforce resultingacceleration inertia inertiaslope
        status cell place omega alpha u d0 d1 d2 p0 p1 p2 p3 cellslope damping resisting curve cells start span per_position half
        max_speed max_acceleration offset viscous coulomb inertias loads viscouses coulombs passed worst tick k largest_effort rows",
};

/// Suffix of the block that tests.
pub(crate) const TEST: &str = "_Test";

/// Share by which an input may exceed its limit without a status: rounding.
const ROUNDING: f64 = 1e-9;

/// Elementary types.
pub(crate) const DINT: Kind = Kind::Elementary("DINT");
const UINT: Kind = Kind::Elementary("UINT");

/// Statements that read a curve into `into`; `last` are those that use the coefficients P0 to P3.
fn read(points: &str, offset: &str, last: &str) -> String {
    format!(
        "D0 := {points}[Cell + 1] - {points}[Cell];\n\
         D1 := {points}[Cell + 2] - {points}[Cell + 1];\n\
         D2 := {points}[Cell + 3] - {points}[Cell + 2];\n\
         P0 := 6.0 * {points}[Cell + 1] + (D1 - D0){offset};\n\
         P1 := 3.0 * (D0 + D1);\n\
         P2 := 3.0 * (D1 - D0);\n\
         P3 := (D2 - D1) - (D1 - D0);\n\
         {last}"
    )
}

/// The value of a curve.
fn value(points: &str, into: &str) -> String {
    let last = format!("{into} := P0 + U * (P1 + U * (P2 + U * P3));\n");
    read(points, "", &last)
}

impl Export {
    /// Names of the inputs: torques, or forces of a sliding link.
    pub(crate) const fn effort(&self) -> [&'static str; 3] {
        self.coordinate.pick(
            ["DriveTorque", "RequiredTorque", "[N m]"],
            ["DriveForce", "RequiredForce", "[N]"],
        )
    }

    /// The block with both directions of the tick.
    pub(crate) fn tick_block(&self, wide: &Wide, Name(name): &Name, about: &str) -> Block {
        let [drive, required, unit] = self.effort();
        let [base, inertia, slope, one] = self.coordinate.pick(
            [
                "rad",
                "[kg m^2]",
                "[kg m^2/rad]",
                "0.017453292519943295 for degrees",
            ],
            ["m", "[kg]", "[kg/m]", "0.001 for mm"],
        );
        let one = format!("{base} in one unit of Position, Speed and accelerations; {one}");
        let inputs = vec![
            variable("Position", "of the drive link, in units of Unit"),
            variable("Speed", "per second"),
            variable(
                "Acceleration",
                "per second squared: asks for the torque or force",
            ),
            variable(
                drive,
                format!("at the drive link {unit}: asks for the acceleration"),
            ),
            number("Unit", 1.0, one),
        ];
        let resulting = format!("of Speed and {drive}, in units of Unit per second squared");
        let status = "0 valid; sum of 1: position beyond the stroke, its end is used; 2: speed, 4: acceleration beyond the range of the table; \
                      8: an input is no number or far too large, all outputs are 0";
        let outputs = vec![
            variable(required, format!("for Speed and Acceleration {unit}")),
            variable("ResultingAcceleration", resulting),
            variable("Inertia", format!("reduced, here {inertia}")),
            variable(
                "InertiaSlope",
                format!("its derivative by the position {slope}"),
            ),
            variable("Status", status).of(UINT),
        ];
        let names = "Place Omega Alpha U D0 D1 D2 P0 P1 P2 P3 CellSlope Damping Resisting Curve";
        let locals = names
            .split(' ')
            .map(|name| variable(name, "intermediate value"));
        let cell = variable("Cell", "index of the cell").of(DINT);
        Block {
            name: name.clone(),
            about: about.trim_end().to_owned(),
            lists: vec![
                (Use::Input, inputs),
                (Use::Output, outputs),
                (Use::Local, std::iter::once(cell).chain(locals).collect()),
                (Use::Constant, self.constants(wide)),
            ],
            body: self.statements(wide),
        }
    }

    /// The table, and the limits of the inputs.
    fn constants(&self, wide: &Wide) -> Vec<Variable> {
        let (constants, span) = (&wide.shape.constants, self.domain.span());
        let cells = f64::from(wide.shape.cells);
        let count = Variable {
            initial: Initial::One(wide.shape.cells.to_string()),
            ..variable("CELLS", "of the table").of(DINT)
        };
        let mut all = vec![
            count,
            number("START", self.domain.position(0.0), "of the range"),
            number("SPAN", span, "length of the range"),
            number("PER_POSITION", cells / span, "cells per position"),
            number("HALF", 0.5 * cells / span, "half of it"),
            number("MAX_SPEED", self.task.omega, "of the table"),
            number("MAX_ACCELERATION", self.task.alpha, "of the table"),
            number("OFFSET", constants.inertia, "added to the inertia"),
        ];
        if wide.has(curves::CONSTANT_VISCOUS) {
            all.push(number("VISCOUS", constants.viscous, "friction by speed"));
        }
        if wide.has(curves::CONSTANT_COULOMB) {
            all.push(number(
                "COULOMB",
                constants.coulomb,
                "friction by direction",
            ));
        }
        for (curve, name, what) in [
            (curves::INERTIA, "INERTIAS", "reduced inertia"),
            (curves::LOAD, "LOADS", "load, in the direction of motion"),
            (curves::VISCOUS, "VISCOUSES", "friction by speed"),
            (curves::COULOMB, "COULOMBS", "friction by direction"),
        ] {
            if wide.has(curve) {
                let what = format!("control points of a cubic B-spline, in sixths: {what}");
                all.push(numbers(name, &wide.points(curve), what));
            }
        }
        all
    }

    /// Statements that bring the place into the range, 0 to 1.
    fn wrapped(&self) -> String {
        match self.domain {
            Domain::Turn => "Place := Place - DINT_TO_LREAL(TRUNC(Place));\n\
                             IF Place < 0.0 THEN\n\
                             \x20   Place := Place + 1.0;\n\
                             END_IF;\n"
                .to_owned(),
            Domain::Stroke { .. } => {
                let slack = real(ROUNDING);
                let beyond = real(1.0 + ROUNDING);
                format!(
                    "IF Place < -{slack} OR Place > {beyond} THEN\n\
                     \x20   Status := Status + 1;\n\
                     END_IF;\n\
                     Place := MIN(MAX(Place, 0.0), 1.0);\n"
                )
            }
        }
    }

    fn statements(&self, wide: &Wide) -> String {
        let [drive, required, _] = self.effort();
        let mut text = format!(
            "Status := 0;\n\
             Place := (Position * Unit - START) / SPAN;\n\
             Omega := Speed * Unit;\n\
             Alpha := Acceleration * Unit;\n\
             IF NOT (Unit > 1.0E-9 AND Unit < 1.0E9 AND ABS(Place) < 1.0E9 AND ABS(Omega) < 1.0E30\n\
             \x20   AND ABS(Alpha) < 1.0E30 AND ABS({drive}) < 1.0E30) THEN\n\
             \x20   Status := 8;\n\
             \x20   {required} := 0.0;\n\
             \x20   ResultingAcceleration := 0.0;\n\
             \x20   Inertia := 0.0;\n\
             \x20   InertiaSlope := 0.0;\n\
             \x20   RETURN;\n\
             END_IF;\n"
        );
        text += &self.wrapped();
        for (number, input, limit) in [(2, "Omega", "MAX_SPEED"), (4, "Alpha", "MAX_ACCELERATION")]
        {
            let _ = writeln!(
                text,
                "IF ABS({input}) > {limit} * {} THEN\n    Status := Status + {number};\nEND_IF;",
                real(1.0 + ROUNDING)
            );
        }
        text += "Place := Place * DINT_TO_LREAL(CELLS);\n\
                 Cell := MIN(TRUNC(Place), CELLS - 1);\n\
                 U := Place - DINT_TO_LREAL(Cell);\n";
        // Value and slope share their products.
        text += &read(
            "INERTIAS",
            " + OFFSET",
            "D0 := P2 + U * P3;\n\
             D1 := P1 + U * D0;\n\
             Inertia := P0 + U * D1;\n\
             CellSlope := D1 + U * (D0 + U * P3);\n\
             InertiaSlope := CellSlope * PER_POSITION;\n",
        );
        text += &if wide.has(curves::VISCOUS) {
            value("VISCOUSES", "Damping")
        } else if wide.has(curves::CONSTANT_VISCOUS) {
            "Damping := VISCOUS;\n".to_owned()
        } else {
            "Damping := 0.0;\n".to_owned()
        };
        text += "Resisting := (CellSlope * HALF * Omega + Damping) * Omega;\n";
        if wide.has(curves::LOAD) {
            text += &value("LOADS", "Curve");
            text += "Resisting := Resisting - Curve;\n";
        }
        if wide.has(curves::COULOMB | curves::CONSTANT_COULOMB) {
            text += &if wide.has(curves::COULOMB) {
                value("COULOMBS", "Curve")
            } else {
                "Curve := COULOMB;\n".to_owned()
            };
            text += "IF Omega > 0.0 THEN\n    Resisting := Resisting + ABS(Curve);\n\
                     ELSIF Omega < 0.0 THEN\n    Resisting := Resisting - ABS(Curve);\nEND_IF;\n";
        }
        text + &format!(
            "{required} := Inertia * Alpha + Resisting;\n\
             ResultingAcceleration := ({drive} - Resisting) / Inertia / Unit;\n"
        )
    }
}
