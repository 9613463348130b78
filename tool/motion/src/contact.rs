//! One-sided contacts in a computed motion: a follower that leaves its cam, a rope that goes slack.
//!
//! No limit of a fastest motion covers them. The force of a contact is linear in the acceleration, so place and speed give the largest acceleration
//! that keeps it.

use jred::error::Error;
use jred_analysis::contact::{ContactLoss, OneWay, lost};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;

use crate::trace::Trace;

/// Shares of a step at which its contacts are checked.
const SHARES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Share of the contact-keeping acceleration that is suggested as a limit: between the checked places it may be slightly smaller.
const LIMIT_MARGIN: f64 = 0.98;

/// A contact that a motion loses, and limits that keep it.
#[derive(Clone, Debug)]
pub struct ContactLimits {
    /// The contact, where and when.
    pub lost: ContactLoss,
    /// Limits of acceleration and deceleration of the drive link (rad/s², or m/s²) that keep the contact, where the motion exceeds them; `None`: no
    /// such limit alone keeps it.
    pub limits: Option<[Option<f64>; 2]>,
}

/// The first contact that a motion of the drive link loses.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub fn broken(file: &MachineFile, trace: &Trace) -> Result<Option<ContactLimits>, Error> {
    let nodes = trace.nodes();
    if nodes.len() < 2 || OneWay::all(file.machine.mechanism()).is_empty() {
        return Ok(None);
    }
    let Some(lost) = lost(file, &Motion::nodes(nodes, false))? else {
        return Ok(None);
    };
    let limits = limits(file, trace)?;
    Ok(Some(ContactLimits { lost, limits }))
}

/// The largest acceleration and deceleration that keep all contacts at the places and speeds of a motion, also at rest. Only kinds that the motion
/// exceeds are given.
fn limits(file: &MachineFile, trace: &Trace) -> Result<Option<[Option<f64>; 2]>, Error> {
    let joints = OneWay::all(file.machine.mechanism());
    let mut most = [f64::INFINITY; 2];
    let mut exceeded = [false; 2];
    for [a, b] in trace.steps() {
        let way = b.phi - a.phi;
        if way == 0.0 {
            continue;
        }
        for share in SHARES {
            let state = b.after(a, share);
            let now = ScheduleInstant {
                omega: Some(way.signum()),
                ..ScheduleInstant::default()
            };
            let machine = file.machine_at(&now, state.phi)?;
            for joint in &joints {
                for omega in [state.omega, 0.0] {
                    let force = |alpha: f64| joint.force(&machine, [state.phi, omega, alpha]);
                    let even = force(0.0)?;
                    if !joint.holds(even) {
                        return Ok(None);
                    }
                    for (kind, sign) in [(0, way.signum()), (1, -way.signum())] {
                        let falls = even - force(sign)?;
                        if falls > 0.0 {
                            most[kind] = f64::min(most[kind], even / falls);
                        }
                        let own = state.alpha * sign;
                        exceeded[kind] |= own > 0.0 && own * falls > even;
                    }
                }
            }
        }
    }
    let kept = [0, 1].map(|kind| exceeded[kind].then_some(LIMIT_MARGIN * most[kind]));
    Ok((kept != [None; 2]).then_some(kept))
}
