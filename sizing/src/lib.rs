//! Servo sizing for machines whose inertia depends on the angle.

pub mod machine;
pub mod motion;
pub mod rules;
