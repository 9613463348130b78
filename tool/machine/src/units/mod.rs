//! Quantities: the units they are written in, what each kind of them is called, and how a figure is named and shown.
//!
//! A [`unit`](mod@unit) is made of words with powers; a [`quantity`] is a number with a unit, of the [`kind`] that is asked for; a
//! [`literal`] is one of any kind. What cannot be read is a [`Fault`] with its cure. A [`Vocabulary`] says whether a figure is a torque or a
//! force, an inertia or a mass. Nothing here knows files, machines or catalogues.

use std::f64::consts::PI;

mod fault;
pub mod kind;
pub mod literal;
pub mod quantity;
pub mod unit;
mod vocabulary;
mod word;

pub use fault::{Fault, closest, did_you_mean};
pub(crate) use fault::{known, meant};
pub use vocabulary::{Sentence, Term, Vocabulary};
pub use word::Dimension;

/// rad/s of one revolution per minute.
pub const RPM: f64 = PI / 30.0;

/// rad of one degree.
pub const DEGREE: f64 = PI / 180.0;

/// rad of one minute of arc.
pub const ARCMIN: f64 = PI / 10_800.0;
