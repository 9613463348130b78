//! From an encoder's count to a torque command.

mod drive;
mod encoder;
mod feed_forward;
mod follower;
mod governor;
mod leave_plan;
mod limits;
mod look_ahead;
pub(crate) mod machine;
mod messages;
mod motion;
mod not_finite;
mod plan;
mod plan_refused;
mod stop;
mod tracker;
