//! `jred project`.

use std::path::PathBuf;

use clap::Args;

use super::SizeFormat;
use super::catalogue::CatalogueFiles;
use super::documents::Documents;
use super::sampling::SamplingOptions;
use super::word::word;

/// `jred project`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 all axes and the bus satisfy every rule; 1 one violates a rule; 2 bad input."
)]
pub struct Project {
    /// Project file: the machine files of its axes, their phases, their common supply; see docs/project.md.
    pub file: PathBuf,
    /// Parts of drives.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Sampling of the motions.
    #[command(flatten)]
    pub sampling: SamplingOptions,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Output format; CSV contains the bill of materials; aas has one submodel for each axis.
    #[arg(long, value_parser = word::<SizeFormat>(), default_value_t)]
    pub format: SizeFormat,
}
