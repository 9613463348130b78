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

use super::{Frames, Jointed, Mechanism};
use crate::error::{finite, positive};
use crate::machine::joint::{Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::number::transfer::Transfer;
use crate::{Domain, Error, math};

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

/// A slider-crank with offset, driven at the crank, which turns fully.
///
/// Links: [`CRANK`](Self::CRANK) (frame at O along OA), [`ROD`](Self::ROD) (frame at A along AB),
/// [`SLIDER`](Self::SLIDER) (frame at B, parallel to the global axes).
///
/// Accuracy: positions, transfer functions and reaction-free reduction agree with 50-digit golden data to
/// 1e-12 of the column's largest value (test `slider_crank_golden`).
#[derive(Clone, Debug, PartialEq)]
pub struct SliderCrank {
    crank: f64,
    rod: f64,
    offset: f64,
    sign: f64,
    links: [Link; 3],
}

impl SliderCrank {
    /// Index of the crank.
    pub const CRANK: usize = 0;
    /// Index of the connecting rod.
    pub const ROD: usize = 1;
    /// Index of the slider.
    pub const SLIDER: usize = 2;

    /// A slider-crank with `crank` and `rod` lengths r, l (m), guide `offset` e (m) and the links crank, rod, slider.
    ///
    /// # Errors
    /// A length that is not positive; a rod too short for a full turn, l ≤ r + |e|, with the angle where it fails.
    pub fn new(
        crank: f64,
        rod: f64,
        offset: f64,
        branch: Branch,
        links: [Link; 3],
    ) -> Result<Self, Error> {
        let crank = positive("crank length", crank)?;
        let rod = positive("rod length", rod)?;
        let offset = finite("offset", offset)?;
        let shortest_rod = crank + math::abs(offset);
        // A hair of distance keeps cos ψ away from the roundings of 1 − sin²ψ, so that no angle fails later.
        if rod <= shortest_rod * (1.0 + 1e-12) {
            // The distance |e − r·sin φ| to be spanned is largest at φ = 90° (e < 0) or 270°; the first φ > 0 at
            // which it exceeds the rod is where the turn ends.
            let phi = first_unreachable(crank, rod, offset);
            return Err(Error::CannotTurn { phi, shortest_rod });
        }
        let sign = match branch {
            Branch::Right => 1.0,
            Branch::Left => -1.0,
        };
        Ok(Self {
            crank,
            rod,
            offset,
            sign,
            links,
        })
    }

    /// Crank length (m).
    pub const fn crank(&self) -> f64 {
        self.crank
    }

    /// Rod length (m).
    pub const fn rod(&self) -> f64 {
        self.rod
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
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, Error> {
        let origin = [0.0, 0.0];
        Ok(Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::CRANK, origin)]),
            Joint::Revolute([
                Marker::on(Self::CRANK, [self.crank, 0.0]),
                Marker::on(Self::ROD, origin),
            ]),
            Joint::Revolute([
                Marker::on(Self::ROD, [self.rod, 0.0]),
                Marker::on(Self::SLIDER, origin),
            ]),
            Joint::Prismatic([
                Marker::ground([0.0, self.offset]),
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

    fn frames(&self, phi: f64) -> Result<Frames, Error> {
        let angle = Transfer::variable(finite("crank angle", phi)?);
        let crank = Frame::turning([0.0, 0.0], angle);
        let [x_a, y_a] = crank.point([self.crank, 0.0]);
        let sin = (Transfer::constant(self.offset) - y_a) * (1.0 / self.rod);
        let under_root = Transfer::constant(1.0) - sin * sin;
        if under_root.value <= 0.0 {
            return Err(Error::DeadPoint { phi, joint: 3 });
        }
        let cos = under_root.sqrt() * self.sign;
        // On the left branch the rod points to the left: ψ stays within a quarter turn of π.
        let rod = Frame::moving([x_a, y_a], sin, cos).unwrapped(if self.sign > 0.0 {
            0.0
        } else {
            core::f64::consts::PI
        });
        let [x_b, _] = rod.point([self.rod, 0.0]);
        let slider = Frame::translating([x_b, Transfer::constant(self.offset)]);
        Ok(Frames::from_iter([crank, rod, slider]))
    }
}
