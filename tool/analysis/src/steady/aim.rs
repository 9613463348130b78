//! The aim of a steady cycle: the given motor, or a mean speed for which the motor or a load is scaled.

use jred::machine::{Action, Load};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::SteadyError;
use super::cycle::{self, CycleResult};
use super::turn::{TurnEnd, TurningMachine};
use crate::simulate::CoupledMachines;
use jred_file::model::characteristic::Characteristic;
use jred_file::model::machine::{MachineFile, ReductionCache};
use jred_file::model::motor::OwnMotor;
use jred_file::model::simulation::Simulation;
use jred_file::number::numerics;

/// A prescribed mean speed of the drive link.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanSpeed {
    /// Mean over time (rad/s); its sign is the direction of rotation.
    pub speed: f64,
    /// The quantity that is scaled for it.
    pub by: Level,
}

/// The quantity that is scaled for a mean speed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Level {
    /// The torque of the motor (or of the brake or generator that it then is) at every speed.
    Motor,
    /// The loads of this name.
    Load(String),
}

/// The scaling that gives a mean speed.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Scaling {
    /// The load that is scaled; none: the motor torque.
    #[serde(rename = "scaled", serialize_with = "Level::serialize_load")]
    #[schemars(with = "Option<String>")]
    pub by: Level,
    /// Factor on the torque of the motor, or on the load.
    pub factor: f64,
    /// The torque of a motor whose torque is constant (N·m).
    #[serde(rename = "constant_torque")]
    pub torque: Option<f64>,
}

/// The search for cycles of a machine, with different flywheels.
pub(super) struct CycleSearch<'a> {
    pub(super) simulation: &'a Simulation,
    pub(super) motor: OwnMotor<'a>,
    pub(super) direction: f64,
    pub(super) turns: u32,
    pub(super) mean_speed: Option<&'a MeanSpeed>,
}

/// A speed at the start of the cycle (rad/s), and a factor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    pub(super) begin: f64,
    factor: f64,
}

/// A cycle, or the reason for its absence.
pub(super) struct CycleOutcome {
    pub(super) found: CycleResult,
    pub(super) held: Option<Scaling>,
    pub(super) guess: Option<Guess>,
}

impl CycleSearch<'_> {
    /// Finds the cycle of these machines, near a guess, and calls `ask` with it.
    pub(super) fn with<T>(
        &self,
        machines: &CoupledMachines,
        guess: Option<Guess>,
        ask: impl FnOnce(&TurningMachine, CycleOutcome) -> Result<T, SteadyError>,
    ) -> Result<T, SteadyError> {
        let Some(aim) = self.mean_speed else {
            let turning = self.turning(machines, self.motor)?;
            let found = cycle::near(&turning, guess.map(|guess| guess.begin))?;
            let guess = match found {
                CycleResult::Cycle(begin) => Some(Guess { begin, factor: 1.0 }),
                CycleResult::Loses(_) => None,
            };
            let held = None;
            return ask(&turning, CycleOutcome { found, held, guess });
        };
        let target = aim.speed.abs();
        let start = guess.map_or(target, |guess| guess.begin);
        // The mean speed grows with the speed at the start of the cycle.
        let mut factor = guess.map(|guess| guess.factor);
        let mut excess = |begin: f64| -> Result<f64, SteadyError> {
            let (own, mean) = self.level(machines, &aim.by, begin, factor)?;
            factor = Some(own);
            Ok(mean / target - 1.0)
        };
        let mut last = (start, excess(start)?);
        let mut ends = None;
        for _ in 0..MOST_TRIALS {
            if last.1 == 0.0 {
                ends = Some([last; 2]);
                break;
            }
            // Slightly beyond the proportional guess.
            let beyond = 1.0 - OVER * last.1.signum();
            let next = last.0 / (1.0 + last.1) * beyond;
            let next = (next, excess(next)?);
            if next.1 * last.1 <= 0.0 {
                ends = Some([last, next]);
                break;
            }
            last = next;
        }
        let Some([a, b]) = ends else {
            return Err(no_level(&aim.by, aim.speed));
        };
        let begin = if a.0.total_cmp(&b.0).is_eq() {
            a.0
        } else {
            let excess = std::cell::RefCell::new(excess);
            let value = |begin: f64| (excess.borrow_mut())(begin);
            numerics::zero(value, [a.0, b.0], [a.1, b.1], 1e-15)?
        };
        let (factor, _) = self.level(machines, &aim.by, begin, factor)?;
        self.scaled(machines, &aim.by, factor, |turning| {
            let constant = match turning.plant.motor.characteristic {
                Characteristic::Points(points) if points.len() == 1 => points.first(),
                _ => None,
            };
            let held = Scaling {
                by: aim.by.clone(),
                factor,
                torque: constant.map(|(_, torque)| *torque),
            };
            let ended = CycleOutcome {
                found: CycleResult::Cycle(begin),
                held: Some(held),
                guess: Some(Guess { begin, factor }),
            };
            ask(turning, ended)
        })
    }

    fn turning<'t>(
        &'t self,
        machines: &CoupledMachines<'t>,
        motor: OwnMotor<'t>,
    ) -> Result<TurningMachine<'t>, SteadyError> {
        let (direction, turns) = (self.direction, self.turns);
        Ok(TurningMachine::new(
            machines,
            self.simulation,
            motor,
            direction,
            turns,
        )?)
    }

    /// The machines with the motor or a load scaled.
    fn scaled<T>(
        &self,
        machines: &CoupledMachines,
        by: &Level,
        factor: f64,
        ask: impl FnOnce(&TurningMachine) -> Result<T, SteadyError>,
    ) -> Result<T, SteadyError> {
        match by {
            Level::Motor => {
                let characteristic = self.motor.characteristic.scaled(factor);
                let motor = OwnMotor {
                    characteristic: &characteristic,
                    ..self.motor
                };
                ask(&self.turning(machines, motor)?)
            }
            Level::Load(name) => {
                let file = with_load(machines.first, name, factor)?;
                let machines = machines.with_first(&file);
                ask(&self.turning(&machines, self.motor)?)
            }
        }
    }

    /// The factor with which a cycle ends at its start speed, near a guess, and its mean speed.
    fn level(
        &self,
        machines: &CoupledMachines,
        by: &Level,
        begin: f64,
        guess: Option<f64>,
    ) -> Result<(f64, f64), SteadyError> {
        let rise = |factor: f64| self.scaled(machines, by, factor, |turning| turning.rise(begin));
        let guess = match guess {
            Some(guess) => guess,
            None => self.by_work(machines, by, begin)?,
        };
        let first = rise(guess)?;
        let mut factor = guess;
        if first != 0.0 {
            let least = if let Level::Load(_) = by {
                0.0
            } else {
                f64::NEG_INFINITY
            };
            let mut reach = if guess == 0.0 {
                1e-3
            } else {
                1e-3 * guess.abs()
            };
            let mut found = None;
            for _ in 0..MOST_DOUBLINGS {
                for side in [1.0, -1.0] {
                    let at = (guess + side * reach).max(least);
                    let here = rise(at)?;
                    if here * first <= 0.0 {
                        found = Some((at, here));
                        break;
                    }
                }
                if found.is_some() {
                    break;
                }
                reach *= 4.0;
            }
            let Some((other, there)) = found else {
                return Err(no_level(by, self.direction * begin));
            };
            factor = numerics::zero(rise, [guess, other], [first, there], 1e-15)?;
        }
        let mean = self.scaled(machines, by, factor, |turning| {
            match turning.turn(begin)? {
                TurnEnd::End([_, period, ..]) => Ok(turning.span() / period),
                TurnEnd::Stopped(x) => Err(cycle::stuck(turning, x)?),
            }
        })?;
        Ok((factor, mean))
    }

    /// The factor from the work of a cycle at constant speed.
    fn by_work(
        &self,
        machines: &CoupledMachines,
        by: &Level,
        speed: f64,
    ) -> Result<f64, SteadyError> {
        let keeping =
            |factor: f64| self.scaled(machines, by, factor, |turning| turning.keeping(speed));
        let given = self.scaled(machines, by, 1.0, |turning| {
            let [torque, _] = turning.plant.motor(turning.direction * speed);
            Ok(torque * turning.sense())
        })?;
        let factor = match by {
            Level::Motor => keeping(1.0)? / given,
            Level::Load(_) => {
                let [without, with] = [keeping(0.0)?, keeping(1.0)?];
                ((given - without) / (with - without)).max(0.0)
            }
        };
        if factor.is_finite() {
            Ok(factor)
        } else {
            Err(no_level(by, self.direction * speed))
        }
    }
}

/// Most speeds that are tried for a mean speed, and the overshoot of each step.
const MOST_TRIALS: u32 = 40;
const OVER: f64 = 1e-3;

/// Most steps away from a guess of the factor, each four times as long as the last.
const MOST_DOUBLINGS: u32 = 30;

fn no_level(by: &Level, speed: f64) -> SteadyError {
    SteadyError::NoLevel {
        by: by.clone(),
        speed,
    }
}

impl Level {
    fn serialize_load<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Motor => serializer.serialize_none(),
            Self::Load(name) => serializer.serialize_some(name),
        }
    }
}

/// The machine with the loads of a name multiplied by a factor.
fn with_load(file: &MachineFile, name: &str, factor: f64) -> Result<MachineFile, SteadyError> {
    let mut file = file.clone();
    let mut found = false;
    for named in file.loads.iter_mut().filter(|named| named.name == name) {
        named.load = scaled(&named.load, factor)?;
        found = true;
    }
    if !found {
        return Err(SteadyError::NoLoad {
            name: name.to_owned(),
            names: file.loads.iter().map(|named| named.name.clone()).collect(),
        });
    }
    file.rebuild([], [])?;
    file.over_range = ReductionCache::default();
    Ok(file)
}

fn scaled(load: &Load, factor: f64) -> Result<Load, SteadyError> {
    let action = match load.action() {
        Action::Force(force) => Action::Force(force.map(|f| factor * f)),
        Action::Moment(moment) => Action::Moment(factor * moment),
        Action::OpposingForce(size) => Action::OpposingForce(factor * size),
        Action::OpposingMoment(size) => Action::OpposingMoment(factor * size),
        Action::ViscousForce(c) => Action::ViscousForce(factor * c),
        Action::ViscousMoment(c) => Action::ViscousMoment(factor * c),
    };
    let made = Load::new(load.link(), action)?.at(load.point())?;
    Ok(load.window().map_or(made, |window| made.within(window)))
}
