//! The stop by the brake alone: the supply fails, the motor is without torque, and the brake closes after a delay. A drive that brakes the machine
//! is a brake without delay.
//!
//! ```text
//! until it closes   E ≤ E₀ + d·φ                      d: the largest torque with which the machine drives itself on
//! then              W = T_B·φ_B ≤ E + d·φ_B            so W ≤ E·T_B/(T_B − d), φ_B = W/T_B
//! ```
//!
//! E is the kinetic energy of machine and rotor. At the least inertia J of the motion the same energy gives the highest speed, ω = √(2·E/J), so the
//! machine travels at most as far as one of this constant inertia that d accelerates at d/J. The result is exact for constant inertia and weight, as
//! of a lift, and otherwise on the safe side. Friction and losses, which help, are ignored.

use crate::duty::Instant;

/// Motion in one direction at the input of the drive train.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct DirectionExtremes {
    /// Largest kinetic energy (J).
    energy: f64,
    /// Largest speed (rad/s).
    speed: f64,
    /// Largest torque that drives the machine (N·m), not negative.
    driving: f64,
}

/// States from which the brake may have to stop the machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunOn {
    ways: Vec<DirectionExtremes>,
    /// Least inertia at the input (kg·m²).
    inertia: f64,
}

/// A brake at the motor shaft, or the motor as a brake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorBrake {
    /// Torque while it slips (N·m).
    pub torque: f64,
    /// Time until it has that torque (s).
    pub time: f64,
    /// Inertia of rotor and gearbox at the motor shaft (kg·m²).
    pub inertia: f64,
    /// Ratio of the gearbox.
    pub ratio: f64,
}

/// A stop by the brake.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BrakeStop {
    /// Work of the brake (J); infinite if it does not hold the machine.
    pub work: f64,
    /// Speed at the input when the brake closes (rad/s).
    pub speed: f64,
    /// Travel at the input until the brake closes (rad).
    pub falling: f64,
    /// Travel at the input until standstill (rad).
    pub way: f64,
}

impl RunOn {
    /// The states of a motion whose drive train has this ratio (without sign); `held`: the largest holding torque at the input (N·m).
    pub(super) fn of(instants: &[Instant], ratio: f64, held: f64) -> Self {
        let inertia = instants.iter().map(|i| i.input_inertia);
        let inertia = inertia.fold(f64::INFINITY, f64::min);
        let way = |sign: f64| {
            let moving = instants.iter().filter(|i| i.omega * sign > 0.0);
            let mut way: Option<DirectionExtremes> = None;
            for instant in moving {
                let speed = instant.input_speed.abs();
                let energy = 0.5 * instant.input_inertia * speed * speed;
                let terms = &instant.terms;
                let driving = -(terms.potential + terms.process) * sign / ratio;
                let way = way.get_or_insert_default();
                way.energy = way.energy.max(energy);
                way.speed = way.speed.max(speed);
                way.driving = way.driving.max(driving);
            }
            way
        };
        let rest = DirectionExtremes {
            driving: held,
            ..DirectionExtremes::default()
        };
        let ways = [way(1.0), way(-1.0), Some(rest)];
        Self {
            ways: ways.into_iter().flatten().collect(),
            inertia,
        }
    }

    /// The most work and the longest travel of all stops.
    pub fn worst(&self, brake: &MotorBrake) -> BrakeStop {
        let mut worst = BrakeStop::default();
        for way in &self.ways {
            let found = self.stop(way, brake);
            worst.work = worst.work.max(found.work);
            worst.speed = worst.speed.max(found.speed);
            worst.falling = worst.falling.max(found.falling);
            worst.way = worst.way.max(found.way);
        }
        worst
    }

    /// The stop in one direction, at the input.
    fn stop(&self, way: &DirectionExtremes, brake: &MotorBrake) -> BrakeStop {
        let MotorBrake {
            torque,
            time,
            inertia: own,
            ratio,
        } = *brake;
        let own = own * ratio * ratio;
        let torque = torque * ratio;
        let inertia = self.inertia + own;
        let energy = way.energy + 0.5 * own * way.speed * way.speed;
        let speed = (2.0 * energy / inertia).sqrt();
        let rate = way.driving / inertia;
        let falling = (speed + 0.5 * rate * time) * time;
        let fast = speed + rate * time;
        let closed = 0.5 * inertia * fast * fast;
        if torque <= way.driving {
            let endless = if closed > 0.0 { f64::INFINITY } else { 0.0 };
            return BrakeStop {
                work: endless,
                speed: fast,
                falling,
                way: falling + endless,
            };
        }
        let work = closed * torque / (torque - way.driving);
        BrakeStop {
            work,
            speed: fast,
            falling,
            way: falling + work / torque,
        }
    }
}
