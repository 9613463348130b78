//! Lower bounds of all limits between two speeds, for callers that must never exceed the motor's capability.

use super::continuous::Continuous;
use super::{Envelope, Limit, TorqueSegment};

impl Envelope {
    /// A chord that is not above the short-time torque in any quadrant between two speeds (rad/s, not negative, rising): its torques at both (N·m);
    /// infinite without data.
    pub(crate) fn peak_floor(&self, speeds: [f64; 2]) -> [f64; 2] {
        let [driving, braking] = [true, false].map(|driving| self.floor(driving, speeds));
        [driving[0].min(braking[0]), driving[1].min(braking[1])]
    }

    /// The same for the S1 torque.
    pub(crate) fn continuous_floor(&self, speeds: [f64; 2]) -> [f64; 2] {
        let [from, to] = speeds;
        match self.continuous_segment(speeds) {
            Some(TorqueSegment::Unknown) => [f64::INFINITY; 2],
            Some(TorqueSegment::Line(torques)) => torques,
            // A hyperbola lies above its tangents, and above its end.
            Some(TorqueSegment::Power(power)) if to > 1.5 * from => [power / to; 2],
            Some(TorqueSegment::Power(power)) => {
                let middle = 0.5 * (from + to);
                speeds.map(|speed| power / middle * (2.0 - speed / middle))
            }
            None if to > self.max_speed() => [0.0; 2],
            None => {
                let heat = self.continuous.least(speeds);
                let [a, b] = self.floor(true, speeds);
                let least = if heat.is_finite() {
                    heat.min(a).min(b)
                } else {
                    heat
                };
                [least; 2]
            }
        }
    }
}

impl Continuous {
    /// The least S1 torque between two speeds: at one of them, or at a border of pieces.
    fn least(&self, [from, to]: [f64; 2]) -> f64 {
        let inside = self.corners().filter(|corner| (from..=to).contains(corner));
        let speeds = inside.chain([from, to]);
        speeds
            .map(|speed| self.torque(speed))
            .fold(f64::INFINITY, f64::min)
    }

    /// Speeds at borders of pieces (rad/s).
    fn corners(&self) -> impl Iterator<Item = f64> {
        let points = self.points.iter().map(|p| p[0]);
        points.chain([self.rated_speed])
    }
}

impl Envelope {
    /// Speeds at which any limit bends or jumps (rad/s), unordered.
    pub(crate) fn corners(&self) -> Vec<f64> {
        let limits = [&self.driving, &self.braking];
        let pieces = limits.into_iter().flat_map(Limit::pieces);
        let ends = pieces.flat_map(|piece| [piece.from, piece.to]);
        let corners = ends.chain(self.continuous.corners());
        corners.filter(|speed| speed.is_finite()).collect()
    }
}

#[cfg(test)]
mod tests;
