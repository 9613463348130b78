//! The duty type of a cycle by IEC 60034-1, from the operation of the motor in it.
//!
//! | type | the motor | detected here by |
//! |---|---|---|
//! | S1 | constant load | torque and speed constant |
//! | S2 | one run from cold | only if given in `[duty]` |
//! | S3 | runs and rests; starts do not count thermally | rests; at most 5 % of ∫T² dt while it accelerates |
//! | S4 | runs and rests; starts count | rests, no electric braking |
//! | S5 | the same with electric braking | rests, power flows back |
//! | S6 | runs continuously with and without load | speed constant, torque not |
//! | S7 | starts, runs and brakes without rest | stops or reverses without rest, power flows back |
//! | S8 | load and speed change without rest | the others |
//! | S9 | load and speed change irregularly | only if given in `[duty]` |

use std::fmt;

use crate::cycle::form::Coefficients;
use crate::cycle::{Cycle, LoadSample};

/// Features of the motor's operation in the cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a feature of its own"
)]
pub struct Features {
    /// Share of the time at standstill.
    pub rest: f64,
    /// Starts from rest per cycle, to more than a hundredth of the largest speed.
    pub starts: u32,
    /// Whether power flows back from the motor.
    pub braking: bool,
    /// Whether the speed is constant.
    pub constant_speed: bool,
    /// Whether the torque is constant.
    pub constant_torque: bool,
    /// Whether it stops for an instant or reverses.
    pub stops: bool,
    /// Share of the squared torque's integral that belongs to acceleration and deceleration.
    pub accelerating: f64,
}

/// The duty type and its reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DutyType {
    /// 1 to 9.
    pub number: u8,
    /// The features from which it follows.
    pub features: Features,
}

/// Largest variation of a value that counts as constant, as a share of its largest magnitude.
const CONSTANT: f64 = 1e-3;

/// A speed below this share of the largest one is a momentary stop.
const STOP: f64 = 1e-6;

/// Share of the exchanged energy below which returned energy is rounding.
const ROUNDING: f64 = 1e-9;

/// Share of the squared torque up to which starts do not count thermally.
const NEGLIGIBLE: f64 = 0.05;

/// The speed, as a share of the largest one, that a start from rest must exceed: a curve through recorded rows oscillates around its rests.
const START: f64 = 1e-2;

/// Number of rises of the speed from rest in a periodic cycle, counted from its fastest instant, where it moves.
fn starts(speeds: impl Iterator<Item = f64> + Clone) -> u32 {
    let sizes = speeds.map(f64::abs);
    let (first, largest) =
        sizes.clone().enumerate().fold(
            (0, 0.0),
            |most, own| if own.1 > most.1 { own } else { most },
        );
    let mut starts = 0;
    let mut resting = false;
    for size in sizes.clone().skip(first).chain(sizes.take(first + 1)) {
        if size == 0.0 {
            resting = true;
        } else if resting && size > START * largest {
            resting = false;
            starts += 1;
        }
    }
    starts
}

impl Features {
    /// Features of the motor of a drive.
    pub fn of(cycle: &Cycle, coefficients: &Coefficients, ratio: f64) -> Self {
        let samples = cycle.samples();
        let [mut slowest, mut fastest] = [f64::INFINITY, f64::NEG_INFINITY];
        let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
        let [mut rest, mut back, mut turned] = [0.0; 3];
        let [mut squares, mut accelerating] = [0.0; 2];
        for sample in samples {
            let torque = coefficients.torque(&sample.loads());
            let speed = sample.speed() * ratio;
            slowest = slowest.min(speed);
            fastest = fastest.max(speed);
            least = least.min(torque);
            most = most.max(torque);
            let still = speed == 0.0;
            let weight = sample.weight;
            rest += if still { weight } else { 0.0 };
            let power = torque * speed;
            back += weight * (-power).max(0.0);
            turned += weight * power.abs();
            squares += weight * torque * torque;
            if sample.loads()[0] != 0.0 {
                accelerating += weight * torque * torque;
            }
        }
        let constant = |low: f64, high: f64| high - low <= CONSTANT * high.abs().max(low.abs());
        let largest = fastest.abs().max(slowest.abs());
        let nearest = samples.iter().map(|s| (s.speed() * ratio).abs());
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        Self {
            rest: rest / cycle.duration(),
            starts: starts(samples.iter().map(LoadSample::speed)),
            braking: back > ROUNDING * turned,
            constant_speed: constant(slowest, fastest),
            constant_torque: constant(least, most),
            stops: slowest < 0.0 && fastest > 0.0 || nearest <= STOP * largest,
            accelerating: if squares > 0.0 {
                accelerating / squares
            } else {
                0.0
            },
        }
    }

    /// The type.
    pub fn duty_type(self) -> DutyType {
        let number = if self.rest > 0.0 && self.starts > 0 {
            if self.accelerating <= NEGLIGIBLE {
                3
            } else if self.braking {
                5
            } else {
                4
            }
        } else if self.constant_speed {
            if self.constant_torque { 1 } else { 6 }
        } else if self.stops && self.braking {
            7
        } else {
            8
        };
        DutyType {
            number,
            features: self,
        }
    }
}

impl fmt::Display for DutyType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Features {
            rest,
            starts,
            braking,
            ..
        } = self.features;
        let braking = if braking { "with" } else { "without" };
        match self.number {
            1 => write!(f, "duty type S1, constant load"),
            3 => write!(
                f,
                "duty type S3, at rest {:.0} % of the time, starts thermally negligible",
                100.0 * rest
            ),
            4 | 5 => {
                let starts = match starts {
                    1 => "a start".to_owned(),
                    n => format!("{n} starts"),
                };
                write!(
                    f,
                    "duty type S{}, {starts} per cycle, at rest {:.0} % of the time, {braking} electric braking",
                    self.number,
                    100.0 * rest
                )
            }
            6 => write!(f, "duty type S6, constant speed with changing load"),
            7 => write!(f, "duty type S7, starts and electric braking without rest"),
            _ => write!(
                f,
                "duty type S8, load and speed change without rest, {braking} electric braking"
            ),
        }
    }
}
