//! Distribution of speed over the cycle: sums of a function of speed without iterating over the samples.
//!
//! The samples in order of |n| are halved repeatedly. Each part keeps its weight W = ∑w, its mean speed c = ∑w·|n|/W, and ∑w·(|n| − c)² and ∑w/n².
//! The weighted square of a straight line l is then W·l(c)² + l′²·∑w·(|n| − c)², without cancellation. Parts are joined by the rule of Chan, Golub
//! and LeVeque (1983, "Algorithms for computing the sample variance", American Statistician 37). For a function of a few pieces, each end of a piece
//! costs one part of each size: the logarithm of the number of samples.

use super::LoadSample;

/// Most samples of a part that is not halved.
const LEAF: usize = 16;

/// Form of a function of speed between two speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpeedFunction {
    /// Zero.
    Zero,
    /// 1 − l², with l the straight line with these values at both ends.
    LessLine([f64; 2]),
    /// 1 − (k/|n|)².
    LessInverse(f64),
}

/// A sample with positive weight.
#[derive(Clone, Copy, Debug)]
struct WeightedSpeed {
    /// |n| at the gearbox output (rad/s).
    speed: f64,
    weight: f64,
}

/// Samples adjacent in the order of speed.
#[derive(Clone, Copy, Debug)]
struct SpeedGroup {
    first: u32,
    last: u32,
    /// Index of the second half; the first half is the next part. Zero: not halved.
    second: u32,
    sums: Sums,
}

/// Sums over a group of samples.
#[derive(Clone, Copy, Debug)]
struct Sums {
    weight: f64,
    mean: f64,
    /// ∑w·(|n| − mean)².
    spread: f64,
    /// ∑w/n²; infinite if it includes rest.
    inverse: f64,
}

impl Sums {
    fn of(entry: &WeightedSpeed) -> Self {
        Self {
            weight: entry.weight,
            mean: entry.speed,
            spread: 0.0,
            inverse: entry.weight / (entry.speed * entry.speed),
        }
    }

    fn with(&self, other: &Self) -> Self {
        let weight = self.weight + other.weight;
        let apart = other.mean - self.mean;
        let share = other.weight / weight;
        Self {
            weight,
            mean: self.mean + apart * share,
            spread: self.spread + other.spread + apart * apart * (self.weight * share),
            inverse: self.inverse + other.inverse,
        }
    }
}

/// The samples of a cycle by speed.
#[derive(Clone, Debug)]
pub(crate) struct Speeds {
    entries: Vec<WeightedSpeed>,
    parts: Vec<SpeedGroup>,
}

impl Speeds {
    pub(super) fn new(samples: &[LoadSample]) -> Self {
        let weighty = samples.iter().filter(|s| s.weight > 0.0);
        let entry = |s: &LoadSample| WeightedSpeed {
            speed: s.speed().abs(),
            weight: s.weight,
        };
        let mut entries: Vec<WeightedSpeed> = weighty.map(entry).collect();
        entries.sort_unstable_by(|a, b| a.speed.total_cmp(&b.speed));
        let mut speeds = Self {
            parts: Vec::with_capacity(4 * entries.len() / LEAF + 1),
            entries,
        };
        if !speeds.entries.is_empty() {
            speeds.build(0, speeds.entries.len() - 1);
        }
        speeds.parts.shrink_to_fit();
        speeds
    }

    /// Adds the samples from `first` to `last`, both included; returns their sums.
    fn build(&mut self, first: usize, last: usize) -> Sums {
        let own = self.parts.len();
        let known = Sums::of(&self.entries[first]);
        let part = |second: usize, sums| SpeedGroup {
            first: first as u32,
            last: last as u32,
            second: second as u32,
            sums,
        };
        self.parts.push(part(0, known));
        if last - first < LEAF {
            let rest = &self.entries[first + 1..=last];
            let sums = rest.iter().map(Sums::of).fold(known, |a, b| a.with(&b));
            self.parts[own] = part(0, sums);
            return sums;
        }
        let middle = usize::midpoint(first, last);
        let one = self.build(first, middle);
        let second = self.parts.len();
        let two = self.build(middle + 1, last);
        let sums = one.with(&two);
        self.parts[own] = part(second, sums);
        sums
    }

    /// ∑w·g(|n|) (s). `on` gives g between two speeds (rad/s, at the gearbox output), `None` if it is not one of the [`SpeedFunction`]s; `at` is g at one
    /// speed. If `on` always returns `None`, every sample is visited.
    pub(crate) fn sum(
        &self,
        on: impl Fn([f64; 2]) -> Option<SpeedFunction>,
        at: impl Fn(f64) -> f64,
    ) -> f64 {
        if self.parts.is_empty() {
            0.0
        } else {
            self.sum_of(0, &on, &at)
        }
    }

    fn sum_of(
        &self,
        index: usize,
        on: &impl Fn([f64; 2]) -> Option<SpeedFunction>,
        at: &impl Fn(f64) -> f64,
    ) -> f64 {
        let part = &self.parts[index];
        let entries = &self.entries[part.first as usize..=part.last as usize];
        let (Some(low), Some(high)) = (entries.first(), entries.last()) else {
            return 0.0;
        };
        let ends = [low.speed, high.speed];
        if let Some(form) = on(ends) {
            return part.sums.sum(form, ends);
        }
        if part.second == 0 {
            entries.iter().map(|e| e.weight * at(e.speed)).sum()
        } else {
            self.sum_of(index + 1, on, at) + self.sum_of(part.second as usize, on, at)
        }
    }
}

impl Sums {
    fn sum(&self, form: SpeedFunction, [low, high]: [f64; 2]) -> f64 {
        match form {
            SpeedFunction::Zero => 0.0,
            SpeedFunction::LessLine([start, end]) => {
                let slope = if high > low {
                    (end - start) / (high - low)
                } else {
                    0.0
                };
                let middle = start + slope * (self.mean - low);
                self.weight * (1.0 - middle * middle) - slope * slope * self.spread
            }
            SpeedFunction::LessInverse(scale) => self.weight - scale * scale * self.inverse,
        }
    }
}

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use std::cell::Cell;

    use super::{LEAF, LoadSample, SpeedFunction, Speeds};

    /// Lines and a hyperbola over a million samples: a few dozen of them are visited, and the sum is correct.
    #[test]
    fn few_samples_are_looked_at() {
        let count = 1_000_000;
        let samples: Vec<LoadSample> = (0..count)
            .map(|k| {
                let t = f64::from(k) / f64::from(count);
                let speed = 100.0 * (std::f64::consts::TAU * t).sin();
                LoadSample {
                    t,
                    weight: 1.0 / f64::from(count),
                    alpha: 0.0,
                    output_torque: 0.0,
                    speed,
                }
            })
            .collect();
        let at = |speed: f64| match speed {
            _ if speed <= 20.0 => 0.0,
            _ if speed <= 50.0 => 1.0 - (1.2 - 0.01 * speed).powi(2),
            _ => 1.0 - (35.0 / speed).powi(2),
        };
        let (asked, looked) = (Cell::new(0), Cell::new(0));
        let on = |[from, to]: [f64; 2]| {
            asked.set(asked.get() + 1);
            match [from, to] {
                [_, to] if to <= 20.0 => Some(SpeedFunction::Zero),
                [from, to] if from > 20.0 && to <= 50.0 => Some(SpeedFunction::LessLine(
                    [from, to].map(|speed| 1.2 - 0.01 * speed),
                )),
                [from, _] if from > 50.0 => Some(SpeedFunction::LessInverse(35.0)),
                _ => None,
            }
        };
        let one = |speed: f64| {
            looked.set(looked.get() + 1);
            at(speed)
        };
        let found = Speeds::new(&samples).sum(on, one);
        let expected: f64 = samples.iter().map(|s| s.weight * at(s.speed().abs())).sum();
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        assert!((1..=2 * LEAF).contains(&looked.get()), "{}", looked.get());
        assert!((20..=120).contains(&asked.get()), "{}", asked.get());
    }
}
