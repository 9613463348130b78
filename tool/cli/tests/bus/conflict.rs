//! Contradictory bus voltages from several sources: only cures that work are offered.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::cures::{Keys, keys, mend, run};
use crate::support::{Folder, jred_of};

/// A motor with a bus voltage, and an amplifier with further figures if given.
fn catalogue(folder: &Folder, amplifier: &str) -> PathBuf {
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
bus_voltage = "560 V"
source = "Sheet"

[[amplifier]]
key = "a"
maker = "Maker"
model = "Model"
rated_current = "600 A"
peak_current = "2000 A"
constant_loss = "20 W"
{amplifier}
source = "Sheet"
"#
    );
    folder.file("catalogue.toml", text)
}

fn of(path: &Path) -> [&str; 4] {
    ["--catalogue", path.to_str().unwrap(), "--drive", "1=m"]
}

fn speaks_of_resistors(answer: &Value) -> bool {
    !answer["brake resistor needed"].is_null()
        || answer["cures"].to_string().contains("brake_resistor.")
}

/// The chopper's voltage is from the file, the highest one from the amplifier and below it.
#[test]
fn a_chopper_above_the_highest_voltage() {
    let folder = Folder::new();
    let path = catalogue(&folder, "max_voltage = \"750 V\"");
    let more = of(&path);
    let mut before = keys(&[
        ("bus_voltage", "560 V"),
        ("chopper_voltage", "780 V"),
        ("capacitance", "2 uF"),
    ]);
    let late = "switches on at 780 V, which is not below the maximum bus voltage of 750 V";
    let check = |before: &Keys<'static>| {
        let (text, answer) = run(&folder, before, &[], &more, 1);
        assert!(text.contains(late), "{text}");
        assert!(
            text.contains("lower chopper_voltage or raise max_voltage"),
            "{text}"
        );
        assert!(!text.contains("requires a brake resistor"), "{text}");
        assert!(!text.contains("required: "), "{text}");
        assert!(!speaks_of_resistors(&answer), "{answer:#}");
        let expected = serde_json::json!(["chopper_voltage", "max_voltage"]);
        assert_eq!(answer["conflict"]["any of"], expected);
        // The offered cure works.
        assert_eq!(
            mend(&folder, before, &[], &more),
            ["capacitance", "regenerative"]
        );
    };
    check(&before);
    // With a resistor the bus rises to 780 V; the capacitor must keep it below 750 V.
    let mut with = before.clone();
    with.extend(keys(&[
        ("brake_resistor.resistance", "10 Ohm"),
        ("brake_resistor.power", "5 kW"),
    ]));
    check(&with);
    // The offered cure works.
    before[1].1 = "740 V".to_owned();
    let (text, answer) = run(&folder, &before, &[], &more, 1);
    assert!(text.contains("resistor     required: "), "{text}");
    assert!(!text.contains("no brake resistor can work here"), "{text}");
    assert!(answer["conflict"].is_null() && speaks_of_resistors(&answer));
    let kinds = mend(&folder, &before, &[], &more);
    assert_eq!(kinds[0], "brake_resistor.resistance", "{kinds:?}");
}

/// The data sheet's bus voltage is above the highest voltage of the file: only another voltage is a cure.
#[test]
fn a_supply_above_the_highest_voltage() {
    let folder = Folder::new();
    let path = catalogue(&folder, "");
    let before = keys(&[("max_voltage", "300 V"), ("capacitance", "100 uF")]);
    for more in [&of(&path)[..], &[&of(&path)[..], &["--in-step"]].concat()] {
        let (text, answer) = run(&folder, &before, &[], more, 1);
        assert!(
            text.contains(
                "the bus voltage is always above its maximum of 300 V: the supply keeps it at 560 V"
            ),
            "{text}"
        );
        assert!(
            !text.contains("any one of these changes is sufficient"),
            "{text}"
        );
        assert_eq!(answer["cures"], serde_json::json!([]));
        assert!(!speaks_of_resistors(&answer), "{answer:#}");
    }
}

const BUS: [(&str, &str); 5] = [
    ("bus_voltage", "560 V"),
    ("chopper_voltage", "780 V"),
    ("max_voltage", "820 V"),
    ("brake_resistor.resistance", "20 Ohm"),
    ("brake_resistor.power", "1 kW"),
];

/// A resistor that never switches on only has to suit the chopper: because nothing is regenerated, or the capacitor takes all of it.
#[test]
fn a_resistance_too_small_that_is_never_used() {
    const ONLY: &str = "- brake_resistor.resistance at least 40 Ohm\n";
    let folder = Folder::new();
    let path = catalogue(&folder, "min_resistance = \"40 Ohm\"");
    let mut before = keys(&BUS);
    before.push(("capacitance", "100 mF".to_owned()));
    let (text, _) = run(&folder, &before, &[], &of(&path), 1);
    assert!(text.contains(ONLY), "{text}");
    let kinds = mend(&folder, &before, &[], &of(&path));
    assert_eq!(kinds, ["brake_resistor.resistance", "regenerative"]);

    let conveyor = |resistance: &str| {
        let text = format!(
            r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
stage = [{{ driver = {{ teeth = 20, inertia = "2 kg cm^2" }}, driven = {{ teeth = 60, inertia = "1 kg m^2" }} }}]
[motion]
type = "constant-speed"
speed = "60 rpm"
[supply]
bus_voltage = "560 V"
chopper_voltage = "780 V"
max_voltage = "820 V"
capacitance = "470 uF"
brake_resistor = {{ resistance = "{resistance}", power = "1 kW" }}
"#
        );
        let file = folder.file("conveyor.toml", text);
        jred_of(
            "bus {} --catalogue {} --drive 1=m --steps 100",
            [&file, &path],
        )
    };
    let text = conveyor("20 Ohm").ends(1).out;
    let (_, cures) = text
        .split_once("any one of these changes is sufficient\n")
        .unwrap();
    let (cures, _) = cures.split_once("\n\n").unwrap();
    assert_eq!(cures, ONLY.trim_end());
    conveyor("40 Ohm").ends(0);
}
