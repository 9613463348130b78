//! What users read, kept as snapshots, so that a change of wording or layout is read in review.
//!
//! `cargo insta review` shows what changed; `INSTA_UPDATE=always cargo test -p jred-cli wording` writes all of it anew. Paths are
//! relative to the folder in which the command runs, colour is off, and rounding noise, digests and the version are masked.

mod catalogues;
mod help;
mod listings;
mod machine_files;
mod mechanism_files;
mod motions;
mod options;
mod reports;
mod sizings;

use std::fmt::Write as _;
use std::path::Path;

use crate::support::{Folder, press_text};

/// A catalogue that is small enough to be read: two motors, two gearboxes, all that the built-in tables say of them.
const MOTORS: [&str; 2] = ["sgmsh-15a", "sgmsh-30a"];
const GEARBOXES: [&str; 2] = ["npt025mf-5", "npt035mf-10"];

/// A folder with machine files and a small catalogue, in which `jred` runs.
struct Desk(Folder);

impl Desk {
    fn new() -> Self {
        let folder = Folder::new();
        let home = Path::new(env!("CARGO_MANIFEST_DIR"));
        for table in ["motors.csv", "gearboxes.csv", "resistors.csv"] {
            let text =
                std::fs::read_to_string(home.join("../sizing/catalogue").join(table)).unwrap();
            let kept = |line: &&str| {
                let key = line.split(',').next().unwrap();
                table == "resistors.csv"
                    || key == "key"
                    || MOTORS.contains(&key)
                    || GEARBOXES.contains(&key)
            };
            let lines: Vec<&str> = text.lines().filter(kept).collect();
            std::fs::create_dir_all(folder.path("drives")).unwrap();
            folder.file(&format!("drives/{table}"), lines.join("\n") + "\n");
        }
        Self(folder)
    }

    /// The text of one of the machine files that users start from.
    fn machine(name: &str) -> String {
        if name == "press.toml" {
            return press_text();
        }
        let file = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../machines")
            .join(name);
        std::fs::read_to_string(file).unwrap()
    }

    fn with(self, name: &str, text: impl AsRef<[u8]>) -> Self {
        self.0.file(name, text);
        self
    }

    fn with_machines(self, names: &[&str]) -> Self {
        names
            .iter()
            .fold(self, |desk, name| desk.with(name, Self::machine(name)))
    }

    /// The command as typed, what it prints, and its exit code if that is not 0.
    fn run(&self, arguments: &[&str]) -> String {
        let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_jred"))
            .current_dir(self.0.path(""))
            .env("NO_COLOR", "1")
            .env("JRED_PROGRESS", "never")
            .env_remove("CLICOLOR_FORCE")
            .env_remove("FORCE_COLOR")
            .args(arguments)
            .output()
            .unwrap();
        let mut text = String::from("$ jred");
        for argument in arguments {
            let quote = if argument.contains([' ', '*']) {
                "'"
            } else {
                ""
            };
            write!(text, " {quote}{argument}{quote}").unwrap();
        }
        text.push('\n');
        text += std::str::from_utf8(&output.stdout).unwrap();
        let err = std::str::from_utf8(&output.stderr).unwrap();
        assert!(!err.contains("panicked"), "{err}");
        if !err.is_empty() {
            write!(text, "--- stderr\n{err}").unwrap();
        }
        if output.status.code() != Some(0) {
            writeln!(text, "--- exit code {}", output.status.code().unwrap()).unwrap();
        }
        text
    }

    /// All of `commands`, one after the other.
    fn runs(&self, commands: &[&[&str]]) -> String {
        let texts: Vec<String> = commands.iter().map(|command| self.run(command)).collect();
        texts.join("\n")
    }
}

/// Compares `text` with the snapshot `name`.
fn compare(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_snapshot_path("snapshots");
    // Blanks at the ends of lines, of which tables have many, cannot be seen.
    settings.add_filter(r"(?m)[ \t]+$", "");
    settings.add_filter(r" *-?\d(\.\d+)?e-1\d\b", " [rounding]");
    settings.add_filter(r"(\d\.\d{5})\d+", "$1…");
    settings.add_filter(r"\b[0-9a-f]{16,64}\b", "[digest]");
    settings.add_filter(r"(?m),[0-9a-f]{8}$", ",[check]");
    settings.add_filter(r"/\S*/\.tmp\w+", "[folder]");
    settings.add_filter(r"\bjred \d+\.\d+\.\d+", "jred [version]");
    settings.bind(|| insta::assert_snapshot!(name, text));
}
