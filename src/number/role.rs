//! The role of a curve: in fixed point each role has its own format.

/// The role of a curve of a table.
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
