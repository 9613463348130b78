//! The machine, integrated by Dormand and Prince's method of order 8(5,3) from tick to tick, and through standstill.

use jred::machine::{PoseError, Reducible};
use jred_file::number::numerics::dormand_prince::{Accuracy, IntegrationError, StatePoint};
use jred_file::number::numerics::zero;
use thiserror::Error;

use crate::closed_loop::{Course, LAG, Plant, TICK};

/// Why the machine stops.
#[derive(Debug, Error)]
pub(crate) enum PlantError {
    /// It cannot be placed.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// The integrator has stopped.
    #[error("the integrator has stopped: {0}; give gentler friction, or a longer tick")]
    Integrator(String),
}

impl From<IntegrationError<PoseError>> for PlantError {
    fn from(error: IntegrationError<PoseError>) -> Self {
        match error {
            IntegrationError::Function(error) => Self::Pose(error),
            other => Self::Integrator(format!("{other:?}")),
        }
    }
}

const ACCURACY: Accuracy = Accuracy {
    tolerance: 1e-11,
    most_steps: 10_000,
};

/// Most standstills within a tick.
const RESTS: u32 = 100;

/// A machine that is released starts this much later (s), so that the sign of its speed is beyond rounding.
const RELEASE: f64 = 1e-9;

/// A machine in motion under a motor.
pub(crate) struct Integrated<'m, M> {
    machine: &'m M,
    /// Positions where a load or a cam segment begins or ends: no step crosses one.
    edges: Vec<f64>,
    phi: f64,
    omega: f64,
}

impl<'m, M: Reducible> Integrated<'m, M> {
    /// At rest at a position (rad).
    pub(crate) fn new(machine: &'m M, phi: f64) -> Self {
        Self {
            machine,
            edges: (0..).map_while(|k| machine.edge(k)).collect(),
            phi,
            omega: 0.0,
        }
    }

    /// The steps from a time within the tick to another, or to the first one at whose end the machine has turned back.
    fn steps(
        &self,
        torque: Course,
        direction: f64,
        [start, end]: [f64; 2],
        from: [f64; 2],
    ) -> Result<Vec<StatePoint<2>>, PlantError> {
        let slope = |x: f64, [phi, omega]: &[f64; 2]| -> Result<[f64; 2], PoseError> {
            let here = self.machine.reduction(*phi)?;
            let push = torque.at(start + x) + here.load_torque()
                - here.viscous * omega
                - here.coulomb * direction
                - 0.5 * here.inertia_slope * omega * omega;
            Ok([*omega, push / here.inertia])
        };
        let bends = |_, [phi, _]: &[f64; 2]| -> Result<Vec<f64>, PoseError> {
            Ok(self.edges.iter().map(|edge| (phi - edge).sin()).collect())
        };
        let turned = |_, [_, omega]: &[f64; 2]| Ok(omega * direction < 0.0);
        Ok(ACCURACY.steps(slope, bends, from, end - start, turned)?)
    }

    /// Moves in a direction until the end of the tick or until the machine rests; returns the time reached.
    fn moves(&mut self, torque: Course, direction: f64, start: f64) -> Result<f64, PlantError> {
        let end = f64::from(TICK);
        let steps = self.steps(torque, direction, [start, end], [self.phi, self.omega])?;
        let [.., (before, from), (after, to)] = steps.as_slice() else {
            return Ok(end);
        };
        [self.phi, self.omega] = *to;
        if to[1] * direction >= 0.0 {
            return Ok(end);
        }
        // Where it rests within the last step.
        let at = |x: f64| -> Result<[f64; 2], PlantError> {
            if x == 0.0 {
                return Ok(*from);
            }
            let span = [start + before, start + before + x];
            let steps = self.steps(torque, direction, span, *from)?;
            Ok(steps.last().map_or(*from, |(_, state)| *state))
        };
        let length = after - before;
        // From rest the speed is zero at the start of the step as well.
        let early = if from[1] == 0.0 {
            RELEASE.min(0.5 * length)
        } else {
            0.0
        };
        let speeds = [at(early)?[1], to[1]];
        let (x, phi) = if speeds[0] * direction > 0.0 {
            let x = zero(
                |x| Ok::<_, PlantError>(at(x)?[1]),
                [early, length],
                speeds,
                1e-12,
            )?;
            (x, at(x)?[0])
        } else {
            (length, from[0])
        };
        [self.phi, self.omega] = [phi, 0.0];
        Ok(start + before + x)
    }

    /// The time within the tick at which the motor overcomes friction, and the direction; `None`: friction holds the machine to the end.
    fn release(&self, torque: Course, start: f64) -> Result<Option<(f64, f64)>, PoseError> {
        let here = self.machine.reduction(self.phi)?;
        let push = |time: f64| torque.at(time) + here.load_torque();
        // The torque is monotonic within a tick.
        for time in [start, f64::from(TICK)] {
            let direction = push(time).signum();
            if push(time).abs() <= here.coulomb {
                continue;
            }
            let enough = direction * here.coulomb - here.load_torque();
            let at = torque.reaches(enough).unwrap_or(start).max(start);
            let at = if time > start { at } else { start };
            return Ok(Some((at + RELEASE, direction)));
        }
        Ok(None)
    }
}

impl Course {
    /// The torque at a time within the tick.
    fn at(self, time: f64) -> f64 {
        self.to + (self.from - self.to) * (-time / LAG).exp()
    }

    /// The time at which it reaches a torque.
    fn reaches(self, torque: f64) -> Option<f64> {
        let time = LAG * ((self.from - self.to) / (torque - self.to)).ln();
        time.is_finite().then_some(time)
    }
}

impl<M: Reducible> Plant for Integrated<'_, M> {
    type Error = PlantError;

    fn phi(&self) -> f64 {
        self.phi
    }

    fn advance(&mut self, torque: Course) -> Result<(), PlantError> {
        let end = f64::from(TICK);
        let mut time = 0.0;
        for _ in 0..RESTS {
            let mut direction = self.omega.signum();
            if self.omega == 0.0 {
                match self.release(torque, time)? {
                    Some(start) => (time, direction) = start,
                    None => return Ok(()),
                }
            }
            if time >= end {
                return Ok(());
            }
            time = self.moves(torque, direction, time)?;
            if time >= end {
                return Ok(());
            }
        }
        Err(PlantError::Integrator(format!(
            "{RESTS} standstills within a tick"
        )))
    }
}
