//! Linkages, springs, dampers and bounded drives in machine files: what they say in SI units, against independent
//! results, and what a user is told about a wrong one.

mod cams;
mod elements;
mod refusals;
mod strokes;
mod trains;
mod values;
mod wheels;

use std::path::Path;

use jred_machine::model::machine::MachineFile;
use jred_machine::read;
use miette::{GraphicalReportHandler, GraphicalTheme, Report};

/// The four-bar of the golden data, as a user would write it: lengths rounded nowhere, angles of the drawing by eye.
const FOUR_BAR: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]

[mechanism]
type = "linkage"
drive = "crank bearing"
ground = { O = ["0 mm", "0 mm"], C = ["300 mm", "0 mm"] }

[[mechanism.body]]
name = "crank"
mass = "0.5 kg"
inertia = "4 kg cm^2"
com = ["30 mm", "-5 mm"]
angle = "0 deg"
points = { A = ["80 mm", "0 mm"] }

[[mechanism.body]]
name = "coupler"
mass = "0.9 kg"
inertia = "0.006 kg m^2"
com = ["110 mm", "40 mm"]
angle = "50 deg"
points = { B = ["250 mm", "0 mm"] }

[[mechanism.body]]
name = "rocker"
mass = "0.7 kg"
inertia = "0.0025 kg m^2"
com = ["85 mm", "10 mm"]
angle = "100 deg"
points = { B = ["180 mm", "0 mm"] }

[[mechanism.joint]]
name = "crank bearing"
between = ["ground.O", "crank"]

[[mechanism.joint]]
name = "crank pin"
between = ["crank.A", "coupler"]

[[mechanism.joint]]
name = "coupler pin"
between = ["coupler.B", "rocker.B"]

[[mechanism.joint]]
name = "rocker bearing"
between = ["ground.C", "rocker"]

[[load]]
on = "rocker"
moment = "-6 N m"
"#;

fn parse(text: &str) -> Result<MachineFile, Report> {
    read::parse("machine.toml", text, Path::new("."))
}

#[track_caller]
fn read(text: &str) -> MachineFile {
    parse(text).unwrap_or_else(|report| panic!("{}", rendered(&report)))
}

/// A file of `machines/`.
fn machine_path(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
}

/// The report as a user sees it, without colours and line breaks.
fn rendered(report: &Report) -> String {
    let mut text = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(1000)
        .render_report(&mut text, report.as_ref())
        .unwrap();
    text
}

/// Checks that `text` is refused with every one of `words`.
#[track_caller]
fn refuses(text: &str, words: &[&str]) {
    let report = match parse(text) {
        Err(report) => rendered(&report),
        Ok(_) => panic!("accepted, though the report should contain {words:?}"),
    };
    if std::env::var_os("SHOW_REPORTS").is_some() {
        println!("{report}");
    }
    for word in words {
        assert!(report.contains(word), "{word:?} is not in\n{report}");
    }
}

/// Reads `base` with the first `from` replaced by `to`, and checks that the report contains every one of `words`.
#[track_caller]
fn refuses_edit(base: &str, from: &str, to: &str, words: &[&str]) {
    refuses(&crate::support::edited(base, from, to), words);
}

#[track_caller]
fn within(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= tolerance,
        "{found} is {error:e} from {expected}, more than {tolerance:e}"
    );
}
