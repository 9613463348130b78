//! Explains the verdict of a drive: contributions to its torque and inertia, and the changes that would make it suitable.

mod breakdown;
mod contributions;
mod course;
mod duty_model;
mod remedy;
mod seek;

pub use breakdown::{Breakdown, InertiaShare, Share};
pub use contributions::{Contribution, Contributions, Effect};
pub use course::ratio_course;
pub use duty_model::DutyModel;
pub use jred_analysis::duty::mechanics::Alteration;
pub use remedy::{Edge, Lever, Remedies, Remedy, RuleViolation};
