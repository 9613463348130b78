//! Lower bounds of a torque limit over speed for the peak search: for a constant limit, a straight one, and any other.

use crate::motor::envelope::Envelope;

/// A lower bound of the torque limit.
pub(super) trait Floor: Copy {
    /// A chord that is not above the limit at any speed of the cycle, for any direction of power: its torque at rest, and its slope by the magnitude
    /// of the speed at the gearbox output.
    fn line(&self) -> [f64; 2];
    /// Its least value at all speeds of the cycle, in both directions of power.
    fn least(&self) -> f64;
    /// End values of a chord that is not above the limit between the two speeds of the motor.
    fn chord(&self, driving: bool, speeds: [f64; 2]) -> [f64; 2];
    /// The limit in the direction of a torque at a speed of the motor.
    fn limit(&self, torque: f64, speed: f64) -> f64;
}

/// The same limit at every speed of the cycle.
#[derive(Clone, Copy)]
pub(super) struct ConstantLimit(pub(super) f64);

impl Floor for ConstantLimit {
    fn line(&self) -> [f64; 2] {
        [self.0, 0.0]
    }

    fn least(&self) -> f64 {
        self.0
    }

    fn chord(&self, _driving: bool, _speeds: [f64; 2]) -> [f64; 2] {
        [self.0; 2]
    }

    fn limit(&self, _torque: f64, _speed: f64) -> f64 {
        self.0
    }
}

/// A straight line over speed while the motor drives, and another while it brakes: the limit by a voltage.
#[derive(Clone, Copy)]
pub(super) struct LinearLimit {
    /// Torque at rest and slope, driving and braking.
    pub(super) lines: [[f64; 2]; 2],
    pub(super) line: [f64; 2],
    pub(super) least: f64,
}

impl Floor for LinearLimit {
    fn line(&self) -> [f64; 2] {
        self.line
    }

    fn least(&self) -> f64 {
        self.least
    }

    fn chord(&self, driving: bool, speeds: [f64; 2]) -> [f64; 2] {
        let [start, slope] = self.lines[usize::from(!driving)];
        speeds.map(|speed| start + slope * speed)
    }

    fn limit(&self, torque: f64, speed: f64) -> f64 {
        let [start, slope] = self.lines[usize::from(torque * speed < 0.0)];
        start + slope * speed.abs()
    }
}

/// A limit that falls with speed.
#[derive(Clone, Copy)]
pub(super) struct FallingLimit<'e> {
    pub(super) envelope: &'e Envelope,
    pub(super) line: [f64; 2],
    pub(super) least: f64,
}

impl Floor for FallingLimit<'_> {
    fn line(&self) -> [f64; 2] {
        self.line
    }

    fn least(&self) -> f64 {
        self.least
    }

    fn chord(&self, driving: bool, speeds: [f64; 2]) -> [f64; 2] {
        self.envelope.floor(driving, speeds)
    }

    fn limit(&self, torque: f64, speed: f64) -> f64 {
        self.envelope.peak_torque(torque, speed)
    }
}
