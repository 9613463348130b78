//! Closing of a recorded cycle: its speeds at both ends, and its advance.

use super::{CsvFault, PrescribedCoordinate, Repeats, SPEED};
use crate::math;
use crate::number::rounding::figure;
use crate::read::motion::closed;
use crate::text::columns::Columns;
use crate::text::problem::{Problem, Result};

/// A cyclic profile closes if it misses a whole number of turns, or on a stroke its start, by less than this share of a turn or of the stroke. The
/// file can give another tolerance.
pub(super) const CLOSURE: f64 = 1e-5;

/// Share of the largest speed by which the first and the last speed of a cycle may differ.
const SPEED_CLOSED: f64 = 0.01;

/// Checks that the first and the last speed of a cycle agree.
pub(super) fn check_speed_closes(columns: &Columns, speeds: &[f64]) -> Result<()> {
    let [first, .., last] = speeds else {
        return Ok(());
    };
    let most = speeds.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    if (last - first).abs() <= SPEED_CLOSED * most {
        return Ok(());
    }
    let [first, last] = [*first, *last].map(|v| columns.shown(SPEED, v));
    Err(
        Problem::new(format!("the cycle starts with {first} and ends with {last}"))
            .at(columns.place(0), "first speed")
            .at(columns.place(columns.rows() - 1), "last speed")
            .help(
                "a cyclic motion ends with the speed it starts with, and its last row is at the end of the cycle: cut \
                 the recording where the speeds match; for a motion that does not repeat write cyclic = false in \
                 [motion]",
            ),
    )
}

/// Advance of a cycle (rad or m): whole turns, or zero on a stroke, if its distance from the start misses them by at most `most`; else any distance
/// after which the machine is the same.
pub(super) fn closed(
    [start, way]: [f64; 2],
    most: f64,
    columns: &Columns,
    prescribed: &PrescribedCoordinate,
    repeats: &Repeats,
) -> std::result::Result<f64, CsvFault> {
    let drive = prescribed.axis;
    let turn = prescribed.per_turn();
    let whole = turn.map_or(0.0, |turn| (way / turn).round() * turn);
    let gap = way - whole;
    if gap.abs() <= most {
        return Ok(whole);
    }
    let mut differs = String::new();
    if turn.is_some() {
        let Some(difference) = repeats(start, way).map_err(CsvFault::InMachine)? else {
            return Ok(way);
        };
        differs = format!(
            "{}, and the machine is not the same there: {}",
            closed::of_the_drive(prescribed),
            closed::in_words(&difference)
        );
    }
    let shown = |gap: f64| {
        let unit = drive.coordinate.unit();
        format!("{} {unit}", figure(drive.coordinate.shown(gap)))
    };
    let message = match turn {
        None => format!(
            "the last position is {} away from the first one",
            shown(gap)
        ),
        Some(_) => format!(
            "the last position is {} {} a whole number of turns from the first one{differs}",
            shown(gap.abs()),
            if gap > 0.0 { "beyond" } else { "short of" }
        ),
    };
    Err(Problem::new(message)
        .at(columns.place(0), "first position")
        .at(columns.place(columns.rows() - 1), "last position")
        .help(format!(
            "a cyclic motion ends where it started or whole turns further, and its last row is at the end of the \
             cycle; for a motion that does not repeat write cyclic = false in [motion]; if the difference is \
             measurement error, write close_within = \"{}\": it is then spread over the cycle as a constant speed",
            format_args!("{} {}", figure(rounded_up(drive.coordinate.shown(gap.abs()))), drive.coordinate.unit())
        ))
        .into())
}

/// The gap plus 5 %, rounded up to two digits.
fn rounded_up(gap: f64) -> f64 {
    let unit = 10f64.powi(math::log10(gap).floor() as i32 - 1);
    (gap / unit * 1.05).ceil() * unit
}
