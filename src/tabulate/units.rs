//! Machine units for a machine.

use crate::machine::{PoseError, Reducible};
use crate::number::Bases;
use crate::number::error::positive;
use crate::tabulate::measure::sampled;
use crate::{Scale, math};

impl Scale {
    /// A scale in which nothing saturates for speeds up to `omega` (rad/s), accelerations up to `alpha` (rad/s²) and drive torques up to those needed
    /// for them. The acceleration by such a torque where the inertia is smallest fits as well.
    ///
    /// The machine is sampled at `positions` places; 5 % are added to speed and acceleration, and 5 % to the torque.
    ///
    /// # Errors
    /// The machine's errors, or `omega` or `alpha` not positive.
    pub fn covering(
        machine: &impl Reducible,
        omega: f64,
        alpha: f64,
        positions: u32,
    ) -> Result<Self, PoseError> {
        let most = Extremes::of(machine, omega, alpha, positions)?;
        // The greatest torque against the greatest resistance, where the inertia is least.
        most.scale((most.inertia * alpha + 2.0 * most.resisting) / most.least)
    }

    /// A scale for speeds up to `omega` and accelerations up to `alpha` only: a larger acceleration saturates in forward dynamics. It makes the best
    /// use of 16 bits; with 32 bits use [`covering`](Self::covering), which loses nothing.
    ///
    /// # Errors
    /// As [`covering`](Self::covering).
    pub fn limited_to(
        machine: &impl Reducible,
        omega: f64,
        alpha: f64,
        positions: u32,
    ) -> Result<Self, PoseError> {
        Extremes::of(machine, omega, alpha, positions)?.scale(alpha)
    }
}

/// The largest quantities of a machine, including a scale's margin for the speed.
struct Extremes {
    /// Least inertia.
    least: f64,
    /// Greatest inertia.
    inertia: f64,
    /// Greatest torque without that of the acceleration.
    resisting: f64,
    /// Greatest speed.
    omega: f64,
}

impl Extremes {
    const MARGIN: f64 = 1.05;

    fn of(
        machine: &impl Reducible,
        omega: f64,
        alpha: f64,
        positions: u32,
    ) -> Result<Self, PoseError> {
        positive("largest speed", omega)?;
        positive("largest acceleration", alpha)?;
        let mut most = Self {
            least: f64::INFINITY,
            inertia: 0.0,
            resisting: 0.0,
            omega: omega * Self::MARGIN,
        };
        for phi in sampled(machine, positions) {
            let point = machine.reduction(phi)?;
            most.least = most.least.min(point.inertia);
            most.inertia = most.inertia.max(point.inertia);
            let resisting = 0.5 * math::abs(point.inertia_slope) * most.omega * most.omega
                + math::abs(point.load_torque())
                + math::abs(point.viscous) * most.omega
                + math::abs(point.coulomb);
            most.resisting = most.resisting.max(resisting);
        }
        Ok(most)
    }

    /// The scale for accelerations up to `alpha`.
    fn scale(&self, alpha: f64) -> Result<Scale, PoseError> {
        let alpha = alpha * Self::MARGIN;
        let torque = (self.inertia * alpha + self.resisting) * Self::MARGIN;
        Ok(Scale::new(Bases {
            torque: torque as f32,
            speed: self.omega as f32,
            inertia: (torque / alpha) as f32,
        })?)
    }
}
