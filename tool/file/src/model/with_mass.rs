//! Masses fixed to links: a link and its masses form one rigid body.

use jred::Domain;
use jred::error::Error;
use jred::machine::{Frames, Jointed, Joints, Link, MassProperties, Mechanism, PoseError};

use crate::model::mechanism::AnyMechanism;

/// A mass fixed to a link: a counterweight, a tool, a payload.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttachedMass {
    /// Index of the link.
    pub link: usize,
    /// Position of its centre of mass in the link's frame (m).
    pub at: [f64; 2],
    /// Mass (kg).
    pub mass: f64,
    /// Moment of inertia about its own centre of mass (kg·m²).
    pub inertia: f64,
}

impl AttachedMass {
    /// The mass without its link, in the link's frame.
    ///
    /// # Errors
    /// A value is not finite.
    pub fn alone(&self) -> Result<Link, Error> {
        Ok(Link::new(MassProperties {
            mass: self.mass,
            inertia: self.inertia,
            com: self.at,
        })?)
    }

    /// The link with the mass on it: one rigid body.
    ///
    /// # Errors
    /// A sum is not finite.
    pub fn on(&self, link: &Link) -> Result<Link, Error> {
        let (own, mass) = (link.mass(), link.mass() + self.mass);
        if mass == 0.0 {
            return Ok(Link::rotor(link.inertia() + self.inertia)?);
        }
        let com = [0, 1].map(|k| (own * link.com()[k] + self.mass * self.at[k]) / mass);
        let off = |at: [f64; 2]| (at[0] - com[0]).powi(2) + (at[1] - com[1]).powi(2);
        let steiner = own * off(link.com()) + self.mass * off(self.at);
        Ok(Link::new(MassProperties {
            mass,
            inertia: link.inertia() + self.inertia + steiner,
            com,
        })?)
    }
}

/// The mechanism with masses on its links.
///
/// # Errors
/// A sum is not finite.
pub fn laden<'a>(
    mechanism: &AnyMechanism,
    masses: impl IntoIterator<Item = &'a AttachedMass>,
) -> Result<AnyMechanism, Error> {
    let mut masses = masses.into_iter().peekable();
    if masses.peek().is_none() {
        return Ok(mechanism.clone());
    }
    let mut links = mechanism.links().to_vec();
    for mass in masses {
        if let Some(link) = links.get_mut(mass.link) {
            *link = mass.on(link)?;
        }
    }
    let inner = mechanism.clone();
    Ok(mechanism.clone().with_inner(WithMass { inner, links }))
}

/// A mechanism with masses on some of its links.
#[derive(Clone, Debug)]
pub(crate) struct WithMass {
    inner: AnyMechanism,
    links: Vec<Link>,
}

impl WithMass {
    /// The mechanism without the masses.
    pub(crate) const fn inner(&self) -> &AnyMechanism {
        &self.inner
    }
}

impl Mechanism for WithMass {
    fn links(&self) -> &[Link] {
        &self.links
    }
    fn domain(&self) -> Domain {
        self.inner.domain()
    }
    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        self.inner.frames(phi)
    }
    fn edge(&self, k: usize) -> Option<f64> {
        self.inner.edge(k)
    }
}

impl Jointed for WithMass {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        self.inner.joints(phi, frames)
    }
    fn drive(&self) -> usize {
        self.inner.drive()
    }
    fn determined(&self, phi: f64) -> bool {
        self.inner.determined(phi)
    }
}
