//! Tables and ticks in 16 bits, for processors without a long multiplication (Cortex-M0, M0+).
//!
//! The same equation as [`Model`](crate::Model), in per-unit numbers [`Q15`](crate::Q15):
//!
//! ```text
//! inverse:  T = J(φ)·α + (V(φ)·ω + b(φ))·ω − load(φ) + c(φ)·sgn ω,      V = ½·J′·ω_b²/T_b
//! forward:  α = (T − (V(φ)·ω + b(φ))·ω + load(φ) − c(φ)·sgn ω)/J(φ)
//! ```
//!
//! J and load are quadratics in every cell, made from uniform quadratic splines, V is the slope of J's: all three are
//! continuous but for the rounding of their numbers, a unit of 2⁻¹⁵ or two. b, c and 1/J are straight lines from knot to knot. A
//! [`Scale::limited_to`](crate::Scale::limited_to) makes the best of 16 bits.
//!
//! The way is the same as elsewhere: [`tabulate`] finds the smallest table for a torque error, [`Model`] ticks it,
//! [`encode`] makes an image of it that [`Image::short_model`](crate::Image::short_model) reads.

mod check;
mod fill;
mod fit;
mod image;
#[deny(clippy::float_arithmetic)]
mod kernel;
mod measure;
#[deny(clippy::float_arithmetic)]
mod model;
#[deny(clippy::float_arithmetic)]
mod row;
mod search;
mod table;

pub use check::usage;
pub use fill::{fill, scratch_len};
pub use image::{encode, image_words};
pub use measure::measure;
pub use model::Model;
pub use row::row_words;
pub use search::tabulate;
pub use table::{Constants, CurveValues, Table, words_len};
