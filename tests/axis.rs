//! From an encoder's count to a torque command.

mod drive;
mod encoder;
mod feed_forward;
mod governor;
mod limits;
mod look_ahead;
mod machine;
mod messages;
mod motion;
mod plan;
mod stop;
mod tracker;
