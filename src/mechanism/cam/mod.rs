//! Cams: the follower's displacement over a turn of the cam, and whether the follower stays in contact.
//!
//! ```text
//! Law, quintic ─► Segment ─► Program s(φ) ─► DiscCam ─► Machine ─► contact force, lift-off
//!  one transition  rise,       one turn,       follower,  masses, springs
//!                  dwell       closed          profile
//! ```
//!
//! VDI 2143 Blatt 1, *Bewegungsgesetze für Kurvengetriebe*, 1980: motion laws between rest (dwell), constant velocity,
//! reversal and general motion. R. L. Norton, *Cam Design and Manufacturing Handbook*, chapters 2 to 5 and 7.

mod contact;
mod extreme;
mod fault;
mod program;
mod segment;

pub use contact::{LiftOff, contact_force, lift_off};
pub use extreme::Extreme;
pub use fault::CamError;
pub use program::{AccelerationJump, MAX_SEGMENTS, Piece, Program};
pub use segment::{Segment, Shape};

pub(crate) use extreme::smallest;
