//! S1 torque over speed by the thermal limit.

use crate::catalogue::Motor;

/// S1 torque over speed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Continuous {
    pub(super) standstill: f64,
    pub(super) rated_torque: f64,
    pub(super) rated_speed: f64,
    pub(super) max_power: f64,
    pub(super) points: Box<[[f64; 2]]>,
}

impl Continuous {
    /// Infinite values mean that there are no data.
    pub(super) fn of(
        motor: &Motor,
        known: impl Fn(Option<f64>) -> f64,
        points: Vec<[f64; 2]>,
    ) -> Self {
        let rated_torque = known(motor.rated_torque);
        let first = points.first().map(|p| p[1]);
        let stated = known(motor.standstill_torque);
        Self {
            standstill: if stated.is_finite() {
                stated
            } else {
                first.unwrap_or(rated_torque)
            },
            rated_torque,
            rated_speed: known(motor.rated_speed),
            max_power: known(motor.max_power),
            points: points.into_boxed_slice(),
        }
    }

    /// The torques at all speeds, times a factor.
    pub(super) fn times(mut self, factor: f64) -> Self {
        // An unknown torque stays unknown.
        let scaled = |x: f64| if x.is_finite() { factor * x } else { x };
        self.standstill = scaled(self.standstill);
        self.rated_torque = scaled(self.rated_torque);
        self.max_power = scaled(self.max_power);
        for [_, torque] in &mut self.points {
            *torque *= factor;
        }
        self
    }

    /// S1 torque (N·m) at a speed's magnitude (rad/s).
    pub(super) fn torque(&self, speed: f64) -> f64 {
        let heat = match &*self.points {
            [] => self.by_figures(speed),
            points => between(points, speed),
        };
        let power = if speed > 0.0 {
            self.max_power / speed
        } else {
            f64::INFINITY
        };
        heat.min(power)
    }

    pub(super) fn by_figures(&self, speed: f64) -> f64 {
        let Self {
            standstill,
            rated_torque: torque,
            rated_speed: rated,
            ..
        } = *self;
        if speed > rated && torque.is_finite() {
            torque * (rated / speed)
        } else if torque.is_finite() && standstill.is_finite() && rated.is_finite() {
            standstill + (torque - standstill) * (speed / rated)
        } else if speed == 0.0 {
            standstill
        } else {
            torque
        }
    }
}

/// Linear between points; constant before the first, with constant power beyond the last.
pub(super) fn between(points: &[[f64; 2]], speed: f64) -> f64 {
    let after = points.partition_point(|p| p[0] < speed);
    match (after.checked_sub(1).map(|k| points[k]), points.get(after)) {
        (None, Some([_, torque])) => *torque,
        (Some([n0, t0]), Some([n1, t1])) => t0 + (t1 - t0) * ((speed - n0) / (n1 - n0)),
        (Some([n, torque]), None) if n > 0.0 => torque * (n / speed),
        (Some([_, torque]), None) => torque,
        (None, None) => f64::INFINITY,
    }
}
