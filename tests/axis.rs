//! From an encoder's count to a torque command.

mod drive;
mod encoder;
mod feed_forward;
mod machine;
mod motion;
mod tracker;
