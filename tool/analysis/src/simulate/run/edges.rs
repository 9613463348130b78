//! Positions at which a force or the mechanism is not smooth: no step of the integrator crosses one.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::Reducible as _;

use super::{Plant, Run};
use crate::simulate::SimulationError;
use crate::simulate::coupled::{CoupledMachines, GearedMachine};
use crate::simulate::drive_state::DriveState;
use jred_file::number::numerics;
use jred_file::number::numerics::dormand_prince::StatePoint;

/// Relative distance at which an edge is still ahead, or behind after it was passed: some rounding errors.
const EDGE_ROUNDING: f64 = 4e-15;

/// The edges of each machine.
pub(super) struct Edges<'a>(Vec<Machine<'a>>);

struct Machine<'a> {
    geared: GearedMachine<'a>,
    /// Positions of its own drive link, sorted; for a turning one within a turn.
    places: Vec<f64>,
    turns: bool,
}

impl<'a> Edges<'a> {
    pub(super) fn of(machines: &CoupledMachines<'a>) -> Self {
        let all = machines.all().map(|geared| {
            let file = geared.file;
            let turns = file.machine.domain() == Domain::Turn;
            // The scheduled machines have other loads, and so other edges.
            let machines = std::iter::once(&file.machine).chain(file.schedule.machines());
            let edges = machines.flat_map(|machine| (0..).map_while(|k| machine.edge(k)));
            let edges = edges.map(|edge| if turns { edge.rem_euclid(TAU) } else { edge });
            let mut places: Vec<f64> = edges.collect();
            places.sort_by(f64::total_cmp);
            places.dedup_by(|b, a| *b - *a <= EDGE_ROUNDING * (1.0 + a.abs()));
            Machine {
                geared,
                places,
                turns,
            }
        });
        Self(all.filter(|machine| !machine.places.is_empty()).collect())
    }

    /// The first edge ahead of a position of the first drive link in a direction; infinite if no edge is ahead.
    pub(super) fn ahead(&self, phi: f64, direction: f64) -> f64 {
        let nearest = self.0.iter().map(|machine| {
            let [own, ..] = machine.geared.state([phi, 0.0, 0.0]);
            let sense = direction * machine.geared.ratio().signum();
            let next = machine.ahead(own, sense);
            ((next - own) / machine.geared.ratio()).abs()
        });
        phi + direction * nearest.fold(f64::INFINITY, f64::min)
    }
}

impl Machine<'_> {
    fn ahead(&self, own: f64, sense: f64) -> f64 {
        let rounding = EDGE_ROUNDING * (1.0 + own.abs());
        let turn = if self.turns { (own / TAU).floor() } else { 0.0 };
        let rounds: &[f64] = if self.turns {
            &[-1.0, 0.0, 1.0]
        } else {
            &[0.0]
        };
        let all = rounds.iter().flat_map(|round| {
            let start = (turn + round) * TAU;
            self.places.iter().map(move |place| start + place)
        });
        let ahead = all.filter(|edge| (edge - own) * sense > rounding);
        ahead.fold(sense * f64::INFINITY, |nearest, edge| {
            if (edge - nearest) * sense < 0.0 {
                edge
            } else {
                nearest
            }
        })
    }
}

impl<P> Run<'_, P> {
    /// Whether the drive link has passed the edge ahead.
    pub(super) fn has_passed(&self, phi: f64) -> bool {
        (phi - self.edge) * self.direction >= 0.0
    }

    /// The state just behind the edge, which lies in the integrator's step between these two.
    pub(super) fn on_edge<const N: usize>(
        &self,
        start: StatePoint<N>,
        last: StatePoint<N>,
    ) -> Result<StatePoint<N>, SimulationError>
    where
        P: Plant<N>,
    {
        let (edge, direction) = (self.edge, self.direction);
        let (t, y) = self.on_place(edge, start, last)?;
        let omega = self.plant.link(t, &y)?.omega;
        let phi = edge + direction * EDGE_ROUNDING * (1.0 + edge.abs());
        let behind = DriveState { phi, omega };
        Ok((t, self.plant.with_link(t, &y, behind)?))
    }

    /// The state at a position within the integrator's step between these two.
    pub(super) fn on_place<const N: usize>(
        &self,
        place: f64,
        start: StatePoint<N>,
        last: StatePoint<N>,
    ) -> Result<StatePoint<N>, SimulationError>
    where
        P: Plant<N>,
    {
        let direction = self.direction;
        let at = |x: f64| -> Result<StatePoint<N>, SimulationError> {
            let steps = self.integrate_until(start.0, start.0 + x, &start.1, |_, _| Ok(false))?;
            Ok(steps.last().copied().unwrap_or(start))
        };
        let beyond = |(t, y): &StatePoint<N>| -> Result<f64, SimulationError> {
            Ok((self.plant.link(*t, y)?.phi - place) * direction)
        };
        let ends = [beyond(&start)?, beyond(&last)?];
        let length = last.0 - start.0;
        let x = numerics::zero(|x| beyond(&at(x)?), [0.0, length], ends, 1e-15)?;
        at(x)
    }
}
