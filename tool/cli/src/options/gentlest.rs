//! `jred gentlest`

use std::path::PathBuf;

use clap::Args;

use super::catalogue::CatalogueFiles;
use super::documents::Documents;
use super::output_file;
use super::plan::PlanFile;
use super::sampling::SamplingOptions;
use super::word::word;
use jred_motion::gentlest::cycle::Goal;
use jred_motion::trace::Master;
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
    /// Write the motion to this file, times and positions, which `[motion]` of a machine file reads with type = "profile".
    #[arg(long, value_name = "CSV", value_parser = output_file())]
    pub profile: Option<PathBuf>,
    /// Write the motion to this file as a table for an electronic cam.
    #[arg(long, value_name = "CSV", value_parser = output_file())]
    pub cam: Option<PathBuf>,
    /// Rows of the cam table.
    #[arg(long, default_value_t = 2001, value_parser = clap::value_parser!(u32).range(16..=1_000_000))]
    pub rows: u32,
    /// Unit of the cam table's master, which makes one turn during the motion; the derivatives are with respect to it.
    #[arg(long, value_name = "UNIT", value_parser = word::<Master>(), default_value_t)]
    pub master: Master,
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
