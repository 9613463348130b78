//! A part of a motion that is kept unchanged.

use jred::machine::motion::{End, Polynomial, State};
use jred_file::model::motion::{Motion, Node, Phase, Steady};

/// Share of a part by which its ends are evaluated further inside, because the acceleration may jump there.
pub(crate) const INSIDE: f64 = 1e-9;

/// Steps into which a kept part is divided at first, and most halvings of each.
const STEPS: u32 = 16;
const HALVINGS: u32 = 10;

/// Allowed error in the middle of a step: of the position as a share of the path, of the speed as a share of the largest speed.
const STEP_ERROR: f64 = 1e-9;

/// A part of a motion, with position, speed and acceleration over time.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptMotion {
    /// Index of its segment in the file, from 0.
    pub segment: usize,
    /// Start position (rad, or m of the drive link).
    pub from: f64,
    /// End position.
    pub to: f64,
    /// Duration (s).
    pub duration: f64,
    /// Its speed (rad/s, or m/s) with sign; of the tool if that is prescribed.
    pub speed: f64,
    course: Vec<Node>,
}

impl KeptMotion {
    /// The part of a motion between two times (s). `further` (rad, or m) is added to the positions, for a later cycle.
    pub(super) fn new(
        motion: &Motion,
        steady: &Steady,
        [from, to]: [f64; 2],
        further: f64,
    ) -> Self {
        let duration = to - from;
        let state = |share: f64| {
            let t = from + duration * share;
            let inside = from + duration * share.clamp(INSIDE, 1.0 - INSIDE);
            let State { phi, omega, .. } = motion.at(t);
            let within = motion.at(inside);
            // The next part may begin with another speed: at the end the value of this part counts.
            let omega = if share >= 1.0 { within.omega } else { omega };
            State {
                phi: phi + further,
                omega,
                alpha: within.alpha,
            }
        };
        let [first, last] = [0.0, 1.0].map(state);
        let node = |share: f64, step: f64, state: State<f64>| Node {
            t: duration * share,
            step,
            phi: state.phi,
            omega: state.omega,
            alpha: [state.alpha; 2],
        };
        let way = (last.phi - first.phi).abs();
        let follows = |[a, b]: [f64; 2]| {
            let [start, end] = [a, b].map(|share| node(share, duration * (b - a), state(share)));
            let (found, exact) = (end.after(&start, 0.5), state(a.midpoint(b)));
            (found.phi - exact.phi).abs() <= STEP_ERROR * way
                && (found.omega - exact.omega).abs() <= STEP_ERROR * exact.omega.abs()
        };
        let mut course = vec![node(0.0, 0.0, first)];
        let even = |k: u32| f64::from(k) / f64::from(STEPS);
        let mut open: Vec<([f64; 2], u32)> = (0..STEPS)
            .rev()
            .map(|k| ([even(k), even(k + 1)], 0))
            .collect();
        // One step is enough where the drive link itself runs at constant speed.
        if follows([0.0, 1.0]) && follows([0.0, 0.3]) {
            open = vec![([0.0, 1.0], 0)];
        }
        while let Some(([a, b], depth)) = open.pop() {
            if depth < HALVINGS && !follows([a, b]) {
                let middle = a.midpoint(b);
                open.extend([([middle, b], depth + 1), ([a, middle], depth + 1)]);
            } else {
                course.push(node(b, duration * (b - a), state(b)));
            }
        }
        Self {
            segment: steady.segment,
            from: first.phi,
            to: last.phi,
            duration,
            speed: steady.speed,
            course,
        }
    }

    /// Its nodes, from t = 0.
    pub fn nodes(&self) -> &[Node] {
        &self.course
    }

    /// Speed and acceleration of the drive link at its start and at its end.
    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        [self.course.first(), self.course.last()]
            .map(|node| node.map_or([0.0; 2], |node| [node.omega, node.alpha[0]]))
    }

    /// The part as successive polynomials.
    pub fn phases(&self) -> Vec<Phase> {
        let phase = |pair: &[Node]| {
            let [a, b] = [&pair[0], &pair[1]];
            let end = |node: &Node| End::new(node.omega, node.alpha[0]);
            Phase {
                duration: b.step,
                polynomial: Polynomial::between(b.phi - a.phi, b.step, end(a), end(b)),
            }
        };
        self.course.windows(2).map(phase).collect()
    }
}
