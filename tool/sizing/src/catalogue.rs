//! The catalogue: motors, gearboxes, servo amplifiers and brake resistors, and their allowed combinations.
//!
//! It comes from folders and files in jred's own format (CSV whose header carries the units, or TOML) or in the format of the Motor-Gearbox Database;
//! docs/catalogue.md describes both. An unusable row is an error that names file, row and column. A row with implausible values is used, with a
//! warning in [`Catalogue::warnings`].

mod amplifier;
mod cell;
mod column;
mod derating;
#[cfg(feature = "fs")]
mod disk;
mod drive;
mod duplicates;
mod entry;
mod fault;
mod files;
mod gaps;
mod gearbox;
mod keep;
mod lists;
mod load;
mod mgdb;
mod motor;
mod pairing;
mod plausible;
mod record;
mod row;
mod table;
mod toml_table;
mod voltage;

pub use amplifier::{Amplifier, Resistor};
pub use derating::{Basis as DeratingBasis, Derating, HOTTEST_MOTOR, SiteRating};
#[cfg(feature = "fs")]
pub use disk::Sources;
pub use drive::{Drive, DriveId};
pub use fault::{BrokenRows, CatalogueError, SHOWN};
pub use gaps::Gap;
pub use gearbox::Gearbox;

pub use motor::{Brake, Commutation, Motor, MotorKind, Thermal, Winding};
pub use pairing::{Drives, Pairing};
pub use record::{ColumnTitle, Parts};
pub(crate) use voltage::VOLTAGE_CLASS;
pub use voltage::{Basis, RatedBusVoltage};

use fault::{Remarks, Text};
use load::Loader;

/// Motors, gearboxes, amplifiers and resistors from which drives are chosen.
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    /// Motors, in the order of the files.
    pub motors: Vec<Motor>,
    /// Gearboxes, in the order of the files.
    pub gearboxes: Vec<Gearbox>,
    /// Servo amplifiers; a motor without a suitable one is checked without amplifier.
    pub amplifiers: Vec<Amplifier>,
    /// Brake resistors.
    pub resistors: Vec<Resistor>,
    /// Allowed combinations.
    pub pairing: Pairing,
    /// The currencies of its prices, as the columns name them ("" if unnamed), each with the first file that uses it.
    pub currencies: Vec<(String, String)>,
    /// Warnings about implausible values, with file and line.
    pub warnings: Vec<String>,
    /// Number of skipped broken rows.
    pub left_out: usize,
}

impl Catalogue {
    /// Checks that all prices are in one currency, so that they can be compared.
    ///
    /// # Errors
    /// Two currencies, or prices with and without a currency.
    pub fn one_currency(&self) -> Result<(), CatalogueError> {
        let [first, second, ..] = self.currencies.as_slice() else {
            return Ok(());
        };
        let words = |(currency, file): &(String, String)| match currency.as_str() {
            "" => format!("no named currency ({file})"),
            currency => format!("{currency} ({file})"),
        };
        Err(CatalogueError::Currencies {
            first: words(first),
            second: words(second),
        })
    }

    /// Keeps the motors of one kind.
    pub fn keep_kind(&mut self, kind: MotorKind) {
        self.keep(|motor| motor.kind == kind, |_| true);
    }

    /// The built-in catalogue.
    ///
    /// # Errors
    /// Never: a test reads it.
    pub fn built_in() -> Result<Self, CatalogueError> {
        Loader::load(vec![files::built_in(|_| true)], Remarks::default(), false)
    }

    /// The catalogue of these files, each given by name and text; the name determines its content. `skip_broken_rows`: broken rows are skipped
    /// instead of refusing the catalogue.
    ///
    /// # Errors
    /// Missing or unknown columns, broken rows, duplicate keys, lists with unknown keys.
    pub fn of_texts<N: Into<String>, T: Into<String>>(
        texts: impl IntoIterator<Item = (N, T)>,
        skip_broken_rows: bool,
    ) -> Result<Self, CatalogueError> {
        let texts = texts.into_iter();
        let group = texts.map(|(name, text)| files::formatted(Text::new(name, text)));
        let group = group.collect::<Result<Vec<_>, _>>()?;
        Loader::load(vec![group], Remarks::default(), skip_broken_rows)
    }

    /// Opens the catalogue of these sources, or the built-in one without sources.
    ///
    /// # Errors
    /// A file that cannot be read, a missing or unknown column, broken rows (all in one error), a duplicate key, a list with
    /// an unknown key.
    #[cfg(feature = "fs")]
    pub fn open(sources: &Sources) -> Result<Self, CatalogueError> {
        sources.load()
    }

    /// The built-in catalogue, with motors or gearboxes replaced by a user's file where one is given.
    ///
    /// # Errors
    /// As [`Catalogue::open`].
    #[cfg(feature = "fs")]
    pub fn load(
        motors: Option<&std::path::Path>,
        gearboxes: Option<&std::path::Path>,
    ) -> Result<Self, CatalogueError> {
        Self::open(&Sources {
            motors: motors.map(std::path::Path::to_owned),
            gearboxes: gearboxes.map(std::path::Path::to_owned),
            ..Sources::default()
        })
    }
}

/// Linear interpolation between points, constant beyond them; 1 without points.
fn broken_line(points: &[[f64; 2]], at: f64) -> f64 {
    let after = points.partition_point(|p| p[0] <= at);
    match (
        after.checked_sub(1).and_then(|k| points.get(k)),
        points.get(after),
    ) {
        (Some([x0, y0]), Some([x1, y1])) => y0 + (y1 - y0) * (at - x0) / (x1 - x0),
        (Some([_, y]), None) | (None, Some([_, y])) => *y,
        (None, None) => 1.0,
    }
}
