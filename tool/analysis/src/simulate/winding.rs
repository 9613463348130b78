//! The winding of a DC motor at a constant voltage: its current follows the voltage with the time constant L/R.
//!
//! ```text
//! L·di/dt = U − R·i − k·ω        T = k·i
//! ```

use jred::error::Error;

use super::commander::{Command, Commander};
use super::machine::Plant;
use jred_file::model::motor::Motor;
use jred_file::model::simulation::Winding;
use jred_file::number::columns::{Column, ColumnQuantity};

impl<M: Motor> Commander<M> for Winding {
    fn command(
        &self,
        plant: &Plant<M>,
        _: f64,
        [_, omega, current]: [f64; 3],
    ) -> Result<Command, Error> {
        let torque = self.constant * current;
        let back = self.constant * omega * plant.ratio();
        Ok(Command {
            torque,
            asked: torque,
            rate: (self.voltage - self.resistance * current - back) / self.inductance,
        })
    }

    fn column(&self) -> Column {
        Column::new(ColumnQuantity::Current, "current", "A")
    }

    /// The circuit of a switched-off motor is open.
    fn figure(&self, _: &Plant<M>, _: f64, [.., current]: [f64; 3], on: bool) -> f64 {
        if on { current } else { 0.0 }
    }

    fn settles(&self) -> bool {
        true
    }
}
