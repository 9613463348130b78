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
    /// Position (rad, or m).
    pub phi: f64,
    /// Speed (rad/s, or m/s).
    pub omega: f64,
    /// Acceleration before and after the instant (rad/s², or m/s²).
    pub alpha: [f64; 2],
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
            let before = if k == 0 { end.alpha[0] } else { node.alpha[0] };
            self.nodes.push(Node {
                t: end.t + node.t,
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
        let b = b.unwrap_or(a);
        let step = b.t - a.t;
        if next == 0 || step <= 0.0 {
            let alpha = a.alpha[usize::from(next > 0)];
            return State {
                phi: a.phi,
                omega: a.omega,
                alpha,
            };
        }
        let u = (t - a.t) / step;
        let [a0, a1] = [a.alpha[1] * step, b.alpha[0] * step];
        // v(u) = v₀ + a₀·u + c·u² + d·u³
        let rise = b.omega - a.omega;
        let (c, d) = (3.0 * rise - 2.0 * a0 - a1, a0 + a1 - 2.0 * rise);
        let way = step * u * (a.omega + u * (0.5 * a0 + u * (c / 3.0 + u * d / 4.0)));
        let whole = step * (a.omega + 0.5 * a0 + c / 3.0 + d / 4.0);
        // What its integral misses, with ends that have neither slope nor curvature.
        let missed = (b.phi - a.phi) - whole;
        let share = u * u * u * (10.0 - u * (15.0 - 6.0 * u));
        State {
            phi: a.phi + way + missed * share,
            omega: a.omega + u * (a0 + u * (c + u * d)),
            alpha: (a0 + u * (2.0 * c + 3.0 * u * d)) / step,
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
