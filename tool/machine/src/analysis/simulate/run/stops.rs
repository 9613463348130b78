//! The ends of the drive link's way: stops that it bounces from or rests at, and the end of a stroke without any.

use jred::{Domain, Error, Reducible as _};

use super::{Plant, Run};
use crate::analysis::simulate::SimulationError;

/// A rebound from an end stop that is back within this time (s) is none.
const BRIEFEST_FLIGHT: f64 = 1e-6;

impl<P> Run<'_, P> {
    /// The end stop that a drive link in motion has passed.
    pub(super) fn stop_behind(&self, [phi, omega]: [f64; 2]) -> Option<f64> {
        let stops = self.stops?;
        if phi > stops.to && omega > 0.0 {
            Some(stops.to)
        } else if phi < stops.from && omega < 0.0 {
            Some(stops.from)
        } else {
            None
        }
    }

    /// Whether an end stop bars the way in a direction.
    pub(super) fn is_at_stop(&self, phi: f64, direction: f64) -> bool {
        self.stops.is_some_and(|stops| {
            if direction > 0.0 {
                phi >= stops.to
            } else {
                phi <= stops.from
            }
        })
    }

    /// The state after the drive link has hit an end stop at a position with a speed; the energy of the impact is lost. A rebound that
    /// would be back at once rests.
    pub(super) fn impact<const N: usize>(
        &mut self,
        t: f64,
        y: &[f64; N],
        [stop, omega]: [f64; 2],
    ) -> Result<[f64; N], SimulationError>
    where
        P: Plant<N>,
    {
        let restitution = self.stops.map_or(0.0, |stops| stops.restitution);
        let kinetic = |y: &[f64; N]| -> Result<f64, Error> {
            Ok(self.plant.row(self.direction, self.within(t), y)?.kinetic)
        };
        let away = -omega.signum();
        let mut after = self.plant.with_link(t, y, [stop, -restitution * omega])?;
        let back = self.plant.alpha(away, self.within(t), &after)? * away;
        let flight = 2.0 * restitution * omega.abs() / -back;
        let rests = restitution == 0.0 || (back < 0.0 && flight < BRIEFEST_FLIGHT);
        if rests {
            after = self.plant.with_link(t, y, [stop, 0.0])?;
        }
        after[N - 1] += kinetic(&self.plant.with_link(t, y, [stop, omega])?)? - kinetic(&after)?;
        if rests {
            self.rests([t, stop]);
            self.direction = self.start_direction(t, &after)?;
        } else {
            self.direction = away;
        }
        Ok(after)
    }

    /// Refuses to go on where the drive link has passed the end of its stroke: what stops it there is not in the file.
    pub(super) fn within_stroke<const N: usize>(
        &self,
        t: f64,
        y: &[f64; N],
    ) -> Result<(), SimulationError>
    where
        P: Plant<N>,
    {
        let Domain::Stroke { from, to } = self.file.machine.domain() else {
            return Ok(());
        };
        let [phi, omega] = self.plant.link(t, y)?;
        let slack = 1e-9 * (to - from);
        // Stops lie within the stroke, and a step that passes one is cut there.
        if self.stops.is_some() || (from - slack..=to + slack).contains(&phi) {
            return Ok(());
        }
        let coordinate = self.file.machine.mechanism().coordinate();
        Err(SimulationError::EndOfStroke {
            t,
            end: coordinate.place(if phi < from { from } else { to }),
            speed: format!(
                "{} {}",
                (omega * 1e6).round() / 1e6,
                coordinate.speed_unit()
            ),
        })
    }
}
