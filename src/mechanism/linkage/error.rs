//! Why links and joints do not form a linkage, or a linkage cannot move through its range.

use core::fmt;

use crate::machine::{MachineError, PoseError};
use crate::number::error::{Curable, RangeError, error};

/// Why a linkage cannot be created, or not be followed over its drive's range. Joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LinkageError {
    /// A quantity outside its range.
    Range(RangeError),
    /// An impossible position: its place and joint.
    Pose(PoseError),
    /// Links and joints that do not form a machine: not exactly one degree of freedom, a link or a joint that does not exist.
    Machine(MachineError),
    /// The joint constrains links that other joints constrain already, while other links are free.
    OverConstrained {
        /// Index of the joint.
        joint: usize,
        /// Index of a free link.
        free: usize,
    },
    /// A transmission was given as a pair of a linkage.
    NotAPair,
    /// The drive of a linkage must be a pin or a guide.
    NotADrive {
        /// Index of the joint.
        joint: usize,
    },
    /// A pair refers to a cam that the linkage does not have.
    NoSuchCam {
        /// The requested index, from 0.
        cam: usize,
        /// Number of cams.
        cams: usize,
    },
    /// The base of a cam is on the cam itself, or on its follower.
    CamBase {
        /// Index of the cam.
        cam: usize,
    },
    /// After a full turn of the drive link, a link is in another place.
    NotClosed {
        /// Index of the link.
        link: usize,
        /// Its gap (m, or rad).
        gap: f64,
    },
    /// A linkage that is to be kept on its branch through change points has none.
    NoChangePoint,
}

error!(
    LinkageError,
    Range(RangeError),
    Pose(PoseError),
    Machine(MachineError)
);

impl fmt::Display for LinkageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range(error) => error.fmt(f),
            Self::Pose(error) => error.fmt(f),
            Self::Machine(error) => error.fmt(f),
            Self::OverConstrained { joint, free } => write!(
                f,
                "joint {joint} holds links that other joints hold already, while link {free} is free"
            ),
            Self::NotAPair => {
                f.write_str("a transmission is not a pair of a linkage: its geometry is not known")
            }
            Self::NotADrive { joint } => write!(
                f,
                "joint {joint} cannot be driven: the drive of a linkage must be a pin or a guide"
            ),
            Self::NoSuchCam { cam, cams } => write!(
                f,
                "there is no cam {cam}: the linkage has {cams} cams, counted from 0"
            ),
            Self::CamBase { cam } => {
                write!(f, "the base of cam {cam} is on the cam or its follower")
            }
            Self::NotClosed { link, gap } => write!(
                f,
                "after a turn of the drive link, link {link} is {gap:.3e} off its first position: the mechanism does not close"
            ),
            Self::NoChangePoint => f.write_str(
                "there is no change point to pass: no two branches of the linkage cross in the drive's range",
            ),
        }
    }
}

impl Curable for LinkageError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Range(error) => return error.write_cure(f),
            Self::Pose(error) => return error.write_cure(f),
            Self::Machine(error) => return error.write_cure(f),
            Self::OverConstrained { .. } => "move one of its ends to the free link",
            Self::NotAPair => "use gears, a rack or a belt",
            Self::NotADrive { .. } => "drive a pin or a guide",
            Self::NoSuchCam { .. } => "take the index of a cam that the linkage was given",
            Self::CamBase { .. } => "put it on the body that carries both",
            Self::NotClosed { .. } => {
                "limit the drive by a stroke, or change lengths or teeth so that a turn comes back"
            }
            Self::NoChangePoint => {
                "assemble it without: it stays on the branch on which it is drawn"
            }
        })
    }
}
