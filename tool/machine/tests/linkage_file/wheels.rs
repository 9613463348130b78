//! Gears, racks and belts that do not fit their bearings, and places that do not follow.

use super::{refuses, refuses_edit};

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
    refuses_edit(
        gears,
        "com = [\"5 mm\", \"0 mm\"]",
        "com = [\"0 mm\", \"0 mm\"]",
        &[
            "joint \"teeth\": the gears' radii 30 mm and 80 mm require a centre distance of 110 mm, but it is 120 mm",
            "32.7273 mm and 87.2727 mm",
        ],
    );
    let fitting = gears.replace("\"80 mm\"", "\"90 mm\"");
    refuses(
        &fitting,
        &[
            "the linkage does not repeat",
            "body \"large\" is",
            "give a `stroke` over all of them, or drive the slowest shaft",
        ],
    );
    refuses_edit(
        &fitting,
        "radii = [\"30 mm\", \"90 mm\"]",
        "radii = [\"30 mm\", \"30 mm\"], mesh = \"internal\"",
        &["are equal", "larger pitch radius"],
    );
    refuses_edit(
        &fitting,
        "radii = [\"30 mm\", \"90 mm\"]",
        "radii = [\"30 mm\", \"90 mm\"], carrier = \"small\"",
        &["\"small\", which is one of the gears"],
    );
    refuses_edit(
        &fitting,
        "between = [\"small\", \"large\"]",
        "between = [\"small\", \"ground.P\"]",
        &["`carrier`", "one of these gears is the ground"],
    );
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
    refuses_edit(
        rack,
        ", direction = \"0 deg\" },\n  { name = \"teeth\"",
        " },\n  { name = \"teeth\"",
        &["`direction`", "the guide's direction on the first body"],
    );
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
