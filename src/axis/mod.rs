//! From an encoder's count to the torque command of a motor, piece by piece: a program pays for those that it uses.
//!
//! ```text
//! register ─► Counter ─► count ─► Encoder ─► phase ─► Tracker ─► φ, ω, α
//!                                                                 │  Period: into machine units
//!  set-point ω, α ────────────────────────────────► Motion ◄──────┘
//!                                                     │  Period::later: lead time
//!                                                     ▼
//!                          Ramp: friction ─► FeedForward ─► torque, status
//!                                                     │  Transmission: to the motor
//!                                                     ▼
//!                                                TorqueLimits ─► command, what was clipped
//! ```
//!
//! A drive link that has a stroke takes a [`StrokeEncoder`] in place of the [`Encoder`]; a set-point comes from a program's own motion, a [`Plan`] that a [`Follower`]
//! follows, or a [`Governor`], which makes of a commanded speed the motion that the drive can make:
//!
//! ```text
//! Envelope: torque against speed ─► Limits ─► feasible α of this tick ─┐
//!                                                                      ├─► Governor ─► α ─► Motion
//! LookAhead: greatest speed at each φ, where it stops ─────────────────┘
//! ```
//!
//! An [`ImageSlot`] exchanges the table while the machine runs. `docs/axis.md` of the project explains each step, `examples/07_axis.rs`, `08_governor.rs` and `09_plan.rs` put them together, and
//! `examples/template` is a firmware to start from.
//!
//! # Numbers that are none
//!
//! In fixed point a result that leaves the range is limited, and flagged in its [`Outcome`](crate::Outcome). In floating point nothing is flagged on the way: NaN and infinity stay in the motion until
//! [`FeedForward`] finds them, as any other motion that the table was not made for, and says so in its [`Status`]. Each function says what becomes of NaN in it; what is made once refuses it with an [`AxisError`]
//! (test `no_function_takes_what_is_no_number_in_silence`).

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
mod motion_range;
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
pub use feed_forward::{Checked, FeedForward, Limited, Ramp, TorqueLimits};
pub use follower::{Follower, Planned, Rate, Stage};
pub use governor::{Governed, Governor};
pub use limits::{Bounded, Feasible, Limit, Limits};
pub use look_ahead::{Direction, LookAhead, Stop};
pub use motion::{Motion, Period};
pub use motion_range::{MotionRange, Status};
pub use plan::Plan;
pub use slot::ImageSlot;
pub use stroke::{Scaled, StrokeEncoder};
pub use tracker::{Tracked, Tracker};
pub use transmission::{Gearbox, Transmission};
