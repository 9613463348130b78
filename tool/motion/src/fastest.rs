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

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, TAU};

use jred::{Domain, Reducible as _};
use jred_machine::model::machine::MachineFile;

use crate::trace::{Node, Trace};
use crate::way::{Actuator, Way};
pub use field::{Binding, Limits, Reserve};
use field::{Field, speed};
pub use joint_force::JointForces;
pub use kept::KeptPart;
use leg::Step;
pub use obstacle::NoMotion;
pub use phases::Phase;
pub use programme::{Price, Start, Warm};
pub use rms::Rms;
pub use slowed::Slowing;
use sweep::{Obstacle, Piece};
pub use tool_speed::{ToolSpeed, ToolSpeeds};
use track::{Ends, Survey, Track};

/// Cells of the first try, and the most.
const CELLS: [usize; 2] = [128, 131_072];

/// Change of the time from one number of cells to twice as many, as a share, at which it is taken: with a method of order 4 a fifteenth
/// of it is left.
const SETTLED: f64 = 1e-9;

/// Share by which a torque, speed or acceleration may exceed its limit between the nodes of the motion.
const SWEEP_EXCESS: f64 = 1e-9;

/// Rounds of finer cells.
const ROUNDS: u32 = 24;

/// Rounds in a row in which what is exceeded most does not fall below this share of the least so far: it is rounding of the machine's terms, of which finer
/// cells have as much.
const IDLE: u32 = 3;
const FALLS: f64 = 0.5;

/// Share by which they may after all rounds, and that of the time by which it may change with the last number of cells: a motion that is
/// less accurate is none.
const MOST_EXCESS: f64 = 1e-6;
const MOST_CHANGE: f64 = 1e-6;

/// Cells with which limits that contradict each other are taken as such.
const ENOUGH: usize = 4096;

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

/// A way with its limits, along which motions with other speeds at their ends are made.
struct Course<'f, 'w, 'a> {
    survey: Survey<'f, 'w, 'a>,
    from: f64,
    length: f64,
    corners: Vec<f64>,
    /// Cells with which the next motion is tried first: half of those with which the one before was settled.
    first: Cell<usize>,
}

impl<'f, 'w, 'a> Course<'f, 'w, 'a> {
    /// The way of a task.
    ///
    /// # Errors
    /// It is too long, or the mechanism cannot be placed somewhere.
    fn new(field: &'f Field<'w, 'a>, task: &Task) -> Result<Self, NoMotion> {
        let length = (task.to - task.from).abs();
        let [first, _] = CELLS;
        Ok(Self {
            survey: Survey::new(field, task.from),
            from: task.from,
            length,
            corners: corners::corners(field, task.from, length)?,
            first: Cell::new(first.max(least_cells(field, task.from, length)?)),
        })
    }

    /// Halves the cells until the time is settled, then makes those finer in which limits are exceeded by more than `within`.
    fn fastest(&self, speeds: [f64; 2], within: f64) -> Result<Fastest, NoMotion> {
        let field = self.survey.field;
        let (way, limits, file) = (field.way, &field.limits, field.way.file);
        let [_, most] = CELLS;
        let mut count = self.first.get();
        let ends = Ends {
            from: self.from,
            length: self.length,
            speeds,
            corners: self.corners.clone(),
        };
        let z = ends.speeds.map(|v| 0.5 * v * v);
        let mut before: Option<f64> = None;
        let mut end: Option<f64> = None;
        let mut settled = f64::INFINITY;
        let mut finer: Vec<f64> = Vec::new();
        let (mut lowest, mut idle) = (f64::INFINITY, 0);
        for round in 0.. {
            let track = Track::new(&self.survey, &ends, count, &finer)?;
            if let Some((phi, force)) = joint_force::without_motion(&track) {
                return Err(NoMotion::of_force(file, phi, &force));
            }
            let may_go_on = track.cells.len() < most && round < ROUNDS;
            let pieces = match sweep::fastest(field, &track, z) {
                Ok(pieces) => pieces,
                Err(Obstacle::StartTooFast(most) | Obstacle::EndTooFast(most))
                    if count < ENOUGH
                        && finer.is_empty()
                        && may_go_on
                        && end
                            .replace(most)
                            .is_none_or(|end| (most - end).abs() > SETTLED * most) =>
                {
                    // How fast an end may be is known as well as the cells show the machine.
                    count *= 2;
                    continue;
                }
                Err(obstacle) => {
                    let eased = match obstacle {
                        Obstacle::Stops(..) => slowed::by(field, &ends, count)?,
                        _ => None,
                    };
                    return Err(NoMotion::at(field, &track, obstacle, eased));
                }
            };
            if let Err(closed) = between::check(field, &ends, &track, &pieces) {
                // Between the places of a cell two limits that meet at the largest speed may cross: everywhere, or just at a dead centre.
                if !(limits.forces.is_some() && may_go_on) {
                    return Err(closed.why);
                }
                if finer.is_empty() && count < ENOUGH {
                    count *= 2;
                } else {
                    finer.extend(closed.places);
                }
                continue;
            }
            let times = sweep::times(&track, &pieces);
            let time: f64 = times.iter().sum();
            if settled.is_infinite() {
                let change = before.map_or(f64::INFINITY, |before| (time - before).abs());
                before = Some(time);
                if change > SETTLED * time && may_go_on {
                    count *= 2;
                    continue;
                }
                settled = change;
                self.first.set(self.first.get().max(count / 2));
            }
            let (pieces, times) = slivers::without(&track, pieces, &times);
            let trace = trace(way, &ends, &track, &pieces, &times);
            let (worst, places) = if within.is_finite() {
                between::largest_excess(&self.survey, &ends, (&track, &pieces), &trace, within)?
            } else {
                ((0.0, self.from), Vec::new())
            };
            let falls = worst.0 < FALLS * lowest;
            if falls {
                (lowest, idle) = (worst.0, 0);
            } else {
                idle += 1;
            }
            if !places.is_empty() && may_go_on && idle < IDLE {
                finer.extend(places);
                continue;
            }
            let (excess, phi) = worst;
            if excess > MOST_EXCESS || settled > MOST_CHANGE * time {
                return Err(NoMotion::NotAccurate {
                    excess,
                    phi,
                    change: settled / time,
                    endless: false,
                    axis: file.axis(),
                });
            }
            return Ok(Fastest {
                time,
                error: settled / 15.0,
                phases: phases::phases(field, &ends, &track, &pieces, &times),
                trace,
                excess,
                cells: track.cells.len(),
                bound: None,
            });
        }
        Err(NoMotion::NoWay)
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

/// The motion over the time.
fn trace(way: &Way, ends: &Ends, track: &Track, pieces: &[Piece], times: &[f64]) -> Trace {
    let mut nodes: Vec<Node> = Vec::with_capacity(pieces.len() + 1);
    let mut t = 0.0;
    let mut push = |t: f64, step: f64, piece: &Piece, end: usize| {
        let Step { u, z, a, .. } = &piece.step;
        let cell = &track.cells[piece.cell];
        let alpha = a[end] * way.direction;
        if let Some(node) = nodes.last_mut().filter(|_| end == 0) {
            node.alpha[1] = alpha;
            return;
        }
        nodes.push(Node {
            t,
            step,
            phi: ends.from + way.direction * (cell.x + u[end] * cell.length),
            omega: speed(z[end]) * way.direction,
            alpha: [if t == 0.0 { 0.0 } else { alpha }, alpha],
        });
    };
    for (piece, time) in pieces.iter().zip(times) {
        push(t, 0.0, piece, 0);
        t += time;
        push(t, *time, piece, 1);
    }
    if let Some(last) = nodes.last_mut() {
        last.alpha[1] = 0.0;
        last.phi = ends.from + way.direction * ends.length;
    }
    Trace::new(way.coordinate(), nodes)
}
