//! Cams: of the type `disc-cam`, and as a joint of a linkage.

use jred::mechanism::cam::MAX_SEGMENTS;

use super::inner;
use super::motion::{LAWS, LAYOUT, SHARES};
use super::parts::{LINK, SWING};
use crate::text::key::{ValueForm, Key, ValueRange, POSITION, KeyTable, key, may, of_axis, pair, quantity};
use crate::units::kind::{ANGLE, ANGULAR_SPEED, CAM_ACCELERATION, CAM_TURNING, CAM_VELOCITY, FORCE, INERTIA, LENGTH, MASS, SHARE, STIFFNESS, TORQUE, TORSION_STIFFNESS};

/// The laws of a cam: those from rest to rest, and further ones.
pub(crate) const CAM_LAWS: [&str; 12] = [
    LAWS[0], LAWS[1], LAWS[2], LAWS[3], LAWS[4], LAWS[5], LAWS[6], LAWS[7], LAWS[8], LAWS[9], "constant-velocity", "polynomial-5",
];

/// The kinds of follower.
pub(crate) const FOLLOWERS: [&str; 4] = ["translating-roller", "translating-flat-face", "oscillating-roller", "oscillating-flat-face"];
const SWINGING: &[&str] = &["oscillating-roller", "oscillating-flat-face"];

const OPEN_END: &[&str] = &["polynomial-5"];
const VELOCITY: ValueForm = of_axis([&SHARE, &CAM_VELOCITY]);
const BEND: ValueForm = of_axis([&CAM_TURNING, &CAM_ACCELERATION]);

static SEGMENT: KeyTable = KeyTable::of("cam.segment", &[&[
    may("dwell", quantity(&ANGLE).positive(), "of the cam; no other key"),
    may("rise", of_axis(POSITION), "of the follower, > 0; an angle if it oscillates"),
    may("return", of_axis(POSITION), "of the follower, > 0; an angle if it oscillates"),
    may("angle", quantity(&ANGLE).positive(), "of the cam for it; required"),
    may("law", ValueForm::Words(&CAM_LAWS), "a law below; required").such_as("\"cycloidal\""),
], SHARES, &[
    may("start_velocity", VELOCITY, "s′: `\"12 mm/rad\"`; a plain number if it oscillates (the neighbour's)").only(OPEN_END),
    may("end_velocity", VELOCITY, "s′: `\"12 mm/rad\"`; a plain number if it oscillates (the neighbour's)").only(OPEN_END),
    may("start_acceleration", BEND, "s″: `\"-30 mm/rad^2\"`; `\"-0.5 1/rad\"` if it oscillates (the neighbour's, else 0)").only(OPEN_END),
    may("end_acceleration", BEND, "s″: `\"-30 mm/rad^2\"`; `\"-0.5 1/rad\"` if it oscillates (the neighbour's, else 0)").only(OPEN_END),
]]).by("law")
    .either(&[(&["dwell", "rise", "return"], "write a separate segment for each")])
    .elsewhere(&[("duration", "a cam program is defined over the angle of the cam")]);

const BASE_RADIUS: Key = key("base_radius", quantity(&LENGTH).positive(), "r_b, of the profile");
const CLOSURE: Key = may("closure", ValueForm::Words(&["force", "form"]), "the follower is kept on the cam by a force, or by a groove or second cam").or("force");

const SHAPE: &[Key] = &[
    key("type", ValueForm::Words(&FOLLOWERS), "see above").such_as("\"translating-roller\""),
    may("offset", quantity(&LENGTH), "translating: e; oscillating face: h").or("0").only(&["translating-roller", "translating-flat-face", "oscillating-flat-face"]),
    key("pivot", pair(&LENGTH), "A").such_as("[\"90 mm\", \"0 mm\"]").only(SWINGING),
    key("swing", ValueForm::Words(&["counter-clockwise", "clockwise"]), "the way the arm turns when it rises").only(SWINGING),
    key("arm", quantity(&LENGTH).positive(), "l").only(&["oscillating-roller"]),
];

/// The program, and where it stands in the file.
const SEGMENTS: ValueForm = ValueForm::Tables(&SEGMENT, [1, MAX_SEGMENTS], "one turn of the cam is made of rises, dwells and returns");

pub(crate) static DISC_CAM: KeyTable = KeyTable::of("disc-cam", &[&[
    BASE_RADIUS,
    CLOSURE,
    key("cam", inner!(LINK), ""),
    key("follower", ValueForm::Table(&KeyTable::of("", &[SHAPE, &[
        key("mass", quantity(&MASS).not_negative(), "without the roller"),
        key("inertia", quantity(&INERTIA).not_negative(), "about its own centre of mass").only(SWINGING),
        super::parts::COM,
    ]]).by("type").elsewhere(&[("inertia", "a follower that slides does not turn, so it has no moment of inertia")])), ""),
    may("roller", ValueForm::Table(&KeyTable::of("", &[&[
        key("radius", quantity(&LENGTH).positive(), "r_r; the roller is required of a follower with one"),
        key("mass", quantity(&MASS).not_negative(), "of the roller"),
        key("inertia", quantity(&INERTIA).not_negative(), "of all that turns with it"),
    ]]).elsewhere(&[("com", "a roller is balanced: its centre of mass is on its axis")])), ""),
    may("spring", inner!(&[
        key("stiffness", ValueForm::Quantity([&TORSION_STIFFNESS, &STIFFNESS], ValueRange::Positive), "closing spring on the guide's axis, or a torsion spring about A"),
        key("preload", ValueForm::Quantity([&TORQUE, &FORCE], ValueRange::NotNegative), "at s = 0, on the cam"),
    ]), ""),
    may("segment", SEGMENTS, "the program, from φ = 0, together one turn; required without `lift`")
        .such_as(" once for each rise = \"…\", return = \"…\" and dwell = \"…\""),
    may("lift", ValueForm::File, "relative to the machine file: the [lift over the angle](#table), instead of segments"),
    may("lift_within", of_axis(POSITION).positive(), "how far the program may miss the table (0.1 % of the stroke)"),
    may("lift_speed", quantity(&ANGULAR_SPEED).positive(), "of the cam for which the table gives velocities and accelerations over the time"),
    LAYOUT[0].meaning("titles of the [columns](import.md#csv) `angle`, `lift`, `slope`, `bend`"),
    LAYOUT[1], LAYOUT[2], LAYOUT[3],
    SWING.meaning("rising, less than a turn: only of a cam with `closure = \"form\"` (full turn)"),
]]).either(&[(&["lift", "segment"], "give either the segments or the table of the lift")]);

/// The keys of a joint that is a cam.
pub(super) const JOINT: &[Key] = &[
    key("axis", ValueForm::Name("a point"), "in which the cam turns, of the body with both bearings, mostly the ground").such_as("\"ground.O\": the point of the ground about which the cam turns"),
    may("axis_direction", quantity(&ANGLE), "+x of the arrangement, from that body's u axis; a translating follower rises along its +y").or("0"),
    CLOSURE,
    BASE_RADIUS,
    key("follower", ValueForm::Table(&KeyTable::of("", &[SHAPE]).by("type").elsewhere(&[
        ("mass", IS_A_BODY), ("inertia", IS_A_BODY), ("com", IS_A_BODY),
    ])), "").such_as("{ type = \"oscillating-roller\", pivot = [\"120 mm\", \"0 mm\"], arm = \"100 mm\", swing = \"clockwise\" }"),
    may("roller", ValueForm::Table(&KeyTable::of("", &[&[key("radius", quantity(&LENGTH).positive(), "required of a follower with a roller")]]).elsewhere(&[
        ("mass", IN_THE_FOLLOWER),
        ("com", IN_THE_FOLLOWER),
        ("inertia", "the rotation of the roller is neglected in a linkage; type = \"disc-cam\" includes it"),
    ])), "").such_as("{ radius = \"13 mm\" }"),
    key("segment", SEGMENTS, "as of a [disc cam](mechanisms/disc-cam.md), also as `[[mechanism.joint.segment]]`").such_as(" once for each rise = \"…\", return = \"…\" and dwell = \"…\""),
];

const IS_A_BODY: &str = "the follower is a body of the linkage, which has its own mass: give it there";
const IN_THE_FOLLOWER: &str = "in a linkage the roller is part of the follower: add its mass to that body";
