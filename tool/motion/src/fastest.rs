//! Minimum time: the fastest motion of a machine along its path within the limits of its drive.
//!
//! With one degree of freedom and an inertia that is positive everywhere, the limits leave an interval of accelerations at every place and speed. The
//! fastest motion is always at one end of it or at a speed limit. Two sweeps along the path find it (`sweep`). The cells of the path are refined
//! until the time no longer changes: there is no grid to choose.
//!
//! [`solve`] is exact for any torque-speed limits, for viscous and Coulomb friction and losses. If it finds no motion, no motion exists, with two
//! exceptions: limits that leave separate ranges of speed (`sweep` says why), and a joint force that only speed keeps within its limit.

mod between;
pub mod corners;
mod costs;
pub mod cycle;
mod endless;
pub mod field;
pub mod joint_force;
mod kept;
pub mod leg;
mod lines;
pub mod motion_input;
mod motor_load;
mod obstacle;
mod path_search;
mod phases;
pub mod plane;
mod programme;
mod reserve;
mod rms;
pub mod ruled;
mod settable_limit;
pub mod sweep;
mod tiny_steps;
pub mod tool_speed;
pub mod track;
pub mod winding;

use std::f64::consts::{FRAC_PI_2, TAU};

use jred::Domain;
use jred::machine::Reducible as _;
use jred_file::model::machine::MachineFile;

use crate::path_dynamics::{Actuator, PathDynamics};
use crate::trace::Trace;
use field::Field;
pub use field::{Binding, MoveLimits, Reserve};
pub use joint_force::JointForces;
pub use kept::KeptPart;
pub use obstacle::NoMotion;
use path_search::{CELLS, PathSearch, SWEEP_EXCESS};
pub use phases::Phase;
pub use programme::{Price, Start, WarmStart};
pub use rms::Rms;
pub use tool_speed::{ToolSpeed, ToolSpeeds};
use track::Ends;

/// Cells per turn of a machine that changes within a turn, at the middle of the path, where cells are longest.
const PER_TURN: f64 = 16.0;

/// A move to be made as fast as possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Position of the start (rad, or m).
    pub from: f64,
    /// Position of the end.
    pub to: f64,
    /// Speeds at the start and at the end, in the direction of the move (rad/s, or m/s); 0: at rest.
    pub speeds: [f64; 2],
    /// Limits besides those of the motor.
    pub limits: MoveLimits,
    /// Whether the move repeats endlessly: its end is its start, with a speed to be found; `speeds` are ignored.
    pub endless: bool,
}

/// The fastest motion.
#[derive(Clone, Debug)]
pub struct Fastest {
    /// Duration (s).
    pub time: f64,
    /// Estimated error of the time (s), from the last two numbers of cells.
    pub error: f64,
    /// The motion.
    pub trace: Trace,
    /// The active limit of each part of the path.
    pub phases: Vec<Phase>,
    /// Largest share by which a limit is exceeded at the nodes and at five places between two nodes: at most 1e-6, mostly 1e-9. Torques are shares of
    /// the motor's torque at rest. With limits of jerk and torque rate: at three places between two nodes.
    pub excess: f64,
    /// Cells of the path.
    pub cells: usize,
    /// Lower bound of the time (s), where the optimum is not proven: the fastest motion without limits of jerk and torque rate.
    pub bound: Option<f64>,
}

/// The fastest motion of a machine with a drive.
///
/// # Errors
/// No motion exists, or none can be computed: where, and which data are missing.
pub fn solve(file: &MachineFile, actuator: &Actuator, task: &Task) -> Result<Fastest, NoMotion> {
    if task.endless {
        return endless::solve(file, actuator, task, SWEEP_EXCESS);
    }
    if task.limits.has_rates() {
        return priced(file, actuator, task, Price::TIME, Start::Nothing).map(|(found, _)| found);
    }
    refine(file, actuator, task, SWEEP_EXCESS)
}

/// The motion with the lowest price.
///
/// # Errors
/// As [`solve`].
pub fn priced(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    price: Price,
    start: Start,
) -> Result<(Fastest, WarmStart), NoMotion> {
    if task.limits.forces.is_some() {
        return Err(NoMotion::JointForceAlone);
    }
    let free = Task {
        limits: task.limits.without_rates(),
        ..*task
    };
    let bound = refine(file, actuator, &free, f64::INFINITY)?;
    let dynamics = dynamics(file, actuator, task)?;
    let field = Field {
        dynamics: &dynamics,
        limits: task.limits,
    };
    let length = (task.to - task.from).abs();
    let ends = Ends {
        from: task.from,
        length,
        speeds: task.speeds,
        corners: corners::corners(&field, task.from, length)?,
    };
    let asked = programme::MoveRequest {
        field: &field,
        ends: &ends,
        bound: bound.time,
        unit: bound.time,
        rise: rise(&field, &bound.trace)? / bound.time,
        price,
    };
    asked.in_own_unit()?.solve(start)
}

/// The time (s) in which the accelerations at a motion's ends rise from zero under the rate limits.
fn rise(field: &Field, trace: &Trace) -> Result<f64, NoMotion> {
    let [Some(first), Some(last)] = [trace.nodes().first(), trace.nodes().last()] else {
        return Ok(0.0);
    };
    let mut most = 0.0_f64;
    for (node, alpha) in [(first, first.alpha[1]), (last, last.alpha[0])] {
        let place = field.dynamics.place(node.phi)?;
        let demand =
            field
                .dynamics
                .demand(&place, node.omega.abs(), alpha * field.dynamics.direction);
        let limits = &field.limits;
        let own = |limit: Option<f64>, change: f64| limit.map_or(0.0, |limit| change.abs() / limit);
        most = most.max(own(limits.jerk, alpha));
        most = most.max(own(limits.torque_rate, alpha * demand.per_acceleration));
    }
    Ok(most)
}

/// The time (s) of the fastest motion alone, without checks between its nodes.
///
/// # Errors
/// As [`solve`].
pub fn time(file: &MachineFile, actuator: &Actuator, task: &Task) -> Result<f64, NoMotion> {
    let alone = f64::INFINITY;
    let found = if task.endless {
        endless::solve(file, actuator, task, alone)
    } else if task.limits.has_rates() {
        solve(file, actuator, task)
    } else {
        refine(file, actuator, task, alone)
    };
    found.map(|found| found.time)
}

/// The fastest motion without rate limits, checked between its nodes where `within` is finite.
fn refine(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    within: f64,
) -> Result<Fastest, NoMotion> {
    let dynamics = dynamics(file, actuator, task)?;
    let limits = task.limits;
    PathSearch::new(
        &Field {
            dynamics: &dynamics,
            limits,
        },
        task,
    )?
    .fastest(task.speeds, within)
}

/// The path of a task, if its ends are valid.
fn dynamics<'a>(
    file: &'a MachineFile,
    actuator: &Actuator,
    task: &Task,
) -> Result<PathDynamics<'a>, NoMotion> {
    let length = task.to - task.from;
    let numbers = [task.from, task.to, task.speeds[0], task.speeds[1]];
    if length == 0.0 || !numbers.iter().all(|x| x.is_finite()) {
        return Err(NoMotion::NoWay);
    }
    let torques = actuator.torques(0.0);
    if !torques.iter().all(|torque| torque.is_finite()) {
        return Err(NoMotion::NoTorqueLimit(obstacle::input(file)));
    }
    let [_, _, back, ..] = actuator.coefficients.0;
    if back < 0.0 {
        return Err(NoMotion::SelfLocking);
    }
    Ok(PathDynamics::new(file, actuator.clone(), length.signum()))
}

/// The least number of cells for a path of many turns. The cells must resolve changes within a turn, and corners are borders of cells.
fn least_cells(field: &Field, from: f64, length: f64) -> Result<usize, NoMotion> {
    let Domain::Turn = field.dynamics.file.machine.domain() else {
        return Ok(0);
    };
    let turns = length / TAU;
    // Nodes are spaced as the cosine of equal parts: the longest cell is π/2 times the mean.
    let each = (PER_TURN * FRAC_PI_2).max(4.0 * corners::count(field) as f64);
    let [_, most] = CELLS;
    let most = most as f64 / 4.0;
    if each * turns <= CELLS[0] as f64 || !corners::changes(field, from)? {
        return Ok(0);
    }
    if each * turns > most {
        return Err(NoMotion::TooLong {
            turns,
            most: most / each,
        });
    }
    Ok((PER_TURN * FRAC_PI_2 * turns).ceil() as usize)
}
