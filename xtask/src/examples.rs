//! `cargo xtask examples`: their expected output on the host and on Cortex-M cores.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;

use crate::cores::{CORES, for_targets};
use crate::expected;
use crate::run::{done, program, qemu, root, target_dir, text, workspace};

/// Checks that every numbered example gives its expected output on the host and, in QEMU, on every core or on those that its line
/// `//! runs on:` names.
#[derive(Args)]
pub(crate) struct Options {
    /// Write the expected output anew, from the host.
    #[arg(long)]
    bless: bool,
}

pub(crate) fn run(options: &Options) -> Result<()> {
    let examples = Example::all()?;
    done(workspace("build").args(["--workspace", "--examples"]))?;
    for Example { name, .. } in &examples {
        let path = target_dir().join("debug/examples").join(name);
        let output = text(&mut program(path)).with_context(|| format!("{name} on the host"))?;
        if options.bless {
            expected::bless(name, &output)?;
        }
        expected::compare(name, &output, "host")?;
    }
    let firmware = ["--package", "jred", "--profile", "firmware", "--examples"];
    done(workspace("build").args(firmware).args(for_targets()))?;
    for core in &CORES {
        for example in &examples {
            let name = &example.name;
            if !example.runs_on(core.name) {
                println!("{name} on {}: not for this core, as it says", core.name);
                continue;
            }
            let output = text(&mut qemu(core, &path(&core.firmware(), name)))
                .with_context(|| format!("{name} on {}", core.name))?;
            expected::compare(name, &output, core.name)?;
        }
    }
    Ok(())
}

/// The program of an example in a folder of cargo.
pub(crate) fn path(folder: &Path, name: &str) -> PathBuf {
    folder.join("examples").join(name)
}

/// A numbered example.
pub(crate) struct Example {
    pub(crate) name: String,
    source: String,
}

impl Example {
    /// All of them, in order.
    pub(crate) fn all() -> Result<Vec<Self>> {
        let mut all = Vec::new();
        for entry in std::fs::read_dir(root().join("examples"))? {
            let path = entry?.path();
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            let numbered = name.starts_with(|c: char| c.is_ascii_digit());
            if numbered && path.extension().is_some_and(|end| end == "rs") {
                all.push(Self {
                    name: name.into_owned(),
                    source: std::fs::read_to_string(&path)?,
                });
            }
        }
        all.sort_by(|one, other| one.name.cmp(&other.name));
        Ok(all)
    }

    /// The rest of the line of its head that begins with `//! KEY: `.
    fn says(&self, key: &str) -> Option<&str> {
        let mut lines = self.source.lines();
        lines.find_map(|line| {
            line.strip_prefix("//! ")?
                .strip_prefix(key)?
                .strip_prefix(": ")
        })
    }

    /// Whether it runs on a core: on all of them, or on those that it names.
    fn runs_on(&self, core: &str) -> bool {
        self.says("runs on")
            .is_none_or(|cores| cores.split_whitespace().any(|named| named == core))
    }

    /// Whether it computes in double precision.
    pub(crate) fn is_double(&self) -> bool {
        self.says("computes in") == Some("double precision")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(source: &str) -> Example {
        Example {
            name: "00_example".into(),
            source: source.into(),
        }
    }

    #[test]
    fn an_example_runs_on_every_core_or_on_those_that_it_names() {
        let named = of("//! A title.\n//! runs on: cortex-m4 cortex-m7\nfn main() {}\n");
        assert!(named.runs_on("cortex-m4") && named.runs_on("cortex-m7"));
        assert!(!named.runs_on("cortex-m") && !named.runs_on("cortex-m0"));
        assert!(of("//! A title that runs on: m4\n").runs_on("cortex-m0"));
    }

    #[test]
    fn an_example_says_whether_it_computes_in_double_precision() {
        assert!(of("//! computes in: double precision\n").is_double());
        assert!(!of("//! computes in: single precision\n").is_double());
        assert!(!of("// computes in: double precision\n").is_double());
    }

    #[test]
    fn all_numbered_examples_are_found_in_order() {
        let all = Example::all().unwrap();
        let names: Vec<_> = all.iter().map(|example| &*example.name).collect();
        assert_eq!(names[..2], ["01_tick", "02_press_f32"]);
        assert!(names.is_sorted() && !names.contains(&"no_panic"));
        assert!(all.iter().any(Example::is_double));
    }
}
