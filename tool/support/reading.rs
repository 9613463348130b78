//! Machine texts read, and the report on one that is refused; the packages that use it name their `reader`.
#![allow(dead_code)]

use std::path::{Path, PathBuf};

use jred_file::model::machine::MachineFile;
use jred_file::text::problem::Problem;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

use crate::reader;
use crate::support::{edited, phrases, rows};

/// The folder of the tests' own files.
pub(crate) fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../file/tests/data")
}

/// A file of `machines/`.
pub(crate) fn machine_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
}

/// A file of `machines/`, read.
pub(crate) fn machine(name: &str) -> MachineFile {
    reader::read(&machine_path(name)).unwrap_or_else(|report| panic!("{}", rendered(&report)))
}

/// Its text.
pub(crate) fn text_of(name: &str) -> String {
    std::fs::read_to_string(machine_path(name)).unwrap()
}

/// Reads a text as a file of [`data`].
pub(crate) fn parse(text: &str) -> Result<MachineFile, Problem> {
    parse_in(text, &data())
}

pub(crate) fn parse_as(name: &str, text: &str) -> Result<MachineFile, Problem> {
    reader::parse(name, text, data())
}

/// Reads a text as a file of `folder`.
pub(crate) fn parse_in(text: &str, folder: &Path) -> Result<MachineFile, Problem> {
    reader::parse("machine.toml", text, folder)
}

/// Reads a text with files beside it; the report without graphics.
pub(crate) fn parse_with(machine: &str, files: &[(&str, &str)]) -> Result<MachineFile, String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    reader::parse("machine.toml", machine, folder.path()).map_err(|report| {
        let mut text = String::new();
        miette::NarratableReportHandler::new()
            .render_report(&mut text, &report)
            .unwrap();
        text
    })
}

#[track_caller]
pub(crate) fn read(text: &str) -> MachineFile {
    parse(text).unwrap_or_else(|report| panic!("{}", rendered(&report)))
}

/// The report as a user sees it, without colours and line breaks.
pub(crate) fn rendered(report: &dyn Diagnostic) -> String {
    rendered_in(report, 1000)
}

pub(crate) fn rendered_in(report: &dyn Diagnostic, width: usize) -> String {
    let mut text = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(width)
        .render_report(&mut text, report)
        .unwrap();
    text
}

/// Checks that `text` is refused with every one of `words`.
#[track_caller]
pub(crate) fn refuses(text: &str, words: &[&str]) {
    let report = match parse(text) {
        Err(report) => rendered(&report),
        Ok(_) => panic!("accepted, though the report should contain {words:?}"),
    };
    says(&report, words);
}

/// Reads `base` with the first `from` replaced by `to`, and checks that the report contains every one of `words`.
#[track_caller]
pub(crate) fn refuses_edit(base: &str, from: &str, to: &str, words: &[&str]) {
    refuses(&edited(base, from, to), words);
}

/// The same for a table of edits ([`rows`]): a text, its replacement, and what the report must contain ([`phrases`]).
#[track_caller]
pub(crate) fn refuses_edits(base: &str, edits: &str) {
    for [from, to, words] in rows(edits) {
        println!("{from} => {to}");
        refuses_edit(base, &from, &to, &phrases(&words));
    }
}

/// Checks that a report contains every one of `words`; `SHOW_REPORTS=1` prints it.
#[track_caller]
pub(crate) fn says(report: &str, words: &[&str]) {
    if std::env::var_os("SHOW_REPORTS").is_some() {
        println!("{report}");
    }
    for word in words {
        assert!(report.contains(word), "{word:?} is not in\n{report}");
    }
}

/// The text of a belt drive, whose drive link turns without end, with what follows.
pub(crate) fn belt_drive(rest: &str) -> String {
    format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
         driver = {{ radius = \"2 cm\", inertia = \"1 kg cm^2\" }}\n\
         driven = {{ radius = \"5 cm\", inertia = \"6 kg cm^2\" }}\n{rest}"
    )
}

/// The same with a motion of segments, in which `; ` is a line break.
pub(crate) fn belt_motion(kind: &str, segments: &[&str]) -> String {
    let segments = segments.iter();
    let segments =
        segments.map(|keys| format!("[[motion.segment]]\n{}\n", keys.replace("; ", "\n")));
    let segments: String = segments.collect();
    belt_drive(&format!("[motion]\ntype = \"{kind}\"\n{segments}"))
}

/// The text of a slider-crank of 90 mm and 300 mm in oblique gravity, with the mass of its slider and what follows.
pub(crate) fn oblique_slider_crank(slider: &str, rest: &str) -> String {
    format!(
        "gravity = [\"3 m/s^2\", \"-9 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\n\
         crank = {{ length = \"90 mm\", mass = \"1 kg\", inertia = \"20 kg cm^2\" }}\n\
         rod = {{ length = \"300 mm\", mass = \"0.8 kg\", inertia = \"80 kg cm^2\", com = [\"120 mm\", \"0 mm\"] }}\n\
         slider = {{ mass = \"{slider}\" }}\n{rest}"
    )
}

/// A file of `machines/` with another motion, in which `; ` is a line break.
pub(crate) fn with_motion(name: &str, motion: &str) -> String {
    let text = text_of(name);
    let head = text.split("\n[motion]").next().unwrap();
    format!("{head}\n[motion]\n{}\n", motion.replace("; ", "\n"))
}

/// A table of an inertia (kg·m²) and a friction (N·m) behind a pair of gears, of which 20 teeth drive so many; what is left of the stage and of the file
/// follows.
pub(crate) fn table_behind_gears(
    [inertia, friction]: [f64; 2],
    driven: u32,
    rest: &str,
) -> MachineFile {
    parse(&format!(
        r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
[mechanism.table]
mass = "1 kg"
inertia = "{inertia} kg m^2"
[[load]]
on = "table"
opposing_moment = "{friction} N m"
[[drive_train]]
type = "gear-train"
[[drive_train.stage]]
driver = {{ teeth = 20, inertia = "0 kg m^2" }}
driven = {{ teeth = {driven}, inertia = "0 kg m^2" }}
{rest}"#
    ))
    .unwrap()
}

/// All files of `machines/`.
pub(crate) fn machines() -> Vec<(PathBuf, MachineFile)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    paths.sort();
    assert!(paths.len() >= 5, "{paths:?}");
    let read = |path: PathBuf| {
        let file = reader::read(&path).unwrap_or_else(|e| panic!("{}: {e:?}", path.display()));
        (path, file)
    };
    paths.into_iter().map(read).collect()
}
