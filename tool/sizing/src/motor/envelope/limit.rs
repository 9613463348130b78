//! A limit over speed as a sequence of pieces.

use super::circuit::Circuit;
use crate::motor::winding::CurrentCurve;

/// A torque limit over the magnitude of the speed, from zero up to the largest speed; zero beyond.
///
/// A short list of [`LimitPiece`]s without gaps, in rising order. While the motor drives, the limit never rises with speed; while it brakes it may,
/// because the voltage drop of the current then helps. It may jump down from one piece to the next. An infinite value means that there are no data.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    pieces: Box<[LimitPiece]>,
}

/// One piece of a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitPiece {
    /// Start of the piece (rad/s), finite.
    pub from: f64,
    /// End of the piece, included (rad/s); may be infinite in the last piece if it is constant.
    pub to: f64,
    /// Form of the torque.
    pub curve: TorqueCurve,
    /// Curvature between `from` and `to`.
    pub shape: Curvature,
}

/// Torque over speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TorqueCurve {
    /// A straight line: torque at the start of the piece (N·m, may be infinite if the slope is zero) and slope (N·m·s/rad).
    Line {
        /// Torque at the start of the piece (N·m).
        start: f64,
        /// Slope (N·m·s/rad).
        slope: f64,
    },
    /// The limit by the circuit of the winding.
    Winding {
        /// The circuit.
        circuit: Circuit,
        /// Its torques.
        torques: CurrentCurve,
        /// Whether the motor brakes.
        braking: bool,
    },
}

/// Curvature of a curve, which determines its lower bound between two speeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curvature {
    /// Straight: the chord is the curve.
    Straight,
    /// Concave: no point is below the chord.
    Concave,
    /// Monotonic, convex or unknown: no point is below the lower end.
    Monotone,
}

impl LimitPiece {
    /// A straight piece through two points \[speed, torque\].
    pub fn line([from, start]: [f64; 2], [to, end]: [f64; 2]) -> Self {
        let slope = (end - start) / (to - from);
        Self {
            from,
            to,
            curve: TorqueCurve::Line {
                start,
                slope: if slope.is_finite() { slope } else { 0.0 },
            },
            shape: Curvature::Straight,
        }
    }

    /// A constant piece.
    pub const fn level(from: f64, to: f64, torque: f64) -> Self {
        Self {
            from,
            to,
            curve: TorqueCurve::Line {
                start: torque,
                slope: 0.0,
            },
            shape: Curvature::Straight,
        }
    }

    /// Torque (N·m) at a speed of the piece (rad/s).
    #[inline]
    pub fn torque(&self, speed: f64) -> f64 {
        match &self.curve {
            // Constant: avoids 0·∞ in an infinite piece.
            TorqueCurve::Line { start, slope } if *slope == 0.0 => *start,
            // A line that ends at zero may become negative by rounding.
            TorqueCurve::Line { start, slope } => (start + slope * (speed - self.from)).max(0.0),
            TorqueCurve::Winding {
                circuit,
                torques,
                braking,
            } => torques.torque(circuit.largest_current(speed, *braking)),
        }
    }

    /// The same torques at `by` times the speeds.
    fn stretched(&self, by: f64) -> Self {
        let curve = match self.curve {
            TorqueCurve::Line { start, slope } => TorqueCurve::Line {
                start,
                slope: slope / by,
            },
            // A winding that needs less voltage at each speed.
            TorqueCurve::Winding {
                circuit,
                torques,
                braking,
            } => TorqueCurve::Winding {
                circuit: Circuit {
                    flux: circuit.flux / by,
                    reactance: circuit.reactance / by,
                    ..circuit
                },
                torques,
                braking,
            },
        };
        Self {
            from: self.from * by,
            to: self.to * by,
            curve,
            shape: self.shape,
        }
    }

    /// The same piece between two other speeds inside it.
    #[must_use]
    pub fn cut(&self, from: f64, to: f64) -> Self {
        let curve = match self.curve {
            TorqueCurve::Line { slope, .. } => TorqueCurve::Line {
                start: self.torque(from),
                slope,
            },
            winding @ TorqueCurve::Winding { .. } => winding,
        };
        Self {
            from,
            to,
            curve,
            shape: self.shape,
        }
    }
}

impl Limit {
    /// From pieces in rising order without gaps; pieces without length are dropped. An empty list allows no torque.
    pub fn new(pieces: impl IntoIterator<Item = LimitPiece>) -> Self {
        let pieces = pieces.into_iter().filter(|piece| piece.to > piece.from);
        Self {
            pieces: pieces.collect(),
        }
    }

    /// A constant torque up to a speed.
    pub fn level(torque: f64, to: f64) -> Self {
        Self::new([LimitPiece::level(0.0, to, torque)])
    }

    /// The same torques at `by` times the speeds.
    #[must_use]
    pub fn stretched(&self, by: f64) -> Self {
        Self::new(self.pieces.iter().map(|piece| piece.stretched(by)))
    }

    /// The pieces.
    pub fn pieces(&self) -> &[LimitPiece] {
        &self.pieces
    }

    /// Largest speed (rad/s).
    pub fn end(&self) -> f64 {
        self.pieces.last().map_or(0.0, |piece| piece.to)
    }

    /// Torque (N·m) at a speed's magnitude (rad/s); zero beyond the end.
    #[inline]
    pub fn torque(&self, speed: f64) -> f64 {
        // For two or three pieces a linear search is fastest.
        for piece in &self.pieces {
            if speed <= piece.to {
                return piece.torque(speed);
            }
        }
        0.0
    }

    /// The lower of two limits, up to the lower of their ends.
    #[must_use]
    pub fn min(&self, other: &Self) -> Self {
        let end = self.end().min(other.end());
        let starts = self.pieces.iter().chain(&*other.pieces);
        let mut cuts: Vec<f64> = starts.map(|piece| piece.from).chain([end]).collect();
        cuts.retain(|cut| *cut <= end);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let mut pieces = Vec::with_capacity(cuts.len());
        for pair in cuts.windows(2) {
            let &[from, to] = pair else { continue };
            // A piece includes its end; the next one starts after it.
            let at = |limit: &Self| limit.pieces.iter().find(|p| p.to > from).copied();
            if let (Some(a), Some(b)) = (at(self), at(other)) {
                lower(&a, &b, from, to, &mut pieces);
            }
        }
        Self::new(pieces)
    }
}

/// The lower of two pieces between two speeds, cut where they cross.
fn lower(a: &LimitPiece, b: &LimitPiece, from: f64, to: f64, pieces: &mut Vec<LimitPiece>) {
    let difference = |speed: f64| a.torque(speed) - b.torque(speed);
    let mut cuts = vec![from];
    if to.is_finite() {
        cuts.extend(crossings(&difference, from, to, is_bent(a) || is_bent(b)));
    }
    cuts.push(to);
    for pair in cuts.windows(2) {
        let &[from, to] = pair else { continue };
        let middle = if to.is_finite() {
            0.5 * (from + to)
        } else {
            from
        };
        let lower = if a.torque(middle) <= b.torque(middle) {
            a
        } else {
            b
        };
        pieces.push(lower.cut(from, to));
    }
}

const fn is_bent(piece: &LimitPiece) -> bool {
    !matches!(piece.shape, Curvature::Straight)
}

/// Bisection for a change of sign.
fn crossings(difference: &impl Fn(f64) -> f64, from: f64, to: f64, bent: bool) -> Vec<f64> {
    // Straight lines cross once; of curves, two crossings closer than this are not distinguished.
    let parts = if bent { 32 } else { 1 };
    let place = |k: u32| from + (to - from) * (f64::from(k) / f64::from(parts));
    let mut found = Vec::new();
    for k in 0..parts {
        let (mut low, mut high) = (place(k), place(k + 1));
        let below = difference(low) <= 0.0;
        if below == (difference(high) <= 0.0) {
            continue;
        }
        while {
            let middle = 0.5 * (low + high);
            low < middle && middle < high
        } {
            let middle = 0.5 * (low + high);
            if (difference(middle) <= 0.0) == below {
                low = middle;
            } else {
                high = middle;
            }
        }
        found.push(high);
    }
    found
}
