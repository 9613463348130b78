//! Which angles a log visits, and at which speeds.

use std::f64::consts::TAU;

use super::fit::{most_rows, rest};
use super::smooth::smooth;
use super::{Obstacle, Samples, within_turn};

/// Number of angle bins in a turn.
const BINS: usize = 72;

/// A bin with less than this share of the mean is not visited.
const VISITED: f64 = 0.1;

/// The least number of samples whose speed is a filtered one.
const SHORTEST: usize = 500;

/// The least number of samples in a bin from which a variation follows.
const IN_BIN: usize = 20;

/// The least variation of ω² at an angle.
const VARIED: f64 = 0.05;

/// The longest range of empty bins.
struct Gap {
    first: usize,
    length: usize,
}

/// The samples in the bins of a turn: place in the bin, from −½ to ½, and ω².
struct Visits(Vec<Vec<[f64; 2]>>);

impl Visits {
    /// Of the samples that count.
    fn new(samples: &Samples, speed: &[f64], counts: impl Fn(usize) -> bool) -> Self {
        let mut bins = vec![Vec::new(); BINS];
        for (at, (phi, omega)) in samples.position.iter().zip(speed).enumerate() {
            if counts(at) {
                let place = within_turn(*phi) / TAU * BINS as f64;
                let bin = (place as usize).min(BINS - 1);
                bins[bin].push([place - bin as f64 - 0.5, omega * omega]);
            }
        }
        Self(bins)
    }

    fn gap(&self) -> Option<Gap> {
        let mean = self.0.iter().map(Vec::len).sum::<usize>() as f64 / BINS as f64;
        let is_empty = |bin: &Vec<_>| bin.is_empty() || (bin.len() as f64) < VISITED * mean;
        let empty: Vec<bool> = self.0.iter().map(is_empty).collect();
        let mut gap: Option<Gap> = None;
        let mut length = 0;
        for k in 0..2 * BINS {
            length = if empty[k % BINS] { length + 1 } else { 0 };
            let longest = gap.as_ref().is_none_or(|gap| length > gap.length);
            if length > 0 && longest && length <= BINS {
                let first = (k + 1 - length) % BINS;
                gap = Some(Gap { first, length });
            }
        }
        gap
    }

    /// Median over the angles of std ω²/mean ω²; `None`: too few samples at each.
    fn variation(&self) -> Option<f64> {
        let bins = self.0.iter().filter(|bin| bin.len() >= IN_BIN);
        let mut each: Vec<f64> = bins.map(|bin| variation(bin)).collect();
        each.sort_by(f64::total_cmp);
        each.get(each.len() / 2).copied()
    }
}

/// std y/mean y without the part that is a line over x: within a bin a cycle that repeats identically has such a line.
fn variation(points: &[[f64; 2]]) -> f64 {
    let mean =
        |of: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x0, y0) = (mean(&|[x, _]| *x), mean(&|[_, y]| *y));
    let [xx, xy, yy] = [
        mean(&|[x, _]| (x - x0).powi(2)),
        mean(&|[x, y]| (x - x0) * (y - y0)),
        mean(&|[_, y]| (y - y0).powi(2)),
    ];
    let line = if xx > 0.0 { xy * xy / xx } else { 0.0 };
    (yy - line).max(0.0).sqrt() / y0.max(1e-9)
}

/// Which samples move and are not left out.
fn used<'s>(samples: &'s Samples, speed: &'s [f64]) -> impl Fn(usize) -> bool + 's {
    let rest = rest(speed);
    move |at| speed[at].abs() > rest && !samples.faulty[at]
}

/// Median over the angles of std ω²/mean ω² of the samples that are used.
pub(super) fn speed_variation(samples: &Samples, speed: &[f64]) -> f64 {
    let visits = Visits::new(samples, speed, used(samples, speed));
    visits.variation().unwrap_or_default()
}

/// Whether the drive link visits every angle in both directions.
pub(super) fn both_ways(samples: &Samples, speed: &[f64]) -> bool {
    let used = used(samples, speed);
    [1.0, -1.0].iter().all(|sign| {
        let here = |at: usize| used(at) && sign * speed[at] > 0.0;
        Visits::new(samples, speed, here).gap().is_none()
    })
}

/// The smoothed speed; refuses a log that cannot determine a machine, whatever the fit: `needed` rows at least.
pub(super) fn check(samples: &Samples, needed: usize) -> Result<Vec<f64>, Obstacle> {
    let count = samples.position.len();
    let short = Obstacle::short(samples, count, BINS * IN_BIN);
    if count < SHORTEST {
        return Err(short);
    }
    // Many samples may have a short duration.
    let rows = most_rows(samples);
    if rows < needed {
        return Err(Obstacle::short(samples, rows, needed));
    }
    let half = ((0.05 / samples.step) as usize).max(8);
    let speed = smooth(&samples.position, samples.step, half).speed;
    let visits = Visits::new(samples, &speed, used(samples, &speed));
    if let Some(Gap { first, length }) = visits.gap() {
        let width = TAU / BINS as f64;
        return Err(Obstacle::NotVisited {
            from: first as f64 * width,
            to: (first + length) as f64 * width,
            left_out: Visits::new(samples, &speed, |_| true).gap().is_none(),
        });
    }
    let variation = visits.variation().ok_or(short)?;
    if variation < VARIED {
        return Err(Obstacle::SameSpeed { variation });
    }
    Ok(speed)
}
