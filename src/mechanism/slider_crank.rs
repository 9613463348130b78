//! The slider-crank in closed form.
//!
//! Crank pivot O = (0, 0), crank pin A = r·(cos φ, sin φ), slider pin B on the guide y = e:
//!
//! ```text
//! sin ψ = (e − r·sin φ)/l      cos ψ = ±√(1 − sin²ψ)      x_B = r·cos φ + l·cos ψ
//! ```
//!
//! For e = 0 and the upper sign this is (4.1) of Nazarenko, *Dynamics of mechanisms* (2002). ψ is the direction from A to B. The direction of gravity
//! gives the machine's real orientation: for a press whose ram moves down as x_B grows, gravity points along +x.

use core::f64::consts::PI;

use super::RotationError;
use super::four_bar::beyond;
use super::reach::{self, DeadPoints};
use crate::machine::error::PoseError;
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// The two positions of the slider: on the right (cos ψ > 0) or on the left (cos ψ < 0) of the crank pin.
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
    /// Rod length l > r + |e|; over a stroke, any that reaches the guide there.
    pub rod: f64,
    /// Offset e of the guide from the crank's pivot, either sign; zero for an in-line slider-crank.
    pub offset: f64,
}

/// A slider-crank with offset, driven at the crank, which turns fully or swings over a stroke.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`ROD`](Self::ROD) (frame at A along AB),
/// [`SLIDER`](Self::SLIDER) (frame at B, parallel to the global axes).
///
/// Accuracy: positions, transfer functions and reaction-free reduction agree with 50-digit golden data to 1e-12 of the column's largest value (test
/// `slider_crank_golden`).
#[derive(Clone, Debug, PartialEq)]
pub struct SliderCrank {
    dimensions: SliderCrankDimensions,
    branch: Branch,
    domain: Domain,
    links: [Link; 3],
}

impl SliderCrank {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the connecting rod.
    pub const ROD: usize = 1;
    /// Index of the slider.
    pub const SLIDER: usize = 2;

    /// A slider-crank of these dimensions, whose crank turns fully, with the links crank, rod, slider.
    ///
    /// # Errors
    /// A length that is not positive; a rod too short for a full turn, l ≤ r + |e|, with the angle where it fails and the angles between which it
    /// reaches the guide.
    pub fn new(
        dimensions: SliderCrankDimensions,
        branch: Branch,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let bare = Self::bare(dimensions, branch, links)?;
        let SliderCrankDimensions { crank, rod, offset } = dimensions;
        let shortest = crank + math::abs(offset);
        // A margin keeps cos ψ away from the rounding of 1 − sin²ψ, so that no angle fails later.
        if rod <= shortest * (1.0 + reach::HAIR) {
            // At equality, rounding may put a dead point just outside.
            let dead_points = dimensions.dead_points(rod, 1e-9);
            let assembled = math::abs(offset) < rod;
            let first = dead_points.iter().copied().fold(f64::INFINITY, f64::min);
            return Err(RotationError::TooShort {
                link: "rod",
                phi: if assembled { first } else { 0.0 },
                shortest,
                reach: reach::between(&dead_points, assembled),
            }
            .into());
        }
        Ok(bare)
    }

    /// A slider-crank whose crank only swings over a `stroke` `[from, to]` (rad): any lengths whose rod reaches the guide all the way, such as a rod
    /// shorter than the crank. The rest as for [`new`](Self::new).
    ///
    /// Accuracy: joints close to 1e-12 over the stroke, up to its dead points (test `short_rods_move_between_their_dead_points`).
    ///
    /// # Errors
    /// A length that is not positive; an empty stroke; a start where the rod does not reach the guide; a dead point in the stroke, where the rod is
    /// perpendicular to the guide, with its angle.
    pub fn over_stroke(
        dimensions: SliderCrankDimensions,
        branch: Branch,
        stroke: [f64; 2],
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let bare = Self::bare(dimensions, branch, links)?;
        let SliderCrankDimensions { crank, rod, offset } = dimensions;
        let gap = math::abs(offset - crank * math::sin_cos(stroke[0]).0) - rod;
        let dead_points = dimensions.dead_points(rod * (1.0 - reach::HAIR), 0.0);
        let domain = reach::over(stroke, 3, [gap, rod], &dead_points)?;
        Ok(Self { domain, ..bare })
    }

    fn bare(
        dimensions: SliderCrankDimensions,
        branch: Branch,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        positive("crank length", dimensions.crank)?;
        positive("rod length", dimensions.rod)?;
        finite("offset", dimensions.offset)?;
        Ok(Self {
            dimensions,
            branch,
            domain: Domain::Turn,
            links,
        })
    }

    /// The side of the crank pin with the slider.
    pub const fn branch(&self) -> Branch {
        self.branch
    }

    /// The dimensions (m).
    pub const fn dimensions(&self) -> SliderCrankDimensions {
        self.dimensions
    }
}

impl SliderCrankDimensions {
    /// The crank angles (rad, 0 to 2π) where |e − r·sin φ| is the length of a `rod`; a sine that exceeds one by up to `slack` counts as one.
    fn dead_points(&self, rod: f64, slack: f64) -> DeadPoints {
        let mut found = DeadPoints::new();
        for height in [self.offset + rod, self.offset - rod] {
            let sin = height / self.crank;
            if math::abs(sin) > 1.0 + slack {
                continue;
            }
            let phi = math::asin(sin.clamp(-1.0, 1.0));
            for phi in [phi, PI - phi] {
                // Cannot fail: capacity of four.
                let _ = found.push(beyond(phi));
            }
        }
        found
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
        self.domain
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
            Branch::Left => PI,
        });
        let [x_b, _] = rod.point([lengths.rod, 0.0]);
        let slider = Frame::translating([x_b, offset]);
        Ok(Frames::from_iter([crank, rod, slider]))
    }
}
