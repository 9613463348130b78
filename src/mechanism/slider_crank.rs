//! The slider-crank in closed form.
//!
//! Crank pivot O = (0, 0), crank pin A = r·(cos φ, sin φ), slider pin B on the guide y = e:
//!
//! ```text
//! sin ψ = (e − r·sin φ)/l      cos ψ = ±√(1 − sin²ψ)      x_B = r·cos φ + l·cos ψ
//! ```
//!
//! For e = 0 and the upper sign this is (4.1) of Nazarenko, *Dynamics of mechanisms* (2002). ψ is the direction
//! from A to B. The machine's real orientation is given by the direction of gravity: for a press whose ram
//! moves down as x_B grows, gravity points along +x.

use super::Blocked;
use crate::machine::error::PoseError;
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// Which of the two positions of the slider: on the right (cos ψ > 0) or on the left (cos ψ < 0) of the crank pin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Branch {
    /// x_B = r·cos φ + √…
    #[default]
    Right,
    /// x_B = r·cos φ − √…
    Left,
}

impl Branch {
    /// Sign of cos ψ.
    pub(super) const fn sign(self) -> f64 {
        match self {
            Self::Right => 1.0,
            Self::Left => -1.0,
        }
    }
}

/// Dimensions of a slider-crank (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SliderCrankDimensions {
    /// Crank length r > 0.
    pub crank: f64,
    /// Rod length l > r + |e|.
    pub rod: f64,
    /// Offset e of the guide from the crank's pivot, either sign; zero for an in-line slider-crank.
    pub offset: f64,
}

/// A slider-crank with offset, driven at the crank, which turns fully.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`ROD`](Self::ROD) (frame at A along AB),
/// [`SLIDER`](Self::SLIDER) (frame at B, parallel to the global axes).
///
/// Accuracy: positions, transfer functions and reaction-free reduction agree with 50-digit golden data to
/// 1e-12 of the column's largest value (test `slider_crank_golden`).
#[derive(Clone, Debug, PartialEq)]
pub struct SliderCrank {
    dimensions: SliderCrankDimensions,
    branch: Branch,
    links: [Link; 3],
}

impl SliderCrank {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the connecting rod.
    pub const ROD: usize = 1;
    /// Index of the slider.
    pub const SLIDER: usize = 2;

    /// A slider-crank of these dimensions, with the links crank, rod, slider.
    ///
    /// # Errors
    /// A length that is not positive; a rod too short for a full turn, l ≤ r + |e|, with the angle where it fails.
    pub fn new(
        dimensions: SliderCrankDimensions,
        branch: Branch,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let crank = positive("crank length", dimensions.crank)?;
        let rod = positive("rod length", dimensions.rod)?;
        let offset = finite("offset", dimensions.offset)?;
        let shortest = crank + math::abs(offset);
        // A hair of distance keeps cos ψ away from the roundings of 1 − sin²ψ, so that no angle fails later.
        if rod <= shortest * (1.0 + 1e-12) {
            // The distance |e − r·sin φ| to be spanned is largest at φ = 90° (e < 0) or 270°; the first φ > 0 at
            // which it exceeds the rod is where the turn ends.
            return Err(Blocked::TooShort {
                link: "rod",
                phi: first_unreachable(crank, rod, offset),
                shortest,
            }
            .into());
        }
        Ok(Self {
            dimensions,
            branch,
            links,
        })
    }

    /// On which side of the crank pin the slider is.
    pub const fn branch(&self) -> Branch {
        self.branch
    }

    /// The dimensions (m).
    pub const fn dimensions(&self) -> SliderCrankDimensions {
        self.dimensions
    }
}

/// The smallest φ ≥ 0 (rad) at which |e − r·sin φ| reaches the rod's length.
fn first_unreachable(crank: f64, rod: f64, offset: f64) -> f64 {
    use core::f64::consts::PI;
    if math::abs(offset) >= rod {
        return 0.0;
    }
    let up = (offset + rod) / crank; // sin φ = (e + l)/r: the pin is too high
    let down = (offset - rod) / crank; // sin φ = (e − l)/r: the pin is too low
    // One of them is reached where rod ≤ crank + |offset|; at equality a rounding may leave it just outside.
    if up <= 1.0 || offset <= 0.0 {
        math::asin(up.min(1.0))
    } else {
        PI + math::asin((-down).min(1.0))
    }
}

impl Jointed for SliderCrank {
    /// O: ground and crank; A: crank and rod; B: rod and slider; guide: ground and slider.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let SliderCrankDimensions { crank, rod, offset } = self.dimensions;
        let origin = [0.0, 0.0];
        Ok(Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::CRANK, origin)]),
            Joint::Revolute([
                Marker::on(Self::CRANK, [crank, 0.0]),
                Marker::on(Self::ROD, origin),
            ]),
            Joint::Revolute([
                Marker::on(Self::ROD, [rod, 0.0]),
                Marker::on(Self::SLIDER, origin),
            ]),
            Joint::Prismatic([
                Marker::ground([0.0, offset]),
                Marker::on(Self::SLIDER, origin),
            ]),
        ]))
    }
}

impl Mechanism for SliderCrank {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let lengths = self.dimensions;
        let offset = Transfer::constant(lengths.offset);
        let crank = Frame::turning([0.0, 0.0], angle);
        let [x_a, y_a] = crank.point([lengths.crank, 0.0]);
        let sin = (offset - y_a) * (1.0 / lengths.rod);
        let under_root = Transfer::constant(1.0) - sin * sin;
        if under_root.value <= 0.0 {
            return Err(PoseError::DeadPoint { phi, joint: 3 });
        }
        let cos = under_root.sqrt() * self.branch.sign();
        // On the left branch the rod points to the left: ψ stays within a quarter turn of π.
        let rod = Frame::moving([x_a, y_a], sin, cos).unwrapped(match self.branch {
            Branch::Right => 0.0,
            Branch::Left => core::f64::consts::PI,
        });
        let [x_b, _] = rod.point([lengths.rod, 0.0]);
        let slider = Frame::translating([x_b, offset]);
        Ok(Frames::from_iter([crank, rod, slider]))
    }
}
