//! The JSON of every command follows its schema in `docs/schemas`, which is generated from the types.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::support::schema::{VALIDATORS, faults};
use crate::support::{Run, jred_with, press_file};
use jred_report::schemas;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schemas")
}

/// `jred-size/4` is in `size.json`.
fn file_of(form: &str) -> PathBuf {
    let name = form.trim_start_matches("jred-");
    let name = name.split('/').next().unwrap();
    folder().join(format!("{name}.json"))
}

/// With `JRED_BLESS=1` the files are written anew.
#[test]
fn the_schemas_are_those_of_the_types() {
    let mut known = BTreeSet::new();
    for (form, schema) in schemas::all() {
        let text = format!("{:#}\n", schema.as_value());
        let path = file_of(form);
        if std::env::var_os("JRED_BLESS").is_some() {
            std::fs::write(&path, &text).unwrap();
        }
        let written = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            written == text,
            "{} is not the schema of {form}: JRED_BLESS=1 writes it",
            path.display()
        );
        known.insert(path);
    }
    let files = std::fs::read_dir(folder()).unwrap();
    for file in files.map(|entry| entry.unwrap().path()) {
        assert!(known.contains(&file), "{} has no type", file.display());
    }
}

#[test]
fn every_answer_follows_its_schema() {
    let press = press_file();
    let with = |name: &str| press.with_file_name(name).display().to_string();
    let files = [
        press.display().to_string(),
        with("hoist.toml"),
        with("ball-screw.toml"),
        with("belt-axis.toml"),
        with("linkage-cam-lever.toml"),
        with("pick-and-place.toml"),
    ];
    let mut runs: Vec<Vec<String>> = Vec::new();
    for file in &files {
        for command in [
            "check",
            "reduce",
            "reduce --points --reactions",
            "size --explain --all --motor sgm*",
            "size --pareto mass,rms-torque",
            "ratio",
            "bus",
            "simulate --duration 0.2s",
            "steady --torque 20Nm --delta 0.05",
            "steady --mean-speed 60rpm",
            "balance --least holding",
            "fastest",
            "retime",
            "sensitivity",
            "tolerance --samples 8",
            "export --torque-error 1% --format json",
            "export --prove --torque-error 5% --format json --type i32",
        ] {
            let mut words = command.split(' ').map(str::to_owned);
            let name = words.next().unwrap();
            runs.push([vec![name, file.clone()], words.collect()].concat());
        }
    }
    runs.extend(
        [
            "rules",
            "rules fanuc",
            "split --ratio 50 --stages 2 --pinion 0.001",
        ]
        .map(|c| c.split(' ').map(str::to_owned).collect()),
    );
    let mut met = BTreeSet::new();
    for mut run in runs {
        let formats = run.iter().any(|word| word == "--format");
        if !formats {
            run.extend(["--format".to_owned(), "json".to_owned()]);
        }
        let answer: Run = jred_with(&run);
        // A command that does not apply to the machine says so.
        if answer.code == 2 || answer.out.is_empty() {
            assert!(!answer.err.is_empty(), "{run:?}");
            continue;
        }
        let answer = answer.json();
        let faults = faults(&answer);
        assert!(
            faults.is_empty(),
            "{}:\n{}",
            run.join(" "),
            faults.join("\n")
        );
        met.insert(answer["schema"].as_str().unwrap().to_owned());
    }
    let forms = VALIDATORS.iter().map(|(form, _)| *form);
    let missed: Vec<&str> = forms.filter(|form| !met.contains(*form)).collect();
    assert!(missed.is_empty(), "no answer has the form {missed:?}");
}
