//! `[motion] type = "profile"`: recorded positions from a CSV file.

use std::f64::consts::TAU;
use std::ops::Range;
use std::path::Path;

use jred::Domain;

use crate::coordinate::Coordinate;
use crate::motion::Motion;

use super::drive_link::DriveLink;
use super::file;
use super::motion;
use super::problem::{Problem, Result, closest, figure};
use super::section::Section;

/// The largest CSV file (bytes).
const MAX_SIZE: u64 = 64 << 20;

/// The fewest rows that a curve can be laid through.
const MIN_ROWS: usize = 5;

/// Largest relative deviation of a time step.
const STEP_TOLERANCE: f64 = 1e-6;

/// A cyclic profile closes if it misses a whole number of turns by less than this (turns).
const CLOSED: f64 = 1e-5;

/// A column: its name, the factor to SI and whether it is the time.
type Column = (&'static str, f64, bool);

/// The columns of a drive link that turns or swings.
const ANGLES: [Column; 4] = [
    ("t [s]", 1.0, true),
    ("t [ms]", 1e-3, true),
    ("phi [deg]", std::f64::consts::PI / 180.0, false),
    ("phi [rad]", 1.0, false),
];

/// The columns of one that slides.
const LENGTHS: [Column; 4] = [
    ("t [s]", 1.0, true),
    ("t [ms]", 1e-3, true),
    ("s [mm]", 1e-3, false),
    ("s [m]", 1.0, false),
];

/// The columns that a profile of this drive link may have, and the header to suggest.
const fn columns_of(drive: DriveLink) -> ([Column; 4], &'static str) {
    match drive.coordinate {
        Coordinate::Angle => (ANGLES, "\"t [s],phi [deg]\" (or t [ms], phi [rad])"),
        Coordinate::Length => (LENGTHS, "\"t [s],s [mm]\" (or t [ms], s [m])"),
    }
}

/// The cure of most things that are wrong with the time column.
const RESAMPLE: &str =
    "record or resample the motion at equal time steps, and give the times with more digits";

/// A row with its place in the CSV file.
struct Row {
    t: f64,
    phi: f64,
    place: Range<usize>,
}

/// The motion of the file named in `section`.
pub(super) fn read(section: &Section, folder: &Path, drive: DriveLink) -> Result<Motion> {
    let item = section.require("file", "file = \"profile.csv\"")?;
    let name = item.text("profile.csv")?;
    let cyclic = section.get("cyclic").map_or(Ok(true), |item| item.flag())?;
    motion::finish(section)?;
    let path = folder.join(name);
    let text = file::read(&path, MAX_SIZE).map_err(|fault| {
        item.problem(&format!("cannot be read: {}", fault.message), "this file")
            .help(fault.help)
    })?;
    curve(&text, cyclic, drive)
        .map_err(|problem| problem.in_file(&path.display().to_string(), &text))
}

fn curve(text: &str, cyclic: bool, drive: DriveLink) -> Result<Motion> {
    let mut rows = rows(text, drive)?;
    let step = check_times(&rows, text, drive)?;
    let outside = |row: &&Row| !drive.reaches(row.phi);
    if let Some(row) = rows.iter().find(outside) {
        return Err(Problem::new(format!(
            "the position {} lies outside the stroke, {}",
            drive.coordinate.place(row.phi),
            drive.range()
        ))
        .at(row.place.clone(), "leaves the stroke")
        .help("record a motion that stays within the stroke of the mechanism"));
    }
    if let (true, [first, .., last], Domain::Stroke { .. }) =
        (cyclic, rows.as_mut_slice(), drive.domain)
    {
        let gap = last.phi - first.phi;
        if gap.abs() > CLOSED * drive.domain.span() {
            return Err(Problem::new(format!(
                "the last position lies {} {} from the first one",
                figure(drive.coordinate.shown(gap)),
                drive.coordinate.unit()
            ))
            .at(first.place.clone(), "first position")
            .at(last.place.clone(), "last position")
            .help(
                "a cyclic motion ends where it began; for a motion that does not repeat write cyclic = false in \
                 [motion]",
            ));
        }
        last.phi = first.phi;
    } else if let (true, [first, .., last]) = (cyclic, rows.as_mut_slice()) {
        let turns = (last.phi - first.phi) / TAU;
        let gap = turns - turns.round();
        if gap.abs() > CLOSED {
            return Err(Problem::new(format!(
                "the last position lies {} deg {} a whole number of turns from the first one",
                figure(gap.abs() * 360.0),
                if gap > 0.0 { "beyond" } else { "short of" }
            ))
            .at(first.place.clone(), "first position")
            .at(last.place.clone(), "last position")
            .help(
                "a cyclic motion ends where it began or whole turns further on, with the last row at the end of the \
                 cycle; for a motion that does not repeat write cyclic = false in [motion]",
            ));
        }
        last.phi = first.phi + turns.round() * TAU;
    }
    let phi: Vec<f64> = rows.iter().map(|row| row.phi).collect();
    Motion::profile(&phi, step, cyclic)
        .map_err(|error| Problem::new(format!("no motion can be made of these positions: {error}")))
}

/// Checks that the times rise in equal steps, and returns the step (s).
fn check_times(rows: &[Row], text: &str, drive: DriveLink) -> Result<f64> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Err(too_short(0, text, drive));
    };
    if rows.len() < MIN_ROWS {
        return Err(too_short(rows.len(), text, drive));
    }
    let mut steps: Vec<f64> = Vec::with_capacity(rows.len());
    for (number, (row, next)) in rows.iter().zip(rows.iter().skip(1)).enumerate() {
        if next.t <= row.t {
            return Err(Problem::new(format!(
                "the time does not rise: row {} has {} s after {} s",
                number + 2,
                figure(next.t),
                figure(row.t)
            ))
            .at(next.place.clone(), "this row")
            .help(RESAMPLE));
        }
        steps.push(next.t - row.t);
    }
    // The usual step is the middle one: a single gap then does not shift what is expected of all others.
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let expected = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
    let odd = |step: &f64| (step / expected - 1.0).abs() > STEP_TOLERANCE;
    if let Some(k) = steps.iter().position(odd) {
        let row = rows.get(k + 1).unwrap_or(last);
        let found = steps.get(k).copied().unwrap_or_default();
        return Err(Problem::new(format!(
            "the time steps are not equal: row {} comes {found:.9} s after the row before, expected {expected:.9} s",
            k + 2
        ))
        .at(row.place.clone(), "this row")
        .help(RESAMPLE));
    }
    Ok((last.t - first.t) / steps.len() as f64)
}

fn too_short(rows: usize, text: &str, drive: DriveLink) -> Problem {
    let end = text.trim_end().len();
    Problem::new(format!(
        "the profile has {rows} rows, but needs at least {MIN_ROWS}"
    ))
    .at(end..end, "ends here")
    .help(format!(
        "give the columns {} and one row for each time step",
        columns_of(drive).1
    ))
}

/// Reads header and rows.
fn rows(text: &str, drive: DriveLink) -> Result<Vec<Row>> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .has_headers(true)
        .flexible(true)
        .from_reader(text.as_bytes());
    let header = reader
        .headers()
        .map_err(|error| broken(&error, text, drive))?
        .clone();
    let columns = columns(&header, text, drive)?;
    let mut rows = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let record = record.map_err(|error| broken(&error, text, drive))?;
        let start = record.position().map_or(0, |p| p.byte() as usize);
        let place = line_at(text, start);
        if record.len() != columns.len() {
            return Err(Problem::new(format!(
                "row {} has {} values, but the header has {} columns",
                index + 1,
                record.len(),
                columns.len()
            ))
            .at(place, "this row")
            .help("separate values with a comma and write decimals with a point"));
        }
        let mut row = Row {
            t: 0.0,
            phi: 0.0,
            place,
        };
        for (field, (name, factor, is_time)) in record.iter().zip(&columns) {
            let value = field.parse::<f64>().ok().filter(|value| value.is_finite());
            let Some(value) = value else {
                return Err(Problem::new(format!(
                    "row {}: \"{field}\" in the column \"{name}\" is not a finite number",
                    index + 1
                ))
                .at(row.place, "this row")
                .help("write plain numbers with a decimal point, without units, such as 12.5"));
            };
            let target = if *is_time { &mut row.t } else { &mut row.phi };
            *target = value * factor;
        }
        rows.push(row);
    }
    Ok(rows)
}

/// What the header's columns are.
fn columns(header: &csv::StringRecord, text: &str, drive: DriveLink) -> Result<Vec<Column>> {
    let (known, shape) = columns_of(drive);
    let help = format!("the first line must be {shape}, separated by a comma");
    let place = line_at(text, 0);
    let names = known.map(|(name, ..)| name);
    let mut columns: Vec<Column> = Vec::new();
    for name in header
        .iter()
        .map(|name| name.trim_start_matches('\u{feff}'))
    {
        let Some(column) = known.into_iter().find(|(known, ..)| *known == name) else {
            let near = closest(name, &names)
                .map_or_else(String::new, |near| format!("did you mean \"{near}\"? "));
            return Err(Problem::new(format!("the column \"{name}\" is not known"))
                .at(place, "header")
                .help(format!("{near}{help}")));
        };
        columns.push(column);
    }
    let times = columns.iter().filter(|(.., is_time)| *is_time).count();
    if columns.len() == 2 && times == 1 {
        return Ok(columns);
    }
    Err(
        Problem::new("the header must have one column for the time and one for the position")
            .at(place, "header")
            .help(help),
    )
}

/// The line that begins at or after `start`.
fn line_at(text: &str, start: usize) -> Range<usize> {
    let rest = text.get(start..).unwrap_or_default();
    let start = start + rest.len() - rest.trim_start().len();
    let line = text.get(start..).unwrap_or_default();
    let length = line.find(['\n', '\r']).unwrap_or(line.len());
    start..start + length
}

fn broken(error: &csv::Error, text: &str, drive: DriveLink) -> Problem {
    let start = error.position().map_or(0, |p| p.byte() as usize);
    Problem::new(format!("not a readable CSV file: {error}"))
        .at(line_at(text, start), "here")
        .help(format!(
            "give two columns of numbers under the header {}",
            columns_of(drive).1
        ))
}
