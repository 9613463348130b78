//! Between the instants of a duty: a quantity over three neighbouring instants of one smooth stretch is nearly a parabola.
//!
//! The largest of the instants lies below the true peak by the second power of the step, the vertex of the parabola differs from
//! it by the fourth.

use std::ops::Range;

use crate::number::parabola::Parabola;

/// A bend that raises the vertex of the parabola over the largest instant by more than this share is no smooth peak (noise, a corner):
/// the instant stands.
pub const MOST_RAISED: f64 = 0.01;

/// Where the smooth stretches of a duty begin. Without any, nothing is known between the instants.
#[derive(Clone, Debug, Default)]
pub struct Smooth {
    /// Index of the first instant of each stretch.
    firsts: Vec<u32>,
}

impl Smooth {
    /// A stretch begins with the instant `first`, which is not before the last one that began.
    pub fn begin(&mut self, first: usize) {
        self.firsts.push(first as u32);
    }

    /// One instant more lies before the instant `k`, in the same stretch.
    pub(super) fn insert(&mut self, k: usize) {
        for first in &mut self.firsts {
            *first += u32::from(*first as usize >= k);
        }
    }

    /// The stretch of the instant `k` of `count`.
    pub fn stretch(&self, k: usize, count: usize) -> Option<Range<usize>> {
        let next = self.firsts.partition_point(|&first| first as usize <= k);
        let first = *self.firsts.get(next.checked_sub(1)?)?;
        let end = self.firsts.get(next).map_or(count, |&end| end as usize);
        Some(first as usize..end)
    }

    /// The instant `k` and its neighbours in its stretch, in order; at an end of the stretch the two next to it.
    pub(super) fn around(&self, k: usize, count: usize) -> Option<[usize; 3]> {
        let stretch = self.stretch(k, count)?;
        let last = stretch.end.checked_sub(3)?;
        if last < stretch.start {
            return None;
        }
        let first = k.saturating_sub(1).clamp(stretch.start, last);
        Some([first, first + 1, first + 2])
    }

    /// Where a quantity that is largest at the instant `k` of `count` is larger still: the parabolas of its neighbours, and the time
    /// of the vertex. `time` and `value` are those of an instant.
    pub fn peak(
        &self,
        k: usize,
        count: usize,
        time: impl Fn(usize) -> f64,
        value: impl Fn(usize) -> f64,
    ) -> Option<Peak> {
        let around = self.around(k, count)?;
        let times = around.map(time);
        let most = value(k);
        let parabola = Parabola::through(times, around.map(value));
        let at = parabola.vertex()?;
        let value = parabola.at(at);
        let inside = times[0] < at && at < times[2];
        let raised = value > most && value - most <= MOST_RAISED * most.abs();
        (inside && raised).then_some(Peak {
            around,
            times,
            at,
            value,
        })
    }
}

/// A peak between instants.
#[derive(Clone, Copy, Debug)]
pub struct Peak {
    /// The three instants around it.
    pub around: [usize; 3],
    times: [f64; 3],
    /// Its time (s).
    pub at: f64,
    /// The quantity there.
    pub value: f64,
}

impl Peak {
    /// Another quantity at the same time, from its values at the three instants.
    pub fn other(&self, values: [f64; 3]) -> f64 {
        Parabola::through(self.times, values).at(self.at)
    }
}
