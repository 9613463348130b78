//! Positions prescribed in time: holonomic, but an actuator does work.
//!
//! Where a *position* depends on time, x(φ, t), and not a ratio of speeds, velocities have a part without ω:
//!
//! ```text
//! ẋ = x_φ·ω + x_t        K = ½·J·ω² + B·ω + C
//! J = Σ m·x_φ²           B = Σ m·x_φ·x_t           C = ½·Σ m·x_t²
//! J·ω̇ + ½·J_φ·ω² + J_t·ω + B_t − C_φ = Q                                (B)
//! dK/dt = Q·ω + P,       P = Σ (m·ẍ − F)·x_t + Σ F·x_t: power of actuator and given forces in the prescribed part
//! ```
//!
//! The factor of J_t is 1 here, as Lagrange's equation gives it, and B and C belong to it: a mass moved along a rotating
//! arm keeps J·ω, not ω·√J. For ratios that vary in time see [`Drive`](super::Drive): there the factor is ½.

use core::ops::{Add, Mul, Sub};

use crate::{Error, math};

/// A coordinate x(φ, t) with its first and second partial derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Coordinate {
    /// x
    pub value: f64,
    /// x_φ
    pub phi: f64,
    /// x_t
    pub t: f64,
    /// x_φφ
    pub phi_phi: f64,
    /// x_φt
    pub phi_t: f64,
    /// x_tt
    pub t_t: f64,
}

impl Coordinate {
    /// A coordinate that does not change.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self {
            value,
            phi: 0.0,
            t: 0.0,
            phi_phi: 0.0,
            phi_t: 0.0,
            t_t: 0.0,
        }
    }

    /// φ itself.
    #[must_use]
    pub const fn angle(phi: f64) -> Self {
        Self {
            phi: 1.0,
            ..Self::constant(phi)
        }
    }

    /// A function of time with its first and second derivative, as a motion law gives it.
    #[must_use]
    pub const fn of_time([value, t, t_t]: [f64; 3]) -> Self {
        Self {
            t,
            t_t,
            ..Self::constant(value)
        }
    }

    /// f(self) for a function with the given value, first and second derivative there.
    #[must_use]
    pub fn through(self, [value, d1, d2]: [f64; 3]) -> Self {
        Self {
            value,
            phi: d1 * self.phi,
            t: d1 * self.t,
            phi_phi: d1 * self.phi_phi + d2 * self.phi * self.phi,
            phi_t: d1 * self.phi_t + d2 * self.phi * self.t,
            t_t: d1 * self.t_t + d2 * self.t * self.t,
        }
    }

    /// Sine and cosine.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = math::sin_cos(self.value);
        (
            self.through([sin, cos, -sin]),
            self.through([cos, -sin, -cos]),
        )
    }

    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            value: f(self.value, other.value),
            phi: f(self.phi, other.phi),
            t: f(self.t, other.t),
            phi_phi: f(self.phi_phi, other.phi_phi),
            phi_t: f(self.phi_t, other.phi_t),
            t_t: f(self.t_t, other.t_t),
        }
    }

    fn is_finite(&self) -> bool {
        let all = [
            self.value,
            self.phi,
            self.t,
            self.phi_phi,
            self.phi_t,
            self.t_t,
        ];
        all.iter().all(|x| x.is_finite())
    }
}

impl Add for Coordinate {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Coordinate {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul<f64> for Coordinate {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        self.zip(self, |a, _| a * k)
    }
}

impl Mul for Coordinate {
    type Output = Self;
    fn mul(self, g: Self) -> Self {
        let f = self;
        Self {
            value: f.value * g.value,
            phi: f.phi * g.value + f.value * g.phi,
            t: f.t * g.value + f.value * g.t,
            phi_phi: f.phi_phi * g.value + 2.0 * f.phi * g.phi + f.value * g.phi_phi,
            phi_t: f.phi_t * g.value + f.phi * g.t + f.t * g.phi + f.value * g.phi_t,
            t_t: f.t_t * g.value + 2.0 * f.t * g.t + f.value * g.t_t,
        }
    }
}

/// The sums of equation (B) at one φ and t.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rheonomic {
    /// J (kg·m²), J_φ, J_t.
    pub inertia: [f64; 3],
    /// B (kg·m²/s), B_φ, B_t.
    pub drift: [f64; 3],
    /// C (J), C_φ, C_t.
    pub rest: [f64; 3],
    /// Σ F·x_φ: given forces reduced to φ (N·m).
    pub force: f64,
    /// Σ F·x_t: their power in the prescribed part of the motion (W).
    pub force_power: f64,
}

impl Rheonomic {
    /// With one more coordinate: a mass (kg) that moves along it, or an inertia (kg·m²) that turns by it, and the given
    /// force (N, or N·m) in its direction, such as the weight. Not the actuator's.
    ///
    /// # Errors
    /// A mass that is negative, or anything not finite.
    pub fn with(mut self, mass: f64, x: Coordinate, force: f64) -> Result<Self, Error> {
        let m = crate::error::not_negative("mass", mass)?;
        crate::error::finite("force", force)?;
        if !x.is_finite() {
            return Err(Error::NotFinite("coordinate prescribed in time"));
        }
        let add = |sums: &mut [f64; 3], terms: [f64; 3]| {
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += m * term;
            }
        };
        let turning = [
            x.phi * x.phi,
            2.0 * x.phi * x.phi_phi,
            2.0 * x.phi * x.phi_t,
        ];
        let mixed = [
            x.phi * x.t,
            x.phi_phi * x.t + x.phi * x.phi_t,
            x.phi_t * x.t + x.phi * x.t_t,
        ];
        add(&mut self.inertia, turning);
        add(&mut self.drift, mixed);
        add(
            &mut self.rest,
            [0.5 * x.t * x.t, x.t * x.phi_t, x.t * x.t_t],
        );
        self.force += force * x.phi;
        self.force_power += force * x.t;
        Ok(self)
    }

    /// Drive torque (N·m) that the motion needs (B).
    #[must_use]
    pub fn torque(&self, omega: f64, alpha: f64) -> f64 {
        self.inertia[0] * alpha + self.velocity_terms(omega) - self.force
    }

    /// Acceleration (rad/s²) under the drive torque `torque` (N·m).
    ///
    /// # Errors
    /// No inertia: J is not positive.
    pub fn acceleration(&self, omega: f64, torque: f64) -> Result<f64, Error> {
        let inertia = crate::error::positive("inertia", self.inertia[0])?;
        Ok((torque + self.force - self.velocity_terms(omega)) / inertia)
    }

    /// ½·J_φ·ω² + J_t·ω + B_t − C_φ
    fn velocity_terms(&self, omega: f64) -> f64 {
        (0.5 * self.inertia[1] * omega + self.inertia[2]) * omega + self.drift[2] - self.rest[1]
    }

    /// ½·J·ω² + B·ω + C (J).
    #[must_use]
    pub fn kinetic_energy(&self, omega: f64) -> f64 {
        (0.5 * self.inertia[0] * omega + self.drift[0]) * omega + self.rest[0]
    }

    /// Power (W) of the actuators that prescribe the motion in time: Σ (m·ẍ − F)·x_t.
    #[must_use]
    pub fn actuator_power(&self, omega: f64, alpha: f64) -> f64 {
        // Σ m·x_φφ·x_t = B_φ − ½·J_t, Σ m·x_φt·x_t = C_φ, Σ m·x_tt·x_t = C_t
        let square = self.drift[1] - 0.5 * self.inertia[2];
        self.drift[0] * alpha + (square * omega + 2.0 * self.rest[1]) * omega + self.rest[2]
            - self.force_power
    }
}
