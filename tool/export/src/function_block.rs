//! The tick as a function block of Structured Text, in double precision, over the words of a spline table; and a block that tests it in the PLC.

use jred::table::{Constants, Shape, Table};
use jred::{AnyModel, CurveSet, Domain, Image, Phase, Spline, curves};

use crate::choice::{LayoutName, Number};
use crate::export::Export;
use crate::name::{Name, PlcNames};
use crate::plcopen;
use crate::structured_text::{Block, Initial, Kind, List, Use, Variable, real};

/// Names of the blocks: 32 characters are the limit of the strictest PLCs, and the second block has a suffix.
pub const BLOCK_NAMES: PlcNames = PlcNames {
    longest: 32 - TEST.len(),
    taken: &[
        "Position",
        "Speed",
        "Acceleration",
        "DriveTorque",
        "DriveForce",
        "Unit",
        "RequiredTorque",
        "RequiredForce",
        "ResultingAcceleration",
        "Inertia",
        "InertiaSlope",
        "Status",
        "Cell",
        "Place",
        "Omega",
        "Alpha",
        "U",
        "D0",
        "D1",
        "D2",
        "P0",
        "P1",
        "P2",
        "P3",
        "CellSlope",
        "Damping",
        "Resisting",
        "Curve",
        "Cells",
        "Start",
        "Span",
        "Per_Position",
        "Half",
        "Max_Speed",
        "Max_Acceleration",
        "Offset",
        "Viscous",
        "Coulomb",
        "Inertias",
        "Loads",
        "Viscouses",
        "Coulombs",
        "Passed",
        "Worst",
        "Tick",
        "K",
        "Largest_Effort",
        "Largest_Acceleration",
        "Rows",
    ],
};

/// Suffix of the block that tests.
const TEST: &str = "_Test";

/// Rows of that test.
const ROWS: u32 = 24;

/// Largest difference that it accepts, as a share of the largest value: roundings of the PLC's own arithmetic.
const SHARE: f64 = 1e-12;

/// Share by which an input may exceed its limit without a status: rounding.
const ROUNDING: f64 = 1e-9;

/// A spline table in double precision: the same numbers as in the image.
struct Wide {
    words: Vec<f64>,
    shape: Shape<Spline<f64>>,
}

impl Wide {
    /// The table of an image of single precision.
    fn of(words: &[u32], domain: Domain) -> Option<Self> {
        let table = Image::new(words).ok()?.table::<Spline<f32>>().ok()?;
        let constants = table.constants();
        Some(Self {
            words: table.words().iter().map(|word| f64::from(*word)).collect(),
            shape: Shape {
                set: table.set(),
                cells: table.cells(),
                domain,
                scale: *table.scale(),
                constants: Constants {
                    inertia: constants.inertia.into(),
                    viscous: constants.viscous.into(),
                    coulomb: constants.coulomb.into(),
                    gains: constants.gains,
                },
            },
        })
    }

    fn has(&self, curve: CurveSet) -> bool {
        self.shape.set & curve != 0
    }

    /// The control points of a curve of the set: of J for [`curves::INERTIA`].
    fn points(&self, curve: CurveSet) -> Vec<f64> {
        let width = curves::width(self.shape.set);
        let column = match curve {
            curves::INERTIA => 0,
            curve => curves::width(self.shape.set & (curve - 1)),
        };
        let points = self.words.iter().skip(column).step_by(width);
        points.copied().collect()
    }

    fn model(&self) -> Option<AnyModel<'_, Spline<f64>>> {
        AnyModel::new(Table::new(&self.words, self.shape).ok()?).ok()
    }
}

/// A constant of type LREAL.
fn constant(name: &str, value: f64, comment: &str) -> Variable {
    variable(name, Initial::One(real(value)), comment)
}

fn variable(name: &str, initial: Initial, comment: &str) -> Variable {
    Variable {
        name: name.to_owned(),
        kind: Kind::Elementary("LREAL"),
        initial,
        comment: comment.to_owned(),
    }
}

fn numbers(name: &str, values: &[f64], comment: &str) -> Variable {
    let values = values.iter().map(|value| real(*value)).collect();
    variable(name, Initial::Array(values), comment)
}

fn other(kind: &'static str, variable: Variable) -> Variable {
    Variable {
        kind: Kind::Elementary(kind),
        ..variable
    }
}

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
    /// The tick as Structured Text: two blocks, the second tests the first. `about` are lines of its comment. `None` for several pieces, and for a
    /// table other than a spline in f32.
    pub fn structured_text(&self, name: &Name, about: &str) -> Option<String> {
        let texts = self.blocks(name, about)?;
        let texts: Vec<String> = texts.iter().map(Block::text).collect();
        Some(texts.join("\n"))
    }

    /// The same as PLCopen XML, made on a `day` such as 2026-11-28.
    pub fn plcopen(&self, name: &Name, about: &str, day: &str) -> Option<String> {
        Some(plcopen::project(
            &self.title,
            day,
            &self.blocks(name, about)?,
        ))
    }

    fn blocks(&self, name: &Name, about: &str) -> Option<[Block; 2]> {
        if self.kind() != (Number::F32, LayoutName::Spline) {
            return None;
        }
        let wide = Wide::of(&self.whole()?.words, self.domain)?;
        Some([self.tick(&wide, name, about), self.test(&wide, name)?])
    }

    /// What the inputs are called: torques, or forces of a sliding link.
    const fn effort(&self) -> [&'static str; 3] {
        self.coordinate.pick(
            ["DriveTorque", "RequiredTorque", "[N m]"],
            ["DriveForce", "RequiredForce", "[N]"],
        )
    }

    fn tick(&self, wide: &Wide, Name(name): &Name, about: &str) -> Block {
        let [drive, required, unit] = self.effort();
        let [base, inertia, slope] = self
            .coordinate
            .pick(["rad", "[kg m^2]", "[kg m^2/rad]"], ["m", "[kg]", "[kg/m]"]);
        let input = |name: &str, comment: &str| variable(name, Initial::Default, comment);
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
            constant(
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
            other("UINT", input("Status", status)),
        ];
        let locals = ["Place", "Omega", "Alpha", "U"].into_iter();
        let locals = locals.chain(["D0", "D1", "D2", "P0", "P1", "P2", "P3"]);
        let locals = locals.chain(["CellSlope", "Damping", "Resisting", "Curve"]);
        let locals = locals.map(|name| input(name, "intermediate value"));
        let cell = std::iter::once(other("DINT", input("Cell", "index of the cell")));
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
        let count = variable("CELLS", Initial::One(cells.to_string()), "of the table");
        let mut all = vec![
            other("DINT", count),
            constant("START", self.domain.position(0.0), "of the range"),
            constant("SPAN", span, "length of the range"),
            constant("PER_POSITION", per_position, "cells per position"),
            constant("HALF", 0.5 * f64::from(cells) / span, "half of it"),
            constant("MAX_SPEED", self.task.omega, "of the table"),
            constant("MAX_ACCELERATION", self.task.alpha, "of the table"),
            constant("OFFSET", constants.inertia, "added to the inertia"),
        ];
        if wide.has(curves::CONSTANT_VISCOUS) {
            all.push(constant("VISCOUS", constants.viscous, "friction by speed"));
        }
        if wide.has(curves::CONSTANT_COULOMB) {
            all.push(constant(
                "COULOMB",
                constants.coulomb,
                "friction by direction",
            ));
        }
        let points = "control points of a cubic B-spline, in sixths:";
        let curve =
            |name, curve, what| numbers(name, &wide.points(curve), &format!("{points} {what}"));
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
        text += &match self.domain {
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
        };
        for (number, input, limit) in [(2, "Omega", "MAX_SPEED"), (4, "Alpha", "MAX_ACCELERATION")]
        {
            text += &format!(
                "IF ABS({input}) > {limit} * {} THEN\n    Status := Status + {number};\nEND_IF;\n",
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

    /// A block that compares the first with torques computed here by the library, and its accelerations with those that gave the torques.
    fn test(&self, wide: &Wide, Name(name): &Name) -> Option<Block> {
        let [drive, required, _] = self.effort();
        let model = wide.model()?;
        let mut rows = Vec::new();
        let (mut torques, mut accelerations) = (0.0f64, 0.0f64);
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
            accelerations = accelerations.max(alpha.abs());
            rows.extend([position, omega, alpha, torque]);
        }
        let input = |name: &str, comment: &str| variable(name, Initial::Default, comment);
        let about = format!(
            "Call it once in the PLC: Passed becomes TRUE if {name} gives the {} values that jred computed.",
            2 * ROWS
        );
        let part = |of, variables| List { of, variables };
        let tick = Variable {
            kind: Kind::Block(name.clone()),
            ..input("Tick", "the block under test")
        };
        let worst = "largest difference, as a share of the largest value";
        let lists = vec![
            part(
                Use::Output,
                vec![
                    other("BOOL", input("Passed", "every value is right")),
                    input("Worst", worst),
                ],
            ),
            part(Use::Local, vec![tick, other("DINT", input("K", "row"))]),
            part(
                Use::Constant,
                vec![
                    constant("LARGEST_EFFORT", torques, "of the rows"),
                    constant("LARGEST_ACCELERATION", accelerations, "of the rows"),
                    numbers(
                        "ROWS",
                        &rows,
                        "position, speed, acceleration and torque or force of each row, in SI units",
                    ),
                ],
            ),
        ];
        let body = format!(
            "Worst := 0.0;\n\
             Passed := TRUE;\n\
             FOR K := 0 TO {} BY 4 DO\n\
             \x20   Tick(Position := ROWS[K], Speed := ROWS[K + 1], Acceleration := ROWS[K + 2], {drive} := ROWS[K + 3], Unit := 1.0);\n\
             \x20   Worst := MAX(Worst, ABS(Tick.{required} - ROWS[K + 3]) / LARGEST_EFFORT);\n\
             \x20   Worst := MAX(Worst, ABS(Tick.ResultingAcceleration - ROWS[K + 2]) / LARGEST_ACCELERATION);\n\
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
            about: vec![about],
            lists,
            body,
        })
    }
}
