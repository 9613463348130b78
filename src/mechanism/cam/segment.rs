//! One segment of a cam program.

use crate::machine::motion::{End, Law, Polynomial};
use crate::mechanism::cam::CamError;
use crate::number::transfer::Transfer;

/// The follower's motion between the ends of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Shape {
    /// It stands still (R, rest).
    Dwell,
    /// By a motion law, from rest to rest (R-R).
    Law(Law),
    /// By the polynomial of fifth degree with the given s′ and s″ at both ends: every transition between rest (R: 0, 0), constant velocity (G: s′,
    /// 0), reversal (U: 0, s″) and motion (B: s′, s″).
    Polynomial {
        /// s′ (m/rad, or rad/rad) and s″ at the start.
        start: [f64; 2],
        /// s′ and s″ at the end.
        end: [f64; 2],
    },
}

/// A part of the turn of a cam: an angle of the cam, and the follower's rise in it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Segment {
    /// Angle of the cam (rad).
    pub angle: f64,
    /// Rise of the follower (m; rad for one that swings); negative for a return.
    pub rise: f64,
    /// The motion in it.
    pub shape: Shape,
}

impl Segment {
    /// The follower stands still over `angle` (rad).
    #[must_use]
    pub const fn dwell(angle: f64) -> Self {
        Self {
            angle,
            rise: 0.0,
            shape: Shape::Dwell,
        }
    }

    /// A rise (m or rad; negative: a return) from rest to rest over `angle` (rad).
    #[must_use]
    pub const fn law(law: Law, angle: f64, rise: f64) -> Self {
        Self {
            angle,
            rise,
            shape: Shape::Law(law),
        }
    }

    /// A transition over `angle` (rad) with given [s′, s″] at both ends.
    #[must_use]
    pub const fn polynomial(angle: f64, rise: f64, start: [f64; 2], end: [f64; 2]) -> Self {
        Self {
            angle,
            rise,
            shape: Shape::Polynomial { start, end },
        }
    }

    /// A rise over `angle` (rad) at the constant velocity s′ = rise/angle (G).
    #[must_use]
    pub const fn constant_velocity(angle: f64, rise: f64) -> Self {
        let ends = [rise / angle, 0.0];
        Self::polynomial(angle, rise, ends, ends)
    }

    /// Checks segment number `index` of a program.
    pub(super) fn check(&self, index: usize) -> Result<(), CamError> {
        let segment = index;
        let finite = |ok: bool| {
            if ok {
                Ok(())
            } else {
                Err(CamError::NotFinite { segment })
            }
        };
        finite(self.angle.is_finite() && self.rise.is_finite())?;
        if self.angle <= 0.0 {
            return Err(CamError::Angle {
                segment,
                angle: self.angle,
            });
        }
        match self.shape {
            Shape::Dwell if self.rise != 0.0 => Err(CamError::DwellRises {
                segment,
                rise: self.rise,
            }),
            Shape::Law(law) => law.check().map_err(|_| CamError::Shares { segment }),
            Shape::Polynomial { start, end } => {
                finite(start.iter().chain(&end).all(|value| value.is_finite()))
            }
            Shape::Dwell => Ok(()),
        }
    }

    /// The shares of its angle where a derivative jumps, excluding its ends.
    pub(in crate::mechanism) fn breaks(&self) -> [Option<f64>; 6] {
        match self.shape {
            Shape::Law(law) => law.breaks(),
            Shape::Dwell | Shape::Polynomial { .. } => [None; 6],
        }
    }

    /// s′ at the start and at the end.
    pub(super) const fn end_speeds(&self) -> [f64; 2] {
        match self.shape {
            Shape::Dwell | Shape::Law(_) => [0.0; 2],
            Shape::Polynomial { start, end } => [start[0], end[0]],
        }
    }

    /// The displacement from the segment's start at the share z (0 to 1) of its angle.
    pub(in crate::mechanism) fn at(&self, z: f64) -> Transfer {
        let (angle, rise) = (self.angle, self.rise);
        let [s, v, a, j] = match self.shape {
            Shape::Dwell => return Transfer::constant(0.0),
            Shape::Law(law) => {
                let [s, v, a] = law.at(z);
                [s, v, a, law.jerk(z)].map(|c| c * rise)
            }
            Shape::Polynomial { start, end } => {
                let [start, end] = [start, end].map(|[v, a]| End::new(v, a));
                let [value, d1, d2, d3] =
                    Polynomial::between(rise, angle, start, end).at(z * angle);
                return Transfer { value, d1, d2, d3 };
            }
        };
        Transfer {
            value: s,
            d1: v / angle,
            d2: a / (angle * angle),
            d3: j / (angle * angle * angle),
        }
    }
}
