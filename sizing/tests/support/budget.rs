//! Every tolerance of the tool's tests, each with its reason. All are bounds on |found − expected|, so both signs
//! count; what a test measured is in brackets.

/// Closed forms of some tens of operations on both sides, relative to the column's largest [3e-16].
pub(crate) const CLOSED_FORM: f64 = 1e-12;
pub(crate) const DIFFERENCES: f64 = 1e-9;
pub(crate) const SECOND_DIFFERENCES: f64 = 1e-5;
pub(crate) const DERIVATION: f64 = 1e-9;
pub(crate) const QUADRATURE: f64 = 1e-9;
pub(crate) const DEFAULT_STEPS: f64 = 1e-6;
pub(crate) const DEFAULT_PEAK: f64 = 1e-5;
pub(crate) const FINE_STEPS: f64 = 1e-9;
pub(crate) const HOLDING_GRID: f64 = 2e-5;
pub(crate) const ORDER: f64 = 0.3;
