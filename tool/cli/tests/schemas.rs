//! The JSON of every command follows its schema in `docs/schemas`, which is generated from the types.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::support::{Folder, Run, jred_with, machine, press_file};
use jred_report::answer::schema;
use serde_json::Value;

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
    for (form, schema) in schema::all() {
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

/// Validators by form.
fn validators() -> BTreeMap<String, jsonschema::Validator> {
    let all = schema::all().into_iter();
    let validator = |(form, schema): (&str, schemars::Schema)| {
        let validator = jsonschema::draft202012::new(schema.as_value()).unwrap();
        (form.to_owned(), validator)
    };
    all.map(validator).collect()
}

/// Every fault of an answer, and the form that it names.
fn faults(validators: &BTreeMap<String, jsonschema::Validator>, run: &Run) -> (String, Vec<String>) {
    let answer: Value = run.json();
    let form = answer["schema"].as_str().unwrap().to_owned();
    let faults = validators[&form].iter_errors(&answer);
    let faults = faults.map(|fault| format!("{}: {fault}", fault.instance_path()));
    (form, faults.collect())
}

#[test]
fn every_answer_follows_its_schema() {
    let validators = validators();
    let folder = Folder::new();
    let table = folder.path("table.json");
    let press = press_file();
    let with = |name: &str| machine(name).display().to_string();
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
            "check", "reduce", "reduce --points --reactions", "size --explain --all --motor sgm*", "size --pareto mass,rms-torque",
            "ratio", "bus", "simulate --torque 20Nm --duration 0.2s", "steady --torque 20Nm --delta 0.05", "steady --mean-speed 60rpm",
            "balance --least holding", "fastest", "retime", "sensitivity", "tolerance --samples 8",
            "export --torque-error 1% --format json", "export --prove --torque-error 5% --format json --type i32",
        ] {
            let mut words = command.split(' ').map(str::to_owned);
            let name = words.next().unwrap();
            runs.push([vec![name, file.clone()], words.collect()].concat());
        }
    }
    runs.extend(["rules", "rules servo", "split --ratio 50"].map(|c| c.split(' ').map(str::to_owned).collect()));
    let _ = table;
    let mut met = BTreeSet::new();
    for mut run in runs {
        let formats = run.iter().any(|word| word == "--format");
        if !formats {
            run.extend(["--format".to_owned(), "json".to_owned()]);
        }
        let answer = jred_with(&run);
        // A command that does not apply to the machine says so.
        if answer.code == 2 || answer.out.is_empty() {
            assert!(!answer.err.is_empty(), "{run:?}");
            continue;
        }
        let (form, faults) = faults(&validators, &answer);
        assert!(faults.is_empty(), "{}:\n{}", run.join(" "), faults.join("\n"));
        met.insert(form);
    }
    let missed: Vec<&String> = validators.keys().filter(|form| !met.contains(*form)).collect();
    assert!(missed.is_empty(), "no answer has the form {missed:?}");
}
