//! The catalogue options of the commands that size drives.

use std::path::PathBuf;

use clap::Args;

use jred_sizing::catalogue::{Catalogue, CatalogueError, Sources};

/// Catalogue files.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Catalogue")]
pub struct CatalogueFiles {
    /// Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue,
    /// in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue.
    #[arg(long, value_name = "DIR|FILE")]
    pub catalogue: Vec<PathBuf>,
    /// Motors from this CSV file instead of the built-in ones.
    #[arg(long, value_name = "CSV")]
    pub motors: Option<PathBuf>,
    /// Gearboxes from this CSV file instead of the built-in ones.
    #[arg(long, value_name = "CSV")]
    pub gearboxes: Option<PathBuf>,
    /// Skip rows of the catalogue that cannot be used, and report their number.
    #[arg(long)]
    pub skip_broken_rows: bool,
}

impl CatalogueFiles {
    /// The given options.
    pub fn given(&self) -> impl Iterator<Item = &'static str> {
        let given = [
            ("--catalogue", !self.catalogue.is_empty()),
            ("--motors", self.motors.is_some()),
            ("--gearboxes", self.gearboxes.is_some()),
        ];
        given
            .into_iter()
            .filter_map(|(name, given)| given.then_some(name))
    }

    /// Opens the catalogue and prints warnings about implausible values to standard error.
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
            crate::terminal::warn(&warning.clone());
        }
        Ok(catalogue)
    }
}
