//! All moves of a motion made as fast as possible, its pauses kept.

use jred::Error;
use jred::machine::motion::State;
use jred_machine::model::machine::MachineFile;

use super::field::{Binding, Limits};
use super::kept::KeptPart;
use super::obstacle::input;
use super::rms::{Asked, Refused, Rms, slowest, within};
use super::tool_speed::ToolSpeeds;
use super::{Fastest, NoMotion, Task, priced, solve};
use crate::moves::{Move, Part, Passing};
use crate::trace::{Node, Trace};
use crate::way::{Actuator, BothWays, Way};

/// Share by which torque and speed of the motor are raised to see what they are worth.
pub const MORE: f64 = 0.1;

/// Gauss and Legendre's rule with two points on 0 to 1.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// A move made as fast as possible.
#[derive(Clone, Debug)]
pub struct Made {
    /// What was asked.
    pub task: Task,
    /// How long the move takes in the motion that was given (s); `None`: it was not part of one.
    pub before: Option<f64>,
    /// The fastest motion.
    pub fastest: Fastest,
    /// What each limit that it reaches costs.
    pub costs: Vec<Cost>,
}

/// What a limit costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The limit.
    pub limit: Binding,
    /// The time (s) without it; of the motor's own limits, with a tenth more torque (driving and braking), or with a torque-speed curve
    /// that reaches to a tenth more speed.
    pub time: f64,
}

/// A motion whose moves are as fast as possible.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The moves.
    pub moves: Vec<Made>,
    /// All of it.
    pub trace: Trace,
    /// Length of the motion that was given (s).
    pub before: Option<f64>,
    /// Time at rest (s).
    pub dwells: f64,
    /// The parts that were kept.
    pub kept: Vec<KeptPart>,
    /// What the motor does.
    pub load: MotorLoad,
}

/// What a motor does in a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorLoad {
    /// RMS torque (N·m) over the motion, pauses with the torque that holds the machine.
    pub rms: f64,
    /// Largest torque (N·m) and speed (rad/s), as magnitudes.
    pub peaks: [f64; 2],
    /// Mean of the speed's magnitude (rad/s).
    pub mean_speed: f64,
    /// Torque at rest at the end (N·m), or where the motion rests last, as a magnitude.
    pub holding: f64,
    /// S1 torque (N·m) at the mean speed; infinite: not known.
    pub continuous: f64,
    /// What the RMS torque may be (N·m): that S1 torque without what a reserve leaves unused.
    pub allowed: f64,
    /// Pause (s) that must be added for the RMS torque to be no larger than that; `None`: not even holding is possible.
    pub pause: Option<f64>,
}

/// Makes every move of a motion as fast as possible.
///
/// # Errors
/// A move, counted from 0, that cannot be made.
pub fn cycle(
    file: &MachineFile,
    actuator: &Actuator,
    limits: Limits,
    rms: Option<Rms>,
    parts: &[Part],
) -> Result<Cycle, (usize, NoMotion)> {
    let steps = parts.iter().filter_map(Part::step);
    let ways = steps.map(|(step, _)| [step.from, step.to]);
    let slow = slowest(file, actuator, ways).map_err(|why| (0, why.into()))?;
    let at = |asked: &mut Asked| at_price(file, actuator, &limits, parts, asked);
    let found = within(rms, slow, input(file), at).map_err(|why| match why {
        Refused::Move(why) => why,
        Refused::Limit(why) => (0, why),
    });
    found.map(|found| with_costs(file, actuator, found))
}

fn at_price(
    file: &MachineFile,
    actuator: &Actuator,
    limits: &Limits,
    parts: &[Part],
    asked: &mut Asked,
) -> Result<Cycle, (usize, NoMotion)> {
    let start = parts.first().map_or(0.0, Part::from);
    let coordinate = Way::new(file, actuator.clone(), 1.0).coordinate();
    let mut trace = Trace::from_rest(coordinate, start);
    let mut moves = Vec::new();
    let mut dwells = 0.0;
    let mut kept = Vec::new();
    for part in parts {
        match part {
            Part::Dwell { duration, .. } => {
                trace.dwell(*duration);
                dwells += duration;
            }
            Part::Kept(part) => {
                let part = KeptPart::new(file, actuator, limits, part);
                let part = part.map_err(|why| (moves.len(), why.into()))?;
                trace.then(part.kept.nodes());
                kept.push(part);
            }
            Part::Move(step) | Part::Passing(step, _) => {
                let Passing { speeds, .. } = part.step().map(|(_, ends)| ends).unwrap_or_default();
                let task = Task {
                    from: step.from,
                    to: step.to,
                    speeds,
                    limits: *limits,
                    endless: false,
                };
                let made = make(
                    file,
                    actuator,
                    &task,
                    Some(step.duration),
                    asked,
                    moves.len(),
                )
                .map_err(|why| (moves.len(), why))?;
                trace.then(made.fastest.trace.nodes());
                moves.push(made);
            }
        }
    }
    let load =
        load(file, actuator, &trace, limits.reserve.rms).map_err(|error| (0, error.into()))?;
    Ok(Cycle {
        moves,
        trace,
        before: Some(parts.iter().map(Part::duration).sum()),
        dwells,
        kept,
        load,
    })
}

/// One move, which need not begin or end at rest.
///
/// # Errors
/// It cannot be made.
pub fn single(
    file: &MachineFile,
    actuator: &Actuator,
    task: Task,
    rms: Option<Rms>,
) -> Result<Cycle, NoMotion> {
    let at = |asked: &mut Asked| -> Result<Cycle, NoMotion> {
        let made = make(file, actuator, &task, None, asked, 0)?;
        let trace = made.fastest.trace.clone();
        Ok(Cycle {
            load: load(file, actuator, &trace, task.limits.reserve.rms)?,
            moves: vec![made],
            trace,
            before: None,
            dwells: 0.0,
            kept: Vec::new(),
        })
    };
    let slow = slowest(file, actuator, [[task.from, task.to]])?;
    let found = within(rms, slow, input(file), at).map_err(|why| match why {
        Refused::Move(why) | Refused::Limit(why) => why,
    });
    found.map(|found| with_costs(file, actuator, found))
}

/// A motion that turns for ever, of the given period, as fast as possible; without limits of rates and of the RMS torque.
///
/// # Errors
/// It cannot be made.
pub fn endless(
    file: &MachineFile,
    actuator: &Actuator,
    limits: Limits,
    step: &Move,
) -> Result<Cycle, NoMotion> {
    let task = Task {
        from: step.from,
        to: step.to,
        speeds: [0.0; 2],
        limits,
        endless: true,
    };
    let mut made = make(
        file,
        actuator,
        &task,
        Some(step.duration),
        &mut Asked::default(),
        0,
    )?;
    let trace = made.fastest.trace.clone();
    let speed = trace.nodes().first().map_or(0.0, |node| node.omega.abs());
    let priced = false;
    made.costs = costs(file, actuator, &made, priced);
    made.task.speeds = [speed; 2];
    Ok(Cycle {
        load: load(file, actuator, &trace, limits.reserve.rms)?,
        moves: vec![made],
        trace,
        before: Some(step.duration),
        dwells: 0.0,
        kept: Vec::new(),
    })
}

/// The move of this number; what its limits cost is not known yet.
fn make(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    before: Option<f64>,
    asked: &mut Asked,
    number: usize,
) -> Result<Made, NoMotion> {
    let fastest = match asked.price {
        None => solve(file, actuator, task)?,
        Some(price) => {
            let (fastest, warm) = priced(file, actuator, task, price, asked.start(number))?;
            asked.keep(number, warm);
            fastest
        }
    };
    Ok(Made {
        costs: Vec::new(),
        task: *task,
        before,
        fastest,
    })
}

/// With what the limits cost each move.
fn with_costs(
    file: &MachineFile,
    actuator: &Actuator,
    (mut cycle, priced): (Cycle, bool),
) -> Cycle {
    for made in &mut cycle.moves {
        made.costs = costs(file, actuator, made, priced);
    }
    cycle
}

fn costs(file: &MachineFile, actuator: &Actuator, made: &Made, priced: bool) -> Vec<Cost> {
    let mut met: Vec<Binding> = Vec::new();
    for phase in &made.fastest.phases {
        // Driving and braking are one motor.
        let limit = match phase.limit {
            Binding::Braking => Binding::Driving,
            other => other,
        };
        if !met.contains(&limit) {
            met.push(limit);
        }
    }
    if priced {
        // The price of the torque is that of the whole cycle: what another limit costs is not known without it.
        met.retain(|limit| *limit == Binding::RmsTorque);
    }
    let cost = |limit: Binding| {
        let (actuator, limits) = without(actuator, &made.task.limits, limit);
        let eased = Task {
            limits,
            ..made.task
        };
        // Where no motion is found the limit is not what it costs time.
        let time = super::time(file, &actuator, &eased).ok()?;
        Some(Cost { limit, time })
    };
    met.into_iter().filter_map(cost).collect()
}

/// The same without a limit, or with more of the motor's own.
fn without(actuator: &Actuator, limits: &Limits, limit: Binding) -> (Actuator, Limits) {
    let mut actuator = actuator.clone();
    let mut limits = *limits;
    match limit {
        Binding::Driving | Binding::Braking => {
            // A tenth more torque moves a machine that asks for a tenth less.
            for c in &mut actuator.coefficients.0 {
                *c /= 1.0 + MORE;
            }
        }
        Binding::MotorSpeed => actuator.ratio /= 1.0 + MORE,
        Binding::GearboxTorque => limits.gearbox_torque = None,
        Binding::GearboxSpeed => limits.gearbox_speed = None,
        Binding::Speed => limits.speed = None,
        Binding::ToolSpeed => limits.tool = ToolSpeeds::default(),
        Binding::Acceleration => limits.acceleration = None,
        Binding::Deceleration => limits.deceleration = None,
        Binding::JointForce(joint) => limits.forces = limits.forces.without(joint),
        Binding::Jerk => limits.jerk = None,
        Binding::TorqueRate => limits.torque_rate = None,
        // Those of the whole cycle, which no move keeps alone.
        Binding::RmsTorque | Binding::WindingTemperature => {}
    }
    limits.level_ends &= limits.has_rates();
    (actuator, limits)
}

/// What the motor does in a motion, of whose S1 torque a share stays unused.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub fn load(
    file: &MachineFile,
    actuator: &Actuator,
    trace: &Trace,
    reserve: f64,
) -> Result<MotorLoad, Error> {
    let ways = BothWays::new(file, actuator);
    let forwards = ways.forwards();
    let (mut squares, mut turns) = (0.0, 0.0);
    let mut peaks = [0.0_f64; 2];
    for pair in trace.nodes().windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let (step, heading) = (b.step, b.phi - a.phi);
        if step <= 0.0 {
            continue;
        }
        for share in GAUSS {
            let motor = ways.torque(&b.after(a, share), heading)?;
            squares += 0.5 * step * motor * motor;
        }
        turns += heading.abs();
        for (node, alpha) in [(a, a.alpha[1]), (b, b.alpha[0])] {
            let Node { phi, omega, .. } = *node;
            let motor = ways.torque(&State { phi, omega, alpha }, heading)?;
            peaks[0] = peaks[0].max(motor.abs());
            peaks[1] = peaks[1].max(forwards.motor_speed(node.omega.abs()));
        }
    }
    let duration = trace.duration();
    // Of a motion that does not end at rest, where it rests before.
    let mut backwards = trace.nodes().iter().rev();
    let rest = backwards.find(|node| node.omega == 0.0);
    let end = rest.or(trace.nodes().last()).map_or(0.0, |node| node.phi);
    let holding = forwards.holding(&forwards.place_at_rest(end)?).abs();
    let mean_speed = forwards.motor_speed(turns) / duration;
    // At the largest speed all the time rounding must not step beyond.
    let continuous =
        (actuator.envelope).continuous_torque(mean_speed.min(actuator.envelope.max_speed()));
    let allowed = continuous * (1.0 - reserve);
    let excess = squares - allowed * allowed * duration;
    let relief = allowed * allowed - holding * holding;
    let pause = if excess <= 0.0 || !allowed.is_finite() {
        Some(0.0)
    } else {
        (relief > 0.0).then(|| excess / relief)
    };
    Ok(MotorLoad {
        rms: (squares / duration).sqrt(),
        peaks,
        mean_speed,
        holding,
        continuous,
        allowed,
        pause,
    })
}
