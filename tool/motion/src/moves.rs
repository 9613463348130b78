//! A prescribed motion as a chain of moves in one direction, pauses between them, and kept parts, in which the machine does its work.

mod kept;
mod timeline;

use jred_file::model::motion::{Motion, Overshoot, Steady};

pub(crate) use kept::INSIDE;
pub use kept::KeptMotion;
use timeline::Timeline;

/// A pause that is shorter than this share of the whole motion counts as an instant of rest, not as a pause.
const INSTANT_SHARE: f64 = 1e-9;

/// Share by which the speeds at the start and at the end of an endless motion may differ.
const CLOSURE_TOLERANCE: f64 = 1e-6;

/// One part of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A move in one direction, from rest to rest.
    Move(Move),
    /// A move in one direction that begins at the end of a kept part, or ends at the start of one, and passes there without rest.
    Passing(Move, EndStates),
    /// A part that is kept unchanged.
    Kept(KeptMotion),
    /// A pause: the drive link is at rest.
    Dwell {
        /// Position of the drive link (rad, or m).
        at: f64,
        /// Duration (s).
        duration: f64,
    },
}

impl Part {
    /// Duration (s).
    pub const fn duration(&self) -> f64 {
        match self {
            Self::Move(Move { duration, .. })
            | Self::Passing(Move { duration, .. }, _)
            | Self::Kept(KeptMotion { duration, .. })
            | Self::Dwell { duration, .. } => *duration,
        }
    }

    /// Start position (rad, or m).
    pub const fn from(&self) -> f64 {
        match self {
            Self::Move(Move { from, .. })
            | Self::Passing(Move { from, .. }, _)
            | Self::Kept(KeptMotion { from, .. }) => *from,
            Self::Dwell { at, .. } => *at,
        }
    }

    /// The move, and how it begins and ends; `None` for a pause or a kept part.
    pub fn step(&self) -> Option<(Move, EndStates)> {
        match self {
            Self::Move(step) => Some((*step, EndStates::default())),
            Self::Passing(step, ends) => Some((*step, *ends)),
            Self::Kept(_) | Self::Dwell { .. } => None,
        }
    }
}

/// A move of the drive link in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Start position (rad, or m).
    pub from: f64,
    /// End position (rad, or m).
    pub to: f64,
    /// Its duration in the motion (s).
    pub duration: f64,
}

/// Speed and acceleration at the start and at the end of a move, positive in its direction; zero where no kept part is next to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndStates {
    /// Speeds (rad/s, or m/s), not negative.
    pub speeds: [f64; 2],
    /// Accelerations (rad/s², or m/s²) of the kept parts there.
    pub accelerations: [f64; 2],
}

/// The parts of a motion, in order. Together they take as long as the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The parts.
    pub parts: Vec<Part>,
    /// Whether the motion never rests and no part of it is kept. Then it is one move, whose end speed equals its start speed.
    pub endless: bool,
    /// Time (s) of the motion at which the first part begins. An endless motion is cut where a kept part or a pause begins, or where it turns back.
    pub begins: f64,
    /// Segments whose law turns back by itself. That is not kept: such a segment is (a part of) one move, straight from its start to its end.
    pub overshoots: Vec<Overshoot>,
    /// The constant speed, if the whole motion consists of it. It is not kept, because then no move would be left to optimise.
    pub given_up: Option<Steady>,
}

impl Chain {
    /// The kept parts.
    pub fn kept(&self) -> impl Iterator<Item = &KeptMotion> {
        self.parts.iter().filter_map(|part| match part {
            Part::Kept(kept) => Some(kept),
            _ => None,
        })
    }
}

/// Why a motion does not consist of moves and pauses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMoves {
    /// The motion begins or ends at this speed (rad/s, or m/s), not at rest.
    NotAtRest {
        /// Speed at the start or at the end.
        speed: f64,
        /// Whether at its end.
        at_end: bool,
    },
    /// Nothing moves.
    Still,
    /// Every part is kept.
    AllKept,
}

/// The moves, pauses and kept parts of the drive link. `process` has the stretches that are kept.
///
/// # Errors
/// See [`NoMoves`].
pub fn chain(motion: &Motion, process: &[Steady]) -> Result<Chain, NoMoves> {
    let duration = motion.duration();
    let kept: f64 = process.iter().map(Steady::duration).sum();
    let all = kept >= duration * (1.0 - INSTANT_SHARE);
    let ends = [0.0, duration].map(|t| motion.at(t).omega);
    let turns = motion.cyclic
        && ends[0] != 0.0
        && (ends[1] - ends[0]).abs() <= CLOSURE_TOLERANCE * ends[0].abs();
    if all && !turns {
        return Err(NoMoves::AllKept);
    }
    let timeline = Timeline::new(motion, if all { &[] } else { process })?;
    let given_up = process.first().filter(|_| all).copied();
    timeline.chain(turns, given_up)
}
