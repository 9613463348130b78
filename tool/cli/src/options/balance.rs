//! `jred balance`

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::sampling::SamplingOptions;
use super::word::word;
use jred_motion::balance::Goal;
use jred_report::list::inspection::Format;

/// `jred balance`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 done; 2 bad input.")]
#[command(group = ArgGroup::new("sought").required(true).multiple(true).args(["counterweight", "spring"]))]
pub struct Balance {
    /// Machine file.
    pub file: PathBuf,
    /// Quantity to minimise.
    #[arg(long, value_parser = word::<Goal>(), default_value_t)]
    pub least: Goal,
    /// A link that may carry a counterweight, its largest mass, and the largest distance of its parts from the origin of the link's frame, e.g.
    /// "crank, 20 kg, 250 mm"; may be repeated.
    #[arg(long, value_name = "LINK, MASS, REACH")]
    pub counterweight: Vec<String>,
    /// A `[[spring]]` of the machine file by its name: its ends are kept, its stiffness and free length are computed; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub spring: Vec<String>,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
    /// Sampling of the motion.
    #[command(flatten)]
    pub sampling: SamplingOptions,
}
