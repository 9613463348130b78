//! A table and the values computed from its machine units, exchanged together.

use jred::axis::{AxisError, FrictionRamp, ImageSlot, Period, TorqueLimits, Transmission};
use jred::{FirmwareError, Phase};

use crate::board::RATE;
use crate::machine::{
    CURVES, FRICTION_RAMP, GEARBOX, LEAD, Layout, MACHINE, MOST_TORQUE, MotorTorque, Number, WORDS,
};

/// Memory for a table. There are two: the tick owns the one that it reads, the background the other.
pub struct Table {
    pub slot: ImageSlot<'static, Layout, CURVES>,
    pub units: Option<Units>,
}

/// The figures of the drive in the machine units of a table.
#[derive(Clone, Copy)]
pub struct Units {
    pub tick: Period<Number>,
    /// The largest step of the crank per tick, at the greatest speed of the table's validity.
    pub step: Phase,
    pub lead: Period<Number>,
    pub ramp: FrictionRamp<Number>,
    pub gearbox: Transmission<Number>,
    pub limits: TorqueLimits<MotorTorque>,
}

impl Table {
    pub const fn new(memory: &'static mut [u32; WORDS]) -> Self {
        Self {
            slot: ImageSlot::new(memory).for_machine(MACHINE),
            units: None,
        }
    }

    pub fn clear(&mut self) {
        self.slot.clear();
        self.units = None;
    }

    /// Checks `words` more words; returns the verdict at the end.
    pub fn check(&mut self, words: usize) -> Option<Result<(), FirmwareError>> {
        let verdict = self.slot.check(words)?.map_err(FirmwareError::from);
        Some(verdict.and_then(|()| Ok(self.convert()?)))
    }

    fn convert(&mut self) -> Result<(), AxisError> {
        let Some(feed_forward) = self.slot.feed_forward() else {
            return Ok(());
        };
        let press = feed_forward.model();
        let tick = Period::new(1.0 / RATE as f32, press)?;
        let gearbox = Transmission::new(GEARBOX, press)?;
        let [least, most] =
            [-MOST_TORQUE, MOST_TORQUE].map(|torque| gearbox.to_torque(torque).value);
        self.units = Some(Units {
            tick,
            step: tick.moved(feed_forward.range().max_speed()),
            lead: Period::new(LEAD, press)?,
            ramp: FrictionRamp::new(FRICTION_RAMP, press)?,
            gearbox,
            limits: TorqueLimits::new(least, most)?,
        });
        Ok(())
    }
}
