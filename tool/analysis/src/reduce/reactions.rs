//! The forces of d'Alembert's principle as columns: drive, joints, shaking force and moment.
//!
//! They are those of the machine without the internal forces of its drive train. The train's inertia, reduced to the drive link, rotates with it like
//! a flywheel: it changes the drive torque but no joint force. The pull of a belt or a pinion on the drive link's bearing is not in the machine file,
//! and so not in the bearing's force.

use jred::error::Error;
use jred::machine::{Joint, Jointed as _, Mechanism as _};
use jred_file::math;

use super::{RowPose, Set, Source};
use jred_file::model::mechanism::AnyMechanism;
use jred_file::number::columns::{Column, ColumnQuantity};

/// Symbols and units of the columns of a joint.
pub(super) const LOADS: [(ColumnQuantity, &str, &str); 4] = [
    (ColumnQuantity::Other, "F_x", "N"),
    (ColumnQuantity::Other, "F_y", "N"),
    (ColumnQuantity::Force, "F", "N"),
    (ColumnQuantity::Moment, "M", "N m"),
];

/// Kinds of load in the joints.
pub(super) struct Reactions {
    /// For each joint of the mechanism, except those of links that represent curves: whether it carries a force, and a moment.
    carries: Vec<[bool; 2]>,
}

/// Whether a joint carries a force, and a moment.
fn carries(joint: &Joint) -> [bool; 2] {
    match joint {
        Joint::Revolute(_) | Joint::PinInSlot(_) => [true, false],
        Joint::Prismatic(_) | Joint::Fixed(_) => [true, true],
        Joint::Transmission(wrenches) => {
            let force = wrenches
                .iter()
                .any(|w| math::hypot(w.force[0], w.force[1]) > 0.0);
            [force, !force || wrenches.iter().any(|w| w.moment != 0.0)]
        }
    }
}

/// Whether each joint of a mechanism carries a force and a moment, except joints of links that represent curves.
fn carried(mechanism: &AnyMechanism) -> Result<Vec<[bool; 2]>, Error> {
    let phi = mechanism.domain().position(0.0);
    let joints = mechanism.joints(phi, &mechanism.frames(phi)?)?;
    let own = joints.iter().take(mechanism.own_joints());
    Ok(own.map(carries).collect())
}

/// The joints of a mechanism that carry a force, by index and name.
///
/// # Errors
/// The mechanism cannot be placed at the start of its range.
pub fn joints_with_force(mechanism: &AnyMechanism) -> Result<Vec<(usize, &str)>, Error> {
    let names = mechanism.joint_names().iter().map(String::as_str);
    let all = names.enumerate().zip(carried(mechanism)?);
    Ok(all
        .filter_map(|(joint, [force, _])| force.then_some(joint))
        .collect())
}

impl Reactions {
    pub(super) fn new(source: &Source) -> Result<Self, Error> {
        Ok(Self {
            carries: carried(source.machine.mechanism())?,
        })
    }

    /// The columns of a joint, without force or moment if it carries none.
    fn pick<T: Clone>(&self, joint: usize, [x, y, size, moment]: [T; 4]) -> Vec<T> {
        let [force, turns] = self.carries.get(joint).copied().unwrap_or([true, true]);
        let mut picked = Vec::with_capacity(4);
        if force {
            picked.extend([x, y, size]);
        }
        if turns {
            picked.push(moment);
        }
        picked
    }
}

impl Set for Reactions {
    fn heads(&self, source: &Source) -> Vec<Column> {
        let loads = |part: &str| {
            LOADS.map(|(quantity, symbol, unit)| Column::of(quantity, part, symbol, unit))
        };
        let mut heads = vec![source.coordinate.drive_effort()];
        let joints = source.machine.mechanism().joint_names();
        for (k, joint) in joints.iter().enumerate().take(self.carries.len()) {
            heads.extend(self.pick(k, loads(joint)));
        }
        heads.extend(loads("shaking"));
        heads
    }

    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let Some(state) = place.state else {
            return Ok(vec![None; self.heads(source).len()]);
        };
        let machine = source.machines.at(&place.now, place.phi)?;
        if !machine.mechanism().determined(place.phi) {
            // At a change point the drive's effort comes from the reduced link, and the joint forces are unknown.
            let mut values = vec![None; self.heads(source).len()];
            if let Some(drive) = values
                .first_mut()
                .filter(|_| machine.frictions().is_empty())
            {
                let terms = machine.torque(place.phi, state.omega, state.alpha)?;
                *drive = Some(terms.total());
            }
            return Ok(values);
        }
        let forces = machine.forces(place.phi, state.omega, state.alpha)?;
        let mut values = vec![forces.drive];
        for (k, reaction) in forces.reactions.iter().enumerate().take(self.carries.len()) {
            let [x, y] = reaction.force;
            values.extend(self.pick(k, [x, y, math::hypot(x, y), reaction.moment]));
        }
        let [mut x, mut y] = forces.shaking_force;
        let mut moment = forces.shaking_moment;
        for carriage in source.file.schedule.carriages() {
            // The effect of its motion along its guide is an inertia force, too.
            let load = machine.loads().get(carriage.load);
            let Some((load, frame)) = load.zip(place.frames.get(carriage.mass.link)) else {
                continue;
            };
            let wrench = load.wrench(frame, place.phi, state.omega);
            (x, y) = (x + wrench.force[0], y + wrench.force[1]);
            moment += wrench.moment_about([0.0, 0.0]);
        }
        values.extend([x, y, math::hypot(x, y), moment]);
        Ok(values.into_iter().map(Some).collect())
    }
}
