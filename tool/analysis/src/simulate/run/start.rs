//! Start from rest: the direction of the drive link, and the missing torque if it does not start.

use jred::error::Error;

use super::{Plant, Run, SIGN_SPEED};
use crate::simulate::clock::Moment;
use crate::simulate::drive_state::DriveState;
use crate::simulate::result::Stall;

impl<P> Run<'_, P> {
    /// The direction of motion at the start; at rest, the direction in which it will start.
    pub(super) fn heading<const N: usize>(&self, y: &[f64; N]) -> Result<f64, Error>
    where
        P: Plant<N>,
    {
        let omega = self.plant.link(0.0, y)?.omega;
        if omega == 0.0 {
            self.start_direction(0.0, y)
        } else {
            Ok(omega.signum())
        }
    }

    /// The direction in which the drive link starts from rest: +1, −1, or 0 if friction holds it.
    pub(super) fn start_direction<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<f64, Error>
    where
        P: Plant<N>,
    {
        let phi = self.plant.link(t, y)?.phi;
        let t = self.within(t);
        for direction in [1.0, -1.0] {
            if self.is_at_stop(phi, direction) {
                continue;
            }
            let omega = direction * SIGN_SPEED;
            let moved = self.plant.with_link(t, y, DriveState { phi, omega })?;
            if self.plant.starts(&Moment::new(t, direction), &moved)? {
                return Ok(direction);
            }
        }
        Ok(0.0)
    }

    /// Sets the direction in which the drive link will start from rest; a link that starts is not held to the end.
    pub(super) fn leave_rest<const N: usize>(&mut self, t: f64, y: &[f64; N]) -> Result<(), Error>
    where
        P: Plant<N>,
    {
        self.direction = self.start_direction(t, y)?;
        if self.direction != 0.0 {
            self.held = None;
            self.rest = None;
        }
        Ok(())
    }

    /// The drive link is at rest: checks whether the motor drives it on.
    pub(super) fn misses<const N: usize>(&mut self, time: f64, y: &[f64; N]) -> Result<(), Error>
    where
        P: Plant<N>,
    {
        if self.stuck.is_none() {
            let missing = self.plant.missing(self.within(time), y)?;
            self.stuck = missing.map(|missing| Stall { time, missing });
        }
        Ok(())
    }
}
