//! The curves of a table in addition to the reduced inertia, as a bit set.
//!
//! The set is part of a [`Model`](crate::Model)'s type: absent curves cost neither memory nor instructions. A friction is a curve or a constant, not
//! both.

use crate::number::Role;

/// A set of curves: `LOAD | CONSTANT_VISCOUS`.
///
/// An alias of an integer, because the set is a const parameter of [`Model`](crate::Model): stable Rust accepts only integers there, and operators
/// of a type of its own are not `const`. With such a type a program would write `{ PRESS.bits() }` in every type. A wrong set is refused instead:
/// [`Image::model`](crate::Image::model) compares it with the table, and
/// [`Image::bytes_are_of`](crate::Image::bytes_are_of) does so when the program is compiled.
pub type CurveSet = u16;

/// Only J_red.
pub const INERTIA: CurveSet = 0;
/// The part of the reduced torque that does not depend on ω: −U′ + process.
pub const LOAD: CurveSet = 1;
/// b in −b·ω.
pub const VISCOUS: CurveSet = 2;
/// c in −c·sgn ω. The tick uses the curve's magnitude: a friction force F on a link with velocity v is stored as F·v′, which is smooth where |v′| has
/// a kink.
pub const COULOMB: CurveSet = 4;
/// Every curve that a machine can have.
pub const ALL: CurveSet = LOAD | VISCOUS | COULOMB;
/// A seed of 1/J, so that fixed-point forward dynamics needs no division. Fixed point only.
pub const RECIPROCAL: CurveSet = 8;
/// A constant b: one number instead of a curve.
pub const CONSTANT_VISCOUS: CurveSet = 16;
/// A constant c.
pub const CONSTANT_COULOMB: CurveSet = 32;

/// Curves in a row: J_red and one for each curve of the set, in the order of their bits.
#[must_use]
pub const fn width(set: CurveSet) -> usize {
    1 + (set & (ALL | RECIPROCAL)).count_ones() as usize
}

/// Whether the set contains this curve.
pub(crate) const fn has(set: CurveSet, curve: CurveSet) -> bool {
    set & curve != 0
}

/// Whether a table of polynomials can have this set: no unknown bit, and no friction as both curve and constant.
pub(crate) const fn is_known(set: CurveSet) -> bool {
    set <= (ALL | RECIPROCAL | CONSTANT_VISCOUS | CONSTANT_COULOMB)
        && !(has(set, VISCOUS) && has(set, CONSTANT_VISCOUS))
        && !(has(set, COULOMB) && has(set, CONSTANT_COULOMB))
}

/// The curves of a row, by column.
pub(crate) fn roles(set: CurveSet) -> impl Iterator<Item = (usize, Role)> {
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
    const fn bit(self) -> CurveSet {
        match self {
            Self::Inertia => 0,
            Self::Load => LOAD,
            Self::Viscous => VISCOUS,
            Self::Coulomb => COULOMB,
            Self::Reciprocal => RECIPROCAL,
        }
    }

    /// Position in a row of the set; `None` if the set does not contain the curve.
    pub(crate) const fn column(self, set: CurveSet) -> Option<usize> {
        let bit = self.bit();
        if bit == 0 {
            Some(0)
        } else if set & bit == 0 {
            None
        } else {
            Some(width(set & (bit - 1)))
        }
    }

    /// The base to enlarge when a curve does not fit.
    pub(crate) const fn base(self) -> &'static str {
        match self {
            Self::Inertia => "inertia",
            _ => "torque",
        }
    }
}
