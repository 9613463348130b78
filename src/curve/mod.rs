//! The curves of the reduced machine as words in RAM or in flash: their meaning, and how they are created, checked and evaluated.
//!
//! A [`Table`] is a run of words and their [`Shape`]; its [`Format`] defines the evaluation, its set of [`curves`] the contents.

pub mod curves;
mod error;
mod format;
mod samples;
mod table;
mod unfold;
mod usage;

pub use curves::CurveSet;
pub use error::TableError;
#[cfg(all(feature = "mechanics", feature = "micromath"))]
pub(crate) use format::COEFFICIENTS;
pub(crate) use format::CONSTANTS;
#[cfg(feature = "mechanics")]
pub(crate) use format::in_use;
pub use format::{
    AccelerationOf, Circular, Coefficient, Constants, Cubic, Curve, Format, Harmonic, Kind,
    MAX_HARMONICS, MotorTorqueOf, Quadratic, RowConstants, Rows16, SpeedOf, Spline, Spline16,
    TorqueOf, terms,
};
#[cfg(feature = "micromath")]
pub use format::{CrankCoefficient, STEEPEST, SliderCrankForm, crank_terms};
#[cfg(feature = "mechanics")]
pub(crate) use samples::{Sample, Samples};
pub use table::{CellCurves, CurveValues, MAX_CELLS, Shape, Table, words_len};
pub(crate) use unfold::unfold;
pub use usage::Usage;
