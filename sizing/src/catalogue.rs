//! The catalogue: motors and gearboxes from CSV files whose header carries the units.

use std::path::Path;

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

mod table;

use table::{Row, Table};

/// The motors and gearboxes that come with the tool, each with its source.
const BUILT_IN: [(&str, &str); 2] = [
    ("motors.csv", include_str!("../catalogue/motors.csv")),
    ("gearboxes.csv", include_str!("../catalogue/gearboxes.csv")),
];

/// A servo motor; SI units. `None`: the data sheet does not say.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Short name, unique in the catalogue.
    pub key: String,
    /// Maker.
    pub maker: String,
    /// Maker's type designation.
    pub model: String,
    /// S1 torque at rated speed (N·m).
    pub rated_torque: f64,
    /// Rated speed (rad/s).
    pub rated_speed: f64,
    /// S1 torque at standstill M0 (N·m).
    pub standstill_torque: Option<f64>,
    /// Peak torque (N·m).
    pub peak_torque: f64,
    /// Largest speed (rad/s).
    pub max_speed: Option<f64>,
    /// Inertia of the rotor (kg·m²).
    pub rotor_inertia: f64,
    /// Speed up to which the peak torque is there (rad/s).
    pub corner_speed: Option<f64>,
    /// Peak torque at the largest speed (N·m).
    pub torque_at_max_speed: Option<f64>,
    /// Mass (kg).
    pub mass: Option<f64>,
    /// Whether the figures were read in the maker's own document.
    pub from_maker: bool,
    /// Where the figures are from.
    pub source: String,
}

/// A gearbox; SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Gearbox {
    /// Short name, unique in the catalogue.
    pub key: String,
    /// Maker.
    pub maker: String,
    /// Maker's type designation.
    pub model: String,
    /// Input speed over output speed.
    pub ratio: f64,
    /// Rated output torque T2N (N·m).
    pub rated_torque: Option<f64>,
    /// Acceleration torque T2B at the output (N·m).
    pub peak_torque: f64,
    /// Rated input speed (rad/s).
    pub rated_speed: Option<f64>,
    /// Largest input speed (rad/s).
    pub max_speed: f64,
    /// Inertia at the input (kg·m²).
    pub inertia: f64,
    /// Efficiency at full load, 0 to 1.
    pub efficiency: f64,
    /// Whether the figures were read in the maker's own document.
    pub from_maker: bool,
    /// Where the figures are from.
    pub source: String,
}

/// What a drive is chosen from.
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    /// Motors, in the file's order.
    pub motors: Vec<Motor>,
    /// Gearboxes, in the file's order. Direct coupling is always a candidate as well.
    pub gearboxes: Vec<Gearbox>,
}

/// A catalogue file that cannot be used.
#[derive(Debug, Error, Diagnostic)]
pub enum CatalogueError {
    /// The file cannot be read.
    #[error("cannot read the catalogue {path}: {reason}")]
    #[diagnostic(help("check the path given with --motors or --gearboxes"))]
    Unreadable {
        /// Path of the file.
        path: String,
        /// What the system says.
        reason: String,
    },
    /// A place in the file is wrong.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wrong(Box<Misplaced>),
    /// No row at all.
    #[error("the catalogue {0} is empty: it holds no {1}")]
    #[diagnostic(help(
        "add at least one row below the header; docs/catalogue.md shows the columns"
    ))]
    Empty(String, &'static str),
}

/// What is wrong at a place of a catalogue file.
#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
pub struct Misplaced {
    message: String,
    #[source_code]
    file: NamedSource<String>,
    #[label("{label}")]
    place: SourceSpan,
    label: String,
    #[help]
    help: String,
}

impl Catalogue {
    /// The built-in catalogue, each half replaced by a file of the user's where one is given.
    ///
    /// # Errors
    /// A file that cannot be read, a column missing or unknown, a figure that is not plausible; with line and column.
    pub fn load(motors: Option<&Path>, gearboxes: Option<&Path>) -> Result<Self, CatalogueError> {
        let [built_in_motors, built_in_gearboxes] = BUILT_IN;
        let (name, text) = source(motors, built_in_motors)?;
        let motors = Table::read(&name, &text)?.rows("motors", motor)?;
        let (name, text) = source(gearboxes, built_in_gearboxes)?;
        let gearboxes = Table::read(&name, &text)?.rows("gearboxes", gearbox)?;
        Ok(Self { motors, gearboxes })
    }
}

fn source(
    path: Option<&Path>,
    (name, text): (&str, &str),
) -> Result<(String, String), CatalogueError> {
    let Some(path) = path else {
        return Ok((format!("built-in {name}"), text.to_owned()));
    };
    let shown = path.display().to_string();
    match std::fs::read_to_string(path) {
        Ok(text) => Ok((shown, text)),
        Err(error) => Err(CatalogueError::Unreadable {
            path: shown,
            reason: error.to_string(),
        }),
    }
}

fn motor(row: &mut Row) -> Result<Motor, CatalogueError> {
    let motor = Motor {
        key: row.key()?,
        maker: row.text("maker")?,
        model: row.text("model")?,
        rated_torque: row.positive("rated_torque")?,
        rated_speed: row.positive("rated_speed")?,
        standstill_torque: row.optional("standstill_torque")?,
        peak_torque: row.positive("peak_torque")?,
        max_speed: row.optional("max_speed")?,
        rotor_inertia: row.positive("rotor_inertia")?,
        corner_speed: row.optional("peak_corner_speed")?,
        torque_at_max_speed: row.optional("peak_torque_at_max_speed")?,
        mass: row.optional("mass")?,
        from_maker: row.is_from_maker()?,
        source: row.text("source")?,
    };
    row.at_least(
        "peak_torque",
        motor.peak_torque,
        "rated_torque",
        motor.rated_torque,
    )?;
    if let Some(max) = motor.max_speed {
        row.at_least("max_speed", max, "rated_speed", motor.rated_speed)?;
    }
    Ok(motor)
}

fn gearbox(row: &mut Row) -> Result<Gearbox, CatalogueError> {
    let gearbox = Gearbox {
        key: row.key()?,
        maker: row.text("maker")?,
        model: row.text("model")?,
        ratio: row.positive("ratio")?,
        rated_torque: row.optional("rated_output_torque")?,
        peak_torque: row.positive("peak_output_torque")?,
        rated_speed: row.optional("rated_input_speed")?,
        max_speed: row.positive("max_input_speed")?,
        inertia: row.positive("input_inertia")?,
        efficiency: row.positive("efficiency")?,
        from_maker: row.is_from_maker()?,
        source: row.text("source")?,
    };
    row.at_most("efficiency", gearbox.efficiency, 1.0)?;
    Ok(gearbox)
}
