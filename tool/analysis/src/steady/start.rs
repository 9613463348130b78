//! From rest to the steady cycle.

use schemars::JsonSchema;
use serde::Serialize;

use super::SteadyError;
use super::cycle::TorqueDeficit;
use super::figures::SteadyFigures;
use super::turn::{self, TurnEnd, TurningMachine};
use crate::simulate::run::SIGN_SPEED;

/// Parts of a turn after which the speed is compared with the cycle's.
const PARTS: usize = 24;

/// Relative difference of the speed that counts as reached.
const SPEED_TOLERANCE: f64 = 0.01;

/// Most turns of the simulation.
const MOST_TURNS: u32 = 300;

/// How the machine starts from rest.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "outcome", rename_all = "snake_case")]
pub enum Start {
    /// From then on the speed stays within 1 % of the cycle's at the same position for a turn.
    Reached {
        /// Time from rest (s), to a 24th of a turn.
        time: f64,
        /// Turns from rest.
        turns: f64,
    },
    /// It does not move, or stops again after some turns.
    Stuck {
        /// Turns from rest.
        turns: f64,
        /// Where, and how much torque is missing.
        #[serde(flatten)]
        missing: TorqueDeficit,
    },
    /// It takes more turns than are simulated.
    Slow {
        /// Simulated turns.
        turns: f64,
        /// Their time (s).
        time: f64,
        /// Speed then as a share of the cycle's.
        share_of_speed: f64,
    },
}

impl Start {
    pub(super) fn of(turning: &TurningMachine, cycle: &SteadyFigures) -> Result<Self, SteadyError> {
        let parts = PARTS * cycle.turns as usize;
        let every = (cycle.nodes.len() / parts).max(1);
        let last = cycle.nodes.len() - 1;
        let nodes = cycle.nodes.iter().enumerate().skip(1);
        let places = nodes.filter(|(k, _)| *k == last || k % every == 0);
        let places: Vec<(f64, f64)> = places.map(|(_, (x, y))| (*x, y[0])).collect();
        let full = 0.5 * cycle.max_speed * cycle.max_speed;
        let alpha = turning.instant(0.0, SIGN_SPEED)?.alpha * turning.direction;
        if alpha <= 0.0 {
            return Ok(Self::Stuck {
                turns: 0.0,
                missing: TorqueDeficit::at(turning, 0.0)?,
            });
        }
        // The very first part of the path, with the acceleration at its start.
        let least = 2.0 * turn::STANDSTILL_ENERGY * full;
        let first = (least / alpha).min(0.5 * places[0].0);
        let mut y = turn::starting((2.0 * (alpha * first).max(least)).sqrt());
        y[1] = (2.0 * first / alpha).sqrt();
        let mut x = first;
        let mut near: Option<[f64; 2]> = None;
        let mut near_for = 0;
        let mut share = 0.0;
        let turns = f64::from(cycle.turns);
        let cycles = MOST_TURNS / cycle.turns;
        for turn in 0..cycles {
            for (to, z) in &places {
                let speed = cycle.max_speed;
                match turning.advance_by(turn::ROUGH, y, [x, *to], speed, &mut |_, _| ())? {
                    TurnEnd::End(end) => y = end,
                    TurnEnd::Stopped(at) => {
                        return Ok(Self::Stuck {
                            turns: turns * f64::from(turn) + at / std::f64::consts::TAU,
                            missing: TorqueDeficit::at(turning, at)?,
                        });
                    }
                }
                x = *to;
                share = (y[0] / z).sqrt();
                if (share - 1.0).abs() > SPEED_TOLERANCE {
                    near = None;
                    continue;
                }
                let turns = turns * f64::from(turn) + x / std::f64::consts::TAU;
                let [time, since] = *near.get_or_insert_with(|| {
                    near_for = 0;
                    [y[1], turns]
                });
                near_for += 1;
                if near_for > places.len() {
                    return Ok(Self::Reached { time, turns: since });
                }
            }
            x = 0.0;
        }
        Ok(Self::Slow {
            turns: f64::from(cycles) * turns,
            time: y[1],
            share_of_speed: share,
        })
    }
}
