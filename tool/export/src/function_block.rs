//! The tick as a function block of Structured Text, in double precision.

use std::fmt::Write as _;

use jred::table::Shape;
use jred::{Domain, curves};

use crate::export::Export;
use crate::name::{Name, PlcNames};
use crate::structured_text::{Block, Initial, Kind, List, Use, Variable, real};
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
        let [base, inertia, slope] = self
            .coordinate
            .pick(["rad", "[kg m^2]", "[kg m^2/rad]"], ["m", "[kg]", "[kg/m]"]);
        let input = Variable::new;
        let inputs = vec![
            input("Position", "of the drive link, in units of Unit"),
            input("Speed", "per second"),
            input(
                "Acceleration",
                "per second squared: asks for the torque or force",
            ),
            input(
                drive,
                &format!("at the drive link {unit}: asks for the acceleration"),
            ),
            Variable::number(
                "Unit",
                1.0,
                &format!(
                    "{base} in one unit of Position, Speed and accelerations; {}",
                    self.coordinate
                        .pick("0.017453292519943295 for degrees", "0.001 for mm")
                ),
            ),
        ];
        let status = "0 valid; sum of 1: position beyond the stroke, its end is used; 2: speed, 4: acceleration beyond the range of the table; \
                      8: an input is no number or far too large, all outputs are 0";
        let outputs = vec![
            input(required, &format!("for Speed and Acceleration {unit}")),
            input(
                "ResultingAcceleration",
                &format!("of Speed and {drive}, in units of Unit per second squared"),
            ),
            input("Inertia", &format!("reduced, here {inertia}")),
            input(
                "InertiaSlope",
                &format!("its derivative by the position {slope}"),
            ),
            input("Status", status).of(UINT),
        ];
        let locals = ["Place", "Omega", "Alpha", "U"].into_iter();
        let locals = locals.chain(["D0", "D1", "D2", "P0", "P1", "P2", "P3"]);
        let locals = locals.chain(["CellSlope", "Damping", "Resisting", "Curve"]);
        let locals = locals.map(|name| input(name, "intermediate value"));
        let cell = std::iter::once(input("Cell", "index of the cell").of(DINT));
        let lists = [
            (Use::Input, inputs),
            (Use::Output, outputs),
            (Use::Local, cell.chain(locals).collect()),
            (Use::Constant, self.constants(wide)),
        ];
        Block {
            name: name.clone(),
            about: about.lines().map(str::to_owned).collect(),
            lists: lists.map(|(of, variables)| List { of, variables }).into(),
            body: self.statements(wide),
        }
    }

    /// The table, and the limits of the inputs.
    fn constants(&self, wide: &Wide) -> Vec<Variable> {
        let Shape {
            cells, constants, ..
        } = wide.shape;
        let span = self.domain.span();
        let per_position = f64::from(cells) / span;
        let count = Variable {
            initial: Initial::One(cells.to_string()),
            ..Variable::new("CELLS", "of the table")
        };
        let mut all = vec![
            count.of(DINT),
            Variable::number("START", self.domain.position(0.0), "of the range"),
            Variable::number("SPAN", span, "length of the range"),
            Variable::number("PER_POSITION", per_position, "cells per position"),
            Variable::number("HALF", 0.5 * f64::from(cells) / span, "half of it"),
            Variable::number("MAX_SPEED", self.task.omega, "of the table"),
            Variable::number("MAX_ACCELERATION", self.task.alpha, "of the table"),
            Variable::number("OFFSET", constants.inertia, "added to the inertia"),
        ];
        if wide.has(curves::CONSTANT_VISCOUS) {
            all.push(Variable::number(
                "VISCOUS",
                constants.viscous,
                "friction by speed",
            ));
        }
        if wide.has(curves::CONSTANT_COULOMB) {
            all.push(Variable::number(
                "COULOMB",
                constants.coulomb,
                "friction by direction",
            ));
        }
        let points = "control points of a cubic B-spline, in sixths:";
        let curve = |name, curve, what| {
            Variable::numbers(name, &wide.points(curve), &format!("{points} {what}"))
        };
        all.push(curve("INERTIAS", curves::INERTIA, "reduced inertia"));
        for (bit, name, what) in [
            (curves::LOAD, "LOADS", "load, in the direction of motion"),
            (curves::VISCOUS, "VISCOUSES", "friction by speed"),
            (curves::COULOMB, "COULOMBS", "friction by direction"),
        ] {
            if wide.has(bit) {
                all.push(curve(name, bit, what));
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
