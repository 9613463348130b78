//! Options of the commands that help to begin: a new machine file, completion, the manual.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap_complete::Shell;

use jred_file::keys::starter;

/// Printed without arguments.
pub const FIRST: &str = "jred sizes drives for machines whose inertia depends on the angle. To begin:

  jred new slider-crank --out press.toml      write a machine file with comments; put in your values
  jred size press.toml                        rank the drives of the catalogue
  jred size press.toml --report press.html    the same as a page with plots

`jred new` lists the types of machines, `jred --help` the commands, `jred COMMAND --help` the options of one.";

/// `jred new`
#[derive(Debug, Args)]
pub struct New {
    /// Type of the mechanism; lists all types if not given.
    #[arg(value_name = "TYPE", hide_possible_values = true, value_parser = types())]
    pub kind: Option<String>,
    /// Write the keys of every table as comments, also of those that a first machine does not need.
    #[arg(long, requires = "kind")]
    pub all: bool,
    /// File to write instead of standard output.
    #[arg(long, short, requires = "kind", value_parser = super::output_file())]
    pub out: Option<PathBuf>,
    /// Overwrite an existing file.
    #[arg(long, requires = "out")]
    pub force: bool,
}

fn types() -> PossibleValuesParser {
    let types = starter::types().map(|(name, about)| PossibleValue::new(name).help(about));
    types.collect::<Vec<_>>().into()
}

/// `jred completion`
#[derive(Debug, Args)]
pub struct Completion {
    /// The shell. Install for bash: `jred completion bash > ~/.local/share/bash-completion/completions/jred`.
    pub shell: Shell,
}

/// `jred man`
#[derive(Debug, Args)]
pub struct Man {
    /// Folder in which to write the pages of all commands, such as ~/.local/share/man/man1; it must exist.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
