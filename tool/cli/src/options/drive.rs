//! The options of the commands that make a motion for one drive.

use clap::Args;

use super::catalogue::CatalogueFiles;

/// One drive of a catalogue.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Drive")]
pub struct OneDrive {
    /// Motor of the drive by its key in the catalogue; without it, the torque is that at the input of the drive train.
    #[arg(long, value_name = "KEY")]
    pub motor: Option<String>,
    /// Its gearbox by its key; without it, the motor is directly coupled.
    #[arg(long, value_name = "KEY", requires = "motor")]
    pub gearbox: Option<String>,
    /// What drives are made of.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
}
