//! `jred check`: degrees of freedom, dead centres, distance from a dead point, and messages about bad mechanisms.

use std::f64::consts::PI;
use std::path::Path;

use crate::support::{Folder, edited_press, jred, near, press_file, squeezed, within};
use serde_json::Value;

fn check(file: &Path, code: i32) -> Value {
    jred([&"check", &file, &"--format", &"json"])
        .ends(code)
        .json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn the_press() {
    let found = check(&press_file(), 0);
    assert_eq!(found["degrees of freedom"], 1);
    assert_eq!(
        (&found["links"], &found["constraints"]),
        (&3.into(), &8.into())
    );
    let joints = found["joints"].as_array().unwrap();
    assert_eq!(joints.len(), 4);
    assert_eq!(joints[0]["driven"], true);
    assert_eq!(joints[3]["kind"], "guide");
    assert_eq!(joints[3]["bodies"], serde_json::json!(["ground", "slider"]));
    assert_eq!(found["range"], "turn");
    assert!(number(&found["closure"]) < 1e-14);
    let travel = &found["travels"][0];
    assert_eq!(
        (&travel["link"], &travel["way"]),
        (&"slider".into(), &"slides".into())
    );
    near("stroke", number(&travel["stroke"]), 0.06, 1e-12);
    let centres = travel["dead_centres"].as_array().unwrap();
    assert_eq!(centres.len(), 2);
    within("BDC", number(&centres[0][0]), 0.0, 1e-9);
    near("BDC x", number(&centres[0][1]), 0.21, 1e-12);
    near("TDC", number(&centres[1][0]), PI, 1e-9);
    // The rod against the guide: the cosine of the largest angle, sin β = r/l.
    let index = (1.0 - 1.0 / 36.0f64).sqrt();
    near(
        "index",
        number(&found["transmission"]["index"]),
        index,
        1e-12,
    );
    assert_eq!(found["transmission"]["branch_kept"], true);
    near("mass", number(&found["inertia"]["mass"]), 57.5, 1e-14);
    assert!(number(&found["agreement"]["dalembert"]) < 1e-12);
    assert!(number(&found["agreement"]["energy"]) < 1e-9);
    let text = jred([&"check", &press_file()]).ends(0).out;
    for words in [
        "3·3 links − 8 constraints = 1",
        "slider slides by 60 mm; dead centres at φ = 0 deg (210 mm), 180 deg (150 mm)",
        "transmission index  at least 0.986",
        "the same over the whole range",
        "every check is satisfied: one degree of freedom, closure after a turn,",
        "`jred size` judges drives",
    ] {
        assert!(text.contains(words), "{words} is not in\n{text}");
    }
}

/// A press whose pressing force has the wrong sign: it pushes the slider towards φ = 360 deg instead of against the motion.
#[test]
fn a_load_that_drives_is_named() {
    let folder = Folder::new();
    let right = jred([&"check", &press_file()]).ends(0).out;
    assert!(!right.contains("drives the machine"), "{right}");
    let text = edited_press(
        "force = [\"-10 kN\", \"0 N\"]",
        "force = [\"10 kN\", \"0 N\"]",
    );
    let wrong = jred([&"check", &folder.file("wrong.toml", text)])
        .ends(0)
        .out;
    let (_, warning) = wrong
        .split_once("warning: the process load \"pressing force\" drives the machine with up to ")
        .unwrap_or_else(|| panic!("{wrong}"));
    assert_eq!(wrong.matches("drives the machine").count(), 1);
    let (power, place) = warning.split_once(" W, at φ = ").unwrap();
    // The force rises over 15 deg from 315 deg and is largest from 330 deg; the slider slows down towards 360 deg.
    let place: f64 = place.split(' ').next().unwrap().parse().unwrap();
    assert!((326.0..=332.0).contains(&(place % 360.0)), "{place}");
    // 10 kN at the speed of the slider of r (sin φ + r/(2 l) sin 2φ) ω, ω at most 29.45 rad/s.
    let power: f64 = power.parse().unwrap();
    let most = 10e3 * 0.03 * (0.5 + 30.0 / 360.0 * 0.866) * 29.4524;
    assert!(power > 0.5 * most && power < 1.1 * most, "{power} {most}");
}

/// With an offset the dead centres are where crank and rod are in line: sin φ = e/(l ± r).
#[test]
fn dead_centres_of_an_offset_slider() {
    let folder = Folder::new();
    let text = edited_press("offset = \"0 mm\"", "offset = \"24 mm\"");
    let found = check(&folder.file("offset.toml", text), 0);
    let centres = &found["travels"][0]["dead_centres"];
    let (r, l, e) = (0.03f64, 0.18f64, 0.024f64);
    near("far", number(&centres[0][0]), (e / (l + r)).asin(), 1e-9);
    near(
        "near",
        number(&centres[1][0]),
        PI + (e / (l - r)).asin(),
        1e-9,
    );
    let stroke = ((l + r).powi(2) - e * e).sqrt() - ((l - r).powi(2) - e * e).sqrt();
    near(
        "stroke",
        number(&found["travels"][0]["stroke"]),
        stroke,
        1e-12,
    );
}

const FOUR_BAR: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "four-bar"
pivot = ["300 mm", "0 mm"]
side = "left"
[mechanism.crank]
length = "80 mm"
mass = "0.5 kg"
inertia = "0.0004 kg m^2"
[mechanism.coupler]
length = "250 mm"
mass = "0.9 kg"
inertia = "0.006 kg m^2"
[mechanism.rocker]
length = "180 mm"
mass = "0.7 kg"
inertia = "0.0025 kg m^2"
"#;

/// cos μ = (b² + c² − d²)/(2bc), with the diagonal d between g − a and g + a: the index is |sin μ|.
#[test]
fn the_index_of_a_four_bar_is_the_sine_of_its_transmission_angle() {
    let folder = Folder::new();
    for (rocker, code) in [(0.18f64, 0), (0.17, 0), (0.2, 0)] {
        let text = FOUR_BAR.replace("\"180 mm\"", &format!("\"{} mm\"", rocker * 1e3));
        let found = check(&folder.file("four-bar.toml", text), code);
        let (a, b, g) = (0.08f64, 0.25f64, 0.3f64);
        let sine = |d: f64| {
            let cos = (b * b + rocker * rocker - d * d) / (2.0 * b * rocker);
            (1.0 - cos * cos).sqrt()
        };
        let least = sine(g - a).min(sine(g + a));
        let transmission = &found["transmission"];
        near("index", number(&transmission["index"]), least, 1e-9);
        near(
            "angle",
            number(&transmission["angle [deg]"]),
            least.asin().to_degrees(),
            1e-9,
        );
        assert_eq!(
            transmission["links"],
            serde_json::json!(["coupler", "rocker"])
        );
        // The rocker turns back where crank and coupler are in line: cosines in the triangles with b ± a.
        let angle = |reach: f64| {
            PI - ((g * g + rocker * rocker - reach * reach) / (2.0 * g * rocker)).acos()
        };
        let swing = (angle(b + a) - angle(b - a)).abs();
        near("swing", number(&found["travels"][0]["stroke"]), swing, 1e-9);
    }
}

/// A rod barely longer than the crank turns fully, but gets almost perpendicular to the guide.
#[test]
fn too_near_a_dead_point() {
    let folder = Folder::new();
    let text = edited_press("length = \"180 mm\"", "length = \"31 mm\"");
    let file = folder.file("short.toml", text);
    let found = check(&file, 1);
    let index = (1.0 - (30.0f64 / 31.0).powi(2)).sqrt();
    near(
        "index",
        number(&found["transmission"]["index"]),
        index,
        1e-9,
    );
    let violation = found["violations"][0].as_str().unwrap();
    assert!(
        violation.contains("too close to a dead point: transmission index 0.2519 at φ = "),
        "{violation}"
    );
    let text = jred([&"check", &file]).ends(1).out;
    assert!(
        text.contains("CLOSE TO A DEAD POINT")
            && squeezed(&text).contains("violated too close to a dead point")
    );
    // In between: worse than recommended, but not a violation.
    let text = edited_press("length = \"180 mm\"", "length = \"36 mm\"");
    let text = jred([&"check", &folder.file("fair.toml", text)])
        .ends(0)
        .out;
    assert!(text.contains("below the recommended 40 deg"), "{text}");
    jred([&"check", &folder.path("nothing.toml")]).ends(2);
}

/// Shafts cannot lock.
#[test]
fn a_train() {
    let train = Path::new(env!("CARGO_MANIFEST_DIR")).join("../file/tests/data/gear-train.toml");
    let found = check(&train, 0);
    near("index", number(&found["transmission"]["index"]), 1.0, 1e-15);
    assert_eq!(found["travels"][0]["way"], "turns");
    near(
        "advance",
        number(&found["travels"][0]["stroke"]),
        -2.0 * PI / 3.0,
        1e-12,
    );
    assert_eq!(found["agreement"]["of_motion"], true);
}

/// For every example machine the joints leave one freedom, and both methods give the same drive torque.
#[test]
fn every_example_machine() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    for entry in std::fs::read_dir(folder).unwrap() {
        let file = entry.unwrap().path();
        if file.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        // A variator has no angle-dependent link to check.
        if std::fs::read_to_string(&file)
            .unwrap()
            .contains("[variator")
        {
            continue;
        }
        let found = check(&file, 0);
        let name = file.display();
        assert_eq!(found["degrees of freedom"], 1, "{name}");
        assert!(number(&found["agreement"]["dalembert"]) < 1e-10, "{name}");
        if let Some(energy) = found["agreement"]["energy"].as_f64() {
            assert!(energy < 1e-9, "{name}: {energy:e}");
        }
    }
}

fn example(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    folder.join(name)
}

/// Checks for words in the text of `jred check` for an example.
fn says(name: &str, words: &[&str]) {
    let text = squeezed(&jred([&"check", &example(name)]).ends(0).out);
    for words in words {
        assert!(text.contains(words), "{words:?} is not in\n{text}");
    }
}

/// The dwells of the program exactly; the pressure angle is a figure of its own.
#[test]
fn a_cam() {
    says(
        "cam-translating.toml",
        &[
            "dwells from 0 deg to 70 deg, 170 deg to 250 deg",
            "(follower, roller): ok",
            "largest pressure angle: 25.73 deg at φ = 312.5995 deg",
            "smallest radius of curvature of the profile: 39.56 mm at φ = ",
            "constant speed at which the follower lifts off: 322.1 rpm at φ = 156.4936 deg",
        ],
    );
    let found = check(&example("cam-translating.toml"), 0);
    assert!(found["transmission"]["angle [deg]"].is_null());
    let facts = found["facts"].as_array().unwrap();
    assert_eq!(facts.len(), 3);
    assert_eq!(facts[0]["label"], "largest pressure angle");
    // The index of the contact is the cosine of the pressure angle.
    let angle: f64 = facts[0]["text"].as_str().unwrap()[..5].parse().unwrap();
    near(
        "pressure angle",
        number(&found["transmission"]["index"]).acos().to_degrees(),
        angle,
        2e-4,
    );
    let at = number(&found["transmission"]["at"]).to_degrees();
    within("where", at, 312.5995, 1e-4);
}

/// The types of a four-bar by Grashof and Alt; the index gives its transmission angle.
#[test]
fn facts_of_a_four_bar() {
    says(
        "four-bar.toml",
        &[
            "Grashof's type crank-rocker: the crank turns fully, the rocker swings",
            "transmission angle over the crank's range: 43.26 to 99.72 deg",
            "(a transmission angle of 43.26 deg; coupler, rocker)",
        ],
    );
}

/// Gears mesh equally in every position and have no transmission angle.
#[test]
fn an_index_that_never_changes_has_no_place() {
    let train = Path::new(env!("CARGO_MANIFEST_DIR")).join("../file/tests/data/gear-train.toml");
    let found = check(&train, 0);
    assert!(found["transmission"]["at"].is_null());
    assert!(found["transmission"]["angle [deg]"].is_null());
    let text = jred([&"check", &train]).ends(0).out;
    assert!(
        squeezed(&text).contains("transmission index at least 1 everywhere ("),
        "{text}"
    );
    assert!(!text.contains("a transmission angle"), "{text}");
}
