//! The hoist in closed form: a drum (or traction sheave) with a load and, optionally, a counterweight on ropes.
//!
//! Drum axis O = (0, 0). The load's rope leaves the drum at (R₁, 0), the counterweight's at (−R₂, 0); both are vertical, along y. A load on n falls
//! of a rope (a tackle) rises by R·φ/n:
//!
//! ```text
//! y₁ = R₁·φ/n₁        y₂ = −R₂·φ/n₂
//! J_red = J₀ + m₁·(R₁/n₁)² + m₂·(R₂/n₂)²        U′ = g·(m₁·R₁/n₁ − m₂·R₂/n₂), the drum balanced, gravity along −y
//! ```
//!
//! The load does not return after a turn, but J, U′ and every force are periodic, so that the drive link's range is a turn; U itself grows with every
//! turn. A spring on the load is not periodic: the reduction is then right at every φ, but must not be tabulated over a turn. The ropes are light,
//! inextensible, taut, and always on the same radius: the weight of long ropes, and the layers of a spirally winding drum, change with the height and
//! are not modelled.
//!
//! Lifting drums with and without a counterweight are worked examples of reduction in any course of machine dynamics, such as the belt over pulleys
//! of Nazarenko, *Dynamics of mechanisms* (2002), (5.9)-(5.16).

use crate::Domain;
use crate::machine::error::PoseError;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, Mechanism};
use crate::number::error::RangeError;
use crate::number::error::{finite, positive, within};
use crate::number::transfer::Transfer;

/// One rope of a hoist: its radius on the drum, and the number of falls that carry its load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rope {
    radius: f64,
    falls: u32,
}

impl Rope {
    /// Greatest number of falls of a tackle.
    pub const MAX_FALLS: u32 = 24;

    /// A rope at the `radius` R of the drum (m, to the rope's centre line) whose load hangs from `falls` n.
    ///
    /// # Errors
    /// A radius that is not positive; falls outside 1 to [`MAX_FALLS`](Self::MAX_FALLS).
    pub fn new(radius: f64, falls: u32) -> Result<Self, RangeError> {
        let radius = positive("drum radius", radius)?;
        let most = f64::from(Self::MAX_FALLS);
        within("number of falls", f64::from(falls), [1.0, most])?;
        Ok(Self { radius, falls })
    }

    /// Radius R (m).
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Number of falls n.
    pub const fn falls(&self) -> u32 {
        self.falls
    }

    /// R/n: travel of the load per angle of the drum (m/rad).
    #[must_use]
    pub fn transmission(&self) -> f64 {
        self.radius / f64::from(self.falls)
    }
}

/// The load on a rope of a hoist, with hook and lower block, or the counterweight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeLoad {
    /// The rope.
    pub rope: Rope,
    /// Its mass properties.
    pub link: Link,
}

/// A hoist, driven at the drum. φ > 0 lifts the load.
///
/// Links: [`DRUM`](Self::DRUM) (frame at O, u along +x at φ = 0), [`LOAD`](Self::LOAD) (with hook and lower block, frame on its rope, parallel to the
/// global axes, at y = 0 for φ = 0) and, if there is one, [`COUNTERWEIGHT`](Self::COUNTERWEIGHT) (likewise).
///
/// The links do not include the inertia of a tackle's sheaves: sheave number k from the rope's fixed end, of n − 1, turns by k·R/(n·r) for each
/// radian of the drum, r its radius. Add J·(k·R/(n·r))² to the flywheel.
///
/// Accuracy: 1e-13 (test `hoist_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct Hoist {
    ropes: heapless::Vec<Rope, 2>,
    links: heapless::Vec<Link, 3>,
}

impl Hoist {
    /// Index of the drum.
    pub const DRUM: usize = 0;
    /// Index of the load.
    pub const LOAD: usize = 1;
    /// Index of the counterweight, if there is one.
    pub const COUNTERWEIGHT: usize = 2;

    /// A hoist of a `drum` with a load on its rope and no counterweight.
    #[must_use]
    pub fn new(drum: Link, load: RopeLoad) -> Self {
        Self {
            ropes: heapless::Vec::from_iter([load.rope]),
            links: heapless::Vec::from_iter([drum, load.link]),
        }
    }

    /// A hoist of a `drum` with a load and a counterweight, each on its rope: an elevator, a differential drum.
    #[must_use]
    pub fn with_counterweight(drum: Link, load: RopeLoad, counterweight: RopeLoad) -> Self {
        Self {
            ropes: heapless::Vec::from_iter([load.rope, counterweight.rope]),
            links: heapless::Vec::from_iter([drum, load.link, counterweight.link]),
        }
    }

    /// The ropes of the load and the counterweight.
    pub fn ropes(&self) -> &[Rope] {
        &self.ropes
    }

    /// The side of the drum with rope number `index`: +1 for the load, which φ > 0 lifts, −1 for the counterweight.
    const fn side(index: usize) -> f64 {
        if index == 0 { 1.0 } else { -1.0 }
    }
}

impl Jointed for Hoist {
    /// O: ground and drum; the guides of the load and of the counterweight; the ropes of the load and of the counterweight. The force of a rope pulls
    /// the drum down where the rope leaves it, so that a taut rope has a negative y component; the load hangs from n times as much.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let bearing = Joint::Revolute([
            Marker::ground([0.0, 0.0]),
            Marker::on(Self::DRUM, [0.0, 0.0]),
        ]);
        let along_y = core::f64::consts::FRAC_PI_2;
        let guide = |(k, rope): (usize, &Rope)| {
            Joint::Prismatic([
                Marker::ground([Self::side(k) * rope.radius, 0.0]).with_angle(along_y),
                Marker::on(k + 1, [0.0, 0.0]).with_angle(along_y),
            ])
        };
        let tension = |(k, rope): (usize, &Rope)| {
            let at = [Self::side(k) * rope.radius, 0.0];
            Joint::Transmission([
                Wrench::force(Body::Link(k + 1), at, [0.0, f64::from(rope.falls)]),
                Wrench::force(Body::Link(Self::DRUM), at, [0.0, -1.0]),
            ])
        };
        let ropes = || self.ropes.iter().enumerate();
        let guides = ropes().map(guide);
        Ok(core::iter::once(bearing)
            .chain(guides)
            .chain(ropes().map(tension))
            .collect())
    }
}

impl Mechanism for Hoist {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("drum angle", phi)?);
        let drum = Frame::turning([0.0, 0.0], angle);
        let hanging = self.ropes.iter().enumerate().map(|(k, rope)| {
            let side = Self::side(k);
            Frame::translating([
                Transfer::constant(side * rope.radius),
                angle * (side * rope.transmission()),
            ])
        });
        Ok(core::iter::once(drum).chain(hanging).collect())
    }
}
