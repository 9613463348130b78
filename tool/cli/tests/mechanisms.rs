//! Machine files of the library mechanisms: what they say in SI units, and what a user is told about a wrong one.

mod ball_screw;
mod disc_cam;
mod four_bar;
mod geneva;
mod hoist;
mod inverted_slider_crank;
mod parallel_shafts;
mod planetary;
mod rack;
mod scotch_yoke;
mod six_link;
mod toggle_press;

use std::path::{Path, PathBuf};

use jred_machine::model::machine::MachineFile;
use jred_machine::read;
use miette::{GraphicalReportHandler, GraphicalTheme, Report};

/// A file of `machines/`.
fn machine_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
}

/// A file of `machines/`, read.
fn machine(name: &str) -> MachineFile {
    read::read(&machine_path(name)).unwrap_or_else(|report| panic!("{}", rendered(&report)))
}

fn parse(text: &str) -> Result<MachineFile, Report> {
    read::parse("machine.toml", text, Path::new("."))
}

/// The one whole example of a document.
fn example(document: &'static str) -> &'static str {
    let mut blocks = document.split("\n```toml\n").skip(1);
    let block = blocks.next().and_then(|rest| rest.split("\n```").next());
    assert!(blocks.next().is_none(), "one example a document");
    block.unwrap()
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

/// Reads `base` with `from` replaced by `to`, and checks that the report contains every one of `words`.
#[track_caller]
fn refuses_edit(base: &str, from: &str, to: &str, words: &[&str]) {
    assert!(base.contains(from), "the example has no {from}");
    let report = match parse(&base.replacen(from, to, 1)) {
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

#[track_caller]
fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= 1e-12 * expected.abs().max(1e-3),
        "{found} is not {expected}"
    );
}

/// The machine file can be reduced and sized, and a drive is found that keeps every rule.
fn a_drive_is_found(name: &str) {
    let path = machine_path(name);
    crate::support::jred([&"reduce", &path]).ends(0);
    crate::support::jred([&"size", &path]).ends(0);
}
