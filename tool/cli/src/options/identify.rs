//! Options of `jred identify`.

use std::path::PathBuf;

use clap::Args;

use super::documents::Documents;
use super::word::word;
use jred_analysis::identify::Shaft;
use jred_report::table::output::Format;

/// `jred identify`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 done; 1 the log has a fault that spoils the result; 2 bad input.\n\
                  The CSV of the answer is a file for [mechanism] type = \"reduced-curves\": jred export reads it."
)]
pub struct Identify {
    /// Logs of the drive (CSV): time, position and torque or current. Further ones are repeats of the same run.
    #[arg(required = true, value_name = "LOG")]
    pub logs: Vec<PathBuf>,
    /// Machine file of the design.
    #[arg(long, value_name = "FILE")]
    pub machine: PathBuf,
    /// Titles of the log's columns: time=…, position=…, torque=… or current=…, separated by commas; a unit in brackets where the title has none.
    #[arg(long, value_name = "NAME=TITLE", value_delimiter = ',', value_parser = column)]
    pub columns: Vec<(String, String)>,
    /// Lines above the header.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=10_000))]
    pub skip_rows: u32,
    /// Counts of a turn of the encoder, for positions in counts; also the step of its noise.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub counts_per_turn: Option<u32>,
    /// Torque of a current, e.g. "1.2 N m/A", for a log of currents.
    #[arg(long, value_name = "CONSTANT", value_parser = jred_file::argument::positive(&jred_file::units::kind::TORQUE_CONSTANT))]
    pub torque_constant: Option<f64>,
    /// Rated torque of the drive, e.g. "2.4 N m", for a log of torques in per mille, % or 0.1% of it (CiA 402).
    #[arg(long, value_name = "TORQUE", value_parser = jred_file::argument::positive(&jred_file::units::kind::TORQUE))]
    pub rated_torque: Option<f64>,
    /// Shaft of the log.
    #[arg(long, value_parser = word::<Shaft>(), default_value_t)]
    pub shaft: Shaft,
    /// The torque of the log counts against that of the machine file.
    #[arg(long)]
    pub reverse_torque: bool,
    /// The position of the log counts against that of the machine file.
    #[arg(long)]
    pub reverse_position: bool,
    /// Position of the log where the drive link is at φ = 0 of the machine file, e.g. "37.5 deg", at the shaft of the log.
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, value_parser = jred_file::argument::any(&jred_file::units::kind::ANGLE))]
    pub zero: Option<f64>,
    /// Inertia of the rotor and its gearbox at the motor, which is taken out of J, e.g. "12 kg cm^2".
    #[arg(long, value_name = "INERTIA", value_parser = jred_file::argument::not_negative(&jred_file::units::kind::INERTIA))]
    pub rotor_inertia: Option<f64>,
    /// Orders of the motor's cogging in a turn of the drive link, e.g. 36,72.
    #[arg(long, value_name = "ORDERS", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub cogging: Vec<u32>,
    /// Delay of the logged torque behind the position, e.g. "1 ms", if it is known, 50 ms at most; found if not given.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = jred_file::argument::any(&jred_file::units::kind::TIME))]
    pub delay: Option<f64>,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
}

/// A column and its title.
fn column(text: &str) -> Result<(String, String), String> {
    const NAMES: [&str; 4] = ["time", "position", "torque", "current"];
    match text.split_once('=') {
        Some((name, title)) if NAMES.contains(&name.trim()) && !title.trim().is_empty() => {
            Ok((name.trim().to_owned(), title.trim().to_owned()))
        }
        _ => Err(format!(
            "write one of {} and its title, for example time=Time [ms]",
            NAMES.join(", ")
        )),
    }
}
