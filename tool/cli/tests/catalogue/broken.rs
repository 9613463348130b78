//! Catalogues with broken rows: messages to the user.

use std::fmt::Write as _;

use super::{refuses, size_with};
use crate::support::catalogue::{FIRST, HEADER};
use crate::support::{Folder, jred, jred_of, press_file};

#[test]
fn each_with_its_place() {
    let mut text = format!("{HEADER}\n");
    for row in 0..14 {
        writeln!(
            text,
            "m{row},Maker,Model,{},2000,36,8.5,Sheet",
            if row == 1 { 8 } else { -8 }
        )
        .unwrap();
    }
    let run = size_with(&text).ends(2);
    run.says(&[
        "13 rows of the catalogue cannot be used",
        "the first 10 are shown",
        "--skip-broken-rows",
    ]);
    for row in [0, 2, 9, 10] {
        let place = format!("m.csv:{}:{}]", row + 2, if row < 10 { 16 } else { 17 });
        assert!(run.err.contains(&place), "{place} is not in\n{}", run.err);
    }
    assert!(
        !run.message().contains("m.csv:13:"),
        "more than ten are shown: {}",
        run.err
    );
    let folder = Folder::new();
    let file = folder.file("m.csv", text);
    let run = jred_of(
        "size {} --motors {} --skip-broken-rows --steps 16",
        [&press_file(), &file],
    );
    assert!(
        run.message()
            .contains("13 broken rows of the catalogue skipped"),
        "{}",
        run.err
    );
    let all = super::built_in().gearboxes.len() + 1;
    assert!(run.out.contains(&format!(" of {all} ")), "{}", run.out);
}

#[test]
fn the_header_again() {
    refuses(
        &format!("{HEADER}\n{FIRST}\n{HEADER}\n"),
        Some((3, 1)),
        &["duplicate header", "remove this line"],
    );
}

/// Byte order marks and line ends of spreadsheets do not shift the position shown.
#[test]
fn places_behind_marks_and_other_line_ends() {
    for text in [
        format!("{HEADER}\r\n{FIRST}\r\nm2,Maker,Model,-9,2000,36,8.5,Sheet\r\n"),
        format!("\u{feff}{HEADER}\n{FIRST}\nm2,Maker,Model,-9,2000,36,8.5,Sheet\n"),
    ] {
        refuses(&text, Some((3, 16)), &["rated_torque of \"m2\" is \"-9\""]);
    }
    refuses(
        &format!(
            "\u{feff}{}\n{FIRST}\n",
            HEADER.replace("rated_torque", "torque")
        ),
        None,
        &["unknown column \"torque\""],
    );
}

#[test]
fn files_and_folders_that_hold_nothing() {
    let folder = Folder::new();
    let refused = |path: &std::path::Path, words: &[&str]| {
        jred([&"size", &press_file(), &"--catalogue", &path])
            .ends(2)
            .says(words);
    };
    refused(
        &folder.path("none"),
        &[
            "cannot read the catalogue",
            "no such file or folder",
            "--catalogue",
        ],
    );
    refused(
        &folder.path(""),
        &["this folder contains no table", "motors.csv"],
    );
    let file = folder.file("drives.csv", format!("{HEADER}\n{FIRST}\n"));
    refused(
        &file,
        &["its name does not say what it contains", "motors.csv"],
    );
    folder.file("gearboxes.csv", "");
    refused(&folder.path(""), &["is empty", "gearboxes"]);
    // A header without rows is a table that is not filled in yet.
    folder.file("gearboxes.csv", "key,maker\n");
    refused(&folder.path(""), &["is empty", "contains no motors"]);
    std::fs::remove_file(folder.path("gearboxes.csv")).unwrap();
    folder.file("list.toml", "");
    refused(&folder.path(""), &["is empty"]);
    folder.file("list.toml", "[[resistor]]\nkey = \"r\"\nmaker = \"M\"\nmodel = \"M\"\nresistance = \"9 Ohm\"\nrated_power = \"9 W\"\nsource = \"S\"\n");
    refused(&folder.path(""), &["is empty", "motors"]);
    // A table with an unknown name is reported as ignored.
    folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    let run = jred_of(
        "size {} --catalogue {} --steps 16",
        [&press_file(), &folder.path("")],
    );
    assert!(
        run.message().contains("drives.csv was ignored"),
        "{}",
        run.err
    );
}
