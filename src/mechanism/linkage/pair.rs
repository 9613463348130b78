//! Kinematic pairs: the constraint equations f(q, φ) = 0 of a linkage, (76).
//!
//! Each equation is written once, with [`Transfer`] arithmetic. Its value is the residual of (76). With the derivatives of the links' coordinates
//! inserted, its derivatives are those of (77), (78) and one order higher; with a single derivative seeded it gives a column of the Jacobian.

use crate::machine::joint::{Body, Joint, Marker, Wrench};
use crate::machine::link::Frame;
use crate::math;
use crate::mechanism::linkage::LinkageError;
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;

use super::cam::{Cams, PlacedCam};

/// A connection of two links of a linkage.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Pair {
    /// A pin, a guide, a rigid connection or a pin in a slot. A [`Joint::Transmission`] is not a pair, because its geometry is unknown.
    Joint(Joint),
    /// Two gears that roll on each other.
    Gears {
        /// The gears' centres, each a marker on its gear.
        centres: [Marker; 2],
        /// The body in which both gears turn: the ground, or the carrier of a planetary gear.
        carrier: Body,
        /// Pitch radii (m); the radius of a ring gear is negative. Their sum is the distance of the centres.
        radii: [f64; 2],
        /// r₁·(ψ₁ − ψ_c) + r₂·(ψ₂ − ψ_c) (m): the phase of the mesh.
        phase: f64,
    },
    /// A pinion that rolls on a rack.
    Rack {
        /// Centre of the pinion.
        pinion: Marker,
        /// A point of the rack with the direction of its pitch line.
        rack: Marker,
        /// Pitch radius (m); positive when the pinion lies to the left of the direction.
        radius: f64,
        /// a·(C − R) + r·(ψ_pinion − ψ_rack) (m): the phase of the mesh.
        phase: f64,
    },
    /// An open belt (or a chain) between two pulleys that turn in the ground.
    Belt {
        /// The pulleys' centres, each a marker on its pulley.
        centres: [Marker; 2],
        /// Radii (m); a negative one for a crossed belt.
        radii: [f64; 2],
        /// r₁·ψ₁ − r₂·ψ₂ (m).
        phase: f64,
    },
    /// A disc cam that moves a follower, roller or flat face. The roller is part of the follower; its spin is not modelled.
    Cam {
        /// A point of the cam with the zero direction of its angle.
        cam: Marker,
        /// For a translating follower a point: the roller's centre, or where the guide's axis meets the face. For an oscillating one the direction:
        /// of the arm from its pivot to the roller's centre, or of the face.
        follower: Marker,
        /// Index of the [`PlacedCam`] in the linkage.
        place: usize,
    },
}

/// Vector from the first marker's point to the second's.
#[inline(always)]
fn apart(a: &Marker, b: &Marker, frames: &[Frame]) -> [Transfer; 2] {
    let ([x_a, y_a], [x_b, y_b]) = (a.position(frames), b.position(frames));
    [x_b - x_a, y_b - y_a]
}

impl Pair {
    /// Gears with the phase of the mesh at `frames`.
    #[must_use]
    pub fn gears(centres: [Marker; 2], carrier: Body, radii: [f64; 2], frames: &[Frame]) -> Self {
        let open = Self::Gears {
            centres,
            carrier,
            radii,
            phase: 0.0,
        };
        open.meshing_at(frames)
    }

    /// The same pair, with the phase of the mesh at `frames`.
    #[must_use]
    pub fn meshing_at(mut self, frames: &[Frame]) -> Self {
        let now = self.equation(0, frames, &Cams::<0>::new()).value;
        match &mut self {
            Self::Joint(_) | Self::Cam { .. } => {}
            Self::Gears { phase, .. } | Self::Rack { phase, .. } | Self::Belt { phase, .. } => {
                *phase += now;
            }
        }
        self
    }

    /// The two markers; for a transmission, which is not a pair, two points of the ground.
    #[must_use]
    pub const fn markers(&self) -> [Marker; 2] {
        match self {
            Self::Joint(
                Joint::Revolute(m) | Joint::Prismatic(m) | Joint::Fixed(m) | Joint::PinInSlot(m),
            ) => *m,
            Self::Joint(Joint::Transmission(_)) => [Marker::ground([0.0, 0.0]); 2],
            Self::Gears { centres, .. } | Self::Belt { centres, .. } => *centres,
            Self::Rack { pinion, rack, .. } => [*pinion, *rack],
            Self::Cam { cam, follower, .. } => [*cam, *follower],
        }
    }

    /// The two bodies.
    #[must_use]
    pub const fn bodies(&self) -> [Body; 2] {
        let [a, b] = self.markers();
        [a.body, b.body]
    }

    /// Number of degrees of freedom that the pair removes: the number of its equations.
    #[must_use]
    pub const fn constraints(&self) -> usize {
        match self {
            Self::Joint(joint) => joint.constraints(),
            Self::Gears { .. } | Self::Rack { .. } | Self::Belt { .. } | Self::Cam { .. } => 1,
        }
    }

    /// Checks every number of the pair.
    pub(super) fn check(&self) -> Result<(), LinkageError> {
        let wheel = |radius: f64| {
            let radius = finite("radius of a wheel", radius)?;
            positive("radius of a wheel", math::abs(radius)).map(drop)
        };
        match self {
            Self::Joint(Joint::Transmission(_)) => return Err(LinkageError::NotAPair),
            Self::Joint(_) | Self::Cam { .. } => {}
            Self::Gears { radii, phase, .. } | Self::Belt { radii, phase, .. } => {
                finite("phase of the mesh", *phase)?;
                wheel(radii[0])?;
                wheel(radii[1])?;
            }
            Self::Rack { radius, phase, .. } => {
                finite("phase of the mesh", *phase)?;
                wheel(*radius)?;
            }
        }
        Ok(self.markers().iter().try_for_each(Marker::check)?)
    }

    /// The left-hand side of equation number `component`, which is zero where the pair is closed (m, or rad).
    #[inline(always)]
    pub(super) fn equation<const CAMS: usize>(
        &self,
        component: usize,
        frames: &[Frame],
        cams: &Cams<CAMS>,
    ) -> Transfer {
        match self {
            Self::Joint(joint) => joint_equation(joint, component, frames),
            Self::Gears {
                centres: [a, b],
                carrier,
                radii: [r_a, r_b],
                phase,
            } => {
                let psi = angle(*carrier, frames);
                (angle(a.body, frames) - psi) * *r_a + (angle(b.body, frames) - psi) * *r_b
                    - Transfer::constant(*phase)
            }
            Self::Belt {
                centres: [a, b],
                radii: [r_a, r_b],
                phase,
            } => {
                angle(a.body, frames) * *r_a
                    - angle(b.body, frames) * *r_b
                    - Transfer::constant(*phase)
            }
            Self::Rack {
                pinion,
                rack,
                radius,
                phase,
            } => {
                let [cos, sin] = rack.axis(frames);
                let [x, y] = apart(rack, pinion, frames);
                cos * x
                    + sin * y
                    + (angle(pinion.body, frames) - angle(rack.body, frames)) * *radius
                    - Transfer::constant(*phase)
            }
            Self::Cam {
                cam,
                follower,
                place,
            } => cam_equation([cam, follower], *place, frames, cams),
        }
    }

    /// The pair as a joint that carries forces, with the links at `frames`.
    pub(super) fn joint<const CAMS: usize>(&self, frames: &[Frame], cams: &Cams<CAMS>) -> Joint {
        let values = |v: [Transfer; 2]| v.map(|c| c.value);
        match self {
            Self::Joint(joint) => *joint,
            Self::Gears {
                centres: [a, b],
                radii: [r_a, r_b],
                ..
            } => {
                let [x, y] = values(a.position(frames));
                let [to_x, to_y] = values(apart(a, b, frames));
                let share = r_a / (r_a + r_b);
                let pitch_point = [x + share * to_x, y + share * to_y];
                let distance = math::sqrt(to_x * to_x + to_y * to_y);
                let tangent = [-to_y / distance, to_x / distance];
                Joint::contact([a.body, b.body], pitch_point, tangent)
            }
            Self::Rack {
                pinion,
                rack,
                radius,
                ..
            } => {
                let [x, y] = values(pinion.position(frames));
                let axis = values(rack.axis(frames));
                let point = [x + radius * axis[1], y - radius * axis[0]];
                Joint::contact([pinion.body, rack.body], point, axis)
            }
            Self::Belt {
                centres: [a, b],
                radii: [r_a, r_b],
                ..
            } => Joint::Transmission([
                Wrench::moment(a.body, -r_a / r_b),
                Wrench::moment(b.body, 1.0),
            ]),
            Self::Cam {
                cam,
                follower,
                place,
            } => match cams.get(*place) {
                Some(placed) if CAMS > 0 => placed.joint([cam, follower], frames),
                // Cannot occur: checked when the linkage was created.
                _ => Joint::contact([cam.body, follower.body], [0.0; 2], [0.0; 2]),
            },
        }
    }
}

/// The left-hand side of a joint's equation number `component`.
#[inline(always)]
fn joint_equation(joint: &Joint, component: usize, frames: &[Frame]) -> Transfer {
    match (joint, component) {
        (Joint::Revolute([a, b]), _) | (Joint::Fixed([a, b]), 0 | 1) => {
            position(b, component, frames) - position(a, component, frames)
        }
        (Joint::Prismatic([a, b]), 0) => off_line(a, b, frames),
        (Joint::Prismatic([a, b]) | Joint::Fixed([a, b]), _) => {
            angle(b.body, frames) - angle(a.body, frames)
                + Transfer::constant(b.angle() - a.angle())
        }
        (Joint::PinInSlot([pin, slot]), _) => off_line(slot, pin, frames),
        // Refused by `check`.
        (Joint::Transmission(_), _) => Transfer::constant(f64::NAN),
    }
}

/// The left-hand side of a cam's equation. A linkage without memory for cams has no code for them.
#[inline(always)]
fn cam_equation<const CAMS: usize>(
    markers: [&Marker; 2],
    place: usize,
    frames: &[Frame],
    cams: &Cams<CAMS>,
) -> Transfer {
    match cams.get(place) {
        Some(placed) if CAMS > 0 => moved(placed, markers, frames),
        // Cannot occur: checked when the linkage was created.
        _ => Transfer::constant(f64::NAN),
    }
}

/// Not inlined: all orders at once, from the program.
#[inline(never)]
fn moved(placed: &PlacedCam, markers: [&Marker; 2], frames: &[Frame]) -> Transfer {
    placed.equation(markers, frames, |theta| placed.displacement(theta))
}

/// Distance of the point of `point` to the left of the line through `line` along its direction.
#[inline(always)]
pub(super) fn off_line(line: &Marker, point: &Marker, frames: &[Frame]) -> Transfer {
    let [cos, sin] = line.axis(frames);
    let [x, y] = apart(line, point, frames);
    cos * y - sin * x
}

/// x (axis 0) or y of a marker's point.
#[inline(always)]
fn position(marker: &Marker, axis: usize, frames: &[Frame]) -> Transfer {
    let frame = marker.body.frame(frames);
    let [u, v] = marker.at;
    let (sin, cos) = frame.direction();
    if axis == 0 {
        frame.x + cos * u - sin * v
    } else {
        frame.y + sin * u + cos * v
    }
}

#[inline(always)]
fn angle(body: Body, frames: &[Frame]) -> Transfer {
    body.frame(frames).psi
}
