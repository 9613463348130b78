//! `jred bus`.

use serde_json::Value;

use super::support::{Folder, Run, edited_press, jred, press_file, press_text};

const SUPPLY: &str = r#"
[supply]
mains_voltage = "400 V"
capacitance = "470 uF"
chopper_voltage = "780 V"
max_voltage = "820 V"
brake_resistor = { resistance = "47 Ohm", power = "200 W", peak_power = "13 kW", pulse_energy = "4 kW s" }
"#;

fn figure(answer: &Value, path: &[&str]) -> f64 {
    let value = path.iter().fold(answer, |value, key| &value[*key]);
    value
        .as_f64()
        .unwrap_or_else(|| panic!("no {path:?} in {answer:#}"))
}

fn says(run: &Run, words: &[&str]) {
    for word in words {
        assert!(run.out.contains(word), "{word:?} is not in\n{}", run.out);
    }
}

#[test]
fn two_presses_on_one_bus() {
    let folder = Folder::new();
    let file = folder.file("press.toml", press_text() + SUPPLY);
    let steps = ["--steps", "200"];
    let one = jred([&"bus", &file, &steps[0], &steps[1], &"--format", &"json"])
        .ends(0)
        .json();
    let two = jred([
        &"bus",
        &file,
        &press_file(),
        &steps[0],
        &steps[1],
        &"--format",
        &"json",
    ]);
    let two = two.ends(0).json();
    assert_eq!(two["schema"], "jred-bus/1");
    assert_eq!(two["axes"].as_array().unwrap().len(), 2);
    let peak = |answer: &Value| figure(answer, &["bounds", "peak drawn [W]"]);
    assert!((peak(&two) - 2.0 * peak(&one)).abs() <= 1e-9 * peak(&two));
    // In step two presses draw twice what one does.
    let supplied = |answer: &Value| {
        figure(answer, &["in step", "supplied [J]"]) - figure(answer, &["in step", "burnt [J]"])
    };
    assert!((supplied(&two) - 2.0 * supplied(&one)).abs() <= 1e-9 * supplied(&two));
    let worst = figure(
        &two,
        &["worst", "voltage", "figures", "highest voltage [V]"],
    );
    assert!(worst >= figure(&two, &["in step", "highest voltage [V]"]) * (1.0 - 1e-12));
    assert!(worst <= figure(&two, &["bounds", "highest voltage [V]"]) * (1.0 + 1e-12));
    let text = jred([&"bus", &file, &press_file(), &steps[0], &steps[1]]).ends(0);
    says(
        &text,
        &[
            "1. Servo press",
            "2. Servo press",
            "in step",
            "At any phases",
            "bus voltage",
            "against 820 V: ok",
        ],
    );
    let rows = jred([
        &"bus",
        &file,
        &"--in-step",
        &steps[0],
        &steps[1],
        &"--format",
        &"csv",
    ])
    .ends(0)
    .columns();
    let highest = rows.get("voltage [V]").into_iter().fold(0.0, f64::max);
    let expected = figure(&one, &["in step", "highest voltage [V]"]);
    assert!(
        (highest - expected).abs() <= 1e-9 * expected,
        "{highest} {expected}"
    );
}

#[test]
fn one_where_a_limit_is_passed_and_two_for_bad_input() {
    let folder = Folder::new();
    let low = SUPPLY
        .replace("\"820 V\"", "\"781 V\"")
        .replace("470 uF", "1 uF")
        .replace("47 Ohm", "2 kOhm");
    let file = folder.file("low.toml", press_text() + &low);
    let run = jred([&"bus", &file, &"--steps", &"200", &"--in-step"]).ends(1);
    says(&run, &["against 781 V: FAIL"]);
    // Without a supply nothing is known; another supply, a wrong drive, a machine without a motion.
    let other = folder.file("other.toml", press_text() + &SUPPLY.replace("470", "680"));
    let good = folder.file("good.toml", press_text() + SUPPLY);
    jred([&"bus", &good, &other])
        .ends(2)
        .says(&["has another [supply] than"]);
    jred([&"bus", &good, &"--drive", &"2=x"])
        .ends(2)
        .says(&["--drive \"2=x\" cannot be used", "from 1 to 1"]);
    jred([&"bus", &good, &"--drive", &"1=nothing"])
        .ends(2)
        .says(&["has no drive \"nothing\""]);
    let still = edited_press(
        "[motion]\ntype = \"cycle\"\nstart = \"180 deg\"",
        "[motion]\ntype = \"cycle\"\nstart = \"180 deg\"\nspeed = 3",
    );
    let still = folder.file("still.toml", still);
    jred([&"bus", &still]).ends(2);
}
