//! The integrator's steps.

use jred::error::Error;

use super::{Plant, Run};
use crate::simulate::error::stopped;
use crate::simulate::{IntegratorStop, SimulationError};
use jred_file::number::numerics::dormand_prince::StatePoint;

/// Most steps in total, besides some for each row: some ten seconds.
const MOST_IN_ALL: u64 = 1_000_000;

impl<P> Run<'_, P> {
    /// The integrator's steps from `t` to `end`, up to the one in which friction changes or an edge is passed.
    pub(super) fn integrate<const N: usize>(
        &self,
        t: f64,
        end: f64,
        y: &[f64; N],
    ) -> Result<Vec<StatePoint<N>>, SimulationError>
    where
        P: Plant<N>,
    {
        self.integrate_until(t, end, y, |t, y| {
            Ok(self.is_over(t, y)? || self.has_passed(self.plant.link(t, y)?.phi))
        })
    }

    pub(super) fn integrate_until<const N: usize>(
        &self,
        t: f64,
        end: f64,
        y: &[f64; N],
        enough: impl Fn(f64, &[f64; N]) -> Result<bool, Error>,
    ) -> Result<Vec<StatePoint<N>>, SimulationError>
    where
        P: Plant<N>,
    {
        if end <= t {
            return Ok(vec![(t, *y)]);
        }
        // Counted from here, short intervals keep all their digits.
        let steps = self.accuracy.steps(
            |x, y| self.plant.slope(&self.moment(t + x), y),
            |x, y| self.plant.bends(&self.moment(t + x), y),
            *y,
            end - t,
            |x, y| enough(t + x, y),
        );
        let mut steps = steps.map_err(|error| stopped(t, error))?;
        for (x, _) in &mut steps {
            *x += t;
        }
        self.steps.set(self.steps.get() + steps.len() as u64);
        if self.steps.get() > MOST_IN_ALL {
            return Err(SimulationError::Integrator {
                t,
                why: IntegratorStop::Steps,
            });
        }
        Ok(steps)
    }
}
