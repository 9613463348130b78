//! A force or a moment over a position: of the drive link, or a coordinate of a point.

use std::f64::consts::TAU;

use jred::machine::{Frame, Mechanism as _, PoseError};
use jred::number::Transfer;

use crate::model::mechanism::AnyMechanism;
use crate::number::numerics;
use crate::number::parabola::peak;
use crate::number::spline::Spline;

/// Number of parts of the drive link's range in each of which a point turns back or passes a row at most once.
const PLACES: u32 = 1440;

/// The variable of a table's rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TableVariable {
    /// The position of the drive link.
    Drive,
    /// x or y of a point, relative to a zero.
    Point {
        /// Index of its link.
        link: usize,
        /// The point in the link's frame (m).
        at: [f64; 2],
        /// 0: x, 1: y.
        axis: usize,
        /// The coordinate (m) at which the rows are zero.
        zero: f64,
    },
}

impl TableVariable {
    /// Its value with the links at `frames`.
    fn value(self, phi: f64, frames: &[Frame]) -> Transfer {
        match self {
            Self::Drive => Transfer::variable(phi),
            Self::Point {
                link,
                at,
                axis,
                zero,
            } => {
                let frame = frames.get(link).unwrap_or(&Frame::GROUND);
                let mut coordinate = frame.point(at)[axis % 2];
                coordinate.value -= zero;
                coordinate
            }
        }
    }

    /// The same at a position of the drive link.
    fn at(self, mechanism: &AnyMechanism, phi: f64) -> Result<f64, PoseError> {
        Ok(self.value(phi, &mechanism.frames(phi)?).value)
    }

    /// Its least and its largest value over the range of the drive link.
    ///
    /// # Errors
    /// The mechanism cannot be placed.
    pub fn range(self, mechanism: &AnyMechanism) -> Result<[f64; 2], PoseError> {
        let domain = mechanism.domain();
        let place = |k: u32| domain.position(f64::from(k) / f64::from(PLACES));
        let extreme = |sign: f64| {
            let value = |phi: f64| Ok::<_, PoseError>(sign * self.at(mechanism, phi)?);
            let mut most = (0, f64::NEG_INFINITY);
            for k in 0..=PLACES {
                let here = value(place(k))?;
                if here > most.1 {
                    most = (k, here);
                }
            }
            let middle = most.0.clamp(1, PLACES - 1);
            let at = peak(value, [middle - 1, middle, middle + 1].map(place))?;
            Ok::<_, PoseError>(sign * value(at)?.max(most.1))
        };
        Ok([extreme(-1.0)?, extreme(1.0)?])
    }

    /// The drive link's positions at which it passes one of these values.
    ///
    /// # Errors
    /// The mechanism cannot be placed.
    pub fn passes(self, mechanism: &AnyMechanism, values: &[f64]) -> Result<Vec<f64>, PoseError> {
        if self == Self::Drive {
            return Ok(values.to_vec());
        }
        let domain = mechanism.domain();
        let mut found = Vec::new();
        for &value in values {
            let below = |phi: f64| Ok::<_, PoseError>(self.at(mechanism, phi)? < value);
            let mut last = (domain.position(0.0), below(domain.position(0.0))?);
            for k in 1..=PLACES {
                let phi = domain.position(f64::from(k) / f64::from(PLACES));
                let here = (phi, below(phi)?);
                if here.1 != last.1 {
                    let as_before = |phi: f64| Ok::<_, PoseError>(below(phi)? == last.1);
                    found.push(numerics::edge(as_before, last.0, phi)?);
                }
                last = here;
            }
        }
        found.sort_by(f64::total_cmp);
        Ok(found)
    }
}

/// A force or a moment over a position. Outside its rows it has the value of the nearest one.
#[derive(Clone, Debug)]
pub struct LoadTable {
    curve: Spline,
    over: TableVariable,
    /// Number of turns of the drive link after which the rows repeat; 0: never.
    turns: u32,
}

impl LoadTable {
    /// A curve over a part of its variable that begins and ends with zero and repeats after this number of turns of the drive link (0: never).
    pub fn new(curve: Spline, over: TableVariable, turns: u32) -> Self {
        Self {
            turns: if over == TableVariable::Drive {
                turns
            } else {
                0
            },
            curve,
            over,
        }
    }

    /// A curve over the whole range of its variable.
    pub const fn whole(curve: Spline, over: TableVariable) -> Self {
        Self {
            curve,
            over,
            turns: 0,
        }
    }

    /// Its curve, its variable, and whether it repeats with the turns of the drive link.
    pub const fn parts(&self) -> (&Spline, TableVariable, bool) {
        (&self.curve, self.over, self.turns > 0)
    }

    /// The force with three derivatives by φ, with the links at `frames`.
    pub(super) fn at(&self, phi: f64, frames: &[Frame]) -> Transfer {
        let mut place = self.over.value(phi, frames);
        let [from, to] = self.curve.range();
        if self.turns > 0 {
            let period = f64::from(self.turns) * TAU;
            place.value -= ((place.value - from) / period).floor() * period;
            if place.value > to {
                return Transfer::constant(0.0);
            }
        }
        let [value, d1, d2, d3] = self.curve.at(place.value);
        Transfer { value, d1, d2, d3 }.after(place)
    }
}
