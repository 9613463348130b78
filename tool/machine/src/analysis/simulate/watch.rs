//! Ends a simulation where a follower leaves its cam or a rope goes slack.

use jred::machine::motion::{End, Polynomial};
use jred::{Domain, Reducible as _};

use super::SimulationError;
use super::geared::{Geared, Together};
use crate::analysis::contact::OneWay;
use crate::number::numerics;

/// Between the integrator's steps the forces are looked at this many times over the drive link's range.
const PER_RANGE: f64 = 720.0;

/// A state of the drive link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At {
    /// Time (s).
    pub(crate) t: f64,
    /// φ, ω, α.
    pub(crate) state: [f64; 3],
}

/// A joint that can let go, and its machine.
#[derive(Clone, Copy)]
struct Watched<'a> {
    machine: Geared<'a>,
    joint: OneWay,
}

/// The joints of machines that can let go.
pub(crate) struct Watch<'a> {
    domain: Domain,
    joints: Vec<Watched<'a>>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(machines: &Together<'a>) -> Self {
        let joints = machines.all().flat_map(|machine| {
            let joints = OneWay::all(machine.file.machine.mechanism());
            (joints.into_iter()).map(move |joint| Watched { machine, joint })
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

    /// Refuses a state in which a joint lets go.
    pub(crate) fn check(&self, at: At) -> Result<(), SimulationError> {
        match self.first_open(at)? {
            Some((joint, force)) => Err(parted(joint, force, at)),
            None => Ok(()),
        }
    }

    /// Refuses the way from one state to the next, which `alpha` gives the accelerations of, where a joint lets go.
    pub(crate) fn check_between(
        &self,
        [from, to]: [At; 2],
        alpha: impl Fn(f64, [f64; 2]) -> Result<f64, SimulationError>,
    ) -> Result<(), SimulationError> {
        let span = match self.domain {
            Domain::Turn => std::f64::consts::TAU,
            stroke @ Domain::Stroke { .. } => stroke.span(),
        };
        let parts = (PER_RANGE * (to.state[0] - from.state[0]).abs() / span).ceil();
        let parts = parts.clamp(1.0, 1e6) as u32;
        let way = between([from, to]);
        let at = |share: f64| -> Result<At, SimulationError> {
            let [phi, omega] = way(share);
            let t = from.t + share * (to.t - from.t);
            let alpha = alpha(t, [phi, omega])?;
            Ok(At {
                t,
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
            // The first instant at which it lets go.
            let holds =
                |share: f64| Ok::<_, SimulationError>(self.first_open(at(share)?)?.is_none());
            let first = at(numerics::edge(holds, closed, share)?)?;
            // By a rounding it may still hold there.
            self.check(first)?;
            self.check(here)?;
        }
        Ok(())
    }

    /// The first joint that lets go, and its force.
    fn first_open(&self, at: At) -> Result<Option<(Watched<'a>, f64)>, SimulationError> {
        for watched in &self.joints {
            let Watched { machine, joint } = watched;
            let force = joint.force(&machine.file.machine, machine.state(at.state))?;
            if !joint.holds(force) {
                return Ok(Some((*watched, force)));
            }
        }
        Ok(None)
    }
}

fn parted(watched: Watched, force: f64, At { t, state }: At) -> SimulationError {
    let Watched { machine, joint } = watched;
    let [phi, omega, _] = machine.state(state);
    match joint.parted(&machine.file.machine, [phi, omega], force) {
        Ok(parted) => SimulationError::Parted {
            t,
            what: parted.what,
            state: parted.state,
            cure: parted.cure,
        },
        Err(error) => error.into(),
    }
}

/// φ and ω between two states, at a share of the time: the polynomial of the fifth degree with their positions, speeds and accelerations.
pub(super) fn between([from, to]: [At; 2]) -> impl Fn(f64) -> [f64; 2] {
    let span = to.t - from.t;
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

    /// A motion of the fifth degree is met exactly.
    #[test]
    fn the_way_between_two_states() {
        let at = |t: f64| At {
            t,
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
