//! The JSON of every command follows its schema in `docs/schemas`, which is generated from the types.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::support::schema::{VALIDATORS, faults};
use crate::support::{Run, jred_with, shipped};
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

/// With `JRED_BLESS=1` the files are regenerated.
#[test]
fn the_schemas_are_those_of_the_types() {
    // That of machine files follows from the descriptions of their keys, in `tool/file`.
    let mut known = BTreeSet::from([folder().join("machine-file.json")]);
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

/// Machines, and the commands that each of them passes.
const RUNS: [(&[&str], &[&str]); 7] = [
    (
        &[""],
        &[
            "rules",
            "rules fanuc",
            "split --ratio 50 --stages 2 --pinion 0.2kgcm^2",
        ],
    ),
    (
        &[
            "press",
            "hoist",
            "linear-gripper",
            "linkage-cam-lever",
            "pick-and-place",
        ],
        &[
            "check",
            "reduce",
            "reduce --points",
            "simulate",
            "size",
            "fastest",
            "gentlest",
        ],
    ),
    (
        &["press", "ball-screw"],
        &[
            "reduce --reactions --positions 24",
            "size --explain --top 3",
            "require",
            "drive",
            "size --pareto power,mass",
            "bus",
            "steady --delta 0.05",
            "steady --mean-speed 60rpm",
            "balance --counterweight crank,20kg,200mm",
            "tolerance --samples 8 --tolerance motion.segment.1.duration=5%",
            "export --torque-error 1Nm",
            "export --torque-error 1Nm --type i32 --layout spline --prove",
        ],
    ),
    (
        &["press"],
        &[
            "ratio",
            "size --motion best",
            "fastest --drive sgm7a-25a+tp004mf-4 --reserve rules",
        ],
    ),
    (&["belt-axis"], &["sensitivity --change 5"]),
    (&["packing-line/project"], &["project"]),
    (
        &[""],
        &[
            "catalogue list",
            "catalogue list amplifiers",
            "catalogue check built-in",
            "catalogue show sgm7a-30a",
        ],
    ),
];

#[test]
fn every_answer_follows_its_schema() {
    let folder = shipped("");
    let mut runs: Vec<Vec<String>> = Vec::new();
    for (machines, commands) in RUNS {
        for machine in machines {
            for command in commands {
                let mut words: Vec<String> = command.split(' ').map(str::to_owned).collect();
                if !machine.is_empty() {
                    let file = folder.join(format!("{machine}.toml"));
                    words.insert(1, file.display().to_string());
                }
                words.extend(["--format", "json"].map(str::to_owned));
                runs.push(words);
            }
        }
    }
    let [log, machine] = ["four-bar-log.csv", "four-bar.toml"];
    let [log, machine] = [log, machine].map(|name| folder.join(name).display().to_string());
    let identify = ["identify", &log, "--machine", &machine];
    let identify = identify
        .into_iter()
        .chain(["--counts-per-turn", "4096", "--format", "json"]);
    runs.push(identify.map(str::to_owned).collect());
    let mut met = BTreeSet::new();
    for run in runs {
        let answer: Run = jred_with(&run);
        // A command that does not apply to the machine reports so.
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
