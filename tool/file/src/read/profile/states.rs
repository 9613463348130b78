//! A profile with position, speed and acceleration in each row: the motion itself, with its corners. Two rows with the same time are a step of the
//! acceleration.

use crate::model::motion::Node;
use crate::text::columns::Columns;
use crate::text::problem::{Problem, Result};

use super::{ACCELERATION, POSITION, SPEED, TIME_COLUMN};
use crate::number::spline::{FitMethod, Spline, SplineError};

/// Tolerances between rows: of the position in shares of the largest speed times the step, of the speed in shares of the largest acceleration times
/// the step. Larger deviations mean a wrong unit.
const ROW_TOLERANCE: [f64; 2] = [0.05, 0.7];

/// Share of the range of positions, and of the largest speed, that is added for short steps: rounding of the digits.
const DIGITS: f64 = 1e-4;

const CURE: &str = "each column is the derivative of the one before over the time: check the units; to lay a smooth curve through the \
                    positions alone, name them: columns = { time = \"…\", position = \"…\" }";

/// The accelerations of rows with positions and speeds only: the slope of the twice continuously differentiable curve through the speeds.
pub(super) fn slopes(
    columns: &Columns,
    times: &[f64],
    cyclic: bool,
) -> std::result::Result<Vec<f64>, SplineError> {
    let speeds = columns.get(SPEED).unwrap_or_default();
    let curve = match times {
        [inner @ .., end] if cyclic && speeds.len() == times.len() => Spline::periodic(
            inner,
            &speeds[..inner.len()],
            *end,
            FitMethod::Interpolating,
        )?,
        _ => Spline::bounded(times, speeds, FitMethod::Interpolating)?,
    };
    Ok(times.iter().map(|t| curve.at(*t)[1]).collect())
}

/// The nodes for these rows, times and accelerations. Each row must follow from the one before, unless they are the points of a cam, which may be far
/// apart.
pub(super) fn nodes(
    columns: &Columns,
    times: &[f64],
    accelerations: &[f64],
    of_cam: bool,
) -> Result<Vec<Node>> {
    let column = |index: usize| columns.get(index).unwrap_or_default();
    let [positions, speeds] = [POSITION, SPEED].map(column);
    let mut nodes: Vec<Node> = Vec::with_capacity(times.len());
    let mut rows: Vec<usize> = Vec::with_capacity(times.len());
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let range = largest(
        &positions
            .iter()
            .map(|x| x - positions[0])
            .collect::<Vec<_>>(),
    );
    let [fastest, hardest] = [speeds, accelerations].map(largest);
    for (row, &t) in times.iter().enumerate() {
        let (phi, omega, alpha) = (positions[row], speeds[row], accelerations[row]);
        let count = nodes.len();
        let Some(last) = nodes.last_mut().filter(|last| t <= last.t) else {
            let step = nodes.last().map_or(0.0, |last| t - last.t);
            nodes.push(Node {
                t,
                step,
                phi,
                omega,
                alpha: [alpha; 2],
            });
            rows.push(row);
            continue;
        };
        let same = (phi - last.phi).abs() <= DIGITS * range
            && (omega - last.omega).abs() <= DIGITS * fastest;
        if rows[count - 1] + 1 != row || !same {
            return Err(columns
                .problem(TIME_COLUMN, row, "does not increase")
                .help("times rise; two rows of the same time, with the same position and speed, are a jump of the acceleration"));
        }
        last.alpha[1] = alpha;
    }
    if of_cam {
        columns.check_slope(POSITION, SPEED, times)?;
        columns.check_slope(SPEED, ACCELERATION, times)?;
    }
    let checked = if of_cam { Vec::new() } else { rows };
    for (pair, row) in nodes.windows(2).zip(checked.into_iter().skip(1)) {
        let [before, after] = [&pair[0], &pair[1]];
        let [position, speed] = after.missed_since(before).map(f64::abs);
        let step = after.step;
        if position > ROW_TOLERANCE[0] * step * fastest + DIGITS * range {
            return Err(columns
                .problem(
                    POSITION,
                    row,
                    "does not follow from the speeds since the row before",
                )
                .help(CURE));
        }
        if speed > ROW_TOLERANCE[1] * step * hardest + DIGITS * fastest {
            return Err(columns
                .problem(
                    SPEED,
                    row,
                    "does not follow from the accelerations since the row before",
                )
                .help(CURE));
        }
    }
    if nodes.len() < 2 {
        return Err(
            Problem::new("the motion has one instant only").help("give rows at several times")
        );
    }
    Ok(nodes)
}
