//! Loads, masses, springs and dampers.

use jred::machine::{MAX_ELEMENTS, MAX_FRICTIONS, MAX_LOADS, Window};

use super::inner;
use super::motion::LAYOUT;
use crate::text::key::{ValueForm, KEEP_ONE, Key, POSITION, KeyTable, key, may, of_axis, pair, quantity};
use crate::units::kind::{
    ANGLE, FORCE, INERTIA, LENGTH, MASS, STIFFNESS, TIME, TORQUE, TORSION_STIFFNESS, VISCOUS_FORCE, VISCOUS_MOMENT,
};

const LINK: ValueForm = ValueForm::Name("the link");
const AT_MOST: &str = "combine loads that act on the same link";

/// When a load acts.
const WHEN: &[Key] = &[
    may("segments", ValueForm::List(&ValueForm::Count([1, 1000]), [1, usize::MAX]), "numbers of the motion's segments in which it acts, from 1 (all)").such_as("[2, 3]"),
    may("during", pair(&TIME), "instead: from one time to another; in a cycle over its end if the second is smaller"),
    may("direction", ValueForm::Words(&["forward", "backward"]), "φ grows, or falls (both). At rest it does not act"),
];

const BETWEEN: Key = may("between", ValueForm::Pair(POSITION), "range of φ in which it acts, at most a turn (always)").such_as("[\"315 deg\", \"360 deg\"]: where the load acts");
const RAMP: Key = may("ramp", of_axis(POSITION).positive(), "at most half of `between`, over which it rises and falls by the 3-4-5 polynomial").such_as("\"10 deg\": the angle over which the load rises and falls");
const TURNS: Key = may("turns", ValueForm::Count([1, Window::MAX_TURNS]), "of the drive link, after which the load repeats").or("1").such_as("2");
const POINT: Key = may("at", pair(&LENGTH), "point of application `[u, v]` of a force").or("0");

/// The names of the keys below.
pub(crate) const ACTIONS: [&str; 6] = ["force", "moment", "opposing_force", "opposing_moment", "viscous_force", "viscous_moment"];

const TIMES: (&[&str], &str) = (&["segments", "during"], "give either the segments or the times");

/// The keys of the action of a load, exactly one of them.
const ACTION: &[Key] = &[
    may("force", pair(&FORCE), "action with fixed direction, x and y"),
    may("moment", quantity(&TORQUE), "action with fixed direction"),
    may("opposing_force", quantity(&FORCE).not_negative(), "action against the velocity, of constant size (dry friction, a process that resists)"),
    may("opposing_moment", quantity(&TORQUE).not_negative(), "action against the rotation, of constant size"),
    may("viscous_force", quantity(&VISCOUS_FORCE).not_negative(), "action c·v against the velocity"),
    may("viscous_moment", quantity(&VISCOUS_MOMENT).not_negative(), "action c·ψ̇ against the rotation"),
];

pub(crate) static LOAD: KeyTable = KeyTable::of("load", &[&[
    may("name", ValueForm::Text, "in reports (from action and link: \"opposing force on slider\")").such_as("\"pressing force\""),
    may("on", LINK, "it acts on; required unless the load is a table"),
], ACTION, &[POINT, BETWEEN, RAMP, TURNS], WHEN, &[
    may("at_rest", ValueForm::Any(&[pair(&FORCE), quantity(&FORCE), quantity(&TORQUE)]), "its value, as the action's, where the drive link rests (as in motion); not viscous"),
]]).variants("table", &[&LOAD_TABLE]).either(&[
    (&ACTIONS, "write a separate [[load]] for each"),
    TIMES,
]);

pub(crate) static LOAD_TABLE: KeyTable = KeyTable::of("load.table", &[&[
    key("table", ValueForm::File, "relative to the machine file").such_as("\"loads.csv\""),
    may("angle", quantity(&ANGLE), "direction of the column `Force`, counter-clockwise from +x"),
    may("angle_on_link", quantity(&ANGLE), "instead: direction of the column `Force` from the link's u axis"),
    may("over", inner!(&[
        key("point", ValueForm::Name("a point, or of a link"), "the rows run over its [position](#over) (the drive link's)").such_as(OVER),
        may("at", pair(&LENGTH), "a point `[u, v]` of the link").or("0"),
        key("along", ValueForm::Words(&["x", "y"]), "direction of the position").such_as("\"x\""),
        may("zero", quantity(&LENGTH), "position at which the rows count from zero").or("0"),
    ]), ""),
    may("outside", ValueForm::Words(&["error", "zero"]), "what acts beyond the rows").or("error"),
    may("curve", ValueForm::Words(&["smooth", "monotone"]), "of forces and moments").or("smooth"),
    LAYOUT[0].meaning("titles of the [columns](#csv) `position`, `payload`, `thrust`, `torque`, `force`, `force_x`, `force_y`, `moment`"),
    LAYOUT[1], LAYOUT[2], LAYOUT[3],
]]).either(&[
    (&["angle", "angle_on_link"], "write `angle` for a fixed direction, `angle_on_link` for one that turns with the link"),
]).elsewhere(&[
    ("at_rest", "write at_rest with a plain force or moment"),
    ("force", SEPARATE), ("moment", SEPARATE), ("opposing_force", SEPARATE), ("opposing_moment", SEPARATE), ("viscous_force", SEPARATE), ("viscous_moment", SEPARATE),
]);

const OVER: &str = "\"slider\", in over = { point = \"slider\", along = \"x\" }";
const SEPARATE: &str = "a table already says what acts; write this in a separate [[load]]";

const PART_OF_MOTION: &str = "what is there for a part of the motion is a [[payload]]";

const fn attached(on: &'static str, mass: &'static str, at: &'static str) -> [Key; 5] {
    [
        key("on", LINK, on),
        key("mass", quantity(&MASS).positive(), mass),
        may("name", ValueForm::Text, "in reports (\"mass on\" and the link)").such_as("\"workpiece\""),
        may("inertia", quantity(&INERTIA).not_negative(), "about its own centre of mass").or("0"),
        may("at", pair(&LENGTH), at).or("0"),
    ]
}

pub(crate) static MASSES: KeyTable = KeyTable::of("mass", &[&attached("it is fixed to", "not counted by a coefficient of guide friction", "its centre of mass `[u, v]` in the link's frame")])
    .elsewhere(&[("segments", PART_OF_MOTION), ("during", PART_OF_MOTION)]);

const PAYLOAD_KEYS: &[Key] = &[
    WHEN[0].meaning("numbers of the motion's segments in which it is carried, in one go; required without `during`"),
    WHEN[1],
    may("while_moving", ValueForm::Flag, "whether its place may move at pick-up and set-down").or("false"),
];

pub(crate) static PAYLOAD: KeyTable = KeyTable::of("payload", &[&attached("it is fixed to", "", "its centre of mass `[u, v]` in the link's frame"), PAYLOAD_KEYS])
    .either(&[TIMES])
    .elsewhere(&[("between", COLUMN), ("ramp", COLUMN), ("direction", "write segments = [2, 3] or during = [\"0.2 s\", \"0.5 s\"]: the time over which it is carried")]);

const COLUMN: &str = "a payload over a part of the turn is a column of a table of loads: docs/import.md";

pub(crate) static CARRIAGE: KeyTable = KeyTable::of("carriage", &[&attached("that carries the guide", "", "its centre of mass `[u, v]` at s = 0"), &[
    may("direction", quantity(&ANGLE), "of the guide, from u of the link's frame").or("0"),
    key("stroke", pair(&LENGTH), "rising: range of s along the guide").such_as("[\"0 mm\", \"1500 mm\"]"),
    key("motion", ValueForm::Table(&super::motion::OF_CARRIAGE), "s over the time of `[motion]`").such_as(" with type = \"cycle\" and its segments, as for [motion]"),
]]).elsewhere(&[
    ("segment", "segments belong to [carriage.motion]"),
    ("segments", "what is there for a part of the motion is a [[payload]]; a carriage stands where its motion has a dwell"),
    ("during", "what is there for a part of the motion is a [[payload]]; a carriage stands where its motion has a dwell"),
]);

static END: KeyTable = KeyTable::of("", &[&[
    key("on", ValueForm::Name("a body"), "").such_as("\"ground\""),
    may("at", pair(&LENGTH), "`[u, v]` of the link, or in global coordinates").or("0"),
]]);

const fn name(help: &'static str) -> Key {
    may("name", ValueForm::Text, help).such_as("\"counterbalance\"")
}

static AN_END: [ValueForm; 2] = [ValueForm::Name("a body or of a point"), ValueForm::Table(&END)];
static EITHER_END: ValueForm = ValueForm::Any(&AN_END);
const ENDS: Key = key("between", ValueForm::List(&EITHER_END, [2, 2]), "two ends on different bodies: the points that it connects")
    .such_as("[\"slider\", { on = \"ground\", at = [\"0 mm\", \"400 mm\"] }]");

pub(crate) static SPRING: KeyTable = KeyTable::of("spring", &[&[
    name("in reports (from its ends: \"spring from slider to ground\")"),
    ENDS,
    key("stiffness", ValueForm::Any(&[quantity(&STIFFNESS).positive(), quantity(&TORSION_STIFFNESS).positive()]), ""),
    may("free_length", quantity(&LENGTH).not_negative(), "without force: longer it pulls, shorter it pushes"),
    may("free_angle", quantity(&ANGLE), "instead, in torsion: angle of the second body against the first without moment"),
]]).either(&[(&["free_length", "free_angle"], KEEP_ONE)]);

pub(crate) static DAMPER: KeyTable = KeyTable::of("damper", &[&[
    name("in reports (from its ends: \"damper from slider to ground\")"),
    ENDS,
    may("viscous_force", quantity(&VISCOUS_FORCE).positive(), "d of the force d·l̇ along the line between its ends"),
    may("viscous_moment", quantity(&VISCOUS_MOMENT).positive(), "instead: d of the moment d·θ̇ between two bodies"),
]]).either(&[(&["viscous_force", "viscous_moment"], KEEP_ONE)]);

pub(crate) static FRICTION: KeyTable = KeyTable::of("friction", &[&[
    key("joint", ValueForm::Name("a guide, a slot or a pin"), "as `jred check` names it").such_as("\"guide\""),
    key("coefficient", ValueForm::Number([0.0, 2.0]), "μ: of a guide f = μ·max(\\|N\\|, 2·\\|M\\|/l), of a slot μ·\\|N\\|, of a pin M = μ·r·\\|F\\|").such_as("0.1"),
    may("pin_radius", quantity(&LENGTH).positive(), "r; required of a pin").such_as("\"15 mm\""),
    may("guide_length", quantity(&LENGTH).positive(), "l; required of a guide: distance of its outer bearings around the slider's point, which carry its moment"),
    may("preload", quantity(&FORCE).not_negative(), "a force that presses besides that of the joint").or("0"),
]]);

/// The lists of loads and masses.
pub(super) const LISTS: &[Key] = &[
    may("load", ValueForm::Tables(&LOAD, [0, usize::MAX], AT_MOST), "[forces and moments](#load) besides gravity, up to 16"),
    may("mass", ValueForm::Tables(&MASSES, [0, 16], "combine what is fixed to the same link"), "[masses](#mass) fixed to links, up to 16"),
    may("payload", ValueForm::Tables(&PAYLOAD, [0, 16], "combine what the same link carries at the same time"), "[masses](#payload) that a link picks up and sets down, up to 16"),
    may("carriage", ValueForm::Tables(&CARRIAGE, [0, 4], "combine what moves along the same guide"), "[masses](#carriage) that a second axis moves, up to 4"),
    may("friction", ValueForm::Tables(&FRICTION, [0, MAX_FRICTIONS], "give the joints with the largest forces"), "[friction in joints](#friction) by its coefficient, up to 16"),
    may("spring", ValueForm::Tables(&SPRING, [0, usize::MAX], ""), "[springs](#spring), with dampers up to 8"),
    may("damper", ValueForm::Tables(&DAMPER, [0, usize::MAX], ""), "[dampers](#damper), with springs up to 8"),
];

const _: () = assert!(MAX_LOADS == 16 && MAX_FRICTIONS == 16 && MAX_ELEMENTS == 8, "the texts above name these numbers");
