//! Quantities: their units, the names of their kinds, and the display of figures.
//!
//! A [`unit`](mod@unit) consists of words with powers. A [`quantity`] is a number with a unit of the required [`kind`]; a [`literal`] is one of any
//! kind. A [`Fault`] tells why a text cannot be read, with a cure. A [`Vocabulary`] tells whether a figure is a torque or a force, an inertia or a
//! mass. Nothing here depends on files, machines or catalogues.

use std::f64::consts::PI;

mod fault;
pub mod kind;
pub mod literal;
pub mod quantity;
pub mod unit;
mod vocabulary;
mod word;

pub use fault::{Fault, closest, did_you_mean, nearest};
pub(crate) use fault::{known, meant};
pub use vocabulary::{Sentence, Term, Vocabulary};
pub use word::Dimension;

/// One revolution per minute in rad/s.
pub const RPM: f64 = PI / 30.0;

/// One degree in rad.
pub const DEGREE: f64 = PI / 180.0;

/// One minute of arc in rad.
pub const ARCMIN: f64 = PI / 10_800.0;
