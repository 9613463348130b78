//! A smooth stretch of the motion, and the initial borders of its panels.

use crate::duty::stretches::start_inset;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;

/// Relative rounding of a number of panels.
const WHOLE_TOLERANCE: f64 = 1e-12;

/// A smooth stretch of the motion.
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Times that are moved inside.
    pub(super) inside: [f64; 2],
    /// Whether the signs of torques matter.
    pub(super) moves: bool,
    pub(super) rows: Vec<f64>,
    /// Initial borders of its panels.
    pub(super) borders: Vec<f64>,
}

impl Stretch {
    /// A stretch that begins with about `count` panels.
    pub(super) fn new(
        file: &MachineFile,
        motion: &Motion,
        (from, to): (f64, f64),
        count: f64,
    ) -> Self {
        let [first, last] = [[from, to], [to, from]].map(|ends| start_inset(motion, ends));
        let mut rows = motion.rows_within([from, to]);
        for carriage in file.schedule.carriages() {
            rows.extend(carriage.motion.rows_within([from, to]));
        }
        rows.sort_by(f64::total_cmp);
        Self {
            from,
            to,
            inside: [from + first, (to - last).min(to.next_down().max(from))],
            moves: motion.at(from.midpoint(to)).omega != 0.0,
            borders: borders([from, to], &rows, count),
            rows,
        }
    }

    pub(super) fn clamp(&self, t: f64) -> f64 {
        let [first, last] = self.inside;
        t.max(first).min(last)
    }

    /// The rows strictly between two times.
    pub(super) fn between(&self, [from, to]: [f64; 2]) -> &[f64] {
        let first = self.rows.partition_point(|row| *row <= from);
        let end = self.rows.partition_point(|row| *row < to);
        self.rows.get(first..end).unwrap_or_default()
    }
}

/// Borders of about `count` panels, at rows of recorded motions where these are crowded.
fn borders([from, to]: [f64; 2], rows: &[f64], count: f64) -> Vec<f64> {
    let mut borders = vec![from];
    let mut k = 1.0;
    while k < count {
        let even = from + (to - from) * (k / count);
        let next = rows.partition_point(|row| *row < even);
        let row = rows.get(next).copied();
        let border = if rows.is_empty() { Some(even) } else { row };
        // Between two rows the panels are equal.
        let last = borders[borders.len() - 1];
        let border = border.filter(|t| *t > last && *t < to);
        let even = (even > last && even < to).then_some(even);
        let crowded = rows.len() as f64 >= count;
        borders.extend(if crowded { border } else { even });
        k += 1.0;
    }
    borders.push(to);
    borders
}

/// Rounds a number that is whole except for rounding.
pub(super) fn near_whole(count: f64) -> f64 {
    if (count - count.round()).abs() < WHOLE_TOLERANCE * count {
        count.round()
    } else {
        count
    }
}
