//! The prescribed motion of the drive link over one cycle.

use jred::motion::{Law, Move, State};
use jred::table::CubicSpline;

/// A motion in consecutive pieces.
#[derive(Clone, Debug)]
pub struct Motion {
    pieces: Vec<Piece>,
    /// Whether the motion repeats; sizing takes the RMS over the whole duration either way.
    pub cyclic: bool,
}

#[derive(Clone, Debug)]
struct Piece {
    start: f64,
    duration: f64,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Constant {
        phi: f64,
        omega: f64,
    },
    Move(Move<f64>),
    Profile {
        deviation: CubicSpline<Vec<f64>>,
        advance: f64,
        /// Speeds (rad/s) below this are standstill.
        standstill: f64,
    },
}

/// Share of a recorded motion's largest speed below which it stands still: the curve through the positions of a dwell
/// swings around zero by a few roundings, and friction must not take that for motion.
const STANDSTILL: f64 = 1e-6;

/// One segment of a segmented motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Distance (rad); zero for a dwell.
    pub distance: f64,
    /// Duration (s).
    pub duration: f64,
    /// Motion law.
    pub law: Law,
}

impl Motion {
    /// Constant speed `omega` (rad/s, not zero) over one turn from `start` (rad).
    pub fn constant_speed(start: f64, omega: f64) -> Self {
        let kind = Kind::Constant { phi: start, omega };
        let duration = std::f64::consts::TAU / omega.abs();
        Self {
            pieces: vec![Piece {
                start: 0.0,
                duration,
                kind,
            }],
            cyclic: true,
        }
    }

    /// Moves and dwells one after another, from `start` (rad).
    ///
    /// # Errors
    /// A duration that is not positive or a law that is not valid, with the index of the segment.
    pub fn segments(
        start: f64,
        segments: &[Segment],
        cyclic: bool,
    ) -> Result<Self, (usize, jred::Error)> {
        let (mut t, mut phi) = (0.0, start);
        let mut pieces = Vec::with_capacity(segments.len());
        for (index, segment) in segments.iter().enumerate() {
            let step = Move::new(segment.law, phi, segment.distance, segment.duration)
                .map_err(|error| (index, error))?;
            pieces.push(Piece {
                start: t,
                duration: segment.duration,
                kind: Kind::Move(step),
            });
            t += segment.duration;
            phi += segment.distance;
        }
        Ok(Self { pieces, cyclic })
    }

    /// A recorded motion: positions `phi` (rad) at equal time steps `dt` (s), the last at the end of the motion.
    /// The twice continuously differentiable curve through them gives speed and acceleration. A cyclic profile ends
    /// a whole number of turns from where it starts, and speed and acceleration close as well.
    ///
    /// # Errors
    /// Too few positions, or one that is not finite.
    pub fn profile(phi: &[f64], dt: f64, cyclic: bool) -> Result<Self, jred::Error> {
        let cells = phi.len().saturating_sub(1);
        let mut control = vec![0.0; jred::table::control_points(cells)];
        let (first, last) = (
            phi.first().copied().unwrap_or(0.0),
            phi.last().copied().unwrap_or(0.0),
        );
        let drift = if cyclic { last - first } else { 0.0 };
        if cyclic {
            // What is periodic is the deviation from the steady advance.
            let deviation: Vec<f64> = (0..cells)
                .map(|k| phi[k] - drift * k as f64 / cells as f64)
                .collect();
            jred::table::fit_periodic(&deviation, &mut control)?;
        } else {
            jred::table::fit_bounded(phi, &mut control)?;
        }
        let deviation = CubicSpline::new(control)?;
        let duration = dt * cells as f64;
        let speeds = (0..=cells).map(|k| (deviation.at(k as f64 / cells as f64)[1] + drift).abs());
        let standstill = STANDSTILL * speeds.fold(0.0, f64::max) / duration;
        let kind = Kind::Profile {
            deviation,
            advance: drift,
            standstill,
        };
        Ok(Self {
            pieces: vec![Piece {
                start: 0.0,
                duration,
                kind,
            }],
            cyclic,
        })
    }

    /// Length of the motion (s).
    pub fn duration(&self) -> f64 {
        self.pieces.last().map_or(0.0, |p| p.start + p.duration)
    }

    /// The smooth stretches of the motion as (start, end) in s: between them the acceleration may jump.
    pub fn stretches(&self) -> Vec<(f64, f64)> {
        let mut stretches = Vec::new();
        for piece in &self.pieces {
            let mut from = piece.start;
            let end = piece.start + piece.duration;
            if let Kind::Move(step) = &piece.kind {
                for z in step.law().breaks().into_iter().flatten() {
                    let to = piece.start + z * piece.duration;
                    if to > from && to < end {
                        stretches.push((from, to));
                        from = to;
                    }
                }
            }
            stretches.push((from, end));
        }
        stretches
    }

    /// The state at `t` (s), clamped to the motion.
    pub fn at(&self, t: f64) -> State<f64> {
        let index = self.pieces.partition_point(|p| p.start <= t).max(1) - 1;
        let Some(piece) = self.pieces.get(index) else {
            return State::default();
        };
        let t = (t - piece.start).clamp(0.0, piece.duration);
        match &piece.kind {
            Kind::Constant { phi, omega } => State {
                phi: phi + omega * t,
                omega: *omega,
                alpha: 0.0,
            },
            Kind::Move(step) => step.at(t),
            Kind::Profile {
                deviation,
                advance,
                standstill,
            } => {
                let [value, d1, d2] = deviation.at(t / piece.duration);
                let speed = (d1 + advance) / piece.duration;
                State {
                    phi: value + advance * t / piece.duration,
                    omega: if speed.abs() > *standstill {
                        speed
                    } else {
                        0.0
                    },
                    alpha: d2 / (piece.duration * piece.duration),
                }
            }
        }
    }
}
