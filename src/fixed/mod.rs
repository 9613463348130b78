//! Fixed point: per-unit numbers in [−1, 1).
//!
//! What 1 stands for is said by the [`Scale`](crate::Scale) of the model. Formats are chosen so that every product of a
//! tick is the upper half of a 32 × 32-bit product (one instruction on a Cortex-M4 and up) and nothing can wrap:
//!
//! | | [`Q31`] | 1 is |
//! |---|---|---|
//! | J, b | Q30 | 2³⁰ |
//! | load, c, sums of torques | Q29 | 2²⁹ |
//! | seed of 1/J | Q31 | 2³¹ |
//! | ω, α, T: arguments and results | Q31 | 2³¹ |
//!
//! Products round towards −∞. What could overflow inside a cell, or in a sum of torques at full speed and
//! acceleration, is refused when table and model are built; so inverse dynamics cannot saturate. Forward dynamics can, and says so.

mod product;

mod q15;
mod q31;

pub use q15::Q15;
pub use q31::Q31;
