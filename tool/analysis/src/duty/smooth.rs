//! Between the instants of a duty: over a panel a quantity is the polynomial through its weighted instants.

use std::convert::Infallible;
use std::ops::Range;

use jred_file::number::numerics::golden_section;
use jred_file::number::quadrature::kronrod::{MOST_PLACES, Rule};

/// Largest rise of a quantity between two instants above them, as a share of it. A polynomial that rises more does not follow a smooth curve (noise,
/// a corner); then the value at the instant is used.
pub const MOST_RAISED: f64 = 0.01;

/// Steps of the search for a peak.
const STEPS: u32 = 40;

/// Starts of the smooth stretches of a duty, and of the panels of the integrals. Without them nothing is known between the instants.
#[derive(Clone, Debug, Default)]
pub struct Smooth {
    /// Index of the first instant of each stretch.
    firsts: Vec<u32>,
    /// Index of the first instant of each panel.
    panels: Vec<u32>,
    /// Whether instants were omitted: then peaks between the remaining ones are unknown.
    is_outline: bool,
}

impl Smooth {
    /// Begins a stretch with the instant `first`, which is not before the start of the last one.
    pub fn begin(&mut self, first: usize) {
        self.firsts.push(first as u32);
    }

    /// Begins a panel with the instant `first`; the first panel of a stretch begins with the stretch.
    pub(super) fn panel(&mut self, first: usize) {
        let stretch = self.firsts.last().copied().unwrap_or(0);
        let begun = self.panels.last().is_some_and(|last| *last >= stretch);
        let first = if begun { first as u32 } else { stretch };
        self.panels.push(first);
    }

    /// Records an instant inserted before the instant `k`, in the same stretch.
    pub(super) fn insert(&mut self, k: usize) {
        for firsts in [&mut self.firsts, &mut self.panels] {
            for first in firsts {
                *first += u32::from(*first as usize >= k);
            }
        }
    }

    /// The same for some of the instants, in order, which include all with a weight.
    #[must_use]
    pub fn among(&self, kept: &[usize]) -> Self {
        let place = |first: &u32| kept.partition_point(|k| *k < *first as usize) as u32;
        Self {
            firsts: self.firsts.iter().map(place).collect(),
            panels: self.panels.iter().map(place).collect(),
            is_outline: true,
        }
    }

    /// Whether a peak may lie between the instants.
    pub const fn knows_peaks(&self) -> bool {
        !self.is_outline
    }

    /// The stretch of the instant `k` of `count`.
    pub fn stretch(&self, k: usize, count: usize) -> Option<Range<usize>> {
        group(&self.firsts, k, count)
    }

    /// The instants of the panel that contains the instant `k` of `count`; those with weights are the places of a rule.
    pub fn panel_of(&self, k: usize, count: usize) -> Option<Range<usize>> {
        let panel = group(&self.panels, k, count)?;
        let stretch = self.stretch(k, count)?;
        let panel = panel.start.max(stretch.start)..panel.end.min(stretch.end);
        (!panel.is_empty()).then_some(panel)
    }

    /// The instants of the panels whose curve contains the instant `k` of `count`: its own panel, and the next one if it begins there.
    pub fn panels_beside(&self, k: usize, count: usize) -> impl Iterator<Item = Range<usize>> {
        let next = self.panel_of(k + 1, count);
        let next = next.filter(|range| range.start == k + 1);
        self.panel_of(k, count).into_iter().chain(next)
    }

    /// The instants of every panel of `count` instants, in order.
    pub fn panels(&self, count: usize) -> impl Iterator<Item = Range<usize>> {
        let firsts = self.panels.iter();
        firsts.filter_map(move |&first| self.panel_of(first as usize, count))
    }

    /// The instant `k` and its neighbours in its stretch, in order; at an end of the stretch, the end and its two neighbours.
    pub(super) fn around(&self, k: usize, count: usize) -> Option<[usize; 3]> {
        let stretch = self.stretch(k, count)?;
        let last = stretch.end.checked_sub(3)?;
        if last < stretch.start {
            return None;
        }
        let first = k.saturating_sub(1).clamp(stretch.start, last);
        Some([first, first + 1, first + 2])
    }
}

/// The group of the index `k` of `count`, given the first index of each group.
fn group(firsts: &[u32], k: usize, count: usize) -> Option<Range<usize>> {
    let next = firsts.partition_point(|&first| first as usize <= k);
    let first = *firsts.get(next.checked_sub(1)?)?;
    let end = firsts.get(next).map_or(count, |&end| end as usize);
    Some(first as usize..end)
}

/// A panel of the integrals, for the values of a quantity at its weighted instants.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    rule: &'static Rule,
    indices: [usize; MOST_PLACES],
    /// Times of its middle and half its length (s).
    middle: f64,
    half: f64,
    /// Its instants.
    first: usize,
    end: usize,
}

impl Panel {
    /// The panel of a range of instants, whose times and weights `at` returns; `None` if they are not a panel.
    pub fn of(range: Range<usize>, at: impl Fn(usize) -> [f64; 2]) -> Option<Self> {
        let mut indices = [0; MOST_PLACES];
        let mut count = 0;
        for k in range.clone() {
            if at(k)[1] > 0.0 {
                *indices.get_mut(count)? = k;
                count += 1;
            }
        }
        let rule = Rule::of_count(count)?;
        let centre = count / 2;
        let [middle, weight] = at(indices[centre]);
        Some(Self {
            rule,
            indices,
            middle,
            half: weight / rule.weights()[centre],
            first: range.start,
            end: range.end,
        })
    }

    /// Its quadrature rule.
    pub const fn rule(&self) -> &'static Rule {
        self.rule
    }

    /// Half its length (s).
    pub const fn half(&self) -> f64 {
        self.half
    }

    /// Its ends (s).
    pub fn span(&self) -> [f64; 2] {
        [self.middle - self.half, self.middle + self.half]
    }

    /// The weighted instants, in order.
    pub fn indices(&self) -> &[usize] {
        &self.indices[..self.rule.places().len()]
    }

    /// A quantity at the weighted instants.
    pub fn values(&self, value: impl Fn(usize) -> f64) -> PanelPolynomial {
        let mut values = [0.0; MOST_PLACES];
        for (place, k) in values.iter_mut().zip(self.indices()) {
            *place = value(*k);
        }
        PanelPolynomial {
            rule: self.rule,
            values,
        }
    }

    /// Place from −1 to 1 of a time (s).
    pub fn place(&self, t: f64) -> f64 {
        ((t - self.middle) / self.half).clamp(-1.0, 1.0)
    }

    /// The places from −1 to 1 of the instants before and after the instant `k`, or the ends; `time` returns the time of an instant.
    pub(crate) fn around(&self, k: usize, time: impl Fn(usize) -> f64) -> [f64; 2] {
        let before = k.checked_sub(1).filter(|j| *j >= self.first);
        let after = Some(k + 1).filter(|j| *j < self.end);
        let place = |j: Option<usize>, end: f64| j.map_or(end, |j| self.place(time(j)));
        [place(before, -1.0), place(after, 1.0)]
    }

    /// The peak of a quantity near the instant `k` of this panel, where it is largest of all instants: the place from −1 to 1 and its value. `known`
    /// is the quantity at an instant, `value` between the instants.
    pub fn peak(
        &self,
        k: usize,
        time: impl Fn(usize) -> f64,
        known: impl Fn(usize) -> f64,
        value: impl Fn(f64) -> f64,
    ) -> Option<(f64, f64)> {
        let most = known(k);
        let [low, high] = self.around(k, time);
        if high <= low {
            return None;
        }
        let Ok([left, right]) = golden_section(
            |x| Ok::<_, Infallible>(value(x)),
            [low, high],
            STEPS,
            |left, right| left > right,
            |left, right| (right - left).abs() <= 1e-15 * right.abs(),
        );
        let best = if left.1 > right.1 { left } else { right };
        let raised = best.1 > most && best.1 - most <= MOST_RAISED * most.abs();
        raised.then_some(best)
    }
}

/// A quantity over a panel: the polynomial through its values at the weighted instants.
#[derive(Clone, Copy, Debug)]
pub struct PanelPolynomial {
    rule: &'static Rule,
    values: [f64; MOST_PLACES],
}

impl PanelPolynomial {
    /// The values at the weighted instants.
    pub fn known(&self) -> &[f64] {
        &self.values[..self.rule.places().len()]
    }

    /// The value at a place from −1 to 1.
    pub fn at(&self, x: f64) -> f64 {
        self.rule.at(self.known(), x)
    }
}
