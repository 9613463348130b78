//! Texts for users as snapshots, so that a change of wording or layout is reviewed.
//!
//! `cargo insta review` shows the changes; `INSTA_UPDATE=always cargo test -p jred-cli wording` rewrites all snapshots. Paths are relative to the
//! folder in which the command runs, colour is off; rounding noise, digests and the version are masked.

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

use crate::support::{Folder, Run, jred_in, press_text, typed};

/// A small catalogue: two motors, two gearboxes, with all figures of the built-in tables.
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

    /// The text of an example machine file.
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

    /// The command as typed, its output, and its exit code if not 0.
    fn run(&self, command: &str) -> String {
        let Run { code, out, err } = jred_in(&self.0.path(""), &typed(command));
        let mut text = format!("$ jred {command}\n{out}");
        if !err.is_empty() {
            write!(text, "--- stderr\n{err}").unwrap();
        }
        if code != 0 {
            writeln!(text, "--- exit code {code}").unwrap();
        }
        text
    }

    /// The commands of the lines in order.
    fn runs(&self, commands: &str) -> String {
        let commands = commands.lines().map(str::trim);
        let commands = commands.filter(|command| !command.is_empty());
        let texts: Vec<String> = commands.map(|command| self.run(command)).collect();
        texts.join("\n")
    }
}

/// Compares `text` with the snapshot `name`.
fn compare(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_snapshot_path("snapshots");
    // Trailing blanks, which tables have, are invisible.
    settings.add_filter(r"(?m)[ \t]+$", "");
    settings.add_filter(r" *-?\d(\.\d+)?e-1\d\b", " [rounding]");
    settings.add_filter(r"(\d\.\d{5})\d+", "$1…");
    settings.add_filter(r"\b[0-9a-f]{16,64}\b", "[digest]");
    settings.add_filter(r"(?m),[0-9a-f]{8}$", ",[check]");
    settings.add_filter(r"/\S*/\.tmp\w+", "[folder]");
    settings.add_filter(r"\bjred \d+\.\d+\.\d+", "jred [version]");
    settings.bind(|| insta::assert_snapshot!(name, text));
}
