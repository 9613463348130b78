//! The prescribed motion of the drive link over one cycle.

use jred::machine::motion::{Law, Move, State};

use crate::number::spline::{Fault, Spline, Way};

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
    /// φ is the curve and a steady advance.
    Positions {
        curve: Spline,
        /// rad/s
        advance: f64,
        /// Speeds (rad/s) below this are standstill.
        standstill: f64,
    },
    /// ω is the curve and a constant; φ its integral.
    Speeds {
        curve: Spline,
        start: f64,
        /// rad/s
        advance: f64,
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
    ) -> Result<Self, (usize, jred::number::RangeError)> {
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

    /// A motion through recorded positions (rad, or m). The twice continuously differentiable curve through them, or near them,
    /// gives speed and acceleration; of a cyclic one all three close.
    ///
    /// # Errors
    /// Times that do not rise, too few rows, numbers that are not finite.
    pub fn positions(recording: &Recording) -> Result<Self, Fault> {
        let duration = recording.duration()?;
        let advance = match recording.closing {
            Closing::Open => 0.0,
            Closing::After(advance) => advance / duration,
        };
        // What is periodic is the deviation from the steady advance.
        let deviation = recording.times.iter().zip(recording.values);
        let deviation: Vec<f64> = deviation.map(|(t, phi)| phi - advance * t).collect();
        let curve = recording.curve(&deviation)?;
        let speeds = recording
            .times
            .iter()
            .map(|t| (curve.at(*t)[1] + advance).abs());
        let standstill = STANDSTILL * speeds.fold(0.0, f64::max);
        Ok(Self::recorded(
            duration,
            recording,
            Kind::Positions {
                curve,
                advance,
                standstill,
            },
        ))
    }

    /// A motion with recorded speeds (rad/s, or m/s), from the position `start`. The position is the exact integral of the curve
    /// through them. What a cyclic one misses is spread over the cycle as a constant speed.
    ///
    /// # Errors
    /// As for [`positions`](Self::positions).
    pub fn speeds(recording: &Recording, start: f64) -> Result<Self, Fault> {
        let duration = recording.duration()?;
        let curve = recording.curve(recording.values)?;
        let advance = match recording.closing {
            Closing::Open => 0.0,
            Closing::After(advance) => (advance - curve.integral(duration)) / duration,
        };
        let speeds = recording.values.iter().map(|speed| speed.abs());
        let standstill = STANDSTILL * speeds.fold(0.0, f64::max);
        Ok(Self::recorded(
            duration,
            recording,
            Kind::Speeds {
                curve,
                start,
                advance,
                standstill,
            },
        ))
    }

    fn recorded(duration: f64, recording: &Recording, kind: Kind) -> Self {
        Self {
            pieces: vec![Piece {
                start: 0.0,
                duration,
                kind,
            }],
            cyclic: recording.closing != Closing::Open,
        }
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
            Kind::Positions {
                curve,
                advance,
                standstill,
            } => {
                // The end of a period is its beginning, a cycle later.
                let [value, d1, d2, _] = curve.at(t);
                State {
                    phi: value + advance * t,
                    omega: moving(d1 + advance, *standstill),
                    alpha: d2,
                }
            }
            Kind::Speeds {
                curve,
                start,
                advance,
                standstill,
            } => {
                let [speed, alpha, ..] = curve.at(t);
                State {
                    phi: start + curve.integral(t) + advance * t,
                    omega: moving(speed + advance, *standstill),
                    alpha,
                }
            }
        }
    }
}

/// A speed, or zero below `standstill`.
fn moving(speed: f64, standstill: f64) -> f64 {
    if speed.abs() > standstill { speed } else { 0.0 }
}

/// Whether a recorded motion repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closing {
    /// It does not.
    Open,
    /// It does, and goes on by this (rad, or m) in a cycle: whole turns, or nothing.
    After(f64),
}

/// Rows of a recorded motion.
#[derive(Clone, Copy, Debug)]
pub struct Recording<'r> {
    /// Times from 0 on, rising, the last at the end of the motion (s).
    pub times: &'r [f64],
    /// Positions or speeds.
    pub values: &'r [f64],
    /// Angular frequency at which smoothing halves an amplitude (rad/s); none: the curve goes through every row.
    pub cutoff: Option<f64>,
    /// Whether it repeats: then its last row is its first, a cycle later.
    pub closing: Closing,
}

impl Recording<'_> {
    fn duration(&self) -> Result<f64, Fault> {
        match self.times {
            [first, .., last] if *first == 0.0 && *last > 0.0 => Ok(*last),
            _ => Err(Fault::NotRising),
        }
    }

    fn curve(&self, values: &[f64]) -> Result<Spline, Fault> {
        let way = self.cutoff.map_or(Way::Interpolating, Way::Smoothing);
        match (self.closing, self.times) {
            (Closing::After(_), [times @ .., duration]) if values.len() == self.times.len() => {
                Spline::periodic(times, &values[..times.len()], *duration, way)
            }
            _ => Spline::bounded(self.times, values, way),
        }
    }
}
