//! The holding torque at rest, and its duration.
//!
//! Weight and springs act wherever the machine is stopped, and so does a constant force or moment that the machine file ties to no position, time or
//! direction: the motor must hold them without end. A process load acts at rest only as long as a dwell of the motion lasts.

use jred::error::Error;
use jred::machine::{Action, Mechanism as _};

use crate::duty::Instant;
use jred_file::model::machine::MachineFile;
use jred_file::model::virtual_link::LinkCurve;

/// Share of a torque that is rounding.
const TORQUE_ROUNDING: f64 = 1e-9;

/// Torques (N·m, or N) that hold the machine at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rest {
    /// The largest torque that may last without end.
    endless: f64,
    /// Times (s) for which a dwell holds at least a torque, with that torque: times falling, torques rising.
    dwells: Vec<[f64; 2]>,
}

/// The sources of a motion's holding torques.
#[derive(Clone, Copy, Debug)]
pub struct HoldingTorques<'a> {
    /// The instants of the motion.
    pub instants: &'a [Instant],
    /// Torque (N·m, or N) at the drive link against the constant loads, one for each instant; zero in motion.
    pub constant: &'a [f64],
    /// Length of the motion (s).
    pub duration: f64,
    /// Whether the motion repeats.
    pub cyclic: bool,
}

impl Rest {
    /// The torques at rest in a motion, and against weight and springs wherever else the machine may rest, all at the drive link.
    pub fn new(held: &HoldingTorques, weights: impl Iterator<Item = f64>) -> Self {
        let mut endless = weights.fold(0.0, |most, weight| f64::max(most, weight.abs()));
        for (instant, constant) in held.instants.iter().zip(held.constant) {
            if instant.omega == 0.0 {
                endless = endless.max((instant.terms.potential + constant).abs());
            }
        }
        let mut spans = Vec::new();
        for run in held.runs() {
            lengths(&run, &mut spans);
        }
        for [time, _] in &mut spans {
            // A machine that never moves rests without end.
            if *time >= held.duration {
                *time = f64::INFINITY;
            }
        }
        spans.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]).then(b[1].total_cmp(&a[1])));
        let mut dwells: Vec<[f64; 2]> = Vec::new();
        for [time, torque] in spans {
            if torque > dwells.last().map_or(endless, |last| last[1]) {
                dwells.push([time, torque]);
            }
        }
        Self { endless, dwells }
    }

    /// The largest torque.
    pub fn largest(&self) -> f64 {
        self.lasting(0.0)
    }

    /// The largest torque that lasts longer than a time (s).
    pub fn lasting(&self, time: f64) -> f64 {
        let longer = self.dwells.iter().take_while(|[length, _]| *length > time);
        longer.last().map_or(self.endless, |[_, torque]| *torque)
    }

    /// The longest time (s) for which more than this torque is held; `None` if it never is.
    pub fn longest_above(&self, torque: f64) -> Option<f64> {
        let above = |most: f64| most > torque * (1.0 + TORQUE_ROUNDING);
        if above(self.endless) {
            return Some(f64::INFINITY);
        }
        let first = self.dwells.iter().find(|[_, held]| above(*held));
        first.map(|[time, _]| *time)
    }

    /// The torques multiplied by a factor.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.endless *= factor;
        for [_, torque] in &mut self.dwells {
            *torque *= factor;
        }
        self
    }
}

impl HoldingTorques<'_> {
    /// The stretches at rest: times (s) with the torque against weight and process loads. A stretch over the end of a cycle is one.
    fn runs(&self) -> Vec<Vec<[f64; 2]>> {
        let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut resting = false;
        for instant in self.instants {
            let rests = instant.omega == 0.0;
            if rests {
                if !resting {
                    runs.push(Vec::new());
                }
                let torque = (instant.terms.potential + instant.terms.process).abs();
                if let Some(run) = runs.last_mut() {
                    run.push([instant.t, torque]);
                }
            }
            resting = rests;
        }
        let at_rest = |instant: Option<&Instant>| instant.is_some_and(|i| i.omega == 0.0);
        if self.cyclic && at_rest(self.instants.first()) && at_rest(self.instants.last()) {
            let shifted = |[t, torque]: &[f64; 2]| [t + self.duration, *torque];
            if let [only] = runs.as_mut_slice() {
                let again: Vec<[f64; 2]> = only.iter().map(shifted).collect();
                only.extend(again);
            } else if let Some(mut last) = runs.pop() {
                if let Some(first) = runs.first_mut() {
                    last.extend(first.iter().map(shifted));
                }
                runs.push(last);
            }
        }
        runs
    }
}

/// Adds the times for which each torque of a stretch at rest is at least held: pairs of time and torque [s, N·m].
fn lengths(run: &[[f64; 2]], spans: &mut Vec<[f64; 2]>) {
    // Rising torques, each with the time since which no torque was below it.
    let mut open: Vec<[f64; 2]> = Vec::new();
    let mut close = |open: &mut Vec<[f64; 2]>, at: f64, below: f64| {
        let mut since = at;
        while let Some([from, torque]) =
            open.pop_if(|last| last[1] * (1.0 - TORQUE_ROUNDING) > below)
        {
            since = from;
            spans.push([at - from, torque]);
        }
        since
    };
    let Some([_, end]) = run.first().zip(run.last()).map(|(a, b)| [a[0], b[0]]) else {
        return;
    };
    for &[t, torque] in run {
        let since = close(&mut open, t, torque);
        if open.last().is_none_or(|last| torque > last[1]) {
            open.push([since, torque]);
        }
    }
    close(&mut open, end, f64::NEG_INFINITY);
}

/// Torque (N·m, or N) at the drive link against the loads that act at any position, time and direction, one for each instant; zero in motion.
///
/// # Errors
/// The mechanism cannot be placed.
pub fn constant_loads(file: &MachineFile, instants: &[Instant]) -> Result<Vec<f64>, Error> {
    let machine = &file.machine;
    let mechanism = machine.mechanism();
    let (_, courses) = mechanism.bare();
    let first_curve = mechanism.links().len().saturating_sub(courses.len());
    let always = |k: usize, load: &jred::machine::Load| {
        let constant = matches!(load.action(), Action::Force(_) | Action::Moment(_));
        let tied = load.window().is_some()
            || file.schedule.loads().iter().any(|other| other.load == k)
            || file.schedule.is_of_carriage(k);
        // A curve over the position is tied to it, except for a torque that is a property of the machine.
        let curve = load.link().checked_sub(first_curve);
        let curve = curve.and_then(|k| courses.get(k));
        constant && !tied && curve.is_none_or(|course| matches!(course, LinkCurve::Torque(_)))
    };
    let loads = machine.loads().iter().enumerate();
    let loads: Vec<_> = loads.filter(|(k, load)| always(*k, load)).collect();
    let mut known: Option<(u64, f64)> = None;
    let mut torque = |phi: f64| -> Result<f64, Error> {
        if let Some((place, torque)) = known
            && place == phi.to_bits()
        {
            return Ok(torque);
        }
        let frames = mechanism.frames(phi)?;
        let reduced = loads.iter().filter_map(|(_, load)| {
            let frame = frames.get(load.link())?;
            Some(load.reduce(frame, phi).process)
        });
        let torque = -reduced.sum::<f64>();
        known = Some((phi.to_bits(), torque));
        Ok(torque)
    };
    let rests = |instant: &Instant| instant.omega == 0.0 && !loads.is_empty();
    (instants.iter())
        .map(|instant| {
            if rests(instant) {
                torque(instant.phi)
            } else {
                Ok(0.0)
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with every stretch of every length.
    #[test]
    fn lengths_are_those_of_every_stretch() {
        let mut seed = 7u32;
        for _ in 0..200 {
            let mut next = |below: u32| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                seed >> 16 & (below - 1)
            };
            let (mut t, mut run) = (0.0, Vec::new());
            for _ in 0..12 {
                run.push([t, f64::from(next(8))]);
                t += f64::from(next(4));
            }
            let mut spans = Vec::new();
            lengths(&run, &mut spans);
            for level in 1..8 {
                let level = f64::from(level);
                let mut longest = None;
                for (from, to) in (0..12).flat_map(|from| (from..12).map(move |to| (from, to))) {
                    let stays = run.iter().skip(from).take(to - from).all(|p| p[1] >= level);
                    // A torque lasts until the next instant, where it may change.
                    if stays && to > from {
                        longest =
                            f64::max(longest.unwrap_or(0.0), run[to][0] - run[from][0]).into();
                    }
                }
                let found = spans.iter().filter(|span| span[1] >= level);
                let found = found.map(|span| span[0]).reduce(f64::max);
                let last = run.last().is_some_and(|p| p[1] >= level);
                let expected = longest.or_else(|| last.then_some(0.0));
                assert_eq!(found, expected, "{level} in {run:?}");
            }
        }
    }
}
