//! Machine files: what they say in SI units, and what a user is told about a wrong one.

mod documented;
mod files;
mod profiles;
mod refusals;
mod values;

use std::path::{Path, PathBuf};

use jred_machine::model::machine::MachineFile;
use jred_machine::read;
use miette::{GraphicalReportHandler, GraphicalTheme, Report};

const PRESS: &str = include_str!("data/press.toml");
const GEARS: &str = include_str!("data/gear-train.toml");

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")
}

fn parse(text: &str) -> Result<MachineFile, Report> {
    parse_as("machine.toml", text)
}

fn parse_as(name: &str, text: &str) -> Result<MachineFile, Report> {
    read::parse(name, text, data())
}

/// The report as a user sees it, without colours.
fn rendered(report: &Report) -> String {
    rendered_in(report, 1000)
}

fn rendered_in(report: &Report, width: usize) -> String {
    let mut text = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(width)
        .render_report(&mut text, report.as_ref())
        .unwrap();
    text
}

/// Reads `base` with `from` replaced by `to`, and checks that the report contains every one of `words`.
fn refuses_edit(base: &str, from: &str, to: &str, words: &[&str]) {
    assert!(base.contains(from), "the example has no {from}");
    refuses(&base.replacen(from, to, 1), words);
}

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

fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= 1e-15 * expected.abs().max(1e-3),
        "{found} is not {expected}"
    );
}

#[test]
fn random_damage_never_panics() {
    let mut state = 7_u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let spare: Vec<char> = "\"[]{}=.,-+e0919 \n#kmNs^/%²é\u{0}\u{feff}"
        .chars()
        .collect();
    for round in 0..500 {
        let base = if round % 3 == 0 { GEARS } else { PRESS };
        let mut text: Vec<char> = base.chars().collect();
        for _ in 0..=random(4) {
            let at = random(text.len());
            match random(4) {
                0 => drop(text.remove(at)),
                1 => text[at] = spare[random(spare.len())],
                2 => text.insert(at, spare[random(spare.len())]),
                _ => drop(text.drain(at..(at + random(60)).min(text.len()))),
            }
        }
        let text: String = text.into_iter().collect();
        if let Err(report) = parse(&text) {
            assert!(rendered(&report).len() > 20);
        }
    }
}
