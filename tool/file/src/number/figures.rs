//! Extremes and means of a quantity over a cycle.

use serde::ser::SerializeStruct as _;
use serde::{Serialize, Serializer};

use super::rounding::cleared;

/// Extremes, mean and RMS of a quantity over the cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, schemars::JsonSchema)]
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

    /// Replaces values that are only rounding compared with `largest` by zero.
    #[must_use]
    pub const fn cleared(&self, largest: f64) -> Self {
        Self {
            min: cleared(self.min, largest),
            mean: cleared(self.mean, largest),
            max: cleared(self.max, largest),
            rms: cleared(self.rms, largest),
        }
    }

    /// Largest magnitude.
    pub fn peak(&self) -> f64 {
        self.max.max(-self.min)
    }
}

/// Programs read zero if a mean over a cycle is zero except for rounding.
impl Serialize for Figures {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let names = ["min", "mean", "max", "rms"];
        let mut fields = serializer.serialize_struct("Figures", names.len())?;
        for (name, value) in names.into_iter().zip(self.cleared(self.peak()).values()) {
            fields.serialize_field(name, &value)?;
        }
        fields.end()
    }
}
