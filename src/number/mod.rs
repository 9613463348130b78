//! Numbers: what everything else computes with.

pub(crate) mod linear;
pub(crate) mod quadrature;
pub(crate) mod transfer;

pub use transfer::Transfer;
