//! Shared by the tests of the command: the packages' own support, and the command itself.
#![allow(dead_code)]

pub(crate) mod json;
pub(crate) mod schema;
#[path = "../../../support/mod.rs"]
mod shared;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;

pub(crate) use shared::*;

/// All commands.
pub(crate) const COMMANDS: [&str; 24] = [
    "new",
    "completion",
    "man",
    "catalogue",
    "require",
    "drive",
    "reduce",
    "check",
    "size",
    "vary",
    "ratio",
    "sensitivity",
    "tolerance",
    "bus",
    "project",
    "simulate",
    "steady",
    "identify",
    "fastest",
    "gentlest",
    "balance",
    "export",
    "rules",
    "split",
];

/// Output of a run of `jred`.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// Runs `jred`; each argument may be a text or a path.
pub(crate) fn jred<const N: usize>(arguments: [&dyn AsRef<std::ffi::OsStr>; N]) -> Run {
    let arguments: Vec<&std::ffi::OsStr> = arguments.iter().map(|a| (*a).as_ref()).collect();
    jred_with(&arguments)
}

/// Runs `jred` as typed; each `{}` in the line is one of `files`, in order.
pub(crate) fn jred_of<const N: usize>(line: &str, files: [&dyn AsRef<std::ffi::OsStr>; N]) -> Run {
    let mut files = files.into_iter();
    let argument = |part| match part {
        "{}" => files.next().unwrap().as_ref(),
        part => std::ffi::OsStr::new(part),
    };
    let arguments: Vec<_> = typed(line).into_iter().map(argument).collect();
    assert!(files.next().is_none(), "{line}");
    jred_with(&arguments)
}

/// The same with any number of arguments.
pub(crate) fn jred_with(arguments: &[impl AsRef<std::ffi::OsStr>]) -> Run {
    jred_in(Path::new("."), arguments)
}

/// The same in a folder.
pub(crate) fn jred_in(folder: &Path, arguments: &[impl AsRef<std::ffi::OsStr>]) -> Run {
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_jred"));
    command
        .current_dir(folder)
        .env("NO_COLOR", "1")
        // Progress lines are not part of the messages.
        .env("JRED_PROGRESS", "never")
        // The date of documents: 2026-12-01.
        .env("SOURCE_DATE_EPOCH", "1796083200")
        .env_remove("CLICOLOR_FORCE")
        .env_remove("FORCE_COLOR");
    command.args(arguments);
    let Output {
        status,
        stdout,
        stderr,
    } = command.output().unwrap();
    let run = Run {
        code: status.code().unwrap_or(-1),
        out: String::from_utf8(stdout).unwrap(),
        err: String::from_utf8(stderr).unwrap(),
    };
    assert!(!run.message().contains("panicked"), "{}", run.err);
    run
}

/// The arguments of a line as typed: between spaces, or within quotes `'…'`.
pub(crate) fn typed(line: &str) -> Vec<&str> {
    let mut quoted = false;
    let parts = line.split(move |c| {
        quoted ^= c == '\'';
        c == '\'' || (c == ' ' && !quoted)
    });
    parts.filter(|part| !part.is_empty()).collect()
}

/// A listing with single spaces between columns.
pub(crate) fn squeezed(text: &str) -> String {
    let lines = text.lines();
    let lines = lines.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ") + "\n");
    lines.collect()
}

impl Run {
    /// The run, which must have ended with `code`.
    pub(crate) fn ends(self, code: i32) -> Self {
        assert_eq!(
            self.code, code,
            "stdout:\n{}\nstderr:\n{}",
            self.out, self.err
        );
        self
    }

    /// The message without line breaks, bars and indentation, for searching.
    pub(crate) fn message(&self) -> String {
        let mut message = String::new();
        for line in self.err.lines() {
            let words = line.split_whitespace().filter(|word| *word != "│");
            for (k, word) in words.enumerate() {
                // Lines whose length depends on the file's path are also broken after hyphens.
                let broken = k == 0 && message.ends_with('-') && !message.ends_with(" -");
                if !message.is_empty() && !broken {
                    message.push(' ');
                }
                message.push_str(word);
            }
        }
        message
    }

    /// Checks that the message contains all of `words`, and that nothing was printed as a result.
    pub(crate) fn says(&self, words: &[&str]) {
        let message = self.message();
        for word in words {
            assert!(message.contains(word), "{word:?} is not in\n{message}");
        }
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap()
    }

    /// The columns of a result in CSV.
    pub(crate) fn columns(&self) -> Columns {
        Columns::of_csv(&self.out)
    }
}

/// The machine files of `machines/` that can be sized with the built-in catalogue.
pub(crate) fn sizeable_machines() -> Vec<PathBuf> {
    // The catalogue has no linear drive, and a time-dependent ratio cannot be sized.
    let refused = ["linear-gripper.toml", "variator-press.toml"];
    let files = std::fs::read_dir(shipped("")).unwrap();
    let files = files.map(|entry| entry.unwrap().path());
    let is_machine = |file: &PathBuf| {
        file.extension().is_some_and(|end| end == "toml")
            && !refused.iter().any(|name| file.ends_with(name))
    };
    files.filter(is_machine).collect()
}

/// A catalogue of the built-in motors and gearboxes alone.
pub(crate) fn without_resistors(folder: &Folder) -> PathBuf {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../sizing/catalogue");
    let parts = folder.path("parts");
    std::fs::create_dir_all(&parts).unwrap();
    for table in ["motors.csv", "gearboxes.csv"] {
        std::fs::copy(home.join(table), parts.join(table)).unwrap();
    }
    parts
}

/// Every row of the files of a study by its number: its line without the number of CSV and the study.
pub(crate) fn study_rows(folder: &Folder, names: &[String]) -> BTreeMap<u64, String> {
    let mut found = BTreeMap::new();
    for name in names {
        let text = std::fs::read_to_string(folder.path(name)).unwrap();
        for line in text.lines().skip(1) {
            let line = line.strip_prefix("{\"row\":").unwrap_or(line);
            let cells = line.split_once(",\"{").map_or(line, |(cells, _)| cells);
            let (row, cells) = cells.trim_end_matches(',').split_once(',').unwrap();
            let before = found.insert(row.parse().unwrap(), cells.to_owned());
            assert_eq!(before, None);
        }
    }
    found
}
