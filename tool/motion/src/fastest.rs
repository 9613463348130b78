//! Minimum time: the fastest motion of a machine along its way within the limits of its drive.
//!
//! One degree of freedom and an inertia that is positive everywhere: at every place and speed the limits leave an interval of
//! accelerations, and the fastest motion is at one end of it, or at a limit of the speed, all the time. It is found by two sweeps along
//! the way (`sweep`), and by refining the cells of the way until the time does not change any more: there is no grid to choose.
//!
//! [`solve`] is exact for any torque-speed limits, for viscous and Coulomb friction and losses. If it finds no motion, there is none:
//! `sweep` says why.

pub mod corners;
pub mod cycle;
pub mod field;
pub mod leg;
mod obstacle;
mod phases;
pub mod sweep;
pub mod track;

use jred_machine::model::machine::MachineFile;

use crate::trace::{Node, Trace};
use crate::way::{Actuator, Way};
pub use field::{Binding, Limits};
use field::{Field, speed};
use leg::Step;
pub use obstacle::NoMotion;
pub use phases::Phase;
use sweep::Piece;
use track::{Ends, Track};

/// Cells of the first try, and of the last.
const CELLS: [usize; 2] = [128, 131_072];

/// Change of the time from one number of cells to twice as many, as a share, at which it is taken: with a method of order 4 a fifteenth
/// of it is left.
const SETTLED: f64 = 1e-9;

/// Share by which a torque, speed or acceleration may exceed its limit between the nodes of the motion.
const WITHIN: f64 = 1e-9;

/// Places between two nodes at which that is looked at.
const LOOKS: [f64; 3] = [0.21, 0.5, 0.79];

/// A move to be made as fast as possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Position of the start (rad, or m).
    pub from: f64,
    /// Position of the end.
    pub to: f64,
    /// Speeds at the start and at the end, in the direction of the move (rad/s, or m/s); 0: at rest.
    pub speeds: [f64; 2],
    /// What is kept besides the limits of the motor.
    pub limits: Limits,
}

/// The fastest motion.
#[derive(Clone, Debug)]
pub struct Fastest {
    /// How long it takes (s).
    pub time: f64,
    /// Estimated error of the time (s), from the last two numbers of cells.
    pub error: f64,
    /// The motion.
    pub trace: Trace,
    /// Which limit it follows from where to where.
    pub phases: Vec<Phase>,
    /// Share by which a limit is exceeded at most between the nodes; at most 1e-9 unless the cells ran out.
    pub excess: f64,
    /// Cells of the way.
    pub cells: usize,
}

/// The fastest motion of a machine with a drive.
///
/// # Errors
/// There is none, or none can be computed: where, and what is missing.
pub fn solve(file: &MachineFile, actuator: &Actuator, task: &Task) -> Result<Fastest, NoMotion> {
    refine(file, actuator, task, WITHIN)
}

/// The time (s) of the fastest motion alone, without a look at what is between its nodes.
///
/// # Errors
/// Those of [`solve`].
pub fn time(file: &MachineFile, actuator: &Actuator, task: &Task) -> Result<f64, NoMotion> {
    refine(file, actuator, task, f64::INFINITY).map(|found| found.time)
}

/// Halves the cells until the time is settled and limits are exceeded by no more than `within`.
fn refine(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    within: f64,
) -> Result<Fastest, NoMotion> {
    let way = way(file, actuator, task)?;
    let limits = task.limits;
    let field = Field { way: &way, limits };
    let length = (task.to - task.from).abs();
    let ends = Ends {
        from: task.from,
        length,
        speeds: task.speeds,
        corners: corners::corners(&field, task.from, length)?,
    };
    let mut before: Option<f64> = None;
    let [mut count, most] = CELLS;
    loop {
        let track = Track::new(&field, &ends, count)?;
        let z = ends.speeds.map(|v| 0.5 * v * v);
        let pieces = sweep::fastest(&field, &track, z)
            .map_err(|obstacle| NoMotion::at(&field, &track, obstacle))?;
        check(&field, &track, &pieces)?;
        let times = sweep::times(&track, &pieces);
        let time: f64 = times.iter().sum();
        let change = before.map_or(f64::INFINITY, |before| (time - before).abs());
        before = Some(time);
        count *= 2;
        if change > SETTLED * time && count <= most {
            continue;
        }
        let trace = trace(&way, &ends, &track, &pieces, &times);
        let enough = if count <= most { within } else { f64::INFINITY };
        let excess = if within.is_finite() {
            excess(&field, &trace, enough)?
        } else {
            0.0
        };
        if excess > enough {
            continue;
        }
        return Ok(Fastest {
            time,
            error: change / 15.0,
            phases: phases::phases(&field, &ends, &track, &pieces, &times),
            trace,
            excess,
            cells: track.cells.len(),
        });
    }
}

/// The way of a task, if it can be gone at all.
fn way<'a>(file: &'a MachineFile, actuator: &Actuator, task: &Task) -> Result<Way<'a>, NoMotion> {
    let length = task.to - task.from;
    let numbers = [task.from, task.to, task.speeds[0], task.speeds[1]];
    if length == 0.0 || !numbers.iter().all(|x| x.is_finite()) {
        return Err(NoMotion::NoWay);
    }
    let torques = actuator.torques(0.0);
    if !torques.iter().all(|torque| torque.is_finite()) {
        return Err(NoMotion::NoTorqueLimit);
    }
    let [_, _, back, ..] = actuator.coefficients.0;
    if back < 0.0 {
        return Err(NoMotion::SelfLocking);
    }
    Ok(Way::new(file, actuator.clone(), length.signum()))
}

/// Limits must leave an acceleration all along: below the speeds where they do, the motion may have come from above.
fn check(field: &Field, track: &Track, pieces: &[Piece]) -> Result<(), NoMotion> {
    if !field.may_be_empty() {
        return Ok(());
    }
    for Piece { cell, step, .. } in pieces {
        let cell = &track.cells[*cell];
        for end in [0, 1] {
            let (place, z) = (cell.place(step.u[end]), step.z[end]);
            let [low, high] = [field.least_by(&place, z), field.most_by(&place, z)];
            if low.0 > high.0 + 1e-9 * (low.0.abs() + high.0.abs()) {
                return Err(NoMotion::Empty {
                    phi: place.phi,
                    speed: speed(z),
                    least: low,
                    most: high,
                });
            }
        }
    }
    Ok(())
}

/// The motion over the time.
fn trace(way: &Way, ends: &Ends, track: &Track, pieces: &[Piece], times: &[f64]) -> Trace {
    let mut nodes: Vec<Node> = Vec::with_capacity(pieces.len() + 1);
    let mut t = 0.0;
    let mut push = |t: f64, piece: &Piece, end: usize| {
        let Step { u, z, a, .. } = &piece.step;
        let cell = &track.cells[piece.cell];
        let alpha = a[end] * way.direction;
        if let Some(node) = nodes.last_mut().filter(|_| end == 0) {
            node.alpha[1] = alpha;
            return;
        }
        nodes.push(Node {
            t,
            phi: ends.from + way.direction * (cell.x + u[end] * cell.length),
            omega: speed(z[end]) * way.direction,
            alpha: [if t == 0.0 { 0.0 } else { alpha }, alpha],
        });
    };
    for (piece, time) in pieces.iter().zip(times) {
        push(t, piece, 0);
        t += time;
        push(t, piece, 1);
    }
    if let Some(last) = nodes.last_mut() {
        last.alpha[1] = 0.0;
        last.phi = ends.from + way.direction * ends.length;
    }
    Trace::new(way.coordinate(), nodes)
}

/// The largest share by which a limit is exceeded between the nodes, with the machine itself at each place; the first one found beyond
/// `enough`.
fn excess(field: &Field, trace: &Trace, enough: f64) -> Result<f64, NoMotion> {
    let way = field.way;
    let direction = way.direction;
    let mut most = 0.0_f64;
    let (top, _) = field.top();
    for pair in trace.nodes().windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        if most > enough {
            break;
        }
        for share in LOOKS {
            let t = a.t + share * (b.t - a.t);
            if !(a.t < t && t < b.t) {
                continue;
            }
            let state = trace.at(t);
            let place = way.place(state.phi)?;
            let (v, alpha) = (state.omega * direction, state.alpha * direction);
            // A torque at its limit is measured by that of the motor at rest: the limit itself may be nothing.
            let limits = field.motor_torques(v);
            let scale = way.actuator.torques(0.0).map(f64::abs);
            let torque = way.demand(&place, v, alpha).torque;
            most = most.max((torque - limits[1]) / scale[1]);
            most = most.max((limits[0] - torque) / scale[0]);
            most = most.max(v / top - 1.0);
            if let Some(limit) = field.limits.gearbox_torque {
                let torque = way.gearbox_demand(&place, v, alpha).torque;
                most = most.max(torque.abs() / limit - 1.0);
            }
            if let Some(limit) = field.limits.acceleration {
                most = most.max(alpha / limit - 1.0);
            }
            if let Some(limit) = field.limits.deceleration {
                most = most.max(-alpha / limit - 1.0);
            }
        }
    }
    Ok(most)
}
