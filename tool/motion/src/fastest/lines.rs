//! A torque-speed curve as the lower envelope of straight lines, each a smooth limit.

use jred_sizing::motor::envelope::{LimitPiece, TorqueCurve};

use super::field::Field;

/// Share of the torque at rest by which straight lines may differ from a torque-speed curve.
const LINE_TOLERANCE: f64 = 1e-12;

impl Field<'_, '_> {
    /// The motor's torque as the lowest of straight lines, each given by its torque at rest and its slope by the drive link's speed; `None` if the
    /// curve has no such form.
    pub fn torque_lines(&self, braking: bool) -> Option<Vec<[f64; 2]>> {
        let pieces = self.dynamics.actuator.envelope.limit(braking).pieces();
        let reserve = &self.limits.reserve;
        let (left, per_speed) = (
            reserve.leaves(reserve.torque),
            self.dynamics.motor_speed(1.0),
        );
        let lines = pieces.iter().map(|piece| match piece.curve {
            TorqueCurve::Line { start, slope } => Some([start - slope * piece.from, slope]),
            TorqueCurve::Winding { .. } => None,
        });
        let lines: Vec<[f64; 2]> = lines.collect::<Option<_>>()?;
        let scale = pieces.first()?.torque(0.0);
        let lowest = |speed: f64| {
            let each = lines.iter().map(|[torque, slope]| torque + slope * speed);
            each.fold(f64::INFINITY, f64::min)
        };
        let is_lowest = |piece: &LimitPiece| {
            [piece.from, piece.to.min(self.motor_end())]
                .iter()
                .all(|speed| {
                    (piece.torque(*speed) - lowest(*speed)).abs() <= LINE_TOLERANCE * scale
                })
        };
        let scaled = |[torque, slope]: &[f64; 2]| [left * torque, left * slope * per_speed];
        (pieces.iter().all(is_lowest)).then(|| lines.iter().map(scaled).collect())
    }
}
