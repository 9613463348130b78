//! Tables.
mod spline;
pub use spline::{CubicSpline, MIN_CELLS, control_points, fit_bounded, fit_periodic};
