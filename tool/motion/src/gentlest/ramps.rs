//! Ramps: the acceleration rises from zero at rest to its first peak in the share of the time that is asked for.
//!
//! In the pieces at the ends that rest the pace is even, so that the acceleration rises there as the path bends ([`super::mesh`]), over exactly that share of the
//! time. What is left to choose is how high it rises: it goes with the length of the piece along the path, which is sought. At an end that moves the piece
//! is as long as it takes so much time.

use jred_machine::number::quadrature::GAUSS_5;

use super::task::{Solved, Start, Task};
use super::{FIRST, Fault, solve};

/// Lengths of the pieces: the longest, and how often that of an end that moves is corrected.
const LONGEST: f64 = 0.45;
const CORRECTED: u32 = 4;

/// Change of a length, as its logarithm, with which the search begins and ends.
const CHANGES: [f64; 2] = [0.4, 0.01];

/// Share of its first peak that the acceleration must have reached when the ramp ends, how much dearer a motion counts by the share that it lacks, and places
/// behind the ramp at which that is looked at.
const REACHED: f64 = 0.9;
const PENALTY: f64 = 10.0;
const PLACES_BEHIND: u32 = 32;

impl<'a> Task<'a> {
    /// The same with the best pieces for the ramp that is asked for, for a motion that moves for so long (s).
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub(super) fn fitted(&self, moving: f64) -> Result<Task<'a>, Fault> {
        let asked = self.travel.ends().ramp;
        let mut task = self.clone();
        if asked == 0.0 {
            return Ok(task);
        }
        let rest = self.travel.ends().rest;
        let corrected = if rest == [true; 2] { 0 } else { CORRECTED };
        for _ in 0..corrected {
            let Some(solved) = task.solve(moving, FIRST, None)? else {
                break;
            };
            let rises = [0, 1].map(|end| solved.time_of_end(end));
            let mut next = task.clone();
            for end in [0, 1].into_iter().filter(|end| !rest[*end]) {
                next.ramps[end] = (next.ramps[end] * asked / rises[end]).min(LONGEST);
            }
            task = next;
        }
        task.highest(moving, rest)
    }

    /// With lengths of the pieces at rest, each changed by smaller and smaller factors as long as that costs less.
    fn highest(self, moving: f64, rest: [bool; 2]) -> Result<Task<'a>, Fault> {
        let mut best = (f64::INFINITY, self.ramps);
        // Each search begins with the solution before: neighbours differ little.
        let mut start: Option<Start> = None;
        let mut at = |ramps: [f64; 2]| -> Result<f64, Fault> {
            if ramps.iter().any(|ramp| *ramp > LONGEST) {
                return Ok(f64::INFINITY);
            }
            let task = Task {
                ramps,
                ..self.clone()
            };
            let solved = task.solve(moving, FIRST, start.as_ref())?;
            Ok(solved.map_or(f64::INFINITY, |solved| {
                start = Some(solved.start());
                let beyond = [0, 1].into_iter().filter(|end| rest[*end]);
                let beyond: f64 = beyond.map(|end| solved.beyond(end)).sum();
                solved.figure() * (1.0 + PENALTY * beyond)
            }))
        };
        best.0 = at(best.1)?;
        if best.0.is_infinite() {
            // In a time in which the machine would crawl no motion is found, whatever its ramps.
            return Ok(Task {
                ramps: best.1,
                ..self
            });
        }
        let mut change = CHANGES[0];
        while change > CHANGES[1] {
            let mut moved = false;
            // Both together, and each alone.
            for which in [[true; 2], [true, false], [false, true]] {
                if which
                    .iter()
                    .zip(rest)
                    .any(|(changes, rests)| *changes && !rests)
                {
                    continue;
                }
                for factor in [change.exp(), (-change).exp()] {
                    let mut ramps = best.1;
                    for (ramp, changes) in ramps.iter_mut().zip(which) {
                        if changes {
                            *ramp *= factor;
                        }
                    }
                    let own = at(ramps)?;
                    if own < best.0 {
                        (best, moved) = ((own, ramps), true);
                        break;
                    }
                }
            }
            if !moved {
                change *= 0.5;
            }
        }
        Ok(Task {
            ramps: best.1,
            ..self
        })
    }
}

impl Solved<'_> {
    /// What is least, in units that do not depend on the mesh.
    fn figure(&self) -> f64 {
        let power = f64::from(self.stage.cost.power);
        self.found.cost.max(0.0).powf(1.0 / power) * self.scale.unit
    }

    /// Share by which the acceleration rises too far in the piece behind a ramp.
    fn beyond(&self, end: usize) -> f64 {
        let last = self.mesh.elements.len() - 1;
        let element = if end == 0 { 1 } else { last - 1 };
        let [from, to] = self.mesh.elements[element].span;
        let size = |k: u32| {
            let share = f64::from(k) / f64::from(PLACES_BEHIND);
            let place = if end == 0 { share } else { 1.0 - share };
            let u = from + place * (to - from);
            let [w, change, _] = solve::pace_at(&self.mesh, &self.found.x, element, u);
            let [_, slope, bend] = self.mesh.shape.at(u);
            (bend * w + 0.5 * slope * change).abs()
        };
        let border = size(0);
        let most = (1..=PLACES_BEHIND).map(size).fold(border, f64::max);
        (REACHED * most / border - 1.0).max(0.0)
    }

    /// Share of the time that the piece at an end takes.
    fn time_of_end(&self, end: usize) -> f64 {
        let element = end * (self.mesh.elements.len() - 1);
        let [from, to] = self.mesh.elements[element].span;
        let part = GAUSS_5.map(|[z, weight]| {
            let [w, ..] =
                solve::pace_at(&self.mesh, &self.found.x, element, from + z * (to - from));
            weight / w.sqrt()
        });
        (to - from) * part.iter().sum::<f64>()
    }
}
