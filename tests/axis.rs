//! From an encoder's count to a torque command.

mod drive;
mod encoder;
mod feed_forward;
mod follower;
mod governor;
mod identify;
mod leave_plan;
mod limits;
mod look_ahead;
pub(crate) mod machine;
mod messages;
mod monitor;
mod motion;
mod not_finite;
mod observer;
mod payload;
mod plan;
mod plan_refused;
mod plants;
mod stop;
mod tracker;
pub(crate) mod watched;
