//! The keys of a project file.

use super::{site, top};
use crate::text::key::{ValueForm, KeyTable, key, may, quantity};
use crate::units::kind::TIME;

/// Most axes of a project.
const MOST: usize = 64;

static AXIS: KeyTable = KeyTable::of("axis", &[&[
    key("machine", ValueForm::Text, "its machine file, relative to the project file").such_as("\"press.toml\""),
    may("name", ValueForm::Text, "in reports (name of the machine file)").such_as("\"feed\""),
    may("quantity", ValueForm::Count([1, MOST as u32]), "number of equal axes").or("1"),
    may("phase", quantity(&TIME).not_negative(), "delay of its cycle; of all axes or of none (the worst phases are searched)"),
    may("drive", ValueForm::Text, "MOTOR+GEARBOX, optionally followed by \" on AMPLIFIER\" (the best one)").such_as("\"motor-a+gearbox-b\""),
]]);

/// All keys of a project file.
pub static PROJECT: KeyTable = KeyTable::of("project", &[&[
    may("title", ValueForm::Text, "title of the document (name of the file)").such_as("\"Packing machine\""),
    may("bus", ValueForm::Words(&["common", "separate"]), "one DC bus and brake resistor for all amplifiers, or one for each").or("common"),
    may("document", ValueForm::Table(&top::DOCUMENT), "[title block](machine-file.md#document)"),
    may("supply", ValueForm::Table(&site::SUPPLY), "the [supply](machine-file.md#supply) of all axes"),
    may("surroundings", ValueForm::Table(&site::SURROUNDINGS), "[surroundings](machine-file.md#surroundings) of the axes whose files have none"),
    key("axis", ValueForm::Tables(&AXIS, [1, MOST], "split the project: axes of different supplies do not influence each other"), "the axes").such_as(" with machine = \"press.toml\""),
]]);
