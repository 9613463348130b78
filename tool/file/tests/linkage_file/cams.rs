//! A cam as a joint of a linkage.

use jred::machine::{Jointed as _, Mechanism as _};
use jred::mechanism::cam::contact_force;

use super::{close, refuses_edit, refuses_edits};
use crate::reading::machine;

const JAW: &str = include_str!("../../../../machines/linkage-cam-lever.toml");

#[test]
fn the_jaw_follows_its_cam() {
    let file = machine("linkage-cam-lever.toml");
    let jaw = file.machine.mechanism();
    let frames = |deg: f64| jaw.frames(deg.to_radians()).unwrap();
    // In the first dwell the roller is on the base circle: the triangle of the pivots.
    let rest = std::f64::consts::PI
        - ((0.12_f64.powi(2) + 0.1_f64.powi(2) - 0.065_f64.powi(2)) / (2.0 * 0.12 * 0.1)).acos();
    close(frames(30.0)[1].psi.value, rest, 1e-12);
    close(
        frames(200.0)[1].psi.value,
        rest - 20_f64.to_radians(),
        1e-12,
    );
    // The jaw's pin by the slider-crank formula.
    let at = |psi: f64| {
        let (c, arm) = (
            0.075_f64.hypot(0.129_904),
            psi + (-0.129_904_f64).atan2(0.075),
        );
        let lift = 0.15 - c * arm.sin();
        0.12 + c * arm.cos() + (0.04 - lift * lift).sqrt()
    };
    for deg in [30.0, 100.0, 140.0, 200.0, 290.0] {
        let frames = frames(deg);
        close(frames[3].x.value, at(frames[1].psi.value), 1e-12);
    }
    close(at(rest - 20_f64.to_radians()) - at(rest), 0.05, 1e-3);
    // The outline is the profile, and the contact presses at rest.
    let outline = jaw.outlines(0).next().unwrap();
    close(outline[0][0].hypot(outline[0][1]), 0.052, 1e-12);
    let contact = 5;
    assert_eq!(jaw.joint_names()[contact], "cam contact");
    assert!(contact_force(&file.machine, contact, 0.5, 0.0, 0.0).unwrap() > 100.0);
    assert_eq!(jaw.contacts().len(), 1);
    let constraints = jaw.joints(0.0, &frames(0.0)).unwrap();
    assert_eq!(
        constraints
            .iter()
            .map(jred::machine::Joint::constraints)
            .sum::<usize>(),
        11
    );
}

/// A follower that translates, all of it lying on its side: +y of the arrangement is −x of the ground.
#[test]
fn an_arrangement_may_be_turned() {
    let text = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "linkage"
drive = "cam bearing"
ground = { O = ["10 mm", "20 mm"], G = ["10 mm", "25 mm"] }
body = [
  { name = "cam", mass = "1 kg", inertia = "3 kg cm^2", angle = "120 deg" },
  { name = "plunger", mass = "2 kg" },
]
joint = [
  { name = "cam bearing", between = ["ground.O", "cam"] },
  { name = "guide", type = "prismatic", between = ["ground.G", "plunger"], direction = "180 deg" },
  { type = "cam", between = ["cam", "plunger"], axis = "ground.O", axis_direction = "90 deg", direction = "-30 deg", base_radius = "40 mm", closure = "form", follower = { type = "translating-roller", offset = "5 mm" }, roller = { radius = "10 mm" }, segment = [
    { rise = "12 mm", angle = "180 deg", law = "cycloidal" },
    { return = "12 mm", angle = "180 deg", law = "cycloidal" },
  ] },
]
"#;
    let file = crate::linkage_file::read(text);
    let cam = file.machine.mechanism();
    let rest = (0.05_f64.powi(2) - 0.005_f64.powi(2)).sqrt();
    // θ = φ − 30° − 90°.
    for (deg, lift) in [(120.0, 0.0), (300.0, 0.012), (210.0, 0.006), (30.0, 0.006)] {
        let plunger = cam.frames(f64::to_radians(deg)).unwrap()[1];
        close(plunger.x.value, 0.01 - rest - lift, 1e-12);
        close(plunger.y.value, 0.025, 1e-12);
    }
    assert!(cam.contacts().is_empty());
    let edits = r#"
        offset = "5 mm" => offset = "6 mm" => slides 5 mm from the cam's axis, but its `offset` is 6 mm
        "prismatic", between = ["ground.G", "plunger"], direction = "180 deg" => "revolute", between = ["ground.G", "plunger"] =>
            `angle` of body "plunger"
    "#;
    refuses_edits(text, edits);
}

#[test]
fn cams_are_refused_with_their_cure() {
    let refuses = |from: &str, to: &str, words: &[&str]| refuses_edit(JAW, from, to, words);
    // The whole rise within 20 degrees.
    let waits = JAW.replace("dwell = \"60 deg\"", "dwell = \"150 deg\"");
    let edits = r#"
        angle = "110 deg" => angle = "20 deg" =>
            `base_radius` in [[mechanism.joint]] number 6 is too small | undercut at φ =␣ | make the base radius greater than
    "#;
    refuses_edits(&waits, edits);
    refuses(
        "axis = \"ground.O\"",
        "axis = \"ground.A\"",
        &["joint \"cam contact\": the point of the cam \"cam\" is 120 mm from the axis"],
    );
    refuses(
        "pivot = [\"120 mm\", \"0 mm\"]",
        "pivot = [\"121 mm\", \"0 mm\"]",
        &[
            "turns about [120 mm, 0 mm]",
            "not about its `pivot`, [121 mm, 0 mm]",
        ],
    );
    refuses(
        "axis = \"ground.O\"",
        "axis = \"cam\"",
        &["is on \"cam\", which this joint moves"],
    );
    refuses(
        "axis = \"ground.O\", ",
        "",
        &["`axis`", "axis = \"ground.O\""],
    );
    refuses(
        "roller = { radius = \"13 mm\" }",
        "roller = { radius = \"13 mm\", mass = \"1 kg\" }",
        &["add its mass to that body"],
    );
    refuses(
        "arm = \"100 mm\",",
        "arm = \"100 mm\", mass = \"1 kg\",",
        &["has its own mass"],
    );
    refuses(
        "{ dwell = \"60 deg\" },",
        "",
        &["cover 300 deg", "add 60 deg"],
    );
    refuses(
        "return = \"20 deg\"",
        "return = \"19 deg\"",
        &["the follower is 1 deg off"],
    );
    refuses(
        "{ name = \"jaw pin\", ",
        "{ name = \"jaw pin\", base_radius = \"1 mm\", ",
        &["`base_radius` is for type = \"cam\""],
    );
}
