//! The motion caused by given torques, in fixed steps that conserve energy.

use crate::machine::error::PoseError;
use crate::machine::reducible::Reducible;
use crate::machine::reduction::Reduction;
use crate::math;
use crate::number::error::{RangeError, finite, positive};

/// A machine in free motion under a torque that is constant over each step.
///
/// Its state is the position φ, the direction, and the energy E = ½·J·ω² + U. A step changes E by the work of all torques not in U, and the speed
/// follows from E. Without torques and friction E stays exactly the same for any number of turns; a method that integrates the speed gains or loses a
/// little each turn. Over a step,
///
/// ```text
/// ½·J₁·ω₁² + U₁ = ½·J₀·ω₀² + U₀ + Q·(φ₁ − φ₀),   φ₁ − φ₀ = ½·h·(ω₀ + ω₁)
/// ```
///
/// with the mean torque Q of motor, process, viscous and Coulomb friction at both ends. The method is symmetric and of order 2: half the step gives a
/// quarter of the error in position and time (`tests/free_motion.rs`). Friction stops the machine within a step and keeps it at rest as long as it
/// can.
///
/// A step costs five to seven evaluations of [`Reducible::reduction`]: it is for a simulated machine behind a controller, on a host or on a core with
/// doubles, not for a tick.
///
/// ```
/// use jred::machine::{FreeMotion, Link, Machine};
/// use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
///
/// # fn main() -> Result<(), jred::error::Error> {
/// let dimensions = SliderCrankDimensions { crank: 0.03, rod: 0.18, offset: 0.0 };
/// let links = [Link::point_mass(0.5)?, Link::point_mass(0.7)?, Link::point_mass(4.0)?];
/// let machine = Machine::new(SliderCrank::new(dimensions, Branch::Right, links)?).with_flywheel(0.02)?;
/// let mut motion = FreeMotion::new(&machine, 0.0, 40.0)?;
/// let energy = motion.energy();
/// for _ in 0..1000 {
///     motion.advance(&machine, 0.0, 1e-3)?;
/// }
/// assert_eq!(motion.energy(), energy);
/// assert!(motion.phi() > 30.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeMotion {
    phi: f64,
    omega: f64,
    energy: f64,
    /// Rounding error of the sum of works.
    rounding: f64,
}

/// Iterations of Newton's method for the speed at the end of a step.
const ITERATIONS: u32 = 30;

/// A relative change of the speed after which the next change is rounding.
const ENOUGH: f64 = 1e-13;

/// A change that rounding of J and U may cause.
const ROUNDING: f64 = 1e-6;

/// For a shorter step (rad, or m) J and U change by their slopes: differences have no digits.
const SHORT: f64 = 1e-5;

/// Greatest number of stops and restarts of a machine in a step.
const RESTS: u32 = 4;

impl FreeMotion {
    /// A motion from a position (rad, or m) and a speed (rad/s, or m/s).
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn new(machine: &impl Reducible, phi: f64, omega: f64) -> Result<Self, PoseError> {
        let here = machine.reduction(phi)?;
        Ok(Self {
            phi,
            omega,
            energy: 0.5 * here.inertia * omega * omega + here.potential_energy,
            rounding: 0.0,
        })
    }

    /// φ (rad, or m).
    pub const fn phi(&self) -> f64 {
        self.phi
    }

    /// ω (rad/s, or m/s).
    pub const fn omega(&self) -> f64 {
        self.omega
    }

    /// E = ½·J·ω² + U (J).
    pub const fn energy(&self) -> f64 {
        self.energy
    }

    /// A step (s, positive) under a torque of the motor (N·m, or N) on the drive link.
    ///
    /// # Errors
    /// The mechanism cannot be placed where the motion leads; a step too long for the motion, in which the machine would turn through much of an
    /// oscillation. The state then stays unchanged.
    pub fn advance(
        &mut self,
        machine: &impl Reducible,
        torque: f64,
        step: f64,
    ) -> Result<(), PoseError> {
        finite("torque", torque)?;
        positive("step", step)?;
        let mut now = *self;
        let mut left = step;
        for _ in 0..RESTS {
            let here = machine.reduction(now.phi)?;
            let force = torque + here.load_torque();
            let direction = if now.omega == 0.0 {
                if math::abs(force) <= here.coulomb {
                    break;
                }
                math::sign(force)
            } else {
                math::sign(now.omega)
            };
            let next = now.step(machine, &here, [torque, direction], left)?;
            if here.coulomb == 0.0 || next.omega * direction >= 0.0 {
                now = next;
                break;
            }
            // Friction reverses with the speed: first the part up to rest, near which the speed falls linearly.
            let share = now.omega / (now.omega - next.omega);
            let rest = now.step(machine, &here, [torque, direction], share * left)?;
            now = Self::new(machine, rest.phi, 0.0)?;
            left *= 1.0 - share;
        }
        *self = now;
        Ok(())
    }

    /// A step in which friction keeps its direction.
    fn step(
        &self,
        machine: &impl Reducible,
        here: &Reduction,
        [torque, direction]: [f64; 2],
        step: f64,
    ) -> Result<Self, PoseError> {
        let push = |at: &Reduction, omega: f64| {
            torque + at.process - at.viscous * omega - at.coulomb * direction
        };
        let mut omega = self.omega;
        let mut before = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let way = 0.5 * step * (self.omega + omega);
            let there = machine.reduction(self.phi + way)?;
            let inertia = 0.5 * (here.inertia + there.inertia);
            // Slopes of J and U between both places, and their change with the place at the end.
            let short = math::abs(way) < SHORT;
            let [inertia_slope, potential_slope] = if short {
                [
                    0.5 * (here.inertia_slope + there.inertia_slope),
                    0.5 * (here.potential_slope + there.potential_slope),
                ]
            } else {
                [
                    (there.inertia - here.inertia) / way,
                    (there.potential_energy - here.potential_energy) / way,
                ]
            };
            let push = 0.5 * (push(here, self.omega) + push(&there, omega));
            let squares = self.omega * self.omega + omega * omega;
            let missing = inertia * (omega - self.omega) / step
                + 0.25 * inertia_slope * squares
                + potential_slope
                - push;
            let bends = if short {
                0.0
            } else {
                (0.25 * (there.inertia_slope - inertia_slope) * squares + there.potential_slope
                    - potential_slope)
                    * 0.5
                    * step
                    / way
            };
            let slope = inertia / step
                + 0.25 * there.inertia_slope * (omega - self.omega)
                + 0.5 * inertia_slope * omega
                + bends
                + 0.5 * there.viscous;
            let change = missing / slope;
            omega -= change;
            let size = math::abs(omega) + math::abs(self.omega);
            let change = math::abs(change);
            // Differences of J and U over a short way, far from 0, have few digits: no further convergence is possible.
            let stuck = change >= before && change <= ROUNDING * size;
            if change <= ENOUGH * size || stuck {
                return self.arrived(machine, omega, [step, push]);
            }
            before = change;
        }
        Err(RangeError::OutOfRange {
            what: "step",
            value: step,
            min: 0.0,
            max: 0.5 * step,
        }
        .into())
    }

    /// The state at the end of a step, with the speed from its energy.
    fn arrived(
        &self,
        machine: &impl Reducible,
        omega: f64,
        [step, push]: [f64; 2],
    ) -> Result<Self, PoseError> {
        let way = 0.5 * step * (self.omega + omega);
        let phi = self.phi + way;
        let there = machine.reduction(phi)?;
        // Compensated, so that small works accumulate.
        let work = push * way + self.rounding;
        let energy = self.energy + work;
        let kinetic = energy - there.potential_energy;
        let speed = if kinetic > 0.0 {
            math::sqrt(2.0 * kinetic / there.inertia)
        } else {
            0.0
        };
        Ok(Self {
            phi,
            omega: if omega < 0.0 { -speed } else { speed },
            energy,
            rounding: work - (energy - self.energy),
        })
    }
}
