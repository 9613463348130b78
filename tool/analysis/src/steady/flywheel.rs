//! The flywheel for a coefficient of speed fluctuation, exactly and by the classical method.

use std::cell::Cell;

use jred::mechanism::Stage;
use schemars::JsonSchema;
use serde::Serialize;

use super::SteadyError;
use super::aim::{CycleOutcome, CycleSearch, Guess, Scaling};
use super::cycle::{self, Cycle, CycleResult};
use super::figures::{self, MotorTorque, SteadyFigures};
use super::turn::TurningMachine;
use crate::simulate::run::SIGN_SPEED;
use jred_file::model::machine::{MachineFile, ReductionCache};
use jred_file::model::simulation::Shaft;
use jred_file::number::numerics;

/// The largest flywheel that is tried (kg·m²).
const LARGEST: f64 = 1e8;

/// The flywheel for a coefficient of speed fluctuation.
#[derive(Debug)]
pub struct Flywheel {
    /// Requested δ.
    pub delta: f64,
    /// Inertia to add on the drive link (kg·m²); 0: none is needed.
    pub inertia: f64,
    /// Inertia at the motor's shaft for the same δ (kg·m²), where the motor drives the machine through stages.
    pub inertia_at_motor: Option<f64>,
    /// The shafts on which it can sit, from the motor to the drive link: the latter alone if the motor acts there, or none is needed.
    pub places: Vec<ShaftFlywheel>,
    /// The classical estimate.
    pub classical: Classical,
    /// The cycle with it.
    pub cycle: Cycle,
}

/// A shaft of the drive train, and the flywheel on it, or why none there makes the fluctuation this small.
#[derive(Debug)]
pub struct ShaftFlywheel {
    /// The stage that the shaft drives, counted from 0; the number of stages means the drive link.
    pub shaft: usize,
    /// The flywheel.
    pub wheel: Option<Wheel>,
    /// Why no flywheel here makes the fluctuation this small.
    pub no_flywheel: Option<SteadyError>,
}

/// A flywheel on one of the shafts.
///
/// Its energy reaches the machine through the stages behind it, with their losses, so that the inertia is not that on the
/// drive link divided by the squared ratio, unless the train has no losses.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Wheel {
    /// Inertia for δ (kg·m²).
    pub inertia: f64,
    /// Mean speed of the shaft (rad/s), by magnitude.
    #[serde(rename = "mean_speed")]
    pub speed: f64,
    /// Kinetic energy of the flywheel at its mean speed (J).
    #[serde(rename = "kinetic_energy")]
    pub stored: f64,
    /// Largest torque that each stage delivers to the shaft behind it over the turn (N·m), by magnitude.
    #[serde(rename = "largest_torque_delivered_by_stage")]
    pub delivered: Vec<f64>,
    /// Motor torque over the cycle (N·m).
    pub motor_torque: MotorTorque,
    /// Losses in a cycle (J).
    pub losses: f64,
}

/// The flywheel by Wittenbauer's method: constant motor torque, energies at the constant mean speed.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Classical {
    /// ΔW: difference between the largest and the least excess of the work at the drive link over that of the machine (J).
    pub work: f64,
    /// The constant speed (rad/s).
    pub speed: f64,
    /// ΔW/(δ·ω²) (kg·m²): the required total inertia.
    pub total: f64,
    /// Existing inertia: the mean of J over the angle (kg·m²), with drive train and rotor.
    pub own: f64,
    /// Inertia of the flywheel, at least 0 (kg·m²).
    pub inertia: f64,
}

impl Flywheel {
    pub(super) fn of(
        turning: &TurningMachine,
        search: &CycleSearch,
        own: Option<&Cycle>,
        guess: Option<Guess>,
        delta: f64,
        positions: usize,
    ) -> Result<Self, SteadyError> {
        let first = turning.machines.first;
        let stages = first.drive_train.stages();
        let task = FlywheelSearch {
            turning,
            search,
            own,
            delta,
            guess: Cell::new(guess),
        };
        let even = own.is_some_and(|cycle| cycle.figures.delta <= delta);
        let inertia = match own {
            _ if even => 0.0,
            Some(cycle) => {
                let speed = cycle.figures.mean_speed.abs();
                task.inertia(stages.len(), Classical::of(turning, delta, speed)?.inertia)?
            }
            None => task.inertia(stages.len(), 0.0)?,
        };
        let (cycle, last) = task.with(stages.len(), inertia, |with, begin, held| {
            let cycle = Cycle::at(with, begin, held, positions)?;
            let last = Wheel::of(with, stages.len(), inertia, &cycle.figures)?;
            Ok((cycle, last))
        })?;
        let mut places = Vec::new();
        if search.simulation.at == Shaft::Motor && inertia > 0.0 {
            for shaft in 0..stages.len() {
                let behind = stages.iter().skip(shaft);
                let ratio: f64 = behind.map(Stage::ratio).product();
                let there = task.inertia(shaft, inertia / (ratio * ratio));
                let wheel = there.and_then(|there| {
                    task.with(shaft, there, |with, begin, _| {
                        Wheel::of(with, shaft, there, &SteadyFigures::of(with, begin, 1)?)
                    })
                });
                places.push(ShaftFlywheel::new(shaft, wheel));
            }
        }
        places.push(ShaftFlywheel::new(stages.len(), Ok(last)));
        let at_motor = places.first().filter(|_| places.len() > 1);
        let at_motor = at_motor.and_then(|place| place.wheel.as_ref());
        Ok(Self {
            delta,
            inertia,
            inertia_at_motor: at_motor.map(|wheel| wheel.inertia),
            classical: Classical::of(turning, delta, cycle.figures.mean_speed.abs())?,
            cycle,
            places,
        })
    }
}

impl ShaftFlywheel {
    fn new(shaft: usize, wheel: Result<Wheel, SteadyError>) -> Self {
        let (wheel, no_flywheel) = match wheel {
            Ok(wheel) => (Some(wheel), None),
            Err(why) => (None, Some(why)),
        };
        Self {
            shaft,
            wheel,
            no_flywheel,
        }
    }
}

impl Wheel {
    fn of(
        turning: &TurningMachine,
        shaft: usize,
        inertia: f64,
        figures: &SteadyFigures,
    ) -> Result<Self, SteadyError> {
        let stages = turning.machines.first.drive_train.stages();
        let behind = stages.iter().skip(shaft);
        let ratio: f64 = behind.map(Stage::ratio).product();
        let speed = (figures.mean_speed * ratio).abs();
        let mut delivered = vec![0.0f64; stages.len()];
        for (x, y) in figures.nodes.iter().filter(|_| !stages.is_empty()) {
            let omega = (2.0 * y[0]).sqrt();
            let alpha = turning.instant(*x, omega)?.alpha;
            let state = [turning.at(*x), turning.direction * omega, alpha];
            let now = turning.plant.delivered(&turning.moment(), state)?;
            for (most, now) in delivered.iter_mut().zip(now) {
                *most = most.max(now.abs());
            }
        }
        Ok(Self {
            inertia,
            speed,
            delivered,
            motor_torque: figures.motor_torque,
            losses: figures.energy.losses,
            stored: 0.5 * inertia * speed * speed,
        })
    }
}

/// The search for a flywheel on one of the shafts.
struct FlywheelSearch<'a> {
    turning: &'a TurningMachine<'a>,
    search: &'a CycleSearch<'a>,
    /// The cycle without it.
    own: Option<&'a Cycle>,
    delta: f64,
    /// Start of the previous cycle.
    guess: Cell<Option<Guess>>,
}

impl FlywheelSearch<'_> {
    /// Calls `ask` with the cycle for a flywheel of this inertia on a shaft; an error if the machine stops.
    fn with<T>(
        &self,
        shaft: usize,
        inertia: f64,
        ask: impl FnOnce(&TurningMachine, f64, Option<Scaling>) -> Result<T, SteadyError>,
    ) -> Result<T, SteadyError> {
        self.among(shaft, inertia, |with, ended| match ended.found {
            CycleResult::Cycle(begin) => ask(with, begin, ended.held),
            CycleResult::Loses(from) => Err(cycle::standstill(with, from)?),
        })
    }

    fn among<T>(
        &self,
        shaft: usize,
        inertia: f64,
        ask: impl FnOnce(&TurningMachine, CycleOutcome) -> Result<T, SteadyError>,
    ) -> Result<T, SteadyError> {
        let machines = &self.turning.machines;
        let file = with_flywheel(machines.first, shaft, inertia)?;
        let machines = machines.with_first(&file);
        self.search
            .with(&machines, self.guess.get(), |with, ended| {
                self.guess.set(ended.guess.or(self.guess.get()));
                ask(with, ended)
            })
    }

    /// Excess of 1/δ of the machine with this flywheel over the requested one.
    fn evenness(&self, shaft: usize, inertia: f64) -> Result<f64, SteadyError> {
        // A machine that stops has no evenness.
        let none = -1.0 / self.delta;
        let found = self.among(shaft, inertia, |with, ended| match ended.found {
            CycleResult::Cycle(begin) => Ok(1.0 / figures::delta(with, begin)? + none),
            CycleResult::Loses(_) => Ok(none),
        });
        match found {
            Err(why) if why.is_standstill() => Ok(none),
            found => found,
        }
    }

    /// The inertia with the requested evenness, found near a guess, if the machine without a flywheel lacks it. 1/δ grows nearly with the inertia.
    fn inertia(&self, shaft: usize, guess: f64) -> Result<f64, SteadyError> {
        let [own, _] = self.turning.plant.inertia(self.turning.at(0.0))?;
        let without = self.own.map_or(0.0, |cycle| 1.0 / cycle.figures.delta);
        let lacking = without - 1.0 / self.delta;
        let (mut low, mut at_low) = (0.0, lacking);
        let mut high = if guess > 0.0 { 1.1 * guess } else { own };
        loop {
            let at_high = self.evenness(shaft, high)?;
            if at_high >= 0.0 {
                let evenness = |inertia: f64| self.evenness(shaft, inertia);
                let found = numerics::zero(evenness, [low, high], [at_low, at_high], 1e-13)?;
                return self.running(shaft, found);
            }
            if high >= LARGEST {
                let runs = at_high > -1.0 / self.delta;
                return Err(SteadyError::NoFlywheel {
                    delta: self.delta,
                    inertia: high,
                    reached: runs.then(|| 1.0 / (at_high + 1.0 / self.delta)),
                    torque: self.turning.keeping(SIGN_SPEED)?.abs(),
                });
            }
            (low, at_low) = (high, at_high);
            high = (high * 30.0).min(LARGEST);
        }
    }
}

impl FlywheelSearch<'_> {
    /// A slightly larger flywheel with which the machine completes a turn, where it may just stop with this one.
    fn running(&self, shaft: usize, inertia: f64) -> Result<f64, SteadyError> {
        let mut more = 1e-12;
        let mut with = inertia;
        while more < 1.0 && self.evenness(shaft, with)? <= -1.0 / self.delta {
            with = inertia * (1.0 + more);
            more *= 8.0;
        }
        Ok(with)
    }
}

/// The machine with a flywheel on the shaft that drives a stage, or after the last one on the drive link.
fn with_flywheel(
    file: &MachineFile,
    shaft: usize,
    inertia: f64,
) -> Result<MachineFile, SteadyError> {
    let mut file = file.clone();
    if shaft < file.drive_train.stages().len() {
        file.drive_train = file.drive_train.with_flywheel(shaft, inertia)?;
    } else {
        file.machine = file.machine.with_flywheel(inertia)?;
    }
    file.over_range = ReductionCache::default();
    Ok(file)
}

impl Classical {
    /// The estimate at constant `speed` (rad/s).
    fn of(turning: &TurningMachine, delta: f64, speed: f64) -> Result<Self, SteadyError> {
        let plant = &turning.plant;
        // Torque at the drive link that keeps the speed, in the direction of motion. The train's loss of a constant motor torque is constant, and no
        // flywheel stores it.
        let asked = |x: f64| -> Result<f64, SteadyError> {
            let state = [turning.at(x), turning.direction * speed];
            Ok(plant.resisting(&turning.moment(), state.into())? * turning.direction)
        };
        let places = turning.places(720);
        let size = turning.largest(&places, speed, asked)?;
        let work = |from: f64, to: f64| numerics::integral(asked, [from, to], 1, 1e-12 * size);
        let mut works = vec![0.0];
        for pair in places.windows(2) {
            let before = works.last().copied().unwrap_or(0.0);
            works.push(before + work(pair[0].0, pair[1].0)?);
        }
        let mean = works.last().copied().unwrap_or(0.0) / turning.span();
        let excess = |x: f64, work: f64| mean * x - work;
        let mut ends = [0.0f64; 2];
        for (k, pair) in places.windows(2).enumerate() {
            let [from, to] = [pair[0].0, pair[1].0];
            let mut seen = vec![excess(to, works[k + 1])];
            let above = |x: f64| -> Result<bool, SteadyError> { Ok(asked(x)? > mean) };
            let first = above(from)?;
            if first != above(to)? {
                let x = numerics::edge(|x| Ok::<_, SteadyError>(above(x)? == first), from, to)?;
                seen.push(excess(x, works[k] + work(from, x)?));
            }
            for value in seen {
                ends = [ends[0].min(value), ends[1].max(value)];
            }
        }
        let inertia = |x: f64| -> Result<f64, SteadyError> { Ok(plant.inertia(turning.at(x))?[0]) };
        let [at_start, _] = plant.inertia(turning.at(0.0))?;
        let span = turning.span();
        let own =
            numerics::integral(inertia, [0.0, span], 96 * turning.turns, 1e-11 * at_start)? / span;
        let total = (ends[1] - ends[0]) / (delta * speed * speed);
        Ok(Self {
            work: ends[1] - ends[0],
            speed,
            total,
            own,
            inertia: (total - own).max(0.0),
        })
    }
}
