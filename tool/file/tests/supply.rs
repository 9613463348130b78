//! `[supply]`, `[surroundings]` and `[duty]` of the machine file: values, and what a user is told about wrong ones.

// Copied figures are exact.
#![allow(clippy::float_cmp)]

use std::path::Path;

use crate::reader;
use crate::reading::{rendered, says};
use crate::support::{budget, near, press_text};
use jred_file::model::operation::Operation;
use jred_file::model::site::Site;

fn read(more: &str) -> Result<Site, String> {
    let text = format!("{}\n{more}", press_text());
    reader::parse("press.toml", &text, Path::new(""))
        .map(|file| file.site)
        .map_err(|report| rendered(&report))
}

fn refuses(more: &str, words: &[&str]) {
    let report = read(more).expect_err(more);
    says(&report, words);
}

#[test]
fn values_are_read() {
    let site = read(
        r#"
[supply]
mains_voltage = "400 V"
capacitance = "470 µF"
chopper_voltage = "0.78 kV"
max_voltage = "820 V"
min_resistance = "30 Ω"
brake_resistor = { resistance = "47 Ohm", power = "0.2 kW", peak_power = "13 kW", pulse_energy = "4 kW s" }
[surroundings]
ambient = "35 °C"
altitude = "1.5 km"
max_housing = "80 degC"
[duty]
type = "S3"
operating_time = "360 s"
rest = "240 s"
at_rest = "holding"
"#,
    )
    .unwrap();
    near("√2", site.bus_voltage.unwrap(), 400.0 * 2f64.sqrt(), 1e-15);
    assert_eq!(site.mains_voltage, Some(400.0));
    near(
        "√2 and 10 %",
        site.highest_supply().unwrap(),
        622.253_967_444_162,
        1e-13,
    );
    let supply = site.supply;
    near("C", supply.capacitance.unwrap(), 470e-6, 1e-15);
    assert_eq!(supply.chopper_voltage, Some(780.0));
    assert_eq!(supply.min_resistance, Some(30.0));
    let resistor = supply.brake_resistor.unwrap();
    assert_eq!([resistor.resistance, resistor.power], [47.0, 200.0]);
    assert_eq!(
        [resistor.peak_power, resistor.pulse_energy],
        [Some(13e3), Some(4e3)]
    );
    assert_eq!(site.surroundings.ambient, 35.0);
    assert_eq!(site.surroundings.housing, Some(80.0));
    near(
        "altitude",
        site.surroundings.altitude_factor(),
        0.95,
        budget::BUS,
    );
    assert_eq!(
        site.duty.operation,
        Operation::Intermittent {
            operating: 360.0,
            rest: 240.0,
            holding: true
        }
    );
    // The maker's table of torque factors at 40 °C: 0.95, 0.89, 0.84 at 2000, 3000, 4000 m.
    for (altitude, torque) in [(2000, 0.95), (3000, 0.89), (4000, 0.84)] {
        let site = read(&format!("[surroundings]\naltitude = \"{altitude} m\"")).unwrap();
        let factor = site.surroundings.altitude_factor().sqrt();
        assert_eq!((factor * 100.0).round() / 100.0, torque);
    }
    assert_eq!(read("").unwrap(), Site::default());
}

/// Mains that there are not.
#[test]
fn mains_that_cannot_be_are_refused() {
    let mains = |value: &str| format!("[supply]\nmains_voltage = {value}");
    for value in ["4000 V", "1001 V", "19 V", "0.4 V"] {
        refuses(
            &mains(&format!("\"{value}\"")),
            &[value, "mains of drives have 20 V to 1000 V", "bus_voltage"],
        );
    }
    for value in ["0 V", "-400 V"] {
        refuses(
            &mains(&format!("\"{value}\"")),
            &[value, "greater than zero"],
        );
    }
    refuses(&mains("400"), &["`mains_voltage` in [supply]", "unit"]);
    refuses(
        "[supply]\nmains_voltage = \"400 V\"\nchopper_voltage = \"560 V\"",
        &["560 V", "√2 times 400 V", "always be on"],
    );
}

#[test]
fn what_cannot_be_is_refused() {
    let supply = |lines: &str| format!("[supply]\nbus_voltage = \"560 V\"\n{lines}");
    refuses(
        &supply("capacitance = \"-470 uF\""),
        &["`capacitance` in [supply]", "-470 uF", "greater than zero"],
    );
    refuses(
        &supply("chopper_voltage = \"850 V\"\nmax_voltage = \"820 V\""),
        &[
            "`chopper_voltage` in [supply] is 850 V, not below `max_voltage`, which is 820 V",
            "amplifier's manual",
        ],
    );
    refuses(
        &supply("chopper_voltage = \"500 V\""),
        &[
            "500 V",
            "above the voltage of the DC bus, 560 V",
            "always be on",
        ],
    );
    refuses(&supply("mains_voltage = \"400 V\""), &["has both", "√2"]);
    refuses(
        &supply("max_voltage = \"820 A\""),
        &["must be a voltage", "is a current"],
    );
    refuses(
        &supply("brake_resistor = { power = \"200 W\" }"),
        &["`resistance` in [supply.brake_resistor] is missing"],
    );
    refuses(
        &supply(
            "min_resistance = \"50 Ohm\"\nbrake_resistor = { resistance = \"47 Ohm\", power = \"200 W\" }",
        ),
        &["47 Ohm", "below `min_resistance`", "50 Ohm"],
    );
    refuses(
        &supply(
            "brake_resistor = { resistance = \"47 Ohm\", power = \"200 W\", peak_power = \"150 W\" }",
        ),
        &["150 W", "below `power`"],
    );
    refuses(
        &supply(
            "regenerative = true\nbrake_resistor = { resistance = \"47 Ohm\", power = \"200 W\" }",
        ),
        &["feeds energy back"],
    );
    refuses(
        "[supply]\ncapacity = \"1 mF\"",
        &["unknown key `capacity` in [supply]"],
    );
    refuses("[surroundings]\nambient = \"313 K\"", &["Celsius"]);
    refuses(
        "[surroundings]\nambient = \"400 degC\"",
        &["between -60 degC and 300 degC"],
    );
    refuses(
        "[surroundings]\naltitude = \"5000 m\"",
        &["between -500 m and 4000 m"],
    );
    refuses(
        "[surroundings]\nmax_housing = \"30 degC\"",
        &["above `ambient`"],
    );
    refuses("[duty]\ntype = \"S10\"", &["is not a valid choice here"]);
    refuses(
        "[duty]\ntype = \"S2\"",
        &["`operating_time` in [duty] is missing"],
    );
    refuses(
        "[duty]\ntype = \"S2\"\noperating_time = \"10 s\"\nrest = \"1 s\"",
        &["is not used with S2"],
    );
    refuses(
        "[duty]\ntype = \"S4\"\noperating_time = \"10 s\"",
        &["`rest` in [duty] is missing"],
    );
    refuses(
        "[duty]\ntype = \"S1\"\nrest = \"10 s\"",
        &["is not used with S1", "without end"],
    );
    refuses(
        "[duty]\ntype = \"S5\"\nat_rest = \"off\"",
        &["which is missing"],
    );
}
