//! `jred gentlest`

use std::path::PathBuf;

use clap::Args;

use super::catalogue::CatalogueFiles;
use super::documents::Documents;
use super::plan::PlanFile;
use super::sampling::SamplingOptions;
use super::series::SeriesFiles;
use super::word::word;
use jred_motion::gentlest::cycle::Goal;
use jred_report::table::output::Format;

jred_file::words! {
    /// Acceleration at the ends of a move.
    pub enum EndAcceleration default Free {
        /// The acceleration may jump at rest, which gives the best result.
        Free = "free",
        /// The acceleration is zero at rest and continuous: for machines that must not be shaken.
        Zero = "zero",
    }
}

/// `jred gentlest`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 done; 1 the motion violates a rule of `jred size` for the --drive, or loses a contact; 2 bad input."
)]
pub struct Gentlest {
    /// Machine file.
    pub file: PathBuf,
    /// Quantity to minimise.
    #[arg(long, value_parser = word::<Goal>(), default_value_t)]
    pub objective: Goal,
    /// Acceleration at the ends of a move.
    #[arg(long, value_parser = word::<EndAcceleration>(), default_value_t)]
    pub ends: EndAcceleration,
    /// With --ends zero: share of a move's time in which the acceleration rises to its first peak, e.g. "5 %"; 10 % if not given.
    #[arg(long, value_name = "SHARE", value_parser = ramp)]
    pub ramp: Option<f64>,
    /// Profile and electronic cam.
    #[command(flatten)]
    pub series: SeriesFiles,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Plan for firmware.
    #[command(flatten)]
    pub plan: PlanFile,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
    /// Sampling of the motion.
    #[command(flatten)]
    pub sampling: SamplingOptions,
    /// The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the torque is at the input of the drive train.
    #[arg(long, value_name = "MOTOR+GEARBOX")]
    pub drive: Option<String>,
    /// Parts of drives.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
}

/// Default ramp.
pub const RAMP: f64 = 0.1;

/// A ramp as a share of a move.
fn ramp(text: &str) -> Result<f64, String> {
    let parsed = match text.strip_suffix('%') {
        Some(percent) => percent.trim().parse::<f64>().map(|x| x / 100.0),
        None => text.parse(),
    };
    let share = parsed.map_err(|_| "write a share such as 0.1 or \"10 %\"")?;
    if (0.02..=0.25).contains(&share) {
        Ok(share)
    } else {
        Err("it must be from 2 % to 25 %".to_owned())
    }
}
