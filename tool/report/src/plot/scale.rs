//! Axis ranges, tick distances and number texts, without drawing.

use jred_file::math;

/// Range of an axis: a whole number of tick steps, except for a tight horizontal axis.
pub(super) struct Span {
    pub(super) lo: f64,
    pub(super) hi: f64,
    pub(super) step: f64,
    pub(super) intervals: usize,
}

impl Span {
    /// Widens the ends slightly, so that rounding errors do not drop the outermost ticks.
    pub(super) fn new(lo: f64, step: f64, intervals: usize) -> Self {
        let (lo, hi) = (lo - 1e-9 * step, lo + (to_f64(intervals) + 1e-9) * step);
        Self {
            lo,
            hi,
            step,
            intervals,
        }
    }

    /// The narrowest axis of 4 to 8 intervals around a range.
    pub(super) fn of(range: (f64, f64)) -> Self {
        let spans = (4..=8).map(|n| Self::with_intervals(range, n));
        let narrowest = spans.min_by(|a, b| (a.hi - a.lo).total_cmp(&(b.hi - b.lo)));
        narrowest.unwrap_or_else(|| Self::with_intervals(range, 5))
    }

    /// An axis from end to end of a range, up to the next tick where that is near.
    pub(super) fn tight(lo: f64, hi: f64, step: f64) -> Self {
        let near = 0.02 * (hi - lo);
        let (first, last) = ((lo / step).floor() * step, (hi / step).ceil() * step);
        let slack = 1e-9 * step;
        Self {
            lo: if lo - first <= near { first } else { lo } - slack,
            hi: if last - hi <= near { last } else { hi } + slack,
            step,
            intervals: ((hi - lo) / step) as usize,
        }
    }

    /// Position of a value between the ends, 0 to 1.
    pub(super) fn share(&self, value: f64) -> f64 {
        (value - self.lo) / (self.hi - self.lo)
    }

    /// The ticks with their numbers.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let size = self.lo.abs().max(self.hi.abs());
        let first = (self.lo / self.step).ceil();
        let count = ((self.hi - first * self.step) / self.step).floor() as usize;
        (0..=count)
            .map(|k| {
                let value = (first + to_f64(k)) * self.step;
                (value, number(value, size, self.step))
            })
            .collect()
    }

    /// Adds a margin that does not cross zero; includes zero if it is near.
    pub(super) fn with_intervals((lo, hi): (f64, f64), intervals: usize) -> Self {
        let air = 0.02 * (hi - lo);
        let low = if lo >= 0.0 && lo < 0.3 * hi {
            0.0
        } else {
            lo - air
        };
        let high = if hi <= 0.0 && hi > 0.3 * lo {
            0.0
        } else {
            hi + air
        };
        let mut reach = high - low;
        loop {
            let step = nice_step(reach / to_f64(intervals));
            let first = (low / step).floor() * step;
            if first + to_f64(intervals) * step >= high {
                return Self::new(first, step, intervals);
            }
            reach *= 1.2;
        }
    }
}

/// The multiple of a power of ten from 1, 2, 2.5 and 5 that is nearest to a positive distance.
pub(super) fn nice_step(distance: f64) -> f64 {
    let magnitude = 10f64.powi(math::log10(distance).floor() as i32);
    let limits = [(1.5, 1.0), (2.25, 2.0), (3.5, 2.5), (7.5, 5.0)];
    let fitting = limits.iter().find(|l| distance / magnitude < l.0);
    fitting.map_or(10.0, |l| l.1) * magnitude
}

/// Formats one of several values of about the given size, with the decimals that the step needs.
pub(super) fn number(value: f64, size: f64, step: f64) -> String {
    let value = if value.abs() < 1e-6 * step {
        0.0
    } else {
        value
    };
    let plain = (1e-3..1e6).contains(&size);
    if value == 0.0 && !plain {
        return "0".into();
    }
    let power = if plain {
        0
    } else {
        math::log10(size).floor() as i32
    };
    let (mut rest, mut decimals) = (step / 10f64.powi(power), 0);
    while (rest - rest.round()).abs() > 1e-4 * rest && decimals < 14 {
        (rest, decimals) = (rest * 10.0, decimals + 1);
    }
    let digits = format!("{:.decimals$}", value / 10f64.powi(power));
    let tail = if plain {
        String::new()
    } else {
        format!("e{power}")
    };
    (digits + &tail).replace('-', "−")
}

#[expect(clippy::cast_precision_loss, reason = "numbers of bars and ticks")]
pub(super) fn to_f64(n: usize) -> f64 {
    n as f64
}

/// Values beyond 1e100 would overflow when scaled.
pub(super) fn usable(value: f64) -> bool {
    value.abs() < 1e100
}

/// Range of the usable values, widened if it is empty or only rounding noise.
pub(super) fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let values: Vec<f64> = values.filter(|&v| usable(v)).collect();
    let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = lo.abs().max(hi.abs());
    let air = if size < 1e-14 { 1.0 } else { 0.1 * size };
    match hi - lo {
        _ if values.is_empty() => (0.0, 1.0),
        width if width > (1e-9 * size).max(1e-14) => (lo, hi),
        _ => (lo - air, hi + air),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_their_range_between_whole_steps() {
        for (lo, hi) in [
            (0.0, 2.81),
            (-0.84, 2.9),
            (1e6, 1e6 + 1.0),
            (-3e-7, -1e-7),
            (99.0, 101.0),
        ] {
            let span = Span::of((lo, hi));
            assert!(span.lo <= lo && hi <= span.hi, "{lo}..{hi}");
            assert!(
                span.hi - span.lo < 2.5 * (hi - lo),
                "{lo}..{hi} is lost on the axis"
            );
            let steps = span.lo / span.step;
            assert!((steps - steps.round()).abs() < 1e-6, "{lo}..{hi}");
        }
    }

    #[test]
    fn numbers_have_the_decimals_of_their_step() {
        assert_eq!(number(0.25, 1.0, 0.05), "0.25");
        assert_eq!(number(-1500.0, 3000.0, 500.0), "−1500");
        assert_eq!(number(2.5e-5, 1e-4, 2.5e-5), "0.25e−4");
        assert_eq!(number(-1e-19, 1.0, 0.5), "0.0");
        assert_eq!(number(0.0, 1e-5, 1e-6), "0");
        assert_eq!(number(0.0, 0.0, 0.0), "0");
        assert_eq!(number(1e6 + 0.002, 1e6 + 0.01, 0.002), "1.000000002e6");
    }
}
