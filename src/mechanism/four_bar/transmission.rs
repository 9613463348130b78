//! Transmission of force from the coupler to the rocker.

use crate::machine::error::PoseError;
use core::f64::consts::{PI, TAU};

use super::{FourBar, beyond};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

impl FourBar {
    /// Transmission angle μ (rad) between coupler and rocker at B, 0 to π, with its derivatives with respect to φ:
    ///
    /// ```text
    /// cos μ = (b² + c² − f²)/(2·b·c)
    /// ```
    ///
    /// The transmission is best at 90°, and zero at 0° and 180°, as at a change point. Rule of thumb (H. Alt, 1932): between 40° and 140°.
    ///
    /// # Errors
    /// No position at `phi`.
    pub fn transmission_angle(&self, phi: f64) -> Result<Transfer, PoseError> {
        let [_, coupler, rocker] = self.place(phi)?;
        let turned = rocker.psi - coupler.psi;
        // From BA to BC as from AB to CB; the direction depends on the side.
        let angle = turned * self.side_at(phi);
        let whole = math::floor(angle.value / TAU) * TAU;
        Ok(angle - Transfer::constant(whole))
    }

    /// Smallest and largest transmission angle (rad) over the crank's range.
    #[must_use]
    pub fn transmission_angle_range(&self) -> [f64; 2] {
        let (b, c) = (self.dimensions.coupler, self.dimensions.rocker);
        let [folded, stretched] = self.reach();
        // At a dead point, which only a linkage with change points reaches, the arc cosine would return the square root of a rounding error.
        let angle = |span: f64| {
            if span <= folded {
                0.0
            } else if span >= stretched {
                PI
            } else {
                math::acos((b * b + c * c - span * span) / (2.0 * b * c))
            }
        };
        self.span_range().map(angle)
    }

    /// Smallest and largest f = |AC| (m) over the crank's range: at its ends, and where O, A and C are in line.
    fn span_range(&self) -> [f64; 2] {
        let (near, far) = (
            math::abs(self.ground - self.dimensions.crank),
            self.ground + self.dimensions.crank,
        );
        let Domain::Stroke { from, to } = self.domain else {
            return [near, far];
        };
        let ends = [self.span(from), self.span(to)];
        let inside = |phi: f64| from + beyond(phi - from) <= to;
        let gamma = self.ground_angle();
        [
            if inside(gamma) {
                near
            } else {
                ends[0].min(ends[1])
            },
            if inside(gamma + PI) {
                far
            } else {
                ends[0].max(ends[1])
            },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::{TAU, beyond};

    #[test]
    fn an_angle_just_below_a_turn_that_rounds_to_it_is_zero() {
        for angle in [-1e-20, -1e-300, 3.0 * TAU, -TAU] {
            assert_eq!(beyond(angle).to_bits(), 0, "{angle}");
        }
        assert!((6.0..TAU).contains(&beyond(-1e-9)));
    }
}
