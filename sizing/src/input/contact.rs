//! Whether a follower stays on its cam in the prescribed motion.

use std::f64::consts::TAU;

use jred::Error;
use jred::cam::{contact_force, lift_off};

use crate::coordinate::Coordinate;
use crate::machine::{Contact, MachineFile};
use crate::motion::Motion;

use super::problem::{Result, figure};
use super::section::Section;

/// Samples of a turn of the cam, and fewest of a stretch of the motion.
const PER_TURN: f64 = 1440.0;
const FEWEST: f64 = 128.0;

/// Checks that every contact force is positive over the whole motion. A cam that holds its follower on both sides has no
/// contact to check.
pub(super) fn check(file: &MachineFile, mechanism: &Section) -> Result<()> {
    let Some(motion) = &file.motion else {
        return Ok(());
    };
    let contacts = file.machine.mechanism().contacts();
    contacts
        .iter()
        .try_for_each(|contact| holds(file, mechanism, motion, contact))
}

fn holds(
    file: &MachineFile,
    mechanism: &Section,
    motion: &Motion,
    contact: &Contact,
) -> Result<()> {
    let report = |error: Error| mechanism.problem(error.to_string(), "in this mechanism");
    let force = |t: f64| {
        let state = motion.at(t);
        contact_force(
            &file.machine,
            contact.joint,
            state.phi,
            state.omega,
            state.alpha,
        )
    };
    let (t, least) = smallest(motion, force).map_err(report)?;
    if least > 0.0 {
        return Ok(());
    }
    let state = motion.at(t);
    let pieces = contact.pieces.iter().copied();
    let limit = lift_off(&file.machine, contact.joint, pieces, state.omega).map_err(report)?;
    let known = file.machine.mechanism();
    let name = match known.joint_names().get(contact.joint) {
        Some(name) if name != "contact" => format!("joint \"{name}\": "),
        _ => String::new(),
    };
    let leaves = format!("{name}the follower leaves the cam in the prescribed motion");
    if Coordinate::of(known).map_err(report)? == Coordinate::Length {
        let message = format!(
            "{leaves}: at {}, {} m/s, the contact force would be {} N",
            Coordinate::Length.place(state.phi),
            figure(state.omega),
            figure(least)
        );
        return Err(mechanism.problem(message, "in this cam").help(
            "use a stiffer spring, more preload or a slower motion; write closure = \"form\" for a grooved or conjugate cam, \
             which holds the follower on both sides",
        ));
    }
    let cure = limit.map_or_else(
        || "at a constant speed it would not: accelerate more slowly, or add preload".to_owned(),
        |limit| limit.to_string(),
    );
    let message = format!(
        "{leaves}: at φ = {:.2}°, {} rpm, the contact force would be {} N",
        state.phi.rem_euclid(TAU).to_degrees(),
        figure(state.omega * 60.0 / TAU),
        figure(least)
    );
    Err(mechanism.problem(message, "in this cam").help(format!(
        "at constant speed: {cure}; write closure = \"form\" for a grooved or conjugate cam, which holds the follower on both sides"
    )))
}

/// The time of the smallest force, and the force.
fn smallest(
    motion: &Motion,
    force: impl Fn(f64) -> std::result::Result<f64, Error>,
) -> std::result::Result<(f64, f64), Error> {
    let mut best = (0.0, f64::INFINITY);
    for (from, to) in motion.stretches() {
        let turned = (motion.at(to).phi - motion.at(from).phi).abs() / TAU;
        let count = (PER_TURN * turned).ceil().max(FEWEST);
        // Between stretches the acceleration may jump: a hair inside.
        let hair = 1e-9 * (to - from);
        let at = |share: f64| (from + share * (to - from)).clamp(from + hair, to - hair);
        let (mut place, mut least) = (0.0, f64::INFINITY);
        for k in 0..=count as u32 {
            let value = force(at(f64::from(k) / count))?;
            if value < least {
                (place, least) = (f64::from(k), value);
            }
        }
        // Between the samples by thirds.
        let (mut low, mut high) = (place - 1.0, place + 1.0);
        for _ in 0..60 {
            let third = (high - low) / 3.0;
            if force(at((low + third) / count))? < force(at((high - third) / count))? {
                high -= third;
            } else {
                low += third;
            }
        }
        let refined = at(low.midpoint(high) / count);
        for (t, value) in [(at(place / count), least), (refined, force(refined)?)] {
            if value < best.1 {
                best = (t, value);
            }
        }
    }
    Ok(best)
}
