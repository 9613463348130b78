//! The commands with the machines of `machines/`, and with machines for some commands only.

use std::path::PathBuf;

use crate::support::machines::{LIFT, LIFT_MOTION, SCREW, SHAFTS};
use crate::support::{Folder, jred, jred_of};

fn machine(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
}

/// The machine of every mechanism can be reduced and sized, and some drive satisfies every rule.
#[test]
fn a_drive_is_found() {
    for name in [
        "ball-screw.toml",
        "belt-axis.toml",
        "belt-conveyor.toml",
        "cam-oscillating.toml",
        "cam-translating.toml",
        "drawing-press.toml",
        "elliptic-drive.toml",
        "feed-roll.toml",
        "flying-shear.toml",
        "four-bar.toml",
        "geneva.toml",
        "hoist.toml",
        "indexing-cam.toml",
        "parallel-lift.toml",
        "parallel-shafts.toml",
        "planetary.toml",
        "rack.toml",
        "rotary-table.toml",
        "scotch-yoke.toml",
        "shaper.toml",
        "six-link.toml",
        "toggle-press.toml",
        "vertical-axis.toml",
        "whitworth.toml",
        "winder.toml",
        "linkage-four-bar.toml",
        "linkage-press.toml",
        "linkage-planetary.toml",
        "line-shaft.toml",
        "friction-fan.toml",
    ] {
        jred([&"reduce", &machine(name)]).ends(0);
        jred([&"size", &machine(name)]).ends(0);
    }
    jred([&"check", &machine("friction-fan.toml")]).ends(0);
}

/// The figures of the document: because of the corner of J′ the error falls with the first power of the number of cells.
#[test]
fn tables_need_as_many_cells_as_documented() {
    let doc = include_str!("../../../docs/mechanisms/geneva.md");
    let folder = Folder::new();
    for (error, cells) in [("0.1", 66), ("0.01", 797)] {
        let asked = format!("{error} N m");
        let (path, out) = (machine("geneva.toml"), folder.path("table.img"));
        let run = jred_of(
            "export {} --torque-error {} --layout spline --out {}",
            [&path, &asked, &out],
        )
        .ends(0);
        assert!(run.out.contains(&format!("{cells} cells")), "{}", run.out);
        assert!(
            doc.contains(&format!("{cells} cells for {error} N·m")),
            "{cells}"
        );
    }
    let path = machine("geneva.toml");
    let run = jred_of(
        "export {} --torque-error '0.01 N m' --layout spline --pieces auto",
        [&path],
    )
    .ends(0);
    assert!(run.out.contains("layout spline, 39 cells"), "{}", run.out);
    assert!(doc.contains("39 cells for 0.01 N·m in two pieces"));
}

/// A cylinder is driven by a motor through a screw.
#[test]
fn a_ball_screw_lets_a_motor_turn() {
    let text = format!("{LIFT}{SCREW}{LIFT_MOTION}");
    let folder = Folder::new();
    let sized = jred([&"size", &folder.file("lift.toml", &text)]);
    assert!(sized.code < 2, "{}", sized.err);
    let direct = jred([
        &"size",
        &folder.file("direct.toml", format!("{LIFT}{LIFT_MOTION}")),
    ])
    .ends(2);
    assert!(
        direct
            .message()
            .contains("the drive link slides, but the catalogue contains rotary motors only"),
        "{}",
        direct.message()
    );
    let file = folder.file("lift.toml", &text);
    let out = folder.path("table.bin");
    let exported = jred([&"export", &file, &"--out", &out, &"--torque-error", &"5 N"]);
    assert!(
        exported.code < 2 && (exported.code == 1 || exported.out.contains("force error reached")),
        "{} {}",
        exported.out,
        exported.err
    );
}

#[test]
fn the_excavator_is_sized() {
    let path = machine("excavator-bucket.toml");
    jred([&"reduce", &path]).ends(0);
    let run = jred([&"size", &path]);
    assert!(run.code < 2, "{}", run.err);
    jred([&"simulate", &path]).ends(0);
}

/// A prescribed motion that would need a rope to push.
#[test]
fn a_rope_in_too_fast_a_cycle() {
    let text = std::fs::read_to_string(machine("hoist.toml")).unwrap();
    let folder = Folder::new();
    let file = folder.file(
        "fast.toml",
        text.replace("duration = \"8 s\"", "duration = \"1 s\""),
    );
    for command in ["check", "size"] {
        let run = jred([&command, &file]).ends(2);
        run.says(&["the rope of the ", "goes slack in the prescribed motion"]);
    }
}

/// A variator has no table: its ratio changes with time.
#[test]
fn commands_that_need_a_table_are_refused() {
    let folder = Folder::new();
    let path = machine("variator-press.toml");
    let out = folder.path("table.bin");
    let why = ["its ratio changes with time", "jred simulate", "holonomic"];
    jred([&"reduce", &path]).ends(2).says(&why);
    jred([&"size", &path]).ends(2).says(&why);
    jred_of("export {} --torque-error '1 N m' --out {}", [&path, &out])
        .ends(2)
        .says(&why);
    let (before, _) = SHAFTS.split_once("[[variator.shift]]").unwrap();
    let constant = folder.file("constant.toml", before);
    jred([&"reduce", &constant])
        .ends(2)
        .says(&["[[drive_train]]", "constant ratio as a stage"]);
}
