//! The toggle press (knuckle-joint press): a crank straightens two links that push the ram.
//!
//! Crank pivot O = (0, 0), crank OA = r, rod AK = l to the knuckle K, upper link PK = p from the fixed pivot P, lower link KR = q, ram R on the guide
//! y = e. O-A-K-P is a [`FourBar`] with the upper link as its rocker; ψ is the angle of the upper link. Then
//!
//! ```text
//! K = P + p·(cos ψ, sin ψ)        sin χ = (e − y_K)/q        x_R = x_K ± q·√(1 − sin²χ)
//! x_R′ = p·ψ′·sin(χ − ψ)/cos χ
//! ```
//!
//! The upper sign is [`Branch::Right`]: the ram on the right of the knuckle. The knuckle lies on the `knuckle` side of the directed line from A to P.
//!
//! The ram stops where the upper link reverses, ψ′ = 0, and where both links are in line, χ = ψ: straight at the bottom. Near it a small torque
//! produces a large force. This is not a dead point of the drive: the crank moves the links through it, and every transfer function stays finite.
//!
//! K. Luck, K.-H. Modler, *Getriebetechnik*; the closed forms of four-bar and slider-crank in series.

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::{FRAC_PI_2, PI, TAU};

use super::four_bar::beyond;
use super::reach;
use super::{Branch, FourBar, FourBarDimensions, RotationError, Side, dyad};
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::Link;
use crate::number::error::{finite, positive};
use crate::{Domain, math};

/// Why the ram stops at a dead centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Standstill {
    /// The upper link reverses: crank and rod are in line.
    Reversal,
    /// Upper and lower link are in line.
    Toggle,
}

/// A crank angle where the ram stops.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct DeadCentre {
    /// Crank angle (rad, 0 to 2π).
    pub phi: f64,
    /// Position x of the ram (m).
    pub ram: f64,
    /// Why it stops.
    pub cause: Standstill,
}

/// The dead centres of one turn, by rising angle.
pub type DeadCentres = heapless::Vec<DeadCentre, 8>;

/// Dead centres closer than this (rad) count as one: the links are in line exactly where the upper link reverses.
const SAME: f64 = 1e-6;

/// Dimensions of a toggle press (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TogglePressDimensions {
    /// Crank length r > 0.
    pub crank: f64,
    /// Rod length l > 0, from the crank to the knuckle.
    pub rod: f64,
    /// Upper link length p > 0, from its pivot to the knuckle.
    pub upper: f64,
    /// Lower link length q > 0, from the knuckle to the ram, long enough to reach the guide over the whole turn or stroke.
    pub lower: f64,
    /// Pivot P = [x, y] of the upper link, with the crank's at [0, 0].
    pub pivot: [f64; 2],
    /// y of the ram's guide e.
    pub guide: f64,
}

/// A toggle press, driven at the crank, which turns fully or swings over a stroke.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`ROD`](Self::ROD) (frame at A along AK), [`UPPER`](Self::UPPER) (frame at P along PK),
/// [`LOWER`](Self::LOWER) (frame at K along KR), [`RAM`](Self::RAM) (frame at R, parallel to the global axes). The pin of the knuckle belongs to the
/// upper link: rod and lower link turn on it.
///
/// Accuracy: positions and transfer functions to 1e-12 against four-bar and slider-crank in series (test
/// `ram_follows_the_slider_crank_of_the_upper_link`).
#[derive(Clone, Debug, PartialEq)]
pub struct TogglePress {
    dimensions: TogglePressDimensions,
    four_bar: FourBar,
    branch: Branch,
    links: [Link; 5],
}

impl TogglePress {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the rod from the crank to the knuckle.
    pub const ROD: usize = 1;
    /// Index of the upper link, from the fixed pivot to the knuckle.
    pub const UPPER: usize = 2;
    /// Index of the lower link, from the knuckle to the ram.
    pub const LOWER: usize = 3;
    /// Index of the ram.
    pub const RAM: usize = 4;

    /// A toggle press of these dimensions, with the side of the knuckle, the branch of the ram, and the links crank, rod, upper, lower, ram.
    ///
    /// # Errors
    /// As [`FourBar::new`] for crank, coupler (here the rod), rocker (the upper link) and P; an impossible lower link or guide; a lower link too
    /// short for a full turn, with the angle where it fails.
    pub fn new(
        dimensions: TogglePressDimensions,
        knuckle: Side,
        branch: Branch,
        links: [Link; 5],
    ) -> Result<Self, BuildError> {
        let press = Self::bare(dimensions, knuckle, branch, None, links)?;
        let shortest = press.farthest_knuckle()?;
        if dimensions.lower <= shortest * (1.0 + reach::HAIR) {
            let dead_points = press.dead_points(dimensions.lower)?;
            let assembled = press.off_guide_at(0.0)? < dimensions.lower;
            let first = dead_points.iter().copied().fold(f64::INFINITY, f64::min);
            return Err(RotationError::TooShort {
                link: "lower link",
                phi: if assembled { first } else { 0.0 },
                shortest,
                reach: reach::between(&dead_points, assembled),
            }
            .into());
        }
        Ok(press)
    }

    /// A toggle press whose crank only swings over a `stroke` `[from, to]` (rad): any lengths of links without a dead point there. The rest as for
    /// [`new`](Self::new).
    ///
    /// # Errors
    /// As [`FourBar::over_stroke`] for crank, rod, upper link and P; an impossible lower link or guide; a start where the lower link does not reach
    /// the guide; a dead point in the stroke, where it is perpendicular to the guide, with its angle.
    pub fn over_stroke(
        dimensions: TogglePressDimensions,
        knuckle: Side,
        branch: Branch,
        stroke: [f64; 2],
        links: [Link; 5],
    ) -> Result<Self, BuildError> {
        let press = Self::bare(dimensions, knuckle, branch, Some(stroke), links)?;
        let lower = dimensions.lower;
        let gap = press.off_guide_at(stroke[0])? - lower;
        let dead_points = press.dead_points(lower * (1.0 - reach::HAIR))?;
        reach::over(stroke, 6, [gap, lower], &dead_points)?;
        Ok(press)
    }

    fn bare(
        dimensions: TogglePressDimensions,
        knuckle: Side,
        branch: Branch,
        stroke: Option<[f64; 2]>,
        links: [Link; 5],
    ) -> Result<Self, BuildError> {
        positive("lower link length", dimensions.lower)?;
        finite("guide", dimensions.guide)?;
        let four_bar = FourBarDimensions {
            crank: dimensions.crank,
            coupler: dimensions.rod,
            rocker: dimensions.upper,
            pivot: dimensions.pivot,
        };
        let first = [links[0], links[1], links[2]];
        let four_bar = match stroke {
            None => FourBar::new(four_bar, knuckle, first)?,
            Some(stroke) => FourBar::over_stroke(four_bar, knuckle, stroke, first)?,
        };
        Ok(Self {
            dimensions,
            four_bar,
            branch,
            links,
        })
    }

    /// The linkage O-A-K-P that moves the upper link.
    pub const fn four_bar(&self) -> &FourBar {
        &self.four_bar
    }

    /// The dimensions (m).
    pub const fn dimensions(&self) -> TogglePressDimensions {
        self.dimensions
    }

    /// Largest distance of the knuckle from the guide's line (m) over a turn.
    fn farthest_knuckle(&self) -> Result<f64, PoseError> {
        let height = |sin: f64| math::abs(self.knuckle_off_guide(sin));
        let Some(dead) = self.four_bar.rocker_dead_centres() else {
            return Ok(height(1.0).max(height(-1.0)));
        };
        let [a, b] = [self.upper_angle(dead[0])?, self.upper_angle(dead[1])?];
        let (least, most) = (a.min(b), a.max(b));
        let ends = height(math::sin_cos(a).0).max(height(math::sin_cos(b).0));
        // The upper link is perpendicular to the guide within its swing.
        let across = [FRAC_PI_2, -FRAC_PI_2]
            .into_iter()
            .filter(|angle| least + beyond(angle - least) <= most);
        Ok(across
            .map(|angle| height(math::sin_cos(angle).0))
            .fold(ends, f64::max))
    }

    /// e − y_K (m) for this sine of the upper link's angle.
    fn knuckle_off_guide(&self, sin: f64) -> f64 {
        let TogglePressDimensions {
            upper,
            pivot,
            guide,
            ..
        } = self.dimensions;
        guide - pivot[1] - upper * sin
    }

    fn upper_angle(&self, phi: f64) -> Result<f64, PoseError> {
        let frames = self.four_bar.frames(phi)?;
        Ok(frames
            .get(FourBar::ROCKER)
            .map_or(0.0, |frame| frame.psi.value))
    }

    /// Distance of the knuckle from the guide's line (m) at a crank angle.
    fn off_guide_at(&self, phi: f64) -> Result<f64, PoseError> {
        let sin = math::sin_cos(self.upper_angle(phi)?).0;
        Ok(math::abs(self.knuckle_off_guide(sin)))
    }

    /// The crank angles (rad, 0 to 2π) where a `lower` link is perpendicular to the guide.
    fn dead_points(&self, lower: f64) -> Result<heapless::Vec<f64, 10>, PoseError> {
        let mut found = heapless::Vec::new();
        for distance in [lower, -lower] {
            let sin = (self.knuckle_off_guide(0.0) - distance) / self.dimensions.upper;
            if math::abs(sin) <= 1.0 {
                let angle = math::asin(sin);
                for psi in [angle, PI - angle] {
                    // Cannot fail: two for each of four angles, and two more.
                    found.extend(self.four_bar.crank_angles(psi));
                }
            }
        }
        // A link that only just fails, at the end of the swing, has no such angle before it.
        for phi in self.four_bar.rocker_dead_centres().into_iter().flatten() {
            if self.off_guide_at(phi)? >= lower * (1.0 - reach::HAIR) {
                let _ = found.push(phi);
            }
        }
        Ok(found)
    }

    /// The crank angles where the ram stops.
    ///
    /// # Errors
    /// No error for a valid press.
    pub fn dead_centres(&self) -> Result<DeadCentres, PoseError> {
        let mut found = DeadCentres::new();
        let mut add = |phi: f64, cause| -> Result<(), PoseError> {
            let frames = self.frames(phi)?;
            let ram = frames.get(Self::RAM).map_or(0.0, |frame| frame.x.value);
            let near = |other: &DeadCentre| {
                let apart = beyond(other.phi - phi);
                apart.min(TAU - apart) < SAME
            };
            if !found.iter().any(near) {
                // Cannot fail: at most two reversals and two angles for each of two toggle positions.
                let _ = found.push(DeadCentre { phi, ram, cause });
            }
            Ok(())
        };
        for phi in self.four_bar.rocker_dead_centres().into_iter().flatten() {
            add(phi, Standstill::Reversal)?;
        }
        let TogglePressDimensions { upper, lower, .. } = self.dimensions;
        let height = self.knuckle_off_guide(0.0);
        // Straight R = P + (p + q)·u and folded R = P + (p − q)·u, u along the upper link; the lower link points to the ram's side.
        for (length, sign) in [
            (upper + lower, self.branch.sign()),
            (upper - lower, -self.branch.sign()),
        ] {
            let sin = height / length;
            if math::abs(sin) < 1.0 {
                let psi = math::atan2(sin, sign * math::sqrt(1.0 - sin * sin));
                for phi in self.four_bar.crank_angles(psi) {
                    add(phi, Standstill::Toggle)?;
                }
            }
        }
        found.sort_unstable_by(|a, b| a.phi.total_cmp(&b.phi));
        Ok(found)
    }

    /// Top and bottom of the ram's stroke; the bottom is farthest from the knuckle's side. A press whose links pass the straight position reaches its
    /// bottom twice per turn; this is the first one.
    ///
    /// # Errors
    /// No error for a valid press.
    pub fn stroke(&self) -> Result<[DeadCentre; 2], PoseError> {
        let centres = self.dead_centres()?;
        let down = |centre: &&DeadCentre| self.branch.sign() * centre.ram;
        let order = |a: &&DeadCentre, b: &&DeadCentre| down(a).total_cmp(&down(b));
        let top = centres.iter().min_by(order);
        // The first of equals.
        let bottom = centres.iter().rev().max_by(order);
        let none = DeadCentre {
            phi: 0.0,
            ram: 0.0,
            cause: Standstill::Reversal,
        };
        Ok([*top.unwrap_or(&none), *bottom.unwrap_or(&none)])
    }
}

impl Jointed for TogglePress {
    /// O: ground and crank; A: crank and rod; K: rod and upper link; P: ground and upper link; K: upper and lower link; R:
    /// lower link and ram; guide: ground and ram.
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        let TogglePressDimensions { upper, lower, .. } = self.dimensions;
        let origin = [0.0, 0.0];
        let mut joints = self.four_bar.joints(phi, frames)?;
        let rest = [
            Joint::Revolute([
                Marker::on(Self::UPPER, [upper, 0.0]),
                Marker::on(Self::LOWER, origin),
            ]),
            Joint::Revolute([
                Marker::on(Self::LOWER, [lower, 0.0]),
                Marker::on(Self::RAM, origin),
            ]),
            Joint::Prismatic([
                Marker::ground([0.0, self.dimensions.guide]),
                Marker::on(Self::RAM, origin),
            ]),
        ];
        joints.extend(rest);
        Ok(joints)
    }
}

impl Mechanism for TogglePress {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.four_bar.domain()
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let mut frames = self.four_bar.frames(phi)?;
        let TogglePressDimensions { upper, lower, .. } = self.dimensions;
        let knuckle = frames
            .get(Self::UPPER)
            .map(|frame| frame.point([upper, 0.0]))
            .and_then(|knuckle| {
                dyad::sliding(knuckle, lower, self.dimensions.guide, self.branch.sign())
            });
        let rest = knuckle.ok_or(PoseError::DeadPoint { phi, joint: 6 })?;
        frames.extend(rest);
        Ok(frames)
    }
}
