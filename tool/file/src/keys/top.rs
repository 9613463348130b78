//! The top of a machine file.

use super::{drive, inner, loads, mechanism, motion, simulation, site};
use crate::text::key::{ValueForm, KeyTable, key, may, pair, quantity};
use crate::units::kind::{ACCELERATION, ANGLE};

const GRAVITY: &[ValueForm] = &[
    pair(&ACCELERATION),
    inner!(&[
        key("inclination", quantity(&ANGLE), "the angle by which x rises"),
        may("acceleration", quantity(&ACCELERATION).not_negative(), "").or("9.81 m/s^2"),
    ]),
];

pub(super) static DOCUMENT: KeyTable = KeyTable::of("document", &[&[
    may("project", ValueForm::Text, "project or order").such_as("\"Line 7\""),
    may("customer", ValueForm::Text, "").such_as("\"Cardboard Ltd\""),
    may("author", ValueForm::Text, "").such_as("\"A. Miller\""),
    may("revision", ValueForm::Text, "").such_as("\"B\""),
    may("date", ValueForm::Text, "(the day of the run)").such_as("\"2026-11-27\""),
]]);

/// All keys of a machine file.
pub static MACHINE: KeyTable = KeyTable::of("machine", &[&[
    may("title", ValueForm::Text, "title of reports (name of the file)").such_as("\"Axis 1\""),
    key("gravity", ValueForm::Any(GRAVITY), "x and y; or [`{ inclination = \"30 deg\" }`](axes.md), the angle by which x rises (90 deg: upwards)")
        .such_as("[\"9.81 m/s^2\", \"0 m/s^2\"], its x and y components; gravity = [\"0 m/s^2\", \"0 m/s^2\"] for a machine that moves in a horizontal plane"),
    key("mechanism", ValueForm::Table(&mechanism::MECHANISM), "the [moving links](#mechanism)"),
], loads::LISTS, &[
    may("drive_train", ValueForm::Tables(&drive::DRIVE_TRAIN, [0, usize::MAX], ""), "[fixed stages](#drive_train) between motor and drive link, at most 8"),
    may("variator", ValueForm::Table(&drive::VARIATOR), "a [friction variator](#variator) before the drive train"),
    may("motion", ValueForm::Table(&motion::MOTION), "the [motion](#motion) of the drive link or the tool"),
    may("simulation", ValueForm::Table(&simulation::SIMULATION), "the motor of a [free motion](#simulation)"),
    may("stiffness", ValueForm::Table(&drive::STIFFNESS), "[stiffness and play](#stiffness) between gearbox and machine"),
    may("tool", ValueForm::Table(&site::TOOL), "[where play matters](#tool)"),
    may("supply", ValueForm::Table(&site::SUPPLY), "the [DC bus](#supply)"),
    may("surroundings", ValueForm::Table(&site::SURROUNDINGS), "[temperatures and altitude](#surroundings)"),
    may("duty", ValueForm::Table(&site::DUTY), "[how the motion is run](#duty)"),
    may("rules", ValueForm::Table(&site::RULES), "[limits](#rules) of the sizing rules"),
    may("document", ValueForm::Table(&DOCUMENT), "[title block](#document) of reports"),
    may("tolerance", site::TOLERANCE, "[scatter](#tolerance) of quantities, by their paths"),
]]);
