//! Numbers: the types that all computations use.
//!
//! The lowest layer: angles, per-unit scales and derivatives, and the numbers of a tick.
//!
//! Fixed-point numbers are per-unit, in [−1, 1); the [`Scale`] of the model defines 1. The formats make every product of a tick the upper half of a
//! 32 × 32-bit product (one instruction on a Cortex-M4 and up), and prevent wrapping:
//!
//! | | [`Q31`](crate::Q31) | 1 is |
//! |---|---|---|
//! | J, b | Q30 | 2³⁰ |
//! | load, c, sums of torques | Q29 | 2²⁹ |
//! | seed of 1/J | Q31 | 2³¹ |
//! | ω, α, T: arguments and results, each with its own type | Q31 | 2³¹ |
//!
//! Products round towards −∞. An overflow inside a cell, or in a sum of torques at full speed and acceleration, is refused when table and model are
//! created, so that inverse dynamics cannot saturate. Forward dynamics can, and reports it.

pub(crate) mod error;
mod factor;
mod fence;
mod friction_sign;
mod kernel;
#[cfg(feature = "mechanics")]
#[allow(
    clippy::indexing_slicing,
    reason = "mechanisms solve systems, ticks do not"
)]
pub(crate) mod linear;
pub(crate) mod phase;
#[deny(clippy::float_arithmetic)]
mod product;
pub(crate) mod q15;
pub(crate) mod q31;
#[cfg(feature = "mechanics")]
pub(crate) mod quadrature;
pub(crate) mod quantity;
mod quotient;
mod role;
pub(crate) mod scalar;
pub(crate) mod scale;
pub(crate) mod spline;
pub(crate) mod transfer;

pub use crate::math::Real;
pub use error::{Cure, RangeError};
pub(crate) use kernel::{Kernel, Ring};

pub(crate) use factor::Factor;
pub(crate) use fence::fence;
pub use friction_sign::FrictionSign;
pub(crate) use product::{high, signed_words, upper_of_sum};
pub use quantity::Quantity;
pub use role::Role;
pub(crate) use scalar::Outcome;
pub use scalar::{Number, Scalar};
pub use scale::Bases;
pub(crate) use scale::Scale;
pub use transfer::Transfer;
