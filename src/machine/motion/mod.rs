//! Motion laws and moves of the drive link.

mod characteristic;
mod law;
mod polynomial;
mod sine_constant_cosine;

pub use characteristic::Characteristic;
pub use law::Law;
pub use polynomial::{End, Polynomial};

use crate::math::Real;
use crate::number::error::RangeError;

/// Position, speed and acceleration of the drive link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct State<R> {
    /// φ (rad, or m)
    pub phi: R,
    /// ω (rad/s, or m/s)
    pub omega: R,
    /// α (rad/s², or m/s²)
    pub alpha: R,
}

/// A move over a distance in a given time by a motion law; a distance of zero is a dwell.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Move<R> {
    law: Law<R>,
    start: R,
    distance: R,
    duration: R,
}

impl<R: Real> Move<R> {
    /// A move from `start` over `distance` (rad) in `duration` (s).
    ///
    /// # Errors
    /// A duration that is not positive, a value that is not finite, or an invalid law.
    #[inline] // see `Law::check`
    pub fn new(law: Law<R>, start: R, distance: R, duration: R) -> Result<Self, RangeError> {
        let zero = R::from_f64(0.0);
        for (what, value) in [
            ("start of the move", start),
            ("distance of the move", distance),
            ("duration of the move", duration),
        ] {
            if !value.is_finite() {
                return Err(RangeError::NotFinite(what));
            }
        }
        if duration <= zero {
            return Err(RangeError::NotPositive(
                "duration of the move",
                duration.to_f64(),
            ));
        }
        law.check()?;
        Ok(Self {
            law,
            start,
            distance,
            duration,
        })
    }

    /// Duration (s).
    pub const fn duration(&self) -> R {
        self.duration
    }

    /// Distance (rad).
    pub const fn distance(&self) -> R {
        self.distance
    }

    /// The law.
    pub const fn law(&self) -> Law<R> {
        self.law
    }

    /// The state at `t` (s) after the start; before and after the move it rests at the ends.
    #[must_use]
    pub fn at(&self, t: R) -> State<R> {
        let [s, v, a] = self.law.at(t / self.duration);
        let speed = self.distance / self.duration;
        State {
            phi: self.start + self.distance * s,
            omega: speed * v,
            alpha: speed / self.duration * a,
        }
    }
}
