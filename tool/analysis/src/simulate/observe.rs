//! The motor during a simulation, and its observers.

use crate::simulate::result::{Effort, FollowingError, TorqueLimit};
use jred_file::number::columns::Column;
use jred_file::number::numerics;

/// Number of evaluations of the motor per step of the integrator.
pub(super) const PARTS: u32 = 4;

/// The motor at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorState {
    /// Position of the drive link (rad, or m).
    pub phi: f64,
    /// Speed of the motor (rad/s).
    pub speed: f64,
    /// Its torque (N·m).
    pub torque: f64,
    /// The torque requested by a controller; without a controller, its torque.
    pub asked: f64,
    /// Torque at the input of the drive train, behind the motor's gearbox (N·m). At rest, where friction takes an unknown share, the whole motor
    /// torque.
    pub input_torque: f64,
    /// Reference less position (rad, or m), under a controller.
    pub error: Option<f64>,
}

impl MotorState {
    /// Whether it gives less than requested.
    pub fn is_limited(&self) -> bool {
        self.torque.total_cmp(&self.asked).is_ne()
    }
}

/// The motor at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorPoint {
    /// The time (s).
    pub t: f64,
    /// The motor.
    pub motor: MotorState,
}

/// Follows a motor through a simulation, piece by piece, and adds columns to its rows.
pub trait Observer {
    /// The columns.
    fn columns(&self) -> Vec<Column>;

    /// A piece so short that everything is nearly linear.
    fn pass(&mut self, from: MotorPoint, to: MotorPoint);

    /// The figures at the end of the last piece, as many as columns; `now` is the motor's state there.
    fn figures(&self, now: &MotorState) -> Vec<f64>;
}

/// No observer.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }
    fn pass(&mut self, _: MotorPoint, _: MotorPoint) {}
    fn figures(&self, _: &MotorState) -> Vec<f64> {
        Vec::new()
    }
}

/// Sums of the motor's effort, step by step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EffortSums {
    torque: [f64; 2],
    power: [f64; 2],
    speed: [f64; 2],
    /// ∫T² dt.
    squares: f64,
    time: f64,
}

impl EffortSums {
    /// A step of the integrator from its start, evaluated in equal parts.
    pub(super) fn pass(&mut self, [from, to]: [f64; 2], seen: &[MotorState; PARTS as usize + 1]) {
        let length = to - from;
        for (k, working) in seen.iter().enumerate() {
            let t = from + length * k as f64 / f64::from(PARTS);
            let most = |most: &mut [f64; 2], value: f64| {
                if value > most[0] {
                    *most = [value, t];
                }
            };
            most(&mut self.torque, working.torque.abs());
            most(&mut self.power, working.torque * working.speed);
            most(&mut self.speed, working.speed.abs());
        }
        // Boole's rule.
        let squares = seen.map(|working| working.torque * working.torque);
        let [a, b, c, d, e] = squares;
        self.squares += length / 90.0 * (7.0 * (a + e) + 32.0 * (b + d) + 12.0 * c);
        self.time += length;
    }

    /// The total; `None` if no time has passed.
    pub(super) fn effort(&self) -> Option<Effort> {
        (self.time > 0.0).then(|| Effort {
            torque: self.torque,
            rms: (self.squares / self.time).sqrt(),
            power: self.power,
            speed: self.speed,
        })
    }
}

/// Time of a controlled motor at its torque limit, and the following error of the machine.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ControlStatistics {
    pub(super) limit: Option<TorqueLimit>,
    pub(super) following: Option<FollowingError>,
    limited: bool,
}

impl ControlStatistics {
    /// A piece between two instants; `at` gives the states inside, by their share of it.
    pub(super) fn pass<E>(
        &mut self,
        from: MotorPoint,
        to: MotorPoint,
        at: impl Fn(f64) -> Result<MotorState, E>,
    ) -> Result<(), E> {
        self.follow(&from);
        self.follow(&to);
        let (share, limited) = match [from, to].map(|point| point.motor.is_limited()) {
            [false, false] => {
                self.limited = false;
                return Ok(());
            }
            [true, true] => ([0.0, 1.0], true),
            [false, true] => {
                let free = |share: f64| Ok(!at(share)?.is_limited());
                ([numerics::edge(free, 0.0, 1.0)?, 1.0], true)
            }
            [true, false] => {
                let limited = |share: f64| Ok(at(share)?.is_limited());
                ([0.0, numerics::edge(limited, 0.0, 1.0)?], false)
            }
        };
        let [begin, stop] = share.map(|share| from.t + share * (to.t - from.t));
        let again = self.limited && from.motor.is_limited();
        let phi = if share[0] > 0.0 {
            at(share[0])?.phi
        } else {
            from.motor.phi
        };
        let limit = self.limit.get_or_insert(TorqueLimit {
            time: begin,
            position: phi,
            count: 0,
            duration: 0.0,
        });
        limit.count += u32::from(!again);
        limit.duration += stop - begin;
        self.limited = limited;
        Ok(())
    }

    fn follow(&mut self, point: &MotorPoint) {
        let Some(error) = point.motor.error else {
            return;
        };
        let now = FollowingError {
            time: point.t,
            position: point.motor.phi,
            error,
        };
        let largest = self.following.get_or_insert(now);
        if error.abs() > largest.error.abs() {
            *largest = now;
        }
    }
}
