//! The cost of a motion per time: powers of the torque, or copper loss and drawn power.

/// The integrand over time, in units of a torque and a time of the move: c(τ) + m·max(τ, 0)·dθ/dt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cost {
    /// |τ| to this power.
    pub(super) power: i32,
    /// m, in motor travel per travel of the drive link.
    pub(super) drawn: f64,
    /// Range of τ over which the bend of max(τ, 0) is rounded.
    pub(super) rounding: f64,
}

impl Cost {
    /// [c, c′, c″]
    pub(super) fn torque(&self, torque: f64) -> [f64; 3] {
        let p = f64::from(self.power);
        let last = torque.abs().powi(self.power - 2);
        [
            last * torque * torque,
            p * last * torque,
            p * (p - 1.0) * last,
        ]
    }

    /// The same for max(τ, 0), its bend rounded by a hyperbola.
    pub(super) fn drawn(&self, torque: f64) -> [f64; 3] {
        if self.drawn == 0.0 {
            return [0.0; 3];
        }
        if self.rounding == 0.0 {
            let driving = f64::from(u8::from(torque > 0.0));
            return [driving * torque, driving, 0.0];
        }
        let e2 = self.rounding * self.rounding;
        let root = (torque * torque + e2).sqrt();
        [
            0.5 * (torque + root),
            0.5 * (1.0 + torque / root),
            0.5 * e2 / (root * root * root),
        ]
    }
}
