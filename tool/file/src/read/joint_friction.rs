//! `[[friction]]`: friction in joints by its coefficient.

use jred::machine::{Joint, JointFriction, Jointed as _, Machine, Mechanism as _};

use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

/// The machine with the friction of the file.
pub(super) fn read(
    root: &Section,
    mut machine: Machine<AnyMechanism>,
) -> Result<Machine<AnyMechanism>> {
    for section in root.tables("friction")? {
        let friction = friction(&section, machine.mechanism())?;
        section.finish()?;
        machine = machine
            .with_friction(friction)
            .map_err(|error| section.error(error, "in this friction"))?;
    }
    Ok(machine)
}

fn friction(section: &Section, mechanism: &AnyMechanism) -> Result<JointFriction> {
    let report = |error: jred::error::Error| section.error(error, "in this mechanism");
    let phi = mechanism.domain().position(0.0);
    let placed = mechanism.frames(phi);
    let joints = placed.and_then(|frames| mechanism.joints(phi, &frames));
    let joints = joints.map_err(|error| report(error.into()))?;
    let item = section.need("joint")?;
    let joint = item.choice(mechanism.joint_names())?;
    let coefficient = section.figure("coefficient")?;
    let found = match joints.get(joint) {
        Some(Joint::Revolute(_)) => {
            JointFriction::pin(joint, coefficient, section.si("pin_radius")?)
        }
        Some(Joint::Prismatic(_)) => {
            JointFriction::guide(joint, coefficient, Some(section.si("guide_length")?))
        }
        Some(Joint::PinInSlot(_)) => JointFriction::guide(joint, coefficient, None),
        _ => {
            return Err(item
                .problem("has no friction by a coefficient", "neither guide, slot nor pin")
                .help("losses of gears, belts and cams are an efficiency of [[drive_train]], or an opposing_force or opposing_moment in [[load]]"));
        }
    };
    let preload = section.si("preload")?;
    found
        .and_then(|friction| friction.with_preload(preload))
        .map_err(|error| section.error(error, "in this friction"))
}
