//! A motion through nodes, each with position, speed and acceleration: the exact form of a computed motion.

use jred::machine::motion::State;

use super::STANDSTILL;

/// The drive link at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Time (s).
    pub t: f64,
    /// Time since the previous node (s), 0 for the first node: after a long motion `t` has too few digits for a short step.
    pub step: f64,
    /// Position (rad, or m).
    pub phi: f64,
    /// Speed (rad/s, or m/s).
    pub omega: f64,
    /// Acceleration before and after the instant (rad/s², or m/s²).
    pub alpha: [f64; 2],
}

/// The curve between two nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeCurve {
    /// The speed is the cubic through speeds and accelerations: of a computed or recorded motion, whose positions may be rounded.
    Speeds,
    /// The position is the quintic through positions, speeds and accelerations, and the speed its derivative: of an electronic cam.
    Positions,
}

impl NodeCurve {
    /// Parts between two nodes, in each of which the motion turns back at most once, except for rounding: the points of a cam may be few.
    pub(super) const fn turns(self) -> u32 {
        match self {
            Self::Speeds => 4,
            Self::Positions => 16,
        }
    }
}

/// Relative difference of two speeds that is rounding: a sweep through short cells accumulates some forty rounding errors. And of two times.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
const OF_TIME: f64 = 16.0 * f64::EPSILON;

/// Share of the largest acceleration below which a jump at a node is rounding.
const CONTINUOUS: f64 = 1e-6;

/// Share of the range of the positions below which two positions are equal: rounding.
const PLACE: f64 = 1e-9;

/// The step between two nodes over its share u:
///
/// ```text
/// v(u) = v₀ + a₀·u + ½·(a₁ − a₀)·u² + e·(3u² − 2u³)
/// ```
///
/// with a₀ and a₁ the accelerations times the step, and e the difference of the change of speed and their mean.
struct Step<'n> {
    before: &'n Node,
    after: &'n Node,
    /// a₀ and a₁ − a₀ (rad/s).
    first: f64,
    bend: f64,
    /// e (rad/s).
    missed: f64,
}

impl<'n> Step<'n> {
    fn between(before: &'n Node, after: &'n Node) -> Self {
        let [a0, a1] = [before.alpha[1] * after.step, after.alpha[0] * after.step];
        Self {
            before,
            after,
            first: a0,
            bend: a1 - a0,
            missed: after.omega - before.omega - 0.5 * (a0 + a1),
        }
    }

    /// e for the acceleration; zero if it is rounding, as in a step that changes the speed by a few of its last digits.
    fn felt(&self) -> f64 {
        let Self { before, after, .. } = self;
        let speed = after.omega.abs().max(before.omega.abs());
        let acceleration = after.alpha[0].abs().max(before.alpha[1].abs());
        let rounding = ROUNDING * speed + OF_TIME * acceleration * after.t;
        if self.missed.abs() > rounding {
            self.missed
        } else {
            0.0
        }
    }

    /// ∫v dt.
    fn way(&self, u: f64) -> f64 {
        let curved = 0.5 * self.first + u * (self.bend / 6.0 + self.missed * (1.0 - 0.5 * u));
        self.after.step * u * (self.before.omega + u * curved)
    }

    /// Remaining difference of the positions.
    fn rest(&self) -> f64 {
        (self.after.phi - self.before.phi) - self.way(1.0)
    }
}

impl Node {
    /// The state at a share of the step from the node before: the speed is the cubic through both speeds and accelerations, the position the quintic
    /// through the positions as well.
    pub fn after(&self, before: &Self, u: f64) -> State<f64> {
        let step = Step::between(before, self);
        let Step {
            first,
            bend,
            missed,
            ..
        } = step;
        // The remainder of the position has neither slope nor curvature at the ends.
        let share = u * u * u * (10.0 - u * (15.0 - 6.0 * u));
        State {
            phi: before.phi + step.way(u) + step.rest() * share,
            omega: before.omega + u * (first + u * (0.5 * bend + missed * (3.0 - 2.0 * u))),
            alpha: (first + u * (bend + step.felt() * 6.0 * (1.0 - u))) / self.step,
        }
    }

    /// The same with this curve; in the half closer to this node the speed is computed backwards from here, so that just before a stop its sign is
    /// that of the motion and not of rounding.
    pub fn at_share(&self, before: &Self, u: f64, curve: NodeCurve) -> State<f64> {
        let mut state = self.after(before, u);
        if u <= 0.5 && curve == NodeCurve::Speeds {
            return state;
        }
        let step = Step::between(before, self);
        let back = 1.0 - u;
        if u > 0.5 {
            let curved = 0.5 * step.bend - step.missed * (3.0 - 2.0 * back);
            state.omega = self.omega - back * (self.alpha[0] * self.step - back * curved);
        }
        if curve == NodeCurve::Positions {
            let [by_step, rest] = [1.0 / self.step, step.rest()];
            state.omega += rest * by_step * 30.0 * (u * back).powi(2);
            state.alpha += rest * by_step * by_step * 60.0 * u * back * (back - u);
        }
        state
    }

    /// The jerk (rad/s³, or m/s³) at a share of the step from the node before.
    pub fn jerk_after(&self, before: &Self, u: f64) -> f64 {
        let step = Step::between(before, self);
        (step.bend + step.felt() * 6.0 * (1.0 - 2.0 * u)) / (self.step * self.step)
    }

    /// The same with this curve.
    pub fn jerk_at_share(&self, before: &Self, u: f64, curve: NodeCurve) -> f64 {
        let rest = match curve {
            NodeCurve::Speeds => 0.0,
            NodeCurve::Positions => Step::between(before, self).rest(),
        };
        self.jerk_after(before, u) + rest * 60.0 * (1.0 - 6.0 * u * (1.0 - u)) / self.step.powi(3)
    }

    /// Errors of the step from the node before: of the position (rad, or m), and of the speed (rad/s, or m/s).
    pub fn missed_since(&self, before: &Self) -> [f64; 2] {
        let step = Step::between(before, self);
        [step.rest(), step.missed]
    }
}

/// The step at a time (s): its nodes and the share of it; at the end the last step. `None` for fewer than two nodes.
pub fn step_at(nodes: &[Node], t: f64) -> Option<([&Node; 2], f64)> {
    let next = nodes.partition_point(|node| node.t <= t);
    let next = next.clamp(1, nodes.len().max(2) - 1);
    let [before, after] = [nodes.get(next - 1)?, nodes.get(next)?];
    let share = if after.step > 0.0 {
        ((t - before.t) / after.step).clamp(0.0, 1.0)
    } else {
        1.0
    };
    Some(([before, after], share))
}

/// Thresholds for rest in a motion.
struct Standstill {
    /// Largest speed (rad/s, or m/s) and acceleration (rad/s², or m/s²).
    speed: f64,
    acceleration: f64,
    /// Distance (rad, or m) within which two positions are equal.
    place: f64,
}

impl Standstill {
    fn of(nodes: &[Node]) -> Self {
        let largest = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let start = nodes.first().map_or(0.0, |node| node.phi);
        Self {
            speed: STANDSTILL * largest(&mut nodes.iter().map(|node| node.omega)),
            acceleration: CONTINUOUS * largest(&mut nodes.iter().flat_map(|node| node.alpha)),
            place: PLACE * largest(&mut nodes.iter().map(|node| node.phi - start)),
        }
    }

    /// Whether the motion rests between two nodes: speeds, travel and accelerations are rounding.
    fn between(&self, before: &Node, after: &Node) -> bool {
        let accelerations = [before.alpha[1], after.alpha[0]].map(f64::abs);
        let way = (after.phi - before.phi).abs();
        before.omega.abs() <= self.speed
            && after.omega.abs() <= self.speed
            && way <= self.speed * after.step + self.place
            && accelerations
                .into_iter()
                .all(|a| a <= self.acceleration && a * after.step <= self.speed)
    }

    /// The nodes of a pause, at rest at the position of the first one, except for a drift above rounding.
    fn settled(&self, pause: &[Node]) -> Vec<Node> {
        let mut at = pause.first().map_or(0.0, |node| node.phi);
        let settled = pause.iter().map(|node| {
            if (node.phi - at).abs() > self.place {
                at = node.phi;
            }
            Node {
                phi: at,
                omega: 0.0,
                alpha: [0.0; 2],
                ..*node
            }
        });
        settled.collect()
    }
}

/// Nodes cut where the acceleration jumps and where a pause begins or ends; the node of a cut belongs to both sides. Nodes of a pause are exactly at
/// rest, so that friction does not treat rounding of the speed as motion.
pub(super) fn runs(nodes: &[Node]) -> Vec<Vec<Node>> {
    let still = Standstill::of(nodes);
    let mut runs = Vec::new();
    let mut first = 0;
    let mut run = |first: usize, last: usize| {
        let run = &nodes[first..=last];
        let stands = run.get(1).is_some_and(|next| still.between(&run[0], next));
        runs.push(if stands {
            still.settled(run)
        } else {
            run.to_vec()
        });
    };
    for (k, three) in nodes.windows(3).enumerate() {
        let [before, node, after] = [&three[0], &three[1], &three[2]];
        let jumps = (node.alpha[1] - node.alpha[0]).abs() > still.acceleration;
        if jumps || still.between(before, node) != still.between(node, after) {
            run(first, k + 1);
            first = k + 1;
        }
    }
    if let Some(last) = nodes.len().checked_sub(1) {
        run(first, last);
    }
    runs
}
