//! The shortest ramp of the rate with which a plan keeps the torque of its drive.
//!
//! A follower passes through the plan with ds/dt = r, so the speed is r·ω and the acceleration r²·α + ω·dr/dt. With a ramp of R seconds from 0 to 100
//! % the rate changes by 1/R per second, up or down. At a place and a rate the drive allows accelerations from a₋ to a₊, at the speed r·ω; so
//!
//! ```text
//! ω/R ≤ a₊(s, r·ω) − r²·α   and   ω/R ≤ r²·α − a₋(s, r·ω)
//! ```
//!
//! for every place s and every rate. 1/R is the least of both right sides divided by ω.

use jred::error::Error;
use jred_file::model::machine::MachineFile;

use crate::path_dynamics::{Actuator, PathDynamics};
use crate::trace::{Node, Trace};

/// Places per step, its ends included, and rates at which the change is evaluated.
const PLACES: u32 = 8;
const RATES: u32 = 48;

/// Rounds and halvings that refine the minimum.
const ROUNDS: u32 = 6;
const STEPS: u32 = 40;

/// Share of the greatest speed below which a change of the rate needs no acceleration.
const REST_SPEED: f64 = 1e-9;

/// Share of the greatest acceleration that counts as zero.
const ZERO_ACCELERATION: f64 = 1e-9;

/// A motion under a drive, for the allowed change of the rate at a place.
struct RateLimits<'a> {
    ways: [PathDynamics<'a>; 2],
    gearbox: Option<f64>,
    /// The greatest speed and acceleration.
    most: [f64; 2],
}

impl RateLimits<'_> {
    /// The greatest change of the rate (1/s), up or down, that the drive allows at a share of a step and a rate.
    fn change(&self, [a, b]: [&Node; 2], share: f64, rate: f64) -> Result<f64, Error> {
        let state = b.after(a, share);
        let speed = state.omega.abs();
        if speed <= REST_SPEED * self.most[0] {
            return Ok(f64::INFINITY);
        }
        let dynamics = &self.ways[usize::from(state.omega < 0.0)];
        let place = dynamics.place(state.phi)?;
        let v = rate * speed;
        let mut range = dynamics.accelerations(&place, v);
        if let Some(torque) = self.gearbox {
            let of_gearbox =
                [-torque, torque].map(|torque| dynamics.gearbox_acceleration(&place, v, torque));
            range = [range[0].max(of_gearbox[0]), range[1].min(of_gearbox[1])];
        }
        let acceleration = rate * rate * state.alpha * dynamics.direction;
        let left = (range[1] - acceleration).min(acceleration - range[0]);
        Ok(left / speed)
    }
}

/// The shortest ramp (s) from 0 to 100 % with which the motion keeps the torque of a drive and of its gearbox (N·m at its output) at every place and
/// rate; infinite if no ramp does. `None` if the drive has no torque limit.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub fn least_ramp(
    file: &MachineFile,
    actuator: &Actuator,
    gearbox: Option<f64>,
    trace: &Trace,
) -> Result<Option<f64>, Error> {
    if !actuator
        .torques(0.0)
        .iter()
        .all(|torque| torque.is_finite())
    {
        return Ok(None);
    }
    let nodes = trace.nodes();
    let most = |of: &dyn Fn(&Node) -> f64| nodes.iter().map(of).fold(0.0, f64::max);
    let motion = RateLimits {
        ways: [1.0, -1.0].map(|direction| PathDynamics::new(file, actuator.clone(), direction)),
        gearbox,
        most: [
            most(&|node| node.omega.abs()),
            most(&|node| node.alpha[0].abs().max(node.alpha[1].abs())),
        ],
    };
    let mut least = (f64::INFINITY, None);
    for step in trace.steps() {
        for k in 0..=PLACES {
            let share = f64::from(k) / f64::from(PLACES);
            for n in 1..=RATES {
                let rate = f64::from(n) / f64::from(RATES);
                let change = motion.change(step, share, rate)?;
                if change < least.0 {
                    least = (change, Some((step, [share, rate])));
                }
            }
        }
    }
    let Some((step, place)) = least.1 else {
        return Ok(Some(0.0));
    };
    let change = least.0.min(lowest(&motion, step, place)?);
    let [speed, acceleration] = motion.most;
    Ok(Some(
        if change * speed <= ZERO_ACCELERATION * acceleration {
            f64::INFINITY
        } else {
            1.0 / change
        },
    ))
}

/// The least change near a place and a rate of a step: by thirds along one, then the other.
fn lowest(motion: &RateLimits, step: [&Node; 2], place: [f64; 2]) -> Result<f64, Error> {
    let mut place = place;
    let mut wide = [1.0 / f64::from(PLACES), 1.0 / f64::from(RATES)];
    let mut least = motion.change(step, place[0], place[1])?;
    for _ in 0..ROUNDS {
        for along in [0, 1] {
            let [mut low, mut high] = [place[along] - wide[along], place[along] + wide[along]]
                .map(|at| at.clamp(0.0, 1.0));
            let at = |value: f64| {
                let mut place = place;
                place[along] = value;
                motion.change(step, place[0], place[1])
            };
            for _ in 0..STEPS {
                let third = (high - low) / 3.0;
                if at(low + third)? < at(high - third)? {
                    high -= third;
                } else {
                    low += third;
                }
            }
            let value = low.midpoint(high);
            let own = at(value)?;
            if own < least {
                (least, place[along]) = (own, value);
            }
        }
        wide = wide.map(|wide| 0.5 * wide);
    }
    Ok(least)
}
