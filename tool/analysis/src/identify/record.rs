//! From the rows of a log to samples at equal steps.

use std::f64::consts::{PI, TAU};

use super::Samples;
use super::clock::Clock;
use super::smooth::noise;

/// Gaps of up to this duration (s) are interpolated: what a motion does in it is below the noise.
const SHORT_GAP: f64 = 4e-3;

/// Times off the equal steps by more than this share of a step are reported.
const JITTER: f64 = 0.2;

/// The position must be smoother by this factor for the times to be those of the samples.
const SMOOTHER: f64 = 0.5;

/// Equal largest torques in a row that are a limit of the drive.
const EQUAL: usize = 3;

/// Range of an angle within one turn, which rounded values may exceed.
const ONE_TURN: f64 = 1.001 * TAU;

/// In fewer rows a large step of the position is no jump.
const LEAST_ROWS: usize = 100;

/// Share of saturated samples from which on they are reported.
const SATURATED: f64 = 0.002;

/// A log with more missing samples than rows is several logs.
const MISSING: f64 = 1.0;

/// A fault of the rows that was repaired. Rows are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Repair {
    /// Rows of the same instant as the one before are left out.
    Duplicates {
        /// Their number.
        count: usize,
        /// The first.
        row: usize,
    },
    /// Missing samples.
    Gaps {
        /// Number of gaps.
        count: usize,
        /// The row after the first.
        row: usize,
        /// Duration of the longest (s).
        longest: f64,
    },
    /// Times that scatter.
    Jitter {
        /// Largest distance from equal steps (s).
        by: f64,
        /// Whether the samples are at equal steps all the same: so the position is smoother. Else position and torque are interpolated.
        equal: bool,
    },
    /// The torque reaches a limit: these samples are left out.
    Saturated {
        /// Their number.
        count: usize,
        /// The first.
        row: usize,
        /// The torque (N·m).
        torque: f64,
    },
}

/// A fault of the rows that cannot be repaired. Rows are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecordFault {
    /// A time is before that of the row before.
    Backwards {
        /// The row.
        row: usize,
        /// Its time (s).
        time: f64,
        /// The time before (s).
        before: f64,
    },
    /// The turns within a gap are not known: the encoder counts within one turn.
    Turns {
        /// The row after the gap.
        row: usize,
        /// Its duration (s).
        gap: f64,
        /// The longest that is possible at the log's largest speed (s).
        longest: f64,
    },
    /// The position jumps by more than half of its range, which is more than a turn: a counter overflows, or was reset.
    Jump {
        /// The row after the jump.
        row: usize,
        /// The jump (rad).
        by: f64,
    },
    /// Most of the samples are missing, or the times scatter so much that their order says nothing.
    Scattered,
    /// The torque is the same in all rows.
    Constant {
        /// The torque (N·m).
        torque: f64,
    },
    /// There are fewer than two different times.
    Empty,
}

/// The rows of a log (s, rad, N·m) at equal steps, and what was repaired.
///
/// # Errors
/// Rows that cannot be repaired.
pub fn samples(
    time: &[f64],
    position: &[f64],
    torque: &[f64],
) -> Result<(Samples, Vec<Repair>), RecordFault> {
    let mut repairs = Vec::new();
    let rows = Rows::new(time, position, torque, &mut repairs)?;
    if rows.time.first() == rows.time.last() {
        return Err(RecordFault::Empty);
    }
    let clock = Clock::new(&rows.time).ok_or(RecordFault::Scattered)?;
    let count = clock.places.last().map_or(0, |last| last.saturating_add(1));
    if count as f64 > (1.0 + MISSING) * rows.time.len() as f64 {
        return Err(RecordFault::Scattered);
    }
    gaps(&rows, &clock, &mut repairs);
    let saturated = saturated(&rows, &mut repairs);
    let unwrapped = unwrapped(&rows, &clock)?;
    let at_equal_steps: Vec<f64> = clock.places.iter().map(|place| *place as f64).collect();
    let mut best = resampled(&rows, &unwrapped, &saturated, &clock, &at_equal_steps);
    let scatter = clock.scatter();
    if scatter > JITTER * clock.step {
        let stated: Vec<f64> = clock
            .off
            .iter()
            .zip(&at_equal_steps)
            .map(|(off, place)| place + off / clock.step)
            .collect();
        let other = resampled(&rows, &unwrapped, &saturated, &clock, &stated);
        let [own, others] =
            [&best, &other].map(|samples| noise(&samples.position, &samples.faulty));
        let equal = others >= SMOOTHER * own;
        if !equal {
            best = other;
        }
        repairs.push(Repair::Jitter { by: scatter, equal });
    }
    Ok((best, repairs))
}

/// The rows that count.
struct Rows {
    /// Their numbers, from 1.
    numbers: Vec<usize>,
    time: Vec<f64>,
    position: Vec<f64>,
    torque: Vec<f64>,
}

impl Rows {
    /// Without those that repeat the row before, time and all.
    fn new(
        time: &[f64],
        position: &[f64],
        torque: &[f64],
        repairs: &mut Vec<Repair>,
    ) -> Result<Self, RecordFault> {
        let row = |k: usize| [time[k], position[k], torque[k]].map(f64::to_bits);
        let twice: Vec<usize> = (1..time.len()).filter(|&k| row(k) == row(k - 1)).collect();
        if let Some(&first) = twice.first() {
            repairs.push(Repair::Duplicates {
                count: twice.len(),
                row: first + 1,
            });
        }
        let kept: Vec<usize> = (0..time.len())
            .filter(|&k| k == 0 || row(k) != row(k - 1))
            .collect();
        if let Some(pair) = kept.windows(2).find(|pair| time[pair[1]] < time[pair[0]]) {
            return Err(RecordFault::Backwards {
                row: pair[1] + 1,
                time: time[pair[1]],
                before: time[pair[0]],
            });
        }
        let of = |values: &[f64]| kept.iter().map(|&k| values[k]).collect::<Vec<f64>>();
        let rows = Self {
            time: of(time),
            position: of(position),
            torque: of(torque),
            numbers: kept.iter().map(|k| k + 1).collect(),
        };
        let [least, most] = range(&rows.torque);
        let constant = most <= least;
        match rows.torque.first() {
            Some(&torque) if constant && rows.torque.len() > EQUAL => {
                Err(RecordFault::Constant { torque })
            }
            _ => Ok(rows),
        }
    }
}

/// The least and the greatest value.
fn range(values: &[f64]) -> [f64; 2] {
    let both = [f64::INFINITY, f64::NEG_INFINITY];
    values.iter().fold(both, |[a, b], &x| [a.min(x), b.max(x)])
}

/// Reports missing samples.
fn gaps(rows: &Rows, clock: &Clock, repairs: &mut Vec<Repair>) {
    let steps = clock.places.windows(2).map(|pair| pair[1] - pair[0]);
    let gaps = steps
        .zip(rows.numbers.iter().skip(1))
        .filter(|(steps, _)| *steps > 1);
    let gaps: Vec<(usize, &usize)> = gaps.collect();
    if let (Some((_, row)), Some(longest)) =
        (gaps.first(), gaps.iter().map(|(steps, _)| steps).max())
    {
        repairs.push(Repair::Gaps {
            count: gaps.len(),
            row: **row,
            longest: *longest as f64 * clock.step,
        });
    }
}

/// Samples at the steps of the clock, between rows that are at these places: those of a long gap are marked, and those of a saturated torque.
fn resampled(
    rows: &Rows,
    position: &[f64],
    saturated: &[bool],
    clock: &Clock,
    at: &[f64],
) -> Samples {
    let count = clock.places.last().map_or(0, |last| last + 1);
    let last = at.len() - 1;
    let mut samples = Samples {
        step: clock.step,
        position: Vec::with_capacity(count),
        torque: Vec::with_capacity(count),
        faulty: Vec::with_capacity(count),
    };
    let mut k = 0;
    for place in 0..count {
        let here = place as f64;
        while k + 1 < last && at[k + 1] <= here {
            k += 1;
        }
        let next = (k + 1).min(last);
        let share = ((here - at[k]) / (at[next] - at[k]).max(1e-9)).clamp(0.0, 1.0);
        let between = |values: &[f64]| values[k] + share * (values[next] - values[k]);
        samples.position.push(between(position));
        samples.torque.push(between(&rows.torque));
        let missing = clock.places[next] - clock.places[k];
        let gap = missing > 1 && missing as f64 * clock.step > SHORT_GAP * (1.0 + 1e-6);
        samples.faulty.push(
            gap && share > 0.0 && share < 1.0
                || saturated[k] && share < 1.0
                || saturated[next] && share > 0.0,
        );
    }
    samples
}

/// The median of five values in a row; near the ends, the values.
fn medians(values: &[f64]) -> Vec<f64> {
    let mut medians = values.to_vec();
    for (median, five) in medians.iter_mut().skip(2).zip(values.windows(5)) {
        let mut five = five.to_vec();
        five.sort_by(f64::total_cmp);
        *median = five[2];
    }
    medians
}

/// A jump by more than `most` from one sample to the next.
fn jump(rows: &Rows, position: &[f64], clock: &Clock, most: f64) -> Option<RecordFault> {
    let steps = position.windows(2).zip(clock.places.windows(2));
    let mut steps = steps.zip(rows.numbers.iter().skip(1));
    let (row, by) = steps.find_map(|((pair, places), row)| {
        let by = pair[1] - pair[0];
        (places[1] - places[0] == 1 && by.abs() > most).then_some((*row, by))
    })?;
    (position.len() > LEAST_ROWS).then_some(RecordFault::Jump { row, by })
}

/// Positions without the jump of an encoder that counts within one turn; others stay.
fn unwrapped(rows: &Rows, clock: &Clock) -> Result<Vec<f64>, RecordFault> {
    let mut values = rows.position.clone();
    // Without single wrong values.
    let usual = medians(&values);
    let [least, most] = range(&usual);
    if most - least > ONE_TURN {
        return jump(rows, &usual, clock, 0.5 * (most - least)).map_or(Ok(values), Err);
    }
    let mut turns = 0.0;
    let mut before = values.first().copied().unwrap_or_default();
    let (mut speed, mut row, mut longest) = (0.0f64, 0, 0.0);
    let steps = clock.places.windows(2).map(|pair| pair[1] - pair[0]);
    for ((value, steps), number) in values
        .iter_mut()
        .skip(1)
        .zip(steps)
        .zip(rows.numbers.iter().skip(1))
    {
        let jump = *value - before;
        // Farther than a turn from a usual value: a wrong value, which stays one within half a turn.
        if *value < most - ONE_TURN || *value > least + ONE_TURN {
            *value += turns - (jump / TAU).round() * TAU;
            continue;
        }
        before = *value;
        let over = (jump / TAU).round() * TAU;
        turns -= over;
        *value += turns;
        let time = steps as f64 * clock.step;
        if steps == 1 {
            speed = speed.max((jump - over).abs() / time);
        } else if time > longest {
            (row, longest) = (*number, time);
        }
    }
    if longest * speed > PI {
        return Err(RecordFault::Turns {
            row,
            gap: longest,
            longest: PI / speed,
        });
    }
    Ok(values)
}

/// Which rows are at a limit of the torque.
fn saturated(rows: &Rows, repairs: &mut Vec<Repair>) -> Vec<bool> {
    let torque = &rows.torque;
    let [least, most] = range(torque);
    let size = most.abs().max(least.abs());
    let mut marked = vec![false; torque.len()];
    for limit in [most, least] {
        let at = |k: usize| (torque[k] - limit).abs() <= 1e-9 * size;
        let mut from = 0;
        while from < torque.len() {
            let mut to = from;
            while to < torque.len() && at(to) {
                to += 1;
            }
            if to - from >= EQUAL && limit != 0.0 {
                marked[from..to].fill(true);
            }
            from = to + 1;
        }
    }
    let count = marked.iter().filter(|marked| **marked).count();
    let first = marked.iter().position(|marked| *marked);
    if let (Some(first), true) = (first, count as f64 > SATURATED * torque.len() as f64) {
        repairs.push(Repair::Saturated {
            count,
            row: rows.numbers[first],
            torque: torque[first],
        });
    }
    marked
}
