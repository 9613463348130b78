//! `jred size --meter`: limits for the firmware's duty meter.

use crate::support::{Folder, edited_press, jred, press_file};

/// The drive of the source that sizing's tests include.
const DRIVE: &str = "sgmsh-30a+npt025mf-3";

/// To regenerate:
///
/// ```text
/// jred size machines/press.toml --why sgmsh-30a+npt025mf-3 --meter tool/sizing/tests/data/meter_press.rs
/// ```
#[test]
fn the_source_is_what_the_command_writes() {
    let folder = Folder::new();
    let out = folder.path("limits.rs");
    let run = jred([&"size", &press_file(), &"--why", &DRIVE, &"--meter", &out]).ends(0);
    assert!(
        run.out.contains("limits for the duty meter written to"),
        "{}",
        run.out
    );
    let written = std::fs::read_to_string(out).unwrap();
    assert_eq!(
        written,
        include_str!("../../sizing/tests/data/meter_press.rs")
    );
}

#[test]
fn without_a_drive_that_holds_nothing_is_written() {
    let folder = Folder::new();
    let file = folder.file(
        "press.toml",
        edited_press("[motion]", "[rules]\nrms_torque = 0.001\n\n[motion]"),
    );
    let out = folder.path("limits.rs");
    let run = jred([&"size", &file, &"--meter", &out]).ends(1);
    run.says(&["no drive satisfies every rule", "is not written", "--why"]);
    assert!(!out.exists());
    // For a drive that violates rules it is written only if named.
    let run = jred([&"size", &file, &"--why", &DRIVE, &"--meter", &out]).ends(1);
    // Not as an approved drive: file and stderr name the violations with figures.
    run.says(&["violates rules (RMS torque", "does not make it acceptable"]);
    let source = std::fs::read_to_string(&out).unwrap();
    let header: Vec<&str> = source
        .lines()
        .take_while(|line| line.starts_with("//"))
        .collect();
    assert!(
        header
            .iter()
            .any(|l| l.contains("THIS DRIVE VIOLATES RULES")),
        "{source}"
    );
    let violated: Vec<&&str> = header.iter().filter(|l| l.contains("violated:")).collect();
    assert!(
        violated.len() == 1
            && violated[0].starts_with("// violated: RMS torque ")
            && violated[0].ends_with(", > 1000 %"),
        "{violated:?}"
    );
    // The machine file is never overwritten.
    let run = jred([&"size", &file, &"--why", &DRIVE, &"--meter", &file]).ends(2);
    run.says(&["read by this command"]);
}
