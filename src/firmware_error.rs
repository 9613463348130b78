//! All errors of a program with a finished table, in one type.

use core::fmt;

use crate::axis::AxisError;
use crate::axis::plan::PlanError;
use crate::curve::TableError;
use crate::number::error::{Curable, error};
use crate::tick::ImageError;
use crate::tick::duty::LimitError;

/// Why firmware with a finished table cannot start: the errors of image, table, axis, plan and duty meter in one type, so that all of them end in `?`.
///
/// No tick returns it. No message needs floating-point formatting.
///
/// ```
/// use jred::axis::{FeedForward, Period, TorqueLimits};
/// use jred::{CurveSet, FirmwareError, Image, Model, Spline, curves, include_image};
///
/// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
///
/// fn main() -> Result<(), FirmwareError> {
///     let image = Image::from_bytes(include_image!("../examples/data/press_f32.jred"))?;
///     let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
///     let tick = Period::new(0.000_5, &press)?;
///     let limits = TorqueLimits::new(-12.0, 12.0)?;
///     let feed_forward = FeedForward::new(press, image.validity());
/// #   let _ = (tick, limits, feed_forward);
///     Ok(())
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FirmwareError {
    /// An image that is refused.
    Image(ImageError),
    /// A table that cannot be ticked.
    Table(TableError),
    /// A figure of the axis that does not fit.
    Axis(AxisError),
    /// A plan that is refused.
    Plan(PlanError),
    /// A limit of the duty meter that does not fit.
    Limit(LimitError),
}

error!(
    FirmwareError,
    Table(TableError),
    Axis(AxisError),
    Limit(LimitError)
);

impl From<ImageError> for FirmwareError {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Table(error) => Self::Table(error),
            other => Self::Image(other),
        }
    }
}

impl From<PlanError> for FirmwareError {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Image(error) => error.into(),
            PlanError::Axis(error) => Self::Axis(error),
            other => Self::Plan(other),
        }
    }
}

impl fmt::Display for FirmwareError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Image(error) => error.fmt(f),
            Self::Table(error) => error.fmt(f),
            Self::Axis(error) => error.fmt(f),
            Self::Plan(error) => error.fmt(f),
            Self::Limit(error) => error.fmt(f),
        }
    }
}

impl Curable for FirmwareError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Image(error) => error.write_cure(f),
            Self::Table(error) => error.write_cure(f),
            Self::Axis(error) => error.write_cure(f),
            Self::Plan(error) => error.write_cure(f),
            Self::Limit(error) => error.write_cure(f),
        }
    }
}
