//! `[[drive_train]]`, `[variator]` and `[stiffness]`.

use jred::machine::MAX_STAGES;

use super::inner;
use crate::text::key::{ValueForm, KEEP_ONE, Key, ValueRange, KeyTable, key, may, quantity};
use crate::units::kind::{ANGLE, INERTIA, LENGTH, MASS, SHARE, STIFFNESS as LINEAR, TIME, TORQUE, TORSION_STIFFNESS, VISCOUS_MOMENT};

/// The cure of too many stages.
pub(super) const COMBINE: &str = "combine stages: multiply their ratios and refer their inertias to one shaft";
pub(super) const A_PAIR: &str = " with driver = { teeth = 18, inertia = \"2 kg cm^2\" } and driven = { … }";

/// The direction of the power through a friction contact.
pub(super) const FLOW: ValueForm = ValueForm::Words(&["input-drives", "output-drives"]);

const INERTIA_OF_WHEEL: Key = key("inertia", quantity(&INERTIA).not_negative(), "of the wheel with its share of the shaft");

const GEAR: ValueForm = inner!(&[key("teeth", ValueForm::Count([1, 100_000]), "number of teeth").such_as("18"), INERTIA_OF_WHEEL]);
const PULLEY: ValueForm = ValueForm::Table(&KeyTable::of("", &[&[key("radius", quantity(&LENGTH).positive(), "effective radius: half the pitch diameter"), INERTIA_OF_WHEEL.meaning("of the pulley with its shaft")]])
    .elsewhere(&[("diameter", "a pulley is given by its radius: give half the pitch diameter, radius = \"40 mm\"")]));

const EFFICIENCY: Key = may("efficiency", quantity(&SHARE).limited(ValueRange::UpTo(1.0)), "in both directions of power").or("100 %");

const PAIR: &[Key] = &[
    key("driver", GEAR, "").such_as("{ teeth = 18, inertia = \"2 kg cm^2\" }"),
    key("driven", GEAR, "").such_as("{ teeth = 18, inertia = \"2 kg cm^2\" }"),
    may("mesh", ValueForm::Words(&["external", "internal"]), "external gears reverse").or("external"),
];

/// A gear pair of the mechanism, and one of the drive train.
pub(crate) static GEAR_PAIR: KeyTable = KeyTable::of("gear-pair", &[PAIR]).elsewhere(&[("efficiency", "efficiency belongs to [[drive_train]]")]);
static LOSSY_PAIR: KeyTable = KeyTable::of("", &[PAIR, &[EFFICIENCY]]);

pub(super) const BELT_KEYS: &[Key] = &[
    key("driver", PULLEY, "").such_as("{ radius = \"40 mm\", inertia = \"6 kg cm^2\" }"),
    key("driven", PULLEY, "").such_as("{ radius = \"40 mm\", inertia = \"6 kg cm^2\" }"),
    may("belt_mass", quantity(&MASS).not_negative(), "of the whole belt").or("0"),
];

const BELT: &[&str] = &["belt"];
const GEARS: &[&str] = &["gear-train"];
const FRICTION: &[&str] = &["friction"];
const SCREW: &[&str] = &["ball-screw"];
const RACK: &[&str] = &["rack"];
const LINEAR_STAGE: &[&str] = &["ball-screw", "rack"];

/// The stages that turn a shaft.
const TURNING: &[Key] = &[
    BELT_KEYS[0].only(BELT),
    BELT_KEYS[1].only(BELT),
    BELT_KEYS[2].only(BELT),
    key("stage", ValueForm::Tables(&LOSSY_PAIR, [1, MAX_STAGES], COMBINE), "as for the mechanism [gear train](mechanisms/gear-train.md), each with its `efficiency`").such_as(A_PAIR).only(GEARS),
    key("ratio", ValueForm::Number([-1e3, 1e3]), "output speed over input speed without slip, ±0.001 to ±1000; negative reverses").such_as("0.5, the output speed over the input speed without slip").only(FRICTION),
    may("slip", quantity(&SHARE).not_negative(), "ε, share of speed and power that is lost, < 100 %").or("0").only(FRICTION),
    key("input_inertia", quantity(&INERTIA).not_negative(), "of the two shafts").only(FRICTION),
    key("output_inertia", quantity(&INERTIA).not_negative(), "of the two shafts").only(FRICTION),
];

static BRANCH: KeyTable = KeyTable::of("branch", &[&[
    may("name", ValueForm::Text, "in messages (its number)").such_as("\"coolant pump\""),
    may("at", ValueForm::Words(&["driven", "driver"]), "the shaft behind the stage (of a gear train the last one), or before it").or("driven"),
    key("type", ValueForm::Words(&["gear-train", "belt", "friction"]), "the branch's stage, with its keys").such_as("\"belt\""),
], TURNING, &[
    EFFICIENCY.only(BELT),
    may("inertia", quantity(&INERTIA).not_negative(), "at its end").or("0"),
    may("opposing_moment", quantity(&TORQUE).not_negative(), "friction there, constant").or("0"),
    may("viscous_moment", quantity(&VISCOUS_MOMENT).not_negative(), "friction there, in proportion to the speed").or("0"),
]]).by("type");

pub(crate) static DRIVE_TRAIN: KeyTable = KeyTable::of("drive_train", &[&[
    key("type", ValueForm::Words(&["gear-train", "belt", "friction", "ball-screw", "rack"]), "").such_as("\"belt\""),
], TURNING, &[
    key("lead", quantity(&LENGTH).positive(), "travel of the nut a turn").only(SCREW),
    may("hand", ValueForm::Words(&["right", "left"]), "left-hand reverses").or("right").only(SCREW),
    key("radius", quantity(&LENGTH).positive(), "pitch radius of the pinion").only(RACK),
    key("inertia", quantity(&INERTIA).not_negative(), "of the screw, or of the pinion").only(LINEAR_STAGE),
    may("mass", quantity(&MASS).not_negative(), "of the nut, or of the rack").or("0").only(LINEAR_STAGE),
    EFFICIENCY.only(&["belt", "ball-screw", "rack"]),
    may("sense", ValueForm::Words(&["as-built", "forward"]), "forward: the output counts as turning with the input, whatever the sign of the ratio").or("as-built"),
    may("branch", ValueForm::Tables(&BRANCH, [0, 8], "combine branches: refer their inertias and torques to one shaft"), "8 in all: shafts [beside the chain](#branch)"),
]]).by("type").elsewhere(&[("efficiency", "in a gear train each stage has its own efficiency")]);

const RATIO: ValueForm = ValueForm::Number(crate::model::variator::RATIOS);

const CURVE: &str = "keep the curve, whose last point is where the contact begins to slide, or slip and torque of that point alone";

const CREEP: ValueForm = ValueForm::Table(&KeyTable::of("", &[&[
    may("slip", quantity(&SHARE).positive(), "instead of `slip` of the variator: slip at which the contact slides, < 100 %"),
    may("torque", quantity(&TORQUE).positive(), "contact torque on the output shaft at which it slides"),
    may("curve", ValueForm::List(&ValueForm::Tuple(&[quantity(&SHARE), quantity(&TORQUE)]), [3, 1000]), "instead of the two: `[slip, torque]`, both rising"),
]]).either(&[(&["curve", "slip"], CURVE), (&["curve", "torque"], CURVE)]));

static SHIFT: KeyTable = KeyTable::of("shift", &[&[
    key("at", quantity(&TIME).not_negative(), "not before the end of the last"),
    key("duration", quantity(&TIME).positive(), ""),
    key("ratio", RATIO, "i at its end").such_as("0.5, the output speed over the input speed"),
    may("law", ValueForm::Words(&["polynomial-345", "cycloidal", "modified-sine"]), "").or("polynomial-345"),
]]);

pub(crate) static VARIATOR: KeyTable = KeyTable::of("variator", &[&[
    key("ratio", ValueForm::Any(&[RATIO, ValueForm::List(&ValueForm::Tuple(&[quantity(&TIME), RATIO]), [5, 1000]), ValueForm::Text]), "i, output over input speed: at the start, or as list or formula its whole course").such_as("0.5, the output speed over the input speed"),
    key("input_inertia", quantity(&INERTIA).positive(), "of the input shaft, without the motor's rotor"),
    key("output_inertia", quantity(&INERTIA).not_negative(), "of the output shaft"),
    may("slip", quantity(&SHARE).not_negative(), "ε < 100 %: constant, loses power"),
    may("power_flow", FLOW, "required with `slip`"),
    may("creep", CREEP, ""),
    may("shift", ValueForm::Tables(&SHIFT, [0, 1000], "give the whole course of the ratio as a formula"), "changes of the ratio, one after another"),
]]).either(&[(&["slip", "creep"], KEEP_ONE)]);

pub(crate) static STIFFNESS: KeyTable = KeyTable::of("stiffness", &[&[
    may("shaft", ValueForm::Quantity([&TORSION_STIFFNESS, &LINEAR], ValueRange::Positive), "of shafts and couplings in series (rigid); `\"80 N/um\"` at a sliding drive link"),
    may("backlash", ValueForm::Quantity([&ANGLE, &LENGTH], ValueRange::NotNegative), "total play of the drive train, flank to flank; a length at a sliding drive link").or("0"),
    may("at", ValueForm::Words(&["input", "drive-link"]), "place of both; input of the drive train").or("input"),
]]);
