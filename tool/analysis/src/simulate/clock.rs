//! The time of a simulation as the time of `[motion]`, and the times at which the machine changes by it.

use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;

use super::coupled::GearedMachine;

/// Distance from a corner, per second of time, at which a step is evaluated: a jump belongs to both sides.
pub(super) const EDGE: f64 = 1e-13;

/// An instant of a simulation, and the direction of the first drive link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Time (s).
    pub t: f64,
    /// +1, −1, or 0 if friction holds it.
    pub direction: f64,
    /// Whether it is still at rest and about to move in this direction.
    pub starts: bool,
}

impl Moment {
    /// Moving, or held.
    pub const fn new(t: f64, direction: f64) -> Self {
        Self {
            t,
            direction,
            starts: false,
        }
    }

    /// At rest, about to move.
    pub const fn starting(t: f64, direction: f64) -> Self {
        Self {
            starts: true,
            ..Self::new(t, direction)
        }
    }

    /// The instant for a machine whose own drive link moves with ω.
    pub(super) fn now(&self, machine: &GearedMachine, omega: f64) -> ScheduleInstant {
        let (_, t) = Clock::of(machine.file).split(self.t);
        let direction = self.direction * machine.ratio();
        if self.starts {
            ScheduleInstant::starting(t, direction)
        } else if direction == 0.0 {
            ScheduleInstant::of(t, 0.0)
        } else {
            ScheduleInstant::moving(t, omega, direction)
        }
    }
}

/// The clock of a machine: its `[motion]` begins with the simulation. A cyclic motion is repeated; any other stays at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    /// Duration of a cycle (s).
    cycle: Option<f64>,
}

impl Clock {
    pub(super) fn of(file: &MachineFile) -> Self {
        let motion = file.motion.as_ref().filter(|motion| motion.cyclic);
        Self {
            cycle: motion.map(Motion::duration),
        }
    }

    /// Number of complete cycles at the time `t`, and the time of the motion since then.
    pub(super) fn split(self, t: f64) -> (f64, f64) {
        self.cycle.map_or((0.0, t), |cycle| {
            let cycles = (t / cycle).floor();
            (cycles, t - cycles * cycle)
        })
    }
}

/// Times at which forces or masses jump or bend: no step of the integrator crosses one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Corners {
    once: Vec<f64>,
    /// Duration of a cycle (s), and the times in it, of which the last may be its end.
    repeated: Vec<(f64, Vec<f64>)>,
}

impl Corners {
    /// Corners at these times.
    pub(super) fn at(times: impl IntoIterator<Item = f64>) -> Self {
        Self {
            once: sorted(times),
            repeated: Vec::new(),
        }
    }

    /// Adds the times of a motion with this clock.
    pub(super) fn by(mut self, clock: Clock, times: impl IntoIterator<Item = f64>) -> Self {
        let times = times.into_iter().filter(|t| *t > 0.0);
        match clock.cycle {
            Some(cycle) => self.repeated.push((cycle, sorted(times))),
            None => self.once = sorted(self.once.into_iter().chain(times)),
        }
        self
    }

    /// Adds the times of a machine's schedule.
    pub(super) fn of_schedule(self, file: &MachineFile) -> Self {
        self.by(Clock::of(file), file.schedule.times())
    }

    /// The last corner up to the time `t`, and the first one after it; of those that differ by rounding, the last.
    pub(super) fn around(&self, t: f64) -> [Option<f64>; 2] {
        let mut all = Vec::new();
        let mut neighbours = |start: f64, times: &[f64]| {
            let next = times.partition_point(|at| start + at <= t);
            let around = [next.checked_sub(1), Some(next)].into_iter().flatten();
            all.extend(around.filter_map(|k| times.get(k)).map(|at| start + at));
        };
        neighbours(0.0, &self.once);
        for (cycle, times) in &self.repeated {
            let now = (t / cycle).floor();
            // By rounding it may already be the next cycle, or still the last one.
            for cycles in [now - 1.0, now, now + 1.0] {
                if cycles >= 0.0 {
                    neighbours(cycles * cycle, times);
                }
            }
        }
        let before = all.iter().copied().filter(|at| *at <= t);
        let behind = || all.iter().copied().filter(|at| *at > t);
        let first = behind().reduce(f64::min);
        let after = first.map(|first| {
            let same = behind().filter(|at| at - first <= EDGE * (1.0 + first));
            same.fold(first, f64::max)
        });
        [before.reduce(f64::max), after]
    }
}

/// Sorted; of those that differ by rounding, the last.
fn sorted(times: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = times.into_iter().collect();
    all.sort_by(f64::total_cmp);
    let mut kept: Vec<f64> = Vec::with_capacity(all.len());
    for t in all {
        match kept.last_mut() {
            Some(last) if t - *last <= EDGE * (1.0 + last.abs()) => *last = t,
            _ => kept.push(t),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a cycle of 0.3 s at 0.1 s and its end, and a single one at 0.4 s.
    #[test]
    fn corners_repeat_with_their_cycle() {
        let clock = Clock { cycle: Some(0.3) };
        let corners = Corners::at([0.4]).by(clock, [0.0, 0.1, 0.3]);
        let mut t = 0.0;
        let mut passed = Vec::new();
        while let [_, Some(next)] = corners.around(t) {
            assert!(next > t);
            t = next;
            if t > 1.0 {
                break;
            }
            passed.push(t);
            assert_eq!(corners.around(t)[0], Some(t));
        }
        // 0.3 + 0.1 and 0.4 are one corner.
        let expected = [0.1, 0.3, 0.4, 0.6, 0.7, 0.9];
        assert_eq!(passed.len(), 7, "{passed:?}");
        for (at, expected) in passed.iter().zip(expected) {
            assert!((at - expected).abs() < 1e-15, "{passed:?}");
        }
        assert_eq!(corners.around(0.0)[0], None);
        let (cycles, time) = clock.split(0.75);
        assert!((cycles - 2.0).abs() < 1e-15 && (time - 0.15).abs() < 1e-15);
        assert_eq!(Clock { cycle: None }.split(0.75), (0.0, 0.75));
    }
}
