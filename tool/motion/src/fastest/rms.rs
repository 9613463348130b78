//! The fastest motion whose RMS torque, over all moves and pauses, is within a limit R.
//!
//! It minimises
//!
//! ```text
//! (1 − β)·t + β·∫T² dt/R²
//! ```
//!
//! with one β for all moves, which is found by a search. With β = 0 only the time counts.
//!
//! A standing or crawling machine whose torque there is C adds 1 − β·(1 − C²/R²) each second. If that were negative, waiting on the path would be
//! best, so β stays below 1/(1 − C²/R²) with the least C of the path. Without a torque at rest this bound is 1: a second never counts less than zero.
//! Where a weight acts all along the path, β may exceed 1: a constant J against a weight G needs β = R²/(4·(R² − G²)), more than 1 for a limit below
//! 1.155·G. Therefore β grows with a share s from 0 to 1 as 1/β = (1 − s)/s + (1 − C²/R²), and ∫T² dt − R²·t falls with s.

use jred::error::Error;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

use super::NoMotion;
use super::cycle::{Cycle, MotorLoad};
use super::programme::{Price, Start, WarmStart};
use crate::path_dynamics::{Actuator, PathDynamics};

/// A limit of the RMS torque over a motion with its pauses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rms {
    /// The S1 torque of the motor at the mean speed, less the reserve.
    Continuous,
    /// A torque (N·m).
    Torque(f64),
    /// The smaller of both.
    Both(f64),
}

impl Rms {
    fn of(self, load: &MotorLoad) -> f64 {
        match self {
            Self::Continuous => load.allowed,
            Self::Torque(torque) => torque,
            Self::Both(torque) => load.allowed.min(torque),
        }
    }

    /// Combines a limit, if there is one, with a torque (N·m).
    #[must_use]
    pub fn and(limit: Option<Self>, torque: f64) -> Self {
        match limit {
            None => Self::Torque(torque),
            Some(Self::Torque(other)) => Self::Torque(torque.min(other)),
            Some(Self::Continuous) => Self::Both(torque),
            Some(Self::Both(other)) => Self::Both(torque.min(other)),
        }
    }
}

/// Shares s that are tried until the RMS torque is small enough. For a constant inertia alone s is 1/4.
const SHARES: [f64; 10] = [
    0.25, 0.4, 0.6, 0.8, 0.9, 0.96, 0.99, 0.997, 0.9997, 0.999_99,
];

/// Most steps between two shares, and the share of the RMS torque below which the motions keep their pieces.
const STEPS: u32 = 40;
const NEAR: f64 = 0.02;

/// Share of an RMS torque that may be rounding: at its peak all along, a motor exceeds a limit of that torque by a bit, or does not.
const ROUNDING: f64 = 1e-12;

/// Share by which the RMS torque may lie below its limit at the end: the target, and the most.
const UNUSED: [f64; 2] = [1e-8, 1e-6];

/// Places of a move at which the torque of a slow motion is evaluated.
const PLACES: u32 = 360;

/// The next motions, and results of the previous ones.
#[derive(Debug, Default)]
pub(super) struct Continuation {
    /// The objective; `None`: the time, with the limits only.
    pub(super) price: Option<Price>,
    /// Of each move.
    warm: Vec<WarmStart>,
    /// Whether the price changes so little that the pieces are kept.
    is_beside: bool,
}

impl Continuation {
    /// Start of the search for a move.
    pub(super) fn start(&self, number: usize) -> Start<'_> {
        match self.warm.get(number) {
            None => Start::Nothing,
            Some(warm) if self.is_beside => Start::Beside(warm),
            Some(warm) => Start::Near(warm),
        }
    }

    /// Keeps a move for the next price.
    pub(super) fn keep(&mut self, number: usize, warm: WarmStart) {
        match self.warm.get_mut(number) {
            Some(own) => *own = warm,
            None => self.warm.push(warm),
        }
    }
}

/// Why there is no cycle.
pub(super) enum RmsError<E> {
    /// A move cannot be made.
    Move(E),
    /// The limit cannot be kept.
    Limit(NoMotion),
}

/// The least torque (N·m) of the motor in a motion without speed and acceleration, on paths from one position to another.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub(super) fn slowest(
    file: &MachineFile,
    actuator: &Actuator,
    ways: impl IntoIterator<Item = [f64; 2]>,
) -> Result<f64, Error> {
    let mut least = f64::INFINITY;
    for [from, to] in ways {
        let dynamics = PathDynamics::new(file, actuator.clone(), (to - from).signum());
        for k in 0..=PLACES {
            let place = dynamics.place(from + (to - from) * f64::from(k) / f64::from(PLACES))?;
            least = least.min(dynamics.demand(&place, 0.0, 0.0).torque.abs());
        }
    }
    Ok(least)
}

/// The price of a share s.
fn price(share: f64, limit: f64, slow: f64) -> Price {
    let waiting = (1.0 - (slow / limit).powi(2)).max(0.0);
    let beta = 1.0 / ((1.0 - share) / share + waiting);
    // Only their ratio counts.
    let unit = beta.max(1.0);
    Price {
        time: (1.0 - beta) / unit,
        heat: beta / unit / (limit * limit),
    }
}

/// The motion whose RMS torque is within a limit, and whether the limit has a price.
pub(super) fn within<E>(
    rms: Option<Rms>,
    slow: f64,
    unit: Coordinate,
    at: impl Fn(&mut Continuation) -> Result<Cycle, E>,
) -> Result<(Cycle, bool), RmsError<E>> {
    let mut asked = Continuation::default();
    let free = at(&mut asked).map_err(RmsError::Move)?;
    let Some(rms) = rms else {
        return Ok((free, false));
    };
    let over = |cycle: &Cycle| cycle.load.rms / rms.of(&cycle.load) - 1.0;
    let limit = rms.of(&free.load);
    let mut cheap = [0.0, over(&free)];
    if cheap[1] <= ROUNDING {
        return Ok((free, false));
    }
    let mut try_at = |share: f64, is_beside: bool| {
        asked.price = Some(price(share, limit, slow));
        asked.is_beside = is_beside;
        at(&mut asked)
    };
    let mut least = free.load.rms;
    let mut best = None;
    let mut stopped = false;
    for share in SHARES {
        let found = match try_at(share, false) {
            Ok(found) => found,
            // Where time has hardly any price, or a negative one, a slowest motion may not exist.
            Err(_) if cheap[0] > 0.0 => {
                stopped = true;
                break;
            }
            Err(why) => return Err(RmsError::Move(why)),
        };
        let own = [share, over(&found)];
        if own[1] <= 0.0 {
            best = Some((own, found));
            break;
        }
        least = least.min(found.load.rms);
        cheap = own;
    }
    let Some((mut dear, mut best)) = best else {
        return Err(RmsError::Limit(NoMotion::RmsTooLarge {
            rms: least,
            allowed: limit,
            slow,
            stopped,
            unit,
        }));
    };
    let mut last = dear;
    let mut slope = (dear[1] - cheap[1]) / (dear[0] - cheap[0]);
    for step in 0..STEPS {
        if dear[1] >= -UNUSED[0] {
            break;
        }
        let is_beside = last[1].abs() <= NEAR;
        // The secant's point, moved slightly to the expensive side; the midpoint where it leaves the interval, and every fourth time.
        let secant = last[0] - (last[1] + 0.5 * UNUSED[0]) / slope;
        let is_inside = secant > cheap[0] && secant < dear[0];
        let next = if is_inside && (is_beside || step % 4 != 3) {
            secant
        } else {
            cheap[0].midpoint(dear[0])
        };
        if next <= cheap[0] || next >= dear[0] {
            break;
        }
        let found = match try_at(next, is_beside) {
            Ok(found) => found,
            // Within the limit and hardly below it: this is the result.
            Err(_) if dear[1] >= -UNUSED[1] => break,
            Err(why) => return Err(RmsError::Move(why)),
        };
        let own = [next, over(&found)];
        // The RMS torque falls with the share; a rise is rounding.
        let fall = (own[1] - last[1]) / (own[0] - last[0]);
        if fall < 0.0 {
            slope = fall;
        }
        last = own;
        if own[1] <= 0.0 {
            (dear, best) = (own, found);
        } else {
            cheap = own;
        }
    }
    Ok((best, true))
}
