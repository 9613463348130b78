//! Errors of harmonics.

use core::fmt;

use crate::number::error::{Curable, error};

/// Why a machine has no harmonics.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum HarmonicError {
    /// The drive link has a stroke.
    Stroke,
    /// No number of harmonics up to the limit meets the requested torque error.
    NotConverged {
        /// Requested torque error (N·m).
        asked: f64,
        /// Torque error with the greatest number of harmonics (N·m), at the places checked.
        reached: f64,
        /// That number of harmonics.
        harmonics: u32,
    },
}

impl fmt::Display for HarmonicError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Stroke => f.write_str(
                "harmonics need a drive link that turns fully, but this one has a stroke",
            ),
            Self::NotConverged {
                asked,
                reached,
                harmonics,
            } => write!(
                f,
                "{harmonics} harmonics reach a torque error of {reached:.3e} N m, not {asked:e} N m"
            ),
        }
    }
}

error!(HarmonicError);

impl Curable for HarmonicError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stroke => f.write_str("use a table"),
            Self::NotConverged { .. } => f.write_str(
                "a curve with a kink, a jump or a steep ramp needs a table; of a smooth machine allow more harmonics or a \
                 larger error, and see that the set has all of its cosines and sines (terms::ALL, or what terms_in_use finds)",
            ),
        }
    }
}
