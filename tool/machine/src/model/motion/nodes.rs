//! A motion through nodes, each with position, speed and acceleration: what a computed motion is written as, exactly.

use jred::machine::motion::State;

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

/// What two speeds may differ by in the last digits, as a share of them: those of a sweep through short cells by some forty roundings. And two times.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
const OF_TIME: f64 = 16.0 * f64::EPSILON;

/// Share of the largest acceleration by which it may differ before and after a node: rounding.
const CONTINUOUS: f64 = 1e-6;

/// The step between two nodes over its share u:
///
/// ```text
/// v(u) = v₀ + a₀·u + ½·(a₁ − a₀)·u² + e·(3u² − 2u³)
/// ```
///
/// with a₀ and a₁ the accelerations times the step, and e what their mean misses of the change of the speed.
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

    /// e as an acceleration has it: where it is rounding, as in a step that changes the speed by a few of its last digits, it is none.
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

    /// What the positions differ by beyond that.
    fn rest(&self) -> f64 {
        (self.after.phi - self.before.phi) - self.way(1.0)
    }
}

impl Node {
    /// The state at a share of the step from the node before: the speed is the cubic through both speeds and accelerations, the position the
    /// quintic that has positions as well.
    pub fn after(&self, before: &Self, u: f64) -> State<f64> {
        let step = Step::between(before, self);
        let Step {
            first,
            bend,
            missed,
            ..
        } = step;
        // What is left of the position has neither slope nor curvature at the ends.
        let share = u * u * u * (10.0 - u * (15.0 - 6.0 * u));
        State {
            phi: before.phi + step.way(u) + step.rest() * share,
            omega: before.omega + u * (first + u * (0.5 * bend + missed * (3.0 - 2.0 * u))),
            alpha: (first + u * (bend + step.felt() * 6.0 * (1.0 - u))) / self.step,
        }
    }

    /// The jerk (rad/s³, or m/s³) at a share of the step from the node before.
    pub fn jerk_after(&self, before: &Self, u: f64) -> f64 {
        let step = Step::between(before, self);
        (step.bend + step.felt() * 6.0 * (1.0 - 2.0 * u)) / (self.step * self.step)
    }

    /// What the step from the node before misses: of the position (rad, or m), and of the speed (rad/s, or m/s).
    pub fn missed_since(&self, before: &Self) -> [f64; 2] {
        let step = Step::between(before, self);
        [step.rest(), step.missed]
    }

    fn rests(&self, before: &Self) -> bool {
        before.omega == 0.0 && self.omega == 0.0 && self.phi.total_cmp(&before.phi).is_eq()
    }
}

/// The step at a time (s): its nodes and the share of it; at the end the last one. None of fewer than two nodes.
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

/// Nodes cut where the acceleration jumps and where a rest begins or ends; the node of a cut belongs to both sides.
pub(super) fn runs(nodes: &[Node]) -> Vec<&[Node]> {
    let largest = nodes.iter().flat_map(|node| node.alpha);
    let largest = largest.fold(0.0_f64, |most, alpha| most.max(alpha.abs()));
    let mut runs = Vec::new();
    let mut first = 0;
    for (k, three) in nodes.windows(3).enumerate() {
        let [before, node, after] = [&three[0], &three[1], &three[2]];
        let jumps = (node.alpha[1] - node.alpha[0]).abs() > CONTINUOUS * largest;
        if jumps || node.rests(before) != after.rests(node) {
            runs.push(&nodes[first..=k + 1]);
            first = k + 1;
        }
    }
    runs.push(&nodes[first..]);
    runs
}
