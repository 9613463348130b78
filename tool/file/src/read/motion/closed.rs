//! Whether a cycle ends where it began.

use jred::machine::Mechanism as _;

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::NamedLoad;
use crate::model::motion::MotionSegment;
use crate::model::repeats::{self, Difference};
use crate::number::rounding::shown;
use crate::read::drive_link::DriveLink;
use crate::text::problem::Result;
use crate::text::section::Section;

use super::PrescribedCoordinate;

/// A cycle closes if its moves miss a whole number of turns by less than this (turns per segment); on a stroke, as a share of the sum of its moves.
const CLOSED: f64 = 1e-9;

/// Checks that a cycle on a stroke ends where it began.
fn check_returns(
    section: &Section,
    parts: &[Section],
    segments: &[MotionSegment],
    drive: DriveLink,
) -> Result<()> {
    let sum: f64 = segments.iter().map(|s| s.distance).sum();
    let ways: f64 = segments.iter().map(|s| s.distance.abs()).sum();
    if sum.abs() <= CLOSED * ways {
        return Ok(());
    }
    let mut problem = section.problem(
        format!(
            "the moves of this cycle add up to {}, so it does not end where it started",
            drive.distance(sum)
        ),
        "a cycle must close",
    );
    for (part, segment) in parts.iter().zip(segments).take(20) {
        if segment.distance != 0.0 {
            problem = problem.at(part.header(), drive.distance(segment.distance));
        }
    }
    Err(problem.help(format!(
        "add a move of {}, or use type = \"point-to-point\" for a motion that does not repeat",
        drive.distance(-sum)
    )))
}

/// Checks that a cycle ends where it began, or after an advance over which the machine repeats.
pub(super) fn check(
    section: &Section,
    parts: &[Section],
    segments: &[MotionSegment],
    start: f64,
    prescribed: &PrescribedCoordinate,
) -> Result<()> {
    let axis = prescribed.axis;
    let Some(per_turn) = prescribed.per_turn() else {
        return check_returns(section, parts, segments, axis);
    };
    let sum = segments.iter().map(|s| s.distance).sum::<f64>();
    let turns = sum / per_turn;
    if (turns.round() - turns).abs() <= CLOSED * segments.len() as f64 {
        return Ok(());
    }
    let Some(difference) = difference(section, prescribed, start, sum)? else {
        return Ok(());
    };
    let mut problem = section.problem(
        format!(
            "the moves of this cycle add up to {}, which is not a whole number of turns{}, and the machine is not the same there: {}{}",
            axis.distance(sum),
            of_the_drive(prescribed),
            in_words(&difference),
            of_load(prescribed, &difference, start, sum)
        ),
        "a cycle must close",
    );
    let moves = parts
        .iter()
        .zip(segments)
        .filter(|(_, segment)| segment.distance != 0.0);
    for (part, segment) in moves.take(20) {
        problem = problem.at(part.header(), axis.distance(segment.distance));
    }
    // Indexing by 1/n turn closes after n cycles.
    let repeats = (1.0 / turns).abs();
    let cure = if repeats > 1.5 && (repeats - repeats.round()).abs() < CLOSED * repeats {
        format!(
            "write the segments {} times, for the whole turn",
            repeats.round()
        )
    } else {
        let whole = turns.round()
            + if turns.round() == 0.0 {
                turns.signum()
            } else {
                0.0
            };
        format!(
            "add a move of {} to reach {}",
            axis.distance((whole - turns) * per_turn),
            axis.distance(whole * per_turn)
        )
    };
    Err(problem.help(format!(
        "{cure}, or use type = \"point-to-point\" for a motion that does not repeat; a load with `between` acts in its part of each turn of the drive link, whatever the motion does"
    )))
}

/// The load whose process torque differs most, as a clause with its name.
fn of_load(
    prescribed: &PrescribedCoordinate,
    difference: &Difference,
    start: f64,
    way: f64,
) -> String {
    let mechanism = prescribed.machine.mechanism();
    let there = difference.phi + prescribed.advance(start, way);
    let at = |named: &NamedLoad, phi: f64| {
        let frames = mechanism.frames(phi).ok()?;
        let parts = named.load.reduce(frames.get(named.load.link())?, phi);
        Some([parts.process, parts.viscous, parts.coulomb])
    };
    let changes = prescribed.loads.iter().filter_map(|named| {
        let [here, there] = [at(named, difference.phi)?, at(named, there)?];
        let apart = here.iter().zip(there).map(|(a, b)| (a - b).abs());
        Some((apart.fold(0.0, f64::max), named))
    });
    let most = changes.max_by(|a, b| a.0.total_cmp(&b.0));
    most.filter(|(apart, _)| *apart > 0.0)
        .map_or_else(String::new, |(_, named)| {
            format!(", by the load \"{}\"", named.name)
        })
}

/// " of the drive link" if another coordinate is prescribed.
pub(in crate::read) fn of_the_drive(prescribed: &PrescribedCoordinate) -> &'static str {
    if prescribed.tool.is_some() {
        " of the drive link"
    } else {
        ""
    }
}

/// How the machine differs after the prescribed coordinate has advanced by `way` from `start`; `None` if it does not.
pub(in crate::read) fn difference(
    section: &Section,
    prescribed: &PrescribedCoordinate,
    start: f64,
    way: f64,
) -> Result<Option<Difference>> {
    repeats::difference(prescribed.machine, prescribed.advance(start, way))
        .map_err(|error| section.error(error, "in this motion"))
}

/// "J_red is 0.12 kg m^2 at φ = 40 deg, and 0.13 kg m^2 a cycle later"
pub(in crate::read) fn in_words(difference: &Difference) -> String {
    let Difference {
        curve,
        unit,
        phi,
        values: [here, there],
    } = difference;
    let size = here.abs().max(there.abs());
    format!(
        "{curve} is {} {unit} at {}, and {} {unit} a cycle later",
        shown(*here, size),
        Coordinate::Angle.place(*phi),
        shown(*there, size)
    )
}
