//! The prescribed motion of the drive link over one cycle.

use std::convert::Infallible;
use std::sync::Arc;

use jred::machine::motion::{Move, Polynomial, State};
use jred::number::RangeError;

use crate::number::numerics;
use crate::number::spline::{FitMethod, SplineError};
use piece::{MotionPiece, PieceKind};

mod course;
mod limits;
mod nodes;
mod noise;
mod outlier;
mod overshoot;
mod piece;
mod recording;
mod segment;
mod steady;
mod tool;

pub use course::SegmentCourse;
pub use limits::{MoveLimits, TooShort, change, fastest};
pub use nodes::{Node, NodeCurve, step_at};
pub use noise::Noise;
pub use outlier::Outlier;
pub use overshoot::Overshoot;
pub use recording::{Recording, Repetition, cutoffs};
pub use segment::{MotionSegment, Phase, SegmentProfile};
pub use steady::Steady;
pub use tool::{Measure, Standstill, ToolCoordinate};

/// A motion in consecutive pieces.
#[derive(Clone, Debug)]
pub struct Motion {
    pieces: Vec<MotionPiece>,
    /// The prescribed coordinate, if it is not the drive link.
    tool: Option<Arc<ToolCoordinate>>,
    limits: Vec<(usize, MoveLimits)>,
    /// Whether the motion repeats; sizing uses the RMS over the whole duration in both cases.
    pub cyclic: bool,
}

/// Share of a recorded motion's largest speed below which it is at rest: the curve through the positions of a dwell oscillates around zero by a few
/// rounding errors, which friction must not treat as motion.
const STANDSTILL: f64 = 1e-6;

/// Parts of a polynomial of seventh degree that are searched for a point where it turns back.
const TURNS: u32 = 64;

/// The same between two rows of a recorded motion, where the speed is at most of third degree.
const TURNS_OF_ROWS: u32 = 4;

/// Parts of a recorded motion at whose ends it is evaluated.
const RECORDED: u32 = 10_000;

/// A point of a motion that may be an extreme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Number of the segment.
    pub segment: usize,
    /// Whether it is the drive link's position, not the tool's.
    pub of_drive: bool,
    /// Time (s).
    pub t: f64,
    /// The prescribed position (rad, or m).
    pub position: f64,
}

impl Motion {
    /// Constant speed `omega` (rad/s, or m/s of a tool; not zero) from `start`, over one turn of the drive link, which is `turn` (rad, or m).
    pub fn constant_speed(start: f64, omega: f64, turn: f64) -> Self {
        let kind = PieceKind::Polynomial {
            start,
            course: Polynomial::constant_jerk([omega, 0.0, 0.0]),
        };
        let duration = (turn / omega).abs();
        Self {
            pieces: vec![MotionPiece {
                segment: 0,
                of_drive: false,
                start: 0.0,
                duration,
                kind,
            }],
            tool: None,
            limits: Vec::new(),
            cyclic: true,
        }
    }

    /// Successive moves and dwells, from `start` (rad, or m).
    ///
    /// # Errors
    /// The index of a segment whose duration is not positive or whose law is not valid.
    pub fn segments(
        start: f64,
        segments: &[MotionSegment],
        cyclic: bool,
    ) -> Result<Self, (usize, RangeError)> {
        let (mut t, mut phi, mut of_drive) = (0.0, start, false);
        let mut pieces = Vec::with_capacity(segments.len());
        for (index, segment) in segments.iter().enumerate() {
            if let Some(from) = segment.from {
                (phi, of_drive) = (from, true);
            }
            match &segment.course {
                SegmentProfile::Law { law, duration } => {
                    let step = Move::new(*law, phi, segment.distance, *duration)
                        .map_err(|error| (index, error))?;
                    pieces.push(MotionPiece {
                        segment: index,
                        of_drive,
                        start: t,
                        duration: *duration,
                        kind: PieceKind::Move(step),
                    });
                    t += duration;
                }
                SegmentProfile::Phases(phases) => {
                    let mut start = phi;
                    for phase in phases {
                        pieces.push(MotionPiece {
                            segment: index,
                            of_drive,
                            start: t,
                            duration: phase.duration,
                            kind: PieceKind::Polynomial {
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
        let limits = segments.iter().enumerate();
        let limits = limits.filter_map(|(index, segment)| Some((index, segment.limits?)));
        Ok(Self {
            pieces,
            tool: None,
            limits: limits.collect(),
            cyclic,
        })
    }

    /// A motion through recorded positions (rad, or m). A twice continuously differentiable curve through them, or near them, gives speed and
    /// acceleration; for a cyclic motion all three close. Another one starts and ends at rest where its curve nearly does ([`FitMethod::Resting`]).
    ///
    /// # Errors
    /// Times do not rise, there are too few rows, or numbers are not finite.
    pub fn positions(recording: &Recording) -> Result<Self, SplineError> {
        let duration = recording.duration()?;
        let advance = match recording.closing {
            Repetition::Open => 0.0,
            Repetition::After(advance) => advance / duration,
        };
        // The deviation from the steady advance is periodic.
        let deviation = recording.times.iter().zip(recording.values);
        let deviation: Vec<f64> = deviation.map(|(t, phi)| phi - advance * t).collect();
        let curve = recording.curve(&deviation, FitMethod::Resting)?;
        let speeds = recording
            .times
            .iter()
            .map(|t| (curve.at(*t)[1] + advance).abs());
        let standstill = STANDSTILL * speeds.fold(0.0, f64::max);
        Ok(Self::recorded(
            duration,
            recording,
            PieceKind::Positions {
                curve,
                advance,
                standstill,
            },
        ))
    }

    /// A motion with recorded speeds (rad/s, or m/s), from the position `start`. The position is the exact integral of the curve through them. For a
    /// cyclic motion, the closing error is spread over the cycle as a constant speed.
    ///
    /// # Errors
    /// As for [`positions`](Self::positions).
    pub fn speeds(recording: &Recording, start: f64) -> Result<Self, SplineError> {
        let duration = recording.duration()?;
        let curve = recording.curve(recording.values, FitMethod::Interpolating)?;
        let advance = match recording.closing {
            Repetition::Open => 0.0,
            Repetition::After(advance) => (advance - curve.integral(duration)) / duration,
        };
        let speeds = recording.values.iter().map(|speed| speed.abs());
        let standstill = STANDSTILL * speeds.fold(0.0, f64::max);
        Ok(Self::recorded(
            duration,
            recording,
            PieceKind::Speeds {
                curve,
                start,
                advance,
                standstill,
            },
        ))
    }

    /// A motion through at least two nodes, in the order of their times, the first at t = 0. Where speeds and accelerations are rounding, it is at
    /// rest.
    pub fn nodes(nodes: &[Node], cyclic: bool) -> Self {
        Self::through(nodes, NodeCurve::Speeds, cyclic)
    }

    /// The motion of an electronic cam through its points, with polynomials of fifth degree between them; else as [`nodes`](Self::nodes).
    pub fn cam(points: &[Node], cyclic: bool) -> Self {
        Self::through(points, NodeCurve::Positions, cyclic)
    }

    fn through(nodes: &[Node], curve: NodeCurve, cyclic: bool) -> Self {
        let piece = |run: Vec<Node>| {
            let [start, end] = [run.first(), run.last()].map(|node| node.map_or(0.0, |n| n.t));
            MotionPiece {
                segment: 0,
                of_drive: false,
                start,
                duration: end - start,
                kind: PieceKind::Nodes { nodes: run, curve },
            }
        };
        Self {
            pieces: nodes::runs(nodes).into_iter().map(piece).collect(),
            tool: None,
            limits: Vec::new(),
            cyclic,
        }
    }

    fn recorded(duration: f64, recording: &Recording, kind: PieceKind) -> Self {
        Self {
            pieces: vec![MotionPiece {
                segment: 0,
                of_drive: false,
                start: 0.0,
                duration,
                kind,
            }],
            tool: None,
            limits: Vec::new(),
            cyclic: recording.closing != Repetition::Open,
        }
    }

    /// The limits that the file gives its segments, by their indices from 0.
    pub fn limits(&self) -> &[(usize, MoveLimits)] {
        &self.limits
    }

    /// Duration (s).
    pub fn duration(&self) -> f64 {
        self.pieces.last().map_or(0.0, MotionPiece::end)
    }

    /// Points at which the prescribed position may be at an extreme: the ends of the pieces, turning points of polynomials, and dense samples of a
    /// recorded motion.
    pub fn reaches(&self) -> Vec<Reach> {
        let mut reaches = Vec::new();
        for piece in &self.pieces {
            let mut reach = |t: f64| {
                reaches.push(Reach {
                    segment: piece.segment,
                    of_drive: piece.of_drive || self.tool.is_none(),
                    t: piece.start + t,
                    position: piece.at(t).phi,
                });
            };
            reach(0.0);
            match &piece.kind {
                PieceKind::Polynomial { course, .. } => {
                    let speed = |t: f64| course.at(t)[1];
                    let place = |k: u32| piece.duration * f64::from(k) / f64::from(TURNS);
                    for k in 0..TURNS {
                        let [a, b] = [place(k), place(k + 1)];
                        if speed(a) * speed(b) < 0.0 {
                            let ahead = |t: f64| Ok::<_, Infallible>(speed(t) * speed(a) > 0.0);
                            let Ok(t) = numerics::edge(ahead, a, b);
                            reach(t);
                        }
                    }
                }
                PieceKind::Positions { .. } | PieceKind::Speeds { .. } => {
                    let place = |k: u32| piece.duration * f64::from(k) / f64::from(RECORDED);
                    (1..RECORDED).for_each(|k| reach(place(k)));
                }
                PieceKind::Nodes { nodes, curve } => {
                    let parts = curve.turns();
                    for pair in nodes.windows(2) {
                        let [from, to] = [&pair[0], &pair[1]].map(|node| node.t - piece.start);
                        let place = |k: u32| from + (to - from) * f64::from(k) / f64::from(parts);
                        (1..=parts).map(place).for_each(&mut reach);
                    }
                }
                PieceKind::Move(_) => {}
            }
            reach(piece.duration);
        }
        reaches
    }

    /// The smooth stretches of the motion as (start, end) in s: between them the acceleration may jump.
    pub fn stretches(&self) -> Vec<(f64, f64)> {
        let mut stretches = Vec::new();
        for piece in &self.pieces {
            let mut from = piece.start;
            let end = piece.start + piece.duration;
            if let PieceKind::Move(step) = &piece.kind {
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

    /// Whether a part of it is recorded or computed as rows.
    pub fn is_recorded(&self) -> bool {
        self.pieces.iter().any(MotionPiece::is_recorded)
    }

    /// The times (s) of its rows strictly within a part of the motion, in order: there a derivative jumps. Empty for a motion that is neither
    /// recorded nor computed.
    pub fn rows_within(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let first = self.pieces.partition_point(|piece| piece.end() <= from);
        let pieces = self.pieces.iter().skip(first);
        let mut rows = Vec::new();
        for piece in pieces.take_while(|piece| piece.start < to) {
            piece.rows_between([from, to], &mut rows);
        }
        rows.dedup();
        rows
    }

    /// A part of the motion cut at its rows: times (s) including both ends.
    pub fn cut_at_rows(&self, span: [f64; 2]) -> Vec<f64> {
        let [from, to] = span;
        let inner = self.rows_within(span);
        [from].into_iter().chain(inner).chain([to]).collect()
    }

    /// Times (s) of a part of the motion, in order with both ends: between two of them the drive link turns back at most once, except for rounding.
    pub fn turning(&self, span: [f64; 2]) -> Vec<f64> {
        let [from, to] = span;
        let first = self.pieces.partition_point(|piece| piece.end() <= from);
        let pieces = self.pieces.iter().skip(first);
        let mut places = vec![from];
        for piece in pieces.take_while(|piece| piece.start < to) {
            let parts = match piece.kind {
                // It has one direction.
                PieceKind::Move(_) => 1,
                PieceKind::Polynomial { .. } => TURNS,
                PieceKind::Positions { .. } | PieceKind::Speeds { .. } => TURNS_OF_ROWS,
                PieceKind::Nodes { curve, .. } => curve.turns(),
            };
            let mut ends = vec![piece.start.max(from)];
            piece.rows_between([from, to], &mut ends);
            ends.push(piece.end().min(to));
            for ends in ends.windows(2) {
                let part = |k: u32| ends[0] + (ends[1] - ends[0]) * f64::from(k) / f64::from(parts);
                places.extend((1..=parts).map(part));
            }
        }
        places.push(to);
        places.dedup_by(|next, before| *next <= *before);
        places
    }

    /// The same motion, prescribed for a coordinate of the tool.
    #[must_use]
    pub fn of_tool(mut self, tool: ToolCoordinate) -> Self {
        self.tool = Some(Arc::new(tool));
        self
    }

    /// The prescribed coordinate of the tool; `None`: the drive link.
    pub fn tool(&self) -> Option<&ToolCoordinate> {
        self.tool.as_deref()
    }

    /// The drive link's state at `t` (s), clamped to the motion.
    pub fn at(&self, t: f64) -> State<f64> {
        let Some(piece) = self.piece(t) else {
            return State::default();
        };
        let prescribed = piece.at(t - piece.start);
        match &self.tool {
            Some(tool) if !piece.of_drive => tool.drive(prescribed),
            _ => prescribed,
        }
    }

    /// The prescribed state at `t` (s), clamped to the motion: of the tool, or of the drive link.
    pub fn prescribed(&self, t: f64) -> State<f64> {
        let piece = self.piece(t);
        piece.map_or(State::default(), |piece| piece.at(t - piece.start))
    }

    /// The piece that contains the time `t`; at a border the later one.
    fn piece(&self, t: f64) -> Option<&MotionPiece> {
        let index = self.pieces.partition_point(|p| p.start <= t).max(1) - 1;
        self.pieces.get(index)
    }
}
