//! A log of a drive: time, position and torque or current, from a CSV file.
//!
//! The header of the measured four-bar linkage of DaRUS (doi 10.18419/darus-4152) is known; others have units in their titles, or are named.

use crate::plain;
use crate::problem;
use crate::text::columns::{self, ColumnSpec, CsvFault, Format, Layout, known};
use crate::text::file::Files;
use crate::text::problem::{Problem, Result};
use crate::units::kind::{ANGLE, CURRENT, TIME, TORQUE};

/// The largest log (bytes).
const MAX_LOG: u64 = 64 << 20;

const TIME_COLUMN: usize = 0;
const POSITION: usize = 1;
const TORQUE_COLUMN: usize = 2;
const CURRENT_COLUMN: usize = 3;

const COLUMNS: [ColumnSpec; 4] = [
    known(&["t", "time"], &TIME),
    known(&["phi", "φ", "angle", "position"], &ANGLE),
    known(&["M", "torque"], &TORQUE),
    known(&["i", "current"], &CURRENT),
];

/// A header to suggest.
const EXAMPLE: &str = "\"time [s],position [deg],torque [N m]\" (or position [counts] with --counts-per-turn, current [A] with --torque-constant); titles of other names: --columns \"time=TITLE,position=TITLE,torque=TITLE\"";

/// Header of the DaRUS log, without its `%`, and its columns.
const FOUR_BAR: &str = "Time s, Goal Current mA, Present Current mA, Present Voltage V, Present Position rad, Present Velocity rad/s";
const FOUR_BAR_COLUMNS: [(&str, &str); 3] = [
    ("time", "Time s [s]"),
    ("position", "Present Position rad [rad]"),
    ("current", "Present Current mA [mA]"),
];

/// How a log is to be read.
#[derive(Clone, Debug, Default)]
pub struct LogLayout {
    /// Titles of the columns by `time`, `position`, `torque` and `current`.
    pub columns: Vec<(String, String)>,
    /// Counts of a turn of the encoder, for positions in counts.
    pub counts_per_turn: Option<u32>,
    /// Torque of a current (N·m/A).
    pub torque_constant: Option<f64>,
    /// Rated torque of the drive (N·m), for torques that are shares of it.
    pub rated_torque: Option<f64>,
    /// Lines above the header.
    pub skipped: u32,
}

/// A log, of the shaft on which it was recorded.
#[derive(Clone, Debug, Default)]
pub struct DriveLog {
    /// Times (s), as in the file.
    pub time: Vec<f64>,
    /// Positions (rad).
    pub position: Vec<f64>,
    /// Torques (N·m).
    pub torque: Vec<f64>,
}

/// Reads the log of this name; its path is relative to the current folder.
///
/// # Errors
/// The first fault of the file, with its place.
pub fn drive_log(name: &str, files: impl Files, layout: &LogLayout) -> Result<DriveLog> {
    let text = files.text(name, MAX_LOG).map_err(|fault| {
        problem!(
            help = fault.help,
            "{} cannot be read: {}",
            plain::quoted(name),
            fault.message
        )
    })?;
    let shown = files.shown(name);
    // The same length, so that places stay.
    let plain = if text.starts_with("% ") {
        text.replacen("% ", "  ", 1)
    } else {
        text.clone()
    };
    let first = plain.lines().next().unwrap_or_default().trim();
    let named: Vec<(String, String)> = if layout.columns.is_empty() && first == FOUR_BAR {
        let named = FOUR_BAR_COLUMNS.iter();
        named
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()))
            .collect()
    } else {
        layout.columns.clone()
    };
    let read = || -> std::result::Result<DriveLog, CsvFault> {
        let own = Layout::of_options(&named, layout.counts_per_turn, layout.skipped)
            .at_rated_torque(layout.rated_torque);
        let format = Format {
            known: &COLUMNS,
            ignored: |_| true,
            of_log: true,
            example: EXAMPLE,
            min_rows: 2,
        };
        let columns = columns::read(&plain, &format, &own)?;
        let column = |index: usize, message: &str| {
            let values = columns.get(index).map(<[f64]>::to_vec);
            values.ok_or_else(|| columns.lacks(message, &plain, EXAMPLE))
        };
        let torque_unit = columns.unit(TORQUE_COLUMN);
        let is_share = torque_unit.and_then(columns::share).is_some();
        if layout.rated_torque.is_some() && torque_unit.is_some() && !is_share {
            let problem = Problem::new(
                "--rated-torque is given, but the log has no torque in per mille or % of it",
            );
            return Err(problem
                .help("leave out --rated-torque, or write the unit: torque [per mille]")
                .into());
        }
        let torque = match (columns.get(TORQUE_COLUMN), columns.get(CURRENT_COLUMN)) {
            (Some(torque), _) => torque.to_vec(),
            (None, Some(current)) => {
                let constant = layout.torque_constant.ok_or_else(|| {
                    Problem::new("the log has a current, and its torque is not given")
                        .help("give the torque constant of the data sheet: --torque-constant \"1.2 N m/A\"")
                })?;
                current.iter().map(|current| current * constant).collect()
            }
            (None, None) => {
                let message = "the log has no column for the torque, nor for the current";
                return Err(columns.lacks(message, &plain, EXAMPLE).into());
            }
        };
        Ok(DriveLog {
            time: column(TIME_COLUMN, "the log has no column for the time")?,
            position: column(POSITION, "the log has no column for the position")?,
            torque,
        })
    };
    let cured = |problem: Problem| {
        let cure = problem.cure().unwrap_or_default().to_owned();
        if cure.contains("counts_per_turn") {
            problem.help("give the counts of a turn of the encoder: --counts-per-turn 8192")
        } else if cure == columns::IN_NEWTON_METRES {
            problem.help(
                "give the rated torque of the drive (CiA 402: object 0x6076): --rated-torque \"2.4 N m\"",
            )
        } else if cure.contains("leave no cell empty") {
            problem.help(format!(
                "{cure}; or delete the row: a missing sample does no harm"
            ))
        } else {
            problem
        }
    };
    read().map_err(|fault| match fault {
        CsvFault::InFile(problem) => cured(problem).in_file(&shown, &text.into()),
        CsvFault::InMachine(problem) => cured(problem),
    })
}
