//! From an encoder's count to the torque command: encoders, speed and acceleration from their counts.

mod counter;
mod encoder;
mod stroke;
mod tracker;

pub use counter::Counter;
pub use encoder::{Counting, Encoder, Mounting};
pub use stroke::{Scaled, StrokeEncoder};
pub use tracker::{Rates, Tracked, Tracker};
