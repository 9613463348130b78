//! A roll onto which a web is wound: its radius and its inertia grow with the turns.
//!
//! With thickness h, width b, density ρ and the core's radius r₀, an Archimedean spiral has
//!
//! ```text
//! r = r₀ + h·φ/2π        L = r₀·φ + h·φ²/4π        L′ = r
//! J = J₀ + ½·π·ρ·b·(r⁴ − r₀⁴)        J′ = ρ·b·h·r³
//! ```
//!
//! J is that of a rotor of 1 kg·m² with ψ′ = √J, as for [tabulated curves](crate::model::virtual_link).

use std::f64::consts::{PI, TAU};

use jred::Domain;
use jred::error::Error;
use jred::machine::{
    Body, Frame, Frames, Joint, Jointed, Joints, Link, Marker, Mechanism, PoseError, Wrench,
};
use jred::number::{RangeError, Transfer};

/// The figures of a winder (SI).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roll {
    /// Radius of the core (m).
    pub(crate) core: f64,
    /// Radius of the full roll (m), greater.
    pub(crate) full: f64,
    /// Moment of inertia of core and shaft (kg·m²).
    pub(crate) inertia: f64,
    /// Thickness of the web (m).
    pub(crate) thickness: f64,
    /// Mass of the web per length (kg/m): ρ·b·h.
    pub(crate) web: f64,
}

impl Roll {
    /// φ of the full roll (rad).
    pub(crate) fn turned(&self) -> f64 {
        TAU * (self.full - self.core) / self.thickness
    }

    /// Length of the web on the full roll (m).
    pub(crate) fn length(&self) -> f64 {
        PI * (self.full * self.full - self.core * self.core) / self.thickness
    }

    /// r at `phi` (m).
    fn radius(&self, phi: f64) -> f64 {
        self.core + self.thickness * phi / TAU
    }

    /// J at `phi` with two derivatives.
    fn inertia(&self, phi: f64) -> Transfer {
        let r = self.radius(phi);
        let growth = self.thickness / TAU;
        let wound = r.powi(4) - self.core.powi(4);
        Transfer {
            value: self.inertia + 0.5 * PI * self.web / self.thickness * wound,
            d1: self.web * r.powi(3),
            d2: 3.0 * self.web * r * r * growth,
            d3: 0.0,
        }
    }
}

/// A winder.
#[derive(Clone, Debug)]
pub(crate) struct Winder {
    roll: Roll,
    domain: Domain,
    links: [Link; 3],
}

impl Winder {
    pub(crate) const ROLL: usize = 0;
    pub(crate) const WEB: usize = 1;
    const WOUND: usize = 2;

    /// A winder that winds for φ > 0.
    ///
    /// # Errors
    /// The range is empty or not finite.
    pub(crate) fn new(roll: Roll) -> Result<Self, Error> {
        Ok(Self {
            domain: Domain::stroke(0.0, roll.turned())?,
            links: [Link::MASSLESS, Link::MASSLESS, Link::rotor(1.0)?],
            roll,
        })
    }
}

impl Mechanism for Winder {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        if !phi.is_finite() {
            return Err(RangeError::NotFinite("position of the roll").into());
        }
        let growth = self.roll.thickness / TAU;
        let web = Transfer {
            value: self.roll.core * phi + 0.5 * growth * phi * phi,
            d1: self.roll.radius(phi),
            d2: growth,
            d3: 0.0,
        };
        let rate = self.roll.inertia(phi).sqrt();
        let wound = Transfer {
            value: 0.0,
            d1: rate.value,
            d2: rate.d1,
            d3: rate.d2,
        };
        Ok(Frames::from_iter([
            Frame::turning([0.0, 0.0], Transfer::variable(phi)),
            Frame::translating([web, Transfer::constant(0.0)]),
            Frame::turning([0.0, 0.0], wound),
        ]))
    }
}

impl Jointed for Winder {
    /// The roll's bearing, the web's guide, the web's pull, and the bearing and gearing of the rotor that represents J.
    fn joints(&self, _phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        let of = |link: usize| frames.get(link).unwrap_or(&Frame::GROUND);
        let (web, wound) = (of(Self::WEB), of(Self::WOUND));
        let bearing =
            |link| Joint::Revolute([Marker::ground([0.0, 0.0]), Marker::on(link, [0.0, 0.0])]);
        let on_roll = |moment| Wrench::moment(Body::Link(Self::ROLL), moment);
        Ok(Joints::from_iter([
            bearing(Self::ROLL),
            Joint::Prismatic([
                Marker::ground([0.0, 0.0]),
                Marker::on(Self::WEB, [0.0, 0.0]),
            ]),
            Joint::Transmission([
                on_roll(-web.x.d1),
                Wrench::force(Body::Link(Self::WEB), [web.x.value, 0.0], [1.0, 0.0]),
            ]),
            bearing(Self::WOUND),
            Joint::Transmission([
                on_roll(-wound.psi.d1),
                Wrench::moment(Body::Link(Self::WOUND), 1.0),
            ]),
        ]))
    }
}
