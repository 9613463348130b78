//! The current smooth stretch of time: times at its ends, where quantities jump, are moved inside.

use jred::error::Error;

use super::{Plant, Run};
use crate::simulate::clock::Moment;

impl<P> Run<'_, P> {
    /// Continues in another smooth stretch, between these times, and books the energy of payloads that come or go.
    pub(super) fn enter<const N: usize>(
        &mut self,
        inside: [f64; 2],
        t: f64,
        mut y: [f64; N],
    ) -> Result<[f64; N], Error>
    where
        P: Plant<N>,
    {
        let before = self.moment(t);
        self.inside = inside;
        let after = self.moment(t);
        let comes = self.has_payloads && before.t < after.t;
        if let Some(at) = self.plant.guests().filter(|_| comes) {
            let energy = |moment: &Moment| -> Result<f64, Error> {
                let row = self.plant.row(moment, &y)?;
                Ok(row.kinetic + row.beyond + row.potential)
            };
            let brought = energy(&after)? - energy(&before)?;
            y[at] += brought;
        }
        Ok(y)
    }

    /// The instant of a time, moved inside the current smooth stretch.
    pub(super) fn moment(&self, t: f64) -> Moment {
        Moment::new(self.within(t), self.direction)
    }

    /// A time, moved inside the current smooth stretch.
    pub(super) fn within(&self, t: f64) -> f64 {
        let [from, to] = self.inside;
        t.max(from).min(to)
    }
}
