//! Moves as fast as limits of speed, acceleration and jerk allow: constant jerk in at most seven phases, constant acceleration in at
//! most three.

use jred::machine::motion::Polynomial;

use super::Phase;

/// Limits of a move (SI, all greater than zero).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveLimits {
    /// Largest speed.
    pub speed: f64,
    /// Largest acceleration while the speed grows.
    pub acceleration: f64,
    /// Largest deceleration.
    pub deceleration: f64,
    /// Largest jerk; `None`: the acceleration may jump.
    pub jerk: Option<f64>,
}

/// A move that is too short to change the speed within its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooShort {
    /// The distance that the change takes.
    pub least: f64,
}

/// A change of speed as fast as possible: the acceleration rises in `ramp`, is constant for `hold`, falls in `ramp` (s).
#[derive(Clone, Copy, Debug)]
struct SpeedChange {
    from: f64,
    to: f64,
    ramp: f64,
    hold: f64,
    /// The largest acceleration, with its sign.
    acceleration: f64,
}

impl SpeedChange {
    fn new(from: f64, to: f64, limits: &MoveLimits) -> Self {
        let most = if to.abs() >= from.abs() {
            limits.acceleration
        } else {
            limits.deceleration
        };
        let size = (to - from).abs();
        let (ramp, hold) = match limits.jerk {
            None => (0.0, size / most),
            Some(jerk) if size * jerk >= most * most => (most / jerk, size / most - most / jerk),
            Some(jerk) => ((size / jerk).sqrt(), 0.0),
        };
        let acceleration = limits.jerk.filter(|_| hold == 0.0);
        let acceleration = acceleration.map_or(most, |jerk| jerk * ramp);
        Self {
            from,
            to,
            ramp,
            hold,
            acceleration: acceleration.copysign(to - from),
        }
    }

    fn duration(&self) -> f64 {
        2.0 * self.ramp + self.hold
    }

    /// The speed is symmetric about the middle of the change.
    fn distance(&self) -> f64 {
        0.5 * (self.from + self.to) * self.duration()
    }

    fn phases(&self, phases: &mut Vec<Phase>) {
        let a = self.acceleration;
        let jerk = if self.ramp > 0.0 { a / self.ramp } else { 0.0 };
        let step = 0.5 * a * self.ramp;
        for (duration, state) in [
            (self.ramp, [self.from, 0.0, jerk]),
            (self.hold, [self.from + step, a, 0.0]),
            (self.ramp, [self.to - step, a, -jerk]),
        ] {
            push(phases, duration, state);
        }
    }
}

fn push(phases: &mut Vec<Phase>, duration: f64, state: [f64; 3]) {
    if duration > 0.0 {
        phases.push(Phase {
            duration,
            polynomial: Polynomial::constant_jerk(state),
        });
    }
}

/// Changes the speed from one to the other as fast as the limits allow; also returns the distance.
pub fn change(speeds: [f64; 2], limits: &MoveLimits) -> (f64, Vec<Phase>) {
    let change = SpeedChange::new(speeds[0], speeds[1], limits);
    let mut phases = Vec::new();
    change.phases(&mut phases);
    (change.distance(), phases)
}

/// Moves over `distance` (not zero) as fast as the limits allow, between two speeds in its direction within the limit. At both ends the acceleration
/// is zero, or jumps if the jerk is not limited. The speed does not fall below the slower of the two.
///
/// # Errors
/// The distance is too short for the change of speed.
pub fn fastest(
    distance: f64,
    speeds: [f64; 2],
    limits: &MoveLimits,
) -> Result<Vec<Phase>, TooShort> {
    let way = distance.abs();
    let [first, last] = speeds.map(|v| (v * distance.signum()).max(0.0));
    // Up to the speed `top` and down again, without constant speed.
    let through = |top: f64| {
        [
            SpeedChange::new(first, top, limits),
            SpeedChange::new(top, last, limits),
        ]
    };
    let way_through = |top: f64| through(top).iter().map(SpeedChange::distance).sum::<f64>();
    let lowest = first.max(last);
    let least = way_through(lowest);
    if least > way * (1.0 + 4.0 * f64::EPSILON) {
        return Err(TooShort {
            least: least.copysign(distance),
        });
    }
    let top = if way_through(limits.speed) <= way {
        limits.speed
    } else {
        highest(way_through, way, [lowest, limits.speed])
    };
    let [up, down] = through(top);
    let stay = ((way - up.distance() - down.distance()) / top).max(0.0);
    // The remainder of the search for the highest speed is rounding, not constant speed.
    let stay = if top < limits.speed { 0.0 } else { stay };
    let mut phases = Vec::with_capacity(7);
    up.phases(&mut phases);
    push(&mut phases, stay, [top, 0.0, 0.0]);
    down.phases(&mut phases);
    if distance < 0.0 {
        for phase in &mut phases {
            let [_, v, a, j] = phase.polynomial.at(0.0);
            phase.polynomial = Polynomial::constant_jerk([-v, -a, -j]);
        }
    }
    Ok(phases)
}

/// The speed with the given distance, which grows with the speed. Bisection to the last bit, for any combination of active limits.
fn highest(way_through: impl Fn(f64) -> f64, way: f64, [mut low, mut high]: [f64; 2]) -> f64 {
    loop {
        let middle = low.midpoint(high);
        if middle <= low || middle >= high {
            return low;
        }
        if way_through(middle) <= way {
            low = middle;
        } else {
            high = middle;
        }
    }
}
