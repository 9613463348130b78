//! Ramps: the acceleration rises from zero at rest to its first peak in the given share of the time.
//!
//! In the pieces at ends at rest the pace is constant, so the acceleration rises as the path bends ([`super::mesh`]), over exactly that share of the
//! time. How high it rises depends on the length of the piece along the path, which is found by a search. At a moving end the piece is as long as
//! that share of the time requires.

use jred_file::math;
use jred_file::number::quadrature::GAUSS_5;

use super::task::{EffortTask, Solution, Start};
use super::{FIRST, Fault, solve};

/// Lengths of the pieces: the longest, and the number of corrections at a moving end.
const LONGEST: f64 = 0.45;
const CORRECTED: u32 = 4;

/// Change of a length, as its logarithm, at the start and at the end of the search.
const CHANGES: [f64; 2] = [0.4, 0.01];

/// Share of its first peak that the acceleration must have reached at the end of the ramp, the penalty per missing share, and the number of places
/// behind the ramp at which it is checked.
const REACHED: f64 = 0.9;
const PENALTY: f64 = 10.0;
const PLACES_BEHIND: u32 = 32;

impl<'a> EffortTask<'a> {
    /// The same task with the best pieces for the requested ramp, for a motion with this time in motion (s).
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub(super) fn fitted(&self, moving: f64) -> Result<EffortTask<'a>, Fault> {
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

    /// Varies the lengths of the pieces at rest by smaller and smaller factors as long as that lowers the cost.
    fn highest(self, moving: f64, rest: [bool; 2]) -> Result<EffortTask<'a>, Fault> {
        let mut best = (f64::INFINITY, self.ramps);
        // Each solution starts from the one before: neighbours differ little.
        let mut start: Option<Start> = None;
        let mut at = |ramps: [f64; 2]| -> Result<f64, Fault> {
            if ramps.iter().any(|ramp| *ramp > LONGEST) {
                return Ok(f64::INFINITY);
            }
            let task = EffortTask {
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
            // In a time in which the machine would crawl no motion is found, whatever the ramps.
            return Ok(EffortTask {
                ramps: best.1,
                ..self
            });
        }
        let mut change = CHANGES[0];
        while change > CHANGES[1] {
            let mut moved = false;
            // Both together, then each alone.
            for which in [[true; 2], [true, false], [false, true]] {
                if which
                    .iter()
                    .zip(rest)
                    .any(|(changes, rests)| *changes && !rests)
                {
                    continue;
                }
                for factor in [math::exp(change), math::exp(-change)] {
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
        Ok(EffortTask {
            ramps: best.1,
            ..self
        })
    }
}

impl Solution<'_> {
    /// The objective, in units independent of the mesh.
    fn figure(&self) -> f64 {
        let power = f64::from(self.stage.cost.power);
        math::pow(self.found.cost.max(0.0), 1.0 / power) * self.scale.unit
    }

    /// Relative excess of the acceleration in the piece behind a ramp.
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
