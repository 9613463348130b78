//! A finished motion over time, for drives (profile, cam table) and for `jred size`, which reads the profile as a motion.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred::machine::motion::State;
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::motion::step_at;
use jred_file::number::rounding::position;

pub use jred_file::model::motion::Node;

jred_file::words! {
    /// The unit of an electronic cam's master.
    pub enum Master default Degree {
        /// A turn is 360.
        Degree = "deg",
        /// A turn is 2π.
        Radian = "rad",
        /// A turn is 1.
        Turn = "turn",
    }
}

impl Master {
    /// A turn in this unit.
    const fn turn(self) -> f64 {
        match self {
            Self::Degree => 360.0,
            Self::Radian => TAU,
            Self::Turn => 1.0,
        }
    }
}

/// A motion through nodes. Between two nodes the speed is the cubic through both speeds and accelerations, the position the quintic through the
/// positions as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Whether positions are angles or lengths.
    pub coordinate: Coordinate,
    nodes: Vec<Node>,
}

/// Share of the largest speed that counts as rest, and of the largest acceleration that is no jump: searches end with less.
const NONE: f64 = 1e-3;

impl Trace {
    /// A motion that starts at rest at a position, at t = 0.
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

    /// A motion through nodes in the order of their times, the first at t = 0.
    pub const fn new(coordinate: Coordinate, nodes: Vec<Node>) -> Self {
        Self { coordinate, nodes }
    }

    /// The same motion in the coordinate of an axis.
    #[must_use]
    pub fn of_axis(&self, axis: &Axis) -> Self {
        let node = |node: &Node| {
            let state = |alpha: f64| {
                axis.state(&State {
                    phi: node.phi,
                    omega: node.omega,
                    alpha,
                })
            };
            let [before, after] = node.alpha.map(state);
            Node {
                phi: before.phi,
                omega: before.omega,
                alpha: [before.alpha, after.alpha],
                ..*node
            }
        };
        Self {
            coordinate: axis.coordinate,
            nodes: self.nodes.iter().map(node).collect(),
        }
    }

    /// The nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The steps that take time, each as the nodes before and after it.
    pub(crate) fn steps(&self) -> impl Iterator<Item = [&Node; 2]> {
        let pairs = self.nodes.windows(2).map(|pair| [&pair[0], &pair[1]]);
        pairs.filter(|[_, after]| after.step > 0.0)
    }

    /// Duration (s).
    pub fn duration(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node.t)
    }

    /// Appends another motion, whose first node lies where this one ends. A pause ends where it began, to the last digit.
    pub fn then(&mut self, next: &[Node]) {
        let pauses = matches!(self.nodes.as_slice(), [.., before, end] if stays(before, end) && before.omega == 0.0);
        let Some(end) = self.nodes.pop() else {
            self.nodes.extend_from_slice(next);
            return;
        };
        let mut still = pauses;
        for (k, node) in next.iter().enumerate() {
            let (step, before) = if k == 0 {
                (end.step, end.alpha[0])
            } else {
                still = still && stays(&next[k - 1], node);
                (node.step, node.alpha[0])
            };
            let place = if still { end } else { *node };
            self.push(Node {
                t: end.t + node.t,
                step,
                alpha: [before, node.alpha[1]],
                ..place
            });
        }
    }

    /// Appends a node. A remaining speed at a stop is rounding; it is set to zero, because friction would otherwise have its direction throughout the
    /// pause.
    fn push(&mut self, node: Node) {
        if let Some(before) = self.nodes.last_mut().filter(|before| stays(before, &node)) {
            before.omega = 0.0;
        }
        self.nodes.push(node);
    }

    /// Appends a pause.
    pub fn dwell(&mut self, duration: f64) {
        let Some(end) = self.nodes.last_mut() else {
            return;
        };
        end.alpha[1] = 0.0;
        let after = Node {
            t: end.t + duration,
            step: duration,
            omega: 0.0,
            alpha: [0.0; 2],
            ..*end
        };
        self.push(after);
    }

    /// The state at a time (s), clamped to the motion; where the acceleration jumps, the later one.
    pub fn at(&self, t: f64) -> State<f64> {
        match (step_at(&self.nodes, t), self.nodes.last()) {
            (Some(([before, after], share)), Some(last)) if t < last.t => {
                after.after(before, share)
            }
            (_, Some(last)) => State {
                phi: last.phi,
                omega: last.omega,
                alpha: last.alpha[1],
            },
            _ => State::default(),
        }
    }

    /// The node where the acceleration jumps most, and by how much (rad/s², or m/s²); none if it is continuous. A motion that begins in motion goes on
    /// from its end.
    pub fn largest_jump(&self) -> Option<(&Node, f64)> {
        let largest = |of: &dyn Fn(&Node) -> f64| self.nodes.iter().map(of).fold(0.0, f64::max);
        let speed = largest(&|node| node.omega.abs());
        let alpha = largest(&|node| node.alpha[0].abs().max(node.alpha[1].abs()));
        let ends = [self.nodes.first()?, self.nodes.last()?];
        let is_end = |node| ends.into_iter().any(|end| std::ptr::eq(end, node));
        let goes_on = |node: &Node| is_end(node) && node.omega.abs() > NONE * speed;
        let nodes = self.nodes.iter().filter(|node| !goes_on(node));
        nodes
            .map(|node| (node, (node.alpha[1] - node.alpha[0]).abs()))
            .filter(|(_, jump)| *jump > NONE * alpha)
            .max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Travel (rad, or m) between the nodes around a time, at the end between the last two. Its sign is the direction, 0 at rest.
    pub fn heading(&self, t: f64) -> f64 {
        step_at(&self.nodes, t).map_or(0.0, |([before, after], _)| after.phi - before.phi)
    }

    /// Rows at equal times over the motion, both ends included.
    fn rows(&self, count: usize) -> impl Iterator<Item = (f64, State<f64>)> {
        let (end, last) = (self.duration(), count.max(2) - 1);
        (0..=last).map(move |k| {
            let t = end * k as f64 / last as f64;
            (t, self.at(t))
        })
    }

    /// The nodes with positions, speeds and accelerations, which `[motion] type = "profile"` reads as this motion. Where the acceleration jumps there
    /// are two rows of the same time.
    pub fn profile(&self) -> String {
        let mut text = match self.coordinate {
            Coordinate::Angle => "t [s],phi [rad],omega [rad/s],alpha [rad/s^2]\n",
            Coordinate::Length => "t [s],s [m],v [m/s],a [m/s^2]\n",
        }
        .to_owned();
        let last = self.nodes.len().saturating_sub(1);
        let mut before = f64::NEG_INFINITY;
        for (k, node) in self.nodes.iter().enumerate() {
            // A step shorter than the last digit of the time is dropped.
            if node.t <= before && k < last {
                continue;
            }
            before = node.t;
            let Node {
                t,
                phi,
                omega,
                alpha,
                ..
            } = node;
            let [earlier, later] = *alpha;
            let mut row = |alpha: f64| {
                // Avoids -0. Writing to a string cannot fail.
                let [phi, omega, alpha] = [*phi, *omega, alpha].map(|value| value + 0.0);
                let _ = writeln!(text, "{t},{phi},{omega},{alpha}");
            };
            if k > 0 {
                row(earlier);
            }
            if k == 0 || k < last && earlier.total_cmp(&later).is_ne() {
                row(later);
            }
        }
        text
    }

    /// Rows of an electronic cam's table: positions over a master that turns once, evenly, in the duration of the motion, with the first and second
    /// derivative by the master. Units are those of `master` and of [`Coordinate::shown`]: a derivative is the limit of the differences of the first
    /// two columns.
    pub fn cam(&self, rows: usize, master: Master) -> Vec<[f64; 4]> {
        let turn = master.turn();
        let speed = turn / self.duration();
        let last = rows.max(2) - 1;
        let rows = self.rows(rows).enumerate().map(|(k, (_, state))| {
            let values = [
                state.phi,
                state.omega / speed,
                state.alpha / (speed * speed),
            ];
            // Avoids -0.
            let [place, first, second] = values.map(|value| self.coordinate.shown(value) + 0.0);
            [
                turn * k as f64 / last as f64,
                position(place),
                first,
                second,
            ]
        });
        rows.collect()
    }
}

/// Whether a motion rests from one node to the next.
fn stays(before: &Node, after: &Node) -> bool {
    let zeros = [before.alpha[1], after.alpha[0], after.omega];
    zeros.into_iter().all(|value| value == 0.0) && before.phi.total_cmp(&after.phi).is_eq()
}
