//! Makes all moves of a motion as fast as possible and keeps its pauses.

use jred::error::Error;
use jred_file::model::machine::MachineFile;

use super::costs::costs;
pub use super::costs::{Cost, MORE};
use super::field::MoveLimits;
use super::kept::KeptPart;
pub use super::motor_load::MotorLoad;
use super::motor_load::load;
use super::obstacle::input;
use super::rms::{Continuation, Rms, RmsError, slowest, within};
use super::{Fastest, NoMotion, Task, priced, solve};
use crate::moves::{EndStates, Move, Part};
use crate::path_dynamics::{Actuator, PathDynamics};
use crate::trace::Trace;

/// A move made as fast as possible.
#[derive(Clone, Debug)]
pub struct FastestMove {
    /// The task.
    pub task: Task,
    /// Time of the move in the given motion (s); `None`: it was not part of one.
    pub before: Option<f64>,
    /// The fastest motion.
    pub fastest: Fastest,
    /// The cost of each limit that it reaches.
    pub costs: Vec<Cost>,
}

/// A motion whose moves are as fast as possible.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The moves.
    pub moves: Vec<FastestMove>,
    /// The whole motion.
    pub trace: Trace,
    /// Duration of the given motion (s).
    pub before: Option<f64>,
    /// Time at rest (s).
    pub dwells: f64,
    /// The parts that were kept.
    pub kept: Vec<KeptPart>,
    /// The load of the motor.
    pub load: MotorLoad,
    /// Whether a limit of the RMS torque takes time.
    pub priced: bool,
}

impl Cycle {
    /// With the cost of the limits for each move.
    #[must_use]
    pub fn with_costs(mut self, file: &MachineFile, actuator: &Actuator) -> Self {
        for made in &mut self.moves {
            let mut all = costs(file, actuator, made, self.priced);
            all.append(&mut made.costs);
            made.costs = all;
        }
        self
    }

    /// A single move.
    fn of_one(file: &MachineFile, actuator: &Actuator, made: FastestMove) -> Result<Self, Error> {
        let trace = made.fastest.trace.clone();
        Ok(Self {
            load: load(file, actuator, &trace, &made.task.limits.reserve)?,
            before: made.before,
            moves: vec![made],
            trace,
            dwells: 0.0,
            kept: Vec::new(),
            priced: false,
        })
    }

    /// The same cycle, with the flag whether a limit of the RMS torque takes time.
    fn priced((cycle, priced): (Self, bool)) -> Self {
        Self { priced, ..cycle }
    }
}

/// Makes every move of a motion as fast as possible, without the cost of its limits.
///
/// # Errors
/// The index of a move that cannot be made, counted from 0.
pub fn cycle(
    file: &MachineFile,
    actuator: &Actuator,
    limits: MoveLimits,
    rms: Option<Rms>,
    parts: &[Part],
) -> Result<Cycle, (usize, NoMotion)> {
    let steps = parts.iter().filter_map(Part::step);
    let ways = steps.map(|(step, _)| [step.from, step.to]);
    let slow = slowest(file, actuator, ways).map_err(|why| (0, why.into()))?;
    let at = |asked: &mut Continuation| at_price(file, actuator, &limits, parts, asked);
    let found = within(rms, slow, input(file), at).map_err(|why| match why {
        RmsError::Move(why) => why,
        RmsError::Limit(why) => (0, why),
    });
    found.map(Cycle::priced)
}

fn at_price(
    file: &MachineFile,
    actuator: &Actuator,
    limits: &MoveLimits,
    parts: &[Part],
    asked: &mut Continuation,
) -> Result<Cycle, (usize, NoMotion)> {
    let start = parts.first().map_or(0.0, Part::from);
    let coordinate = PathDynamics::new(file, actuator.clone(), 1.0).coordinate();
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
                let EndStates { speeds, .. } =
                    part.step().map(|(_, ends)| ends).unwrap_or_default();
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
    let load = load(file, actuator, &trace, &limits.reserve).map_err(|error| (0, error.into()))?;
    Ok(Cycle {
        moves,
        trace,
        before: Some(parts.iter().map(Part::duration).sum()),
        dwells,
        kept,
        load,
        priced: false,
    })
}

/// One move, which need not begin or end at rest.
///
/// # Errors
/// The move cannot be made.
pub fn single(
    file: &MachineFile,
    actuator: &Actuator,
    task: Task,
    rms: Option<Rms>,
) -> Result<Cycle, NoMotion> {
    let at = |asked: &mut Continuation| -> Result<Cycle, NoMotion> {
        let made = make(file, actuator, &task, None, asked, 0)?;
        Ok(Cycle::of_one(file, actuator, made)?)
    };
    let slow = slowest(file, actuator, [[task.from, task.to]])?;
    let found = within(rms, slow, input(file), at).map_err(|why| match why {
        RmsError::Move(why) | RmsError::Limit(why) => why,
    });
    found.map(Cycle::priced)
}

/// An endlessly turning motion of the given period, made as fast as possible, without limits of rates and of the RMS torque.
///
/// # Errors
/// The motion cannot be made.
pub fn endless(
    file: &MachineFile,
    actuator: &Actuator,
    limits: MoveLimits,
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
        &mut Continuation::default(),
        0,
    )?;
    let first = made.fastest.trace.nodes().first();
    made.task.speeds = [first.map_or(0.0, |node| node.omega.abs()); 2];
    Ok(Cycle::of_one(file, actuator, made)?)
}

/// The move with this index, without the cost of its limits.
fn make(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    before: Option<f64>,
    asked: &mut Continuation,
    number: usize,
) -> Result<FastestMove, NoMotion> {
    let fastest = match asked.price {
        None => solve(file, actuator, task)?,
        Some(price) => {
            let (fastest, warm) = priced(file, actuator, task, price, asked.start(number))?;
            asked.keep(number, warm);
            fastest
        }
    };
    Ok(FastestMove {
        costs: Vec::new(),
        task: *task,
        before,
        fastest,
    })
}
