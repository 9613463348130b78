//! The machine of the comparison: a slider-crank with λ = r/l = 0.25 whose reduced inertia varies by 5.25.
//!
//! ```text
//! x = r·cos φ + l·√(1 − λ²·sin²φ)    J = J₀ + m·x′²    ½·J′ = m·x′·x″    G = m·g·x′
//! torque:        T = J·α + ½·J′·ω² + G + b·ω + c·sgn ω
//! acceleration:  α = (T − ½·J′·ω²)/J        T: what is left of the motor's torque after the load
//! ```
//!
//! These closed forms are the reference. The library gets the mechanism, but not them.

use jred::mechanism::SliderCrankDimensions;
use std::f64::consts::TAU;

use jred::error::Error;
use jred::machine::{Action, Link, Load, Machine};
use jred::mechanism::{Branch, SliderCrank};

/// Crank radius r (m).
pub(crate) const RADIUS: f64 = 0.05;
/// λ = r/l.
pub(crate) const RATIO: f64 = 0.25;
/// Mass of the slider m (kg).
pub(crate) const MASS: f64 = 1.6;
/// Largest over smallest reduced inertia.
const VARIATION: f64 = 5.25;
/// Acceleration of gravity along the guide (m/s²): x points up.
const GRAVITY: f64 = 9.81;
/// Weight m·g (N).
pub(crate) const WEIGHT: f64 = MASS * GRAVITY;
/// b (N·m·s/rad).
pub(crate) const VISCOUS: f64 = 0.02;
/// c (N·m).
pub(crate) const COULOMB: f64 = 0.3;
/// Largest speed (rad/s).
pub(crate) const OMEGA: f64 = 60.0;
/// Largest acceleration (rad/s²).
pub(crate) const ALPHA: f64 = 3000.0;
/// Angles of a turn.
const ANGLES: usize = 64;

/// The curves at an angle.
pub(crate) struct Curves {
    /// J (kg·m²).
    pub(crate) inertia: f64,
    /// ½·J′ (kg·m²/rad).
    pub(crate) half_slope: f64,
    /// G (N·m).
    pub(crate) load: f64,
}

/// x′ and x″ (m/rad, m/rad²).
fn transfer(phi: f64) -> [f64; 2] {
    let (sin, cos) = phi.sin_cos();
    let root = (1.0 - (RATIO * sin).powi(2)).sqrt();
    let first = -RADIUS * (sin + RATIO * sin * cos / root);
    let second = -RADIUS
        * (cos
            + RATIO * (cos * cos - sin * sin) / root
            + RATIO.powi(3) * (sin * cos).powi(2) / root.powi(3));
    [first, second]
}

/// J₀ (kg·m²) for the specified variation of the inertia.
pub(crate) fn rotating() -> f64 {
    let steps = 100_000;
    let largest = (0..steps)
        .map(|k| transfer(f64::from(k) / f64::from(steps) * TAU)[0].powi(2))
        .fold(0.0, f64::max);
    MASS * largest / (VARIATION - 1.0)
}

/// The machine with its J₀.
pub(crate) struct Example {
    pub(crate) rotating: f64,
}

impl Example {
    pub(crate) fn new() -> Self {
        Self {
            rotating: rotating(),
        }
    }

    pub(crate) fn curves(&self, phi: f64) -> Curves {
        let [first, second] = transfer(phi);
        Curves {
            inertia: self.rotating + MASS * first * first,
            half_slope: MASS * first * second,
            load: WEIGHT * first,
        }
    }

    pub(crate) fn torque(&self, phi: f64, omega: f64, alpha: f64) -> f64 {
        let curves = self.curves(phi);
        let friction = if omega == 0.0 {
            0.0
        } else {
            COULOMB * omega.signum()
        };
        curves.inertia * alpha
            + curves.half_slope * omega * omega
            + curves.load
            + VISCOUS * omega
            + friction
    }

    pub(crate) fn acceleration(&self, phi: f64, omega: f64, torque: f64) -> f64 {
        let curves = self.curves(phi);
        (torque - curves.half_slope * omega * omega) / curves.inertia
    }

    /// The mechanism; with weight and the friction of the drive link, as loads of the crank.
    pub(crate) fn crank(&self, loaded: bool) -> Result<Machine<SliderCrank>, Error> {
        let links = [
            Link::rotor(self.rotating)?,
            Link::rotor(0.0)?,
            Link::point_mass(MASS)?,
        ];
        let mechanism = SliderCrank::new(
            SliderCrankDimensions {
                crank: RADIUS,
                rod: RADIUS / RATIO,
                offset: 0.0,
            },
            Branch::Right,
            links,
        )?;
        let machine = Machine::new(mechanism);
        if !loaded {
            return Ok(machine);
        }
        let viscous = Load::new(SliderCrank::CRANK, Action::ViscousMoment(VISCOUS))?;
        let coulomb = Load::new(SliderCrank::CRANK, Action::OpposingMoment(COULOMB))?;
        Ok(machine
            .with_gravity([-GRAVITY, 0.0])?
            .with_load(viscous)?
            .with_load(coulomb)?)
    }

    /// The same machine for the library: mechanism, gravity, friction of the drive link.
    pub(crate) fn mechanism(&self) -> Result<Machine<SliderCrank>, Error> {
        self.crank(true)
    }
}

/// Angle (turns), speed (rad/s), acceleration (rad/s²).
pub(crate) type Motion = [f64; 3];

/// 64 angles over a turn, none at a knot of a table; at each both directions and standstill. Speeds and accelerations follow golden-ratio sequences
/// over their ranges.
pub(crate) fn motions() -> Vec<Motion> {
    let golden = |k: usize, step: f64| (k as f64 * step).fract();
    (0..ANGLES)
        .flat_map(|k| {
            let turn = (k as f64 + golden(k, 0.754_877_666)) / ANGLES as f64;
            let omega = OMEGA * (0.25 + 0.75 * golden(k, 0.618_033_989));
            [omega, -omega, 0.0].map(move |omega| (k, turn, omega))
        })
        .enumerate()
        .map(|(n, (_, turn, omega))| {
            [
                turn,
                omega,
                ALPHA * (2.0 * golden(n + 1, 0.569_840_291) - 1.0),
            ]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use jred::machine::Reducible as _;

    #[test]
    fn the_reference_and_the_library_know_the_same_machine() {
        let example = Example::new();
        let reduced = example.mechanism().unwrap();
        let [mut least, mut most] = [f64::INFINITY, 0.0f64];
        for [turn, omega, alpha] in motions() {
            let phi = turn * TAU;
            let reduction = reduced.reduction(phi).unwrap();
            let torque = example.torque(phi, omega, alpha);
            assert!(
                (reduction.torque(omega, alpha).total() - torque).abs() < 1e-12,
                "{torque} at {phi}"
            );
            assert!((reduction.inertia_slope / 2.0 - example.curves(phi).half_slope).abs() < 1e-15);
            least = least.min(reduction.inertia);
            most = most.max(reduction.inertia);
        }
        assert!((most / least - VARIATION).abs() < 0.01, "{}", most / least);
    }

    #[test]
    fn motions_cover_the_turn_and_both_directions() {
        let motions = motions();
        assert_eq!(motions.len(), 3 * ANGLES);
        for (k, motion) in motions.iter().enumerate() {
            let cell = (k / 3) as f64 / ANGLES as f64;
            assert!(motion[0] >= cell && motion[0] < cell + 1.0 / ANGLES as f64);
            assert!((motion[1] / OMEGA).abs() <= 1.0 && (motion[2] / ALPHA).abs() <= 1.0);
        }
        let sign = |s: f64| motions.iter().filter(|m| m[1] * s > 0.0).count();
        assert_eq!([sign(1.0), sign(-1.0)], [ANGLES; 2]);
    }
}
