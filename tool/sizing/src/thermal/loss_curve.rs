//! The losses over a cycle, and the resulting temperatures.

use super::network::{Losses, Network, Rise, Transition};
use jred_file::model::operation::Operation;

/// The losses at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossSample {
    /// Time (s).
    pub t: f64,
    /// Root of the copper loss (√W) with the winding at ambient temperature, with the sign of the torque. It is proportional to the current, and
    /// linear from one instant to the next.
    pub root: f64,
    /// Other losses (W), linear from one instant to the next.
    pub other: f64,
}

/// The losses over one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct LossCurve {
    pieces: Vec<LossPiece>,
    duration: f64,
}

/// The losses over a piece of the cycle: parabolas c₀ + c₁·x + c₂·x² over the time as a share of the piece, −½ ≤ x ≤ ½.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossPiece {
    /// Its length (s).
    pub time: f64,
    /// Copper loss (W) with the winding at ambient temperature.
    pub copper: [f64; 3],
    /// Other losses (W).
    pub other: [f64; 3],
}

impl LossPiece {
    /// A piece from these moments ∫xᵏ·P dx of the copper loss and of the others, k = 0, 1, 2: its mean, slope and curvature are those of the losses.
    pub fn of_moments(time: f64, copper: [f64; 3], other: [f64; 3]) -> Self {
        let parabola = |[mean, first, second]: [f64; 3]| {
            let bend = 180.0 * (second - mean / 12.0);
            [mean - bend / 12.0, 12.0 * first, bend]
        };
        Self {
            time,
            copper: parabola(copper),
            other: parabola(other),
        }
    }

    /// The piece from one point to another.
    fn straight(a: LossSample, b: LossSample) -> Self {
        let [middle, step] = [0.5 * (a.root + b.root), b.root - a.root];
        Self {
            time: b.t - a.t,
            copper: [middle * middle, 2.0 * middle * step, step * step],
            other: [0.5 * (a.other + b.other), b.other - a.other, 0.0],
        }
    }

    /// The part between two shares of its time, from 0 to 1.
    fn between(&self, from: f64, to: f64) -> Self {
        let (middle, length) = (from.midpoint(to) - 0.5, to - from);
        let part = |[a, b, c]: [f64; 3]| {
            [
                a + middle * (b + middle * c),
                length * (b + 2.0 * middle * c),
                length * length * c,
            ]
        };
        Self {
            time: length * self.time,
            copper: part(self.copper),
            other: part(self.other),
        }
    }

    fn mean(&self) -> Losses {
        let mean = |[a, _, c]: [f64; 3]| a + c / 12.0;
        Losses {
            copper: mean(self.copper),
            other: mean(self.other),
        }
    }

    fn varies(&self) -> bool {
        let varies = |[a, b, c]: [f64; 3]| b.abs().max(c.abs()) > 1e-9 * a.abs();
        varies(self.copper) || varies(self.other)
    }

    /// Change of the rises by the piece. It uses constant losses over each half, whose means differ by two thirds of the slope. For varying losses
    /// the method is of fourth order in time (E. Celledoni, A. Marthinsen, B. Owren, Commutator-free Lie group methods, Future Generation Computer
    /// Systems 19 (2003) 341).
    fn change(&self, network: &Network) -> Transition {
        let mean = self.mean();
        if !self.varies() {
            return network.change(mean, self.time);
        }
        let half = |sign: f64| Losses {
            copper: mean.copper + sign / 3.0 * self.copper[1],
            other: mean.other + sign / 3.0 * self.other[1],
        };
        let [first, second] = [-1.0, 1.0].map(|sign| network.change(half(sign), 0.5 * self.time));
        first.then(&second)
    }
}

/// The hottest rises above the surroundings (K).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PeakRise {
    /// Of winding and housing; for a single body only the first.
    Rise(Rise),
    /// Unbounded: the copper loss grows faster with the temperature than the heat flow to the surroundings.
    Runaway,
}

/// Longest part of a piece of changing losses, as a share of the network's fastest time constant: the error falls with its fourth power.
pub(super) const PART: f64 = 0.02;

/// The most parts of one piece, or of one panel of the integrals.
pub(super) const MOST_PARTS: f64 = 4096.0;

/// Multiple of the slowest time constant after which a rise has vanished.
const DECAY_TIMES: f64 = 50.0;

impl LossCurve {
    /// Losses at the instants of a cycle of `duration` (s), in order of time. Before the first and after the last instant the losses are constant.
    pub fn new(points: &[LossSample], duration: f64) -> Self {
        let mut pieces = Vec::with_capacity(points.len() + 1);
        if let Some((first, last)) = points.first().zip(points.last()) {
            let end = LossSample {
                t: duration,
                ..*last
            };
            let mut before = LossSample { t: 0.0, ..*first };
            for point in points.iter().chain([&end]) {
                if point.t > before.t {
                    pieces.push(LossPiece::straight(before, *point));
                }
                before = *point;
            }
        }
        Self::of_pieces(pieces, duration)
    }

    /// A course of successive pieces.
    pub const fn of_pieces(pieces: Vec<LossPiece>, duration: f64) -> Self {
        Self { pieces, duration }
    }

    /// The same with all torques multiplied by a factor; other losses stay.
    #[must_use]
    pub fn scaled(&self, proportion: f64) -> Self {
        let square = proportion * proportion;
        let piece = |piece: &LossPiece| LossPiece {
            copper: piece.copper.map(|c| square * c),
            ..*piece
        };
        Self {
            pieces: self.pieces.iter().map(piece).collect(),
            duration: self.duration,
        }
    }

    /// Mean losses.
    pub fn mean(&self) -> Losses {
        let mut sum = Losses::default();
        self.up_to(self.duration, |piece| {
            let mean = piece.mean();
            sum.copper += mean.copper * piece.time;
            sum.other += mean.other * piece.time;
        });
        Losses {
            copper: sum.copper / self.duration,
            other: sum.other / self.duration,
        }
    }

    /// The pieces of the cycle up to `until` (s).
    fn up_to(&self, until: f64, mut take: impl FnMut(LossPiece)) {
        let mut t = 0.0;
        let last = self.pieces.len().saturating_sub(1);
        for (k, piece) in self.pieces.iter().enumerate() {
            let next = t + piece.time;
            // The sum of all pieces is the cycle, except for rounding.
            if next > until && !(k == last && until >= self.duration) {
                let share = (until - t) / piece.time;
                if share > 0.0 {
                    take(piece.between(0.0, share));
                }
                return;
            }
            take(*piece);
            t = next;
        }
    }

    /// Parts short enough for the method.
    fn parts(&self, network: &Network, until: f64, mut take: impl FnMut(LossPiece)) {
        let longest = PART * network.fastest();
        self.up_to(until, |piece| {
            let parts = if piece.varies() {
                (piece.time / longest).ceil().clamp(1.0, MOST_PARTS)
            } else {
                1.0
            };
            if parts <= 1.0 {
                take(piece);
                return;
            }
            let mut k = 0.0;
            while k < parts {
                take(piece.between(k / parts, (k + 1.0) / parts));
                k += 1.0;
            }
        });
    }

    /// Change of the rises by the cycle up to `until` (s).
    pub fn change(&self, network: &Network, until: f64) -> Transition {
        let mut change = Transition::default();
        self.parts(network, until, |piece| {
            change = change.then(&piece.change(network));
        });
        change
    }

    /// The hottest rises of the cycle up to `until` (s), starting from these, and the rises at its end.
    pub fn follow(&self, network: &Network, from: Rise, until: f64) -> (Rise, Rise) {
        let (mut now, mut hottest) = (from, from);
        self.parts(network, until, |piece| {
            let next = piece.change(network).of(now);
            let there = network.hottest(piece.mean(), piece.time, now, next);
            hottest = most(hottest, there);
            now = next;
        });
        (hottest, now)
    }

    /// The rises over one periodic cycle, at the ends of its pieces: time (s), winding, housing (K); `None`: runaway.
    pub fn periodic(&self, network: &Network) -> Option<Vec<(f64, Rise)>> {
        let mut now = self.change(network, self.duration).periodic()?;
        let mut t = 0.0;
        let mut course = vec![(t, now)];
        self.parts(network, self.duration, |piece| {
            now = piece.change(network).of(now);
            t += piece.time;
            course.push((t, now));
        });
        Some(course)
    }

    /// The hottest rises in an operation.
    pub fn hottest(&self, network: &Network, operation: &Operation, rest: Losses) -> PeakRise {
        let hottest = match *operation {
            Operation::Continuous => {
                let start = self.change(network, self.duration).periodic();
                start.map(|start| self.follow(network, start, self.duration).0)
            }
            Operation::Short { operating } => {
                let (hottest, end) = self.operating(network, [0.0; 2], operating);
                // While everything cools down, the housing may still warm up.
                let cold = DECAY_TIMES * network.slowest();
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
            Some(rise) => PeakRise::Rise(rise),
            None => PeakRise::Runaway,
        }
    }

    /// Number of whole cycles in an operating time (s), and the remaining time.
    fn cycles(&self, operating: f64) -> (u64, f64) {
        let cycles = (operating / self.duration * (1.0 + 1e-12)).floor();
        let left = (operating - cycles * self.duration).max(0.0);
        (cycles as u64, left)
    }

    /// The hottest rises of an operating time, and the rises at its end. From cycle to cycle a rise approaches its periodic course with two
    /// exponentials, of which the slower does not change its sign, so the hottest cycle is the first or the last.
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

/// The hottest rises, including a rest of `pause` (s) after `end`.
fn after(network: &Network, rest: Losses, pause: f64, end: Rise, hottest: Rise) -> Rise {
    let rested = network.change(rest, pause).of(end);
    most(hottest, network.hottest(rest, pause, end, rested))
}

fn most(a: Rise, b: Rise) -> Rise {
    [a[0].max(b[0]), a[1].max(b[1])]
}
