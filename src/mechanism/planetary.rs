//! The simple planetary gear in closed form: sun, planets on a carrier, ring.
//!
//! Willis: relative to the carrier it is an ordinary train, from the sun over the planets to the ring:
//!
//! ```text
//! z_s·(ω_s − ω_c) = −z_p·(ω_p − ω_c) = −z_r·(ω_r − ω_c)        so   ω_s + k·ω_r = (1 + k)·ω_c,   k = z_r/z_s
//! J_red = J_s·ω_s² + (J_c + N·m_p·a²)·ω_c² + J_r·ω_r² + N·J_p·ω_p²,   every ω for an input of 1
//! ```
//!
//! One member is fixed, another is the input, the third the output. For a fixed ring and the sun as input ω_c = z_s/(z_s + z_r).
//!
//! R. Willis, *Principles of mechanism* (1841); the energy sum is (6.4) of Nazarenko, *Dynamics of mechanisms* (2002).

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::PI;

use super::DimensionError;
use super::dimensions::centred;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link, MassProperties};
use crate::number::error::{finite, positive, within};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// A central member of a planetary gear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Member {
    /// The sun.
    Sun,
    /// The planet carrier.
    Carrier,
    /// The ring.
    Ring,
}

impl Member {
    /// Name in messages.
    const fn name(self) -> &'static str {
        match self {
            Self::Sun => "sun",
            Self::Carrier => "carrier",
            Self::Ring => "ring",
        }
    }

    /// Index of its link.
    const fn link(self) -> usize {
        match self {
            Self::Sun => Planetary::SUN,
            Self::Carrier => Planetary::CARRIER,
            Self::Ring => Planetary::RING,
        }
    }
}

/// Teeth and distances of a planetary gear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PlanetaryDimensions {
    /// Teeth z_s of the sun.
    pub sun: u32,
    /// Teeth z_p of a planet: (z_r − z_s)/2 or, with profile shift, one more or less; the ratios do not depend on it.
    pub planet: u32,
    /// Teeth z_r of the ring.
    pub ring: u32,
    /// Number N of planets, equally spaced, at least 2.
    pub planets: u32,
    /// Distance a > 0 of the planets' axes from the central one (m).
    pub centres: f64,
}

/// The gears of a planetary gear, checked for fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanetaryGears(PlanetaryDimensions);

impl PlanetaryGears {
    /// Least number of teeth of a gear.
    pub const MIN_TEETH: u32 = 5;
    /// Greatest number of teeth of a gear.
    pub const MAX_TEETH: u32 = 100_000;

    /// Checks that the gears mesh and fit.
    ///
    /// # Errors
    /// Fewer than [`MIN_TEETH`](Self::MIN_TEETH) or more than [`MAX_TEETH`](Self::MAX_TEETH) teeth; fewer than two planets, which would not balance;
    /// a distance that is not positive; planets that do not fill the gap, that cannot be equally spaced ((z_s + z_r)/N is not an integer), or that
    /// overlap (sin(π/N) ≤ z_p/(z_s + z_p)).
    pub fn new(dimensions: PlanetaryDimensions) -> Result<Self, BuildError> {
        let PlanetaryDimensions {
            sun,
            planet,
            ring,
            planets,
            centres,
        } = dimensions;
        let teeth = [Self::MIN_TEETH, Self::MAX_TEETH].map(f64::from);
        within("teeth of the sun", f64::from(sun), teeth)?;
        within("teeth of a planet", f64::from(planet), teeth)?;
        within("teeth of the ring", f64::from(ring), teeth)?;
        let most = f64::from(sun + ring);
        within("number of planets", f64::from(planets), [2.0, most])?;
        positive("centre distance", centres)?;
        let gap = ring.saturating_sub(sun);
        if gap.abs_diff(2 * planet) > 2 {
            return Err(DimensionError::PlanetTeeth { planet, gap }.into());
        }
        if !(sun + ring).is_multiple_of(planets) {
            let teeth = sun + ring;
            return Err(DimensionError::PlanetSpacing { teeth, planets }.into());
        }
        // Neighbours' axes are 2a·sin(π/N) apart, pitch diameters 2a·z_p/(z_s + z_p).
        let diameter = f64::from(planet) / f64::from(sun + planet);
        let (spacing, _) = math::sin_cos(PI / f64::from(planets));
        if spacing <= diameter {
            let fits = |n: &u32| math::sin_cos(PI / f64::from(*n)).0 > diameter;
            let most = (2..planets).rev().find(fits).unwrap_or(2);
            return Err(DimensionError::PlanetsOverlap { planets, most }.into());
        }
        Ok(Self(dimensions))
    }

    /// Teeth of sun, planet and ring, as floating-point numbers.
    fn teeth(&self) -> [f64; 3] {
        [self.0.sun, self.0.planet, self.0.ring].map(f64::from)
    }

    /// Teeth and distances.
    pub const fn dimensions(&self) -> PlanetaryDimensions {
        self.0
    }

    /// Radius of the working pitch circle of the sun, a·z_s/(z_s + z_p), and of the ring, a·z_r/(z_r − z_p) (m).
    #[must_use]
    pub fn pitch_radii(&self) -> [f64; 2] {
        let [sun, planet, ring] = self.teeth();
        let centres = self.0.centres;
        [
            centres * sun / (sun + planet),
            centres * ring / (ring - planet),
        ]
    }
}

/// A planetary gear with one member fixed, driven at another.
///
/// Links: [`SUN`](Self::SUN), [`CARRIER`](Self::CARRIER), [`RING`](Self::RING) (frames at the origin), [`PLANETS`](Self::PLANETS) (frame at the first
/// planet's axis, turning with it). The fixed member is a link at rest, so that its holding moment is among the reactions.
///
/// The N planets are identical and balance each other. One link represents all of them, at the position of the first, with N·J_p. Their mass N·m_p,
/// with its common centre on the axis, belongs to the carrier, with N·m_p·a² in its inertia. In
/// [`link_inertias`](crate::machine::Machine::link_inertias) the carrier's share includes the planets' orbital motion.
///
/// Accuracy: 1e-13 against Willis' equation by the tabular method and the energy of N separate planets (tests `speeds_by_the_tabular_method`,
/// `inertia_of_planets_one_by_one`).
#[derive(Clone, Debug, PartialEq)]
pub struct Planetary {
    gears: PlanetaryGears,
    input: Member,
    fixed: Member,
    links: [Link; 4],
}

impl Planetary {
    /// Index of the sun.
    pub const SUN: usize = 0;
    /// Index of the carrier.
    pub const CARRIER: usize = 1;
    /// Index of the ring.
    pub const RING: usize = 2;
    /// Index of the planets.
    pub const PLANETS: usize = 3;

    /// A planetary gear of these `gears`, driven at `input` with the member `fixed` at rest, and the links sun, carrier, ring and *one* planet: its
    /// mass and its inertia about its own axis.
    ///
    /// # Errors
    /// The same member as input and fixed; a link whose centre of mass is off its axis.
    pub fn new(
        gears: PlanetaryGears,
        input: Member,
        fixed: Member,
        links: [Link; 4],
    ) -> Result<Self, BuildError> {
        if input == fixed {
            return Err(DimensionError::FixedInput(fixed.name()).into());
        }
        let [sun, carrier, ring, planet] = links;
        for (name, link) in ["sun", "carrier", "ring", "planet"].into_iter().zip(&links) {
            centred(name, link)?;
        }
        let PlanetaryDimensions {
            planets, centres, ..
        } = gears.0;
        let count = f64::from(planets);
        let mass = count * planet.mass();
        let orbital = mass * centres * centres;
        let carrier = Link::new(MassProperties {
            mass: carrier.mass() + mass,
            inertia: carrier.inertia() + orbital,
            com: [0.0, 0.0],
        })?;
        let planets = Link::rotor(count * planet.inertia())?;
        Ok(Self {
            gears,
            input,
            fixed,
            links: [sun, carrier, ring, planets],
        })
    }

    /// The gears.
    pub const fn gears(&self) -> &PlanetaryGears {
        &self.gears
    }

    /// The input, the drive link.
    pub const fn input(&self) -> Member {
        self.input
    }

    /// The member at rest.
    pub const fn fixed(&self) -> Member {
        self.fixed
    }

    /// The member that is neither input nor fixed.
    #[must_use]
    pub fn output(&self) -> Member {
        [Member::Sun, Member::Carrier, Member::Ring]
            .into_iter()
            .find(|member| *member != self.input && *member != self.fixed)
            .unwrap_or(self.input)
    }

    /// Speeds of sun, carrier, ring and planets for an input of 1, by Willis' equation.
    #[must_use]
    pub fn speeds(&self) -> [f64; 4] {
        let [sun, planet, ring] = self.gears.teeth();
        let k = ring / sun;
        let [s, c, r] = match (self.fixed, self.input) {
            (Member::Ring, Member::Sun) => [1.0, 1.0 / (1.0 + k), 0.0],
            (Member::Ring, _) => [1.0 + k, 1.0, 0.0],
            (Member::Carrier, Member::Sun) => [1.0, 0.0, -1.0 / k],
            (Member::Carrier, _) => [-k, 0.0, 1.0],
            (Member::Sun, Member::Carrier) => [0.0, 1.0, (1.0 + k) / k],
            (Member::Sun, _) => [0.0, k / (1.0 + k), 1.0],
        };
        let p = c - (s - c) * sun / planet;
        [s, c, r, p]
    }

    /// Signed ratio i = ω_input/ω_output.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        let [s, c, r, _] = self.speeds();
        1.0 / match self.output() {
            Member::Sun => s,
            Member::Carrier => c,
            Member::Ring => r,
        }
    }
}

impl Jointed for Planetary {
    /// The bearings of sun, carrier and ring (the bearing of the fixed member also carries its moment); the planets' pins along the carrier's motion
    /// and towards the axis; the meshes of sun and ring, on the planets.
    ///
    /// Pins and meshes give the sum over all planets, as forces on the first planet at its position: if the load is shared evenly, 1/N of it acts on
    /// each, turned to its position. On the central members these forces are a pure moment. Mesh forces are tangential; the radial forces of a
    /// planet's two meshes, from the pressure angle, balance except for profile shift. A planet's own inertia forces, m_p·a·ω_c² outwards and
    /// m_p·a·α_c, and its weight act on its pin in addition: here its mass belongs to the carrier.
    fn joints(&self, _phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        let bearing = |member: Member| {
            let markers = [Marker::ground(origin), Marker::on(member.link(), origin)];
            if member == self.fixed {
                Joint::Fixed(markers)
            } else {
                Joint::Revolute(markers)
            }
        };
        let carrier = Body::Link(Self::CARRIER).frame(frames).psi.value;
        let (sin, cos) = math::sin_cos(carrier);
        let (outwards, along) = ([cos, sin], [-sin, cos]);
        // A force on the planets at a radius, against a moment on the central member of this radius.
        let force = |link: usize, radius: f64, direction: [f64; 2], arm: f64| {
            let point = outwards.map(|c| c * radius);
            Joint::Transmission([
                Wrench::moment(Body::Link(link), -arm),
                Wrench::force(Body::Link(Self::PLANETS), point, direction),
            ])
        };
        let [sun, ring] = self.gears.pitch_radii();
        let centres = self.gears.0.centres;
        Ok(Joints::from_iter([
            bearing(Member::Sun),
            bearing(Member::Carrier),
            bearing(Member::Ring),
            force(Self::CARRIER, centres, along, centres),
            force(Self::CARRIER, centres, outwards, 0.0),
            force(Self::SUN, sun, along, sun),
            force(Self::RING, ring, along, ring),
        ]))
    }

    fn drive(&self) -> usize {
        self.input.link()
    }
}

impl Mechanism for Planetary {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let input = Transfer::variable(finite("input angle", phi)?);
        let [sun, carrier, ring, planets] = self.speeds().map(|speed| input * speed);
        let central = |angle| Frame::turning([0.0, 0.0], angle);
        let (sin, cos) = carrier.sin_cos();
        let axis = [cos * self.gears.0.centres, sin * self.gears.0.centres];
        Ok(Frames::from_iter([
            central(sun),
            central(carrier),
            central(ring),
            Frame::turned(axis, planets),
        ]))
    }
}
