//! A part of a motion that is kept as it is.

use jred::machine::motion::{End, Polynomial, State};
use jred_machine::model::motion::{Motion, Node, Phase, Steady};

/// Share of a part by which its ends are looked at from inside: where the acceleration jumps it has the value of its own side.
pub(crate) const INSIDE: f64 = 1e-9;

/// Steps of a kept part, and how often each is halved at most.
const STEPS: u32 = 16;
const HALVINGS: u32 = 10;

/// Share of the way, and of the largest speed, by which a step may be off halfway.
const OFF: f64 = 1e-9;

/// A part of a motion with its course, position, speed and acceleration over its time.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Number of its segment in the file, from 0 on.
    pub segment: usize,
    /// Where it begins (rad, or m of the drive link).
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// How long it takes (s).
    pub duration: f64,
    /// Its speed (rad/s, or m/s), of the tool if that is prescribed, with its sign.
    pub speed: f64,
    course: Vec<Node>,
}

impl Kept {
    /// The stretch of a motion between two times (s), `further` on (rad, or m) than there.
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
            // Where the next piece begins with another speed, the end is this one's.
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
            (found.phi - exact.phi).abs() <= OFF * way
                && (found.omega - exact.omega).abs() <= OFF * exact.omega.abs()
        };
        let mut course = vec![node(0.0, 0.0, first)];
        let even = |k: u32| f64::from(k) / f64::from(STEPS);
        let mut open: Vec<([f64; 2], u32)> = (0..STEPS)
            .rev()
            .map(|k| ([even(k), even(k + 1)], 0))
            .collect();
        // One step will do where the drive link itself goes evenly.
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

    /// Its nodes, from t = 0 on.
    pub fn nodes(&self) -> &[Node] {
        &self.course
    }

    /// Speed and acceleration of the drive link at its start and at its end.
    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        [self.course.first(), self.course.last()]
            .map(|node| node.map_or([0.0; 2], |node| [node.omega, node.alpha[0]]))
    }

    /// It as polynomials one after another.
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
