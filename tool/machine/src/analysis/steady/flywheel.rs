//! The flywheel that gives a coefficient of speed fluctuation, exactly and by the classical method.

use std::cell::Cell;
use std::f64::consts::TAU;

use super::SteadyError;
use super::cycle::{self, Cycle, Found};
use super::figures::Figures;
use super::turn::Turning;
use crate::model::machine::{MachineFile, OverRange};
use crate::model::simulation::Simulation;
use crate::number::numerics;
use crate::number::rounding::short;

/// The largest flywheel that is tried (kg·m²).
const LARGEST: f64 = 1e8;

/// The flywheel for a coefficient of speed fluctuation.
#[derive(Debug)]
pub struct Flywheel {
    /// δ asked for.
    pub delta: f64,
    /// Inertia to add on the drive link (kg·m²); 0: the machine runs as evenly without.
    pub inertia: f64,
    /// The same at the motor's shaft, divided by the squared ratio of the drive train.
    pub at_motor: f64,
    /// The cycle with it.
    pub cycle: Cycle,
    /// The classical estimate.
    pub classical: Classical,
}

/// The flywheel by Wittenbauer's method: constant motor torque, energies at the constant mean speed.
#[derive(Clone, Copy, Debug)]
pub struct Classical {
    /// ΔW: from the least to the largest excess of the work that reaches the drive link over that of the machine (J).
    pub work: f64,
    /// The constant speed (rad/s).
    pub speed: f64,
    /// ΔW/(δ·ω²) (kg·m²): what the machine must have in all.
    pub total: f64,
    /// Mean of J over the angle, which the machine has (kg·m²), with drive train and rotor.
    pub own: f64,
    /// What a flywheel would add, at least 0 (kg·m²).
    pub inertia: f64,
}

impl Flywheel {
    pub(super) fn of(
        turning: &Turning,
        simulation: &Simulation,
        own: Option<&Cycle>,
        delta: f64,
        positions: usize,
    ) -> Result<Self, SteadyError> {
        let guess = Cell::new(own.map(|cycle| cycle.figures.begin));
        let evenness = |inertia: f64| -> Result<f64, SteadyError> {
            let file = with_flywheel(turning.machines.first, inertia)?;
            let machines = turning.machines.with_first(&file);
            let turning = Turning::new(
                &machines,
                simulation,
                turning.plant.motor,
                turning.direction,
            )?;
            let Found::Cycle(begin) = cycle::near(&turning, guess.get())? else {
                // It stops: no evenness at all.
                return Ok(-1.0 / delta);
            };
            guess.set(Some(begin));
            Ok(1.0 / Figures::of(&turning, begin, 1)?.delta - 1.0 / delta)
        };
        let inertia = match own {
            Some(cycle) if cycle.figures.delta <= delta => 0.0,
            _ => {
                let classical = match own {
                    Some(cycle) => {
                        Classical::of(turning, delta, cycle.figures.mean_speed.abs())?.inertia
                    }
                    None => 0.0,
                };
                let lacking = own.map_or(-1.0 / delta, |cycle| {
                    1.0 / cycle.figures.delta - 1.0 / delta
                });
                Self::seek(turning, classical, [delta, lacking], &evenness)?
            }
        };
        let file = with_flywheel(turning.machines.first, inertia)?;
        let machines = turning.machines.with_first(&file);
        let with = Turning::new(
            &machines,
            simulation,
            turning.plant.motor,
            turning.direction,
        )?;
        let cycle = match cycle::near(&with, guess.get())? {
            Found::Cycle(begin) => Cycle::at(&with, begin, positions)?,
            Found::Loses(from) => return Err(cycle::standstill(&with, from)?),
        };
        let ratio = turning.machines.first.drive_train.ratio();
        Ok(Self {
            delta,
            inertia,
            at_motor: inertia / (ratio * ratio),
            classical: Classical::of(turning, delta, cycle.figures.mean_speed.abs())?,
            cycle,
        })
    }

    /// The inertia with which the evenness, lacking without a flywheel, is that asked for. 1/δ grows nearly with the inertia.
    fn seek(
        turning: &Turning,
        classical: f64,
        [delta, lacking]: [f64; 2],
        evenness: &impl Fn(f64) -> Result<f64, SteadyError>,
    ) -> Result<f64, SteadyError> {
        let [own, _] = turning.plant.inertia(turning.at(0.0))?;
        let (mut low, mut at_low) = (0.0, lacking);
        let mut high = if classical > 0.0 {
            1.1 * classical
        } else {
            own
        };
        loop {
            let at_high = evenness(high)?;
            if at_high >= 0.0 {
                return numerics::zero(evenness, [low, high], [at_low, at_high], 1e-13);
            }
            if high >= LARGEST {
                let why = if at_high <= -1.0 / delta {
                    "the machine stops".to_owned()
                } else {
                    format!("it is {}", short(1.0 / (at_high + 1.0 / delta)))
                };
                return Err(SteadyError::NoFlywheel {
                    delta: short(delta),
                    inertia: short(high),
                    why,
                });
            }
            (low, at_low) = (high, at_high);
            high = (high * 30.0).min(LARGEST);
        }
    }
}

fn with_flywheel(file: &MachineFile, inertia: f64) -> Result<MachineFile, SteadyError> {
    let mut file = file.clone();
    file.machine = file.machine.with_flywheel(inertia)?;
    file.over_range = OverRange::default();
    Ok(file)
}

impl Classical {
    /// At the constant `speed` (rad/s).
    fn of(turning: &Turning, delta: f64, speed: f64) -> Result<Self, SteadyError> {
        let plant = &turning.plant;
        // Torque at the drive link that keeps the speed, in the direction of motion. What the drive train loses of a constant motor
        // torque is constant, and no flywheel stores it.
        let asked = |x: f64| -> Result<f64, SteadyError> {
            let state = [turning.at(x), turning.direction * speed];
            Ok(plant.resisting(&turning.moment(), state)? * turning.direction)
        };
        let places = turning.places(720);
        let size = turning.effort(speed);
        let work = |from: f64, to: f64| numerics::integral(asked, [from, to], 1, 1e-12 * size);
        let mut works = vec![0.0];
        for pair in places.windows(2) {
            let before = works.last().copied().unwrap_or(0.0);
            works.push(before + work(pair[0].0, pair[1].0)?);
        }
        let mean = works.last().copied().unwrap_or(0.0) / TAU;
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
        let own = numerics::integral(inertia, [0.0, TAU], 96, 1e-11 * at_start)? / TAU;
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
