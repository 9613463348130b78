//! Used share of a table's number range.

use super::{Format, Table, TableError};

/// Largest used share of the number range for each quantity, over all phases and at full speed and acceleration: 1 is all of it in fixed point. In
/// floating point it is the quantity itself, in machine units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Usage {
    /// J
    pub inertia: f32,
    /// ½·J′·ω²
    pub velocity: f32,
    /// −U′ + process
    pub load: f32,
    /// b·ω
    pub viscous: f32,
    /// c
    pub coulomb: f32,
    /// The sum of all: the torque.
    pub torque: f32,
}

impl Usage {
    /// Usage of a table.
    ///
    /// # Errors
    /// The first cell in which a quantity does not fit, as for [`Model::new`](crate::Model::new).
    pub fn of<F: Format>(table: &Table<'_, F>) -> Result<Self, TableError> {
        F::usage(table)
    }

    /// The larger of each.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            inertia: self.inertia.max(other.inertia),
            velocity: self.velocity.max(other.velocity),
            load: self.load.max(other.load),
            viscous: self.viscous.max(other.viscous),
            coulomb: self.coulomb.max(other.coulomb),
            torque: self.torque.max(other.torque),
        }
    }
}
