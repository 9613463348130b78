//! The four-bar linkage in closed form.
//!
//! Crank pivot O = (0, 0), crank pin A = a·(cos φ, sin φ), rocker pivot C anywhere, coupler AB = b, rocker CB = c, ground
//! d = |OC|. With f = |AC| the pin B is where the circles about A and C meet:
//!
//! ```text
//! f² = a² + d² − 2·a·d·cos(φ − γ)       γ: direction of OC
//! AB = (p·AC ± q·AC⊥)/f²       p = (f² + b² − c²)/2       4·q² = ((b + c)² − f²)·(f² − (b − c)²)
//! ```
//!
//! The upper sign is [`Side::Left`]: B to the left of the directed line from A to C.
//!
//! The crank turns fully if a + d < b + c and |a − d| > |b − c| (see [`Grashof`]). Over a part of the turn it may be driven as long as it meets no
//! dead point, f = b + c or f = |b − c|, where coupler and rocker are stretched or folded. Where the whole linkage lies flat, that is a change point,
//! and a guided linkage passes through it.

mod change_point;
mod transmission;

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::{PI, TAU};

use super::dyad;
use super::grashof::NAMES;
use super::{Grashof, RotationError, Side};
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};
use change_point::FlatBranch;

/// Margin to a dead point, as a share of b + c, so that rounding does not make a position within the range fail.
const HAIR: f64 = 1e-12;

/// Dimensions of a four-bar linkage (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FourBarDimensions {
    /// Crank length a > 0.
    pub crank: f64,
    /// Coupler length b > 0.
    pub coupler: f64,
    /// Rocker length c > 0.
    pub rocker: f64,
    /// The rocker's pivot C = [x, y], with the crank's at [0, 0]; not at the same point.
    pub pivot: [f64; 2],
}

/// A four-bar linkage driven at the crank.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`COUPLER`](Self::COUPLER) (frame at A along AB), [`ROCKER`](Self::ROCKER) (frame at C along
/// CB). Angles are continuous in φ over any number of turns; at φ = 0 (at the start of a stroke) those of coupler and rocker lie in (−π, π].
///
/// Accuracy: positions and transfer functions agree with 50-digit golden data to 1e-12, the reduction to 1e-11 of the
/// column's largest value (test `four_bar_golden`); joint reactions to 1e-10 (test `four_bar_reactions_golden`).
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    dimensions: FourBarDimensions,
    ground: f64,
    side: Side,
    domain: Domain,
    /// Its branch, if it is kept on one through change points.
    kept: Option<FlatBranch>,
    /// Added to the angles of coupler and rocker.
    turns: [f64; 2],
    links: [Link; 3],
}

impl FourBar {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the coupler.
    pub const COUPLER: usize = 1;
    /// Index of the rocker.
    pub const ROCKER: usize = 2;

    /// A four-bar whose crank turns fully: crank-rocker or double-crank (drag link). B lies on the `side` of AC; the links are crank, coupler,
    /// rocker.
    ///
    /// # Errors
    /// A length that is not positive; C at O; a link longer than the other three together; a crank that cannot turn fully, with the reason and the
    /// angles that it reaches.
    pub fn new(
        dimensions: FourBarDimensions,
        side: Side,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let bare = Self::bare(dimensions, side, links)?;
        let [folded, stretched] = bare.reach();
        let (a, d) = (bare.dimensions.crank, bare.ground);
        if a + d >= stretched || math::abs(a - d) <= folded {
            return Err(RotationError::FourBar {
                lengths: bare.lengths(),
                reach: bare.crank_range(),
            }
            .into());
        }
        bare.with_angles_from(0.0)
    }

    /// A four-bar whose crank only swings over a `stroke` `[from, to]` (rad): any lengths that can be assembled, if no dead point lies in the stroke.
    /// The rest as for [`new`](Self::new).
    ///
    /// # Errors
    /// A length that is not positive; C at O; a link longer than the other three together; an empty stroke; a start where coupler and rocker do not
    /// meet; a dead point in the stroke, with its angle.
    pub fn over_stroke(
        dimensions: FourBarDimensions,
        side: Side,
        stroke: [f64; 2],
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let [from, to] = stroke;
        let mut four_bar = Self::bare(dimensions, side, links)?;
        four_bar.domain = Domain::stroke(from, to)?;
        let [folded, stretched] = four_bar.reach();
        let (phi, joint, span) = (from, 2, four_bar.span(from));
        let gap = (span - stretched).max(folded - span);
        if gap > 2.0 * HAIR * stretched {
            return Err(PoseError::CannotAssemble { phi, joint, gap }.into());
        }
        if gap >= 0.0 {
            return Err(PoseError::DeadPoint { phi, joint }.into());
        }
        if four_bar.first(&[folded, stretched], from) <= to {
            let phi = four_bar.first(&four_bar.limits(), from);
            return Err(PoseError::DeadPoint { phi, joint }.into());
        }
        four_bar.with_angles_from(from)
    }

    fn bare(
        dimensions: FourBarDimensions,
        side: Side,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        positive("crank length", dimensions.crank)?;
        positive("coupler length", dimensions.coupler)?;
        positive("rocker length", dimensions.rocker)?;
        let [x, y] = dimensions.pivot;
        finite("rocker pivot x", x)?;
        finite("rocker pivot y", y)?;
        let bare = Self {
            dimensions,
            ground: positive("distance of the pivots", math::sqrt(x * x + y * y))?,
            side,
            domain: Domain::Turn,
            kept: None,
            turns: [0.0; 2],
            links,
        };
        let lengths = bare.lengths();
        let sum: f64 = lengths.iter().sum();
        for (link, length) in NAMES.into_iter().zip(lengths) {
            let others = sum - length;
            if length >= others {
                return Err(RotationError::Apart {
                    link,
                    length,
                    others,
                }
                .into());
            }
        }
        Ok(bare)
    }

    /// Sets the whole turns of the angles: within (−π, π] at `phi`.
    fn with_angles_from(mut self, phi: f64) -> Result<Self, BuildError> {
        let [_, coupler, rocker] = self.place(phi)?;
        self.turns = [coupler, rocker].map(|frame| math::floor(0.5 - frame.psi.value / TAU) * TAU);
        Ok(self)
    }

    /// Lengths of crank, coupler, rocker and ground (m).
    pub const fn lengths(&self) -> [f64; 4] {
        let FourBarDimensions {
            crank,
            coupler,
            rocker,
            ..
        } = self.dimensions;
        [crank, coupler, rocker, self.ground]
    }

    /// The dimensions (m).
    pub const fn dimensions(&self) -> FourBarDimensions {
        self.dimensions
    }

    /// The side of AC with the pin B; for a linkage kept on its branch [through change points](Self::through_change_points), while the crank is to
    /// the left of OC.
    pub const fn side(&self) -> Side {
        self.side
    }

    /// The kind of the linkage: which links turn fully.
    #[must_use]
    pub fn grashof(&self) -> Grashof {
        Grashof::of(self.lengths())
    }

    /// The crank angles (rad, 0 to 2π) where the rocker reverses: crank and coupler stretched, and folded. `None` if the rocker turns fully, or over
    /// a stroke.
    #[must_use]
    pub fn rocker_dead_centres(&self) -> Option<[f64; 2]> {
        if self.domain != Domain::Turn || self.grashof() != Grashof::CrankRocker {
            return None;
        }
        let [x, y] = self.dimensions.pivot;
        let towards = |span: f64| {
            // Triangle O, C, B with OB = span, B on its side of OC.
            let d = self.ground * self.ground;
            let p = 0.5 * (d + span * span - self.dimensions.rocker * self.dimensions.rocker);
            let q = math::sqrt((d * span * span - p * p).max(0.0)) * self.side.sign();
            math::atan2(p * y + q * x, p * x - q * y)
        };
        let stretched = towards(self.dimensions.coupler + self.dimensions.crank);
        let folded = towards(self.dimensions.coupler - self.dimensions.crank) + PI;
        Some([beyond(stretched), beyond(folded)])
    }

    /// The crank angles (rad, 0 to 2π) where the rocker has the angle `psi` (rad): zero, one or two. For a linkage that returns after two turns,
    /// those of the first.
    #[must_use]
    pub fn crank_angles(&self, psi: f64) -> heapless::Vec<f64, 2> {
        let (sin, cos) = math::sin_cos(psi);
        let b = [
            self.dimensions.pivot[0] + self.dimensions.rocker * cos,
            self.dimensions.pivot[1] + self.dimensions.rocker * sin,
        ];
        let square = b[0] * b[0] + b[1] * b[1];
        let p = 0.5
            * (square + self.dimensions.crank * self.dimensions.crank
                - self.dimensions.coupler * self.dimensions.coupler);
        let under_root = square * self.dimensions.crank * self.dimensions.crank - p * p;
        let mut found = heapless::Vec::new();
        if square <= 0.0 || under_root < 0.0 {
            return found;
        }
        let root = math::sqrt(under_root);
        for q in [root, -root] {
            let a = [
                (p * b[0] - q * b[1]) / square,
                (p * b[1] + q * b[0]) / square,
            ];
            let (to_c, to_b) = (
                [
                    self.dimensions.pivot[0] - a[0],
                    self.dimensions.pivot[1] - a[1],
                ],
                [b[0] - a[0], b[1] - a[1]],
            );
            let left = to_c[0] * to_b[1] - to_c[1] * to_b[0];
            let phi = beyond(math::atan2(a[1], a[0]));
            if left * self.side_at(phi) > 0.0 {
                // Cannot fail: at most two.
                let _ = found.push(phi);
            }
        }
        found
    }

    /// f at the dead points: coupler and rocker folded, and stretched.
    fn limits(&self) -> [f64; 2] {
        let (b, c) = (self.dimensions.coupler, self.dimensions.rocker);
        [math::abs(b - c), b + c]
    }

    /// The range of f in which coupler and rocker can move, with a margin to the dead points.
    fn reach(&self) -> [f64; 2] {
        let [folded, stretched] = self.limits();
        let hair = HAIR * stretched;
        [folded + hair, stretched - hair]
    }

    /// f = |AC| at a crank angle.
    fn span(&self, phi: f64) -> f64 {
        let (sin, cos) = math::sin_cos(phi);
        let (x, y) = (
            self.dimensions.pivot[0] - self.dimensions.crank * cos,
            self.dimensions.pivot[1] - self.dimensions.crank * sin,
        );
        math::sqrt(x * x + y * y)
    }

    /// The first crank angle from `from` on where |AC| has one of these lengths; infinite if there is no such angle.
    fn first(&self, spans: &[f64], from: f64) -> f64 {
        let places = spans.iter().filter_map(|span| self.crank_angle_of(*span));
        places
            .flatten()
            .map(|phi| from + beyond(phi - from))
            .fold(f64::INFINITY, f64::min)
    }

    /// Direction γ of OC.
    fn ground_angle(&self) -> f64 {
        math::atan2(self.dimensions.pivot[1], self.dimensions.pivot[0])
    }

    /// The crank angles γ ∓ θ where |AC| is `span`, if there are any.
    fn crank_angle_of(&self, span: f64) -> Option<[f64; 2]> {
        let (a, d) = (self.dimensions.crank, self.ground);
        let cos = (a * a + d * d - span * span) / (2.0 * a * d);
        // A linkage that flattens does so at cos = ±1, up to rounding.
        (math::abs(cos) <= 1.0 + HAIR).then(|| {
            let (gamma, theta) = (self.ground_angle(), math::acos(cos.clamp(-1.0, 1.0)));
            [gamma - theta, gamma + theta]
        })
    }

    /// The crank angles [from, to] between which a linkage that cannot turn moves; if there are two such ranges, symmetric about the ground line, the
    /// one to the left of OC.
    fn crank_range(&self) -> [f64; 2] {
        let [folded, stretched] = self.limits().map(|span| self.crank_angle_of(span));
        let gamma = self.ground_angle();
        match (folded, stretched) {
            (None, None) => [gamma, gamma + TAU],
            (None, Some(stretched)) => stretched,
            (Some([below, above]), None) => [above, below + TAU],
            (Some([_, folded]), Some([_, stretched])) => [folded, stretched],
        }
    }

    /// Crank, coupler and rocker, with angles continuous in φ.
    fn place(&self, phi: f64) -> Result<[Frame; 3], PoseError> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let crank = Frame::turning([0.0, 0.0], angle);
        let a = crank.point([self.dimensions.crank, 0.0]);
        let c = self.dimensions.pivot.map(Transfer::constant);
        let dead = PoseError::DeadPoint { phi, joint: 2 };
        let [(coupler, near_coupler), (rocker, near_rocker)] = if let Some(kept) = &self.kept {
            self.along(kept, angle, [a, c]).ok_or(dead)?
        } else {
            let lengths = [self.dimensions.coupler, self.dimensions.rocker];
            let [coupler, rocker] = dyad::pinned(a, c, lengths, self.side).ok_or(dead)?;
            // Coupler and rocker stay on one side of AC, so that their angles do not jump.
            let (line, quarter) = (self.line(phi, [a, c]), 0.5 * PI * self.side.sign());
            [(coupler, line + quarter), (rocker, line + PI - quarter)]
        };
        Ok([
            crank,
            coupler.unwrapped(near_coupler + self.turns[0]),
            rocker.unwrapped(near_rocker + self.turns[1]),
        ])
    }

    /// Direction of AC without a jump: it stays within a quarter turn of OC's (a ≤ d) or of AO's (a > d).
    fn line(&self, phi: f64, [a, c]: [[Transfer; 2]; 2]) -> f64 {
        let base = if self.dimensions.crank > self.ground {
            phi + PI
        } else {
            self.ground_angle()
        };
        let (sin, cos) = math::sin_cos(base);
        let (x, y) = (c[0].value - a[0].value, c[1].value - a[1].value);
        base + math::atan2(cos * y - sin * x, cos * x + sin * y)
    }
}

/// The equivalent of `angle` in [0, 2π).
pub(super) fn beyond(angle: f64) -> f64 {
    let rest = angle - math::floor(angle / TAU) * TAU;
    if rest < TAU { rest } else { 0.0 }
}

impl Jointed for FourBar {
    /// O: ground and crank; A: crank and coupler; B: coupler and rocker; C: ground and rocker.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        let pin = |first, second| Joint::Revolute([first, second]);
        Ok(Joints::from_iter([
            pin(Marker::ground(origin), Marker::on(Self::CRANK, origin)),
            pin(
                Marker::on(Self::CRANK, [self.dimensions.crank, 0.0]),
                Marker::on(Self::COUPLER, origin),
            ),
            pin(
                Marker::on(Self::COUPLER, [self.dimensions.coupler, 0.0]),
                Marker::on(Self::ROCKER, [self.dimensions.rocker, 0.0]),
            ),
            pin(
                Marker::ground(self.dimensions.pivot),
                Marker::on(Self::ROCKER, origin),
            ),
        ]))
    }

    /// False within [`FLAT`](Self::FLAT) of a change point.
    fn determined(&self, phi: f64) -> bool {
        self.kept
            .is_none_or(|kept| !kept.is_flat(phi - self.ground_angle()))
    }
}

impl Mechanism for FourBar {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        Ok(Frames::from_iter(self.place(phi)?))
    }
}
