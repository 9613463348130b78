//! Joints: connections of links, and their reactions.
//!
//! A joint connects two *markers*, each a point with a direction on a link or on the ground. It removes as many of a link's three degrees of freedom
//! as it has unknown reactions: two forces in a pin, a force and a moment in a guide.

use crate::machine::link::Frame;
use crate::machine::mechanism::MAX_LINKS;
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::finite;
use crate::number::transfer::Transfer;

/// Greatest number of joints of a mechanism: each of the links' degrees of freedom except the drive's may be removed by a separate joint.
pub const MAX_JOINTS: usize = 2 * MAX_LINKS;

/// The joints of a mechanism.
pub type Joints = heapless::Vec<Joint, MAX_JOINTS>;

/// A body that a joint connects: the ground (frame), or a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Body {
    /// The fixed frame.
    Ground,
    /// A link, by its index in [`Mechanism::links`](crate::machine::Mechanism::links).
    Link(usize),
}

impl Body {
    /// Index of the link; `None` for the ground.
    #[must_use]
    pub const fn link(self) -> Option<usize> {
        match self {
            Self::Ground => None,
            Self::Link(link) => Some(link),
        }
    }

    /// The frame of the body. A link without a frame counts as ground; mechanisms check their joints when created.
    #[inline]
    #[must_use]
    pub fn frame(self, frames: &[Frame]) -> &Frame {
        self.link()
            .and_then(|link| frames.get(link))
            .unwrap_or(&Frame::GROUND)
    }
}

/// A point of a body with a direction through it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Marker {
    /// The body of the marker.
    pub body: Body,
    /// The point [u, v] in the body's frame (m).
    pub at: [f64; 2],
    angle: f64,
    /// Cosine and sine of `angle`.
    axis: [f64; 2],
}

impl Marker {
    /// A point on the ground, in global coordinates (m).
    #[must_use]
    pub const fn ground(at: [f64; 2]) -> Self {
        Self {
            body: Body::Ground,
            at,
            angle: 0.0,
            axis: [1.0, 0.0],
        }
    }

    /// A point `[u, v]` (m) of link number `link`.
    #[must_use]
    pub const fn on(link: usize, at: [f64; 2]) -> Self {
        Self {
            body: Body::Link(link),
            at,
            angle: 0.0,
            axis: [1.0, 0.0],
        }
    }

    /// The same point with a direction (rad, from the body's u axis).
    #[must_use]
    pub fn with_angle(self, angle: f64) -> Self {
        let (sin, cos) = math::sin_cos(angle);
        Self {
            angle,
            axis: [cos, sin],
            ..self
        }
    }

    /// The direction, from the body's u axis (rad): the axis of a guide or a slot, the zero of an angle.
    #[must_use]
    pub const fn angle(&self) -> f64 {
        self.angle
    }

    /// Checks that all numbers are finite.
    ///
    /// # Errors
    /// A coordinate or the direction that is not finite.
    pub fn check(&self) -> Result<(), RangeError> {
        finite("marker u", self.at[0])?;
        finite("marker v", self.at[1])?;
        finite("marker direction", self.angle)?;
        Ok(())
    }

    /// The point in global coordinates.
    #[inline]
    #[must_use]
    pub fn position(&self, frames: &[Frame]) -> [Transfer; 2] {
        self.body.frame(frames).point(self.at)
    }

    /// The direction's angle from +x.
    #[inline]
    #[must_use]
    pub fn direction(&self, frames: &[Frame]) -> Transfer {
        self.body.frame(frames).psi + Transfer::constant(self.angle)
    }

    /// The direction as a unit vector.
    #[inline]
    #[must_use]
    pub fn axis(&self, frames: &[Frame]) -> [Transfer; 2] {
        self.body.frame(frames).vector(self.axis)
    }
}

/// A force and a moment on a body, both as numbers at one position.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Wrench {
    /// The body that the wrench acts on.
    pub body: Body,
    /// Point of application, global (m).
    pub point: [f64; 2],
    /// Force, global components (N).
    pub force: [f64; 2],
    /// Moment in addition to the force's (N·m), counter-clockwise positive.
    pub moment: f64,
}

impl Wrench {
    /// A force at a point.
    #[must_use]
    pub const fn force(body: Body, point: [f64; 2], force: [f64; 2]) -> Self {
        Self {
            body,
            point,
            force,
            moment: 0.0,
        }
    }

    /// A moment.
    #[must_use]
    pub const fn moment(body: Body, moment: f64) -> Self {
        Self {
            body,
            point: [0.0, 0.0],
            force: [0.0, 0.0],
            moment,
        }
    }

    /// The same times `k`.
    #[must_use]
    pub fn times(self, k: f64) -> Self {
        Self {
            force: [self.force[0] * k, self.force[1] * k],
            moment: self.moment * k,
            ..self
        }
    }

    /// The same wrench on another body: with `times(-1.0)`, action and reaction.
    #[must_use]
    pub const fn acting_on(self, body: Body) -> Self {
        Self { body, ..self }
    }

    /// Moment about the point `about` (N·m).
    #[must_use]
    pub fn moment_about(&self, about: [f64; 2]) -> f64 {
        let arm = [self.point[0] - about[0], self.point[1] - about[1]];
        arm[0] * self.force[1] - arm[1] * self.force[0] + self.moment
    }
}

/// A joint between two bodies. Its reaction acts from the first body on the second.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Joint {
    /// Pin: the two points coincide. Reaction: a force.
    Revolute([Marker; 2]),
    /// Guide: the second point stays on the line through the first marker along its direction, and the two directions
    /// agree. Reaction: a force across the line, at the second point, and a moment.
    Prismatic([Marker; 2]),
    /// Rigid: points and directions coincide. Reaction: a force and a moment.
    Fixed([Marker; 2]),
    /// The first marker's point, a pin, stays on the line through the second marker, a slot, along its direction.
    /// Reaction: a force across the slot, at the pin, on the slot's body.
    PinInSlot([Marker; 2]),
    /// A transmission: teeth in mesh, a belt, a cam on its follower, a rope, a screw. The wrenches of one unit of its effort on the first and on the
    /// second body; the ground takes the difference to action = reaction.
    Transmission([Wrench; 2]),
}

/// The unknown reactions of one joint: for each, the wrenches of one unit on the first and on the second body.
pub type UnitReactions = heapless::Vec<[Wrench; 2], 3>;

impl Joint {
    /// Two surfaces in contact at `point` (m): a unit of effort pushes the second body along `normal`, and the first in the opposite direction.
    #[must_use]
    pub fn contact(bodies: [Body; 2], point: [f64; 2], normal: [f64; 2]) -> Self {
        let on_second = Wrench::force(bodies[1], point, normal);
        Self::Transmission([on_second.times(-1.0).acting_on(bodies[0]), on_second])
    }

    /// The two bodies: the first acts on the second.
    #[must_use]
    pub const fn bodies(&self) -> [Body; 2] {
        match self {
            Self::Revolute([a, b])
            | Self::Prismatic([a, b])
            | Self::Fixed([a, b])
            | Self::PinInSlot([a, b]) => [a.body, b.body],
            Self::Transmission([a, b]) => [a.body, b.body],
        }
    }

    /// Number of degrees of freedom that the joint removes.
    #[must_use]
    pub const fn constraints(&self) -> usize {
        match self {
            Self::Fixed(_) => 3,
            Self::Revolute(_) | Self::Prismatic(_) => 2,
            Self::PinInSlot(_) | Self::Transmission(_) => 1,
        }
    }

    /// The joint's free coordinate: the angle (rad) or displacement (m) of the second marker against the first, of a pin along its slot; zero for the
    /// other kinds.
    #[inline]
    #[must_use]
    pub fn coordinate(&self, frames: &[Frame]) -> Transfer {
        match self {
            Self::Revolute([a, b]) => b.direction(frames) - a.direction(frames),
            Self::Prismatic([a, b]) => {
                let [cos, sin] = a.axis(frames);
                let ([x_a, y_a], [x_b, y_b]) = (a.position(frames), b.position(frames));
                cos * (x_b - x_a) + sin * (y_b - y_a)
            }
            Self::PinInSlot([pin, slot]) => Self::Prismatic([*slot, *pin]).coordinate(frames),
            _ => Transfer::constant(0.0),
        }
    }

    /// The wrenches of a unit of drive effort in this joint's free coordinate on the first and the second body: a moment (1 N·m) in a pin, a force (1
    /// N) along a guide, or of the slot on its pin.
    #[must_use]
    pub fn unit_drive(&self, frames: &[Frame]) -> [Wrench; 2] {
        let [first, second] = self.bodies();
        let on_second = match self {
            Self::Prismatic([a, b]) => {
                let axis = a.axis(frames).map(|c| c.value);
                Wrench::force(second, b.position(frames).map(|c| c.value), axis)
            }
            Self::PinInSlot([pin, slot]) => {
                let [on_slot, on_pin] = Self::Prismatic([*slot, *pin]).unit_drive(frames);
                return [on_pin, on_slot];
            }
            _ => Wrench::moment(second, 1.0),
        };
        [on_second.times(-1.0).acting_on(first), on_second]
    }

    /// The unknown reactions, as wrenches of one unit.
    #[must_use]
    pub fn unit_reactions(&self, frames: &[Frame]) -> UnitReactions {
        let [first, second] = self.bodies();
        let both = |on_second: Wrench| [on_second.times(-1.0).acting_on(first), on_second];
        let force = |marker: &Marker, force| {
            let point = marker.position(frames).map(|c| c.value);
            both(Wrench::force(second, point, force))
        };
        let moment = || both(Wrench::moment(second, 1.0));
        match self {
            Self::Revolute([_, b]) => {
                UnitReactions::from_iter([force(b, [1.0, 0.0]), force(b, [0.0, 1.0])])
            }
            Self::Fixed([_, b]) => {
                UnitReactions::from_iter([force(b, [1.0, 0.0]), force(b, [0.0, 1.0]), moment()])
            }
            Self::Prismatic([a, b]) => {
                UnitReactions::from_iter([force(b, across(a, frames)), moment()])
            }
            Self::PinInSlot([pin, slot]) => {
                UnitReactions::from_iter([force(pin, across(slot, frames))])
            }
            Self::Transmission(wrenches) => UnitReactions::from_iter([*wrenches]),
        }
    }
}

/// The unit vector normal to a marker's direction: the direction turned by +90°.
fn across(marker: &Marker, frames: &[Frame]) -> [f64; 2] {
    let [cos, sin] = marker.axis(frames);
    [-sin.value, cos.value]
}
