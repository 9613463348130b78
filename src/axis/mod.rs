//! From an encoder's count to the torque command: encoders, speed and acceleration from their counts.

mod braking;
mod counter;
mod encoder;
mod envelope;
mod error;
mod feed_forward;
mod follower;
mod governor;
mod limits;
mod look_ahead;
mod motion;
pub mod plan;
mod slot;
mod stroke;
mod tracker;
mod transmission;

pub use braking::Braking;
pub use counter::Counter;
pub use encoder::{Counting, Encoder, Mounting};
pub use envelope::Envelope;
pub use error::AxisError;
pub use feed_forward::{Checked, FeedForward, Limited, Ramp, Status, TorqueLimits};
pub use follower::{Follower, Planned, Rate, Stage};
pub use governor::{Governed, Governor};
pub use limits::{Bounded, Feasible, Limit, Limits};
pub use look_ahead::{Direction, LookAhead, Stop};
pub use motion::{Motion, Period};
pub use plan::Plan;
pub use slot::ImageSlot;
pub use stroke::{Scaled, StrokeEncoder};
pub use tracker::{Tracked, Tracker};
pub use transmission::{Gearbox, Transmission};
