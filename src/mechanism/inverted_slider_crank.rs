//! The inverted slider-crank in closed form: crank, block, slotted lever.
//!
//! Crank pivot O = (0, 0), crank pin A = r·(cos φ, sin φ) with a block that slides in the slot of a lever; the lever turns about the fixed point C,
//! at the distance e from the slot's centre line. In the lever's frame at C, u along the slot, A = (s, e):
//!
//! ```text
//! d = A − C        s = √(|d|² − e²)        cos ψ = (s·d_x + e·d_y)/|d|²        sin ψ = (s·d_y − e·d_x)/|d|²
//! ```
//!
//! The lever rocks for |OC| > r + |e| (crank and slotted lever, the quick-return motion of a shaper) and turns fully for |OC| < r − |e| (Whitworth's
//! motion). In between, the slot cannot follow the pin through the whole turn: |d| falls to |e|, a change point.
//!
//! The inversion of the slider-crank and its time ratio for e = 0 are in textbooks of mechanisms, such as Norton, *Design of machinery*, chapter 3;
//! [`InvertedSliderCrank::swing`] derives the formulas with e.

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::PI;

use super::four_bar::beyond;
use super::{DimensionError, reach};
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// Motion of the slotted lever.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LeverMotion {
    /// It rocks: |OC| > r + |e|; over a stroke |OC| ≥ r.
    Rocking,
    /// It turns fully, once per turn of the crank: |OC| < r − |e|; over a stroke it turns with the crank, |OC| < r.
    Turning,
}

/// Dimensions of an inverted slider-crank (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct InvertedSliderCrankDimensions {
    /// Crank length r > 0.
    pub crank: f64,
    /// Pivot C = [x, y] of the lever, with the crank's at [0, 0]: at more than r + |e| for a lever that rocks, less than r − |e| for one that turns.
    pub pivot: [f64; 2],
    /// Offset e of the slot from C, towards the lever's +v.
    pub offset: f64,
}

/// An inverted slider-crank, driven at the crank, which turns fully or swings over a stroke.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`BLOCK`](Self::BLOCK) (frame at A, u along the slot), [`LEVER`](Self::LEVER) (frame at C, u
/// along the slot, from C towards the block; the slot lies at v = e). The same machine with −e has the slot on the other side.
///
/// ψ of a rocking lever stays within 180° of the direction from C to O, ψ of a turning lever within 180° of φ.
///
/// Accuracy: 1e-12 against the half-angle and inverse forms (tests `rocking_lever_textbook`, `turning_lever_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct InvertedSliderCrank {
    dimensions: InvertedSliderCrankDimensions,
    centres: f64,
    /// Direction from C to O (rad).
    towards_crank: f64,
    motion: LeverMotion,
    domain: Domain,
    links: [Link; 3],
}

impl InvertedSliderCrank {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the sliding block.
    pub const BLOCK: usize = 1;
    /// Index of the slotted lever.
    pub const LEVER: usize = 2;

    /// An inverted slider-crank of these dimensions, with the links crank, block, lever.
    ///
    /// # Errors
    /// A crank that is not positive; a length not finite; a pivot between the two ranges of distance, where the slot cannot follow the pin through
    /// the whole turn.
    pub fn new(
        dimensions: InvertedSliderCrankDimensions,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let bare = Self::bare(dimensions, links)?;
        let (crank, centres, width) =
            (dimensions.crank, bare.centres, math::abs(dimensions.offset));
        // A margin, so that rounding of |d|² − e² cannot make an angle fail later.
        let hair = reach::HAIR * (crank + width);
        let (rocking, turning) = (crank + width, crank - width);
        if centres > rocking + hair || centres < turning - hair {
            return Ok(bare);
        }
        Err(DimensionError::ChangePoint {
            centres,
            rocking,
            turning,
        }
        .into())
    }

    /// An inverted slider-crank whose crank only swings over a `stroke` `[from, to]` (rad): any lengths whose slot follows the crank pin all the way.
    /// The rest as for [`new`](Self::new).
    ///
    /// # Errors
    /// A crank that is not positive; a length not finite; an empty stroke; a start where the slot does not meet the pin; a dead point in the stroke,
    /// where the pin is at the distance |e| from C, with its angle.
    pub fn over_stroke(
        dimensions: InvertedSliderCrankDimensions,
        stroke: [f64; 2],
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let bare = Self::bare(dimensions, links)?;
        let (crank, centres) = (dimensions.crank, bare.centres);
        let [x, y] = dimensions.pivot;
        let (sin, cos) = math::sin_cos(stroke[0]);
        let [u, v] = [crank * cos - x, crank * sin - y];
        let size = crank + centres;
        let gap = math::abs(dimensions.offset) - math::sqrt(u * u + v * v);
        // The pin at the distance |e| from C, plus a margin: cos(φ − γ) of the triangle O, A, C.
        let nearest = math::abs(dimensions.offset) + reach::HAIR * size;
        let cos = (crank * crank + centres * centres - nearest * nearest) / (2.0 * crank * centres);
        let mut dead_points = reach::DeadPoints::new();
        if math::abs(cos) <= 1.0 {
            let towards = bare.towards_crank + PI;
            for phi in [towards - math::acos(cos), towards + math::acos(cos)] {
                // Cannot fail: capacity of four.
                let _ = dead_points.push(beyond(phi));
            }
        }
        let domain = reach::over(stroke, 2, [gap, size], &dead_points)?;
        Ok(Self { domain, ..bare })
    }

    /// A lever farther away than the crank's length stays within a quarter turn of the direction from C to O, a nearer one within a quarter turn of
    /// φ, where both can be assembled.
    fn bare(
        dimensions: InvertedSliderCrankDimensions,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let InvertedSliderCrankDimensions {
            crank,
            pivot,
            offset,
        } = dimensions;
        positive("crank length", crank)?;
        finite("lever pivot x", pivot[0])?;
        finite("lever pivot y", pivot[1])?;
        finite("slot offset", offset)?;
        let centres = math::sqrt(pivot[0] * pivot[0] + pivot[1] * pivot[1]);
        Ok(Self {
            dimensions,
            centres,
            towards_crank: math::atan2(-pivot[1], -pivot[0]),
            motion: if centres < crank {
                LeverMotion::Turning
            } else {
                LeverMotion::Rocking
            },
            domain: Domain::Turn,
            links,
        })
    }

    /// The dimensions (m).
    pub const fn dimensions(&self) -> InvertedSliderCrankDimensions {
        self.dimensions
    }

    /// Whether the lever rocks or turns.
    pub const fn motion(&self) -> LeverMotion {
        self.motion
    }

    /// The angle S (rad) that determines the time ratio:
    ///
    /// ```text
    /// rocking: S = asin((r + e)/c) + asin((r − e)/c)        turning: S = asin((c + e)/r) + asin((c − e)/r)        c = |OC|
    /// ```
    ///
    /// A rocking lever swings through S. It stops where the slot's line touches the crank's circle, with O at v = e ± r of the lever. There the crank
    /// is perpendicular to the slot, so that it turns by π + S through the pin's farthest point, and by π − S on the way back. A turning lever makes
    /// the half turn between its two positions perpendicular to OC while the crank turns by π ± S, by φ = ψ + asin((e − c·sin(γ − ψ))/r) with γ the
    /// direction from C to O.
    #[must_use]
    pub fn swing(&self) -> f64 {
        let (short, long) = match self.motion {
            LeverMotion::Rocking => (self.dimensions.crank, self.centres),
            LeverMotion::Turning => (self.centres, self.dimensions.crank),
        };
        math::asin((short + self.dimensions.offset) / long)
            + math::asin((short - self.dimensions.offset) / long)
    }

    /// Quick-return ratio (π + S)/(π − S) at constant crank speed, time of the slow stroke over time of the quick one, with S of
    /// [`swing`](Self::swing).
    ///
    /// For a rocking lever the strokes are its two swings. For a turning lever they are the strokes of a ram driven by a long rod from the lever, in
    /// line with its slot, along a line through C perpendicular to OC.
    #[must_use]
    pub fn time_ratio(&self) -> f64 {
        let swing = self.swing();
        (PI + swing) / (PI - swing)
    }
}

impl Jointed for InvertedSliderCrank {
    /// O: ground and crank; A: crank and block; slot: lever and block; C: ground and lever.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        Ok(Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::CRANK, origin)]),
            Joint::Revolute([
                Marker::on(Self::CRANK, [self.dimensions.crank, 0.0]),
                Marker::on(Self::BLOCK, origin),
            ]),
            Joint::Prismatic([
                Marker::on(Self::LEVER, [0.0, self.dimensions.offset]),
                Marker::on(Self::BLOCK, origin),
            ]),
            Joint::Revolute([
                Marker::ground(self.dimensions.pivot),
                Marker::on(Self::LEVER, origin),
            ]),
        ]))
    }
}

impl Mechanism for InvertedSliderCrank {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let crank = Frame::turning([0.0, 0.0], angle);
        let pin = crank.point([self.dimensions.crank, 0.0]);
        // ψ counts from a direction that it never leaves by 180°, so that no arctangent jumps.
        let reference = match self.motion {
            LeverMotion::Rocking => Transfer::constant(self.towards_crank),
            LeverMotion::Turning => angle,
        };
        let (sin, cos) = reference.sin_cos();
        let [x, y] = [
            pin[0] - Transfer::constant(self.dimensions.pivot[0]),
            pin[1] - Transfer::constant(self.dimensions.pivot[1]),
        ];
        let [along, across] = [cos * x + sin * y, cos * y - sin * x];
        let distance_squared = x * x + y * y;
        let under_root =
            distance_squared - Transfer::constant(self.dimensions.offset * self.dimensions.offset);
        if under_root.value <= 0.0 {
            return Err(PoseError::DeadPoint { phi, joint: 2 });
        }
        let s = under_root.sqrt();
        let turned = Transfer::angle(
            (s * across - along * self.dimensions.offset).over(distance_squared),
            (s * along + across * self.dimensions.offset).over(distance_squared),
        );
        let psi = reference + turned;
        let block = Frame::turned(pin, psi);
        let lever = Frame::turning(self.dimensions.pivot, psi);
        Ok(Frames::from_iter([crank, block, lever]))
    }
}
