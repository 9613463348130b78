//! Periodic power over time: straight lines between points, with jumps.

/// Power drawn from the bus (W, negative: fed back) over one period.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerCurve {
    /// (time (s), power (W)), times not falling, from 0 to the period; two points at one time are a jump.
    points: Vec<[f64; 2]>,
    period: f64,
    stop: StopPower,
}

/// Power fed back in a stop by the drives: largest at its begin, and falling to zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StopPower {
    /// The largest power (W).
    pub peak: f64,
    /// The energy (J).
    pub energy: f64,
}

impl StopPower {
    /// The power over time, as long again at zero; `None` without a stop.
    pub(super) fn curve(self) -> Option<PowerCurve> {
        let Self { peak, energy } = self;
        let time = 2.0 * energy / peak;
        (peak > 0.0).then(|| PowerCurve::new([[0.0, -peak], [time, 0.0]], 2.0 * time))
    }
}

impl PowerCurve {
    /// A curve through points in order of time, constant before the first point and after the last one.
    pub fn new(inner: impl IntoIterator<Item = [f64; 2]>, period: f64) -> Self {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for [t, power] in inner {
            let t = t.clamp(0.0, period);
            if points.is_empty() && t > 0.0 {
                points.push([0.0, power]);
            }
            points.push([t, power]);
        }
        match points.last().copied() {
            Some([t, power]) if t < period => points.push([period, power]),
            Some(_) => {}
            None => points.extend([[0.0, 0.0], [period, 0.0]]),
        }
        Self {
            points,
            period,
            stop: StopPower::default(),
        }
    }

    /// With a stop that may begin at any time.
    #[must_use]
    pub fn with_stop(self, stop: StopPower) -> Self {
        Self { stop, ..self }
    }

    /// The stop by the drives.
    pub const fn stop(&self) -> StopPower {
        self.stop
    }

    /// The period (s).
    pub const fn period(&self) -> f64 {
        self.period
    }

    /// The points.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The straight pieces: length (s), power at both ends (W).
    pub fn pieces(&self) -> impl Iterator<Item = PowerPiece> {
        let pairs = self.points.windows(2);
        pairs.filter_map(|pair| match pair {
            [[t, a], [next, b]] if next > t => Some((next - t, [*a, *b])),
            _ => None,
        })
    }

    /// Energy drawn less energy fed back over a period (J).
    pub fn energy(&self) -> f64 {
        self.pieces().map(|(h, [a, b])| 0.5 * h * (a + b)).sum()
    }

    /// Energy drawn and energy fed back over a period (J).
    pub fn energies(&self) -> [f64; 2] {
        let [mut drawn, mut back] = [0.0; 2];
        for piece in self.pieces() {
            split(piece, 0.0, |(h, [a, b])| {
                let area = 0.5 * h * (a + b);
                drawn += area.max(0.0);
                back += (-area).max(0.0);
            });
        }
        [drawn, back]
    }

    /// Smallest and largest power (W).
    pub fn extremes(&self) -> [f64; 2] {
        let powers = self.points.iter().map(|[_, p]| *p);
        powers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            [low.min(p), high.max(p)]
        })
    }

    /// First time at which the power is smallest (s).
    pub(super) fn least_at(&self) -> f64 {
        let least = self.points.iter().min_by(|a, b| a[1].total_cmp(&b[1]));
        least.map_or(0.0, |[t, _]| *t)
    }

    /// The curve moved later by `shift` (s).
    #[must_use]
    pub fn shifted(&self, shift: f64) -> Self {
        let mut moved = Self::empty();
        self.shift_into(shift, &mut moved);
        moved
    }

    /// Writes the shifted curve into an existing one, because a search over phases shifts a curve many times.
    pub(super) fn shift_into(&self, shift: f64, moved: &mut Self) {
        let cut = (self.period - shift).rem_euclid(self.period);
        // The part from `cut` on comes first.
        let split = self.points.partition_point(|[t, _]| *t < cut);
        let (head, tail) = self.points.split_at(split);
        let at_cut = match (head.last(), tail.first()) {
            (Some([t, a]), Some([next, b])) if next > t => a + (b - a) * (cut - t) / (next - t),
            (_, Some([_, b])) => *b,
            (Some([_, a]), None) => *a,
            (None, None) => 0.0,
        };
        let rest = self.period - cut;
        (moved.period, moved.stop) = (self.period, self.stop);
        let points = &mut moved.points;
        points.clear();
        points.push([0.0, at_cut]);
        points.extend(tail.iter().map(|[t, p]| [t - cut, *p]));
        points.extend(head.iter().map(|[t, p]| [t + rest, *p]));
        points.push([self.period, at_cut]);
    }

    /// An empty curve to write into.
    pub(super) const fn empty() -> Self {
        Self {
            points: Vec::new(),
            period: 0.0,
            stop: StopPower {
                peak: 0.0,
                energy: 0.0,
            },
        }
    }

    /// The curve `count` times one after another.
    #[must_use]
    pub fn repeated(&self, count: u32) -> Self {
        let times = (0..count).flat_map(|k| {
            let start = f64::from(k) * self.period;
            self.points.iter().map(move |[t, p]| [t + start, *p])
        });
        Self {
            points: times.collect(),
            period: self.period * f64::from(count),
            stop: self.stop,
        }
    }

    /// A curve with fewer points whose error is nowhere above `tolerance` (W); jumps stay.
    #[must_use]
    pub fn simplified(&self, tolerance: f64) -> Self {
        // The last kept point, and slopes of lines from it that pass all points after it within the tolerance.
        let mut kept = 0;
        let mut slopes = [f64::NEG_INFINITY, f64::INFINITY];
        let mut points = self.points.get(..1).unwrap_or_default().to_vec();
        for (last, pair) in self.points.windows(2).enumerate() {
            let [[before, _], [t, power]] = [pair[0], pair[1]];
            let slope_to = |power: f64, kept: usize| {
                let [from, start] = self.points[kept];
                (power - start) / (t - from)
            };
            let jumps = t <= before;
            if jumps || !(slopes[0]..=slopes[1]).contains(&slope_to(power, kept)) {
                points.extend((last > kept).then_some(pair[0]));
                kept = last;
                slopes = [f64::NEG_INFINITY, f64::INFINITY];
            }
            if jumps {
                points.push(pair[1]);
                kept = last + 1;
            } else {
                slopes[0] = slopes[0].max(slope_to(power - tolerance, kept));
                slopes[1] = slopes[1].min(slope_to(power + tolerance, kept));
            }
        }
        points.extend(self.points.get(kept + 1..).and_then(<[_]>::last));
        Self {
            points,
            period: self.period,
            stop: self.stop,
        }
    }

    /// The sum with a curve of the same period. Both stop together.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = Self::empty();
        self.sum_into(other, &mut sum);
        sum
    }

    /// Writes the sum into an existing curve.
    pub(super) fn sum_into(&self, other: &Self, sum: &mut Self) {
        let (a, b) = (&self.points, &other.points);
        sum.period = self.period;
        sum.stop = StopPower {
            peak: self.stop.peak + other.stop.peak,
            energy: self.stop.energy + other.stop.energy,
        };
        let points = &mut sum.points;
        points.clear();
        let (mut i, mut k) = (0, 0);
        // The value of a curve at `t` between its points n − 1 and n.
        let value = |points: &[[f64; 2]], n: usize, t: f64| match (
            n.checked_sub(1).and_then(|m| points.get(m)),
            points.get(n),
        ) {
            (Some([from, p]), Some([to, q])) if to > from => p + (q - p) * (t - from) / (to - from),
            (Some([_, p]), _) | (None, Some([_, p])) => *p,
            (None, None) => 0.0,
        };
        while let (Some([ta, pa]), Some([tb, pb])) = (a.get(i), b.get(k)) {
            if ta < tb {
                points.push([*ta, pa + value(b, k, *ta)]);
                i += 1;
            } else if tb < ta {
                points.push([*tb, pb + value(a, i, *tb)]);
                k += 1;
            } else {
                points.push([*ta, pa + pb]);
                // At a jump only one side advances at a time.
                let jumps = |points: &[[f64; 2]], n: usize, t: f64| {
                    points.get(n + 1).is_some_and(|[next, _]| *next <= t)
                };
                match (jumps(a, i, *ta), jumps(b, k, *tb)) {
                    (true, false) => i += 1,
                    (false, true) => k += 1,
                    _ => {
                        i += 1;
                        k += 1;
                    }
                }
            }
        }
        // Past the end of one curve, the other's last points lie at the period.
        let last_of = |points: &[[f64; 2]]| points.last().map_or(0.0, |[_, p]| *p);
        for [t, p] in a.iter().skip(i) {
            points.push([*t, p + last_of(b)]);
        }
        for [t, p] in b.iter().skip(k) {
            points.push([*t, p + last_of(a)]);
        }
    }
}

/// A straight piece of power: length (s), power at both ends (W).
pub type PowerPiece = (f64, [f64; 2]);

/// The parts of a straight piece, cut where its power crosses `level`.
pub(super) fn split((h, [a, b]): PowerPiece, level: f64, mut part: impl FnMut(PowerPiece)) {
    let place = (level - a) / (b - a);
    if (a - level) * (b - level) < 0.0 && place > 0.0 && place < 1.0 {
        part((h * place, [a, level]));
        part((h * (1.0 - place), [level, b]));
    } else {
        part((h, [a, b]));
    }
}
