//! The search over the phases between axes.
//!
//! All goals are searched in one pass over the same grid. Two axes: all phases on a grid of 720 per cycle; three: 48 × 48; then finer around the best
//! of each goal. More: one phase at a time from several starts. Cycles that repeat together only after several cycles of each have fewer distinct
//! phases ([`Common::reach`](super::period::Common)), so the work does not grow with the length of the common period.

use super::curve::PowerCurve;
use crate::threads;

/// Receives the progress of a search.
pub trait Watch: Sync {
    /// Adds `count` phases to be tried.
    fn planned(&self, count: u64);
    /// Reports `count` phases as done.
    fn done(&self, count: u64);
}

/// Ignores progress.
impl Watch for () {
    fn planned(&self, _: u64) {}
    fn done(&self, _: u64) {}
}

/// Grid phases per cycle for two axes, for three, and for one phase of many.
const GRID: [f64; 3] = [720.0, 48.0, 48.0];

/// Least number of grid phases for two axes, and for three.
const LEAST: [f64; 2] = [16.0, 32.0];

/// Parts of a grid step around the best place, and halvings of such a part after that.
const PARTS: u32 = 8;
const HALVINGS: u32 = 12;

/// If all values around a phase agree to this share, the search is not refined there.
const FLATNESS: f64 = 1e-9;

/// Starts of a one-phase-at-a-time search, besides the start with all largest powers fed back at once.
const STARTS: u32 = 4;

/// Curves of one period on a bus, the first one fixed.
pub(super) struct Phases<'a> {
    /// The curves over the common period.
    pub(super) whole: &'a [PowerCurve],
    /// Largest distinct phase (s) of each.
    pub(super) reach: &'a [f64],
    /// Period of each (s).
    pub(super) periods: Vec<f64>,
}

/// The best phases for a goal.
#[derive(Clone, Debug)]
pub(super) struct PhaseSolution {
    pub(super) phases: Vec<f64>,
    value: f64,
    /// The smallest value seen.
    least: f64,
}

impl PhaseSolution {
    fn of<const N: usize>(phases: &[f64], values: [f64; N]) -> [Self; N] {
        values.map(|value| Self {
            phases: phases.to_vec(),
            value,
            least: value,
        })
    }

    fn or(&mut self, phases: &[f64], value: f64) {
        self.least = self.least.min(value);
        if value > self.value {
            self.phases.clear();
            self.phases.extend_from_slice(phases);
            self.value = value;
        }
    }

    /// Merges the result of another search.
    fn with(&mut self, other: &Self) {
        self.or(&other.phases, other.value);
        self.least = self.least.min(other.least);
    }

    /// Whether continuing cannot improve the result.
    fn is_flat(&self) -> bool {
        self.value.is_infinite() || self.value - self.least <= FLATNESS * self.value.abs()
    }
}

/// Evaluates all goals at one set of phases.
fn offer<const N: usize>(best: &mut [PhaseSolution; N], phases: &[f64], values: [f64; N]) {
    for (found, value) in best.iter_mut().zip(values) {
        found.or(phases, value);
    }
}

/// Working curves.
struct Room {
    moved: PowerCurve,
    sum: PowerCurve,
}

impl Room {
    const fn new() -> Self {
        Self {
            moved: PowerCurve::empty(),
            sum: PowerCurve::empty(),
        }
    }

    /// `rest` and a curve moved by `phase`.
    fn sum(&mut self, rest: &PowerCurve, curve: &PowerCurve, phase: f64) -> &PowerCurve {
        curve.shift_into(phase, &mut self.moved);
        rest.sum_into(&self.moved, &mut self.sum);
        &self.sum
    }
}

impl Phases<'_> {
    /// All axes but `without`.
    fn rest(&self, phases: &[f64], without: usize) -> PowerCurve {
        let others = self.whole.iter().zip(phases).enumerate();
        let others = others.filter(|(axis, _)| *axis != without);
        others
            .map(|(_, (curve, phase))| curve.shifted(*phase))
            .reduce(|sum, next| sum.plus(&next))
            .unwrap_or_else(|| PowerCurve::new([], self.whole[without].period()))
    }

    /// The power of all axes.
    pub(super) fn all(&self, phases: &[f64]) -> PowerCurve {
        self.rest(phases, usize::MAX)
    }

    /// All axes feed back their largest power at once.
    fn aligned(&self) -> Vec<f64> {
        let least: Vec<f64> = self.whole.iter().map(PowerCurve::least_at).collect();
        let phases = least.iter().zip(&self.periods);
        phases
            .map(|(at, period)| (least[0] - at).rem_euclid(*period))
            .collect()
    }

    /// Grid phases per cycle.
    fn grid(&self) -> f64 {
        GRID[self.whole.len().clamp(2, 4) - 2]
    }

    /// Number of grid places for the phase of an axis, and their distance (s).
    fn step(&self, axis: usize) -> (u32, f64) {
        let grid = self.grid();
        if self.whole.len() > 3 {
            // One phase moves at a time: while the others are fixed, all phases of the axis's own period count.
            return (grid as u32, self.periods[axis] / grid);
        }
        let count = (grid * self.reach[axis] / self.periods[axis])
            .ceil()
            .max(LEAST[usize::from(self.whole.len() > 2)]);
        (count as u32, self.reach[axis] / count)
    }

    /// The phases at which each goal is largest, as far as the search finds them. `everywhere`: whether the goals depend on the phases at all.
    pub(super) fn search<const N: usize>(
        &self,
        everywhere: bool,
        goals: impl Fn(&PowerCurve) -> [f64; N] + Sync,
        watch: &dyn Watch,
    ) -> [PhaseSolution; N] {
        let in_step = vec![0.0; self.whole.len()];
        let mut best = PhaseSolution::of(&in_step, goals(&self.all(&in_step)));
        let aligned = self.aligned();
        offer(&mut best, &aligned, goals(&self.all(&aligned)));
        if !everywhere || self.whole.len() < 2 {
            return best;
        }
        match self.whole {
            [first, second] => self.pair(first, second, &goals, watch, &mut best),
            [first, second, third] => {
                let three = [first, second, third];
                self.triple(three, &goals, watch, &mut best);
            }
            _ => self.many(&goals, watch, &mut best),
        }
        threads::for_each(&mut best, |goal, found| {
            self.close_in(goal, found, &goals, watch);
        });
        best
    }

    fn pair<const N: usize>(
        &self,
        first: &PowerCurve,
        second: &PowerCurve,
        goals: &(impl Fn(&PowerCurve) -> [f64; N] + Sync),
        watch: &dyn Watch,
        best: &mut [PhaseSolution; N],
    ) {
        let (count, step) = self.step(1);
        watch.planned(u64::from(count));
        let values: Vec<[f64; N]> = threads::map_in(count, Room::new, |room, i| {
            let values = goals(room.sum(first, second, f64::from(i) * step));
            watch.done(1);
            values
        });
        // In the order of the phases: the result does not depend on how the work was distributed.
        for (i, values) in values.into_iter().enumerate() {
            offer(best, &[0.0, i as f64 * step], values);
        }
    }

    fn triple<const N: usize>(
        &self,
        [first, second, third]: [&PowerCurve; 3],
        goals: &(impl Fn(&PowerCurve) -> [f64; N] + Sync),
        watch: &dyn Watch,
        best: &mut [PhaseSolution; N],
    ) {
        let [(rows, row), (columns, column)] = [1, 2].map(|axis| self.step(axis));
        watch.planned(u64::from(rows) * u64::from(columns));
        let lines: Vec<Option<[PhaseSolution; N]>> = threads::map_in(rows, Room::new, |room, i| {
            let phase = f64::from(i) * row;
            let both = first.plus(&second.shifted(phase));
            let mut line: Option<[PhaseSolution; N]> = None;
            for k in 0..columns {
                let phases = [0.0, phase, f64::from(k) * column];
                let values = goals(room.sum(&both, third, phases[2]));
                match &mut line {
                    Some(line) => offer(line, &phases, values),
                    None => line = Some(PhaseSolution::of(&phases, values)),
                }
            }
            watch.done(u64::from(columns));
            line
        });
        for line in lines.iter().flatten() {
            best.iter_mut().zip(line).for_each(|(a, b)| a.with(b));
        }
    }

    fn many<const N: usize>(
        &self,
        goals: &(impl Fn(&PowerCurve) -> [f64; N] + Sync),
        watch: &dyn Watch,
        best: &mut [PhaseSolution; N],
    ) {
        // Evenly spread starts: multiples of the golden section, one for each axis.
        const SECTION: f64 = 0.618_033_988_749_894_9;
        let spread = |start: u32| -> Vec<f64> {
            let periods = self.periods.iter().enumerate();
            periods
                .map(|(axis, period)| (f64::from(start) * axis as f64 * SECTION).fract() * period)
                .collect()
        };
        let starts: Vec<Vec<f64>> = std::iter::once(self.aligned())
            .chain((0..STARTS).map(spread))
            .collect();
        watch.planned(starts.len() as u64 * self.climbs(N));
        let ends: Vec<[PhaseSolution; N]> =
            threads::map(&starts, |start| self.climb(start, goals, watch));
        for end in &ends {
            best.iter_mut().zip(end).for_each(|(a, b)| a.with(b));
        }
    }

    /// Number of phases that a climb is expected to try: two rounds for each goal.
    fn climbs(&self, goals: usize) -> u64 {
        (2 * goals * (self.whole.len() - 1)) as u64 * self.grid() as u64
    }

    /// Coordinate ascent: one phase at a time until no goal improves, for each goal from the best phases found so far.
    fn climb<const N: usize>(
        &self,
        start: &[f64],
        goals: &impl Fn(&PowerCurve) -> [f64; N],
        watch: &dyn Watch,
    ) -> [PhaseSolution; N] {
        let mut room = Room::new();
        let mut best = PhaseSolution::of(start, goals(&self.all(start)));
        let mut expected = self.climbs(N);
        for goal in 0..N {
            // A goal that no phase has changed so far does not depend on them.
            if goal > 0 && best[goal].is_flat() {
                continue;
            }
            loop {
                let before = best[goal].value;
                for axis in 1..self.whole.len() {
                    let mut phases = best[goal].phases.clone();
                    let rest = self.rest(&phases, axis);
                    let (count, step) = self.step(axis);
                    if expected == 0 {
                        watch.planned(u64::from(count));
                    }
                    expected = expected.saturating_sub(u64::from(count));
                    for i in 0..count {
                        phases[axis] = f64::from(i) * step;
                        let sum = room.sum(&rest, &self.whole[axis], phases[axis]);
                        offer(&mut best, &phases, goals(sum));
                    }
                    watch.done(u64::from(count));
                }
                if best[goal].value <= before {
                    break;
                }
            }
        }
        watch.done(expected);
        best
    }

    /// Refines around a place: once between its grid neighbours, then by repeated halving.
    fn close_in<const N: usize>(
        &self,
        goal: usize,
        found: &mut PhaseSolution,
        goals: &impl Fn(&PowerCurve) -> [f64; N],
        watch: &dyn Watch,
    ) {
        let mut room = Room::new();
        let mut width = 1.0;
        let mut parts = PARTS;
        if found.is_flat() {
            return;
        }
        for _ in 0..=HALVINGS {
            found.least = found.value;
            for axis in 1..self.whole.len() {
                let centre = found.phases.clone();
                let rest = self.rest(&centre, axis);
                let step = self.step(axis).1;
                let mut phases = centre.clone();
                watch.planned(u64::from(2 * parts));
                // Both sides; the middle is already evaluated.
                for i in (0..=2 * parts).filter(|i| *i != parts) {
                    let off = (f64::from(i) / f64::from(parts) - 1.0) * width * step;
                    phases[axis] = (centre[axis] + off).rem_euclid(self.periods[axis]);
                    let value = goals(room.sum(&rest, &self.whole[axis], phases[axis]))[goal];
                    found.or(&phases, value);
                }
                watch.done(u64::from(2 * parts));
            }
            if found.is_flat() {
                return;
            }
            width *= 0.5 / f64::from(parts);
            parts = 1;
        }
    }
}
