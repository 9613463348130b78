//! The steady cycle: the fixed point of a turn.

use jred_file::math;
use schemars::JsonSchema;
use serde::Serialize;

use super::SteadyError;
use super::aim::{CycleOutcome, Scaling};
use super::figures::SteadyFigures;
use super::start::Start;
use super::turn::{TurnEnd, TurningMachine};
use crate::simulate::run::SIGN_SPEED;
use jred_file::number::numerics;

/// Range of the drive link's speeds in the search (rad/s).
const FASTEST: f64 = 1e5;
const SLOWEST: f64 = 1e-3;

/// Share of the energy below which a rise has few significant digits.
const CANCELLATION: f64 = 1e-6;

/// Ratio of successive speeds.
const STEP: f64 = 1.25;

/// Most turns for which a machine is followed to standstill.
const MOST_TURNS: u32 = 2000;

/// A small relative change of speed or energy.
const SMALL_CHANGE: f64 = 1e-3;

/// The motion that repeats with every turn.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Cycle {
    /// Its figures and its course.
    #[serde(flatten)]
    pub figures: SteadyFigures,
    /// The scale of the motor or a load for a prescribed mean speed.
    #[serde(rename = "for_mean_speed")]
    pub held: Option<Scaling>,
    /// |E(end) − E(0)|/E(0).
    pub residual: f64,
    /// Remaining share of a small deviation of the energy after a cycle: below 1 the cycle is stable.
    pub left_over: f64,
    /// The lowest speed at the start of a cycle from which the machine comes to this cycle (rad/s); none: from every speed.
    #[serde(rename = "reached_from_speed")]
    pub caught_from: Option<f64>,
    /// The start from rest.
    pub start: Start,
}

impl Cycle {
    /// The cycle from a search result, or the reason for its absence.
    pub(super) fn of(
        turning: &TurningMachine,
        ended: CycleOutcome,
        positions: usize,
    ) -> Result<Self, SteadyError> {
        match ended.found {
            CycleResult::Cycle(begin) => Self::at(turning, begin, ended.held, positions),
            CycleResult::Loses(from) => Err(standstill(turning, from)?),
        }
    }

    /// The cycle that begins with this speed.
    pub(super) fn at(
        turning: &TurningMachine,
        begin: f64,
        held: Option<Scaling>,
        positions: usize,
    ) -> Result<Self, SteadyError> {
        let figures = SteadyFigures::of(turning, begin, positions)?;
        figures.check_contacts(turning)?;
        // E at the end as a function of E(0), both relative to the cycle's.
        let energy = |share: f64| -> Result<f64, SteadyError> {
            Ok(share * (1.0 + turning.rise(begin * share.sqrt())?))
        };
        Ok(Self {
            left_over: (energy(1.0 + SMALL_CHANGE)? - energy(1.0 - SMALL_CHANGE)?)
                / (2.0 * SMALL_CHANGE),
            residual: turning.rise(begin)?.abs(),
            caught_from: caught_from(turning, begin)?,
            start: Start::of(turning, &figures)?,
            held,
            figures,
        })
    }
}

/// The speeds to evaluate, falling, including those at which the motor's characteristic changes, with some on either side.
fn speeds(turning: &TurningMachine) -> Vec<f64> {
    let ratio = turning.plant.ratio() * turning.direction;
    let marks = turning
        .plant
        .motor
        .characteristic
        .marks()
        .into_iter()
        .map(|mark| mark / ratio);
    let mut marks: Vec<f64> = marks.filter(|m| (SLOWEST..FASTEST).contains(m)).collect();
    marks.sort_by(f64::total_cmp);
    let middles = marks.windows(2).map(|pair| pair[0].midpoint(pair[1]));
    let around = marks
        .iter()
        .flat_map(|m| [0.96 * m, 0.99 * m, *m, 1.01 * m]);
    let count = (math::ln(FASTEST / SLOWEST) / math::ln(STEP)) as i32;
    let grid = (0..=count).map(|k| FASTEST / STEP.powi(k));
    let mut all: Vec<f64> = grid.chain(middles).chain(around).collect();
    all.sort_by(|a, b| b.total_cmp(a));
    all
}

/// Result of the search for the fixed point.
pub(super) enum CycleResult {
    /// The speed at the start of the turn (rad/s) with which it also ends.
    Cycle(f64),
    /// A cycle loses energy at every speed; this is the lowest speed with which the machine still completes it.
    Loses(f64),
}

/// The fixed point with the highest speed, if there are several: it is the stable one.
fn search(turning: &TurningMachine) -> Result<CycleResult, SteadyError> {
    let speeds = speeds(turning);
    let mut above = None;
    let mut best: Option<(usize, f64)> = None;
    let mut comes_round = FASTEST;
    for (k, &at) in speeds.iter().enumerate() {
        let gain = turning.about_gain(at)?;
        match above {
            None if gain > 0.0 => {
                let [inertia, _] = turning.plant.inertia(turning.at(0.0))?;
                return Err(SteadyError::Surplus {
                    speed: at,
                    surplus: gain * 0.5 * inertia * at * at,
                });
            }
            Some((speed, lost)) if gain > 0.0 => {
                return between(turning, [at, speed], [gain, lost]).map(CycleResult::Cycle);
            }
            _ => {}
        }
        if gain > -1.0 {
            comes_round = at;
            let energy = gain * at * at;
            if best.is_none_or(|(_, most)| energy > most) {
                best = Some((k, energy));
            }
        }
        above = Some((at, gain));
    }
    // A narrow range of speeds with a surplus may lie between two evaluated speeds.
    if let Some((k, _)) = best {
        let [fast, slow] = [k.saturating_sub(1), (k + 1).min(speeds.len() - 1)].map(|k| speeds[k]);
        let found = numerics::least(|at| Ok::<_, SteadyError>(-turning.gain(at)?), slow, fast)?;
        let gain = turning.gain(found)?;
        if gain > 0.0 {
            let gains = [gain, turning.gain(fast)?];
            return between(turning, [found, fast], gains).map(CycleResult::Cycle);
        }
    }
    Ok(CycleResult::Loses(comes_round))
}

/// The speed in [low, high] with which a turn ends as it began. The gain is positive at the low speed and negative at the high one, or zero.
fn between(turning: &TurningMachine, ends: [f64; 2], gains: [f64; 2]) -> Result<f64, SteadyError> {
    if gains[1] == 0.0 {
        // The cycle itself, if a turn that begins faster loses energy.
        if turning.gain(ends[1] * (1.0 + SMALL_CHANGE))? < 0.0 {
            return Ok(ends[1]);
        }
        return Err(SteadyError::Indifferent(turning.direction * ends[1]));
    }
    let rises = [turning.rise(ends[0])?, turning.rise(ends[1])?];
    if rises[0] > CANCELLATION && rises[1] < -CANCELLATION {
        numerics::zero(|at| turning.rise(at), ends, rises, 1e-15)
    } else {
        // The work of a cycle is below the digits of the energy.
        numerics::zero(|at| turning.gain(at), ends, gains, 1e-15)
    }
}

/// The stable fixed point near a guess by the secant method, if that converges to it.
fn secant(turning: &TurningMachine, guess: f64) -> Result<Option<f64>, SteadyError> {
    let mut last = (guess, turning.gain(guess)?);
    let mut now = (guess * (1.0 + FIRST * last.1.signum()), 0.0);
    for _ in 0..MOST_SECANTS {
        now.1 = turning.gain(now.0)?;
        let slope = (now.1 - last.1) / (now.0 - last.0);
        if now.1 == 0.0 && slope < 0.0 {
            return Ok(Some(now.0));
        }
        let step = -now.1 / slope;
        if !(slope < 0.0 && step.abs() < MOST_AWAY * guess) {
            return Ok(None);
        }
        last = now;
        now.0 += step;
        if step.abs() <= 1e-15 * guess {
            return Ok(Some(now.0));
        }
    }
    Ok(None)
}

/// First step from a guess, most steps, and largest distance, as shares of the guess.
const FIRST: f64 = 1e-5;
const MOST_SECANTS: u32 = 10;
const MOST_AWAY: f64 = 0.1;

/// The fixed point near `guess`, otherwise by the full search.
pub(super) fn near(
    turning: &TurningMachine,
    guess: Option<f64>,
) -> Result<CycleResult, SteadyError> {
    if let Some(guess) = guess
        && let Some(begin) = secant(turning, guess)?
    {
        return Ok(CycleResult::Cycle(begin));
    }
    match search(turning) {
        // Loads that are far too large stop every motion almost at once.
        Err(SteadyError::Integrator) => Err(held_up(turning)?.unwrap_or(SteadyError::Integrator)),
        found => found,
    }
}

/// The lowest speed at the start of a turn from which the machine gains speed up to this cycle.
fn caught_from(turning: &TurningMachine, begin: f64) -> Result<Option<f64>, SteadyError> {
    let mut gains = begin;
    while gains > 1e-3 * begin {
        let next = gains / STEP;
        let lost = turning.about_gain(next)?;
        if lost <= 0.0 {
            let ends = [next, gains];
            let values = [lost, turning.about_gain(gains)?];
            // The cycle itself neither gains nor loses.
            if values[1] <= 0.0 {
                return Ok(Some(gains));
            }
            let found = numerics::zero(|at| turning.about_gain(at), ends, values, 1e-7)?;
            return Ok(Some(found));
        }
        gains = next;
    }
    Ok(None)
}

/// Follows a machine that loses speed with every turn to its standstill.
pub(super) fn standstill(turning: &TurningMachine, from: f64) -> Result<SteadyError, SteadyError> {
    let mut now = from;
    for _ in 0..MOST_TURNS {
        match turning.turn(now)? {
            TurnEnd::Stopped(x) => return stuck(turning, x),
            TurnEnd::End([z, ..]) => now = (2.0 * z).sqrt(),
        }
        if now < SLOWEST {
            break;
        }
    }
    Ok(SteadyError::Dying(turning.direction * now))
}

/// The missing torque at the place where the motor is weakest at rest; `None` if it can start the machine everywhere.
fn held_up(turning: &TurningMachine) -> Result<Option<SteadyError>, SteadyError> {
    let side = turning.plant.ratio().signum() * turning.direction;
    let mut worst: Option<TorqueDeficit> = None;
    for (x, _) in turning.places(360) {
        let here = TorqueDeficit::at(turning, x)?;
        let lacking = |missing: &TorqueDeficit| (missing.needed - missing.given) * side;
        if lacking(&here) > worst.as_ref().map_or(0.0, lacking) {
            worst = Some(here);
        }
    }
    Ok(worst.map(SteadyError::Stuck))
}

/// The missing torque at the place where the machine stopped.
pub(super) fn stuck(turning: &TurningMachine, x: f64) -> Result<SteadyError, SteadyError> {
    Ok(SteadyError::Stuck(TorqueDeficit::at(turning, x)?))
}

/// A place where the motor is too weak to start or keep the machine moving.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct TorqueDeficit {
    /// Position there (rad), within the cycle.
    #[serde(rename = "stuck_at")]
    pub phi: f64,
    /// Motor torque at rest (N·m).
    #[serde(rename = "torque_at_rest")]
    pub given: f64,
    /// Motor torque that the loads need there (N·m).
    #[serde(rename = "torque_needed")]
    pub needed: f64,
}

impl TorqueDeficit {
    pub(super) fn at(turning: &TurningMachine, x: f64) -> Result<Self, SteadyError> {
        let phi = turning.at(x).rem_euclid(turning.span());
        let state = [phi, turning.direction * SIGN_SPEED];
        Ok(Self {
            phi,
            given: turning.plant.motor(0.0)[0],
            needed: turning.plant.keeping(&turning.moment(), state.into())?,
        })
    }
}
