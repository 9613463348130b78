//! Options of `jred catalogue`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use glob::Pattern;

use super::catalogue::CatalogueFiles;
use super::word::word;
use jred_report::list::inspection::AnswerFormat;
use jred_report::table::output::Format;

jred_file::words! {
    /// A table of a catalogue.
    pub enum Table default Motors {
        /// Motors.
        Motors = "motors",
        /// Linear motors.
        LinearMotors = "linear-motors",
        /// Gearboxes.
        Gearboxes = "gearboxes",
        /// Servo amplifiers.
        Amplifiers = "amplifiers",
        /// Brake resistors.
        Resistors = "resistors",
    }
}

/// `jred catalogue`
#[derive(Debug, Subcommand)]
pub enum Catalogue {
    /// List the parts of a catalogue; as CSV a table that can be read as a catalogue again.
    List(List),
    /// Show every figure of a part, its amplifiers and what it lacks.
    Show(Show),
    /// Check a catalogue of your own: rows that cannot be right or are probably wrong, and what each missing figure costs.
    Check(Check),
    /// Write an empty catalogue with a comment for every column.
    New(New),
}

/// `jred catalogue list`
#[derive(Debug, Args)]
pub struct List {
    /// Table.
    #[arg(value_parser = word::<Table>(), default_value_t)]
    pub table: Table,
    /// The catalogue.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Only parts whose key matches, e.g. "sgm7*"; may be repeated.
    #[arg(long, value_name = "GLOB")]
    pub key: Vec<Pattern>,
    /// Only parts of matching makers; may be repeated.
    #[arg(long, value_name = "GLOB")]
    pub maker: Vec<Pattern>,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}

/// `jred catalogue show`
#[derive(Debug, Args)]
pub struct Show {
    /// Key of the part.
    pub key: String,
    /// The catalogue.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Output format.
    #[arg(long, value_parser = word::<AnswerFormat>(), default_value_t)]
    pub format: AnswerFormat,
}

/// `jred catalogue check`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 the catalogue can be used; 1 figures are probably wrong; 2 it cannot be used."
)]
pub struct Check {
    /// Folders or files; "built-in" is the built-in catalogue.
    #[arg(required = true, value_name = "DIR|FILE")]
    pub catalogue: Vec<PathBuf>,
    /// Skip rows that cannot be used, and report their number.
    #[arg(long)]
    pub skip_broken_rows: bool,
    /// Output format.
    #[arg(long, value_parser = word::<AnswerFormat>(), default_value_t)]
    pub format: AnswerFormat,
}

/// `jred catalogue new`
#[derive(Debug, Args)]
pub struct New {
    /// Folder to write; it must be empty or not exist.
    pub folder: PathBuf,
    /// For linear motors.
    #[arg(long)]
    pub linear: bool,
}
