//! Torque-speed limits of a motor, from what its data sheet says.
//!
//! Where the sheet gives no figure, a stated assumption stands in ([`Envelope::assumptions`]):
//! - no maximum speed: the rated speed;
//! - no corner speed: the peak torque is available up to the rated speed;
//! - no peak torque at maximum speed: it falls along a straight line to the rated torque there;
//! - no standstill torque: the rated torque;
//! - the S1 torque falls in a straight line from standstill to rated speed, and above that with constant power.

use crate::catalogue::Motor;

/// Peak and continuous torque over speed, the same in all four quadrants.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    peak: f64,
    corner_speed: f64,
    torque_at_max_speed: f64,
    max_speed: f64,
    standstill: f64,
    rated_torque: f64,
    rated_speed: f64,
    assumptions: Vec<&'static str>,
}

impl Envelope {
    /// The envelope of a motor.
    pub fn of(motor: &Motor) -> Self {
        let mut assumptions = Vec::new();
        let mut known = |figure: Option<f64>, instead: f64, words: &'static str| {
            figure.unwrap_or_else(|| {
                assumptions.push(words);
                instead
            })
        };
        let max_speed = known(
            motor.max_speed,
            motor.rated_speed,
            "maximum speed not stated: the rated speed is taken",
        );
        let corner_speed = known(
            motor.corner_speed,
            motor.rated_speed.min(max_speed),
            "corner of the peak torque not stated: peak torque up to rated speed",
        )
        .min(max_speed);
        let torque_at_max_speed = if max_speed > corner_speed {
            known(
                motor.torque_at_max_speed,
                motor.rated_torque,
                "peak torque at maximum speed not stated: straight line to the rated torque",
            )
        } else {
            motor.peak_torque
        };
        let standstill = known(
            motor.standstill_torque,
            motor.rated_torque,
            "standstill torque not stated: the rated torque is taken",
        );
        Self {
            peak: motor.peak_torque,
            corner_speed,
            torque_at_max_speed,
            max_speed,
            standstill,
            rated_torque: motor.rated_torque,
            rated_speed: motor.rated_speed,
            assumptions,
        }
    }

    /// Largest speed (rad/s).
    pub const fn max_speed(&self) -> f64 {
        self.max_speed
    }

    /// S1 torque at standstill (N·m).
    pub const fn standstill(&self) -> f64 {
        self.standstill
    }

    /// What was assumed because the data sheet does not say.
    pub fn assumptions(&self) -> &[&'static str] {
        &self.assumptions
    }

    /// Largest short-time torque at `speed` (rad/s); zero beyond the maximum speed.
    pub fn peak_torque(&self, speed: f64) -> f64 {
        let speed = speed.abs();
        if speed <= self.corner_speed {
            self.peak
        } else if speed <= self.max_speed {
            let part = (speed - self.corner_speed) / (self.max_speed - self.corner_speed);
            self.peak + part * (self.torque_at_max_speed - self.peak)
        } else {
            0.0
        }
    }

    /// Continuous (S1) torque at `speed` (rad/s); zero beyond the maximum speed.
    pub fn continuous_torque(&self, speed: f64) -> f64 {
        let speed = speed.abs();
        if speed <= self.rated_speed {
            self.standstill + (self.rated_torque - self.standstill) * speed / self.rated_speed
        } else if speed <= self.max_speed {
            self.rated_torque * self.rated_speed / speed
        } else {
            0.0
        }
    }
}
