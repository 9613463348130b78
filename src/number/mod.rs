//! Numbers: the types that everything else computes with.
//!
//! Fixed point numbers are per-unit, in [−1, 1). The [`Scale`] of the model says what 1 means. Formats are chosen
//! so that every product of a tick is the upper half of a 32 × 32-bit product (one instruction on a Cortex-M4 and up) and
//! nothing can wrap:
//!
//! | | [`Q31`] | 1 is |
//! |---|---|---|
//! | J, b | Q30 | 2³⁰ |
//! | load, c, sums of torques | Q29 | 2²⁹ |
//! | seed of 1/J | Q31 | 2³¹ |
//! | ω, α, T: arguments and results | Q31 | 2³¹ |
//!
//! Products round towards −∞. An overflow inside a cell, or in a sum of torques at full speed and acceleration, is refused when
//! table and model are built; so inverse dynamics cannot saturate. Forward dynamics can, and reports it.

pub(crate) mod error;
mod kernel;
#[allow(
    clippy::indexing_slicing,
    reason = "mechanisms solve systems, ticks do not"
)]
pub(crate) mod linear;
pub(crate) mod phase;
#[deny(clippy::float_arithmetic)]
mod product;
mod q15;
mod q31;
pub(crate) mod quadrature;
mod role;
mod scalar;
mod scale;
pub(crate) mod transfer;

pub use error::{Cure, RangeError};
pub(crate) use kernel::{Kernel, Ring};
pub use phase::{Domain, Phase};
pub use q15::Q15;
pub use q31::Q31;
pub use role::Role;
pub use scalar::{Number, Outcome, Scalar};
pub use scale::Scale;
pub use transfer::Transfer;
