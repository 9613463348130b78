//! Which catalogue a command takes its drives from.

use std::path::PathBuf;

use clap::Args;

use jred_sizing::catalogue::{Catalogue, CatalogueError, Sources};

/// Which catalogue.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Catalogue")]
pub struct CatalogueFiles {
    /// Folder or file of motors, gearboxes, servo amplifiers and brake resistors instead of the built-in catalogue, in jred's
    /// own format or that of the Motor-Gearbox Database; may be repeated, "built-in" is the built-in one.
    #[arg(long, value_name = "DIR|FILE")]
    pub catalogue: Vec<PathBuf>,
    /// Motors from this CSV file instead of the built-in ones.
    #[arg(long, value_name = "CSV")]
    pub motors: Option<PathBuf>,
    /// Gearboxes from this CSV file instead of the built-in ones.
    #[arg(long, value_name = "CSV")]
    pub gearboxes: Option<PathBuf>,
    /// Leave out rows of the catalogue that cannot be used, and say how many they are.
    #[arg(long)]
    pub skip_broken_rows: bool,
}

impl CatalogueFiles {
    /// The catalogue; what can hardly be right in it is said on the standard error.
    ///
    /// # Errors
    /// Those of [`Catalogue::open`].
    pub fn open(&self) -> Result<Catalogue, CatalogueError> {
        let catalogue = Catalogue::open(&Sources {
            catalogues: self.catalogue.clone(),
            motors: self.motors.clone(),
            gearboxes: self.gearboxes.clone(),
            skip_broken_rows: self.skip_broken_rows,
        })?;
        for warning in &catalogue.warnings {
            eprintln!("{warning}");
        }
        Ok(catalogue)
    }
}
