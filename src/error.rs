//! All errors before the first tick, in one type.

use core::fmt;

use crate::curve::TableError;
use crate::friction::FrictionError;
use crate::machine::{MachineError, PoseError};
use crate::mechanism::BuildError;
use crate::mechanism::cam::CamError;
use crate::mechanism::linkage::LinkageError;
use crate::number::error::{Curable, RangeError, error};
use crate::tabulate::harmonic::HarmonicError;
#[cfg(feature = "micromath")]
use crate::tabulate::slider_crank::SliderCrankError;
use crate::tick::ImageError;

/// Why a machine, a motion or a table cannot be created: the errors of all layers, each with its own type. None of them can occur in a tick.
///
/// Values are in SI units (m, kg, s, rad); angles of the drive link are printed in degrees as well. The message names the error, [`cure`](Self::cure)
/// the remedy.
///
/// Later versions may add errors, so that a `match` needs a wildcard arm:
///
/// ```
/// # use jred::error::Error;
/// fn is_about_the_image(error: &Error) -> bool {
///     match error {
///         Error::Image(_) => true,
///         _ => false,
///     }
/// }
/// ```
///
/// ```compile_fail,E0004
/// # use jred::error::Error;
/// fn is_about_the_image(error: &Error) -> bool {
///     match error {
///         Error::Image(_) => true,
///         Error::Range(_) | Error::Pose(_) | Error::Machine(_) | Error::Build(_) | Error::Cam(_) => false,
///         Error::Linkage(_) | Error::Friction(_) | Error::Harmonic(_) | Error::Table(_) => false,
///         Error::TorqueErrorNotReached { .. } => false,
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Error {
    /// A quantity outside its range.
    Range(RangeError),
    /// A position that the mechanism or the machine cannot take.
    Pose(PoseError),
    /// Parts that do not form a machine.
    Machine(MachineError),
    /// Dimensions that do not form a mechanism.
    Build(BuildError),
    /// An impossible cam program or cam.
    Cam(CamError),
    /// Links and joints that do not form a linkage.
    Linkage(LinkageError),
    /// A friction drive that cannot be created or moved.
    Friction(FrictionError),
    /// A machine without harmonics, or harmonics that cannot be identified.
    Harmonic(HarmonicError),
    /// A slider-crank without a closed form.
    #[cfg(feature = "micromath")]
    SliderCrank(SliderCrankError),
    /// An image that is refused, or cannot be written.
    Image(ImageError),
    /// A table that cannot be created or ticked.
    Table(TableError),
    /// No table within the buffer meets the requested torque error.
    TorqueErrorNotReached {
        /// Requested torque error (N·m).
        asked: f64,
        /// Smallest torque error of the sizes tried (N·m).
        reached: f64,
        /// Number of cells of that table.
        cells: u32,
    },
}

error!(
    Error,
    Range(RangeError),
    Harmonic(HarmonicError),
    Table(TableError)
);

#[cfg(feature = "micromath")]
impl From<SliderCrankError> for Error {
    fn from(error: SliderCrankError) -> Self {
        Self::SliderCrank(error)
    }
}

impl From<ImageError> for Error {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Table(error) => Self::Table(error),
            other => Self::Image(other),
        }
    }
}

impl From<PoseError> for Error {
    fn from(error: PoseError) -> Self {
        match error {
            PoseError::Range(error) => Self::Range(error),
            other => Self::Pose(other),
        }
    }
}

impl From<MachineError> for Error {
    fn from(error: MachineError) -> Self {
        match error {
            MachineError::Range(error) => Self::Range(error),
            MachineError::Pose(error) => error.into(),
            other => Self::Machine(other),
        }
    }
}

impl From<BuildError> for Error {
    fn from(error: BuildError) -> Self {
        match error {
            BuildError::Range(error) => Self::Range(error),
            BuildError::Pose(error) => error.into(),
            other => Self::Build(other),
        }
    }
}

impl From<CamError> for Error {
    fn from(error: CamError) -> Self {
        match error {
            CamError::Range(error) => Self::Range(error),
            other => Self::Cam(other),
        }
    }
}

impl From<LinkageError> for Error {
    fn from(error: LinkageError) -> Self {
        match error {
            LinkageError::Range(error) => Self::Range(error),
            LinkageError::Pose(error) => error.into(),
            LinkageError::Machine(error) => error.into(),
            other => Self::Linkage(other),
        }
    }
}

impl From<FrictionError> for Error {
    fn from(error: FrictionError) -> Self {
        match error {
            FrictionError::Range(error) => Self::Range(error),
            other => Self::Friction(other),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range(error) => error.fmt(f),
            Self::Pose(error) => error.fmt(f),
            Self::Machine(error) => error.fmt(f),
            Self::Build(error) => error.fmt(f),
            Self::Cam(error) => error.fmt(f),
            Self::Linkage(error) => error.fmt(f),
            Self::Friction(error) => error.fmt(f),
            Self::Harmonic(error) => error.fmt(f),
            #[cfg(feature = "micromath")]
            Self::SliderCrank(error) => error.fmt(f),
            Self::Image(error) => error.fmt(f),
            Self::Table(error) => error.fmt(f),
            Self::TorqueErrorNotReached {
                asked,
                reached,
                cells,
            } => write!(
                f,
                "no table meets a torque error of {asked:e} N m: {cells} cells reach {reached:.3e} N m"
            ),
        }
    }
}

impl Curable for Error {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range(error) => error.write_cure(f),
            Self::Pose(error) => error.write_cure(f),
            Self::Machine(error) => error.write_cure(f),
            Self::Build(error) => error.write_cure(f),
            Self::Cam(error) => error.write_cure(f),
            Self::Linkage(error) => error.write_cure(f),
            Self::Friction(error) => error.write_cure(f),
            Self::Harmonic(error) => error.write_cure(f),
            #[cfg(feature = "micromath")]
            Self::SliderCrank(error) => error.write_cure(f),
            Self::Image(error) => error.write_cure(f),
            Self::Table(error) => error.write_cure(f),
            Self::TorqueErrorNotReached { .. } => f.write_str(
                "allow a larger error, take another layout or number type, or smooth the load (longer ramps); \
                 of a turn with jumps tabulate the pieces between them (Part, Pieces)",
            ),
        }
    }
}
