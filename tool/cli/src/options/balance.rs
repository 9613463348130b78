//! `jred balance`

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::sampling::SamplingOptions;
use super::word::word;
use jred_motion::balance::BalanceGoal;
use jred_report::list::inspection::AnswerFormat;

/// `jred balance`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 done; 2 bad input.")]
#[command(group = ArgGroup::new("sought").required(true).multiple(true).args(["counterweight", "spring"]))]
pub struct Balance {
    /// Machine file.
    pub file: PathBuf,
    /// Quantity to minimise.
    #[arg(long, value_parser = word::<BalanceGoal>(), default_value_t)]
    pub least: BalanceGoal,
    /// A link that may carry a counterweight, its largest mass, and the largest distance of its parts from the origin of the link's frame, e.g.
    /// "crank, 20 kg, 250 mm"; may be repeated.
    #[arg(long, value_name = "LINK, MASS, REACH")]
    pub counterweight: Vec<String>,
    /// A `[[spring]]` of the machine file by its name: its ends are kept, its stiffness and free length are computed; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub spring: Vec<String>,
    /// Output format.
    #[arg(long, value_parser = word::<AnswerFormat>(), default_value_t)]
    pub format: AnswerFormat,
    /// Sampling of the motion.
    #[command(flatten)]
    pub sampling: SamplingOptions,
}
