//! The Scotch yoke in closed form.
//!
//! Crank pivot O = (0, 0), crank pin A = r·(cos φ, sin φ), which moves in a slot of the yoke; the yoke slides along x.
//! The slot is inclined by β to the direction of motion:
//!
//! ```text
//! x = r·cos φ − r·sin φ·cot β = r·sin(β − φ)/sin β         β = 90°: x = r·cos φ
//! ```
//!
//! a harmonic motion of amplitude r/sin β for every β. For β = 90° it is the limit of the slider-crank (4.1) of Nazarenko, *Dynamics of mechanisms*
//! (2002), for an infinitely long rod.

use crate::machine::error::PoseError;
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use crate::number::error::{finite, positive, within};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// Dimensions of a Scotch yoke.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScotchYokeDimensions {
    /// Crank length r > 0 (m).
    pub crank: f64,
    /// Angle β of the slot with the direction of motion (rad), [`ScotchYoke::FLATTEST`] to π − `FLATTEST`; π/2 for the usual yoke.
    pub slot_angle: f64,
}

/// A Scotch yoke, driven at the crank, which turns fully.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`YOKE`](Self::YOKE) (frame where the slot's centre line crosses the line y = 0 through O,
/// parallel to the global axes). A sliding block in the slot counts as part of the crank pin, with its mass at A: it turns with the yoke, so that its
/// own inertia has no effect.
///
/// Accuracy: 1e-13 of the crank's length against the formula above and its explicit derivatives (test `yoke_is_a_harmonic_motion`).
#[derive(Clone, Debug, PartialEq)]
pub struct ScotchYoke {
    dimensions: ScotchYokeDimensions,
    /// cot β.
    cotangent: f64,
    links: [Link; 2],
}

impl ScotchYoke {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the yoke.
    pub const YOKE: usize = 1;
    /// Smallest slot angle (rad): the yoke's stroke is then 115 times the crank's length.
    pub const FLATTEST: f64 = core::f64::consts::PI / 180.0;

    /// A Scotch yoke of these dimensions, with the links crank, yoke.
    ///
    /// # Errors
    /// A crank that is not positive; a slot angle outside [`FLATTEST`](Self::FLATTEST) to π − `FLATTEST`: a slot along the direction of motion would
    /// lock the crank.
    pub fn new(dimensions: ScotchYokeDimensions, links: [Link; 2]) -> Result<Self, BuildError> {
        let ScotchYokeDimensions { crank, slot_angle } = dimensions;
        positive("crank length", crank)?;
        finite("slot angle", slot_angle)?;
        within(
            "slot angle (rad, from the direction of motion)",
            slot_angle,
            [Self::FLATTEST, core::f64::consts::PI - Self::FLATTEST],
        )?;
        let (sin, cos) = math::sin_cos(slot_angle);
        Ok(Self {
            dimensions,
            cotangent: cos / sin,
            links,
        })
    }

    /// The dimensions.
    pub const fn dimensions(&self) -> ScotchYokeDimensions {
        self.dimensions
    }

    /// Stroke of the yoke 2r/sin β (m).
    #[must_use]
    pub fn stroke(&self) -> f64 {
        2.0 * self.dimensions.crank / math::sin_cos(self.dimensions.slot_angle).0
    }
}

impl Jointed for ScotchYoke {
    /// O: ground and crank; A: the crank's pin in the yoke's slot; guide: ground and yoke, with its moment about the origin of the yoke's frame.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        Ok(Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::CRANK, origin)]),
            Joint::PinInSlot([
                Marker::on(Self::CRANK, [self.dimensions.crank, 0.0]),
                Marker::on(Self::YOKE, origin).with_angle(self.dimensions.slot_angle),
            ]),
            Joint::Prismatic([Marker::ground(origin), Marker::on(Self::YOKE, origin)]),
        ]))
    }
}

impl Mechanism for ScotchYoke {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let crank = Frame::turning([0.0, 0.0], angle);
        let [x_a, y_a] = crank.point([self.dimensions.crank, 0.0]);
        let x = x_a - y_a * self.cotangent;
        let yoke = Frame::translating([x, Transfer::constant(0.0)]);
        Ok(Frames::from_iter([crank, yoke]))
    }
}
