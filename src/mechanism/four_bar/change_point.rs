//! Through change points: four-bars whose links can all lie in one line.
//!
//! With θ = φ − γ, f² = (a − d)² + 4·a·d·sin² θ/2, so that the factors of q in the closed form are
//!
//! ```text
//! (b + c)² − f² = (b + c)² − (a + d)² + 4·a·d·cos² θ/2      a + d = b + c:     its root is 2·√(a·d)·cos θ/2
//! f² − (b − c)² = (a − d)² − (b − c)² + 4·a·d·sin² θ/2      |a − d| = |b − c|: its root is 2·√(a·d)·sin θ/2
//! ```
//!
//! These signed roots are smooth through zero: the linkage leaves the flat position on the other side of AC, with all transfer functions finite. An
//! unsigned root of the product would reverse the rocker's speed abruptly. If both are equal, q = ±a·d·sin θ: a parallelogram (+), an
//! antiparallelogram (−) or a kite. If A meets C (a = d, b = c: kite, Galloway's mechanism), f itself is 2·a·sin θ/2, signed.
//!
//! K. Luck, K.-H. Modler, *Getriebetechnik*, on linkages that pass change points; E. A. Dijksman, *Motion Geometry of Mechanisms*, on Galloway's
//! mechanism.

use core::f64::consts::{PI, TAU};

use super::{FourBar, FourBarDimensions, HAIR, beyond};
use crate::machine::error::PoseError;
use crate::machine::link::{Frame, Link};
use crate::mechanism::dyad;
use crate::mechanism::error::BuildError;
use crate::mechanism::{DimensionError, Side};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// The branch of a linkage that passes change points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FlatBranch {
    /// a + d = b + c: flat at θ = π, coupler and rocker stretched.
    stretched: bool,
    /// |a − d| = |b − c|: flat at θ = 0, coupler and rocker folded.
    folded: bool,
    /// Sign of q, where the roots are positive.
    sign: f64,
}

impl FlatBranch {
    /// Sign of q at θ.
    fn side(&self, theta: f64) -> f64 {
        let (sin, cos) = math::sin_cos(0.5 * theta);
        let sign = |flat: bool, root: f64| if flat { math::sign(root) } else { 1.0 };
        self.sign * sign(self.stretched, cos) * sign(self.folded, sin)
    }

    /// Whether the linkage is within [`FourBar::FLAT`] of a change point.
    pub(super) fn is_flat(&self, theta: f64) -> bool {
        let (sin, cos) = math::sin_cos(0.5 * theta);
        let near = |flat: bool, root: f64| flat && 2.0 * math::abs(root) < FourBar::FLAT;
        near(self.stretched, cos) || near(self.folded, sin)
    }
}

impl FourBar {
    /// Distance from a change point (rad) within which the forces in the joints are not determined. They grow in proportion to 1/distance, and depend
    /// there on play and stiffness, and on the linkage's guide: a second crank, teeth, another coupler.
    pub const FLAT: f64 = 1e-3;

    /// A four-bar that can lie flat, s + l = p + q, and is guided so that it stays on its branch: parallelogram and antiparallelogram, kite,
    /// Galloway's mechanism, and any other of [`Grashof::ChangePoint`](crate::mechanism::Grashof).
    ///
    /// `side` is the side of AC with the pin B in the first half turn, from the start on, with the crank to the left of OC, 0 < φ − γ < π; beyond the
    /// flat position it is the other side. With a = c, b = d, [`Side::Left`] gives a parallelogram, [`Side::Right`] an antiparallelogram. A linkage
    /// with two change points per turn returns after a turn. One with a single change point returns after two turns, and can only be driven over a
    /// stroke.
    ///
    /// Accuracy: the parallelogram's links translate and turn exactly; joints close to 1e-12 at and near change points (test
    /// `joints_close_through_change_points`).
    ///
    /// # Errors
    /// As [`over_stroke`](Self::over_stroke), with a dead point that is not a change point; a linkage that never lies flat; a full turn of one that
    /// returns after two; the branch of a kite with a stationary rocker.
    pub fn through_change_points(
        dimensions: FourBarDimensions,
        side: Side,
        domain: Domain,
        links: [Link; 3],
    ) -> Result<Self, BuildError> {
        let mut bare = Self::bare(dimensions, side, links)?;
        if let Domain::Stroke { from, to } = domain {
            bare.domain = Domain::stroke(from, to)?;
        }
        let [a, b, c, d] = bare.lengths();
        let hair = HAIR * (a + b + c + d);
        let same = |x: f64, y: f64| math::abs(x - y) <= hair;
        let stretched = same(a + d, b + c);
        let folded = same(math::abs(a - d), math::abs(b - c));
        if !stretched && !folded {
            let sum = a + b + c + d;
            let ends = a.max(b).max(c).max(d) + a.min(b).min(c).min(d);
            let others = sum - ends;
            return Err(DimensionError::NeverFlat { ends, others }.into());
        }
        let [from, to] = match bare.domain {
            Domain::Turn => [0.0, TAU],
            Domain::Stroke { from, to } => [from, to],
        };
        let joint = 2;
        let [least, most] = bare.reach();
        let span = bare.span(from);
        let mut gap = f64::NEG_INFINITY;
        if !folded {
            gap = gap.max(least - span);
        }
        if !stretched {
            gap = gap.max(span - most);
        }
        if gap > 2.0 * HAIR * most {
            return Err(PoseError::CannotAssemble {
                phi: from,
                joint,
                gap,
            }
            .into());
        }
        let mut ends = heapless::Vec::<[f64; 2], 2>::new();
        let [inner, outer] = bare.limits();
        // Pushes cannot fail: capacity of two.
        if !folded {
            let _ = ends.push([least, inner]);
        }
        if !stretched {
            let _ = ends.push([most, outer]);
        }
        for [kept_off, limit] in ends {
            if gap >= 0.0 || bare.first(&[kept_off], from) <= to {
                let phi = if gap >= 0.0 {
                    from
                } else {
                    bare.first(&[limit], from)
                };
                return Err(PoseError::DeadPoint { phi, joint }.into());
            }
        }
        if bare.domain == Domain::Turn && !(stretched && folded) {
            return Err(DimensionError::TwoTurns.into());
        }
        if stretched && folded && same(a, b) && side == Side::Right {
            return Err(DimensionError::RockerStands.into());
        }
        // The first half turn from the start on with the crank to the left of OC.
        let start = from - bare.ground_angle();
        let first = start
            + if beyond(start) < PI {
                0.0
            } else {
                TAU - beyond(start)
            };
        let kept = FlatBranch {
            stretched,
            folded,
            sign: 1.0,
        };
        let middle = first - beyond(first) + 0.5 * PI;
        let sign = kept.side(middle) * side.sign();
        bare.kept = Some(FlatBranch { sign, ..kept });
        bare.with_angles_from(from)
    }

    /// The crank angles (rad, 0 to 2π) of the change points through which the linkage is kept on its branch; empty for other linkages.
    #[must_use]
    pub fn change_points(&self) -> heapless::Vec<f64, 2> {
        let mut found = heapless::Vec::new();
        let gamma = self.ground_angle();
        if let Some(kept) = &self.kept {
            // Pushes cannot fail: capacity of two.
            if kept.folded {
                let _ = found.push(beyond(gamma));
            }
            if kept.stretched {
                let _ = found.push(beyond(gamma + PI));
            }
        }
        found
    }

    /// The side of AC with B at a crank angle, +1 for left; 0 at a change point.
    pub(super) fn side_at(&self, phi: f64) -> f64 {
        match &self.kept {
            Some(kept) => kept.side(phi - self.ground_angle()),
            None => self.side.sign(),
        }
    }

    /// Coupler and rocker on the branch, each with an angle within half a turn of its own; `None` at a dead point.
    #[inline(never)]
    pub(super) fn along(
        &self,
        kept: &FlatBranch,
        phi: Transfer,
        [a, c]: [[Transfer; 2]; 2],
    ) -> Option<[(Frame, f64); 2]> {
        let [crank, b, rocker, d] = self.lengths();
        let gamma = self.ground_angle();
        let same = |x: f64, y: f64| math::abs(x - y) <= HAIR * (crank + b + rocker + d);
        if kept.stretched && kept.folded && kept.sign > 0.0 && same(crank, rocker) {
            // A parallelogram: the coupler translates on a circle, the rocker turns with the crank.
            let [x, y] = self.dimensions.pivot.map(|x| Transfer::constant(x / d));
            let coupler = Frame::moving(a, y, x);
            return Some([
                (coupler, gamma),
                (Frame::turning(self.dimensions.pivot, phi), phi.value),
            ]);
        }
        let (sin, cos) = ((phi - Transfer::constant(gamma)) * 0.5).sin_cos();
        let (sum, difference) = (b + rocker, b - rocker);
        let [x, y] = [c[0] - a[0], c[1] - a[1]];
        let scale = 2.0 * math::sqrt(crank * d);
        let root = |square: Transfer| (square.value > 0.0).then(|| square.sqrt());
        if kept.folded && same(crank, d) {
            // A meets C: AC = f·e with signed f, and e = (cos, sin) of (φ + γ)/2 − π/2.
            let span = sin * (2.0 * crank);
            let height = root(Transfer::constant(sum * sum) - span * span)? * (0.5 * kept.sign);
            let line = (phi + Transfer::constant(gamma - PI)) * 0.5;
            let (sin, cos) = line.sin_cos();
            let link = |origin, half: Transfer, length: f64| {
                let scale = 1.0 / length;
                Frame::moving(
                    origin,
                    (half * sin + height * cos) * scale,
                    (half * cos - height * sin) * scale,
                )
            };
            let near = line.value + 0.5 * PI * kept.sign;
            let half = span * 0.5;
            let (coupler, rocker) = (link(a, half, b), link(c, half * -1.0, rocker));
            return Some([(coupler, near), (rocker, near)]);
        }
        let square = x * x + y * y;
        let first = if kept.stretched {
            cos * scale
        } else {
            root(Transfer::constant(sum * sum) - square)?
        };
        let second = if kept.folded {
            sin * scale
        } else {
            root(square - Transfer::constant(difference * difference))?
        };
        let q = first * second * (0.5 * kept.sign);
        let [from_a, from_c] = dyad::placed([a, c], ([x, y], square), [b, rocker], q);
        // The half angle of a link with AC has the tangent ±√((c − b + f)·(c + b − f))/√((b + f − c)·(b + f + c)), and its two roots have the signs
        // of q's.
        let half = |own: f64, other: f64| match (kept.folded && other > own, kept.stretched) {
            (false, _) => 0.0,
            (true, false) => 0.5 * PI,
            (true, true) => 0.5 * (PI - (phi.value - gamma)),
        };
        let line = self.line(phi.value, [a, c]);
        Some([
            (from_a, line + 2.0 * kept.sign * half(b, rocker)),
            (from_c, line + PI - 2.0 * kept.sign * half(rocker, b)),
        ])
    }
}
