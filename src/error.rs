//! What can be wrong when a machine, a motion or a table is built. Nothing here can happen in a tick.

use core::fmt;

/// A reason why a machine, a motion or a table cannot be built.
///
/// Values are in SI units (m, kg, s, rad); angles of the drive link are printed in degrees as well.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Error {
    /// The named quantity is NaN or infinite.
    NotFinite(&'static str),
    /// The named quantity must be greater than zero.
    NotPositive(&'static str, f64),
    /// The named quantity must not be negative.
    Negative(&'static str, f64),
    /// The named quantity lies outside `[min, max]`.
    OutOfRange {
        /// Which quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// A slider-crank whose rod is too short for the crank to turn fully.
    CannotTurn {
        /// Crank angle (rad) beyond which the rod no longer reaches the guide.
        phi: f64,
        /// The rod must be longer than this (m): crank length + |offset|.
        shortest_rod: f64,
    },
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
        /// Index of the joint that stays open widest.
        joint: usize,
        /// How far it stays open (m, or rad).
        gap: f64,
    },
    /// The mechanism jumped to another branch between two positions.
    BranchChange {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
        /// Index of the joint at which the branches meet.
        joint: usize,
    },
    /// After a full turn of the drive link, a link is not where it was.
    NotClosed {
        /// Index of the link.
        link: usize,
        /// How far off it is (m, or rad).
        gap: f64,
    },
    /// The ends of a spring or a damper meet: its direction is not known there.
    EndsMeet {
        /// Position of the drive link (rad, or m for a sliding link).
        phi: f64,
    },
    /// Inertia or load are not the same one turn of the drive link later.
    NotPeriodic {
        /// Angle of the drive link (rad).
        phi: f64,
    },
    /// The joints do not leave the links exactly one freedom.
    Mobility {
        /// Number of moving links.
        links: usize,
        /// Number of freedoms that the joints take.
        constraints: usize,
    },
    /// The joint constrains links that other joints constrain already, while other links are free.
    OverConstrained {
        /// Index of the joint.
        joint: usize,
        /// Index of a link that is free.
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
        /// The index asked for, from 0.
        cam: usize,
        /// How many cams there are.
        cams: usize,
    },
    /// The base of a cam is on the cam itself, or on its follower.
    CamBase {
        /// Index of the cam.
        cam: usize,
    },
    /// The mechanism has no joint of this number, or one of a kind that does not fit.
    NoSuchJoint {
        /// The index asked for, from 0.
        joint: usize,
        /// How many joints there are.
        joints: usize,
    },
    /// The load acts on a link that the mechanism does not have.
    NoSuchLink {
        /// The index asked for, from 0.
        link: usize,
        /// How many links there are.
        links: usize,
    },
    /// More elements than the fixed capacity.
    TooMany {
        /// What was being added.
        what: &'static str,
        /// How many fit.
        capacity: usize,
    },
    /// A friction stage whose ratio or slip is not a number, where only numbers make sense.
    VaryingRatio {
        /// Index of the stage.
        stage: usize,
    },
    /// Quantities that depend on each other did not come to rest.
    NotSettled {
        /// Which.
        what: &'static str,
    },
    /// The reduced inertia is not positive at this angle: nothing with mass moves there.
    NoInertia {
        /// Angle of the drive link (rad).
        phi: f64,
    },
    /// Dimensions of a library mechanism that do not fit together.
    Misfit(crate::mechanism::Misfit),
    /// A cam program or a cam that is not possible.
    Cam(crate::mechanism::cam::CamError),
    /// A machine without harmonics, or harmonics that cannot be identified.
    Harmonic(crate::harmonic::HarmonicError),
    /// The drive link of a library mechanism cannot turn fully.
    Blocked(crate::mechanism::Blocked),
    /// A curve does not fit the fixed-point range: choose a larger base for the named quantity.
    Overflow {
        /// Which base of the [`Scale`](crate::Scale) is too small.
        base: &'static str,
        /// Index of the table cell.
        cell: u32,
    },
    /// Tables of this number type are not stored in images.
    NoImage(&'static str),
    /// The table made is not sound.
    Table(crate::TableError),
    /// No table within the buffer meets the torque error asked for.
    TorqueErrorNotReached {
        /// Torque error asked for (N·m).
        asked: f64,
        /// Least torque error of the sizes tried (N·m).
        reached: f64,
        /// Number of cells of that table.
        cells: u32,
    },
    /// The buffer given is too short.
    BufferTooShort {
        /// Number of elements needed.
        needed: usize,
        /// Number of elements given.
        given: usize,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite(what) => write!(f, "{what} is not a finite number"),
            Self::NotPositive(what, value) => {
                write!(f, "{what} is {value}, but must be greater than zero")
            }
            Self::Negative(what, value) => {
                write!(f, "{what} is {value}, but must not be negative")
            }
            Self::OutOfRange {
                what,
                value,
                min,
                max,
            } => write!(f, "{what} is {value}, outside {min} to {max}"),
            Self::CannotTurn { phi, shortest_rod } => write!(
                f,
                "the crank cannot turn fully: the rod no longer reaches the guide at φ = {:.2}°; \
                 make the rod longer than crank + |offset| = {shortest_rod} m, or shorten the crank or the offset",
                phi.to_degrees()
            ),
            Self::NoSuchLink { link, links } => {
                write!(
                    f,
                    "there is no link {link}: the mechanism has links 0 to {}",
                    links.saturating_sub(1)
                )
            }
            Self::TooMany { what, capacity } => {
                write!(f, "too many {what}: at most {capacity} fit")
            }
            Self::VaryingRatio { stage } => write!(
                f,
                "the ratio or slip of friction stage {stage} varies: the angle of its second shaft need not be a function \
                 of the drive angle; give numbers, or use the friction drive's own equation of motion"
            ),
            Self::NotSettled { what } => write!(
                f,
                "{what} do not settle: let the one depend less on the other"
            ),
            Self::NoInertia { phi } => write!(
                f,
                "the reduced inertia is not positive at φ = {:.2}°: give the drive link or its flywheel an inertia",
                phi.to_degrees()
            ),
            Self::Misfit(misfit) => misfit.fmt(f),
            Self::Cam(error) => error.fmt(f),
            Self::Harmonic(error) => error.fmt(f),
            Self::Blocked(blocked) => blocked.fmt(f),
            Self::Overflow { base, cell } => write!(
                f,
                "a curve leaves the fixed-point range in table cell {cell}: choose a larger {base} base"
            ),
            Self::NoImage(name) => write!(
                f,
                "tables of {name} are not stored in images: use f32 or i32"
            ),
            Self::Table(error) => error.fmt(f),
            Self::TorqueErrorNotReached {
                asked,
                reached,
                cells,
            } => write!(
                f,
                "no table meets a torque error of {asked:e} N m: {cells} cells reach {reached:.3e} N m; \
                 allow a larger error, take another layout or number type, or smooth the load (longer ramps); \
                 of a turn with jumps tabulate the pieces between them (Part, Pieces)"
            ),
            Self::BufferTooShort { needed, given } => {
                write!(
                    f,
                    "the buffer holds {given} elements, but {needed} are needed"
                )
            }
            ref of_joints => of_joints.fmt_joints(f),
        }
    }
}

impl Error {
    /// What can be wrong with links and joints.
    fn fmt_joints(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::DeadPoint { phi, joint } => write!(
                f,
                "dead point: the drive cannot move the mechanism at {}; joint {joint} locks",
                Place(phi)
            ),
            Self::CannotAssemble { phi, joint, gap } => write!(
                f,
                "the mechanism cannot be assembled at {}: joint {joint} stays open by {gap:.3e}",
                Place(phi)
            ),
            Self::BranchChange { phi, joint } => write!(
                f,
                "the mechanism changes to another branch at {}, where joint {joint} is stretched or folded",
                Place(phi)
            ),
            Self::NotClosed { link, gap } => write!(
                f,
                "after a turn of the drive link, link {link} is {gap:.3e} off its first position: the mechanism does not close"
            ),
            Self::EndsMeet { phi } => write!(
                f,
                "the ends of a spring or damper meet at {}, where it has no direction: move one of them a little aside",
                Place(phi)
            ),
            Self::NotPeriodic { phi } => write!(
                f,
                "inertia or load at {} are not the same a turn of the drive link later: a spring, or a force of fixed \
                 direction, acts on a link that does not come back; attach it elsewhere, or limit the drive by a stroke",
                Place(phi)
            ),
            Self::Mobility { links, constraints } => {
                let freedoms = 3 * links as i64 - constraints as i64;
                write!(
                    f,
                    "the mechanism has {freedoms} degrees of freedom, not one: 3·{links} links − {constraints} constraints"
                )
            }
            Self::OverConstrained { joint, free } => write!(
                f,
                "joint {joint} holds links that other joints hold already, while link {free} is free"
            ),
            Self::NotAPair => f.write_str(
                "a transmission is not a pair of a linkage: its geometry is not known; use gears, a rack or a belt",
            ),
            Self::NotADrive { joint } => write!(
                f,
                "joint {joint} cannot be driven: the drive of a linkage must be a pin or a guide"
            ),
            Self::NoSuchCam { cam, cams } => {
                write!(
                    f,
                    "there is no cam {cam}: the linkage has {cams} cams, counted from 0"
                )
            }
            Self::CamBase { cam } => write!(
                f,
                "the base of cam {cam} is on the cam or its follower: put it on the body that carries both"
            ),
            Self::NoSuchJoint { joint, joints } => {
                write!(
                    f,
                    "joint {joint} cannot be used: the mechanism has {joints} joints, counted from 0"
                )
            }
            // Written by `fmt`; never nothing.
            ref other => write!(f, "{other:?}"),
        }
    }
}

/// A position of the drive link, which turns or slides.
struct Place(f64);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "φ = {:.2}° ({:.6} rad, or m of a stroke)",
            self.0.to_degrees(),
            self.0
        )
    }
}

impl core::error::Error for Error {}

/// `value` if it is finite.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<f64, Error> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Error::NotFinite(what))
    }
}

/// `value` if it is finite and not negative.
pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<f64, Error> {
    if finite(what, value)? < 0.0 {
        Err(Error::Negative(what, value))
    } else {
        Ok(value)
    }
}

/// `value` if it is finite and greater than zero.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, Error> {
    if finite(what, value)? > 0.0 {
        Ok(value)
    } else {
        Err(Error::NotPositive(what, value))
    }
}
