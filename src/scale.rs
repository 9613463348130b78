//! SI units to machine units and back.

use crate::error::positive;
use crate::scalar::{Outcome, Scalar};
use crate::{Error, Reducible};

/// The bases of the per-unit system: what the number 1 stands for.
///
/// Three bases are free; the others follow, so that the equation of motion has the same form in machine units:
/// acceleration T_b/J_b, viscous coefficient T_b/ω_b. They are single-precision numbers, exactly as a table image
/// holds them, so that host and firmware convert with the same bits.
///
/// For a sliding drive link read force (N), speed (m/s), mass (kg).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scale {
    torque: f32,
    speed: f32,
    inertia: f32,
}

impl Scale {
    /// Machine units are SI units: the scale of floating-point models.
    pub const SI: Self = Self {
        torque: 1.0,
        speed: 1.0,
        inertia: 1.0,
    };

    /// From the bases of torque (N·m), speed (rad/s) and inertia (kg·m²).
    ///
    /// # Errors
    /// A base that is not positive and finite.
    pub fn new(torque: f32, speed: f32, inertia: f32) -> Result<Self, Error> {
        for (what, base) in [
            ("torque base", torque),
            ("speed base", speed),
            ("inertia base", inertia),
        ] {
            positive(what, f64::from(base))?;
        }
        Ok(Self {
            torque,
            speed,
            inertia,
        })
    }

    /// Whether the bases are positive, finite numbers.
    pub(crate) fn is_sound(&self) -> bool {
        [self.torque, self.speed, self.inertia]
            .iter()
            .all(|b| *b > 0.0 && b.is_finite())
            && self.velocity_base().is_finite()
            && self.acceleration().is_finite()
    }

    /// From bases read from an image; see [`is_sound`](Self::is_sound).
    pub(crate) const fn from_bases([torque, speed, inertia]: [f32; 3]) -> Self {
        Self {
            torque,
            speed,
            inertia,
        }
    }

    /// A scale in which nothing saturates for speeds up to `omega` (rad/s), accelerations up to `alpha` (rad/s²)
    /// and drive torques of the size that these need: the acceleration that such a torque gives where the inertia
    /// is smallest fits as well.
    ///
    /// The machine is sampled at `positions` places; 5 % are added.
    ///
    /// # Errors
    /// Those of the machine, or `omega` or `alpha` not positive.
    pub fn covering(
        machine: &impl Reducible,
        omega: f64,
        alpha: f64,
        positions: u32,
    ) -> Result<Self, Error> {
        const MARGIN: f64 = 1.05;
        positive("largest speed", omega)?;
        positive("largest acceleration", alpha)?;
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        let (mut torque, mut resisting) = (0.0f64, 0.0f64);
        for k in 0..positions {
            let place = f64::from(k) / f64::from(positions);
            let point = machine.reduction(machine.domain().position(place))?;
            least = least.min(point.inertia[0]);
            most = most.max(point.inertia[0]);
            let terms = point.torque(omega, alpha).values();
            let against: f64 = terms.iter().skip(1).map(|t| crate::math::abs(*t)).sum();
            torque = torque.max(crate::math::abs(terms[0]) + against);
            resisting = resisting.max(against);
        }
        // What resists may add to the torque; the margin counts twice, as J_b has it, too, and ω_b² has it squared.
        let torque = (torque + resisting) * most / least;
        Self::new(
            (torque * MARGIN * MARGIN) as f32,
            (omega * MARGIN) as f32,
            (most * MARGIN) as f32,
        )
    }

    /// Torque base T_b (N·m).
    pub const fn torque(&self) -> f32 {
        self.torque
    }

    /// Speed base ω_b (rad/s).
    pub const fn speed(&self) -> f32 {
        self.speed
    }

    /// Inertia base J_b (kg·m²).
    pub const fn inertia(&self) -> f32 {
        self.inertia
    }

    /// Acceleration base T_b/J_b (rad/s²).
    pub fn acceleration(&self) -> f32 {
        self.torque / self.inertia
    }

    /// J_b·ω_b²/T_b: size of the velocity term.
    pub(crate) fn velocity_base(&self) -> f32 {
        self.inertia * self.speed / self.torque * self.speed
    }

    /// A speed (rad/s) in machine units.
    pub fn omega<S: Scalar>(&self, omega: f32) -> Outcome<S> {
        S::per_unit(omega, self.speed)
    }

    /// An acceleration (rad/s²) in machine units.
    pub fn alpha<S: Scalar>(&self, alpha: f32) -> Outcome<S> {
        S::per_unit(alpha, self.acceleration())
    }

    /// A torque (N·m) in machine units.
    pub fn to_torque<S: Scalar>(&self, torque: f32) -> Outcome<S> {
        S::per_unit(torque, self.torque)
    }

    /// A torque in machine units, in N·m.
    pub fn torque_si<S: Scalar>(&self, torque: S) -> f32 {
        torque.si(self.torque)
    }

    /// An acceleration in machine units, in rad/s².
    pub fn alpha_si<S: Scalar>(&self, alpha: S) -> f32 {
        alpha.si(self.acceleration())
    }
}
