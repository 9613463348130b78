//! Lower bounds of a limit between two speeds, for the search for the peak: see [`Cycle::peak`](crate::cycle::Cycle::peak).

use super::{Curvature, Envelope, Limit, LimitPiece, TorqueCurve};

impl Envelope {
    /// A chord that is not above the short-time torque limit between two speeds (rad/s, not negative, rising): its torques at both (N·m). It is exact
    /// where the limit is straight or concave; elsewhere it is the limit's least value between them.
    pub(crate) fn floor(&self, driving: bool, speeds: [f64; 2]) -> [f64; 2] {
        self.limit(!driving).floor(speeds)
    }

    /// A speed (rad/s) below which torque is available in all four quadrants.
    pub(crate) fn positive_below(&self) -> f64 {
        self.limit(false)
            .positive_below()
            .min(self.limit(true).positive_below())
    }

    /// The limit, if it is the same in all four quadrants at every speed up to this one, and not zero.
    pub(crate) fn level_up_to(&self, speed: f64) -> Option<f64> {
        let level = |limit: &Limit| limit.pieces().first().and_then(|p| p.level_up_to(speed));
        let driving = level(self.limit(false))?;
        let braking = level(self.limit(true))?;
        (driving.total_cmp(&braking).is_eq() && driving > 0.0).then_some(driving)
    }
}

impl Envelope {
    /// Torque at rest (N·m) and slope (N·m·s/rad) of the limits while the motor drives and while it brakes, if both are straight up to this speed
    /// (rad/s).
    pub(crate) fn straight_up_to(&self, speed: f64) -> Option<[[f64; 2]; 2]> {
        let line = |limit: &Limit| match limit.pieces().first()? {
            LimitPiece {
                from: 0.0,
                to,
                curve: TorqueCurve::Line { start, slope },
                ..
            } if speed <= *to && start.is_finite() => Some([*start, *slope]),
            _ => None,
        };
        Some([line(self.limit(false))?, line(self.limit(true))?])
    }
}

impl LimitPiece {
    fn level_up_to(&self, speed: f64) -> Option<f64> {
        match self.curve {
            TorqueCurve::Line { start, slope } if slope == 0.0 && speed <= self.to => Some(start),
            _ => None,
        }
    }

    /// The least torque between two speeds of the piece: in every shape it is at an end.
    fn least(&self, from: f64, to: f64) -> f64 {
        self.torque(from).min(self.torque(to))
    }
}

impl Limit {
    fn positive_below(&self) -> f64 {
        // Just below the end, where the last torques may already round to zero.
        const JUST_BELOW: f64 = 1.0 - 1e-9;
        for piece in self.pieces() {
            let [from, to] = [piece.torque(piece.from), piece.torque(piece.to)];
            let positive = match piece.shape {
                _ if from <= 0.0 => piece.from,
                _ if to > 0.0 => continue,
                // A chord that is positive up to its end.
                Curvature::Straight | Curvature::Concave => piece.to * JUST_BELOW,
                Curvature::Monotone => piece.from,
            };
            return positive;
        }
        self.end()
    }

    /// See [`Envelope::floor`].
    fn floor(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let pieces = self.pieces();
        let mut place = 0;
        while pieces.get(place).is_some_and(|piece| piece.to < from) {
            place += 1;
        }
        let Some(first) = pieces.get(place) else {
            return [0.0; 2];
        };
        if to <= first.to {
            let ends = [first.torque(from), first.torque(to)];
            return match first.shape {
                Curvature::Straight | Curvature::Concave => ends,
                Curvature::Monotone => [ends[0].min(ends[1]); 2],
            };
        }
        if to > self.end() {
            return [0.0; 2];
        }
        // Over several pieces the chord is valid if it is above no corner.
        let covered = &pieces[place..];
        let mut least = f64::INFINITY;
        let mut bends_down = true;
        let start = first.torque(from);
        let end = self.torque(to);
        let slope = (end - start) / (to - from);
        let rounding = 8.0 * f64::EPSILON * (start + end);
        let above = |torque: f64, speed: f64| torque + rounding >= start + slope * (speed - from);
        for piece in covered.iter().take_while(|piece| piece.from < to) {
            let (a, b) = (piece.from.max(from), piece.to.min(to));
            least = least.min(piece.least(a, b));
            bends_down &= piece.shape != Curvature::Monotone
                && above(piece.torque(a), a)
                && above(piece.torque(b), b);
        }
        if bends_down && slope.is_finite() && start.is_finite() {
            [start, end]
        } else {
            [least; 2]
        }
    }
}

#[cfg(test)]
mod tests;
