//! What a prescribed motion is made of: moves one way, the pauses between them, and the parts that are kept as they are because the machine does its work there.

mod kept;
mod timeline;

use jred_machine::model::motion::{Motion, Steady};

pub(crate) use kept::INSIDE;
pub use kept::Kept;
use timeline::Timeline;

/// Share of the whole motion below which a pause is a point of rest only.
const POINT: f64 = 1e-9;

/// Share of the speed by which start and end of an endless motion may differ.
const CLOSED: f64 = 1e-6;

/// One part of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// From rest to rest in one direction.
    Move(Move),
    /// In one direction, from a kept part or to one.
    Passing(Move, Passing),
    /// Kept as it is.
    Kept(Kept),
    /// At rest.
    Dwell {
        /// Position of the drive link (rad, or m).
        at: f64,
        /// How long (s).
        duration: f64,
    },
}

impl Part {
    /// How long it takes (s).
    pub const fn duration(&self) -> f64 {
        match self {
            Self::Move(Move { duration, .. })
            | Self::Passing(Move { duration, .. }, _)
            | Self::Kept(Kept { duration, .. })
            | Self::Dwell { duration, .. } => *duration,
        }
    }

    /// Where it begins (rad, or m).
    pub const fn from(&self) -> f64 {
        match self {
            Self::Move(Move { from, .. })
            | Self::Passing(Move { from, .. }, _)
            | Self::Kept(Kept { from, .. }) => *from,
            Self::Dwell { at, .. } => *at,
        }
    }

    /// The move that it is, if it is one, and how it begins and ends.
    pub fn step(&self) -> Option<(Move, Passing)> {
        match self {
            Self::Move(step) => Some((*step, Passing::default())),
            Self::Passing(step, ends) => Some((*step, *ends)),
            Self::Kept(_) | Self::Dwell { .. } => None,
        }
    }
}

/// A move of the drive link in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Where it begins (rad, or m).
    pub from: f64,
    /// Where it ends (rad, or m).
    pub to: f64,
    /// How long it takes in the motion (s).
    pub duration: f64,
}

/// How a move begins and ends, both counted in its direction; at rest where nothing is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passing {
    /// Speeds (rad/s, or m/s), not negative.
    pub speeds: [f64; 2],
    /// Accelerations (rad/s², or m/s²) of the kept parts there.
    pub accelerations: [f64; 2],
}

/// The parts of a motion, one after another, as long as the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The parts.
    pub parts: Vec<Part>,
    /// Whether it turns for ever without rest and nothing of it is kept: one move, which comes round with the speed that it began with.
    pub endless: bool,
    /// When it begins in the motion (s): a motion that turns for ever begins where something is kept, or rests.
    pub begins: f64,
    /// The constant speed of a motion that is nothing else: it is not kept, because nothing would be left to seek.
    pub given_up: Option<Steady>,
}

impl Chain {
    /// The kept parts.
    pub fn kept(&self) -> impl Iterator<Item = &Kept> {
        self.parts.iter().filter_map(|part| match part {
            Part::Kept(kept) => Some(kept),
            _ => None,
        })
    }
}

/// Why a motion is not made of moves and pauses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMoves {
    /// It begins or ends in motion, at this speed (rad/s, or m/s).
    NotAtRest {
        /// Speed at the start or at the end.
        speed: f64,
        /// Whether at its end.
        at_end: bool,
    },
    /// Nothing moves.
    Still,
    /// All of it is kept.
    AllKept,
}

/// The moves, pauses and kept parts of the drive link. `process` is what is kept.
///
/// # Errors
/// A motion that begins or ends in motion and does not turn for ever, or in which nothing moves, or nothing that is not kept.
pub fn chain(motion: &Motion, process: &[Steady]) -> Result<Chain, NoMoves> {
    let duration = motion.duration();
    let kept: f64 = process.iter().map(Steady::duration).sum();
    let all = kept >= duration * (1.0 - POINT);
    let ends = [0.0, duration].map(|t| motion.at(t).omega);
    let turns =
        motion.cyclic && ends[0] != 0.0 && (ends[1] - ends[0]).abs() <= CLOSED * ends[0].abs();
    if all && !turns {
        return Err(NoMoves::AllKept);
    }
    let timeline = Timeline::new(motion, if all { &[] } else { process })?;
    let given_up = process.first().filter(|_| all).copied();
    timeline.chain(turns, given_up)
}
