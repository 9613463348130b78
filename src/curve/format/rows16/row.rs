//! Packing of a row of 16-bit numbers.
//!
//! Words in this order; a row has the words of its set of [`curves`]. Upper half : lower half, signed 16-bit numbers except J₀.
//!
//! | word | of the set | content | units |
//! |---|---|---|---|
//! | g₁ : g₂ | `LOAD` | −load(u) = g₀ + g₁·u + g₂·u² | 2⁻¹⁵ |
//! | j₁ : j₂ | always | J(u) = J₀ + j₁·u + j₂·u² | 2⁻¹⁶ |
//! | v₀ : v₁ | always | V(u) = v₀ + v₁·u, the velocity torque at ω = 1 | 2⁻¹⁵ |
//! | J₀ : g₀ | always | J₀ unsigned; g₀ is 0 without `LOAD` | 2⁻¹⁶, 2⁻¹⁵ |
//! | b₀ : b₁ | `VISCOUS` | b(u) = b₀ + b₁·u | 2⁻¹⁵ |
//! | c₀ : c₁ | `COULOMB` | c(u) = c₀ + c₁·u, of which the tick uses the magnitude | 2⁻¹⁵ |
//! | r₀ : r₁ | `RECIPROCAL` | 1/J(u) = (r₀ + r₁·u)/2ᵏ | 1 |
//!
//! u is the place in the cell, 0 to 1. Every lower half, read as an unsigned fraction of a unit, also adds to the upper half of its word.

use crate::curve::curves::{self, CurveSet, has};

/// Words of a row.
pub(super) const fn length(set: CurveSet) -> usize {
    super::ROW.pitch(set)
}

/// Index of the line of J.
pub(super) const fn inertia(set: CurveSet) -> usize {
    has(set, curves::LOAD) as usize
}

/// Index of the line of V.
pub(super) const fn velocity(set: CurveSet) -> usize {
    inertia(set) + 1
}

/// Index of the starts of J and of the load.
pub(super) const fn start(set: CurveSet) -> usize {
    inertia(set) + 2
}

/// Index of the line of b, if the set has it.
pub(super) const fn viscous(set: CurveSet) -> usize {
    inertia(set) + 3
}

/// Index of the line of c, if the set has it.
pub(super) const fn coulomb(set: CurveSet) -> usize {
    viscous(set) + has(set, curves::VISCOUS) as usize
}

/// Index of the line of 1/J, if the set has it.
pub(super) const fn reciprocal(set: CurveSet) -> usize {
    coulomb(set) + has(set, curves::COULOMB) as usize
}

/// A word from two halves.
pub(super) const fn word(upper: u16, lower: u16) -> u32 {
    (upper as u32) << 16 | lower as u32
}

/// The rows of a table.
pub(super) type Rows<'a> = crate::curve::format::Rows<'a, u32, 3, 4, 5, 6, 7>;

/// A word of a row; 0 beyond its end, where the compiler sees no read.
#[inline(always)]
pub(super) fn at(row: &[u32], index: usize) -> u32 {
    row.get(index).copied().unwrap_or(0)
}
