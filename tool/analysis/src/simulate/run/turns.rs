//! Works in whole turns of the drive link: a turning machine is then in the same position, so the works can be compared.

use std::f64::consts::TAU;

use super::{Plant, Run};
use crate::simulate::SimulationError;
use crate::simulate::result::TurnWorks;
use jred_file::number::numerics::dormand_prince::StatePoint;

impl<P> Run<'_, P> {
    /// Counts the whole turns that end in the integrator's step between these two.
    pub(super) fn count_turns<const N: usize>(
        &mut self,
        from: &StatePoint<N>,
        to: &StatePoint<N>,
    ) -> Result<(), SimulationError>
    where
        P: Plant<N>,
    {
        let Some(begin) = self.begin else {
            return Ok(());
        };
        let phi = self.plant.link(to.0, &to.1)?.phi;
        let turns = ((phi - begin) / TAU).trunc();
        if turns.abs() <= self.turned.map_or(0.0, |turned| turned.turns.abs()) {
            return Ok(());
        }
        let (t, y) = self.on_place(begin + turns * TAU, *from, *to)?;
        let row = self.plant.row(&self.moment(t), &y)?;
        let [motor, process, losses] = std::array::from_fn(|i| y[N - 3 + i]);
        self.turned = Some(TurnWorks {
            turns,
            motor,
            process,
            losses,
            kinetic: row.kinetic,
        });
        Ok(())
    }
}
