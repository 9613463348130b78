//! The phase plane of a move: speed over position, with the active limit of each stretch and the speeds that the machine cannot pass.

use jred::error::Error;
use jred_file::model::machine::MachineFile;

use super::Binding;
use super::cycle::FastestMove;
use super::field::Field;
use super::joint_force::Spot;
use super::sweep::Side;
use crate::path_dynamics::{Actuator, PathDynamics};

/// Positions at which the limits are evaluated.
const POSITIONS: usize = 361;

/// Speeds at each position, from rest to the largest.
const SPEEDS: u32 = 96;

/// Most points of the motion.
const POINTS: usize = 3000;

/// The phase plane: positions (rad, or m) and speeds along the path (rad/s, or m/s).
#[derive(Clone, Debug, Default)]
pub struct Plane {
    /// Successive stretches of the motion, each with its active limit.
    pub stretches: Vec<(Binding, Vec<[f64; 2]>)>,
    /// The largest speed, lower where limits of acceleration contradict each other; empty without a limit.
    pub ceiling: Vec<[f64; 2]>,
    /// Speeds above which the limits only allow slowing down, where they are below the largest speed.
    pub holding: Vec<[f64; 2]>,
}

impl Plane {
    /// The phase plane of a move.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn of(file: &MachineFile, actuator: &Actuator, made: &FastestMove) -> Result<Self, Error> {
        let [from, to] = [made.task.from, made.task.to];
        let direction = (to - from).signum();
        let dynamics = PathDynamics::new(file, actuator.clone(), direction);
        let field = Field {
            dynamics: &dynamics,
            limits: made.task.limits,
        };
        let mut plane = Self {
            stretches: stretches(made, direction),
            ..Self::default()
        };
        let (top, _) = field.top();
        let fastest = plane.fastest();
        // Without a speed limit: above the motion's own speed.
        let highest = if top.is_finite() { top } else { 1.5 * fastest };
        for k in 0..POSITIONS {
            let phi = from + (to - from) * k as f64 / (POSITIONS - 1) as f64;
            let forces: Vec<_> = (field.forces(phi)?.iter())
                .map(|force| [*force; 3])
                .collect();
            let place = Spot::new(dynamics.place(phi)?, &forces, [1.0, 0.0, 0.0]);
            let z = |v: f64| 0.5 * v * v;
            let top = top.min(field.tool_speed(phi)?);
            let closed = if field.may_be_empty() {
                first(highest, |v| !field.is_open(&place, z(v)))
            } else {
                None
            };
            if closed.is_some() || top.is_finite() {
                plane.ceiling.push([phi, closed.unwrap_or(top)]);
            }
            let slows = first(highest, |v| field.side(Side::Most, &place, z(v)) < 0.0);
            let below = |v: &f64| *v < closed.unwrap_or(f64::INFINITY);
            let speed = slows.filter(below).unwrap_or(f64::NAN);
            plane.holding.push([phi, speed]);
        }
        if plane.holding.iter().all(|[_, speed]| speed.is_nan()) {
            plane.holding.clear();
        }
        Ok(plane)
    }

    /// The largest speed of the motion.
    pub fn fastest(&self) -> f64 {
        let points = self.stretches.iter().flat_map(|(_, points)| points);
        points.fold(0.0, |most, [_, speed]| most.max(*speed))
    }
}

/// The first speed up to `highest` from which a condition is true, to a millionth of `highest`.
fn first(highest: f64, holds: impl Fn(f64) -> bool) -> Option<f64> {
    let speed = |k: u32| highest * f64::from(k) / f64::from(SPEEDS);
    let k = (0..=SPEEDS).find(|k| holds(speed(*k)))?;
    let (mut below, mut above) = (speed(k.saturating_sub(1)), speed(k));
    while above - below > 1e-6 * highest {
        let middle = below.midpoint(above);
        if holds(middle) {
            above = middle;
        } else {
            below = middle;
        }
    }
    Some(above)
}

/// The nodes of each phase, including its ends.
fn stretches(made: &FastestMove, direction: f64) -> Vec<(Binding, Vec<[f64; 2]>)> {
    let nodes = made.fastest.trace.nodes();
    let stride = nodes.len().div_ceil(POINTS).max(1);
    let phases = made.fastest.phases.iter();
    let stretch = |phase: &super::Phase| {
        let [begin, end] = phase.t;
        let inner = nodes
            .iter()
            .enumerate()
            .filter(|(k, node)| k.is_multiple_of(stride) && node.t > begin && node.t < end);
        let mut points = vec![[phase.phi[0], phase.speed[0]]];
        points.extend(inner.map(|(_, node)| [node.phi, node.omega * direction]));
        points.push([phase.phi[1], phase.speed[1]]);
        (phase.limit, points)
    };
    phases.map(stretch).collect()
}
