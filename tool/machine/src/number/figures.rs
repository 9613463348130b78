//! Extremes and means of a quantity over a cycle.

/// Extremes, mean and RMS of a quantity over the cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Figures {
    /// Smallest value.
    pub min: f64,
    /// Mean over time.
    pub mean: f64,
    /// Largest value.
    pub max: f64,
    /// Root mean square over time.
    pub rms: f64,
}

impl Figures {
    /// Smallest, mean, largest, RMS.
    pub const fn values(&self) -> [f64; 4] {
        [self.min, self.mean, self.max, self.rms]
    }

    /// Largest magnitude.
    pub fn peak(&self) -> f64 {
        self.max.max(-self.min)
    }
}
