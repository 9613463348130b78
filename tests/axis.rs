//! From an encoder's count to a torque command.

mod encoder;
mod feed_forward;
mod tracker;
