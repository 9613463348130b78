//! Gears, racks and belts: how they move, and what does not fit their bearings or follow.

use jred::machine::Mechanism as _;
use jred::machine::Reducible as _;

use super::{close, read, refuses, refuses_edits};

#[test]
fn wheels_that_do_not_fit() {
    let gears = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "linkage"
drive = "first"
ground = { P = ["120 mm", "0 mm"] }
body = [
  { name = "small", mass = "1 kg", inertia = "3 kg cm^2", angle = "0 deg" },
  { name = "large", mass = "2 kg", inertia = "40 kg cm^2", angle = "0 deg", com = ["5 mm", "0 mm"] },
]
joint = [
  { name = "first", between = ["ground", "small"] },
  { name = "second", between = ["ground.P", "large"] },
  { name = "teeth", type = "gears", between = ["small", "large"], radii = ["30 mm", "80 mm"] },
]
"#;
    let edits = r#"
        com = ["5 mm", "0 mm"] => com = ["0 mm", "0 mm"] =>
            joint "teeth": the gears' radii 30 mm and 80 mm require a centre distance of 110 mm, but it is 120 mm |
            32.7273 mm and 87.2727 mm
    "#;
    refuses_edits(gears, edits);
    let fitting = gears.replace("\"80 mm\"", "\"90 mm\"");
    refuses(
        &fitting,
        &[
            "the linkage does not repeat",
            "body \"large\" is",
            "give a `stroke` over all of them, or drive the slowest shaft",
        ],
    );
    let edits = r#"
        radii = ["30 mm", "90 mm"] => radii = ["30 mm", "30 mm"], mesh = "internal" => are equal | larger pitch radius
        radii = ["30 mm", "90 mm"] => radii = ["30 mm", "90 mm"], carrier = "small" => "small", which is one of the gears
        between = ["small", "large"] => between = ["small", "ground.P"] => `carrier` | one of these gears is the ground
    "#;
    refuses_edits(&fitting, edits);
    // Three bodies: the belt's second pulley rides on the first.
    let riding = fitting
        .replace("[\"ground.P\", \"large\"]", "[\"small.P\", \"large\"]")
        .replace(
            "inertia = \"3 kg cm^2\", angle = \"0 deg\"",
            "inertia = \"3 kg cm^2\", angle = \"0 deg\", points = { P = [\"120 mm\", \"0 mm\"] }",
        )
        .replace("type = \"gears\"", "type = \"belt\"")
        .replace(", com = [\"5 mm\", \"0 mm\"]", "");
    refuses(&riding, &["the centre of the pulley \"large\" moves"]);
}

#[test]
fn places_that_do_not_follow() {
    let rack = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "linkage"
drive = "bearing"
stroke = ["0 deg", "90 deg"]
body = [
  { name = "pinion", mass = "2 kg", inertia = "40 kg cm^2", angle = "0 deg" },
  { name = "rack", mass = "5 kg" },
]
joint = [
  { name = "bearing", between = ["ground", "pinion"] },
  { name = "guide", type = "prismatic", between = ["ground", "rack"], direction = "0 deg" },
  { name = "teeth", type = "rack", between = ["pinion", "rack"], radius = "30 mm", direction = "0 deg" },
]
"#;
    refuses(
        rack,
        &[
            "joint \"teeth\": the pinion has a radius of 30 mm, but its centre is 0 mm from the rack's pitch line",
        ],
    );
    let edits = r#"
        , direction = "0 deg" },\n  { name = "teeth" => ␣},\n  { name = "teeth" =>
            `direction` | the guide's direction on the first body
    "#;
    refuses_edits(rack, edits);
    let slides = rack
        .replace(
            "drive = \"bearing\"\nstroke = [\"0 deg\", \"90 deg\"]",
            "drive = \"guide\"",
        )
        .replace(
            "between = [\"ground\", \"rack\"]",
            "between = [\"ground.G\", \"rack\"]",
        )
        .replace(
            "body = [",
            "ground = { G = [\"0 mm\", \"-30 mm\"] }\nbody = [",
        );
    refuses(
        &slides,
        &[
            "`stroke` in [mechanism] is missing",
            "two ends of its stroke",
        ],
    );
}

/// Sun 24 teeth of module 2, planet 18, ring 60: the sun drives, the ring is the ground; 3.5 turns of the sun are one of the
/// arm.
const PLANETARY: &str = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "linkage"
drive = "sun bearing"
stroke = ["0 deg", "1260 deg"]
body = [
  { name = "sun", mass = "1 kg", inertia = "3 kg cm^2", angle = "0 deg" },
  { name = "arm", mass = "2 kg", inertia = "40 kg cm^2", angle = "0 deg", points = { P = ["42 mm", "0 mm"] } },
  { name = "planet", mass = "0.5 kg", inertia = "1 kg cm^2", angle = "0 deg" },
]
joint = [
  { name = "sun bearing", between = ["ground", "sun"] },
  { name = "arm bearing", between = ["ground", "arm"] },
  { name = "planet bearing", between = ["arm.P", "planet"] },
  { name = "sun and planet", type = "gears", between = ["sun", "planet"], radii = ["24 mm", "18 mm"], carrier = "arm" },
  { name = "planet and ring", type = "gears", between = ["planet", "ground"], radii = ["18 mm", "60 mm"], mesh = "internal", carrier = "arm" },
]
[[load]]
on = "arm"
moment = "-10 N m"
"#;

#[test]
fn a_planetary_gear_by_willis() {
    let file = read(PLANETARY);
    // Willis: ω_arm/ω_sun = z_s/(z_s + z_r); ω_planet = ω_arm·(1 − z_r/z_p).
    let arm = 24.0 / 84.0;
    let planet = arm * (1.0 - 60.0 / 18.0);
    let inertia = 3e-4 + (40e-4 + 0.5 * 0.042 * 0.042) * arm * arm + 1e-4 * planet * planet;
    for phi in [0.0, 1.0, 4.0, 20.0] {
        let frames = file.machine.mechanism().frames(phi).unwrap();
        close(frames[1].psi.d1, arm, 1e-14);
        close(frames[2].psi.d1, planet, 1e-14);
        let reduced = file.machine.reduction(phi).unwrap();
        close(reduced.inertia, inertia, 1e-17);
        close(reduced.load_torque(), -10.0 * arm, 1e-13);
        // d'Alembert sees the same torque, through the teeth.
        let drive = file.machine.forces(phi, 30.0, 200.0).unwrap().drive;
        close(drive, inertia * 200.0 + 10.0 * arm, 1e-12);
    }
}

/// A pinion on a crank bearing moves a rack, which an open belt's second pulley has no part in.
const RACK: &str = r#"gravity = ["-9.81 m/s^2", "0 m/s^2"]
[mechanism]
type = "linkage"
drive = "bearing"
stroke = ["0 deg", "720 deg"]
ground = { P = ["200 mm", "0 mm"], G = ["0 mm", "-70 mm"] }
body = [
  { name = "small", mass = "1 kg", inertia = "3 kg cm^2", angle = "0 deg" },
  { name = "pinion", mass = "2 kg", inertia = "40 kg cm^2", angle = "0 deg" },
  { name = "rack", mass = "5 kg", points = { R = ["0 mm", "40 mm"] } },
]
joint = [
  { name = "bearing", between = ["ground", "small"] },
  { name = "pinion bearing", between = ["ground.P", "pinion"] },
  { name = "belt", type = "belt", between = ["small", "pinion"], radii = ["20 mm", "60 mm"] },
  { name = "guide", type = "prismatic", between = ["ground.G", "rack"], direction = "0 deg" },
  { name = "teeth", type = "rack", between = ["pinion", "rack.R"], radius = "30 mm", direction = "0 deg" },
]
"#;

#[test]
fn belt_and_rack() {
    for (text, sign) in [
        (RACK.to_owned(), 1.0),
        // A crossed belt turns the other way round, and so does a rack above the pinion.
        (
            RACK.replace(
                "[\"20 mm\", \"60 mm\"]",
                "[\"20 mm\", \"60 mm\"], crossed = true",
            ),
            -1.0,
        ),
        (RACK.replace("\"-70 mm\"", "\"-10 mm\""), -1.0),
    ] {
        let file = read(&text);
        for phi in [0.0, 2.0, 12.0] {
            let frames = file.machine.mechanism().frames(phi).unwrap();
            let way = frames[2].x.value;
            close(way, sign * 0.030 * phi / 3.0, 1e-14);
            let reduced = file.machine.reduction(phi).unwrap();
            let inertia = 3e-4 + 40e-4 / 9.0 + 5.0 * 0.01 * 0.01;
            close(reduced.inertia, inertia, 1e-16);
            close(reduced.load_torque(), -sign * 5.0 * 9.81 * 0.01, 1e-13);
        }
    }
}
