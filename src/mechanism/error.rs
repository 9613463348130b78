//! Why dimensions do not form a mechanism.

use core::fmt;

use super::{DimensionError, RotationError};
use crate::machine::PoseError;
use crate::number::error::{Curable, RangeError, error};

/// Why a mechanism of the library cannot be created.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BuildError {
    /// A dimension outside its range.
    Range(RangeError),
    /// An impossible position within the drive's range.
    Pose(PoseError),
    /// Dimensions that do not fit together.
    Dimensions(DimensionError),
    /// The drive link cannot turn fully.
    Rotation(RotationError),
}

error!(
    BuildError,
    Range(RangeError),
    Pose(PoseError),
    Dimensions(DimensionError),
    Rotation(RotationError)
);

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range(error) => error.fmt(f),
            Self::Pose(error) => error.fmt(f),
            Self::Dimensions(error) => error.fmt(f),
            Self::Rotation(error) => error.fmt(f),
        }
    }
}

impl Curable for BuildError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range(error) => error.write_cure(f),
            Self::Pose(error) => error.write_cure(f),
            Self::Dimensions(error) => error.write_cure(f),
            Self::Rotation(error) => error.write_cure(f),
        }
    }
}
