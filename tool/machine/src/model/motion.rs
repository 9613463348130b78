//! The prescribed motion of the drive link over one cycle.

use std::convert::Infallible;
use std::sync::Arc;

use jred::machine::motion::{Law, Move, Polynomial, State};
use jred::number::RangeError;

use crate::number::numerics;
use crate::number::spline::{Fault, Spline};

mod limits;
mod recording;
mod tool;

pub use limits::{Limits, TooShort, change, fastest};
pub use recording::{Closing, Recording};
pub use tool::{Measure, Standstill, ToolCoordinate};

/// A motion in consecutive pieces.
#[derive(Clone, Debug)]
pub struct Motion {
    pieces: Vec<Piece>,
    /// What is prescribed, if it is not the drive link.
    tool: Option<Arc<ToolCoordinate>>,
    /// Whether the motion repeats; sizing takes the RMS over the whole duration either way.
    pub cyclic: bool,
}

#[derive(Clone, Debug)]
struct Piece {
    /// Number of its segment.
    segment: usize,
    start: f64,
    duration: f64,
    kind: Kind,
}

impl Piece {
    fn end(&self) -> f64 {
        self.start + self.duration
    }
}

#[derive(Clone, Debug)]
enum Kind {
    Polynomial {
        start: f64,
        course: Polynomial,
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

/// Parts of a polynomial of seventh degree in which it is looked for a point where it turns back.
const TURNS: u32 = 64;

/// Parts of a recorded motion at whose ends it is looked at.
const RECORDED: u32 = 10_000;

/// One segment of a segmented motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Distance (rad, or m); zero for a dwell.
    pub distance: f64,
    /// How it is covered.
    pub course: Course,
}

/// How a segment goes from one end to the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// By a motion law, from rest to rest.
    Law {
        /// The law.
        law: Law,
        /// Duration (s).
        duration: f64,
    },
    /// By polynomials one after another.
    Phases(Vec<Phase>),
}

/// One polynomial over the time since its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Duration (s).
    pub duration: f64,
    /// Displacement over the time.
    pub polynomial: Polynomial,
}

impl Segment {
    /// A pause (s).
    pub fn dwell(duration: f64) -> Self {
        Self::law(0.0, duration, Law::default())
    }

    /// A move (rad, or m) by a motion law in a duration (s).
    pub const fn law(distance: f64, duration: f64, law: Law) -> Self {
        let course = Course::Law { law, duration };
        Self { distance, course }
    }

    /// Polynomials one after another, which cover the distance together.
    pub const fn phases(distance: f64, phases: Vec<Phase>) -> Self {
        let course = Course::Phases(phases);
        Self { distance, course }
    }

    /// A move by one polynomial.
    pub fn polynomial(distance: f64, duration: f64, polynomial: Polynomial) -> Self {
        let phase = Phase {
            duration,
            polynomial,
        };
        Self::phases(distance, vec![phase])
    }

    /// A move at constant speed.
    pub fn constant_speed(distance: f64, duration: f64, speed: f64) -> Self {
        let steady = Polynomial::constant_jerk([speed, 0.0, 0.0]);
        Self::polynomial(distance, duration, steady)
    }

    /// Duration (s).
    pub fn duration(&self) -> f64 {
        match &self.course {
            Course::Law { duration, .. } => *duration,
            Course::Phases(phases) => phases.iter().map(|phase| phase.duration).sum(),
        }
    }

    /// Speed and acceleration at the start and at the end.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        match &self.course {
            Course::Law { law, duration } => {
                let bend = self.distance / (duration * duration);
                [0.0, 1.0].map(|z| [0.0, law.at(z)[2] * bend])
            }
            Course::Phases(phases) => {
                let at = |phase: Option<&Phase>, end: bool| {
                    phase.map_or([0.0; 2], |phase| {
                        let t = if end { phase.duration } else { 0.0 };
                        let [_, v, a, _] = phase.polynomial.at(t);
                        [v, a]
                    })
                };
                [at(phases.first(), false), at(phases.last(), true)]
            }
        }
    }
}

impl Motion {
    /// Constant speed `omega` (rad/s, or m/s of a tool; not zero) from `start`, over one turn of the drive link, which is `turn` (rad, or m).
    pub fn constant_speed(start: f64, omega: f64, turn: f64) -> Self {
        let kind = Kind::Polynomial {
            start,
            course: Polynomial::constant_jerk([omega, 0.0, 0.0]),
        };
        let duration = (turn / omega).abs();
        Self {
            pieces: vec![Piece {
                segment: 0,
                start: 0.0,
                duration,
                kind,
            }],
            tool: None,
            cyclic: true,
        }
    }

    /// Moves and dwells one after another, from `start` (rad, or m).
    ///
    /// # Errors
    /// A duration that is not positive or a law that is not valid, with the index of the segment.
    pub fn segments(
        start: f64,
        segments: &[Segment],
        cyclic: bool,
    ) -> Result<Self, (usize, RangeError)> {
        let (mut t, mut phi) = (0.0, start);
        let mut pieces = Vec::with_capacity(segments.len());
        for (index, segment) in segments.iter().enumerate() {
            match &segment.course {
                Course::Law { law, duration } => {
                    let step = Move::new(*law, phi, segment.distance, *duration)
                        .map_err(|error| (index, error))?;
                    pieces.push(Piece {
                        segment: index,
                        start: t,
                        duration: *duration,
                        kind: Kind::Move(step),
                    });
                    t += duration;
                }
                Course::Phases(phases) => {
                    let mut start = phi;
                    for phase in phases {
                        pieces.push(Piece {
                            segment: index,
                            start: t,
                            duration: phase.duration,
                            kind: Kind::Polynomial {
                                start,
                                course: phase.polynomial,
                            },
                        });
                        t += phase.duration;
                        start += phase.polynomial.at(phase.duration)[0];
                    }
                }
            }
            phi += segment.distance;
        }
        Ok(Self {
            pieces,
            tool: None,
            cyclic,
        })
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
                segment: 0,
                start: 0.0,
                duration,
                kind,
            }],
            tool: None,
            cyclic: recording.closing != Closing::Open,
        }
    }

    /// Length of the motion (s).
    pub fn duration(&self) -> f64 {
        self.pieces.last().map_or(0.0, |p| p.end())
    }

    /// When segment number `index` ends (s).
    pub fn end_of(&self, index: usize) -> f64 {
        let pieces = self.pieces.iter().filter(|piece| piece.segment <= index);
        pieces.map(Piece::end).fold(0.0, f64::max)
    }

    /// The times (s) at which the prescribed position may be at an extreme, each with the number of its segment: the ends of the pieces,
    /// where a polynomial turns back, and a dense row of a recorded motion.
    pub fn reaches(&self) -> Vec<(usize, f64)> {
        let mut times = Vec::new();
        for piece in &self.pieces {
            if let Kind::Polynomial { course, .. } = &piece.kind {
                let speed = |t: f64| course.at(t)[1];
                let place = |k: u32| piece.duration * f64::from(k) / f64::from(TURNS);
                for k in 0..TURNS {
                    let [a, b] = [place(k), place(k + 1)];
                    if speed(a) * speed(b) < 0.0 {
                        let ahead = |t: f64| Ok::<_, Infallible>(speed(t) * speed(a) > 0.0);
                        let Ok(t) = numerics::edge(ahead, a, b);
                        times.push((piece.segment, piece.start + t));
                    }
                }
            }
            if let Kind::Positions { .. } | Kind::Speeds { .. } = &piece.kind {
                let place = |k: u32| piece.duration * f64::from(k) / f64::from(RECORDED);
                times.extend((0..RECORDED).map(|k| (piece.segment, piece.start + place(k))));
            }
            times.push((piece.segment, piece.end()));
        }
        times
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

    /// The same motion, prescribed for a coordinate of the tool.
    #[must_use]
    pub fn of_tool(mut self, tool: ToolCoordinate) -> Self {
        self.tool = Some(Arc::new(tool));
        self
    }

    /// The coordinate of the tool that is prescribed; `None`: the drive link.
    pub fn tool(&self) -> Option<&ToolCoordinate> {
        self.tool.as_deref()
    }

    /// The drive link's state at `t` (s), clamped to the motion.
    pub fn at(&self, t: f64) -> State<f64> {
        let prescribed = self.prescribed(t);
        match &self.tool {
            Some(tool) => tool.drive(prescribed),
            None => prescribed,
        }
    }

    /// The state of what is prescribed, the tool or the drive link, at `t` (s), clamped to the motion.
    pub fn prescribed(&self, t: f64) -> State<f64> {
        let index = self.pieces.partition_point(|p| p.start <= t).max(1) - 1;
        let Some(piece) = self.pieces.get(index) else {
            return State::default();
        };
        let t = (t - piece.start).clamp(0.0, piece.duration);
        match &piece.kind {
            Kind::Polynomial { start, course } => {
                let [way, omega, alpha, _] = course.at(t);
                State {
                    phi: start + way,
                    omega,
                    alpha,
                }
            }
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
