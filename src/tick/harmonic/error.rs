//! What can be wrong with harmonics.

use core::fmt;

use super::Coefficient;
use crate::{Error, Phase};

/// Why numbers are not the coefficients of a usable machine. Contains no floating-point number, so that firmware in single
/// precision can check coefficients without double precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum CoefficientError {
    /// Not the means and a whole number of rows, from no harmonic to [`MAX_HARMONICS`](super::MAX_HARMONICS).
    Length {
        /// Number of coefficients given.
        given: u32,
        /// Means at the start.
        means: u32,
        /// Coefficients of each harmonic after them.
        row: u32,
    },
    /// A coefficient that is NaN, infinite or 1e30 and more.
    Range {
        /// Its place.
        word: u32,
    },
    /// The reduced inertia is not positive here.
    NoInertia {
        /// The phase of the drive link.
        phase: Phase,
    },
    /// At every place looked at the reduced inertia is positive, but so little that between two of them its curvature
    /// may take it to zero.
    InertiaNotShown {
        /// Where it is least.
        phase: Phase,
    },
}

impl fmt::Display for CoefficientError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Length { given, means, row } => write!(
                f,
                "{given} coefficients are not {means} means and up to {} rows of {row}",
                super::MAX_HARMONICS
            ),
            Self::Range { word } => write!(
                f,
                "coefficient {word} is not a finite number below 1e30 in size"
            ),
            Self::NoInertia { phase } => write!(
                f,
                "the reduced inertia of the harmonics is not positive at φ = {}: give the drive link an inertia, or use \
                 more harmonics",
                Degrees(phase)
            ),
            Self::InertiaNotShown { phase } => write!(
                f,
                "the reduced inertia of the harmonics comes too close to zero at φ = {} to be shown positive: give the \
                 drive link an inertia",
                Degrees(phase)
            ),
        }
    }
}

impl core::error::Error for CoefficientError {}

/// A phase in degrees, rounded down to hundredths, by integers.
struct Degrees(Phase);

impl fmt::Display for Degrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hundredths = (u64::from(self.0.to_bits()) * 36_000) >> 32;
        write!(f, "{}.{:02}°", hundredths / 100, hundredths % 100)
    }
}

/// Why a machine has no harmonics, or why they cannot be identified.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum HarmonicError {
    /// The drive link has a stroke.
    Stroke,
    /// No number of harmonics up to the limit meets the torque error asked for.
    NotConverged {
        /// Torque error asked for (N·m).
        asked: f64,
        /// Torque error with the most harmonics (N·m), at the places checked.
        reached: f64,
        /// How many harmonics that are.
        harmonics: u32,
    },
    /// The coefficients are not those of a usable machine.
    Coefficients(CoefficientError),
    /// Fewer samples than coefficients and one.
    TooFewSamples {
        /// How many are needed.
        needed: u32,
        /// How many there are.
        given: u32,
    },
    /// The samples do not tell this coefficient.
    NotExcited {
        /// Which.
        coefficient: Coefficient,
        /// The one that has the same effect in these samples; `None` if the first has no effect at all.
        like: Option<Coefficient>,
    },
}

impl fmt::Display for HarmonicError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Stroke => f.write_str(
                "harmonics need a drive link that turns fully, but this one has a stroke: use a table",
            ),
            Self::NotConverged {
                asked,
                reached,
                harmonics,
            } => write!(
                f,
                "{harmonics} harmonics reach a torque error of {reached:.3e} N m, not {asked:e} N m: a curve with a kink, \
                 a jump or a steep ramp needs a table; of a smooth machine allow more harmonics or a larger error, and see that \
                 TERMS has all of its cosines and sines (terms::ALL, or what terms_in_use finds)"
            ),
            Self::Coefficients(error) => error.fmt(f),
            Self::TooFewSamples { needed, given } => write!(
                f,
                "{given} samples do not tell the coefficients and their error: at least {needed} are needed"
            ),
            Self::NotExcited {
                coefficient,
                like: None,
            } => write!(
                f,
                "the samples do not depend on {coefficient}: measure with other speeds and accelerations"
            ),
            Self::NotExcited {
                coefficient,
                like: Some(other),
            } => write!(
                f,
                "the samples do not tell {coefficient} from {other}: measure with other speeds and accelerations, in both \
                 directions, or leave one of them out"
            ),
        }
    }
}

impl core::error::Error for HarmonicError {}

impl From<CoefficientError> for HarmonicError {
    fn from(error: CoefficientError) -> Self {
        Self::Coefficients(error)
    }
}

impl From<HarmonicError> for Error {
    fn from(error: HarmonicError) -> Self {
        Self::Harmonic(error)
    }
}

impl From<CoefficientError> for Error {
    fn from(error: CoefficientError) -> Self {
        Self::Harmonic(error.into())
    }
}
