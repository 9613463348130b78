//! `[mechanism] type = "linkage"`.

use super::cam;
use crate::text::key::{ValueForm, Key, POSITION, KeyTable, key, may, of_axis, pair, quantity};
use crate::units::kind::{ANGLE, INERTIA, LENGTH, MASS};

/// The types of joint.
pub(crate) const JOINTS: [&str; 8] = ["revolute", "prismatic", "fixed", "pin-in-slot", "gears", "rack", "belt", "cam"];

/// The most bodies and joints.
pub(crate) const MOST: [usize; 2] = [16, 32];

static BODY: KeyTable = KeyTable::of("linkage.body", &[&[
    key("name", ValueForm::Text, "not `ground`, without `.`").such_as("\"crank\""),
    key("mass", quantity(&MASS).not_negative(), ""),
    may("inertia", quantity(&INERTIA).not_negative(), "about its own centre of mass; required of a body that turns"),
    super::parts::COM,
    may("angle", quantity(&ANGLE), "of the u axis in the drawing, approximate (from guides)"),
    may("position", pair(&LENGTH), "origin of the frame in the drawing, approximate (from the joints)"),
    may("points", ValueForm::Named(&pair(&LENGTH)), "points `[u, v]`, names without `.`"),
]]).elsewhere(&[
    ("length", "a body has no `length`: give its points instead, such as points = { A = [\"80 mm\", \"0 mm\"] }"),
    ("at", "use `position` for the place of the body in the drawing"),
]);

const ROLLING: &[&str] = &["gears", "belt"];
const GEARS: &[&str] = &["gears"];

const fn of_a_cam(mut keys: [Key; 7]) -> [Key; 7] {
    let mut at = 0;
    while at < 7 {
        keys[at] = keys[at].only(&["cam"]);
        at += 1;
    }
    keys
}

const CAM: &[Key] = &of_a_cam([cam::JOINT[0], cam::JOINT[1], cam::JOINT[2], cam::JOINT[3], cam::JOINT[4], cam::JOINT[5], cam::JOINT[6]]);

static JOINT: KeyTable = KeyTable::of("linkage.joint", &[&[
    may("name", ValueForm::Text, "in `drive`, messages and reports (its ends: \"ground.O to crank\")").such_as("\"crank pin\""),
    may("type", ValueForm::Words(&JOINTS), "see above").or("revolute"),
    key("between", ValueForm::List(&ValueForm::Name("a body or of a point"), [2, 2]), "of two different bodies").such_as("[\"ground.O\", \"crank\"]"),
    may("direction", quantity(&ANGLE), "on the first body of a guide or cam, the second of a slot or rack; required of guide, slot, rack (0). Of a cam θ counts from it").only(&["prismatic", "fixed", "pin-in-slot", "rack", "cam"]),
    may("second_direction", quantity(&ANGLE), "on the second body, that agrees with the first; on an oscillating follower, of the arm to the roller or of the face").or("0").only(&["prismatic", "fixed", "cam"]),
    key("radii", pair(&LENGTH), "pitch radii > 0, in the order of `between`").such_as("[\"40 mm\", \"80 mm\"]").only(ROLLING),
    may("mesh", ValueForm::Words(&["external", "internal"]), "internal: the larger one is the ring").or("external").only(GEARS),
    may("carrier", ValueForm::Name("the body in which both gears turn"), "(`ground`): the arm of a planetary gear").such_as("\"arm\"").only(GEARS),
    may("crossed", ValueForm::Flag, "a crossed belt reverses").or("false").only(&["belt"]),
    key("radius", quantity(&LENGTH).positive(), "pitch radius of the pinion").only(&["rack"]),
], CAM]).by("type").elsewhere(&[
    ("at", "give the points that a joint connects as its ends: between = [\"crank.A\", \"rod\"]"),
    ("radius", "gears and belts have radii = [\"40 mm\", \"80 mm\"], a rack has the radius of its pinion"),
]);

pub(crate) static LINKAGE: KeyTable = KeyTable::of("linkage", &[&[
    key("drive", ValueForm::Name("the driven joint"), "revolute or prismatic").such_as("\"crank bearing\""),
    may("ground", ValueForm::Named(&pair(&LENGTH)), "points of the fixed frame, in global coordinates: `{ O = [\"0 mm\", \"0 mm\"] }`"),
    key("body", ValueForm::Tables(&BODY, [1, MOST[0]], "bodies that are rigidly connected are one body: add their masses"), "the moving bodies, or `[[mechanism.body]]` for each")
        .such_as(" once for each moving body, with name, mass, angle and points"),
    key("joint", ValueForm::Tables(&JOINT, [1, MOST[1]], "bodies that are rigidly connected are one body: remove the joint between them"), "the joints, or `[[mechanism.joint]]` for each")
        .such_as(" once for each joint, with name, type and between = [\"ground.O\", \"crank\"]"),
    may("drawn_at", of_axis(POSITION), "φ of the drawing, where the first position is searched (from the drawing)"),
    may("stroke", ValueForm::Pair(POSITION), "rising (a full turn); required of a prismatic drive").such_as("[\"-30 deg\", \"60 deg\"]"),
    may("keep_branch", ValueForm::Flag, "guided through its [change points](#change-points)").or("false"),
]]);
