//! The source of tables: the curves of a machine at any place of its range.

use super::curves::CurveSet;
use crate::{Domain, Scale};

/// The curves at one place, in machine units.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// J_red
    pub(crate) inertia: f64,
    /// −U′ + process
    pub(crate) load: f64,
    /// b
    pub(crate) viscous: f64,
    /// c
    pub(crate) coulomb: f64,
}

/// The curves that a table of this many cells is made from.
#[derive(Clone, Copy, Debug)]
pub struct Samples<F> {
    pub(crate) set: CurveSet,
    pub(crate) cells: u32,
    pub(crate) domain: Domain,
    pub(crate) scale: Scale,
    /// The curves at a place of the range, 0 to 1.
    pub(crate) at: F,
}

impl<F> Samples<F> {
    /// The curves at a place, in cells from the start.
    pub(crate) fn at_cell<E>(&self, cell: f64) -> Result<Sample, E>
    where
        F: Fn(f64) -> Result<Sample, E>,
    {
        (self.at)(cell / f64::from(self.cells))
    }

    /// Whether the curves are periodic over the range.
    pub(crate) fn periodic(&self) -> bool {
        matches!(self.domain, Domain::Turn)
    }
}
