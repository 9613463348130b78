//! Passes the motor's state to the observers.

use super::{Plant, Run};
use crate::simulate::SimulationError;
use crate::simulate::clock::Moment;
use crate::simulate::drive_state::Passage;
use crate::simulate::observe::{MotorPoint, MotorState, PARTS};
use crate::simulate::watch::between;
use jred_file::number::numerics;
use jred_file::number::numerics::dormand_prince::StatePoint;

impl<P> Run<'_, P> {
    /// Passes the motor's state to the observers, from one step to the next.
    pub(super) fn observe<const N: usize>(
        &mut self,
        from: &StatePoint<N>,
        to: &StatePoint<N>,
    ) -> Result<(), SimulationError>
    where
        P: Plant<N>,
    {
        let plant = self.plant;
        let (direction, length) = (self.direction, to.0 - from.0);
        let Some(first) = plant.working(&self.moment(from.0), &from.1)? else {
            return Ok(());
        };
        let ends = [self.at(from.0, &from.1)?, self.at(to.0, &to.1)?];
        let (inside, way) = (self.inside, between(ends));
        let at = |share: f64| -> Result<MotorState, SimulationError> {
            let t = (from.0 + share * length).max(inside[0]).min(inside[1]);
            let y = std::array::from_fn(|i| from.1[i] + share * (to.1[i] - from.1[i]));
            let y = plant.with_link(t, &y, way(share))?;
            let working = plant.working(&Moment::new(t, direction), &y)?;
            Ok(working.unwrap_or(first))
        };
        let part = |k: u32| f64::from(k) / f64::from(PARTS);
        let mut seen = [first; PARTS as usize + 1];
        for k in 1..=PARTS {
            seen[k as usize] = at(part(k))?;
        }
        if self.halt.is_none() {
            self.giving.pass([from.0, to.0], &seen);
        }
        if let Some(speed) = self.speed_to_reach() {
            let reaches = |omega: f64| omega.abs() >= speed;
            let [_, omega, _] = ends[1].state;
            if reaches(omega) {
                let slow = |share: f64| Ok::<_, SimulationError>(!reaches(way(share).omega));
                let share = if slow(0.0)? {
                    numerics::edge(slow, 0.0, 1.0)?
                } else {
                    0.0
                };
                let t = from.0 + share * length;
                let phi = way(share).phi;
                self.reached = Some(Passage { t, phi });
            }
        }
        for k in 1..=PARTS {
            let shares = [part(k - 1), part(k)];
            let [before, after] = [k - 1, k].map(|k| MotorPoint {
                t: from.0 + part(k) * length,
                motor: seen[k as usize],
            });
            self.controlling.pass(before, after, |share| {
                at(shares[0] + share * (shares[1] - shares[0]))
            })?;
            self.observer.pass(before, after);
        }
        Ok(())
    }

    /// The speed to report when it is reached, until then.
    fn speed_to_reach(&self) -> Option<f64> {
        self.to_speed.filter(|_| self.reached.is_none())
    }
}
