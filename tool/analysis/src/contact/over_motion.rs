//! One-sided contacts over a motion.

use std::cell::Cell;

use jred::error::Error;
use jred::machine::{Mechanism as _, Reducible as _};

use super::{OneWay, Separation};
use crate::duty::smooth_stretches;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::numerics;

/// Samples of the drive link's range (a turn or its stroke), and the least number for a stretch of the motion between edges.
const SAMPLES: f64 = 1440.0;
const FEWEST: f64 = 128.0;

/// The most samples of a stretch: a drive link may make a thousand turns.
const MOST: f64 = 60_000.0;

/// A contact that is lost in a motion.
#[derive(Clone, Debug)]
pub struct ContactLoss {
    /// The contact.
    pub joint: OneWay,
    /// Time of its least force (s).
    pub t: f64,
    /// Description of that instant.
    pub parted: Separation,
}

/// The first contact that a motion loses, at its least force.
///
/// # Errors
/// Errors of the machine.
pub fn lost(file: &MachineFile, motion: &Motion) -> Result<Option<ContactLoss>, Error> {
    for joint in OneWay::all(file.machine.mechanism()) {
        let (t, least) = least(file, motion, joint)?;
        if joint.holds(least) {
            continue;
        }
        let state = motion.at(t);
        let machine = file.machine_at(&ScheduleInstant::of(t, state.omega), state.phi)?;
        let parted = joint.parted(&machine, [state.phi, state.omega], least)?;
        return Ok(Some(ContactLoss { joint, t, parted }));
    }
    Ok(None)
}

/// The time of the smallest force, and the force.
fn least(file: &MachineFile, motion: &Motion, joint: OneWay) -> Result<(f64, f64), Error> {
    // In a dwell the state is the same at every sample.
    let last: Cell<Option<(usize, [f64; 3], f64)>> = Cell::new(None);
    let force = |t: f64| {
        let state = motion.at(t);
        let now = ScheduleInstant::of(t, state.omega);
        let number = file.schedule.number(&now);
        let state = [state.phi, state.omega, state.alpha];
        if let Some((same, known, force)) = last.get()
            && !file.schedule.flows()
            && same == number
            && known.map(f64::to_bits) == state.map(f64::to_bits)
        {
            return Ok(force);
        }
        let force = joint.force(&*file.machine_at(&now, state[0])?, state)?;
        last.set(Some((number, state, force)));
        Ok(force)
    };
    // The pull of a rope is as smooth as the motion, unless a load has edges or a table.
    let moved = file.machine.mechanism();
    let tables = moved.own_links() < moved.links().len();
    let smooth = joint.rope && !tables && !file.schedule.flows() && file.machine.edge(0).is_none();
    let samples = if smooth { 0.0 } else { SAMPLES };
    smallest(file, motion, samples, force)
}

/// The time of the smallest force, and the force; searched at `count` places of the drive link's range.
fn smallest(
    file: &MachineFile,
    motion: &Motion,
    samples: f64,
    force: impl Fn(f64) -> Result<f64, Error>,
) -> Result<(f64, f64), Error> {
    let mut best = (0.0, f64::INFINITY);
    let span = file.machine.domain().span();
    for (from, to) in smooth_stretches(file, motion) {
        let share = (motion.at(to).phi - motion.at(from).phi).abs() / span;
        let count = (samples * share).ceil().clamp(FEWEST, MOST);
        // The acceleration may jump between stretches, so the ends are moved inside.
        let inset = 1e-9 * (to - from);
        let last = (to - inset).min(to.next_down()).max(from);
        let at = |share: f64| (from + share * (to - from)).max(from + inset).min(last);
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
