//! Ends a simulation where a follower leaves its cam or a rope goes slack.

use std::borrow::Cow;

use jred::Domain;
use jred::error::Error;
use jred::machine::motion::{End, Polynomial};
use jred::machine::{Machine, Reducible as _};

use super::SimulationError;
use super::clock::Moment;
use super::coupled::{CoupledMachines, GearedMachine};
use crate::contact::OneWay;
use jred_file::model::mechanism::AnyMechanism;
use jred_file::number::numerics;

/// Evaluations of the forces over the drive link's range, between steps of the integrator.
const PER_RANGE: f64 = 720.0;

/// A state of the drive link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkState {
    /// The instant.
    pub(crate) moment: Moment,
    /// φ, ω, α.
    pub(crate) state: [f64; 3],
}

/// A joint that may separate, and its machine.
#[derive(Clone, Copy)]
struct WatchedJoint<'a> {
    machine: GearedMachine<'a>,
    joint: OneWay,
}

/// The joints of machines that may separate.
pub(crate) struct Watch<'a> {
    domain: Domain,
    joints: Vec<WatchedJoint<'a>>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(machines: &CoupledMachines<'a>) -> Self {
        let joints = machines.all().flat_map(|machine| {
            let joints = OneWay::all(machine.file.machine.mechanism());
            (joints.into_iter()).map(move |joint| WatchedJoint { machine, joint })
        });
        Self {
            domain: machines.first.machine.domain(),
            joints: joints.collect(),
        }
    }

    /// Whether there is nothing to watch.
    pub(crate) fn is_idle(&self) -> bool {
        self.joints.is_empty()
    }

    /// Refuses a state in which a joint separates.
    pub(crate) fn check(&self, at: LinkState) -> Result<(), SimulationError> {
        match self.first_open(at)? {
            Some((joint, force)) => Err(parted(joint, force, at)),
            None => Ok(()),
        }
    }

    /// Refuses the interval from one state to the next, with accelerations from `alpha`, if a joint separates.
    pub(crate) fn check_between(
        &self,
        [from, to]: [LinkState; 2],
        alpha: impl Fn(f64, [f64; 2]) -> Result<f64, SimulationError>,
    ) -> Result<(), SimulationError> {
        let span = match self.domain {
            Domain::Turn => std::f64::consts::TAU,
            stroke @ Domain::Stroke { .. } => stroke.span(),
        };
        let parts = (PER_RANGE * (to.state[0] - from.state[0]).abs() / span).ceil();
        let parts = parts.clamp(1.0, 1e6) as u32;
        let way = between([from, to]);
        let at = |share: f64| -> Result<LinkState, SimulationError> {
            let [phi, omega] = way(share);
            let t = from.moment.t + share * (to.moment.t - from.moment.t);
            let alpha = alpha(t, [phi, omega])?;
            Ok(LinkState {
                moment: Moment { t, ..from.moment },
                state: [phi, omega, alpha],
            })
        };
        let mut closed = 0.0;
        for k in 1..=parts {
            let share = f64::from(k) / f64::from(parts);
            let here = if k == parts { to } else { at(share)? };
            if self.first_open(here)?.is_none() {
                closed = share;
                continue;
            }
            // The first instant at which it separates.
            let holds =
                |share: f64| Ok::<_, SimulationError>(self.first_open(at(share)?)?.is_none());
            let first = at(numerics::edge(holds, closed, share)?)?;
            // By rounding contact may still be maintained there.
            self.check(first)?;
            self.check(here)?;
        }
        Ok(())
    }

    /// The first joint that separates, and its force.
    fn first_open(
        &self,
        at: LinkState,
    ) -> Result<Option<(WatchedJoint<'a>, f64)>, SimulationError> {
        for watched in &self.joints {
            let WatchedJoint { machine, joint } = watched;
            let state = machine.state(at.state);
            let force = joint.force(&*machine_at(machine, &at)?, state)?;
            if !joint.holds(force) {
                return Ok(Some((*watched, force)));
            }
        }
        Ok(None)
    }
}

/// A machine at an instant.
fn machine_at<'f>(
    machine: &GearedMachine<'f>,
    at: &LinkState,
) -> Result<Cow<'f, Machine<AnyMechanism>>, Error> {
    let [phi, omega, _] = machine.state(at.state);
    let now = at.moment.now(machine, omega);
    machine.file.machine_at(&now, phi)
}

fn parted(watched: WatchedJoint, force: f64, at: LinkState) -> SimulationError {
    let WatchedJoint { machine, joint } = watched;
    let [phi, omega, _] = machine.state(at.state);
    let parted =
        machine_at(&machine, &at).and_then(|machine| joint.parted(&machine, [phi, omega], force));
    match parted {
        Ok(parted) => SimulationError::Parted {
            t: at.moment.t,
            what: parted.what(),
            state: parted.state(),
            cure: parted.cure(),
        },
        Err(error) => error.into(),
    }
}

/// φ and ω between two states, at a share of the time: the polynomial of fifth degree through their positions, speeds and accelerations.
pub(super) fn between([from, to]: [LinkState; 2]) -> impl Fn(f64) -> [f64; 2] {
    let span = to.moment.t - from.moment.t;
    let ([p, v, a], [q, w, b]) = (from.state, to.state);
    let through =
        (span > 0.0).then(|| Polynomial::between(q - p, span, End::new(v, a), End::new(w, b)));
    move |share| {
        through.map_or([p, v], |through| {
            let [way, speed, ..] = through.at(share * span);
            [p + way, speed]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion of fifth degree is reproduced exactly.
    #[test]
    fn the_way_between_two_states() {
        let at = |t: f64| LinkState {
            moment: Moment::new(t, 1.0),
            state: [
                1.0 + 2.0 * t - 3.0 * t.powi(3) + t.powi(5),
                2.0 - 9.0 * t * t + 5.0 * t.powi(4),
                -18.0 * t + 20.0 * t.powi(3),
            ],
        };
        let ends = [at(0.2), at(0.9)];
        for share in [0.0, 0.3, 0.71, 1.0] {
            let [phi, omega] = between(ends)(share);
            let expected = at(0.2 + 0.7 * share).state;
            assert!((phi - expected[0]).abs() < 1e-14, "{phi}");
            assert!((omega - expected[1]).abs() < 1e-13, "{omega}");
        }
    }
}
