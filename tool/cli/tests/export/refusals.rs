//! Messages of `jred export` without a table, verbatim.

use super::{export_of, number_after};
use crate::support::{Folder, edited_press, press_file, shipped, typed};

/// Parts that follow the motion cannot be in a table over the position.
#[test]
fn what_goes_by_the_motion_is_refused() {
    let lift = shipped("pick-and-place.toml");
    let run = export_of(&lift, &["--torque-error", "1 N m"], None).ends(2);
    run.says(&[
        "load \"suction cup pressed on the part\" acts in segment 1: that goes by [motion], and a table is over the position",
        "remove its segments or during, for this command",
    ]);
}

/// A request that the table is too coarse for fails with the number of cells that meets it; the machine is valid.
#[test]
fn a_table_too_coarse_names_the_cells() {
    let coarse = typed("--type i16 --max-cells 4 --torque-error '50 N m'");
    let reciprocal = typed("--type i16 --reciprocal yes --max-cells 8 --torque-error '50 N m'");
    for (name, asked) in [
        ("four-bar.toml", &coarse[..]),
        ("cam-translating.toml", &reciprocal),
        ("geneva.toml", &reciprocal),
        ("load-table.toml", &reciprocal),
        ("six-link.toml", &reciprocal),
    ] {
        let file = shipped(name);
        let run = export_of(&file, asked, None).ends(1);
        let most = asked[if asked.len() > 6 { 5 } else { 3 }];
        run.says(&[
            &format!("no i16 table of up to {most} cells is usable: that is too coarse"),
            "in the table, not in the machine",
            "use --max-cells ",
        ]);
        // That number of cells gives a table.
        let message = run.message();
        let cells = message.split_once("use --max-cells ").unwrap().1;
        let cells: String = cells.chars().take_while(char::is_ascii_digit).collect();
        let with: Vec<&str> = asked
            .iter()
            .map(|word| if *word == most { cells.as_str() } else { word })
            .collect();
        let again = export_of(&file, &with, None);
        assert!(
            !again.message().contains("too coarse"),
            "{name}: {}",
            again.err
        );
    }
}

#[test]
fn too_few_cells_name_the_load_and_the_cures() {
    let more = typed("--torque-error '0.5 N m' --max-cells 60 --layout spline");
    let run = export_of(&press_file(), &more, None).ends(1);
    run.says(&[
        "no table meets a torque error of 0.5 N m: type f32, up to 60 cells",
        "spline: ",
        " cells reach ",
        "the error falls with the number of cells to the power of ",
        "; at this rate, --max-cells ",
        " would be enough",
        "the largest error is at φ = ",
        "the load \"pressing force\"",
        "over a ramp of 15 deg",
        "increase the allowed error, or --max-cells ",
        "or a longer ramp of the load \"pressing force\" in the machine file",
    ]);
    assert!(run.out.is_empty());
    // The number of cells in the message is sufficient.
    let message = run.message();
    let cells = message.split_once("--max-cells ").unwrap().1;
    let cells: String = cells.chars().take_while(char::is_ascii_digit).collect();
    let line = format!("--torque-error '0.5 N m' --max-cells {cells} --layout spline");
    let more = typed(&line);
    export_of(&press_file(), &more, None).ends(0);
}

/// A ramp causes the bend: with a longer one the same number of cells is sufficient.
#[test]
fn the_ramp_is_a_cure() {
    let folder = Folder::new();
    let longer = folder.file(
        "ramp.toml",
        edited_press("ramp = \"15 deg\"", "ramp = \"22 deg\""),
    );
    let more = typed("--torque-error '0.5 N m' --max-cells 96 --layout spline");
    export_of(&press_file(), &more, None).ends(1);
    export_of(&longer, &more, None).ends(0);
}

#[test]
#[ignore = "more than five seconds of a processor"]
fn the_floor_of_single_precision_is_named_with_what_is_below_it() {
    let more = ["--torque-error", "0.00001 N m"];
    let run = export_of(&press_file(), &more, None).ends(1);
    run.says(&[
        "no table meets a torque error of 1.00000e-5 N m: type f32, up to 4096 cells",
        "cubic: ",
        "this is the rounding floor of f32: more cells do not lower it",
        "increase the allowed error",
        "or give a smaller range with --omega and --alpha",
    ]);
    // 16 bits fail by far; the cure in the message works.
    let more = ["--torque-error", "0.02 N m", "--type", "i16"];
    let run = export_of(&press_file(), &more, None).ends(1);
    run.says(&[
        "rows: ",
        "this is the rounding floor of i16",
        "or take --type f32 (",
        "or take --type i32 (",
    ]);
    for number in ["f32", "i32"] {
        export_of(
            &press_file(),
            &["--torque-error", "0.02 N m", "--type", number],
            None,
        )
        .ends(0);
    }
}

#[test]
fn another_layout_is_offered_where_it_does() {
    let more = typed("--torque-error '0.5 N m' --layout quadratic --max-cells 120");
    let run = export_of(&press_file(), &more, None).ends(1);
    run.says(&[
        "quadratic: ",
        "or take --layout spline (",
        " cells, ",
        " bytes)",
    ]);
    assert!(!run.message().contains("cubic: "), "{}", run.message());
}

#[test]
fn a_kink_of_the_mechanism_is_named() {
    let geneva = shipped("geneva.toml");
    let more = typed("--torque-error '0.0001 N m' --omega '60 rpm' --max-cells 200");
    let run = export_of(&geneva, &more, None).ends(1);
    // The pin enters a slot at ±60 degrees, and the wheel's acceleration jumps.
    let message = run.message();
    assert!(
        message.contains("J_red' has a kink at φ = 300 deg")
            || message.contains("J_red' has a kink at φ = 60 deg"),
        "{message}"
    );
}

#[test]
fn bytes_that_are_too_few() {
    let run = export_of(&press_file(), &["--max-bytes", "100"], None).ends(2);
    run.says(&[
        "no f32 table fits into 100 bytes: the smallest image takes 184 bytes",
        "allow more bytes",
    ]);
}

#[test]
fn forward_dynamics_has_a_reciprocal_in_fixed_point() {
    let summary = |more: &[&str]| {
        let all: Vec<&str> = ["--torque-error", "2 N m"]
            .iter()
            .chain(more)
            .copied()
            .collect();
        export_of(&press_file(), &all, None).ends(0).out.clone()
    };
    for (more, curve, said) in [
        (&["--type", "i32"][..], false, None),
        (
            &["--type", "i32", "--forward"],
            true,
            Some("without a division"),
        ),
        (
            &["--type", "i16", "--forward", "--reciprocal", "no"],
            false,
            Some("divides by J; --reciprocal auto"),
        ),
        (
            &["--forward"],
            false,
            Some("divides by J, in single precision"),
        ),
    ] {
        let found = summary(more);
        assert_eq!(found.contains(", reciprocal"), curve, "{found}");
        assert_eq!(
            found.contains("forward dynamics: "),
            said.is_some(),
            "{found}"
        );
        assert!(said.is_none_or(|said| found.contains(said)), "{found}");
    }
}

#[test]
fn a_reciprocal_of_floating_point() {
    let more = ["--torque-error", "1 N m", "--reciprocal", "yes"];
    let run = export_of(&press_file(), &more, None).ends(2);
    run.says(&[
        "f32 tables have no curve of 1/J: in floating point, the tick divides",
        "remove --reciprocal, or use --type i32",
    ]);
}

#[test]
fn a_layout_that_the_type_has_not() {
    for (number, layout) in [
        ("f32", "spline16"),
        ("f32", "rows"),
        ("i16", "spline"),
        ("i32", "rows"),
    ] {
        let line = format!("--torque-error '1 N m' --type {number} --layout {layout}");
        let more = typed(&line);
        let run = export_of(&press_file(), &more, None).ends(2);
        run.says(&[
            &format!("{number} tables have no layout {layout}"),
            "--layout",
        ]);
    }
}

/// A sliding drive link has forces and speeds in m/s.
#[test]
fn quantities_of_a_link_that_slides() {
    let hoist = shipped("excavator-bucket.toml");
    export_of(&hoist, &["--torque-error", "100 N"], None).ends(0);
    let run = export_of(&hoist, &["--torque-error", "100 N m"], None).ends(2);
    run.says(&["--torque-error \"100 N m\" cannot be used", "N"]);
    let run = export_of(
        &hoist,
        &["--torque-error", "100 N", "--omega", "60 rpm"],
        None,
    )
    .ends(2);
    run.says(&["--omega \"60 rpm\" cannot be used", "m/s"]);
    let run = export_of(
        &press_file(),
        &["--torque-error", "1 N m", "--alpha", "3 m/s^2"],
        None,
    );
    run.ends(2).says(&["--alpha \"3 m/s^2\" cannot be used"]);
}

/// A load over a thousandth of a degree between all even positions: the error includes it, and the message reports it.
#[test]
fn a_narrow_load_is_not_stepped_over() {
    let folder = Folder::new();
    let text = edited_press(
        "between = [\"315 deg\", \"360 deg\"]",
        "between = [\"300 deg\", \"300.001 deg\"]",
    );
    let text = text.replace("ramp = \"15 deg\"", "ramp = \"0.0004999995 deg\"");
    let file = folder.file("narrow.toml", &text);
    let run = export_of(&file, &["--torque-error", "20 N m"], None).ends(1);
    run.says(&[
        "cells reach 281.7 N m; more cells hardly lower it",
        "the largest error is at φ = 300.0005 deg: the load \"pressing force\"",
        "or a longer ramp of the load \"pressing force\"",
    ]);
    // With an allowed error of twice the load's height every table is accepted.
    let run = export_of(&file, &["--torque-error", "300 N m"], None).ends(0);
    let reached = number_after(&run.out, "torque error reached ");
    assert!((280.0..300.0).contains(&reached), "{reached}");
    // A ramp too steep for any table is refused in the machine file.
    let steeper = folder.file(
        "steeper.toml",
        text.replace("0.0004999995 deg", "0.0003 deg"),
    );
    export_of(&steeper, &["--torque-error", "20 N m"], None)
        .ends(2)
        .says(&[
            "is 0.0003 deg, as steep as a jump",
            "write at least 0.00036 deg, a millionth of the drive link's range",
        ]);
}

#[test]
fn pieces_that_are_not_possible() {
    let folder = Folder::new();
    let gripper = shipped("linear-gripper.toml");
    let plain = shipped("planetary.toml");
    let refused = |file: &std::path::Path, more: &[&str], words: &[&str]| {
        let more = [&["--torque-error", "2 N m"], more].concat();
        export_of(file, &more, None).ends(2).says(words);
    };
    let press = press_file();
    let out = folder.path("table.jred");
    let more = ["--torque-error", "2 N m", "--pieces", "auto"];
    let run = export_of(&press, &more, Some(&out)).ends(2);
    run.says(&[
        "one image cannot hold the tables of several pieces",
        "--format rust, c or json",
    ]);
    assert!(!out.exists());
    refused(
        &press,
        &["--pieces", "10 deg, 5 mm"],
        &["--pieces", "\"5 mm\"", "or auto"],
    );
    refused(
        &press,
        &["--pieces", "60 deg, 75 deg, 420 deg"],
        &["\"420 deg\" is the same place as \"60 deg\"; name each place once"],
    );
    refused(
        &press,
        &["--pieces", "10 deg, 10.004 deg"],
        &[
            "the piece from φ = 10 deg to φ = 10.004 deg is shorter than 0.005493 deg, 1/65536 of the range",
        ],
    );
    refused(
        &press,
        &["--pieces", "auto", "--max-bytes", "900"],
        &["cannot be used with"],
    );
    refused(
        &plain,
        &["--pieces", "auto", "--omega", "1 rad/s"],
        &[
            "no disc cam and no Geneva drive, so there are no edges for --pieces auto",
            "--pieces \"60 deg, 75 deg\"",
        ],
    );
    let outside = ["--torque-error", "2 N", "--pieces", "1 m"];
    export_of(&gripper, &outside, None)
        .ends(2)
        .says(&["\"1 m\": it must lie within the stroke, "]);
    let both = ["--layout", "harmonic", "--pieces", "auto"];
    refused(
        &press,
        &both,
        &["harmonics describe a whole turn", "remove --pieces"],
    );
    // The machine units of i32 depend on the width of a cell; these pieces have none in common.
    let irrational = ["--type", "i32", "--pieces", "0 deg, 0.0582492235949962 deg"];
    refused(
        &press,
        &irrational,
        &["for i32 go with the width of a cell", "--type f32"],
    );
}
