//! `[motion] type = "profile"`: positions or speeds over time from a CSV file, as a drive or a motion program records them.

use std::f64::consts::TAU;

use crate::model::coordinate::Coordinate;
use crate::model::motion::{Motion, Recording, Repetition, cutoffs};
use crate::model::repeats::Difference;
use crate::text::file::Files;

use super::drive_link::DriveLink;
use super::motion::{self, PrescribedCoordinate};
use crate::number::rounding::figure;
use crate::text::columns::{Columns, CsvFault, CsvFile, Layout};
use crate::text::csv;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;

mod closing;
mod form;
mod states;

use closing::{CLOSURE, check_speed_closes, closed};
use form::{ACCELERATION, BEND, POSITION, SPEED, TIME_COLUMN, read_columns};

/// A time step this many times the median step is a gap in the recording.
const GAP: f64 = 20.0;

/// A time step this many times shorter than the median means two rows of one instant.
const DOUBLE_ROW: f64 = 1000.0;

/// Cure for most faults of the time column.
const TIMES: &str =
    "give one row for each instant, in order, with enough digits in the times to tell them apart";

/// Keys of `[motion]` about the file.
struct ProfileKeys {
    cyclic: bool,
    /// Start position of a recorded speed (rad or m).
    start: Option<Value>,
    /// Time between rows (s), if the file has no time column.
    step: Option<Value>,
    /// Cut-off frequency of smoothing.
    smoothing: Option<Value>,
    /// Distance by which a cycle may miss its start.
    close_within: Option<Value>,
    /// Speed of the master of an electronic cam, or the time in which it passes the table.
    master_speed: Option<Value>,
    master_time: Option<Value>,
}

/// The motion of the file named in `section`.
pub(super) fn read(
    section: &Section,
    files: &dyn Files,
    prescribed: &PrescribedCoordinate,
) -> Result<Motion> {
    let drive = prescribed.axis;
    let item = section.need("file")?;
    let request = ProfileKeys {
        cyclic: section.get("cyclic").map_or(Ok(true), |item| item.flag())?,
        start: section.given("start")?,
        step: section.given("step")?,
        smoothing: section.given("smoothing")?,
        close_within: section.given("close_within")?,
        master_speed: section.given("master_speed")?,
        master_time: section.given("master_time")?,
    };
    let speed = request.master_speed.as_ref().map(|speed| speed.si);
    let layout = Layout::read(section)?.at_speed("master_speed", speed);
    section.finish()?;
    let file = CsvFile::open(&item, "profile.csv", files)?;
    let columns = read_columns(&file.text, drive.coordinate, &layout, &request);
    let columns = columns.map_err(|fault| {
        let other = drive.coordinate.pick(Coordinate::Length, Coordinate::Angle);
        if read_columns(&file.text, other, &layout, &request).is_err() {
            return file.shows(fault);
        }
        let has = other.pick("angles", "lengths");
        if let (Some(tool), Some(of)) = (&prescribed.tool, section.get("of")) {
            let what = format!("is {}, but the file has {has}, positions of the drive link", tool.name());
            return of.problem(&what, "not those of the file").help(
                "remove `of` from [motion]: `jred fastest` and `jred gentlest` write such profiles of the drive link",
            );
        }
        let (does, own) = other.pick(("slides", "s [mm]"), ("turns", "phi [deg]"));
        let what = format!("has {has}, but the drive link {does}");
        item.problem(&what, "not of the drive link").help(format!(
            "name in [motion] the part that the file tells of, as in the motion that it was made from: of = {{ point = \"carriage\", \
             along = \"x\" }}; or give the positions of the drive link, \"t [s],{own}\""
        ))
    })?;
    check_request(&request, &columns, prescribed)?;
    let repeats =
        |start: f64, way: f64| motion::closed::difference(section, prescribed, start, way);
    curve(&columns, &request, prescribed, &file.text, &repeats).map_err(|fault| file.shows(fault))
}

/// Checks that the keys of `[motion]` match the columns of the file.
fn check_request(
    request: &ProfileKeys,
    columns: &Columns,
    prescribed: &PrescribedCoordinate,
) -> Result<()> {
    let of_positions = columns.get(POSITION).is_some();
    if let (Some(start), true) = (&request.start, of_positions) {
        return Err(start
            .problem("is given, but the file has positions", "not needed")
            .help("a profile of positions starts at its first position; remove this"));
    }
    if let Some(start) = &request.start {
        prescribed.check_start(start)?;
    }
    let stated = of_positions && columns.get(SPEED).is_some();
    if let (Some(smoothing), true) = (&request.smoothing, stated) {
        return Err(smoothing
            .problem("is given, but the file has positions and speeds: the motion goes through both", "not needed")
            .help("remove this, or read the positions alone: columns = { time = \"…\", position = \"…\" }"));
    }
    match (&request.step, columns.get(TIME_COLUMN)) {
        (Some(step), Some(_)) => Err(step
            .problem("is given, but the file has a column for the time", "not needed")
            .help("remove this, or the column")),
        (None, None) => Err(Problem::new("the file has no column for the time")
            .help("add the column \"t [s]\", or write the time between rows into [motion]: step = \"1 ms\"")),
        _ => Ok(()),
    }
}

fn curve(
    columns: &Columns,
    request: &ProfileKeys,
    prescribed: &PrescribedCoordinate,
    text: &str,
    repeats: &Repeats,
) -> std::result::Result<Motion, CsvFault> {
    let drive = prescribed.axis;
    let turn = prescribed.per_turn();
    let span = turn.unwrap_or(drive.domain.span()).abs();
    let times = times(columns, request)?;
    let duration = times.last().copied().unwrap_or_default();
    let cutoff = cutoff(request, &times)?;
    let closing = |what: f64| {
        if request.cyclic {
            Repetition::After(what)
        } else {
            Repetition::Open
        }
    };
    let unmade = |fault| {
        Problem::new(format!("no motion fits these rows: {fault}"))
            .at(csv::header_place(text), "in this file")
    };
    let most = |default: f64| {
        request
            .close_within
            .as_ref()
            .map_or(default, |value| value.si)
    };
    let mut advance = 0.0;
    let motion = if columns.get(POSITION).is_some() && columns.get(SPEED).is_some() {
        let of_cam = columns.get(BEND).is_some();
        let nodes = if let Some(accelerations) = columns.get(ACCELERATION) {
            states::nodes(columns, &times, accelerations, of_cam)?
        } else {
            let slopes = states::slopes(columns, &times, request.cyclic).map_err(unmade)?;
            states::nodes(columns, &times, &slopes, of_cam)?
        };
        if let ([first, .., last], true) = (nodes.as_slice(), request.cyclic) {
            check_speed_closes(columns, columns.get(SPEED).unwrap_or_default())?;
            let way = [first.phi, last.phi - first.phi];
            closed(way, most(CLOSURE * span), columns, prescribed, repeats)?;
        }
        if of_cam {
            Motion::cam(&nodes, request.cyclic)
        } else {
            Motion::nodes(&nodes, request.cyclic)
        }
    } else if let Some(positions) = columns.get(POSITION) {
        let (first, last) = (
            positions.first().copied().unwrap_or_default(),
            positions.last().copied().unwrap_or_default(),
        );
        if request.cyclic {
            let way = [first, last - first];
            advance = closed(way, most(CLOSURE * span), columns, prescribed, repeats)?;
        }
        let recording = Recording {
            times: &times,
            values: positions,
            cutoff,
            closing: closing(advance),
        };
        Motion::positions(&recording).map_err(unmade)?
    } else {
        let speeds = columns.get(SPEED).unwrap_or_default();
        let start = request
            .start
            .as_ref()
            .map_or_else(|| prescribed.start(), |start| start.si);
        if request.cyclic {
            check_speed_closes(columns, speeds)?;
        }
        let mut recording = Recording {
            times: &times,
            values: speeds,
            cutoff,
            closing: Repetition::Open,
        };
        if request.cyclic {
            let way = Motion::speeds(&recording, start)
                .map_err(unmade)?
                .at(duration)
                .phi
                - start;
            let way = [start, way];
            advance = closed(way, most(CLOSURE * span), columns, prescribed, repeats)?;
            recording.closing = Repetition::After(advance);
        }
        Motion::speeds(&recording, start).map_err(unmade)?
    };
    if prescribed.tool.is_none() {
        check_stroke(&motion, &times, columns, drive)?;
    }
    let motion = prescribed.of_tool(motion);
    prescribed.check_reach(&motion, |_, what| {
        Problem::new(format!("the recorded motion {what}"))
            .at(csv::header_place(text), "in this file")
    })?;
    Ok(motion)
}

/// Checks that no row leaves the stroke.
fn check_stroke(motion: &Motion, times: &[f64], columns: &Columns, drive: DriveLink) -> Result<()> {
    let outside = times.iter().position(|t| !drive.reaches(motion.at(*t).phi));
    let Some(row) = outside else {
        return Ok(());
    };
    Err(Problem::new(format!(
        "row {}: the position {} is outside the stroke, {}",
        row + 1,
        drive.coordinate.place(motion.at(times[row]).phi),
        drive.range()
    ))
    .at(columns.place(row), "leaves the stroke")
    .help("give a motion that stays within the stroke, or lengthen it"))
}

/// The times since the first row (s).
fn times(columns: &Columns, request: &ProfileKeys) -> Result<Vec<f64>> {
    if let Some(step) = &request.step {
        return Ok((0..columns.rows()).map(|k| k as f64 * step.si).collect());
    }
    let times = columns.get(TIME_COLUMN).unwrap_or_default();
    let first = times.first().copied().unwrap_or_default();
    if columns.get(ACCELERATION).is_some() {
        return Ok(times.iter().map(|t| t - first).collect());
    }
    columns.check_rising(TIME_COLUMN, "time", TIMES)?;
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    // The usual step is the median, which a single gap does not shift.
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
    if let Some(row) = steps.iter().position(|step| *step > GAP * usual) {
        return Err(Problem::new(format!(
            "there is a gap in the times: row {} is {} s after the previous row; the usual step is {} s",
            row + 2,
            figure(steps[row]),
            figure(usual)
        ))
        .at(columns.place(row + 1), "this row")
        .help(format!(
            "a curve through a gap of more than {GAP} steps would be guesswork: add the missing rows, including those at standstill"
        )));
    }
    let twice = steps.iter().position(|step| *step * DOUBLE_ROW < usual);
    if let (Some(row), None) = (twice, &request.smoothing) {
        return Err(Problem::new(format!(
            "row {} is {} s after the previous row; the usual step is {} s",
            row + 2,
            figure(steps[row]),
            figure(usual)
        ))
        .at(columns.place(row + 1), "this row")
        .help(
            "a curve through two rows that are one instant has a false acceleration between them: remove one of the two",
        ));
    }
    Ok(times.iter().map(|t| t - first).collect())
}

/// The cut-off (rad/s); it must be within the range that the rows allow.
fn cutoff(request: &ProfileKeys, times: &[f64]) -> std::result::Result<Option<f64>, CsvFault> {
    let Some(smoothing) = &request.smoothing else {
        return Ok(None);
    };
    let duration = times.last().copied().unwrap_or_default();
    let [low, high] = cutoffs(times.len(), duration);
    if !(low..=high).contains(&smoothing.si) {
        let what = if low > high {
            format!(
                "is {}, but these rows are too few to be smoothed",
                smoothing.shown()
            )
        } else {
            format!(
                "is {}, but these rows can be smoothed at {} to {} only",
                smoothing.shown(),
                smoothing.show(low),
                smoothing.show(high)
            )
        };
        return Err(CsvFault::InMachine(
            smoothing.problem(&what, "not possible").help(
                "take a frequency well above that of the motion and well below that of the rows; without `smoothing` the curve \
                 goes through every row",
            ),
        ));
    }
    Ok(Some(smoothing.si * TAU))
}

/// How the machine differs after the motion has advanced from a start by a distance; `None` if it does not.
type Repeats<'a> = dyn Fn(f64, f64) -> Result<Option<Difference>> + 'a;
