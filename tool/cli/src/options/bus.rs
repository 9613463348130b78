//! `jred bus`.

use std::path::PathBuf;

use clap::Args;

use super::catalogue::CatalogueFiles;
use super::sampling::SamplingOptions;
use super::word::word;
use jred_report::table::output::Format;

/// `jred bus`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 the bus satisfies every rule; 1 it violates one; 2 bad input."
)]
pub struct Bus {
    /// Machine files, one for each axis; at least one of them describes the common bus in its `[supply]`.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Parts of drives.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Drive of an axis instead of the best suitable one: number of the axis from 1 and MOTOR+GEARBOX (or MOTOR), e.g.
    /// "2=motor-a+gearbox-b", followed by " on AMPLIFIER" if there are several, or the name as printed; at most once per
    /// axis.
    #[arg(long, value_name = "N=DRIVE")]
    pub drive: Vec<String>,
    /// All axes start their cycles together, as in the files: check only this case.
    #[arg(long)]
    pub in_step: bool,
    /// Sampling of the motion.
    #[command(flatten)]
    pub sampling: SamplingOptions,
    /// Output format; CSV contains power and voltage over time with all axes in step.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}
