//! The top of a machine file.

use super::{drive, inner, loads, mechanism, motion, simulation, site};
use crate::text::key::{Form, Table, key, may, pair, quantity};
use crate::units::kind::{ACCELERATION, ANGLE};

const GRAVITY: &[Form] = &[
    pair(&ACCELERATION),
    inner!(&[
        key("inclination", quantity(&ANGLE), "the angle by which x rises"),
        may("acceleration", quantity(&ACCELERATION).not_negative(), "").or("9.81 m/s^2"),
    ]),
];

/// All keys of a machine file.
pub static MACHINE: Table = Table::of("machine", &[&[
    may("title", Form::Text, "title of reports (name of the file)").such_as("\"Servo press\""),
    key("gravity", Form::Any(GRAVITY), "x and y; or [`{ inclination = \"30 deg\" }`](axes.md), the angle by which x rises")
        .such_as("[\"9.81 m/s^2\", \"0 m/s^2\"], its x and y components; gravity = [\"0 m/s^2\", \"0 m/s^2\"] for a machine that moves in a horizontal plane"),
    key("mechanism", Form::Table(&mechanism::MECHANISM), "the [moving links](#mechanism)"),
], loads::LISTS, &[
    may("drive_train", Form::Tables(&drive::DRIVE_TRAIN, [0, usize::MAX], ""), "[fixed stages](#drive_train) between motor and drive link, at most 8"),
    may("variator", Form::Table(&drive::VARIATOR), "a [friction variator](#variator) before the drive train"),
    may("motion", Form::Table(&motion::MOTION), "the [motion](#motion) of the drive link or the tool"),
    may("simulation", Form::Table(&simulation::SIMULATION), "the motor of a [free motion](#simulation)"),
    may("stiffness", Form::Table(&drive::STIFFNESS), "[stiffness and play](#stiffness) between gearbox and machine"),
    may("tool", Form::Table(&site::TOOL), "[where play matters](#tool)"),
    may("supply", Form::Table(&site::SUPPLY), "the [DC bus](#supply)"),
    may("surroundings", Form::Table(&site::SURROUNDINGS), "[temperatures and altitude](#surroundings)"),
    may("duty", Form::Table(&site::DUTY), "[how the motion is run](#duty)"),
    may("rules", Form::Table(&site::RULES), "[limits](#rules) of the sizing rules"),
    may("tolerance", site::TOLERANCE, "[scatter](#tolerance) of quantities, by their paths"),
]]);
