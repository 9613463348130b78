//! Ends a simulation where a follower leaves its cam or a rope goes slack.

use std::borrow::Cow;

use jred::Domain;
use jred::error::Error;
use jred::machine::motion::{End, Polynomial};
use jred::machine::{Machine, Reducible as _};

use super::SimulationError;
use super::clock::Moment;
use super::coupled::{CoupledMachines, GearedMachine};
use super::drive_state::DriveState;
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
        alpha: impl Fn(f64, DriveState) -> Result<f64, SimulationError>,
    ) -> Result<(), SimulationError> {
        let span = match self.domain {
            Domain::Turn => std::f64::consts::TAU,
            stroke @ Domain::Stroke { .. } => stroke.span(),
        };
        let parts = (PER_RANGE * (to.state[0] - from.state[0]).abs() / span).ceil();
        let parts = parts.clamp(1.0, 1e6) as u32;
        let way = between([from, to]);
        let at = |share: f64| -> Result<LinkState, SimulationError> {
            let link = way(share);
            let t = from.moment.t + share * (to.moment.t - from.moment.t);
            let alpha = alpha(t, link)?;
            Ok(LinkState {
                moment: Moment { t, ..from.moment },
                state: [link.phi, link.omega, alpha],
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
    let separation =
        machine_at(&machine, &at).and_then(|machine| joint.parted(&machine, [phi, omega], force));
    match separation {
        Ok(separation) => SimulationError::Parted {
            t: at.moment.t,
            separation,
        },
        Err(error) => error.into(),
    }
}

/// φ and ω between two states, at a share of the time: the polynomial of fifth degree through their positions, speeds and accelerations. Over a very
/// short time the difference of the positions is the integrator's error, which would be a large speed: there the way follows from the speeds and
/// accelerations.
pub(super) fn between([from, to]: [LinkState; 2]) -> impl Fn(f64) -> DriveState {
    let span = to.moment.t - from.moment.t;
    let ([p, v, a], [q, w, b]) = (from.state, to.state);
    // Hermite's polynomial of third degree for the speed, integrated.
    let travel = span * (0.5 * (v + w) + span * (a - b) / 12.0);
    // The deviation of the positions from it, as the speed in the middle that it would make, against the change of the speed.
    let strange = 15.0 / 8.0 * (q - p - travel).abs();
    let is_noise = strange > span * ((w - v).abs() + span * (a.abs() + b.abs()));
    let way = if is_noise { travel } else { q - p };
    let through =
        (span > 0.0).then(|| Polynomial::between(way, span, End::new(v, a), End::new(w, b)));
    move |share| {
        let [way, omega] = through.map_or([0.0, v], |through| {
            let [way, speed, ..] = through.at(share * span);
            [way, speed]
        });
        DriveState {
            phi: p + way,
            omega,
        }
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
            let DriveState { phi, omega } = between(ends)(share);
            let expected = at(0.2 + 0.7 * share).state;
            assert!((phi - expected[0]).abs() < 1e-14, "{phi}");
            assert!((omega - expected[1]).abs() < 1e-13, "{omega}");
        }
    }

    /// Two steps whose positions differ by the integrator's error only: the speed between them is theirs.
    #[test]
    fn a_very_short_step_makes_no_speed() {
        let at = |t: f64, phi: f64| LinkState {
            moment: Moment::new(t, 1.0),
            state: [phi, 28.0, -3.0],
        };
        for span in [1e-15, 1e-13, 1e-10] {
            for slip in [-1.0, 0.0, 2.0] {
                let end = 50.0 + 28.0 * span + slip * 1e-10;
                let DriveState { phi, omega } = between([at(0.0, 50.0), at(span, end)])(0.5);
                assert!((omega - 28.0).abs() < 1e-6, "{omega}");
                assert!((phi - 50.0).abs() < 1e-8, "{phi}");
            }
        }
    }
}
