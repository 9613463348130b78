//! The losses over a cycle, and the temperatures that they lead to.

use super::network::{Change, Losses, Network, Rise};
use jred_machine::model::operation::Operation;

/// The losses at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time (s).
    pub t: f64,
    /// Root of the copper loss (√W) with the winding at the temperature of the surroundings, with the sign of the torque. It
    /// is proportional to the current, and runs in a straight line from one instant to the next.
    pub root: f64,
    /// Other losses (W); a straight line from one instant to the next.
    pub other: f64,
}

/// The losses over one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    points: Vec<Point>,
    duration: f64,
}

/// The hottest rises above the surroundings (K).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hottest {
    /// Of winding and housing; of the motor as a whole the first counts.
    Rise(Rise),
    /// There is no bound: the copper loss grows faster with the temperature than the heat that flows off.
    Runaway,
}

/// Longest part of a stretch of changing losses, as a share of the network's fastest time constant: what is missed by taking
/// the losses as constant over a part falls with its square.
const PART: f64 = 0.02;

/// The most parts of one stretch between two instants.
const MOST_PARTS: f64 = 4096.0;

/// Times the slowest time constant after which nothing is left of a rise.
const COLD: f64 = 50.0;

impl Course {
    /// Losses at the instants of a cycle of `duration` (s), in order of time.
    pub const fn new(points: Vec<Point>, duration: f64) -> Self {
        Self { points, duration }
    }

    /// The same with all torques in a proportion; other losses stay.
    #[must_use]
    pub fn scaled(&self, proportion: f64) -> Self {
        let point = |point: &Point| Point {
            root: proportion * point.root,
            ..*point
        };
        Self {
            points: self.points.iter().map(point).collect(),
            duration: self.duration,
        }
    }

    /// Mean losses.
    pub fn mean(&self) -> Losses {
        let mut sum = Losses::default();
        self.pieces(self.duration, |losses, time| {
            sum.copper += losses.copper * time;
            sum.other += losses.other * time;
        });
        Losses {
            copper: sum.copper / self.duration,
            other: sum.other / self.duration,
        }
    }

    /// The straight pieces of the cycle up to `until` (s): the points at their ends. The cycle closes from the last instant
    /// to its end with the last instant's losses, and begins with the first one's.
    fn stretches(&self, until: f64, mut take: impl FnMut(Point, Point)) {
        let Some((first, last)) = self.points.first().zip(self.points.last()) else {
            return;
        };
        let start = Point { t: 0.0, ..*first };
        let end = Point {
            t: self.duration,
            ..*last
        };
        let ends = self.points.iter().chain(std::iter::once(&end));
        let mut before = start;
        for point in ends {
            if point.t <= before.t {
                before = *point;
                continue;
            }
            if point.t >= until {
                let part = (until - before.t) / (point.t - before.t);
                if part > 0.0 {
                    take(
                        before,
                        Point {
                            t: until,
                            root: before.root + part * (point.root - before.root),
                            other: before.other + part * (point.other - before.other),
                        },
                    );
                }
                return;
            }
            take(before, *point);
            before = *point;
        }
    }

    /// The same with the mean losses of each piece and its length (s).
    fn pieces(&self, until: f64, mut take: impl FnMut(Losses, f64)) {
        self.stretches(until, |a, b| take(between(a, b), b.t - a.t));
    }

    /// Pieces so short that their losses can be taken as constant.
    fn parts(&self, network: &Network, until: f64, mut take: impl FnMut(Losses, f64)) {
        let longest = PART * network.fastest();
        self.stretches(until, |a, b| {
            let time = b.t - a.t;
            let changes = differ(a.root.abs(), b.root.abs()) || differ(a.other, b.other);
            let parts = if changes {
                (time / longest).ceil().clamp(1.0, MOST_PARTS)
            } else {
                1.0
            };
            let at = |k: f64| Point {
                t: a.t + time * k / parts,
                root: a.root + (b.root - a.root) * k / parts,
                other: a.other + (b.other - a.other) * k / parts,
            };
            let mut k = 0.0;
            while k < parts {
                take(between(at(k), at(k + 1.0)), time / parts);
                k += 1.0;
            }
        });
    }

    /// Change of the rises by the cycle up to `until` (s).
    pub fn change(&self, network: &Network, until: f64) -> Change {
        let mut change = Change::default();
        self.parts(network, until, |losses, time| {
            change = change.then(&network.change(losses, time));
        });
        change
    }

    /// The hottest rises of the cycle up to `until` (s), from these on, and those at its end.
    pub fn follow(&self, network: &Network, from: Rise, until: f64) -> (Rise, Rise) {
        let (mut now, mut hottest) = (from, from);
        self.parts(network, until, |losses, time| {
            let next = network.change(losses, time).of(now);
            let there = network.hottest(losses, time, now, next);
            hottest = most(hottest, there);
            now = next;
        });
        (hottest, now)
    }

    /// The rises over one periodic cycle, at the ends of its pieces: time (s), winding, housing (K). `None`: runaway.
    pub fn periodic(&self, network: &Network) -> Option<Vec<(f64, Rise)>> {
        let mut now = self.change(network, self.duration).periodic()?;
        let mut t = 0.0;
        let mut course = vec![(t, now)];
        self.parts(network, self.duration, |losses, time| {
            now = network.change(losses, time).of(now);
            t += time;
            course.push((t, now));
        });
        Some(course)
    }

    /// The hottest rises in an operation.
    pub fn hottest(&self, network: &Network, operation: &Operation, rest: Losses) -> Hottest {
        let hottest = match *operation {
            Operation::Continuous => {
                let start = self.change(network, self.duration).periodic();
                start.map(|start| self.follow(network, start, self.duration).0)
            }
            Operation::Short { operating } => {
                let (hottest, end) = self.operating(network, [0.0; 2], operating);
                // While all cools down the housing may still warm up.
                let cold = COLD * network.slowest();
                Some(after(network, Losses::default(), cold, end, hottest))
            }
            Operation::Intermittent {
                operating,
                rest: pause,
                ..
            } => {
                let (cycles, left) = self.cycles(operating);
                let running = self
                    .change(network, self.duration)
                    .repeated(cycles)
                    .then(&self.change(network, left));
                let period = running.then(&network.change(rest, pause));
                let start = period.periodic();
                start.map(|start| {
                    let (hottest, end) = self.operating(network, start, operating);
                    after(network, rest, pause, end, hottest)
                })
            }
        };
        match hottest.filter(|rise| rise.iter().all(|x| x.is_finite())) {
            Some(rise) => Hottest::Rise(rise),
            None => Hottest::Runaway,
        }
    }

    /// Whole cycles in an operating time (s), and what is left of it.
    fn cycles(&self, operating: f64) -> (u64, f64) {
        let cycles = (operating / self.duration * (1.0 + 1e-12)).floor();
        let left = (operating - cycles * self.duration).max(0.0);
        (cycles as u64, left)
    }

    /// The hottest rises of an operating time, and those at its end. From cycle to cycle a rise nears its periodic course with two exponentials of
    /// which the slower does not change its sign, so the hottest cycle is the first one or the last.
    fn operating(&self, network: &Network, start: Rise, operating: f64) -> (Rise, Rise) {
        let (cycles, left) = self.cycles(operating);
        let mut now = start;
        let mut hottest = start;
        if cycles > 0 {
            hottest = most(hottest, self.follow(network, now, self.duration).0);
            let cycle = self.change(network, self.duration);
            now = cycle.repeated(cycles - 1).of(now);
            let (last, end) = self.follow(network, now, self.duration);
            hottest = most(hottest, last);
            now = end;
        }
        let (last, end) = self.follow(network, now, left);
        (most(hottest, last), end)
    }
}

/// The hottest rises, a rest of `pause` (s) after `end` included.
fn after(network: &Network, rest: Losses, pause: f64, end: Rise, hottest: Rise) -> Rise {
    let rested = network.change(rest, pause).of(end);
    most(hottest, network.hottest(rest, pause, end, rested))
}

fn most(a: Rise, b: Rise) -> Rise {
    [a[0].max(b[0]), a[1].max(b[1])]
}

/// The mean losses between two points.
fn between(a: Point, b: Point) -> Losses {
    Losses {
        copper: (a.root * a.root + a.root * b.root + b.root * b.root) / 3.0,
        other: 0.5 * (a.other + b.other),
    }
}

fn differ(a: f64, b: f64) -> bool {
    (a - b).abs() > 1e-9 * a.abs().max(b.abs())
}
