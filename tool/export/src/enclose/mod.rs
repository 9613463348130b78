//! The curves of a machine file's machine in intervals: the basis of a proof of a table's error.
//!
//! The positions of the links are found in two ways: linkages by the closure of their joints; gear trains, racks, screws and ropes, whose coordinates
//! are proportional to φ, from one pose. A Geneva drive uses both in turn. Curves over a position, which the machine's equations represent by virtual
//! links, are added as curves.

mod course;

use jred::friction::FrictionDrive;
use jred::machine::Machine;
use jred::machine::{Element, Frame, Load, Mechanism as _};
use jred::mechanism::{BallScrew, Geneva, Hoist, ParallelShafts, Planetary, RackAndPinion, Train};
use jred_enclosure::{Closure, Curves, Interval, LinkFrame, Parts, ProofError, TaylorForm};
use jred_file::math;
use std::any::Any;

use jred_file::model::mechanism::{AnyMechanism, Inner};
use jred_file::model::virtual_link::LinkCurve;

/// A machine whose curves can be enclosed on any stretch of its range.
pub(crate) struct EnclosedMachine<'m> {
    machine: &'m Machine<AnyMechanism>,
    motion: LinkMotion<'m>,
    courses: Vec<&'m LinkCurve>,
    /// Loads on the mechanism's own links.
    loads: Vec<Load>,
    elements: Vec<Element>,
}

/// Motion of the mechanism's own links.
enum LinkMotion<'m> {
    /// By the closure of their joints.
    Closed(Closure<'m>),
    /// Every coordinate is proportional to the drive link's.
    Geared(&'m dyn Inner),
    /// Closed on some stretches, at rest on the others: a Geneva drive.
    Indexed(&'m dyn Inner),
}

impl<'m> EnclosedMachine<'m> {
    /// The curves of a machine.
    ///
    /// # Errors
    /// A mechanism that cannot be enclosed.
    pub(crate) fn new(machine: &'m Machine<AnyMechanism>) -> Result<Self, ProofError> {
        let any = machine.mechanism();
        let (bare, courses) = any.bare();
        let own = any.own_links();
        let phi = machine.mechanism().domain().position(0.3);
        let named = |why| match why {
            ProofError::Joint { number } => {
                let name = any.joint_names().get(number).map_or("", String::as_str);
                ProofError::Part(format!(
                    "the motion that joint \"{name}\" of the {} transmits is not enclosed in intervals",
                    any.kind()
                ))
            }
            other => other,
        };
        let motion = if is_geared(bare) {
            LinkMotion::Geared(bare)
        } else if (bare as &dyn Any).is::<Geneva>() {
            LinkMotion::Indexed(bare)
        } else if any.pairs().is_empty() {
            LinkMotion::Closed(Closure::new(bare, own, any.own_joints(), phi).map_err(named)?)
        } else {
            LinkMotion::Closed(Closure::of_pairs(bare, own, any.pairs(), phi).map_err(named)?)
        };
        let on_own = |link: Option<usize>| link.is_none_or(|link| link < own);
        let elements = machine.elements().iter();
        let elements =
            elements.filter(|e| e.between().iter().all(|marker| on_own(marker.body.link())));
        let loads = machine.loads().iter().filter(|load| load.link() < own);
        Ok(Self {
            machine,
            motion,
            courses,
            loads: loads.copied().collect(),
            elements: elements.copied().collect(),
        })
    }

    /// The curves from one position of the drive link to another.
    ///
    /// # Errors
    /// The stretch is too long, or a place on it is singular.
    pub(crate) fn curves(&self, stretch: [f64; 2]) -> Result<Curves, ProofError> {
        let places = match &self.motion {
            LinkMotion::Closed(closure) => closure.places(stretch)?,
            LinkMotion::Geared(mechanism) => geared(*mechanism, stretch)?,
            LinkMotion::Indexed(mechanism) => {
                let any = self.machine.mechanism();
                let middle = stretch[0].midpoint(stretch[1]);
                match Closure::new(*mechanism, any.own_links(), any.own_joints(), middle) {
                    Ok(closure) => closure.places(stretch)?,
                    // The dwell.
                    Err(ProofError::Joint { .. }) => geared(*mechanism, stretch)?,
                    Err(why) => return Err(why),
                }
            }
        };
        let own = places.len();
        let links = self.machine.mechanism().links();
        let parts = Parts {
            links: links.get(..own).unwrap_or(links),
            loads: &self.loads,
            elements: &self.elements,
            gravity: self.machine.gravity(),
            flywheel: self.machine.flywheel(),
        };
        let mut curves = Curves::of(&parts, &places, stretch)?;
        for (k, course) in self.courses.iter().enumerate() {
            let load = self
                .machine
                .loads()
                .iter()
                .find(|load| load.link() == own + k);
            let window = load.and_then(Load::window);
            course::add(&mut curves, course, &places, stretch, window.as_ref());
        }
        Ok(curves)
    }
}

/// Whether all coordinates of a mechanism are proportional to the drive link's.
fn is_geared(mechanism: &dyn Inner) -> bool {
    let any: &dyn Any = mechanism;
    any.is::<RackAndPinion>()
        || any.is::<BallScrew>()
        || any.is::<Hoist>()
        || any.is::<ParallelShafts>()
        || any.is::<Planetary>()
        || any.is::<Train>()
        || any.is::<FrictionDrive>()
}

/// The links of such a mechanism, from one pose: their rates are constant.
fn geared(
    mechanism: &dyn Inner,
    stretch: [f64; 2],
) -> Result<Vec<LinkFrame<TaylorForm>>, ProofError> {
    let middle = stretch[0].midpoint(stretch[1]);
    let frames = mechanism
        .frames(middle)
        .map_err(|_| ProofError::Pose { phi: middle })?;
    // A few rounding errors of the largest number from whose difference it may be computed.
    let parts = |q: jred::number::Transfer| q.value.abs().max(q.d1.abs());
    let sizes = frames.iter().flat_map(|f| [f.x, f.y, f.psi].map(parts));
    let largest = sizes.fold(1.0, f64::max);
    let number = |value: f64| Interval::around(value, 1e-15 * largest);
    let away = TaylorForm::variable(stretch) - TaylorForm::constant(middle);
    let planets = (mechanism as &dyn Any).is::<Planetary>();
    let place = |(k, frame): (usize, &Frame)| {
        let at = |q: jred::number::Transfer| {
            let rate = TaylorForm::somewhere(number(q.d1));
            away * rate + TaylorForm::somewhere(number(q.value))
        };
        // The centre of the planets rotates with their carrier.
        let origin = if planets && k == Planetary::PLANETS {
            let carrier = frames.get(Planetary::CARRIER)?;
            let (sin, cos) = at(carrier.psi).sin_cos();
            let arm = math::hypot(frame.x.value, frame.y.value);
            let arm = TaylorForm::somewhere(number(arm));
            [cos * arm, sin * arm]
        } else {
            [at(frame.x), at(frame.y)]
        };
        Some(LinkFrame::new(origin, at(frame.psi)))
    };
    let places = frames.iter().enumerate().map(place);
    places
        .collect::<Option<_>>()
        .ok_or(ProofError::Pose { phi: middle })
}
