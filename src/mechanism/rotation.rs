//! Why a drive link cannot turn fully.

use core::fmt;

use super::grashof::{Cause, Remedy};
use crate::number::error::{Curable, error};

/// Why the drive link of a library mechanism cannot turn fully, with the angle where it stops.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum RotationError {
    /// A four-bar whose crank cannot turn freely.
    FourBar {
        /// Lengths of crank, coupler, rocker and ground (m).
        lengths: [f64; 4],
        /// Crank angles (rad) between which it moves. If there are two such ranges, symmetric about the line of the pivots, the one to the left of
        /// it.
        reach: [f64; 2],
    },
    /// A four-bar with a link as long as the others together.
    Apart {
        /// The link.
        link: &'static str,
        /// Its length (m).
        length: f64,
        /// Sum of the other three (m).
        others: f64,
    },
    /// The crank pin passes through the pivot of the slotted rocker.
    PinMeetsPivot {
        /// Crank length, equal to the distance of the pivots (m).
        length: f64,
    },
    /// The link to a slider no longer reaches the guide.
    TooShort {
        /// The link.
        link: &'static str,
        /// The first crank angle (rad, from 0) at which it fails.
        phi: f64,
        /// It must be longer than this (m).
        shortest: f64,
        /// Crank angles (rad) between which it reaches the guide: the range around φ = 0, or the first after it; `None`: nowhere.
        reach: Option<[f64; 2]>,
    },
}

error!(RotationError);

impl fmt::Display for RotationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Apart { .. } => "the links cannot be joined: ",
            _ => "the crank cannot turn fully: ",
        })?;
        match *self {
            Self::Apart {
                link,
                length,
                others,
            } => write!(
                f,
                "the {link} of {length:.6} m is not shorter than the other three together, {others:.6} m"
            ),
            Self::FourBar { lengths, .. } => Cause(lengths).fmt(f),
            Self::PinMeetsPivot { length } => write!(
                f,
                "it is as long as the distance of the pivots, {length} m, so its pin passes through the rocker's pivot at φ = \
                 180°"
            ),
            Self::TooShort { link, phi, .. } => write!(
                f,
                "the {link} no longer reaches the guide at φ = {:.2}°",
                phi.to_degrees()
            ),
        }
    }
}

impl Curable for RotationError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Apart { .. } => f.write_str("shorten it, or make the others longer"),
            Self::FourBar { lengths, reach } => write!(
                f,
                "{}, or drive it over a stroke that stays inside φ = {:.2}° and {:.2}°, its dead points",
                Remedy(lengths),
                reach[0].to_degrees(),
                reach[1].to_degrees()
            ),
            Self::PinMeetsPivot { .. } => f.write_str(
                "make it shorter for a rocker that swings, or longer for one that turns",
            ),
            Self::TooShort {
                link,
                shortest,
                reach,
                ..
            } => {
                write!(f, "make the {link} longer than {shortest:.6} m, ")?;
                match reach {
                    None => f.write_str("or shorten the crank"),
                    Some([from, to]) => write!(
                        f,
                        "shorten the crank, or drive it over a stroke that stays inside φ = {:.2}° and {:.2}°, its dead points",
                        from.to_degrees(),
                        to.to_degrees()
                    ),
                }
            }
        }
    }
}
