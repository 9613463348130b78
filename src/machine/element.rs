//! Force elements: springs and dampers between two markers.
//!
//! ```text
//! spring          U = ½·k·(l − l₀)²        U′ = k·(l − l₀)·l′         l: distance of the two points
//! torsion spring  U = ½·c·(θ − θ₀)²        U′ = c·(θ − θ₀)·θ′         θ: angle of the second marker against the first
//! damper          b = d·l′²                torsion damper  b = d·θ′²
//! ```

use crate::machine::joint::{Marker, Wrench};
use crate::machine::link::Frame;
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::{finite, not_negative, positive};
use crate::number::transfer::Transfer;

/// Greatest number of force elements of a machine.
pub const MAX_ELEMENTS: usize = 8;

/// The law of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ElementLaw {
    /// A spring along the line between the points.
    Spring {
        /// k (N/m).
        stiffness: f64,
        /// l₀ (m).
        free_length: f64,
    },
    /// A spring between the directions.
    TorsionSpring {
        /// c (N·m/rad).
        stiffness: f64,
        /// θ₀ (rad).
        free_angle: f64,
    },
    /// A damper along the line between the points.
    Damper {
        /// d (N·s/m).
        coefficient: f64,
    },
    /// A damper between the directions.
    TorsionDamper {
        /// d (N·m·s/rad).
        coefficient: f64,
    },
}

/// A spring or a damper between two markers, each on a link or on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Element {
    between: [Marker; 2],
    law: ElementLaw,
}

/// An element's share of the reduction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Share {
    /// U (J), U′ (N·m).
    pub(crate) potential_energy: [f64; 2],
    /// b (N·m·s/rad).
    pub(crate) viscous: f64,
}

impl Element {
    /// A spring of `stiffness` k (N/m) whose force is zero at the `free_length` l₀ (m); it pulls when longer and pushes when shorter.
    ///
    /// # Errors
    /// A stiffness that is not positive, a free length that is negative, or a marker that is not finite.
    pub fn spring(
        between: [Marker; 2],
        stiffness: f64,
        free_length: f64,
    ) -> Result<Self, RangeError> {
        let law = ElementLaw::Spring {
            stiffness: positive("spring stiffness", stiffness)?,
            free_length: not_negative("free length of the spring", free_length)?,
        };
        Self::new(between, law)
    }

    /// A torsion spring of `stiffness` c (N·m/rad) whose moment is zero where the second marker's direction is turned by `free_angle` θ₀ (rad)
    /// against the first's.
    ///
    /// # Errors
    /// A stiffness that is not positive, or a value that is not finite.
    pub fn torsion_spring(
        between: [Marker; 2],
        stiffness: f64,
        free_angle: f64,
    ) -> Result<Self, RangeError> {
        let law = ElementLaw::TorsionSpring {
            stiffness: positive("torsion spring stiffness", stiffness)?,
            free_angle: finite("free angle of the torsion spring", free_angle)?,
        };
        Self::new(between, law)
    }

    /// A damper with the `coefficient` d (N·s/m) along the line between its points.
    ///
    /// # Errors
    /// A coefficient that is negative, or a value that is not finite.
    pub fn damper(between: [Marker; 2], coefficient: f64) -> Result<Self, RangeError> {
        let coefficient = not_negative("damper coefficient", coefficient)?;
        Self::new(between, ElementLaw::Damper { coefficient })
    }

    /// A torsion damper with the `coefficient` d (N·m·s/rad).
    ///
    /// # Errors
    /// A coefficient that is negative, or a value that is not finite.
    pub fn torsion_damper(between: [Marker; 2], coefficient: f64) -> Result<Self, RangeError> {
        let coefficient = not_negative("torsion damper coefficient", coefficient)?;
        Self::new(between, ElementLaw::TorsionDamper { coefficient })
    }

    fn new(between: [Marker; 2], law: ElementLaw) -> Result<Self, RangeError> {
        between[0].check()?;
        between[1].check()?;
        Ok(Self { between, law })
    }

    /// Stiffness (N/m, or N·m/rad) and free length (m), or free angle (rad), of a spring; `None` for a damper.
    #[must_use]
    pub const fn spring_rate(&self) -> Option<[f64; 2]> {
        match self.law {
            ElementLaw::Spring {
                stiffness,
                free_length,
            } => Some([stiffness, free_length]),
            ElementLaw::TorsionSpring {
                stiffness,
                free_angle,
            } => Some([stiffness, free_angle]),
            ElementLaw::Damper { .. } | ElementLaw::TorsionDamper { .. } => None,
        }
    }

    /// Whether it acts on the angle between its bodies instead of the distance of its points.
    #[must_use]
    pub const fn is_torsional(&self) -> bool {
        matches!(
            self.law,
            ElementLaw::TorsionSpring { .. } | ElementLaw::TorsionDamper { .. }
        )
    }

    /// The law.
    pub const fn law(&self) -> ElementLaw {
        self.law
    }

    /// The two markers.
    pub const fn between(&self) -> [Marker; 2] {
        self.between
    }

    /// Length l (m) of a spring or damper, angle θ (rad) of a torsional one.
    #[must_use]
    pub fn length(&self, frames: &[Frame]) -> Transfer {
        let [a, b] = &self.between;
        match self.law {
            ElementLaw::Spring { .. } | ElementLaw::Damper { .. } => {
                let [x, y] = self.line(frames);
                (x * x + y * y).sqrt()
            }
            ElementLaw::TorsionSpring { .. } | ElementLaw::TorsionDamper { .. } => {
                b.direction(frames) - a.direction(frames)
            }
        }
    }

    /// The vector from the first point to the second.
    fn line(&self, frames: &[Frame]) -> [Transfer; 2] {
        let ([x_a, y_a], [x_b, y_b]) = (
            self.between[0].position(frames),
            self.between[1].position(frames),
        );
        [x_b - x_a, y_b - y_a]
    }

    /// The element's force (N) or moment (N·m) on its second marker in the direction of growing length, at speed ω.
    #[must_use]
    pub fn effort(&self, frames: &[Frame], omega: f64) -> f64 {
        let length = self.length(frames);
        match self.law {
            ElementLaw::Spring {
                stiffness,
                free_length: free,
            }
            | ElementLaw::TorsionSpring {
                stiffness,
                free_angle: free,
            } => -stiffness * (length.value - free),
            ElementLaw::Damper { coefficient } | ElementLaw::TorsionDamper { coefficient } => {
                -coefficient * length.velocity(omega)
            }
        }
    }

    /// The element's share; `None` where its ends meet, because its direction is undefined there.
    pub(crate) fn reduce(&self, frames: &[Frame]) -> Option<Share> {
        let length = self.length(frames);
        if !length.d1.is_finite() {
            return None;
        }
        Some(match self.law {
            ElementLaw::Spring {
                stiffness,
                free_length: free,
            }
            | ElementLaw::TorsionSpring {
                stiffness,
                free_angle: free,
            } => {
                let stretch = length.value - free;
                Share {
                    potential_energy: [
                        0.5 * stiffness * stretch * stretch,
                        stiffness * stretch * length.d1,
                    ],
                    viscous: 0.0,
                }
            }
            ElementLaw::Damper { coefficient } | ElementLaw::TorsionDamper { coefficient } => {
                Share {
                    potential_energy: [0.0; 2],
                    viscous: coefficient * length.d1 * length.d1,
                }
            }
        })
    }

    /// The wrenches on its two bodies at speed ω (rad/s); `None` where its ends meet, because its direction is undefined there.
    #[must_use]
    pub fn wrenches(&self, frames: &[Frame], omega: f64) -> Option<[Wrench; 2]> {
        let [a, b] = &self.between;
        let effort = self.effort(frames, omega);
        Some(match self.law {
            ElementLaw::Spring { .. } | ElementLaw::Damper { .. } => {
                let line = self.line(frames).map(|c| c.value);
                let length = math::sqrt(line[0] * line[0] + line[1] * line[1]);
                if length <= 0.0 {
                    return None;
                }
                let force = line.map(|c| effort * c / length);
                let at = |marker: &Marker| marker.position(frames).map(|c| c.value);
                [
                    Wrench::force(a.body, at(a), force).times(-1.0),
                    Wrench::force(b.body, at(b), force),
                ]
            }
            ElementLaw::TorsionSpring { .. } | ElementLaw::TorsionDamper { .. } => [
                Wrench::moment(a.body, -effort),
                Wrench::moment(b.body, effort),
            ],
        })
    }
}
