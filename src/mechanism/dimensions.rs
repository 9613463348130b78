//! Dimensions that do not fit together.

use core::fmt;

use crate::machine::Link;
use crate::math;
use crate::number::error::{Curable, error};

/// Why dimensions that are possible individually do not form a mechanism of the library.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum DimensionError {
    /// The pivot of a slotted lever lies where the slot cannot follow the crank pin through a whole turn.
    ChangePoint {
        /// Distance of the pivots (m).
        centres: f64,
        /// The lever rocks if the distance is larger than this (m).
        rocking: f64,
        /// The lever turns if the distance is smaller than this (m); never if this is not positive.
        turning: f64,
    },
    /// A four-bar that is to be kept on its branch, but never lies flat.
    NeverFlat {
        /// Sum of the shortest and the longest link (m).
        ends: f64,
        /// Sum of the other two (m).
        others: f64,
    },
    /// A four-bar that passes one change point per turn: it returns after two turns of the crank.
    TwoTurns,
    /// A four-bar with equal lengths of crank and coupler, rocker and ground, on the branch with a stationary rocker.
    RockerStands,
    /// The centre of mass of the named link is off its axis, and the link does not turn once per turn of the drive link.
    OffAxis {
        /// The link.
        link: &'static str,
        /// Distance of the centre of mass from the axis (m).
        distance: f64,
    },
    /// The planets' teeth do not fill the gap between sun and ring.
    PlanetTeeth {
        /// Teeth of a planet.
        planet: u32,
        /// Teeth of the ring minus those of the sun.
        gap: u32,
    },
    /// Equally spaced planets do not mesh with sun and ring.
    PlanetSpacing {
        /// Teeth of sun plus ring.
        teeth: u32,
        /// Number of planets.
        planets: u32,
    },
    /// Planets of this size would overlap.
    PlanetsOverlap {
        /// Number of planets.
        planets: u32,
        /// Greatest number of planets of this size.
        most: u32,
    },
    /// The named member of a planetary gear is both fixed and input.
    FixedInput(&'static str),
}

error!(DimensionError);

impl fmt::Display for DimensionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ChangePoint { centres, .. } => write!(
                f,
                "the slot cannot follow the crank pin through a whole turn: the pivots are {centres} m apart"
            ),
            Self::NeverFlat { ends, others } => write!(
                f,
                "there is no change point to pass: shortest and longest link together are {ends:.6} m, the other two \
                 {others:.6} m"
            ),
            Self::TwoTurns => f.write_str(
                "the linkage lies flat once in a turn of the crank and leaves on the other side, so it comes back after two \
                 turns",
            ),
            Self::RockerStands => f.write_str(
                "the rocker stands still on this side: the rocker pin stays at the crank's pivot, and the coupler lies on \
                 the crank",
            ),
            Self::OffAxis { link, distance } => write!(
                f,
                "the centre of mass of the {link} is {distance} m off its axis, so its weight does not repeat with every \
                 turn of the drive link"
            ),
            Self::PlanetTeeth { planet, gap } => write!(
                f,
                "planets with {planet} teeth do not fill the gap between sun and ring: ring less sun, {gap}, must be \
                 twice the planet's teeth, give or take 2 with profile shift"
            ),
            Self::PlanetSpacing { teeth, planets } => write!(
                f,
                "{planets} equally spaced planets do not mesh: the teeth of sun and ring together, {teeth}, must be \
                 divisible by the number of planets"
            ),
            Self::PlanetsOverlap { planets, most } => write!(
                f,
                "{planets} planets of this size overlap: at most {most} fit round the sun"
            ),
            Self::FixedInput(member) => {
                write!(f, "the {member} is fixed and cannot be the input as well")
            }
        }
    }
}

impl Curable for DimensionError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ChangePoint {
                rocking, turning, ..
            } => {
                write!(
                    f,
                    "make it more than crank + |offset| = {rocking} m for a lever that rocks"
                )?;
                if turning > 0.0 {
                    write!(
                        f,
                        ", or less than crank − |offset| = {turning} m for one that turns"
                    )?;
                }
                Ok(())
            }
            Self::NeverFlat { .. } => f.write_str(
                "do not guide it through change points: this linkage stays on the branch on which it is assembled",
            ),
            Self::TwoTurns => {
                f.write_str("drive it over a stroke, at most of two turns for the whole motion")
            }
            Self::RockerStands => f.write_str("take the other side"),
            Self::OffAxis { .. } => f.write_str("balance it: centre of mass [0, 0]"),
            Self::PlanetTeeth { gap, .. } => write!(f, "give the planets {} teeth", gap / 2),
            Self::PlanetSpacing { .. } => f.write_str("change the teeth or the number of planets"),
            Self::PlanetsOverlap { .. } => f.write_str("choose fewer planets, or smaller ones"),
            Self::FixedInput(_) => f.write_str("choose another member for one of the two"),
        }
    }
}

/// Checks that a link's centre of mass lies on its axis, the origin of its frame.
pub(super) fn centred(name: &'static str, link: &Link) -> Result<(), DimensionError> {
    if link.is_centred() {
        return Ok(());
    }
    let [u, v] = link.com();
    let distance = math::sqrt(u * u + v * v);
    Err(DimensionError::OffAxis {
        link: name,
        distance,
    })
}
