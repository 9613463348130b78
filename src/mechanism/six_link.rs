//! The six-link quick-return mechanism: a crank drives a slotted rocker through a block, and the rocker drives a slider.
//!
//! Crank pivot O₁ = (0, 0), crank pin A = l₁·(cos φ, sin φ) on a block that slides along the rocker O₂B, rocker pivot
//! O₂ = (−b, 0), rocker length l₂, connecting link BC of length l₃, slider C on the guide y = −a:
//!
//! ```text
//! l₁·cos φ − s·cos φ₂ + b = 0        s = |O₂A|                                            (81)
//! l₁·sin φ − s·sin φ₂ = 0
//! l₂·sin φ₂ − l₃·sin φ₃ + a = 0      φ₃: direction from C to B
//! ```
//!
//! so that s² = l₁² + b² + 2·l₁·b·cos φ, and the slider is at x_C = −b + l₂·cos φ₂ − l₃·cos φ₃. The first two determine φ₂ and s > 0; the third
//! leaves the sign of cos φ₃, which is the [`Branch`]: with [`Branch::Right`] the slider is on the right of B (cos φ₃ < 0), with [`Branch::Left`] on
//! its left.
//!
//! With b > l₁ the rocker swings between ±asin(l₁/b), and returns faster than it advances (shaper). With b < l₁ it turns fully (Whitworth's quick
//! return). b = l₁ is refused: the pin passes through O₂.
//!
//! Equations (80)-(84) of the kinematics of plane mechanisms, Example 32; the signs of (81) are missing in print.

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::PI;

use super::four_bar::beyond;
use super::reach::{self, DeadPoints};
use super::{Branch, RotationError, dyad};
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// Dimensions of the six-link mechanism (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SixLinkDimensions {
    /// Crank length l₁ > 0, other than b.
    pub crank: f64,
    /// Rocker length l₂ > 0.
    pub rocker: f64,
    /// Rod length l₃ > 0, long enough to reach the guide over the whole turn or stroke.
    pub rod: f64,
    /// Distance b > 0 of the pivots: b > l₁ for a rocker that swings, b < l₁ for one that turns (Whitworth).
    pub centres: f64,
    /// Distance a of the guide below the crank's pivot, either sign.
    pub below: f64,
}

/// The six-link mechanism, driven at the crank, which turns fully or swings over a stroke.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O₁ along O₁A), [`BLOCK`](Self::BLOCK) (frame at A, parallel to the rocker), [`ROCKER`](Self::ROCKER)
/// (frame at O₂ along O₂B, with the angle φ₂), [`ROD`](Self::ROD) (frame at B along BC, with the angle φ₃ plus half a turn), [`SLIDER`](Self::SLIDER)
/// (frame at C, parallel to the global axes).
///
/// Accuracy: (81) and its derivatives (82), (84) are satisfied to 1e-12 of their largest term (test `printed_equations_hold`).
#[derive(Clone, Debug, PartialEq)]
pub struct SixLink {
    dimensions: SixLinkDimensions,
    branch: Branch,
    domain: Domain,
    links: [Link; 5],
}

impl SixLink {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the block on the crank pin.
    pub const BLOCK: usize = 1;
    /// Index of the slotted rocker.
    pub const ROCKER: usize = 2;
    /// Index of the link from rocker to slider.
    pub const ROD: usize = 3;
    /// Index of the slider.
    pub const SLIDER: usize = 4;

    /// A six-link mechanism of these dimensions, with the links crank, block, rocker, rod, slider.
    ///
    /// # Errors
    /// A length or b not positive; b = l₁; a rod too short for a full turn, with the angle where it fails.
    pub fn new(
        dimensions: SixLinkDimensions,
        branch: Branch,
        links: [Link; 5],
    ) -> Result<Self, BuildError> {
        let six_link = Self::bare(dimensions, branch, links)?;
        if six_link.pin_meets_pivot() {
            let length = dimensions.crank;
            return Err(RotationError::PinMeetsPivot { length }.into());
        }
        let (l3, guide) = (dimensions.rod, dimensions.below);
        let shortest = dimensions.rocker * six_link.largest_sine() + math::abs(guide);
        if l3 <= shortest * (1.0 + reach::HAIR) {
            let dead_points = six_link.dead_points(l3, 1e-9);
            // At φ = 0 the rocker lies along x.
            let assembled = math::abs(guide) < l3;
            let first = dead_points.iter().copied().fold(f64::INFINITY, f64::min);
            return Err(RotationError::TooShort {
                link: "rod",
                phi: if assembled { first } else { 0.0 },
                shortest,
                reach: reach::between(&dead_points, assembled),
            }
            .into());
        }
        Ok(six_link)
    }

    /// A six-link mechanism whose crank only swings over a `stroke` `[from, to]` (rad): any lengths whose rod reaches the guide all the way. The rest
    /// as for [`new`](Self::new).
    ///
    /// # Errors
    /// A length or b not positive; b = l₁ with φ = 180° in the stroke; an empty stroke; a start where the rod does not reach the guide; a dead point
    /// in the stroke, where the rod is perpendicular to the guide, with its angle.
    pub fn over_stroke(
        dimensions: SixLinkDimensions,
        branch: Branch,
        stroke: [f64; 2],
        links: [Link; 5],
    ) -> Result<Self, BuildError> {
        let six_link = Self::bare(dimensions, branch, links)?;
        let [from, to] = stroke;
        if six_link.pin_meets_pivot() && from + beyond(PI - from) <= to {
            let length = dimensions.crank;
            return Err(RotationError::PinMeetsPivot { length }.into());
        }
        let (sin, cos) = math::sin_cos(from);
        let (x, y) = (
            dimensions.crank * cos + dimensions.centres,
            dimensions.crank * sin,
        );
        let height = dimensions.rocker * y / math::sqrt(x * x + y * y) + dimensions.below;
        let rod = dimensions.rod;
        let dead_points = six_link.dead_points(rod * (1.0 - reach::HAIR), 0.0);
        let gap = math::abs(height) - rod;
        let domain = reach::over(stroke, 6, [gap, rod], &dead_points)?;
        Ok(Self { domain, ..six_link })
    }

    fn bare(
        dimensions: SixLinkDimensions,
        branch: Branch,
        links: [Link; 5],
    ) -> Result<Self, BuildError> {
        positive("crank length", dimensions.crank)?;
        positive("rocker length", dimensions.rocker)?;
        positive("rod length", dimensions.rod)?;
        positive("distance of the pivots", dimensions.centres)?;
        finite("distance of the guide", dimensions.below)?;
        Ok(Self {
            dimensions,
            branch,
            domain: Domain::Turn,
            links,
        })
    }

    /// Whether the crank pin passes through O₂ at φ = 180°, or nearer than the rounding of s allows.
    fn pin_meets_pivot(&self) -> bool {
        let SixLinkDimensions { crank, centres, .. } = self.dimensions;
        math::abs(crank - centres) <= 1e-9 * centres
    }

    /// Whether the rocker turns fully (b < l₁, Whitworth) or swings.
    #[must_use]
    pub fn rocker_turns(&self) -> bool {
        self.dimensions.centres < self.dimensions.crank
    }

    /// The dimensions (m).
    pub const fn dimensions(&self) -> SixLinkDimensions {
        self.dimensions
    }

    /// y of the guide (m).
    const fn guide(&self) -> f64 {
        -self.dimensions.below
    }

    /// Pivot O₂ of the rocker (m).
    pub const fn pivot(&self) -> [f64; 2] {
        [-self.dimensions.centres, 0.0]
    }

    /// Largest sin φ₂ of a turn.
    fn largest_sine(&self) -> f64 {
        if self.rocker_turns() {
            1.0
        } else {
            self.dimensions.crank / self.dimensions.centres
        }
    }

    /// The crank angles (rad, 0 to 2π) where a `rod` is perpendicular to the guide, |l₂·sin φ₂ + a| = l₃; a sine that exceeds the largest of a turn
    /// by up to `slack` counts as the largest.
    fn dead_points(&self, rod: f64, slack: f64) -> DeadPoints {
        let (l1, b) = (self.dimensions.crank, self.dimensions.centres);
        let largest = self.largest_sine();
        let mut found = DeadPoints::new();
        for end in [rod, -rod] {
            let sin = (self.guide() + end) / self.dimensions.rocker;
            if math::abs(sin) > largest * (1.0 + slack) {
                continue;
            }
            let sin = sin.clamp(-largest, largest);
            // l₁·sin(φ − φ₂) = b·sin φ₂ (law of sines), and s = l₁·cos(φ − φ₂) + b·cos φ₂ > 0.
            let rocker = math::asin(sin);
            let turned = math::asin((b * sin / l1).clamp(-1.0, 1.0));
            let positions = if self.rocker_turns() {
                [rocker + turned, PI - rocker + turned]
            } else {
                [rocker + turned, rocker + PI - turned]
            };
            for phi in positions {
                // Cannot fail: capacity of four.
                let _ = found.push(beyond(phi));
            }
        }
        found
    }
}

impl Jointed for SixLink {
    /// O₁: ground and crank; A: crank and block; slot: rocker and block; O₂: ground and rocker; B: rocker and rod; C: rod
    /// and slider; guide: ground and slider. The slot's coordinate is s.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        let pin = |first, second| Joint::Revolute([first, second]);
        Ok(Joints::from_iter([
            pin(Marker::ground(origin), Marker::on(Self::CRANK, origin)),
            pin(
                Marker::on(Self::CRANK, [self.dimensions.crank, 0.0]),
                Marker::on(Self::BLOCK, origin),
            ),
            Joint::Prismatic([
                Marker::on(Self::ROCKER, origin),
                Marker::on(Self::BLOCK, origin),
            ]),
            pin(
                Marker::ground(self.pivot()),
                Marker::on(Self::ROCKER, origin),
            ),
            pin(
                Marker::on(Self::ROCKER, [self.dimensions.rocker, 0.0]),
                Marker::on(Self::ROD, origin),
            ),
            pin(
                Marker::on(Self::ROD, [self.dimensions.rod, 0.0]),
                Marker::on(Self::SLIDER, origin),
            ),
            Joint::Prismatic([
                Marker::ground([0.0, self.guide()]),
                Marker::on(Self::SLIDER, origin),
            ]),
        ]))
    }
}

impl Mechanism for SixLink {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let crank = Frame::turning([0.0, 0.0], angle);
        let a = crank.point([self.dimensions.crank, 0.0]);
        let pivot = self.pivot().map(Transfer::constant);
        let (x, y) = (a[0] - pivot[0], a[1] - pivot[1]);
        let s = (x * x + y * y).sqrt();
        // A swinging rocker stays within a quarter turn of +x, a turning one within a quarter turn of the crank.
        let near = if self.rocker_turns() { phi } else { 0.0 };
        let (sin, cos) = (y.over(s), x.over(s));
        let rocker = Frame::moving(pivot, sin, cos).unwrapped(near);
        let block = Frame::moving(a, sin, cos).unwrapped(near);
        let b = rocker.point([self.dimensions.rocker, 0.0]);
        let [rod, slider] = dyad::sliding(b, self.dimensions.rod, self.guide(), self.branch.sign())
            .ok_or(PoseError::DeadPoint { phi, joint: 6 })?;
        Ok(Frames::from_iter([crank, block, rocker, rod, slider]))
    }
}
