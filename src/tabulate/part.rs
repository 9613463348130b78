//! A part of a machine's range, tabulated separately.

use crate::machine::{PoseError, Reducible, Reduction};
use crate::number::error::{RangeError, finite};
use core::f64::consts::TAU;

use crate::{Domain, math};

/// A part of a machine's range, as a stroke from 0 to its length: the source of one table of [`Pieces`](crate::Pieces).
///
/// Positions count from the part's start, so that even a short length keeps all digits in single precision.
#[derive(Debug)]
pub struct Part<'m, M> {
    machine: &'m M,
    from: f64,
    to: f64,
}

// A part only refers to its machine: `M` need not be `Clone`.
impl<M> Clone for Part<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Part<'_, M> {}

/// Margin of a part's first and last place to its ends, as a share of the machine's range: a unit of a [`Phase`](crate::Phase). The end belongs to
/// the next part, and the start may be rounded into the previous one.
const INSIDE: f64 = 1.0 / 4_294_967_296.0;

impl<'m, M: Reducible> Part<'m, M> {
    /// The part from the position `from` to `to` (rad, or m).
    ///
    /// # Errors
    /// A position that is not finite, `to` not greater than `from`, or more than a turn.
    pub fn new(machine: &'m M, from: f64, to: f64) -> Result<Self, RangeError> {
        let from = finite("start of the part", from)?;
        let to = finite("end of the part", to)?;
        let span = machine.domain().span();
        // A turn from one position to the same position a turn later may be rounded up.
        if !(to > from && to - from <= span * (1.0 + 1e-12)) {
            return Err(RangeError::OutOfRange {
                what: "length of the part",
                value: to - from,
                min: 0.0,
                max: span,
            });
        }
        Ok(Self { machine, from, to })
    }

    /// Whether the machine's drive link turns, so that a part may continue into the next turn.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.machine.domain() == Domain::Turn
    }

    /// Start in the machine's range (rad, or m).
    #[must_use]
    pub const fn start(&self) -> f64 {
        self.from
    }
}

impl<M: Reducible> Reducible for Part<'_, M> {
    fn domain(&self) -> Domain {
        Domain::Stroke {
            from: 0.0,
            to: self.to - self.from,
        }
    }

    fn edge(&self, k: usize) -> Option<f64> {
        let edge = self.machine.edge(k)? - self.from;
        // An edge within this margin before the start counts as the start.
        let hair = INSIDE * TAU;
        Some(match self.machine.domain() {
            Domain::Turn => (edge - TAU * math::floor((edge + hair) / TAU)).max(0.0),
            Domain::Stroke { .. } => edge,
        })
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let margin = INSIDE * self.machine.domain().span();
        // Not `clamp`, which panics if rounding swaps the ends of a very short part.
        let phi = (self.from + phi)
            .max(self.from + margin)
            .min(self.to - margin);
        self.machine.reduction(phi)
    }
}
