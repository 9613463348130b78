//! From the rows of a log to samples at equal steps.

use std::f64::consts::{PI, TAU};

use super::Samples;

/// Longer than this many steps is a gap.
const GAP: f64 = 1.5;

/// Times off the equal steps by more than this share of a step are reported.
const JITTER: f64 = 0.2;

/// Share of a step by which the same instant may differ: rounded times.
const SAME: f64 = 2e-3;

/// Equal largest torques in a row that are a limit of the drive.
const EQUAL: usize = 3;

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
    /// Times that scatter: position and torque are interpolated.
    Jitter {
        /// Largest distance from equal steps, as a share of a step.
        share: f64,
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
    /// Most of the samples are missing.
    Scattered,
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
    let kept = rising(time, &mut repairs)?;
    let mut steps: Vec<f64> = kept.windows(2).map(|k| time[k[1]] - time[k[0]]).collect();
    steps.sort_by(f64::total_cmp);
    let Some(&median) = steps.get(steps.len() / 2) else {
        return Err(RecordFault::Empty);
    };
    // Places on the grid, and where rows are missing.
    let mut places = Vec::with_capacity(kept.len());
    let mut place = 0usize;
    let (mut gaps, mut longest, mut after) = (0, 0.0f64, 0);
    for (k, &row) in kept.iter().enumerate() {
        if let Some(&before) = k.checked_sub(1).and_then(|k| kept.get(k)) {
            let step = time[row] - time[before];
            let whole = (step / median).round().max(1.0);
            if step > GAP * median {
                if gaps == 0 {
                    after = row + 1;
                }
                gaps += 1;
                longest = longest.max(step);
            }
            place = place.saturating_add(if step > GAP * median {
                whole as usize
            } else {
                1
            });
        }
        places.push(place);
    }
    if place as f64 > (1.0 + MISSING) * kept.len() as f64 {
        return Err(RecordFault::Scattered);
    }
    if gaps > 0 {
        repairs.push(Repair::Gaps {
            count: gaps,
            row: after,
            longest,
        });
    }
    let (Some(&first), Some(&last)) = (kept.first(), kept.last()) else {
        return Err(RecordFault::Empty);
    };
    let step = (time[last] - time[first]) / place.max(1) as f64;
    let count = place + 1;
    let saturated = saturated(torque, &kept, &mut repairs);
    let off = kept
        .iter()
        .zip(&places)
        .map(|(&row, &place)| ((time[row] - time[first]) / step - place as f64).abs());
    let off = off.fold(0.0, f64::max);
    if off > JITTER {
        repairs.push(Repair::Jitter { share: off });
    }
    let unwrapped = unwrapped(&kept, position, time, GAP * median)?;
    let mut samples = Samples {
        step,
        position: vec![0.0; count],
        torque: vec![0.0; count],
        faulty: vec![false; count],
    };
    // Between two rows the samples are interpolated; those of a gap are marked.
    let mut k = 0;
    for at in 0..count {
        let here = time[first] + at as f64 * step;
        while k + 2 < kept.len() && time[kept[k + 1]] <= here + SAME * step {
            k += 1;
        }
        let (a, b) = (kept[k], kept[(k + 1).min(kept.len() - 1)]);
        let span = time[b] - time[a];
        let share = match (here - time[a]) / span.max(1e-300) {
            share if share * span < SAME * step => 0.0,
            share if (1.0 - share) * span < SAME * step => 1.0,
            share => share,
        };
        let next = (k + 1).min(kept.len() - 1);
        let between = |values: [f64; 2]| values[0] + share * (values[1] - values[0]);
        samples.position[at] = between([unwrapped[k], unwrapped[next]]);
        samples.torque[at] = between([torque[a], torque[b]]);
        samples.faulty[at] = span > GAP * median && share > 0.0 && share < 1.0
            || saturated[k] && share < 1.0
            || saturated[next] && share > 0.0;
    }
    Ok((samples, repairs))
}

/// The rows whose times increase.
fn rising(time: &[f64], repairs: &mut Vec<Repair>) -> Result<Vec<usize>, RecordFault> {
    let mut kept: Vec<usize> = Vec::with_capacity(time.len());
    let (mut duplicates, mut first_duplicate) = (0, 0);
    for (k, &t) in time.iter().enumerate() {
        match kept.last().map(|&last| time[last]) {
            Some(before) if t < before => {
                return Err(RecordFault::Backwards {
                    row: k + 1,
                    time: t,
                    before,
                });
            }
            Some(before) if t - before <= 1e-12 * before.abs() => {
                if duplicates == 0 {
                    first_duplicate = k + 1;
                }
                duplicates += 1;
            }
            _ => kept.push(k),
        }
    }
    if duplicates > 0 {
        repairs.push(Repair::Duplicates {
            count: duplicates,
            row: first_duplicate,
        });
    }
    Ok(kept)
}

/// Positions without the jump of an encoder that counts within one turn; others stay.
fn unwrapped(
    kept: &[usize],
    position: &[f64],
    time: &[f64],
    gap: f64,
) -> Result<Vec<f64>, RecordFault> {
    let mut values: Vec<f64> = kept.iter().map(|&row| position[row]).collect();
    let [least, most] = values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| {
            [a.min(x), b.max(x)]
        });
    // Rounded positions may exceed a turn.
    if most - least > 1.001 * TAU {
        return Ok(values);
    }
    let mut turns = 0.0;
    let mut before = values.first().copied().unwrap_or_default();
    let (mut speed, mut row, mut longest) = (0.0f64, 0, 0.0);
    for (value, rows) in values.iter_mut().skip(1).zip(kept.windows(2)) {
        let jump = *value - before;
        before = *value;
        let over = (jump / TAU).round() * TAU;
        turns -= over;
        *value += turns;
        let &[from, to] = rows else { continue };
        let step = time[to] - time[from];
        if step <= gap {
            speed = speed.max((jump - over).abs() / step);
        } else if step > longest {
            (row, longest) = (to + 1, step);
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

/// Which of the kept rows are at a limit of the torque.
fn saturated(torque: &[f64], kept: &[usize], repairs: &mut Vec<Repair>) -> Vec<bool> {
    let values = || kept.iter().map(|&row| torque[row]);
    let most = values().fold(f64::NEG_INFINITY, f64::max);
    let least = values().fold(f64::INFINITY, f64::min);
    let size = most.abs().max(least.abs());
    let mut marked = vec![false; kept.len()];
    for limit in [most, least] {
        let at = |k: usize| (torque[kept[k]] - limit).abs() <= 1e-9 * size;
        let mut from = 0;
        while from < kept.len() {
            let mut to = from;
            while to < kept.len() && at(to) {
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
    if let (Some(first), true) = (first, count as f64 > SATURATED * kept.len() as f64) {
        repairs.push(Repair::Saturated {
            count,
            row: kept[first] + 1,
            torque: torque[kept[first]],
        });
    }
    marked
}
