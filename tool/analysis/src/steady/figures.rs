//! The course of a steady cycle and its figures.

use schemars::JsonSchema;
use serde::Serialize;

use super::SteadyError;
use super::cycle;
use super::turn::{TurnEnd, TurnState, TurningMachine, starting};
use crate::simulate::Moment;
use crate::simulate::run::{Plant as _, Terms, Works, cells, heads};
use crate::simulate::watch::{LinkState, Watch};
use jred_file::number::columns::Columns;
use jred_file::number::numerics;

/// Fewest positions per turn at which the motion is evaluated.
const FEWEST: usize = 360;

/// Speeds at which the motor's characteristic is evaluated.
const SPEEDS: u32 = 256;

/// A turn of the steady motion.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SteadyFigures {
    /// Mean over the time, 2π·turns/period (rad/s); negative: the drive link turns clockwise.
    pub mean_speed: f64,
    /// Speed at the start of the cycle (rad/s), by magnitude.
    pub speed_at_start_of_turn: f64,
    /// Largest speed (rad/s), by magnitude.
    pub max_speed: f64,
    /// Its position (rad).
    pub max_speed_at: f64,
    /// Smallest speed (rad/s), by magnitude.
    pub min_speed: f64,
    /// Its position (rad).
    pub min_speed_at: f64,
    /// δ = (ω_max − ω_min)/ω_mean with the mean over the time.
    pub delta: f64,
    /// The same with the mean (ω_max + ω_min)/2.
    pub delta_of_extremes: f64,
    /// Turns of the drive link in a cycle.
    pub turns: u32,
    /// Duration of a cycle (s).
    pub period: f64,
    /// Largest minus least kinetic energy of all moving parts over a cycle (J).
    pub kinetic_energy_fluctuation: f64,
    /// Motor torque over the time (N·m).
    pub motor_torque: MotorTorque,
    /// Motor power (W).
    pub motor_power: MotorPower,
    /// Mean speed of the motor (rad/s).
    pub motor_speed: f64,
    /// Energies of a cycle (J).
    pub energy: Energies,
    /// The largest energy balance as a share of the energy turned over.
    pub imbalance: f64,
    /// The course over the time.
    #[serde(skip)]
    pub course: Columns,
    /// z = ½ω² at equal positions over the turn.
    #[serde(skip)]
    pub(super) nodes: Nodes,
}

/// Torque of the motor over a cycle (N·m).
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct MotorTorque {
    /// Mean over the time.
    pub mean: f64,
    /// Root of the mean square over the time.
    pub rms: f64,
    /// Largest magnitude.
    pub peak: f64,
}

/// Power of the motor over a cycle (W).
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct MotorPower {
    /// Mean over the time.
    pub mean: f64,
    /// Largest.
    pub peak: f64,
}

/// Energies of a cycle (J).
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Energies {
    /// Work of the motor.
    pub motor: f64,
    /// Work of the process loads; positive: they drive.
    pub process: f64,
    /// Losses of friction and drive train.
    pub losses: f64,
}

/// States over the position.
type Nodes = Vec<(f64, TurnState)>;

/// The nodes of a turn that begins with the speed `begin`, and the indices of those that are rows, at least `positions`.
fn integrated(
    turning: &TurningMachine,
    begin: f64,
    positions: usize,
) -> Result<(Nodes, Vec<usize>), SteadyError> {
    let finer = FEWEST.div_ceil(positions);
    let places = turning.places(positions * finer);
    let mut nodes = Nodes::with_capacity(places.len());
    let mut listed = Vec::new();
    let mut even = 0usize;
    for (x, part) in places {
        let y = match nodes.last() {
            None => starting(begin),
            Some((before, y)) => match turning.advance(*y, [*before, x], begin)? {
                TurnEnd::End(y) => y,
                // A fixed point just above a standstill is not a cycle.
                TurnEnd::Stopped(x) => return Err(cycle::stuck(turning, x)?),
            },
        };
        if part {
            if even.is_multiple_of(finer) {
                listed.push(nodes.len());
            }
            even += 1;
        }
        nodes.push((x, y));
    }
    Ok((nodes, listed))
}

impl SteadyFigures {
    /// The turn that begins with the speed `begin`, with at least `positions` rows.
    pub(super) fn of(
        turning: &TurningMachine,
        begin: f64,
        positions: usize,
    ) -> Result<Self, SteadyError> {
        let (nodes, listed) = integrated(turning, begin, positions)?;
        let fastest = extreme_speed(turning, &nodes, begin, 1.0)?;
        let slowest = extreme_speed(turning, &nodes, begin, -1.0)?;
        let Some((_, [_, period, motor, process, losses, torques, squares])) =
            nodes.last().copied()
        else {
            return Err(SteadyError::Integrator);
        };
        let plant = &turning.plant;
        let mean = turning.span() / period;
        let motor_speed = mean * turning.direction * plant.ratio();
        let span = [slowest[0], fastest[0]];
        let torque = |omega: f64| plant.motor(turning.direction * omega)[0];
        let power = |omega: f64| {
            let [torque, speed] = plant.motor(turning.direction * omega);
            torque * speed
        };
        let mut course = Columns::new(heads(plant.columns(), Terms::default()));
        let mut start = None;
        let (mut imbalance, mut turned_over) = (0.0f64, 0.0f64);
        let [most, least] = [1.0, -1.0].map(|side| extreme(turning, &nodes, begin, side, kinetic));
        let fluctuation = most?[0] - least?[0];
        let mut listed = listed.into_iter().peekable();
        for (k, (x, y)) in nodes.iter().enumerate() {
            if listed.next_if_eq(&k).is_none() {
                continue;
            }
            let omega = turning.direction * (2.0 * y[0]).sqrt();
            let state = [turning.at(*x), omega, y[2], y[3], y[4]];
            let row = plant.row(
                &Moment {
                    t: y[1],
                    ..turning.moment()
                },
                &state,
            )?;
            turned_over = turned_over.max(row.kinetic);
            let start = *start.get_or_insert(row.kinetic + row.potential);
            let works = Works {
                motor: y[2],
                brake: None,
                payloads: None,
                carriages: None,
                process: y[3],
                losses: y[4],
            };
            let (cells, balance) = cells(y[1], row, works, start);
            imbalance = imbalance.max(balance.abs());
            course.push(cells);
        }
        turned_over = [motor, process, losses]
            .iter()
            .fold(turned_over, |most, work| most.max(work.abs()));
        Ok(Self {
            mean_speed: turning.direction * mean,
            speed_at_start_of_turn: begin,
            max_speed: fastest[0],
            max_speed_at: turning.at(fastest[1]),
            min_speed: slowest[0],
            min_speed_at: turning.at(slowest[1]),
            delta: (fastest[0] - slowest[0]) / mean,
            delta_of_extremes: 2.0 * (fastest[0] - slowest[0]) / (fastest[0] + slowest[0]),
            turns: turning.turns,
            period,
            kinetic_energy_fluctuation: fluctuation,
            motor_torque: MotorTorque {
                mean: torques / period,
                rms: (squares / period).sqrt(),
                peak: largest(&|omega| torque(omega).abs(), span),
            },
            motor_power: MotorPower {
                mean: motor / period,
                peak: largest(&power, span),
            },
            motor_speed,
            energy: Energies {
                motor,
                process,
                losses,
            },
            imbalance: imbalance / turned_over,
            course,
            nodes,
        })
    }

    /// Refuses a cycle in which a follower leaves its cam or a rope is slack.
    pub(super) fn check_contacts(&self, turning: &TurningMachine) -> Result<(), SteadyError> {
        let watch = Watch::new(&turning.machines);
        if watch.is_idle() {
            return Ok(());
        }
        for (x, y) in &self.nodes {
            let speed = (2.0 * y[0]).sqrt();
            let alpha = turning.instant(*x, speed)?.alpha;
            let state = [turning.at(*x), turning.direction * speed, alpha];
            watch
                .check(LinkState {
                    moment: Moment {
                        t: y[1],
                        ..turning.moment()
                    },
                    state,
                })
                .map_err(SteadyError::Parted)?;
        }
        Ok(())
    }
}

/// δ of the cycle that begins with a speed, over the ends of the integrator's steps and the extremes between them.
pub(super) fn delta(turning: &TurningMachine, begin: f64) -> Result<f64, SteadyError> {
    let (reached, nodes) = turning.course(begin)?;
    let period = match reached {
        TurnEnd::End([_, period, ..]) => period,
        TurnEnd::Stopped(x) => return Err(cycle::stuck(turning, x)?),
    };
    let fastest = extreme_speed(turning, &nodes, begin, 1.0)?;
    let slowest = extreme_speed(turning, &nodes, begin, -1.0)?;
    Ok((fastest[0] - slowest[0]) * period / turning.span())
}

/// ½ω² at a place, and its slope along the path.
fn squares(turning: &TurningMachine, x: f64, z: f64) -> Result<[f64; 2], SteadyError> {
    let alpha = turning.instant(x, (2.0 * z).sqrt())?.alpha;
    Ok([z, alpha * turning.direction])
}

/// The kinetic energy ½Jω² of all moving parts (J), and its slope along the path.
fn kinetic(turning: &TurningMachine, x: f64, z: f64) -> Result<[f64; 2], SteadyError> {
    let [inertia, slope] = turning.plant.inertia(turning.at(x))?;
    let [_, along] = squares(turning, x, z)?;
    Ok([inertia * z, inertia * along + turning.direction * slope * z])
}

/// The largest (`side` = 1) or smallest (−1) speed, and its distance from the start of the cycle.
fn extreme_speed(
    turning: &TurningMachine,
    nodes: &[(f64, TurnState)],
    begin: f64,
    side: f64,
) -> Result<[f64; 2], SteadyError> {
    let [most, x] = extreme(turning, nodes, begin, side, squares)?;
    Ok([(2.0 * most).sqrt(), x])
}

/// The largest (`side` = 1) or smallest (−1) value of a quantity of the place and ½ω², given with its slope, and its distance from the start of the
/// cycle.
fn extreme(
    turning: &TurningMachine,
    nodes: &[(f64, TurnState)],
    begin: f64,
    side: f64,
    quantity: impl Fn(&TurningMachine, f64, f64) -> Result<[f64; 2], SteadyError>,
) -> Result<[f64; 2], SteadyError> {
    let of = |x: f64, z: f64| -> Result<[f64; 2], SteadyError> {
        Ok(quantity(turning, x, z)?.map(|value| side * value))
    };
    let known: Result<Vec<[f64; 2]>, SteadyError> =
        nodes.iter().map(|(x, y)| of(*x, y[0])).collect();
    let known = known?;
    let mut found = [f64::NEG_INFINITY, 0.0];
    for ((x, _), [value, _]) in nodes.iter().zip(&known) {
        if *value > found[0] {
            found = [*value, *x];
        }
    }
    for (pair, ends) in nodes.windows(2).zip(known.windows(2)) {
        let [from, to] = [pair[0], pair[1]];
        let z = |x: f64| -> Result<f64, SteadyError> {
            if x <= from.0 {
                return Ok(from.1[0]);
            }
            match turning.advance(from.1, [from.0, x], begin)? {
                TurnEnd::End(y) => Ok(y[0]),
                TurnEnd::Stopped(_) => Ok(0.0),
            }
        };
        let values = [ends[0][0], ends[1][0]];
        let slopes = [ends[0][1], ends[1][1]];
        let most = values[0].max(values[1]) + slopes[0].max(-slopes[1]) * (to.0 - from.0);
        if slopes[0] > 0.0 && slopes[1] <= 0.0 && most > found[0] {
            let x = numerics::zero(
                |x| Ok::<_, SteadyError>(of(x, z(x)?)?[1]),
                [from.0, to.0],
                slopes,
                1e-15,
            )?;
            let [there, _] = of(x, z(x)?)?;
            if there > found[0] {
                found = [there, x];
            }
        }
    }
    Ok([side * found[0], found[1]])
}

/// The largest value of `f` between two speeds.
fn largest(f: &dyn Fn(f64) -> f64, [low, high]: [f64; 2]) -> f64 {
    let step = (high - low) / f64::from(SPEEDS);
    let at = |k: u32| low + step * f64::from(k);
    let best = (0..=SPEEDS).max_by(|a, b| f(at(*a)).total_cmp(&f(at(*b))));
    let best = best.map_or(low, at);
    let negative = |speed: f64| Ok::<f64, std::convert::Infallible>(-f(speed));
    let around = [(best - step).max(low), (best + step).min(high)];
    let Ok(found) = numerics::least(negative, around[0], around[1]);
    f(found).max(f(best))
}
