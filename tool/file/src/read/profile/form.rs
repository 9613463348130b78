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
pub(super) const BEND: usize = 6;

/// The columns of a drive link that turns or swings.
const ANGLES: [ColumnSpec; 7] = [
    known(&["t", "time"], &TIME),
    known(&["phi", "φ", "psi", "ψ", "angle", "dY", "position"], &ANGLE),
    known(&["omega", "ω", "n", "speed"], &ANGULAR_SPEED),
    known(&["alpha", "α", "acceleration"], &ANGULAR_ACCELERATION),
    known(&["dX", "master"], &ANGLE),
    known(&["phi'", "psi'", "dV", "slope"], &SHARE),
    known(&["phi''", "psi''", "dA", "bend"], &CAM_TURNING),
];

/// The columns of a drive link that slides.
const LENGTHS: [ColumnSpec; 7] = [
    known(&["t", "time"], &TIME),
    known(&["s", "x", "y", "dY", "position"], &LENGTH),
    known(&["v", "speed"], &VELOCITY),
    known(&["a", "acceleration"], &LINEAR_ACCELERATION),
    known(&["dX", "master"], &ANGLE),
    known(&["s'", "x'", "y'", "dV", "slope"], &CAM_VELOCITY),
    known(&["s''", "x''", "y''", "dA", "bend"], &CAM_ACCELERATION),
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
        of_log: true,
        example,
        min_rows: 2,
    };
    let mut columns = columns::read(text, &format, layout)?;
    over_master(&mut columns, request, text)?;
    if columns.get(ACCELERATION).is_none() {
        columns.check_rows(MIN_POINTS, text)?;
    }
    let given = [POSITION, SPEED, ACCELERATION].map(|index| columns.get(index).is_some());
    if !matches!(
        given,
        [true, false, false] | [false, true, false] | [true, true, _]
    ) {
        let message = "the header must have a column for the position, for the speed, or for both; an acceleration needs both";
        return Err(columns.lacks(message, text, example).into());
    }
    Ok(columns)
}

/// Converts the columns of an electronic cam to time; the master turns at constant speed.
fn over_master(columns: &mut Columns, request: &ProfileKeys, text: &str) -> Result<(), CsvFault> {
    let given = request
        .master_speed
        .as_ref()
        .or(request.master_time.as_ref());
    let Some(master) = columns.get(MASTER).map(<[f64]>::to_vec) else {
        return match given {
            Some(key) => Err(CsvFault::InMachine(
                key.problem(
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
    let Some(given) = given else {
        let help = "write into [motion] how fast the master turns, master_speed = \"60 rpm\", or in which time it passes the table, \
                    master_time = \"1 s\"";
        return Err(header("the file is a cam's table over the angle of a master", help).into());
    };
    let omega = match (&request.master_speed, master.as_slice()) {
        (Some(speed), _) => speed.si,
        (None, [first, .., last]) if last > first => (last - first) / given.si,
        _ => {
            let message = "the master does not turn forwards from the first row to the last";
            return Err(header(message, "give the rows in the order of the master's angle").into());
        }
    };
    if [TIME_COLUMN, SPEED, ACCELERATION]
        .iter()
        .any(|index| columns.get(*index).is_some())
    {
        let message = "the file has a column for the master, and columns over the time";
        return Err(header(message, "keep the master with position, slope and bend, or the time with position, speed and acceleration").into());
    }
    columns.derive(TIME_COLUMN, MASTER, 1.0 / omega);
    for (from, to, factor) in [(SLOPE, SPEED, omega), (BEND, ACCELERATION, omega * omega)] {
        if columns.get(from).is_some() {
            columns.derive(to, from, factor);
        }
    }
    Ok(())
}
