//! What a curve stands for: in fixed point each has a format of its own.

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
