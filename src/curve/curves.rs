//! Which curves a table has beside the reduced inertia, as a bit set.
//!
//! The set is part of a table's type: curves that a machine does not have cost neither memory nor instructions.

/// Only J_red.
pub const INERTIA: u8 = 0;
/// The part of the reduced torque that does not depend on ω: −U′ + process.
pub const LOAD: u8 = 1;
/// b in −b·ω.
pub const VISCOUS: u8 = 2;
/// c in −c·sgn ω. The tick takes the curve's magnitude, so that a friction force F on a link with velocity v is stored as
/// F·v′, which is smooth where |v′| has a kink.
pub const COULOMB: u8 = 4;
/// Every curve that a machine can have.
pub const ALL: u8 = LOAD | VISCOUS | COULOMB;
/// A seed of 1/J, with which fixed-point forward dynamics does without a division. Fixed point only.
pub const RECIPROCAL: u8 = 8;
/// A constant that adds to b: one number instead of a curve.
pub const CONSTANT_VISCOUS: u8 = 16;
/// A constant that adds to c.
pub const CONSTANT_COULOMB: u8 = 32;
/// Every bit.
pub const EVERY: u8 = ALL | RECIPROCAL | CONSTANT_VISCOUS | CONSTANT_COULOMB;

/// Curves in a row: J_red and one for each curve of the set, in the order of their bits.
#[must_use]
pub const fn width(set: u8) -> usize {
    1 + (set & (ALL | RECIPROCAL)).count_ones() as usize
}

/// What a curve of a table stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// J_red
    Inertia,
    /// −U′ + process
    Load,
    /// b
    Viscous,
    /// c, signed
    Coulomb,
    /// J_m/J with J_m the power of two (in per-unit) below the least J
    Reciprocal,
}

/// The curves of a row, by column.
pub(crate) fn roles(set: u8) -> impl Iterator<Item = (usize, Role)> {
    let all = [
        Role::Inertia,
        Role::Load,
        Role::Viscous,
        Role::Coulomb,
        Role::Reciprocal,
    ];
    all.into_iter()
        .filter_map(move |role| Some((role.column(set)?, role)))
}

impl Role {
    const fn bit(self) -> u8 {
        match self {
            Self::Inertia => 0,
            Self::Load => LOAD,
            Self::Viscous => VISCOUS,
            Self::Coulomb => COULOMB,
            Self::Reciprocal => RECIPROCAL,
        }
    }

    /// Position in a row of the set; `None` if the set has no such curve.
    pub(crate) const fn column(self, set: u8) -> Option<usize> {
        let bit = self.bit();
        if bit == 0 {
            Some(0)
        } else if set & bit == 0 {
            None
        } else {
            Some(width(set & (bit - 1)))
        }
    }
}
