//! A curve with few points below a limit, for the meter in the firmware.

use jred::duty::MAX_POINTS;

/// Number of equally spaced speeds from rest to the largest at which points may lie. Corners of the limit are added, and midpoints while the bound
/// between two speeds is too loose …
const EVEN: u32 = 32;

/// … that is, by more than this share of the largest torque …
const COARSE_SHORTFALL: f64 = 2e-4;

/// … up to this number of speeds.
const MOST_SPEEDS: usize = 192;

/// Parts of an interval between two such speeds that are bounded separately.
const PARTS: u32 = 16;

/// Number of steps below the limit that are tried as torques at each speed.
const STEPS: usize = 4;

/// Shortfall, as a share of the largest torque, that needs no further point.
const SUFFICIENT_SHORTFALL: f64 = 1e-3;

/// The least requested shortfall (rounding).
const ROUNDING: f64 = 1e-7;

/// Final reduction as a share: more than the rounding of a line in `f32`, 4 units in the last place.
const MARGIN: f64 = 1e-6;

/// A curve of straight lines that never rises and never exceeds a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LowerCurve {
    /// Speed (rad/s) and torque (N·m) of its points, for [`jred::duty::Curve::new`].
    pub points: Vec<[f32; 2]>,
    /// Largest distance below the limit, as a share of the limit's largest torque.
    pub shortfall: f64,
}

/// Bounds of the limit between two speeds.
struct Interval {
    /// End values of a line that is nowhere above the limit.
    ends: [f64; 2],
    /// Largest distance of the line below the limit (N·m).
    loose: f64,
}

/// Fewest points up to a speed and step (as indices), and the speed and step before.
type Predecessor = (usize, Option<(usize, usize)>);

/// The limit at the speeds where points may lie.
struct Tunnel {
    speeds: Vec<f32>,
    between: Vec<Interval>,
    /// Upper bound of a point.
    most: Vec<f64>,
}

/// The curve of at most [`MAX_POINTS`] points below a limit that ends at the speed `end` (rad/s) and bends or jumps only at `corners`. `floor` gives
/// a chord that is not above the limit between two speeds, and the limit itself for equal ones. Where the limit rises with the speed the curve stays
/// level. `None` without data for the limit at any speed.
///
/// It has at most as many points as a shortfall of 0.1 % needs. With that number it has the least shortfall for points at the evaluated speeds (at
/// most 192 and the corners), at the limit or in four steps below it.
pub fn below(
    end: f64,
    corners: &[f64],
    floor: impl Fn([f64; 2]) -> [f64; 2],
) -> Option<LowerCurve> {
    let tunnel = Tunnel::new(speeds(end, corners), &floor)?;
    let largest = tunnel.most.first().copied().unwrap_or(0.0);
    let fewest = tunnel.path(SUFFICIENT_SHORTFALL).map(|path| path.len());
    let count = fewest.map_or(MAX_POINTS, |n| n.min(MAX_POINTS));
    let fits = |shortfall: f64| tunnel.path(shortfall).filter(|path| path.len() <= count);
    // A shortfall of 1 allows a level curve, which needs one point.
    let (mut low, mut high) = (ROUNDING, 1.0);
    let mut path = fits(low);
    if path.is_none() {
        for _ in 0..24 {
            let middle = (low * high).sqrt();
            match fits(middle) {
                Some(better) => (high, path) = (middle, Some(better)),
                None => low = middle,
            }
        }
        path = path.or_else(|| fits(1.0));
    }
    let points: Vec<[f32; 2]> = path?
        .iter()
        .map(|&[speed, torque]| [speed as f32, (torque * (1.0 - MARGIN)) as f32])
        .collect();
    let missed = tunnel.missed(&points, &floor);
    Some(LowerCurve {
        points,
        shortfall: if largest > 0.0 { missed / largest } else { 0.0 },
    })
}

/// The curve through points, as [`jred::duty::Curve::at`] interpolates it, in double precision.
pub(super) fn at(points: &[[f32; 2]], speed: f64) -> f64 {
    let points = points.iter().map(|point| point.map(f64::from));
    let mut before: Option<[f64; 2]> = None;
    for [end, torque] in points {
        if speed <= end {
            return match before {
                Some([from, start]) => torque + (start - torque) * ((end - speed) / (end - from)),
                None => torque,
            };
        }
        before = Some([end, torque]);
    }
    0.0
}

/// The speeds at which points may lie: from rest to the largest single-precision number not beyond the end.
fn speeds(end: f64, corners: &[f64]) -> Vec<f32> {
    let last = rounded_down(end);
    let mut speeds: Vec<f32> = (0..EVEN).map(|k| last * (k as f32 / EVEN as f32)).collect();
    for &corner in corners {
        // Both sides of a jump.
        let below = rounded_down(corner);
        speeds.extend([below, below.next_up()]);
    }
    speeds.retain(|speed| *speed >= 0.0 && *speed < last);
    speeds.push(last);
    speeds.sort_by(f32::total_cmp);
    speeds.dedup();
    speeds
}

/// The largest single-precision number not above `x`.
pub(super) fn rounded_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x {
        near.next_down()
    } else {
        near
    }
}

impl Tunnel {
    fn new(mut speeds: Vec<f32>, floor: impl Fn([f64; 2]) -> [f64; 2]) -> Option<Self> {
        let mut between = Interval::all(&speeds, &floor);
        while let Some(more) = closer(&speeds, &between) {
            speeds.extend(more);
            speeds.sort_by(f32::total_cmp);
            between = Interval::all(&speeds, &floor);
        }
        let ends = between.iter().flat_map(|interval| interval.ends);
        let alone = floor([0.0; 2])[0];
        let finite = ends.chain([alone]).filter(|torque| torque.is_finite());
        let largest = finite.fold(f64::NEG_INFINITY, f64::max);
        if largest < 0.0 {
            return None;
        }
        // Never rising; an unknown limit at low speeds is at least the known one at higher speeds.
        let mut most = largest;
        for interval in &mut between {
            for end in &mut interval.ends {
                most = most.min(*end).max(0.0);
                *end = most;
            }
        }
        let last = between.last().map_or(largest, |interval| interval.ends[1]);
        let starts = between.iter().map(|interval| interval.ends[0]);
        Some(Self {
            most: starts.chain([last]).collect(),
            speeds,
            between,
        })
    }

    /// Lower bound of the curve at a speed.
    fn least(&self, place: usize, shortfall: f64) -> f64 {
        let (here, largest) = (self.most[place], self.most[0]);
        (here - 0.5 * shortfall * (here + largest)).max(0.0)
    }

    /// Largest distance of a curve below the limit (N·m), also between the speeds where points may lie.
    fn missed(&self, points: &[[f32; 2]], floor: &impl Fn([f64; 2]) -> [f64; 2]) -> f64 {
        let mut most = self.most.first().copied().unwrap_or(0.0);
        let mut missed = 0.0f64;
        let mut look = |speed: f64| {
            // A rise of the limit that the curve does not follow is not a shortfall.
            most = most.min(floor([speed; 2])[0]);
            missed = missed.max(most - at(points, speed));
        };
        for pair in self.speeds.windows(2) {
            let [from, to] = [pair[0], pair[1]].map(f64::from);
            for k in 0..PARTS {
                look(from + (to - from) * (f64::from(k) / f64::from(PARTS)));
            }
        }
        look(self.speeds.last().copied().map_or(0.0, f64::from));
        missed
    }

    /// The curve of the fewest points within a shortfall, as \[speed, torque\]; `None` if that is impossible.
    fn path(&self, shortfall: f64) -> Option<Vec<[f64; 2]>> {
        let count = self.speeds.len();
        let torque = |place: usize, step: usize| {
            let (most, least) = (self.most[place], self.least(place, shortfall));
            most - (most - least) * (step as f64 / STEPS as f64)
        };
        let unreached: Predecessor = (usize::MAX, None);
        let mut best = vec![[unreached; STEPS + 1]; count];
        let floor = self.least(0, shortfall);
        for place in 0..count {
            for step in 0..=STEPS {
                // Level up to here.
                let start = torque(place, step);
                if start >= floor {
                    best[place][step] = (1, None);
                }
                let (points, _) = best[place][step];
                if points >= MAX_POINTS {
                    continue;
                }
                self.reach(place, start, shortfall, |other, slopes, span| {
                    for (next, found) in best[other].iter_mut().enumerate() {
                        let slope = (torque(other, next) - start) / span;
                        if slopes[0] <= slope && slope <= slopes[1] && points + 1 < found.0 {
                            *found = (points + 1, Some((place, step)));
                        }
                    }
                });
            }
        }
        let last = best.last()?;
        let step = (0..=STEPS).min_by_key(|&step| last[step].0)?;
        let mut path = Vec::new();
        let mut here = Some((count - 1, step)).filter(|_| last[step].0 <= MAX_POINTS);
        while let Some((place, step)) = here {
            path.push([f64::from(self.speeds[place]), torque(place, step)]);
            here = best[place][step].1;
        }
        path.reverse();
        Some(path).filter(|path| !path.is_empty())
    }

    /// Every place that a line from here can reach: with the least and the largest slope that keep it within the bounds, and the distance.
    fn reach(
        &self,
        from: usize,
        start: f64,
        shortfall: f64,
        mut take: impl FnMut(usize, [f64; 2], f64),
    ) {
        let slack = 1e-9;
        let [mut least, mut largest] = [f64::NEG_INFINITY, f64::INFINITY];
        let origin = f64::from(self.speeds[from]);
        for place in from + 1..self.speeds.len() {
            let interval = &self.between[place - 1];
            let span = |place: usize| f64::from(self.speeds[place]) - origin;
            let above = |bound: f64, span: f64| (bound * (1.0 + slack) - start) / span;
            if place - 1 > from {
                largest = largest.min(above(interval.ends[0], span(place - 1)));
            }
            largest = largest.min(above(interval.ends[1], span(place)));
            if least > largest {
                return;
            }
            take(place, [least, largest], span(place));
            least = least.max((self.least(place, shortfall) - start) / span(place));
        }
    }
}

/// Midpoints of the intervals whose bound is loose, the loosest first; `None` if there are no loose ones, or already enough speeds.
fn closer(speeds: &[f32], between: &[Interval]) -> Option<Vec<f32>> {
    let ends = between.iter().flat_map(|interval| interval.ends);
    let largest = ends.filter(|end| end.is_finite()).fold(0.0, f64::max);
    let mut loose: Vec<(f64, f32)> = between
        .iter()
        .zip(speeds.windows(2))
        .filter(|(interval, _)| interval.loose > COARSE_SHORTFALL * largest)
        .map(|(interval, pair)| (interval.loose, f32::midpoint(pair[0], pair[1]), pair))
        .filter(|(_, middle, pair)| pair[0] < *middle && *middle < pair[1])
        .map(|(loose, middle, _)| (loose, middle))
        .collect();
    loose.sort_by(|a, b| b.0.total_cmp(&a.0));
    loose.truncate(MOST_SPEEDS.saturating_sub(speeds.len()));
    let more: Vec<f32> = loose.into_iter().map(|(_, speed)| speed).collect();
    Some(more).filter(|more| !more.is_empty())
}

impl Interval {
    fn all(speeds: &[f32], floor: &impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Self> {
        let pairs = speeds.windows(2);
        pairs
            .map(|pair| Self::new([pair[0], pair[1]], floor))
            .collect()
    }

    fn new([from, to]: [f32; 2], floor: &impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let next = from.next_up() >= to;
        let [from, to] = [from, to].map(f64::from);
        if next {
            // No single-precision speed lies between.
            return Self {
                ends: [from, to].map(|speed| floor([speed; 2])[0]),
                loose: 0.0,
            };
        }
        let place = |k: u32| match k {
            PARTS => to,
            _ => from + (to - from) * (f64::from(k) / f64::from(PARTS)),
        };
        let floors: Vec<([f64; 2], [f64; 2])> = (0..PARTS)
            .map(|k| [place(k), place(k + 1)])
            .map(|speeds| (speeds, floor(speeds)))
            .collect();
        let [start, end] = [floor([from; 2])[0], floor([to; 2])[0]];
        let line = |speed: f64| start + (end - start) * ((speed - from) / (to - from));
        let over = floors
            .iter()
            .flat_map(|(speeds, torques)| [0, 1].map(|k| line(speeds[k]) - torques[k]))
            .fold(0.0, f64::max);
        let lowered = [start - over, end - over];
        let is_limit = |torque: &f64| (0.0..f64::INFINITY).contains(torque);
        let ends = if lowered.iter().all(is_limit) {
            lowered
        } else {
            // An unknown limit, or a steep and curved one.
            let least = floors.iter().flat_map(|(_, torques)| *torques);
            [least.fold(f64::INFINITY, f64::min).max(0.0); 2]
        };
        let missed = (0..=PARTS).map(place).map(|speed| {
            let line = ends[0] + (ends[1] - ends[0]) * ((speed - from) / (to - from));
            floor([speed; 2])[0] - line
        });
        let loose = missed.filter(|missed| missed.is_finite());
        Self {
            ends,
            loose: loose.fold(0.0, f64::max),
        }
    }
}

#[cfg(test)]
mod tests;
