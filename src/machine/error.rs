//! Positions that a mechanism cannot take, and parts that do not form a machine.

use core::fmt;

use crate::number::error::{Curable, RangeError, error};

/// A position of the drive link that the mechanism or the machine cannot take.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PoseError {
    /// A position, or a dimension needed there, outside its range.
    Range(RangeError),
    /// The drive link cannot move the mechanism here: a transfer function is infinite.
    DeadPoint {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
        /// Index of the joint that locks.
        joint: usize,
    },
    /// No position of the links satisfies all joints.
    CannotAssemble {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
        /// Index of the joint with the largest gap.
        joint: usize,
        /// The gap (m, or rad).
        gap: f64,
    },
    /// The mechanism jumped to another branch between two positions.
    BranchChange {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
        /// Index of the joint at which the branches meet.
        joint: usize,
    },
    /// The linkage is at a change point: it moves on, but the forces in its joints are indeterminate there.
    ChangePoint {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
    },
    /// The ends of a spring or a damper meet: its direction is undefined there.
    EndsMeet {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
    },
    /// The reduced inertia is not positive: no mass moves there.
    NoInertia {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
    },
    /// Friction in the joints has no definite size here: it blocks the mechanism.
    Jams {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
        /// Index of the joint whose friction acts on itself most.
        joint: usize,
    },
    /// Friction by a coefficient depends on the acceleration, so that no curve over the position contains it.
    NoCurve {
        /// Index of a joint with such friction.
        joint: usize,
    },
    /// Inertia or load differs one turn of the drive link later.
    NotPeriodic {
        /// Angle of the drive link (rad).
        phi: f64,
    },
}

error!(PoseError, Range(RangeError));

impl fmt::Display for PoseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range(error) => error.fmt(f),
            Self::DeadPoint { phi, joint } => write!(
                f,
                "dead point: the drive cannot move the mechanism at {}; joint {joint} locks",
                Position(phi)
            ),
            Self::CannotAssemble { phi, joint, gap } => write!(
                f,
                "the mechanism cannot be assembled at {}: joint {joint} stays open by {gap:.3e}",
                Position(phi)
            ),
            Self::BranchChange { phi, joint } => write!(
                f,
                "the mechanism changes to another branch at {}, where joint {joint} is stretched or folded",
                Position(phi)
            ),
            Self::ChangePoint { phi } => write!(
                f,
                "the forces in the joints are not determined at {}, a change point, where the linkage lies flat",
                Position(phi)
            ),
            Self::EndsMeet { phi } => write!(
                f,
                "the ends of a spring or damper meet at {}, where it has no direction",
                Position(phi)
            ),
            Self::NoInertia { phi } => {
                write!(
                    f,
                    "the reduced inertia is not positive at {}",
                    Position(phi)
                )
            }
            Self::Jams { phi, joint } => write!(
                f,
                "friction jams the mechanism at {}: in joint {joint} it grows as fast as the force against it",
                Position(phi)
            ),
            Self::NoCurve { joint } => write!(
                f,
                "friction by a coefficient, in joint {joint}, depends on the acceleration: no curve over the position contains it"
            ),
            Self::NotPeriodic { phi } => write!(
                f,
                "inertia or load at {} are not the same a turn of the drive link later: a spring, or a force of fixed \
                 direction, acts on a link that does not come back",
                Position(phi)
            ),
        }
    }
}

impl Curable for PoseError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Range(error) => return error.write_cure(f),
            Self::DeadPoint { .. } => {
                "end the drive's stroke some degrees before it, or change the lengths"
            }
            Self::CannotAssemble { .. } => {
                "check the lengths, and where the links are drawn: the joint's two points must be able to meet"
            }
            Self::BranchChange { .. } => {
                "end the drive's stroke before it, or change the lengths"
            }
            Self::ChangePoint { .. } => {
                "look at a position beside it; there what guides the linkage carries the difference"
            }
            Self::EndsMeet { .. } => "move one of them a little aside",
            Self::NoInertia { .. } => "give the drive link or its flywheel an inertia",
            Self::Jams { .. } => {
                "lower its coefficient, lengthen its guide, or end the drive's stroke before it: there the joint drives flatter"
            }
            Self::NoCurve { .. } => {
                "give it as an opposing force or moment of the size that you expect"
            }
            Self::NotPeriodic { .. } => "attach it elsewhere, or limit the drive by a stroke",
        })
    }
}

/// Parts that do not form a machine, or an instant whose forces cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum MachineError {
    /// A quantity outside its range.
    Range(RangeError),
    /// An impossible position.
    Pose(PoseError),
    /// The joints do not leave the links exactly one degree of freedom.
    Mobility {
        /// Number of moving links.
        links: usize,
        /// Number of degrees of freedom that the joints remove.
        constraints: usize,
    },
    /// The mechanism has no joint with this index, or its kind does not fit.
    NoSuchJoint {
        /// The requested index, from 0.
        joint: usize,
        /// Number of joints.
        joints: usize,
    },
    /// The load acts on a link that the mechanism does not have.
    NoSuchLink {
        /// The requested index, from 0.
        link: usize,
        /// Number of links.
        links: usize,
    },
}

error!(MachineError, Range(RangeError), Pose(PoseError));

impl fmt::Display for MachineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range(error) => error.fmt(f),
            Self::Pose(error) => error.fmt(f),
            Self::Mobility { links, constraints } => {
                let freedoms = 3 * links as i64 - constraints as i64;
                write!(
                    f,
                    "the mechanism has {freedoms} degrees of freedom, not one: 3·{links} links − {constraints} constraints"
                )
            }
            Self::NoSuchJoint { joint, joints } => write!(
                f,
                "joint {joint} cannot be used: the mechanism has {joints} joints, counted from 0"
            ),
            Self::NoSuchLink { link, links } => write!(
                f,
                "there is no link {link}: the mechanism has links 0 to {}",
                links.saturating_sub(1)
            ),
        }
    }
}

impl Curable for MachineError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Range(error) => return error.write_cure(f),
            Self::Pose(error) => return error.write_cure(f),
            Self::Mobility { links, constraints } if *constraints + 1 < 3 * links => {
                "hold the links by another joint, or leave one out"
            }
            Self::Mobility { .. } => {
                "leave out a joint that holds what others hold already, or use a pin in a slot, which takes one freedom"
            }
            Self::NoSuchJoint { .. } => "take the index of a joint of the right kind",
            Self::NoSuchLink { .. } => "take an index from the mechanism's list of links",
        })
    }
}

/// A position of the drive link, which turns or slides, for a message.
struct Position(f64);

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "φ = {:.2}° ({:.6} rad, or m of a stroke)",
            self.0.to_degrees(),
            self.0
        )
    }
}
