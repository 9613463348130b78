//! Catalogues with broken rows: all of them found in one pass, the first few shown, the others usable.

use std::fmt::Write as _;

use jred_sizing::catalogue::{Catalogue, CatalogueError, SHOWN, Sources};

use super::{FIRST, HEADER, refuses, size_with};
use crate::support::{Folder, jred, press_file};

const ROWS: usize = 100_000;

/// A large table, every seventh row broken in one of several ways.
fn large() -> (String, usize) {
    let mut text = format!("{HEADER}\n");
    let mut broken = 0;
    for row in 0..ROWS {
        let good = format!("m{row},Maker,Model,8,2000,36,8.5,\"Sheet, page {row}\"\n");
        if row % 7 != 3 {
            text += &good;
            continue;
        }
        broken += 1;
        let bad = match broken % 5 {
            0 => good.replace(",8,", ",eight,"),
            1 => good.replace(",36,", ",3,"),
            2 => good.replace(",Maker,", ",,"),
            3 => good.replace(",8.5,", ",-8.5,"),
            _ => good.replace(",8.5,", ","),
        };
        text += &bad;
    }
    (text, broken)
}

#[test]
fn a_large_catalogue_with_broken_rows() {
    let (text, broken) = large();
    let folder = Folder::new();
    folder.file("motors.csv", text);
    let mut sources = Sources {
        catalogues: vec![folder.path("")],
        ..Sources::default()
    };
    let start = std::time::Instant::now();
    let Err(CatalogueError::Several(several)) = Catalogue::open(&sources) else {
        panic!("several faults were expected");
    };
    println!("refused after {:?}", start.elapsed());
    assert_eq!(several.rows, broken);
    assert_eq!(several.shown.len(), SHOWN);
    sources.skip_broken_rows = true;
    let start = std::time::Instant::now();
    let catalogue = Catalogue::open(&sources).unwrap();
    println!("read in {:?}", start.elapsed());
    assert_eq!(catalogue.left_out, broken);
    assert_eq!(catalogue.motors.len(), ROWS - broken);
    assert!(
        catalogue
            .warnings
            .iter()
            .any(|w| w.contains(&format!("{broken} broken rows")))
    );
    assert!(catalogue.motors.iter().all(|m| m.rated_torque == Some(8.0)));
}

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
        !run.err.contains("m.csv:13:"),
        "more than ten are shown: {}",
        run.err
    );
    let folder = Folder::new();
    let file = folder.file("m.csv", text);
    let run = jred([
        &"size",
        &press_file(),
        &"--motors",
        &file,
        &"--skip-broken-rows",
        &"--steps",
        &"16",
    ]);
    assert!(
        run.err.contains("13 broken rows of the catalogue skipped"),
        "{}",
        run.err
    );
    let all = super::built_in().gearboxes.len() + 1;
    assert!(run.out.contains(&format!(" of {all} ")), "{}", run.out);
}

/// A list may go on naming what was left out; what was never there is a fault all the same.
#[test]
fn lists_that_name_broken_rows() {
    let folder = Folder::new();
    let gearbox = "key,maker,model,ratio,rated_output_torque [N m],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source\n\
                   g1,M,G,3,50,6000,1,97,S\ng2,M,G,0,50,6000,1,97,S\n";
    folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    folder.file("gearboxes.csv", gearbox);
    folder.file("compatibility.csv", "motor,gearboxes\nm1,g1;g2;g3\n");
    let catalogue = Catalogue::open(&Sources {
        catalogues: vec![folder.path("")],
        skip_broken_rows: true,
        ..Sources::default()
    })
    .unwrap();
    assert_eq!(catalogue.count(), 2);
    assert_eq!(catalogue.left_out, 2);
}

#[test]
fn the_header_again() {
    refuses(
        &format!("{HEADER}\n{FIRST}\n{HEADER}\n"),
        Some((3, 1)),
        &["duplicate header", "remove this line"],
    );
}

/// Marks and line ends that spreadsheets write do not shift the place shown.
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
    folder.file("gearboxes.csv", "key,maker\n");
    refused(&folder.path(""), &["is empty", "gearboxes"]);
    std::fs::remove_file(folder.path("gearboxes.csv")).unwrap();
    folder.file("list.toml", "");
    refused(&folder.path(""), &["is empty"]);
    folder.file("list.toml", "[[resistor]]\nkey = \"r\"\nmaker = \"M\"\nmodel = \"M\"\nresistance = \"9 Ohm\"\nrated_power = \"9 W\"\nsource = \"S\"\n");
    refused(&folder.path(""), &["is empty", "motors"]);
    // A table whose name says nothing is said to be left aside.
    folder.file("motors.csv", format!("{HEADER}\n{FIRST}\n"));
    let run = jred([
        &"size",
        &press_file(),
        &"--catalogue",
        &folder.path(""),
        &"--steps",
        &"16",
    ]);
    assert!(run.err.contains("drives.csv was ignored"), "{}", run.err);
}
