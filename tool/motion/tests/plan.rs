//! A motion as a plan for firmware.

mod bound;
mod kept;
mod ramp;
mod rows;

use std::f64::consts::TAU;

use jred_file::model::coordinate::Coordinate;
use jred_motion::trace::{Node, Trace};

/// A motion with nodes at equal time steps.
fn motion(count: usize, length: f64, state: impl Fn(f64) -> [f64; 3]) -> Trace {
    let step = length / count as f64;
    let node = |k: usize| {
        let t = k as f64 * step;
        let [phi, omega, alpha] = state(t);
        Node {
            t,
            step: if k == 0 { 0.0 } else { step },
            phi,
            omega,
            alpha: [alpha; 2],
        }
    };
    Trace::new(Coordinate::Angle, (0..=count).map(node).collect())
}

/// A cycloidal move of half a turn in a second, in `count` steps.
fn cycloid(count: usize) -> Trace {
    let (way, angle) = (0.5 * TAU, TAU);
    motion(count, 1.0, |t| {
        [
            way * (t - (angle * t).sin() / angle),
            way * (1.0 - (angle * t).cos()),
            way * angle * (angle * t).sin(),
        ]
    })
}
