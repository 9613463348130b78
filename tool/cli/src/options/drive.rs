//! Options of `jred drive`.

use std::path::PathBuf;

use clap::Args;

use super::catalogue::CatalogueFiles;
use super::documents::Documents;
use super::sampling::SamplingOptions;
use super::word::word;
use jred_report::table::output::Format;

/// `jred drive`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 done; 1 the drive violates a rule; 2 bad input.")]
pub struct Drive {
    /// Machine file, with a `[motion]`.
    pub file: PathBuf,
    /// Parts of drives.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Drive instead of the best suitable one: MOTOR+GEARBOX (or MOTOR), or the name as printed.
    #[arg(long, value_name = "DRIVE")]
    pub drive: Option<String>,
    /// Only the parameters of this maker: cia402, ax8000, sigma-7, akd or ax5000.
    #[arg(long, value_name = "MAKER")]
    pub maker: Option<String>,
    /// Encoder counts in a turn of the motor.
    #[arg(long, value_name = "COUNTS", value_parser = clap::value_parser!(u32).range(1..))]
    pub counts_per_turn: Option<u32>,
    /// Bandwidth of the speed loop for its gain, e.g. "40 Hz".
    #[arg(long, value_name = "FREQUENCY", value_parser = jred_file::argument::positive(&jred_file::units::kind::CUTOFF))]
    pub bandwidth: Option<f64>,
    /// Sampling of the motion.
    #[command(flatten)]
    pub sampling: SamplingOptions,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Output format; CSV has maker, parameter, name, value and unit.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}
