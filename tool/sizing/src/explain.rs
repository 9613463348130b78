//! Explains the verdict of a drive: contributions to its torque and inertia, and the changes that would make it suitable.

mod altered;
mod breakdown;
mod contributions;
mod course;
mod remedy;
mod seek;
mod words;

pub use altered::{Alteration, DutyModel};
pub use breakdown::{Breakdown, InertiaShare, Share};
pub use contributions::{Contribution, Contributions, Effect};
pub use course::ratio_course;
pub use remedy::{Edge, Lever, Remedies, Remedy, RuleViolation};
