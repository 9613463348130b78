//! From an encoder's count to the torque command: encoders, speed and acceleration from their counts.

mod counter;
mod encoder;
mod error;
mod feed_forward;
mod motion;
mod slot;
mod stroke;
mod tracker;
mod transmission;

pub use counter::Counter;
pub use encoder::{Counting, Encoder, Mounting};
pub use error::AxisError;
pub use feed_forward::{Checked, FeedForward, Limited, Ramp, Status, TorqueLimits};
pub use motion::{Motion, Period};
pub use slot::ImageSlot;
pub use stroke::{Scaled, StrokeEncoder};
pub use tracker::{Tracked, Tracker};
pub use transmission::{Gearbox, Transmission};
