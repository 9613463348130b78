//! Messages about an unusable catalogue of the user.

mod broken;
mod currency;
mod together;

use std::path::Path;

use crate::support::catalogue::{FIRST, HEADER, SECOND};
use crate::support::{Folder, Run, jred, jred_of, press_file};
use jred_sizing::catalogue::Catalogue;

fn built_in() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

fn size_with(motors: impl AsRef<[u8]>) -> Run {
    let folder = Folder::new();
    let file = folder.file("m.csv", motors);
    // A short path, because messages are wrapped at a fixed width.
    jred_of("size {} --motors {} --steps 16", [&press_file(), &file])
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
    refuses(HEADER, None, &["is empty", "motors", "add a row"]);
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
        &["must be a torque, but \"kg m^2\"", "N m, kN m, mN m"],
    );
    refuses(
        &table(&HEADER.replace("rated_speed [rpm]", "rated_speed")),
        Some((1, 36)),
        &["has no unit", "\"rated_speed [rpm]\"", "rad/s"],
    );
    refuses(
        &table(&HEADER.replace("rated_speed [rpm]", "ratio")),
        Some((1, 36)),
        &["unknown column \"ratio\"", "It is a column of gearboxes"],
    );
}

/// Two columns of one name contradict each other.
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
            "row 2 has 5 values, but the header has 8 columns",
            "every row must have as many cells",
        ],
    );
    refuses(
        &format!("{HEADER}\n{FIRST}\n{SECOND},extra\n"),
        None,
        &["every row must have as many cells", "decimals have a point"],
    );
    refuses(
        &format!("{HEADER}\n{FIRST}\nm2,,Model,9,2000,36,8.5,Sheet\n"),
        None,
        &["maker of \"m2\" is empty"],
    );
}

/// The position shown is that of the cell, not of the same characters before it.
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

/// With the built-in one, a catalogue of the user's is added to it.
#[test]
fn a_catalogue_beside_the_built_in_one() {
    let folder = Folder::new();
    folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    let run = jred_of(
        "size {} --catalogue {} --catalogue built-in --steps 16",
        [&press_file(), &folder.path("")],
    );
    let built_in = built_in();
    let all = built_in.count() + built_in.gearboxes.len() + 1;
    assert!(run.out.contains(&format!(" of {all} ")), "{}", run.out);
}

/// An implausible figure is used with a warning.
#[test]
fn remarks_go_to_the_standard_error() {
    let folder = Folder::new();
    let header = HEADER.replace("[kg cm^2]", "[g cm^2]");
    let file = folder.file("motors.csv", format!("{header}\n{FIRST}\n"));
    let run = jred_of("size {} --motors {} --steps 16", [&press_file(), &file]);
    assert!(run.code < 2, "{}", run.err);
    assert!(
        run.message().contains("less than for any known motor"),
        "{}",
        run.err
    );
    assert!(!run.out.contains("less than for any known motor"));
}
