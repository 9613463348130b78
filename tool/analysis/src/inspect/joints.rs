//! The joints of a mechanism, and its size.

use jred::machine::{Body, Frames, Joint, Jointed as _, Marker};
use jred_file::math;
use serde::Serialize;

use jred_file::model::mechanism::AnyMechanism;

/// One joint.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct JointFinding {
    /// Its name.
    pub name: String,
    /// Pin, guide, and so on.
    pub kind: &'static str,
    /// The two bodies: the first acts on the second.
    pub bodies: [String; 2],
    /// Degrees of freedom that it removes.
    pub constraints: usize,
    /// Whether the drive moves it.
    pub driven: bool,
}

fn body_name(mechanism: &AnyMechanism, body: Body) -> String {
    match body {
        Body::Ground => "ground".to_owned(),
        Body::Link(k) => mechanism.link_names().get(k).cloned().unwrap_or_default(),
    }
}

pub(super) fn findings(mechanism: &AnyMechanism, joints: &[Joint]) -> Vec<JointFinding> {
    // Links that represent curves, each with two joints that remove its three freedoms, are not parts of the machine.
    let names = mechanism.joint_names().iter();
    let finding = |(k, (joint, name)): (usize, (&Joint, &String))| JointFinding {
        name: name.clone(),
        kind: match joint {
            Joint::Revolute(_) => "pin",
            Joint::Prismatic(_) => "guide",
            Joint::Fixed(_) => "rigid",
            Joint::PinInSlot(_) => "pin in slot",
            Joint::Transmission(_) => "transmission",
        },
        bodies: joint.bodies().map(|body| body_name(mechanism, body)),
        constraints: joint.constraints(),
        driven: k == mechanism.drive(),
    };
    joints.iter().zip(names).enumerate().map(finding).collect()
}

/// The size of a mechanism: the largest distance between two of its joints (m).
pub(super) fn size(joints: &[Joint], frames: &Frames) -> f64 {
    let points: Vec<[f64; 2]> = joints
        .iter()
        .flat_map(|joint| points(joint, frames))
        .collect();
    let mut most = 0.0f64;
    for a in &points {
        for b in &points {
            most = most.max(math::hypot(a[0] - b[0], a[1] - b[1]));
        }
    }
    if most > 0.0 { most } else { 1.0 }
}

/// The points of a joint.
fn points(joint: &Joint, frames: &Frames) -> Vec<[f64; 2]> {
    match joint {
        Joint::Revolute(m) | Joint::Prismatic(m) | Joint::Fixed(m) | Joint::PinInSlot(m) => {
            let of = |m: &Marker| m.position(frames).map(|c| c.value);
            m.iter().map(of).collect()
        }
        Joint::Transmission(_) => Vec::new(),
    }
}
