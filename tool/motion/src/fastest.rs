//! Minimum time: the fastest motion of a machine along its way within the limits of its drive.
//!
//! One degree of freedom and an inertia that is positive everywhere: at every place and speed the limits leave an interval of
//! accelerations, and the fastest motion is at one end of it, or at a limit of the speed, all the time. It is found by two sweeps along
//! the way (`sweep`), and by refining the cells of the way until the time does not change any more: there is no grid to choose.
//!
//! [`solve`] is exact for any torque-speed limits, for viscous and Coulomb friction and losses. If it finds no motion, there is none, with
//! two exceptions: limits that leave separate ranges of speed (`sweep` says why), and a force in a joint that only speed keeps within its limit.

mod between;
pub mod corners;
mod costs;
mod course;
pub mod cycle;
mod endless;
pub mod field;
pub mod joint_force;
mod kept;
pub mod leg;
mod lines;
mod motor_load;
mod obstacle;
mod phases;
pub mod plane;
mod programme;
mod reserve;
mod rms;
pub mod ruled;
mod slivers;
mod slowed;
pub mod sweep;
pub mod tool_speed;
pub mod track;
pub mod winding;

use std::f64::consts::{FRAC_PI_2, TAU};

use jred::{Domain, Reducible as _};
use jred_machine::model::machine::MachineFile;

use crate::trace::Trace;
use crate::way::{Actuator, Way};
use course::{CELLS, Course, SWEEP_EXCESS};
use field::Field;
pub use field::{Binding, Limits, Reserve};
pub use joint_force::JointForces;
pub use kept::KeptPart;
pub use obstacle::NoMotion;
pub use phases::Phase;
pub use programme::{Price, Start, Warm};
pub use rms::Rms;
pub use slowed::Slowing;
pub use tool_speed::{ToolSpeed, ToolSpeeds};
use track::Ends;

/// Cells in a turn of a machine that changes within it, about the middle of the way where they are longest.
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
    /// What is kept besides the limits of the motor.
    pub limits: Limits,
    /// Whether it goes on for ever: its end is its start, with a speed that is sought; `speeds` are not asked for.
    pub endless: bool,
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
    /// Share by which a limit is exceeded in the nodes and at five places between two of them, at most 1e-6, mostly 1e-9: torques as a share of the motor's torque at rest.
    /// Limits of jerk and torque rate: at three places between them.
    pub excess: f64,
    /// Cells of the way.
    pub cells: usize,
    /// No motion takes less time (s), where it is not known that this one takes the least: the fastest without limits of jerk and torque rate.
    pub bound: Option<f64>,
}

/// The fastest motion of a machine with a drive.
///
/// # Errors
/// There is none, or none can be computed: where, and what is missing.
pub fn solve(file: &MachineFile, actuator: &Actuator, task: &Task) -> Result<Fastest, NoMotion> {
    if task.endless {
        return endless::solve(file, actuator, task, SWEEP_EXCESS);
    }
    if task.limits.has_rates() {
        return priced(file, actuator, task, Price::TIME, Start::Nothing).map(|(found, _)| found);
    }
    refine(file, actuator, task, SWEEP_EXCESS)
}

/// The motion with the least price.
///
/// # Errors
/// Those of [`solve`].
pub fn priced(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    price: Price,
    start: Start,
) -> Result<(Fastest, Warm), NoMotion> {
    if task.limits.forces.is_some() {
        return Err(NoMotion::JointForceAlone);
    }
    let free = Task {
        limits: task.limits.without_rates(),
        ..*task
    };
    let bound = refine(file, actuator, &free, f64::INFINITY)?;
    let way = way(file, actuator, task)?;
    let field = Field {
        way: &way,
        limits: task.limits,
    };
    let length = (task.to - task.from).abs();
    let ends = Ends {
        from: task.from,
        length,
        speeds: task.speeds,
        corners: corners::corners(&field, task.from, length)?,
    };
    let asked = programme::Asked {
        field: &field,
        ends: &ends,
        bound: bound.time,
        unit: bound.time,
        rise: rise(&field, &bound.trace)? / bound.time,
        price,
    };
    asked.in_own_unit()?.solve(start)
}

/// The time (s) in which the accelerations of a motion's ends rise from zero under the limits of rates.
fn rise(field: &Field, trace: &Trace) -> Result<f64, NoMotion> {
    let [Some(first), Some(last)] = [trace.nodes().first(), trace.nodes().last()] else {
        return Ok(0.0);
    };
    let mut most = 0.0_f64;
    for (node, alpha) in [(first, first.alpha[1]), (last, last.alpha[0])] {
        let place = field.way.place(node.phi)?;
        let demand = field
            .way
            .demand(&place, node.omega.abs(), alpha * field.way.direction);
        let limits = &field.limits;
        let own = |limit: Option<f64>, change: f64| limit.map_or(0.0, |limit| change.abs() / limit);
        most = most.max(own(limits.jerk, alpha));
        most = most.max(own(limits.torque_rate, alpha * demand.per_acceleration));
    }
    Ok(most)
}

/// The time (s) of the fastest motion alone, without a look at what is between its nodes.
///
/// # Errors
/// Those of [`solve`].
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

/// The fastest motion without limits of rates, looked at between its nodes where `within` is finite.
fn refine(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    within: f64,
) -> Result<Fastest, NoMotion> {
    let way = way(file, actuator, task)?;
    let limits = task.limits;
    Course::new(&Field { way: &way, limits }, task)?.fastest(task.speeds, within)
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
        return Err(NoMotion::NoTorqueLimit(obstacle::input(file)));
    }
    let [_, _, back, ..] = actuator.coefficients.0;
    if back < 0.0 {
        return Err(NoMotion::SelfLocking);
    }
    Ok(Way::new(file, actuator.clone(), length.signum()))
}

/// Cells that a way of many turns takes at least. Those of a machine that changes within a turn must show it, and corners are borders of
/// cells.
fn least_cells(field: &Field, from: f64, length: f64) -> Result<usize, NoMotion> {
    let Domain::Turn = field.way.file.machine.domain() else {
        return Ok(0);
    };
    let turns = length / TAU;
    // Nodes lie as the cosine of equal parts: the longest cell is π/2 times the mean one.
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
