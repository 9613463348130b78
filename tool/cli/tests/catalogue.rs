//! The catalogue: what is built in, and what a user is told about a file of his own that cannot be used.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod broken;
mod contradictions;
mod currency;
mod database;
mod format;
mod pairing;
mod plausible;
mod spreadsheet;
mod together;

use std::collections::BTreeSet;
use std::path::Path;

use crate::support::{Folder, Run, jred, press_file};
use jred_machine::units::RPM;
use jred_sizing::catalogue::Catalogue;

fn built_in() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

#[test]
fn the_built_in_catalogue_is_plausible() {
    let catalogue = built_in();
    assert!(catalogue.motors.len() >= 15, "{}", catalogue.motors.len());
    assert!(catalogue.gearboxes.len() >= 6);
    let makers: BTreeSet<&str> = catalogue.motors.iter().map(|m| m.maker.as_str()).collect();
    assert!(makers.len() >= 3, "{makers:?}");
    let keys: BTreeSet<&str> = catalogue.motors.iter().map(|m| m.key.as_str()).collect();
    assert_eq!(keys.len(), catalogue.motors.len());
    for motor in &catalogue.motors {
        let key = &motor.key;
        assert!(motor.source.len() > 20, "{key}");
        let rated_torque = motor.rated_torque.unwrap();
        let rated_speed = motor.rated_speed.unwrap();
        let peak_torque = motor.peak_torque.unwrap();
        let power = rated_torque * rated_speed;
        assert!((50.0..20e3).contains(&power), "{key}: {power} W");
        let rpm = rated_speed / RPM;
        assert!((500.0..6001.0).contains(&rpm), "{key}: {rpm} rpm");
        let overload = peak_torque / rated_torque;
        assert!(
            (1.5..10.0).contains(&overload),
            "{key}: peak/rated {overload}"
        );
        if let Some(standstill) = motor.standstill_torque {
            let share = standstill / rated_torque;
            assert!((1.0..2.0).contains(&share), "{key}: M0/Mn {share}");
            assert!(standstill < peak_torque, "{key}");
        }
        // Rotors grow with the torque to the power 5/3 (similar shape); makers differ by a factor of ten.
        let slimness = motor.rotor_inertia / peak_torque.powf(5.0 / 3.0);
        assert!((5e-7..2e-5).contains(&slimness), "{key}: {slimness:e}");
        // Time to accelerate the bare rotor to rated speed at peak torque.
        let time = motor.rotor_inertia * rated_speed / peak_torque;
        assert!((1e-3..0.2).contains(&time), "{key}: {time} s");
        if let Some(mass) = motor.mass {
            assert!((0.2..20.0).contains(&(rated_torque / mass)), "{key}");
        }
    }
    // Torque constants are stated at 20 °C or 100 °C, torques with hot windings.
    let currents = catalogue.motors.iter().filter_map(|motor| {
        let winding = &motor.winding;
        let given = winding.torque_constant.zip(winding.rated_current);
        given.map(|(k_t, i)| (&motor.key, k_t * i / motor.rated_torque.unwrap()))
    });
    let currents: Vec<_> = currents.collect();
    assert_eq!(currents.len(), 12);
    for (key, share) in currents {
        assert!((0.95..1.35).contains(&share), "{key}: {share}");
    }
    let keys: BTreeSet<&str> = catalogue.gearboxes.iter().map(|g| g.key.as_str()).collect();
    assert_eq!(keys.len(), catalogue.gearboxes.len());
    for gearbox in &catalogue.gearboxes {
        let key = &gearbox.key;
        assert!(gearbox.source.len() > 20, "{key}");
        assert!((2.0..=200.0).contains(&gearbox.ratio), "{key}");
        assert!((0.8..1.0).contains(&gearbox.efficiency), "{key}");
        if let Some(rated) = gearbox.rated_torque {
            let overload = gearbox.peak_torque.unwrap() / rated;
            assert!((1.0..4.0).contains(&overload), "{key}: {overload}");
        }
        if let Some(speed) = gearbox.rated_speed {
            assert!(speed < gearbox.max_speed.unwrap(), "{key}");
        }
        assert!((1e-6..1e-2).contains(&gearbox.inertia), "{key}");
        if let (Some(stiffness), Some(torque)) = (gearbox.stiffness, gearbox.rated_torque) {
            // The rated torque twists a planetary gearbox by some arcminutes.
            let twist = (torque / stiffness).to_degrees() * 60.0;
            assert!((3.0..10.0).contains(&twist), "{key}: {twist} arcmin");
        }
        // The ratio is part of the type designation.
        assert!(
            gearbox.model.contains(&format!("i={}", gearbox.ratio)),
            "{key}: {}",
            gearbox.model
        );
    }
}

#[test]
fn the_built_in_brake_resistors() {
    let catalogue = built_in();
    let found: Vec<[f64; 2]> = catalogue
        .resistors
        .iter()
        .map(|r| [r.resistance, r.rated_power])
        .collect();
    let expected = [10.0, 18.0, 23.0, 33.0, 47.0].map(|ohm| [ohm, 450.0]);
    assert_eq!(found, expected);
    assert!(
        catalogue
            .resistors
            .iter()
            .all(|r| r.from_maker && r.source.len() > 20)
    );
}

const HEADER: &str = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source";
const FIRST: &str = "m1,Maker,Model,8,2000,36,8.5,Sheet";
const SECOND: &str = "m2,Maker,Model,9,2000,36,8.5,Sheet";

fn size_with(motors: impl AsRef<[u8]>) -> Run {
    let folder = Folder::new();
    let file = folder.file("m.csv", motors);
    // A short path: messages are broken into lines at a fixed width.
    jred([
        &"size",
        &press_file(),
        &"--motors",
        &file,
        &"--steps",
        &"16",
    ])
}

/// `place` is line and column as the message shows them.
fn refuses(motors: &str, place: Option<(usize, usize)>, words: &[&str]) {
    let run = size_with(motors).ends(2);
    if std::env::var_os("SHOW_REPORTS").is_some() {
        println!("{}", run.err);
    }
    assert!(run.out.is_empty());
    run.says(words);
    if let Some((line, column)) = place {
        let place = format!("m.csv:{line}:{column}]");
        assert!(run.err.contains(&place), "{place} is not in\n{}", run.err);
    }
}

#[test]
fn nothing_in_the_file() {
    refuses("", None, &["is empty", "motors", "docs/catalogue.md"]);
    refuses("\n\n", None, &["is empty", "motors"]);
    refuses(HEADER, None, &["is empty", "motors", "at least one row"]);
    refuses(&format!("{HEADER}\n# nothing yet\n"), None, &["is empty"]);
}

#[test]
fn wrong_columns() {
    let table = |header: &str| format!("{header}\n{FIRST}\n");
    refuses(
        "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],source\nm,M,M,8,2000,36,S\n",
        Some((1, 1)),
        &["the column \"rotor_inertia\" is missing", "add the column"],
    );
    refuses(
        &table(&HEADER.replace("rated_torque", "rated_torqe")),
        Some((1, 17)),
        &[
            "unknown column \"rated_torqe\"",
            "did you mean \"rated_torque\"?",
        ],
    );
    refuses(
        &table(&HEADER.replace("rotor_inertia", "rotor inertia")),
        None,
        &["did you mean \"rotor_inertia\"?"],
    );
    refuses(
        &table(&HEADER.replace("rated_torque [N m]", "rated_torque [kg m^2]")),
        Some((1, 17)),
        &["has the unit [kg m^2]", "[N m]", "[mN m]"],
    );
    refuses(
        &table(&HEADER.replace("rated_speed [rpm]", "rated_speed")),
        Some((1, 36)),
        &["rated_speed", "[rpm]", "[rad/s]"],
    );
    // Semicolons and tabs separate as well, but decimals keep their point.
    for separator in [";", "\t"] {
        let table = table(HEADER).replace("8.5", "8~5").replace(',', separator);
        refuses(
            &table.replace('~', ","),
            Some((2, FIRST.find("8.5").unwrap() + 1)),
            &[
                "rotor_inertia of \"m1\" is \"8,5\"",
                "decimal point",
                "\"8.5\"",
            ],
        );
    }
    refuses(
        &table(&HEADER.replace("rated_speed [rpm]", "ratio")),
        Some((1, 36)),
        &["unknown column \"ratio\"", "It is a column of gearboxes"],
    );
}

/// Two columns of one name cannot both be right.
#[test]
fn a_column_given_twice() {
    refuses(
        &format!("{HEADER},rated_torque [mN m]\n{FIRST},8000\n"),
        None,
        &["duplicate column \"rated_torque\""],
    );
}

#[test]
fn wrong_cells() {
    let with = |cell: &str| format!("{HEADER}\n{FIRST}\nm2,Maker,Model,{cell},2000,36,8.5,Sheet\n");
    for cell in [
        "abc", "-9", "NaN", "inf", "0", "9 Nm", "1e999", "-0.0", "9..1",
    ] {
        refuses(
            &with(cell),
            Some((3, 16)),
            &[
                &format!("rated_torque of \"m2\" is \"{cell}\""),
                "not a number greater than zero",
                "write a plain number",
            ],
        );
    }
    refuses(
        &with("\"9,1\""),
        None,
        &["rated_torque of \"m2\" is \"9,1\"", "write a plain number"],
    );
    refuses(
        &with(""),
        None,
        &["rated_torque of \"m2\" is empty", "fill in"],
    );
    refuses(
        &with("40"),
        Some((3, 24)),
        &[
            "peak_torque of \"m2\" is below its rated_torque",
            "check peak_torque",
        ],
    );
    refuses(
        &format!("{HEADER}\n{FIRST}\n{}\n", SECOND.replace("m2", "m1")),
        Some((3, 1)),
        &["duplicate key \"m1\"", "a unique key"],
    );
    refuses(
        &format!("{HEADER}\n{FIRST}\nm2,Maker,Model,9,2000\n"),
        Some((3, 1)),
        &[
            "this row has 5 cells, but the header has 8",
            "every row must have as many cells",
        ],
    );
    refuses(
        &format!("{HEADER}\n{FIRST}\n{SECOND},extra\n"),
        None,
        &["every row must have as many cells"],
    );
    refuses(
        &format!("{HEADER}\n{FIRST}\nm2,,Model,9,2000,36,8.5,Sheet\n"),
        None,
        &["maker of \"m2\" is empty"],
    );
}

/// The place shown is the cell's, not that of the same characters somewhere before it.
#[test]
fn the_place_is_the_cell() {
    refuses(
        &format!("{HEADER}\nm-9,Maker,Model,-9,2000,36,8.5,Sheet\n"),
        Some((2, 17)),
        &["rated_torque of \"m-9\" is \"-9\""],
    );
}

#[test]
fn the_place_is_not_in_a_comment() {
    refuses(
        &format!("{HEADER}\n# not -9\nm2,Maker,Model,-9,2000,36,8.5,Sheet\n"),
        Some((3, 16)),
        &["rated_torque of \"m2\" is \"-9\""],
    );
}

#[test]
fn not_text() {
    let run = size_with([0xffu8, 0xfe, 0x00, 0x41]).ends(2);
    run.says(&["cannot read the catalogue", "--motors"]);
    let run = jred([
        &"size",
        &press_file(),
        &"--gearboxes",
        &Path::new("/no/such.csv"),
    ]);
    run.ends(2)
        .says(&["cannot read the catalogue", "--gearboxes"]);
}

/// A catalogue of the user's replaces the built-in one.
#[test]
fn own_catalogues_are_the_only_candidates() {
    let run = size_with(format!("{HEADER}\n{FIRST}\n{SECOND}\n"));
    let all = 2 * (built_in().gearboxes.len() + 1);
    assert!(run.out.contains(&format!(" of {all} ")), "{}", run.out);
}
