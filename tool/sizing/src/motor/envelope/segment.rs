//! The S1 torque between two speeds, where it is a single line or hyperbola.

use super::continuous::Continuous;
use super::{Curvature, Envelope, Limit};

/// A torque over speed between two speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TorqueSegment {
    /// No data.
    Unknown,
    /// A straight line with these torques at both ends (N·m).
    Line([f64; 2]),
    /// Constant power (W).
    Power(f64),
}

impl Envelope {
    /// The S1 torque between two speeds (rad/s, not negative, not falling). `None` if it is more than one line or hyperbola, or the voltage line of a
    /// winding, or if a simple test does not decide.
    pub(crate) fn continuous_segment(&self, speeds: [f64; 2]) -> Option<TorqueSegment> {
        let [from, to] = speeds;
        if from > self.max_speed {
            return Some(TorqueSegment::Line([0.0; 2]));
        }
        if to > self.max_speed {
            return None;
        }
        match self.continuous.segment(speeds)? {
            // An unknown torque is not capped: see `Envelope::continuous_torque`.
            TorqueSegment::Unknown => Some(TorqueSegment::Unknown),
            heat => self.driving.caps(heat, speeds),
        }
    }
}

impl Continuous {
    fn segment(&self, speeds: [f64; 2]) -> Option<TorqueSegment> {
        let heat = match &*self.points {
            [] => self.figures_segment(speeds)?,
            points => points_segment(points, speeds)?,
        };
        let power = if self.max_power.is_finite() {
            TorqueSegment::Power(self.max_power)
        } else {
            TorqueSegment::Unknown
        };
        lower(heat, power, speeds)
    }

    fn figures_segment(&self, [from, to]: [f64; 2]) -> Option<TorqueSegment> {
        let (torque, rated) = (self.rated_torque, self.rated_speed);
        if torque.is_finite() && from > rated {
            return Some(TorqueSegment::Power(torque * rated));
        }
        let straight = torque.is_finite() && self.standstill.is_finite() && rated.is_finite();
        let together = straight || from > 0.0 || to == 0.0;
        (to <= rated && together)
            .then(|| level_or_line([from, to].map(|speed| self.by_figures(speed))))
    }
}

/// Between points, constant before the first, with constant power beyond the last.
fn points_segment(points: &[[f64; 2]], speeds: [f64; 2]) -> Option<TorqueSegment> {
    let [after, same] = speeds.map(|speed| points.partition_point(|p| p[0] < speed));
    if after != same {
        return None;
    }
    match points.last() {
        Some([speed, torque]) if after == points.len() && *speed > 0.0 => {
            Some(TorqueSegment::Power(torque * speed))
        }
        _ => Some(level_or_line(
            speeds.map(|speed| super::continuous::between(points, speed)),
        )),
    }
}

fn level_or_line(torques: [f64; 2]) -> TorqueSegment {
    if torques.iter().all(|torque| torque.is_finite()) {
        TorqueSegment::Line(torques)
    } else {
        TorqueSegment::Unknown
    }
}

/// The lower of two, if one is the lower everywhere.
fn lower(one: TorqueSegment, other: TorqueSegment, speeds: [f64; 2]) -> Option<TorqueSegment> {
    match (one, other) {
        (TorqueSegment::Unknown, known) | (known, TorqueSegment::Unknown) => Some(known),
        (TorqueSegment::Line(a), TorqueSegment::Line(b)) if below(a, b) => Some(one),
        (TorqueSegment::Line(a), TorqueSegment::Line(b)) if below(b, a) => Some(other),
        (TorqueSegment::Line(_), TorqueSegment::Line(_)) => None,
        (TorqueSegment::Power(a), TorqueSegment::Power(b)) => Some(TorqueSegment::Power(a.min(b))),
        (TorqueSegment::Line(line), TorqueSegment::Power(power))
        | (TorqueSegment::Power(power), TorqueSegment::Line(line)) => {
            lower_of_both(line, power, speeds)
        }
    }
}

/// Whether a line is nowhere above another.
fn below(line: [f64; 2], other: [f64; 2]) -> bool {
    line[0] <= other[0] && line[1] <= other[1]
}

fn lower_of_both(line: [f64; 2], power: f64, speeds: [f64; 2]) -> Option<TorqueSegment> {
    // The hyperbola is convex: below its chord, and above its tangents.
    if speeds[0] > 0.0 && below(speeds.map(|speed| power / speed), line) {
        return Some(TorqueSegment::Power(power));
    }
    let middle = 0.5 * (speeds[0] + speeds[1]);
    let tangent = |at: f64| speeds.map(|speed| power / at * (2.0 - speed / at));
    let above = |at: f64| at > 0.0 && below(line, tangent(at));
    let level = [line[0].max(line[1]); 2];
    let least = speeds[1] == 0.0 || below(level, [power / speeds[1]; 2]);
    (least || above(middle) || above(speeds[1])).then_some(TorqueSegment::Line(line))
}

impl Limit {
    /// The lower of this limit and a torque, if it is the same line or hyperbola between two speeds in the range of the limit.
    fn caps(&self, torque: TorqueSegment, speeds: [f64; 2]) -> Option<TorqueSegment> {
        let reached = self.pieces().iter().find(|piece| speeds[0] <= piece.to);
        let Some(piece) = reached else {
            return Some(TorqueSegment::Line([0.0; 2]));
        };
        if speeds[1] > piece.to {
            return None;
        }
        let ends = speeds.map(|speed| piece.torque(speed));
        match piece.shape {
            Curvature::Straight => lower(torque, level_or_line(ends), speeds),
            Curvature::Concave => under(torque, ends, speeds),
            Curvature::Monotone => under(torque, [ends[0].min(ends[1]); 2], speeds),
        }
    }
}

/// A torque that is nowhere above a chord below the limit; `None` otherwise, because the limit itself is not a line.
fn under(torque: TorqueSegment, chord: [f64; 2], speeds: [f64; 2]) -> Option<TorqueSegment> {
    lower(torque, TorqueSegment::Line(chord), speeds).filter(|lower| *lower == torque)
}
