//! The part in contact with the cam.

use crate::machine::link::{Link, MassProperties};
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::{finite, positive};

/// Direction of rotation of an oscillating follower when it rises.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Swing {
    /// Counter-clockwise: ψ grows with s.
    #[default]
    CounterClockwise,
    /// Clockwise: ψ falls as s grows.
    Clockwise,
}

impl Swing {
    /// +1 or −1.
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::CounterClockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }
}

/// Dimensions and mass of a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RollerDimensions {
    /// Radius (m).
    pub radius: f64,
    /// Mass (kg).
    pub mass: f64,
    /// Inertia about its own axis (kg·m²), of everything that turns with it.
    pub inertia: f64,
}

/// A roller, which turns about its centre in the follower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roller {
    radius: f64,
    link: Link,
}

impl Roller {
    /// A roller of these dimensions.
    ///
    /// # Errors
    /// A radius that is not positive, a mass or an inertia that is negative, or a value not finite.
    pub fn new(dimensions: RollerDimensions) -> Result<Self, RangeError> {
        Ok(Self {
            radius: positive("roller radius", dimensions.radius)?,
            link: Link::new(MassProperties {
                mass: dimensions.mass,
                inertia: dimensions.inertia,
                com: [0.0, 0.0],
            })?,
        })
    }

    /// Radius (m).
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Mass properties.
    pub const fn link(&self) -> Link {
        self.link
    }
}

/// The follower: its guide and its contact with the cam. The cam's pivot is the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follower {
    /// Slides along x = offset, upwards when it rises; a roller touches the cam.
    TranslatingRoller {
        /// x of the guide and of the roller's centre (m).
        offset: f64,
        /// The roller.
        roller: Roller,
    },
    /// Slides along x = offset, upwards when it rises; a flat face across the guide touches the cam.
    TranslatingFace {
        /// x of the guide (m). It does not change the motion, only the forces in the guide.
        offset: f64,
    },
    /// Swings about a pivot; a roller at the end of an arm touches the cam.
    OscillatingRoller {
        /// The follower's pivot A (m).
        pivot: [f64; 2],
        /// From the pivot to the roller's centre (m).
        arm: f64,
        /// Direction of rotation when it rises.
        swing: Swing,
        /// The roller.
        roller: Roller,
    },
    /// Swings about a pivot; a flat face touches the cam.
    OscillatingFace {
        /// The follower's pivot A (m).
        pivot: [f64; 2],
        /// Distance of the face's plane from the pivot towards the cam (m); negative: away from it.
        offset: f64,
        /// Direction of rotation when it rises.
        swing: Swing,
    },
}

impl Follower {
    /// The roller; `None` for a face.
    #[must_use]
    pub const fn roller(&self) -> Option<&Roller> {
        match self {
            Self::TranslatingRoller { roller, .. } | Self::OscillatingRoller { roller, .. } => {
                Some(roller)
            }
            Self::TranslatingFace { .. } | Self::OscillatingFace { .. } => None,
        }
    }

    /// Pivot and swing of an oscillating follower.
    #[must_use]
    pub const fn pivot(&self) -> Option<([f64; 2], Swing)> {
        match self {
            Self::OscillatingRoller { pivot, swing, .. }
            | Self::OscillatingFace { pivot, swing, .. } => Some((*pivot, *swing)),
            Self::TranslatingRoller { .. } | Self::TranslatingFace { .. } => None,
        }
    }

    /// Radius of the roller; zero for a face.
    pub(super) const fn roller_radius(&self) -> f64 {
        match self.roller() {
            Some(roller) => roller.radius,
            None => 0.0,
        }
    }

    /// Checks each number separately.
    pub(super) fn check(&self) -> Result<(), RangeError> {
        match *self {
            Self::TranslatingRoller { offset, .. } | Self::TranslatingFace { offset } => {
                finite("offset of the guide", offset)?;
            }
            Self::OscillatingRoller { arm, .. } => {
                positive("length of the arm", arm)?;
            }
            Self::OscillatingFace { offset, .. } => {
                finite("offset of the face", offset)?;
            }
        }
        if let Some((pivot, _)) = self.pivot() {
            finite("pivot x", pivot[0])?;
            finite("pivot y", pivot[1])?;
            positive("distance of the pivots", distance(pivot))?;
        }
        Ok(())
    }
}

/// Distance from the cam's pivot.
pub(super) fn distance([x, y]: [f64; 2]) -> f64 {
    math::sqrt(x * x + y * y)
}
