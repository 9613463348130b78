//! `jred simulate`.

use std::path::PathBuf;

use clap::Args;

use super::catalogue::CatalogueFiles;
use super::documents::Documents;
use super::word::word;
use jred_report::table::output::Format;

/// `jred simulate`
#[derive(Debug, Args)]
pub struct Simulate {
    /// Machine file, with a `[simulation]`. Further ones are machines on the same motor shaft, each with its own drive train, whose drive links start
    /// as in their own `[simulation]`.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Lead of a further machine's drive link over that start, e.g. "180 deg"; one for each of them, in order.
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, value_parser = jred_file::argument::any(&jred_file::units::kind::ANGLE))]
    pub phase: Vec<f64>,
    /// The drive instead of the motor in `[simulation]`: MOTOR+GEARBOX, or MOTOR for a direct drive. Without a controller it gives its full torque.
    #[arg(long, value_name = "MOTOR+GEARBOX")]
    pub drive: Option<String>,
    /// Report when the drive link, or the axis, first reaches this speed, e.g. "120 rpm", in either direction.
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub to_speed: Option<String>,
    /// Switch the motor off at this many instants over the last cycle before the `stop` of the file, and report the longest distance and time to
    /// rest.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub stops: Option<u32>,
    /// Add columns of the parts of the drive torque: acceleration, change of the inertia, weight and springs, process loads, viscous and dry
    /// friction.
    #[arg(long)]
    pub torques: bool,
    /// Add columns of every named point, centre of mass and link: positions, transfer functions, velocities and accelerations.
    #[arg(long)]
    pub points: bool,
    /// Add columns of drive torque, joint forces, shaking force and moment by d'Alembert's principle.
    #[arg(long)]
    pub reactions: bool,
    /// Catalogue.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
}
