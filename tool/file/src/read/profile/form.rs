//! The columns of a recorded motion: over time, or over the angle of a master.

use super::ProfileKeys;
use crate::model::coordinate::Coordinate;
use crate::number::spline::MIN_POINTS;
use crate::text::columns::{self, ColumnSpec, Columns, CsvFault, Format, Layout, known};
use crate::text::csv;
use crate::text::problem::Problem;
use crate::units::kind::{
    ACCELERATION as LINEAR_ACCELERATION, ANGLE, ANGULAR_ACCELERATION, ANGULAR_SPEED,
    CAM_ACCELERATION, CAM_TURNING, CAM_VELOCITY, LENGTH, SHARE, TIME, VELOCITY,
};

pub(super) const TIME_COLUMN: usize = 0;
pub(super) const POSITION: usize = 1;
pub(super) const SPEED: usize = 2;
pub(super) const ACCELERATION: usize = 3;

/// Columns of an electronic cam: the master's angle, and the derivatives with respect to it.
const MASTER: usize = 4;
const SLOPE: usize = 5;
const BEND: usize = 6;

/// The columns of a drive link that turns or swings.
const ANGLES: [ColumnSpec; 7] = [
    known(&["t", "time"], &TIME),
    known(&["phi", "φ", "psi", "ψ", "angle", "position"], &ANGLE),
    known(&["omega", "ω", "n", "speed"], &ANGULAR_SPEED),
    known(&["alpha", "α", "acceleration"], &ANGULAR_ACCELERATION),
    known(&["master"], &ANGLE),
    known(&["phi'", "psi'", "slope"], &SHARE),
    known(&["phi''", "psi''", "bend"], &CAM_TURNING),
];

/// The columns of a drive link that slides.
const LENGTHS: [ColumnSpec; 7] = [
    known(&["t", "time"], &TIME),
    known(&["s", "x", "y", "position"], &LENGTH),
    known(&["v", "speed"], &VELOCITY),
    known(&["a", "acceleration"], &LINEAR_ACCELERATION),
    known(&["master"], &ANGLE),
    known(&["s'", "x'", "y'", "slope"], &CAM_VELOCITY),
    known(&["s''", "x''", "y''", "bend"], &CAM_ACCELERATION),
];

/// The columns of a file, converted to functions of time.
pub(super) fn read_columns(
    text: &str,
    coordinate: Coordinate,
    layout: &Layout,
    request: &ProfileKeys,
) -> Result<Columns, CsvFault> {
    let (known, example) = match coordinate {
        Coordinate::Angle => (
            &ANGLES,
            "\"t [s],phi [deg]\" (or t [ms], phi [rad]; or omega [rpm] instead of phi; or master [deg] instead of t)",
        ),
        Coordinate::Length => (
            &LENGTHS,
            "\"t [s],s [mm]\" (or t [ms], s [m]; or v [m/s] instead of s; or master [deg] instead of t)",
        ),
    };
    let format = Format {
        known,
        ignored: |_| false,
        example,
        min_rows: MIN_POINTS,
    };
    let mut columns = columns::read(text, &format, layout)?;
    over_master(&mut columns, request, text)?;
    let given = [POSITION, SPEED, ACCELERATION].map(|index| columns.get(index).is_some());
    if !matches!(
        given,
        [true, false, false] | [false, true, false] | [true, true, _]
    ) {
        return Err(Problem::new(
            "the header must have a column for the position, for the speed, or for both; an acceleration needs both",
        )
        .at(csv::header_place(text), "header")
        .help(format!(
            "the first line gives column names with units: {example}"
        ))
        .into());
    }
    Ok(columns)
}

/// Converts the columns of an electronic cam to time; the master turns at constant speed.
fn over_master(columns: &mut Columns, request: &ProfileKeys, text: &str) -> Result<(), CsvFault> {
    let Some(master) = columns.get(MASTER).map(<[f64]>::to_vec) else {
        return match &request.master_speed {
            Some(speed) => Err(CsvFault::InMachine(
                speed
                    .problem(
                        "is given, but the file has no column for the master",
                        "not needed",
                    )
                    .help("remove this, or name the master's column \"master [deg]\""),
            )),
            None => Ok(()),
        };
    };
    let header = |message: &str, help: &str| {
        Problem::new(message)
            .at(csv::header_place(text), "header")
            .help(help)
    };
    let Some(speed) = &request.master_speed else {
        let help = "write into [motion] how fast the master turns: master_speed = \"60 rpm\"";
        return Err(header("the file is a cam's table over the angle of a master", help).into());
    };
    if [TIME_COLUMN, SPEED, ACCELERATION]
        .iter()
        .any(|index| columns.get(*index).is_some())
    {
        let message = "the file has a column for the master, and columns over the time";
        return Err(header(message, "keep the master with position, slope and bend, or the time with position, speed and acceleration").into());
    }
    let omega = speed.si;
    columns.derive(
        TIME_COLUMN,
        (MASTER, 1.0 / omega),
        master.iter().map(|angle| angle / omega).collect(),
    );
    for (from, to, factor) in [(SLOPE, SPEED, omega), (BEND, ACCELERATION, omega * omega)] {
        if let Some(values) = columns.get(from) {
            let values = values.iter().map(|value| value * factor).collect();
            columns.derive(to, (from, factor), values);
        }
    }
    Ok(())
}
