//! Conversion between SI units and machine units.

use crate::math;
use crate::number::error::{RangeError, positive};
use crate::number::{Number, Outcome, Quantity};

/// The bases of the per-unit system: the SI values of the number 1.
///
/// Three bases are free; the others follow, so that the equation of motion has the same form in machine units: acceleration T_b/J_b, viscous
/// coefficient T_b/ω_b. They are single-precision numbers, as in a table image, so that host and firmware convert with the same bits.
///
/// For a sliding drive link read force (N), speed (m/s), mass (kg).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scale {
    torque: f32,
    speed: f32,
    inertia: f32,
}

/// The SI values of the number 1 in machine units.
///
/// ```
/// # use jred::{Scale, number::Bases};
/// let scale = Scale::new(Bases { torque: 20.0, speed: 60.0, inertia: 0.05 })?;
/// assert_eq!(scale.acceleration(), 400.0);
/// # Ok::<(), jred::number::RangeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bases {
    /// T_b (N·m).
    pub torque: f32,
    /// ω_b (rad/s).
    pub speed: f32,
    /// J_b (kg·m²).
    pub inertia: f32,
}

impl Scale {
    /// SI units as machine units: the scale of floating-point models.
    pub const SI: Self = Self {
        torque: 1.0,
        speed: 1.0,
        inertia: 1.0,
    };

    /// The machine units with these bases.
    ///
    /// # Errors
    /// A base that is not positive and finite.
    pub fn new(bases: Bases) -> Result<Self, RangeError> {
        let Bases {
            torque,
            speed,
            inertia,
        } = bases;
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

    /// The same with a slightly larger speed base, so that in a fixed-point table of `cells` cells over `span` (2π, or the stroke) the velocity
    /// torque is an integer multiple of the slope per cell:
    ///
    /// ```text
    /// ½·cells/span·J_b·ω_b²/T_b = 1, 2, 3, …
    /// ```
    ///
    /// One integer multiplication then replaces a product with a fraction and a shift. The speed base grows until the multiple is the next integer,
    /// by a few per cent unless the integer is small. The bases of torque and inertia grow with its square, so that no curve leaves its range, but at
    /// most by the larger of 2 and the growth of the speed base (from the integer 1 on, the velocity torque is only the slope per cell). The
    /// acceleration base stays the same.
    ///
    /// Accuracy: rounding of the bases to single precision causes an error of up to 2.5e-7 of the velocity torque (`tests/proofs/scale.g`, test
    /// `for_cells_makes_the_factor_whole`). A scale within that error of an integer multiple is returned unchanged.
    #[must_use]
    pub fn for_cells(self, cells: u32, span: f64) -> Self {
        let (torque, speed, inertia) = (
            f64::from(self.torque),
            f64::from(self.speed),
            f64::from(self.inertia),
        );
        let per_square = 0.5 * f64::from(cells) / span * inertia / torque;
        let factor = per_square * speed * speed;
        // A scale with an integer multiple does not change: four roundings of 2⁻²⁴ are 2.4e-7.
        let nearest = math::floor(factor + 0.5);
        if nearest >= 1.0 && math::abs(factor - nearest) < 2.5e-7 * factor {
            return self;
        }
        let growth = (math::floor(factor) + 1.0) / factor;
        let faster = math::sqrt(growth);
        let larger = growth.min(faster.max(2.0));
        Self {
            torque: (torque * larger) as f32,
            speed: (speed * faster) as f32,
            inertia: (inertia * larger) as f32,
        }
    }

    /// Checks that the bases are positive and finite.
    pub(crate) fn is_sound(&self) -> bool {
        [self.torque, self.speed, self.inertia]
            .iter()
            .all(|b| *b > 0.0 && b.is_finite())
            && self.velocity_base().is_finite()
            && self.acceleration().is_finite()
    }

    /// A scale with bases read from an image; see [`is_sound`](Self::is_sound).
    pub(crate) const fn from_bases([torque, speed, inertia]: [f32; 3]) -> Self {
        Self {
            torque,
            speed,
            inertia,
        }
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

    /// J_b·ω_b²/T_b: magnitude of the velocity term.
    pub(crate) fn velocity_base(&self) -> f32 {
        self.inertia * self.speed / self.torque * self.speed
    }

    /// A speed (rad/s) in machine units.
    pub fn omega<S: Quantity<Number: Number<Speed = S>>>(&self, omega: f32) -> Outcome<S> {
        S::from_si(omega, self.speed)
    }

    /// An acceleration (rad/s²) in machine units.
    pub fn alpha<A: Quantity<Number: Number<Acceleration = A>>>(&self, alpha: f32) -> Outcome<A> {
        A::from_si(alpha, self.acceleration())
    }

    /// A torque on the drive link (N·m) in machine units.
    pub fn to_torque<T: Quantity<Number: Number<Torque = T>>>(&self, torque: f32) -> Outcome<T> {
        T::from_si(torque, self.torque)
    }

    /// A torque on the drive link, from machine units to N·m.
    pub fn torque_si<T: Quantity<Number: Number<Torque = T>>>(&self, torque: T) -> f32 {
        torque.to_si(self.torque)
    }

    /// A speed, from machine units to rad/s.
    pub fn omega_si<S: Quantity<Number: Number<Speed = S>>>(&self, omega: S) -> f32 {
        omega.to_si(self.speed)
    }

    /// An acceleration, from machine units to rad/s².
    pub fn alpha_si<A: Quantity<Number: Number<Acceleration = A>>>(&self, alpha: A) -> f32 {
        alpha.to_si(self.acceleration())
    }
}

impl Default for Scale {
    fn default() -> Self {
        Self::SI
    }
}
