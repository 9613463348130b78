//! The largest error of a table, proven: a machine's curves enclosed in intervals at all positions, compared with the exact polynomials of the
//! table's words.
//!
//! ```text
//! joints ──► places ──► curves ──► difference to each cell ──► bound
//! (closure)  Taylor series in intervals: J, J′, load, b, c    by halving
//! ```
//!
//! A sampled error gives no information between two places. Here every number is an [`Interval`], rounded outward, and every quantity of the machine
//! a Taylor polynomial with Lagrange's remainder over a stretch of positions ([`TaylorForm`]): the pose of the links is proven by the interval Newton
//! method ([`Closure`]), their motion follows from the equations of the joints, and the curves follow from the motion ([`Curves`]). A stretch whose
//! remainder is too large is halved. [`prove`] bounds
//!
//! ```text
//! |δT| ≤ |δJ|·α_max + ½·|δJ′|·ω_max² + |δload| + |δb|·ω_max + |δc|
//! ```
//!
//! for every position of the range. To the bound of the exactly evaluated table it adds the rounding of the tick.
#![forbid(unsafe_code)]

mod closure;
mod curves;
mod difference;
mod equation;
mod error;
mod interval;
mod link_frame;
mod matrix;
mod proof;
mod series;
mod taylor_form;
mod tick;

pub use closure::Closure;
pub use curves::{Curves, Parts, factor};
pub use error::ProofError;
pub use interval::Interval;
pub use link_frame::LinkFrame;
pub use proof::{Goal, Proof, prove};
pub use series::{REMAINDER, Series, TERMS};
pub use taylor_form::TaylorForm;
