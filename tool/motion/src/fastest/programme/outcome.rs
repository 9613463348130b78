//! The motion over time for w(u), and the check of its limits with the machine itself.

use jred::error::Error;
use jred_file::number::quadrature::GAUSS_5;

use super::borders::{ActiveConstraint, strongest};
use super::limits::Margins;
use super::mesh::SHARES;
use super::{MeshMotion, MoveRequest, PROGRAMME_EXCESS};
use crate::collocation::shape::Parametrization;
use crate::fastest::between::{BETWEEN_NODES, within_step};
use crate::fastest::field::Binding;
use crate::fastest::track::PathPoint;
use crate::fastest::{NoMotion, Phase};
use crate::path_dynamics::Place;
use crate::trace::{Node, Trace};

/// Rounding errors of a speed or a torque, in units of the last digit; within a step they look like a jerk or a torque rate.
const ROUNDINGS: f64 = 4.0;

/// Share of a step over which the torque rate is computed.
const RATE_STEP: f64 = 0.02;

/// Parts of a step for the check of the torque rate where the torque bends in it.
const PARTS: u32 = 32;

/// Two limits whose values differ by less than this share count as met together.
const TIE_TOLERANCE: f64 = 1e-6;

/// The most exceeded limit between the nodes, the share of the excess, and the position.
#[derive(Clone, Copy, Debug)]
pub(super) struct LargestExcess {
    pub(super) excess: f64,
    pub(super) limit: Option<Binding>,
    pub(super) phi: f64,
}

impl LargestExcess {
    /// Not checked.
    pub(super) const NONE: Self = Self {
        excess: f64::INFINITY,
        limit: None,
        phi: 0.0,
    };
}

/// Widens the margins of pieces in which limits are exceeded, by the excess. In late rounds each margin is doubled too: a bend between two stations
/// may exceed a limit that is far away at the stations, where a small margin has no effect.
pub(super) fn widen(margins: &mut [Margins], exceeded: &[[f64; 3]], is_late: bool) {
    for (margins, own) in margins.iter_mut().zip(exceeded) {
        let each = [&mut margins.state, &mut margins.jerk, &mut margins.rate];
        for (margin, excess) in each.into_iter().zip(own) {
            if *excess > 0.5 * PROGRAMME_EXCESS {
                let more = if is_late { *margin } else { 0.0 };
                *margin += 1.1 * excess + 1e-9 + more;
            }
        }
    }
}

/// The jerk in a step that rounding of the speeds may cause.
fn rounded_jerk([a, b]: [&Node; 2]) -> f64 {
    ROUNDINGS * f64::EPSILON * (a.omega.abs() + b.omega.abs()) / (b.step * b.step)
}

/// The greatest magnitude of the parabola through values at the start, in the middle and at the end.
fn greatest([first, middle, last]: [f64; 3]) -> f64 {
    let slope = 4.0 * middle - 3.0 * first - last;
    let bend = 2.0 * (first + last) - 4.0 * middle;
    let share = -0.5 * slope / bend;
    let peak = if share > 0.0 && share < 1.0 {
        first + share * (slope + share * bend)
    } else {
        middle
    };
    [first, peak, last]
        .into_iter()
        .map(f64::abs)
        .fold(0.0, f64::max)
}

impl MoveRequest<'_> {
    /// The motion over time.
    pub(super) fn trace(&self, shape: &Parametrization, found: &MeshMotion) -> Trace {
        let direction = self.field.dynamics.direction;
        let problem = self.problem(&found.mesh, &[], found.range);
        let mut nodes: Vec<Node> = Vec::new();
        let mut t = 0.0;
        let count = SHARES.len();
        for (index, stations) in found.mesh.stations.chunks(count).enumerate() {
            let [from, to] = found.mesh.elements[index].span;
            let values = found.mesh.values(&found.point.x, index);
            for (k, station) in stations.iter().enumerate() {
                let state = problem.state(station, &values);
                let alpha = direction * state.acceleration;
                if k == 0
                    && let Some(node) = nodes.last_mut()
                {
                    node.alpha[1] = alpha;
                    continue;
                }
                let step = if k == 0 {
                    0.0
                } else {
                    self.step(found, index, [k - 1, k])
                };
                t += step;
                let [g, ..] = shape.series(station.u, from.midpoint(to));
                nodes.push(Node {
                    t,
                    step,
                    phi: self.ends.from + direction * self.ends.length * g,
                    omega: direction * state.speed,
                    alpha: [alpha; 2],
                });
            }
        }
        if let Some(first) = nodes.first_mut() {
            first.alpha[0] = 0.0;
        }
        if let Some(last) = nodes.last_mut() {
            last.alpha[1] = 0.0;
            last.phi = self.ends.from + direction * self.ends.length;
        }
        Trace::new(self.field.dynamics.coordinate(), nodes)
    }

    /// The time (s) from one station of a piece to another.
    pub(super) fn step(&self, found: &MeshMotion, element: usize, stations: [usize; 2]) -> f64 {
        let [from, to] = stations.map(|k| SHARES[k][0]);
        let [start, end] = found.mesh.elements[element].span;
        let each = GAUSS_5.into_iter().map(|[z, weight]| {
            let [w, ..] = found
                .mesh
                .pace(&found.point.x, element, from + z * (to - from));
            weight / w.sqrt()
        });
        self.unit * (end - start) * (to - from) * each.sum::<f64>()
    }

    /// The most exceeded limit, and for each piece the shares by which limits of state, jerk and torque rate are exceeded.
    pub(super) fn exceeded(
        &self,
        trace: &Trace,
        pieces: usize,
    ) -> Result<(LargestExcess, Vec<[f64; 3]>), NoMotion> {
        let dynamics = self.field.dynamics;
        let direction = dynamics.direction;
        let limits = self.limits();
        let mut worst = LargestExcess {
            excess: f64::NEG_INFINITY,
            ..LargestExcess::NONE
        };
        let near = self.ends.inside(0.0);
        let distance = |phi: f64| (phi - self.ends.from) * direction;
        let mut own: Vec<[f64; 3]> = vec![[0.0; 3]; pieces];
        for (index, pair) in trace.nodes().windows(2).enumerate() {
            let [a, b] = [&pair[0], &pair[1]];
            if b.step <= 0.0 {
                continue;
            }
            let piece = index / (SHARES.len() - 1);
            let mut look = |kind: usize, excess: f64, limit: Binding| {
                let all = &mut own[piece][kind];
                *all = all.max(excess);
                if excess > worst.excess {
                    worst = LargestExcess {
                        excess,
                        limit: Some(limit),
                        phi: a.phi,
                    };
                }
            };
            let [first, last] = [a, b].map(|node| distance(node.phi));
            let middle = 0.5 * (first + last);
            let place = |phi: f64| {
                // At a corner of the machine, the place is moved slightly to its own side.
                let x = distance(phi)
                    .max((first + near).min(middle))
                    .min((last - near).max(middle));
                dynamics.place(self.ends.from + direction * x)
            };
            for share in BETWEEN_NODES {
                let state = within_step(a, b, share);
                let seen = PathPoint::new(self.field, place(state.phi)?.phi)?;
                let (v, alpha) = (state.omega * direction, state.alpha * direction);
                let (excess, limit) = self.field.excess_by(&seen, v, alpha);
                look(0, excess, limit);
            }
            if let Some(limit) = limits.torque_rate {
                let rate = self.torque_rate([a, b], place)?;
                look(2, rate / limit - 1.0, Binding::TorqueRate);
            }
            if let Some(limit) = limits.jerk {
                for share in [0.0, 1.0] {
                    let jerk = b.jerk_after(a, share).abs() - rounded_jerk([a, b]);
                    look(1, jerk / limit - 1.0, Binding::Jerk);
                }
            }
        }
        Ok((worst, own))
    }

    /// The greatest torque rate (N·m/s) in a step, less possible rounding.
    fn torque_rate(
        &self,
        [a, b]: [&Node; 2],
        place: impl Fn(f64) -> Result<Place, Error>,
    ) -> Result<f64, NoMotion> {
        let dynamics = self.field.dynamics;
        let slope = |share: f64| -> Result<(f64, [usize; 2]), NoMotion> {
            let ends = [share * (1.0 - RATE_STEP), share + RATE_STEP * (1.0 - share)];
            let mut torques = [0.0; 2];
            let mut flows = [0; 2];
            let mut rounding = 0.0_f64;
            for (k, share) in ends.into_iter().enumerate() {
                let state = b.after(a, share);
                let place = place(state.phi)?;
                let [v, alpha] = [state.omega, state.alpha].map(|x| x * dynamics.direction);
                let demand = dynamics.demand(&place, v, alpha);
                (torques[k], flows[k]) = (demand.torque, dynamics.flow(&place, v, alpha));
                let parts = demand.torque.abs() + demand.per_acceleration * alpha.abs();
                let own = ROUNDINGS * f64::EPSILON * parts / (RATE_STEP * b.step)
                    + rounded_jerk([a, b]) * demand.per_acceleration;
                rounding = rounding.max(own);
            }
            let slope = (torques[1] - torques[0]) / ((ends[1] - ends[0]) * b.step);
            Ok((slope.signum() * (slope.abs() - rounding).max(0.0), flows))
        };
        let [first, middle, last] = [slope(0.0)?, slope(0.5)?, slope(1.0)?];
        let flow = first.1[0];
        let flows = [first.1, middle.1, last.1];
        if flows.iter().flatten().all(|own| *own == flow) {
            return Ok(greatest([first.0, middle.0, last.0]));
        }
        // The torque bends in the step.
        let mut most = 0.0_f64;
        for k in 0..=PARTS {
            most = most.max(slope(f64::from(k) / f64::from(PARTS))?.0.abs());
        }
        Ok(most)
    }

    /// The active limit of each part of the motion.
    pub(super) fn phases(&self, found: &MeshMotion, trace: &Trace) -> Vec<Phase> {
        let met = self.all_met(found);
        let count = SHARES.len();
        let mut phases: Vec<Phase> = Vec::new();
        let nodes = trace.nodes();
        let idle = if self.price.heat > 0.0 {
            Some(Binding::RmsTorque)
        } else {
            None
        };
        for (index, pair) in nodes.windows(2).enumerate() {
            let [a, b] = [&pair[0], &pair[1]];
            let piece = index / (count - 1);
            let first = piece * count + index % (count - 1);
            let mut at = [1, 0].into_iter().map(|k| &met[first + k]);
            let limit = at.find_map(|at| strongest(at).map(|own| (at, own)));
            // Where two limits are met together, the one that was active before is kept.
            let limit = limit.map(|(at, own)| {
                let before = phases.last().map(|phase| phase.limit);
                let goes_on = |met: &ActiveConstraint| {
                    Some(met.limit) == before && met.value > own.value - TIE_TOLERANCE
                };
                at.iter()
                    .find(|met| goes_on(met))
                    .map_or(own.limit, |met| met.limit)
            });
            let limit = limit.or(idle);
            let end = |node: &Node| (node.phi, node.t, node.omega.abs());
            let (phi, t, speed) = end(b);
            let limit = limit.or(phases.last().map(|phase| phase.limit));
            let Some(limit) = limit else { continue };
            if let Some(phase) = phases.last_mut().filter(|phase| phase.limit == limit) {
                (phase.phi[1], phase.t[1], phase.speed[1]) = (phi, t, speed);
                continue;
            }
            let (from, start, begin) = end(a);
            phases.push(Phase {
                limit,
                phi: [from, phi],
                t: [start, t],
                speed: [begin, speed],
            });
        }
        phases
    }
}
