//! The ends of the drive link's travel: end stops from which it rebounds or at which it rests, and the end of a stroke without a stop.

use super::{Plant, Run};
use crate::simulate::clock::Moment;
use crate::simulate::drive_state::{DriveState, Passage};
use crate::simulate::{BRIEFEST_FLIGHT, Impacts, SimulationError};

impl<P> Run<'_, P> {
    /// The end of travel that a moving drive link has passed: an end stop, or the end of the stroke.
    pub(super) fn stop_behind(&self, DriveState { phi, omega }: DriveState) -> Option<f64> {
        let [from, to] = self.ends?;
        if phi > to && omega > 0.0 {
            Some(to)
        } else if phi < from && omega < 0.0 {
            Some(from)
        } else {
            None
        }
    }

    /// Whether an end stop blocks a direction.
    pub(super) fn is_at_stop(&self, phi: f64, direction: f64) -> bool {
        self.stops.is_some_and(|stops| {
            if direction > 0.0 {
                phi >= stops.to
            } else {
                phi <= stops.from
            }
        })
    }

    /// The state after the drive link has hit an end stop with the state `hit`; the energy of the impact is lost. A rebound that would return
    /// immediately ends at rest. At the end of a stroke without a stop the behaviour is undefined: an error.
    pub(super) fn impact<const N: usize>(
        &mut self,
        t: f64,
        y: &[f64; N],
        hit: DriveState,
    ) -> Result<[f64; N], SimulationError>
    where
        P: Plant<N>,
    {
        let DriveState { phi, omega } = hit;
        let Some(stops) = self.stops else {
            return Err(SimulationError::EndOfStroke {
                t,
                axis: self.file.axis(),
                end: phi,
                speed: omega.abs(),
            });
        };
        let restitution = stops.restitution;
        let impact = self.impacts.get_or_insert(Impacts {
            time: t,
            position: phi,
            speed: omega.abs(),
            count: 0,
            settled: false,
        });
        impact.count += 1;
        let row = |y: &[f64; N]| self.plant.row(&self.moment(t), y);
        let at_stop = |omega: f64| DriveState { phi, omega };
        let away = -omega.signum();
        let mut after = self.plant.with_link(t, y, at_stop(-restitution * omega))?;
        let back = (self.plant).alpha(&Moment::new(self.within(t), away), &after)? * away;
        let flight = 2.0 * restitution * omega.abs() / -back;
        let rests = restitution == 0.0 || (back < 0.0 && flight < BRIEFEST_FLIGHT);
        if rests {
            after = self.plant.with_link(t, y, at_stop(0.0))?;
        }
        let [hit, left] = [row(&self.plant.with_link(t, y, hit)?)?, row(&after)?];
        after[N - 1] += hit.kinetic - left.kinetic;
        if let Some(at) = self.plant.guests() {
            // The impulse with which its axis keeps the carriage's speed along its guide.
            after[at + 1] += left.beyond - hit.beyond;
        }
        if rests {
            if let Some(impacts) = &mut self.impacts {
                impacts.settled |= restitution != 0.0;
            }
            self.direction = self.start_direction(t, &after)?;
            self.stands(Passage { t, phi });
        } else {
            self.direction = away;
        }
        Ok(after)
    }
}
