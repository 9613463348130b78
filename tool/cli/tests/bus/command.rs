//! `jred bus`.

use serde_json::Value;

use crate::support::{
    Folder, Run, budget, edited_press, jred, jred_of, jred_with, near, press_file, press_text,
    squeezed,
};

pub(super) const SUPPLY: &str = r#"
[supply]
mains_voltage = "400 V"
capacitance = "470 uF"
chopper_voltage = "780 V"
max_voltage = "820 V"
brake_resistor = { resistance = "47 Ohm", power = "200 W", peak_power = "13 kW", pulse_energy = "4 kW s" }
"#;

pub(crate) fn figure(answer: &Value, path: &[&str]) -> f64 {
    let value = path.iter().fold(answer, |value, key| &value[*key]);
    value
        .as_f64()
        .unwrap_or_else(|| panic!("no {path:?} in {answer:#}"))
}

pub(super) fn says(run: &Run, words: &[&str]) {
    let text = squeezed(&run.out);
    for word in words {
        assert!(text.contains(word), "{word:?} is not in\n{text}");
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
    // In step, two presses draw twice the power of one.
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
            "axis 1 Servo press",
            "axis 2 Servo press",
            "in step",
            "any phases peak drawn",
            "bus voltage",
            "against 820 V: ok",
            "\none bus compared with a bus for each axis, with 1/2 of the capacitance and the same brake resistor, it saves ",
        ],
    );
    // With one axis there is nothing to share.
    assert!(figure(&two, &["saved by sharing [W]"]) >= 0.0);
    assert_eq!(one["saved by sharing [W]"], Value::Null);
    let alone = jred([&"bus", &file, &steps[0], &steps[1]]).ends(0);
    assert!(!alone.out.contains("the common bus saves"), "{}", alone.out);
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
    // Refused: different supplies, a wrong drive, a machine without a motion.
    let other = folder.file("other.toml", press_text() + &SUPPLY.replace("470", "680"));
    let good = folder.file("good.toml", press_text() + SUPPLY);
    jred([&"bus", &good, &other])
        .ends(2)
        .says(&["differs from that in"]);
    jred([&"bus", &good, &"--drive", &"2=x"])
        .ends(2)
        .says(&["--drive \"2=x\" cannot be used", "from 1 to 1"]);
    jred([&"bus", &good, &"--drive", &"1=nothing"])
        .ends(2)
        .says(&["there is no drive \"nothing\""]);
    let still = edited_press(
        "[motion]\ntype = \"cycle\"\nstart = \"180 deg\"",
        "[motion]\ntype = \"cycle\"\nstart = \"180 deg\"\nspeed = 3",
    );
    let still = folder.file("still.toml", still);
    jred([&"bus", &still]).ends(2);
}

/// Memory for all axes together has a limit: eleven times the most steps are refused before a file is read, with the allowed number.
#[test]
fn more_steps_than_memory_is_meant_for_are_refused() {
    let mut words = vec!["bus"];
    words.extend(["nowhere.toml"; 11]);
    words.extend(["--steps", "200000"]);
    jred_with(&words).ends(2).says(&[
        "11 axes of 200000 steps are too many",
        "use --steps 181818 or fewer",
    ]);
}

/// A bus with few data: each unchecked rule is reported with its missing data.
#[test]
fn what_is_not_checked_is_said() {
    let folder = Folder::new();
    let run = |name: &str, machine: String, supply: &str| {
        let file = folder.file(
            name,
            machine + "\n[supply]\nmains_voltage = \"400 V\"\n" + supply,
        );
        let steps = ["--steps", "200"];
        let text = jred([&"bus", &file, &steps[0], &steps[1]]);
        let json = jred([&"bus", &file, &steps[0], &steps[1], &"--format", &"json"]).json();
        (text, json)
    };
    let named = |json: &Value| json["not checked"].as_array().unwrap().len();
    let keys = |json: &Value, n: usize| json["not known"][n]["any of"].clone();
    let (text, json) = run("high.toml", press_text(), "capacitance = \"2 uF\"\n");
    let highest = figure(
        &json,
        &["worst", "voltage", "figures", "highest voltage [V]"],
    );
    assert!(highest > 1000.0, "{highest}");
    let text = text.ends(0);
    says(
        &text,
        &[
            "not checked bus voltage: no data for the maximum voltage of the DC bus, and it rises from 622.3 V to",
            "without a brake resistor: give max_voltage in [supply]",
        ],
    );
    assert_eq!((named(&json), &json["holds"]), (1, &Value::Bool(true)));
    assert_eq!(keys(&json, 0), serde_json::json!([["max_voltage"]]));
    // With the mains alone: the missing figures, with their keys; nothing is printed as zero.
    let (text, json) = run("bare.toml", press_text(), "");
    let text = text.ends(0);
    says(
        &text,
        &[
            "bus voltage not known, supply ",
            "W mean, no brake resistor",
            "not checked bus voltage: no data for the capacitance of the DC bus",
            "in [supply] give capacitance, or chopper_voltage and brake_resistor, or regenerative = true",
            "not checked bus voltage: no data for the maximum voltage of the DC bus: give max_voltage in [supply]",
            "not checked brake resistor: only bounds of its load are known, at most",
            "give chopper_voltage in [supply]",
        ],
    );
    assert!(!text.out.contains(" 0 W"), "{}", text.out);
    assert_eq!(named(&json), 3);
    let expected = serde_json::json!([
        ["capacitance"],
        ["chopper_voltage", "brake_resistor"],
        ["regenerative"]
    ]);
    assert_eq!(keys(&json, 0), expected);
    assert_eq!(keys(&json, 1), serde_json::json!([["max_voltage"]]));
    assert_eq!(keys(&json, 2), serde_json::json!([["chopper_voltage"]]));
    assert_eq!(json["in step"]["supplied [J]"], Value::Null);
    // The supply delivers at most the drawn energy, and at least the drawn minus the regenerated one.
    let [drawn, back] = ["drawn [J]", "fed back [J]"].map(|key| figure(&json["axes"][0], &[key]));
    let period = figure(&json, &["period [s]"]);
    let words = text.out.split("supply ").nth(1).unwrap();
    let words: Vec<f64> = words
        .split(' ')
        .take(3)
        .filter_map(|word| word.parse().ok())
        .collect();
    near("least", words[0], (drawn - back) / period, budget::SHORT);
    near("most", words[1], drawn / period, budget::SHORT);
    let (_, json) = run("top.toml", press_text(), "max_voltage = \"820 V\"\n");
    assert_eq!(json["checks"][0]["holds"], Value::Null);
    // A load that drives the machine feeds back more than the machine draws.
    let driven = edited_press("\"-10 kN\"", "\"60 kN\"");
    let (text, json) = run("driven.toml", driven, "capacitance = \"470 uF\"\n");
    let text = text.ends(1);
    says(
        &text,
        &["bus voltage without bound against any limit: FAIL"],
    );
    assert_eq!(json["checks"][0]["check"], "bus voltage");
    assert_eq!(json["checks"][0]["holds"], Value::Bool(false));
    let words = json["cures"].to_string();
    for part in [
        "brake_resistor.power",
        "its square over the peak_power",
        "regenerative = true",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(!words.contains("capacitance"), "{words}");
}

/// The brake resistor must not be below the amplifier's least resistance.
#[test]
fn the_amplifier_bounds_the_resistance() {
    let folder = Folder::new();
    let catalogue = |least: &str| {
        let text = format!(
            r#"
[[motor]]
key = "m"
maker = "Maker"
model = "Model"
rated_torque = "300 N m"
rated_speed = "1000 rpm"
max_speed = "2000 rpm"
peak_torque = "3000 N m"
rotor_inertia = "500 kg cm^2"
torque_constant = "2 N m/A"
source = "Sheet"

[[amplifier]]
key = "a"
maker = "Maker"
model = "Model"
rated_current = "600 A"
peak_current = "2000 A"
min_resistance = "{least}"
source = "Sheet"
"#
        );
        folder.file("catalogue.toml", text)
    };
    let file = folder.file("press.toml", press_text() + SUPPLY);
    let run = |least: &str| {
        let catalogue = catalogue(least);
        jred_of(
            "bus {} --catalogue {} --drive 1=m --steps 200",
            [&file, &catalogue],
        )
    };
    let low = run("60 Ohm").ends(1);
    says(&low, &["brake resistance 47 against 60 Ohm: FAIL"]);
    says(&run("40 Ohm"), &["brake resistance 47 against 40 Ohm: ok"]);
}
