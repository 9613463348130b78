//! A motion that was made, over the time: for drives (profile, cam table) and for `jred size`, which reads the profile as a motion.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred::machine::motion::State;
use jred_machine::model::coordinate::Coordinate;

/// The drive link at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Time (s).
    pub t: f64,
    /// Time since the node before (s), of the first node 0: after a long motion `t` has too few digits for a short step.
    pub step: f64,
    /// Position (rad, or m).
    pub phi: f64,
    /// Speed (rad/s, or m/s).
    pub omega: f64,
    /// Acceleration before and after the instant (rad/s², or m/s²).
    pub alpha: [f64; 2],
}

/// What two speeds may differ by in the last digits, as a share of them.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Node {
    /// The state at a share u of the step from the node before:
    ///
    /// ```text
    /// v(u) = v₀ + a₀·u + ½·(a₁ − a₀)·u² + e·(3u² − 2u³)
    /// ```
    ///
    /// with a₀ and a₁ the accelerations times the step, and e what their mean misses of the change of the speed. Where e is rounding, as in
    /// a step that changes the speed by a few of its last digits, it is no acceleration.
    pub fn after(&self, before: &Self, u: f64) -> State<f64> {
        let step = self.step;
        let [a0, a1] = [before.alpha[1] * step, self.alpha[0] * step];
        let bend = a1 - a0;
        let missed = self.omega - before.omega - 0.5 * (a0 + a1);
        let largest = self.omega.abs().max(before.omega.abs());
        let felt = if missed.abs() > ROUNDING * largest {
            missed
        } else {
            0.0
        };
        let way = |u: f64| {
            let cubic = missed * u * u * (1.0 - 0.5 * u);
            step * u * (before.omega + u * (0.5 * a0 + u * bend / 6.0) + cubic)
        };
        // What its integral misses, with ends that have neither slope nor curvature.
        let rest = (self.phi - before.phi) - way(1.0);
        let share = u * u * u * (10.0 - u * (15.0 - 6.0 * u));
        State {
            phi: before.phi + way(u) + rest * share,
            omega: before.omega + u * (a0 + u * (0.5 * bend + missed * (3.0 - 2.0 * u))),
            alpha: (a0 + u * (bend + felt * 6.0 * (1.0 - u))) / step,
        }
    }
}

/// A motion through nodes: between two of them the speed is the cubic through both speeds and accelerations, the position the quintic
/// that has positions as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Whether the drive link turns or slides.
    pub coordinate: Coordinate,
    nodes: Vec<Node>,
}

impl Trace {
    /// At rest at a position, at t = 0.
    pub fn from_rest(coordinate: Coordinate, phi: f64) -> Self {
        Self {
            coordinate,
            nodes: vec![Node {
                t: 0.0,
                step: 0.0,
                phi,
                omega: 0.0,
                alpha: [0.0; 2],
            }],
        }
    }

    /// Through nodes in the order of their times, the first at t = 0.
    pub const fn new(coordinate: Coordinate, nodes: Vec<Node>) -> Self {
        Self { coordinate, nodes }
    }

    /// The nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Length (s).
    pub fn duration(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node.t)
    }

    /// Goes on with another motion, whose first node lies where this one ends.
    pub fn then(&mut self, next: &[Node]) {
        let Some(end) = self.nodes.pop() else {
            self.nodes.extend_from_slice(next);
            return;
        };
        for (k, node) in next.iter().enumerate() {
            let (step, before) = if k == 0 {
                (end.step, end.alpha[0])
            } else {
                (node.step, node.alpha[0])
            };
            self.nodes.push(Node {
                t: end.t + node.t,
                step,
                alpha: [before, node.alpha[1]],
                ..*node
            });
        }
    }

    /// Goes on at rest.
    pub fn dwell(&mut self, duration: f64) {
        let Some(end) = self.nodes.last_mut() else {
            return;
        };
        end.alpha[1] = 0.0;
        let after = Node {
            t: end.t + duration,
            step: duration,
            alpha: [0.0; 2],
            ..*end
        };
        self.nodes.push(after);
    }

    /// The state at a time (s), clamped to the motion; where the acceleration jumps, the one after.
    pub fn at(&self, t: f64) -> State<f64> {
        let next = self.nodes.partition_point(|node| node.t <= t);
        let (Some(a), b) = (self.nodes.get(next.saturating_sub(1)), self.nodes.get(next)) else {
            return State::default();
        };
        match b.filter(|b| next > 0 && b.step > 0.0) {
            Some(b) => b.after(a, ((t - a.t) / b.step).clamp(0.0, 1.0)),
            None => State {
                phi: a.phi,
                omega: a.omega,
                alpha: a.alpha[usize::from(next > 0)],
            },
        }
    }

    /// The way (rad, or m) between the nodes around a time, at its end those before: its sign is the direction, 0 where the machine stands.
    pub fn heading(&self, t: f64) -> f64 {
        let next = self.nodes.partition_point(|node| node.t <= t);
        let next = next.clamp(1, self.nodes.len().max(2) - 1);
        match (self.nodes.get(next - 1), self.nodes.get(next)) {
            (Some(a), Some(b)) => b.phi - a.phi,
            _ => 0.0,
        }
    }

    /// Equal times over the motion, both ends included.
    fn rows(&self, count: usize) -> impl Iterator<Item = (f64, State<f64>)> {
        let (end, last) = (self.duration(), count.max(2) - 1);
        (0..=last).map(move |k| {
            let t = end * k as f64 / last as f64;
            (t, self.at(t))
        })
    }

    /// Positions over equal times, which `[motion] type = "profile"` reads.
    pub fn profile(&self, rows: usize) -> String {
        let (name, unit) = match self.coordinate {
            Coordinate::Angle => ("phi", "rad"),
            Coordinate::Length => ("s", "m"),
        };
        let mut text = format!("t [s],{name} [{unit}]\n");
        for (t, state) in self.rows(rows) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{t},{}", state.phi);
        }
        text
    }

    /// An electronic cam's table: positions over a master that turns once, evenly, in the length of the motion; with the first and second
    /// derivative by the master's angle (rad).
    pub fn cam(&self, rows: usize) -> String {
        let symbol = self.coordinate.symbol();
        let symbol = if symbol == "φ" { "phi" } else { symbol };
        let unit = self.coordinate.unit();
        let per = match self.coordinate {
            Coordinate::Angle => ["1", "1/rad"],
            Coordinate::Length => ["mm/rad", "mm/rad^2"],
        };
        let mut text = format!(
            "master [deg],{symbol} [{unit}],{symbol}' [{}],{symbol}'' [{}]\n",
            per[0], per[1]
        );
        let speed = TAU / self.duration();
        let shown = |value: f64| match self.coordinate {
            Coordinate::Angle => value,
            Coordinate::Length => value * 1e3,
        };
        for (t, state) in self.rows(rows) {
            let _ = writeln!(
                text,
                "{},{},{},{}",
                (t * speed).to_degrees(),
                self.coordinate.shown(state.phi),
                shown(state.omega / speed),
                shown(state.alpha / (speed * speed))
            );
        }
        text
    }
}
