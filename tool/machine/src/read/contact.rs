//! Checks that followers stay on their cams and ropes stay taut during the prescribed motion.

use std::f64::consts::TAU;

use jred::Error;

use crate::analysis::contact::OneWay;
use crate::model::machine::MachineFile;
use crate::model::motion::Motion;
use crate::number::numerics;

use crate::text::problem::Result;
use crate::text::section::Section;

/// Samples of a turn of the drive link, and fewest of a stretch of the motion.
const PER_TURN: f64 = 1440.0;
const FEWEST: f64 = 128.0;

/// The most samples of a stretch: a hoist's drum may make a thousand turns.
const MOST: f64 = 60_000.0;

/// Checks that every cam's contact presses and every rope pulls over the whole motion. A cam that guides its follower on
/// both sides has no contact to check.
pub(super) fn check(file: &MachineFile, mechanism: &Section) -> Result<()> {
    let Some(motion) = &file.motion else {
        return Ok(());
    };
    OneWay::all(file.machine.mechanism())
        .into_iter()
        .try_for_each(|joint| holds(file, mechanism, motion, joint))
}

fn holds(file: &MachineFile, mechanism: &Section, motion: &Motion, joint: OneWay) -> Result<()> {
    let report = |error: Error| {
        mechanism
            .problem(error.to_string(), "in this mechanism")
            .help(error.cure().to_string())
    };
    let force = |t: f64| {
        let state = motion.at(t);
        joint.force(&file.machine, [state.phi, state.omega, state.alpha])
    };
    let (t, least) = smallest(motion, force).map_err(report)?;
    if joint.holds(least) {
        return Ok(());
    }
    let state = motion.at(t);
    let parted = joint
        .parted(&file.machine, [state.phi, state.omega], least)
        .map_err(report)?;
    let message = format!(
        "{} in the prescribed motion: at {}, {}",
        parted.what, parted.state, parted.force
    );
    let label = if joint.rope {
        "in this mechanism"
    } else {
        "in this cam"
    };
    Err(mechanism.problem(message, label).help(parted.cure))
}

/// The time of the smallest force, and the force.
fn smallest(
    motion: &Motion,
    force: impl Fn(f64) -> std::result::Result<f64, Error>,
) -> std::result::Result<(f64, f64), Error> {
    let mut best = (0.0, f64::INFINITY);
    for (from, to) in motion.stretches() {
        let turned = (motion.at(to).phi - motion.at(from).phi).abs() / TAU;
        let count = (PER_TURN * turned).ceil().clamp(FEWEST, MOST);
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
        let share = numerics::least(
            |share| force(at(share)),
            (place - 1.0) / count,
            (place + 1.0) / count,
        )?;
        let refined = at(share);
        for (t, value) in [(at(place / count), least), (refined, force(refined)?)] {
            if value < best.1 {
                best = (t, value);
            }
        }
    }
    Ok(best)
}
