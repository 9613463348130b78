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
        /// Angle of the drive link (rad).
        phi: f64,
    },
    /// The load acts on a link that the mechanism does not have.
    NoSuchLink {
        /// The index asked for, from 0.
        link: usize,
        /// How many links there are.
        links: usize,
    },
    /// More elements than the fixed capacity holds.
    TooMany {
        /// What was being added.
        what: &'static str,
        /// How many fit.
        capacity: usize,
    },
    /// The reduced inertia is not positive at this angle: nothing with mass moves there.
    NoInertia {
        /// Angle of the drive link (rad).
        phi: f64,
    },
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
        /// Torque error of the largest table that fits (N·m).
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
            Self::DeadPoint { phi } => write!(
                f,
                "dead point: the drive link cannot move the mechanism at φ = {:.2}°",
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
            Self::NoInertia { phi } => write!(
                f,
                "the reduced inertia is not positive at φ = {:.2}°: give the drive link or its flywheel an inertia",
                phi.to_degrees()
            ),
            Self::Overflow { base, cell } => write!(
                f,
                "a curve leaves the fixed-point range in table cell {cell}: choose a larger {base} base"
            ),
            Self::NoImage(name) => write!(
                f,
                "tables of {name} are not stored in images: use f32 or q31"
            ),
            Self::Table(error) => error.fmt(f),
            Self::TorqueErrorNotReached {
                asked,
                reached,
                cells,
            } => write!(
                f,
                "no table meets a torque error of {asked:e} N m: {cells} cells reach {reached:.3e} N m; \
                 allow a larger error, or smooth the load (longer ramps)"
            ),
            Self::BufferTooShort { needed, given } => {
                write!(
                    f,
                    "the buffer holds {given} elements, but {needed} are needed"
                )
            }
        }
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
