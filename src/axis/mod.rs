//! From an encoder count to the torque command of a motor, in separate parts: a program pays only for those that it uses.
//!
//! ```text
//! register ─► Counter ─► count ─► Encoder ─► phase ─► Tracker ─► φ, ω, α
//!                                                                 │  Period: into machine units
//!  set-point ω, α ────────────────────────────────► MotionState ◄──────┘
//!                                                     │  Period::later: lead time
//!                                                     ▼
//!                          FrictionRamp: friction ─► FeedForward ─► torque, status
//!                                                     │  Transmission: to the motor
//!                                                     ▼
//!                                                TorqueLimits ─► command, what was clipped
//! ```
//!
//! A drive link with a stroke takes a [`StrokeEncoder`] instead of the [`Encoder`]. The set-point comes from the program's own motion, from a
//! [`Plan`] followed by a [`PlanFollower`], or from a [`Governor`], which turns a commanded speed into a motion that the drive can make:
//!
//! ```text
//! Envelope: torque against speed ─► Limits ─► feasible α of this tick ─┐
//!                                                                      ├─► Governor ─► α ─► MotionState
//! LookAhead: greatest speed at each φ, where it stops ─────────────────┘
//! ```
//!
//! An [`Observer`] is a [`Tracker`] with the model: it also sees the torque of the load, from which a [`Payload`] is estimated and a
//! [`Monitor`](monitor::Monitor) finds jams and wear.
//!
//! An [`Identification`] finds J, load and friction from the encoder and the torque, while the machine turns.
//!
//! An [`ImageSlot`] exchanges the table while the machine runs. `docs/axis.md` of the project explains each step; `examples/07_axis.rs`,
//! `08_governor.rs`, `09_plan.rs`, `11_observer.rs` and `12_identify.rs` combine them; `examples/template` is a firmware to start from.
//!
//! # NaN and infinity
//!
//! In fixed point a result outside the range is limited and flagged in its [`Outcome`](crate::Outcome). In floating point nothing is flagged on the
//! way: NaN and infinity stay in the motion until [`FeedForward`] reports them in its [`Status`], like any motion outside the validity of the table.
//! Each function documents its result for NaN; constructors refuse it with an [`AxisError`] (test `no_function_takes_what_is_no_number_in_silence`).

mod braking;
mod counter;
mod encoder;
mod envelope;
mod error;
mod feed_forward;
mod follower;
mod governor;
mod identify;
mod limits;
mod look_ahead;
pub mod monitor;
mod motion;
mod motion_range;
mod observer;
mod payload;
pub mod plan;
mod slot;
mod stroke;
mod torque_count;
mod tracker;
mod transmission;

pub use crate::tick::{MachineUnits, Units};
pub use braking::Braking;
pub use counter::Counter;
pub use encoder::{Counting, Encoder, Mounting};
pub use envelope::Envelope;
pub use error::AxisError;
pub use feed_forward::{CheckedTorque, FeedForward, FrictionRamp, LimitedTorque, TorqueLimits};
pub use follower::{Override, PlanFollower, PlanState, SetPoint};
pub use governor::{Governor, GovernorOutput};
pub use identify::{
    Equations, Found, FoundStatus, Identification, IdentificationSettings, Sampled,
};
pub use limits::{AccelerationBound, FeasibleAccelerations, Limit, Limits};
pub use look_ahead::{Direction, LookAhead, Stop};
pub use motion::{MotionState, Period};
pub use motion_range::{MotionRange, Status};
pub use observer::{Observed, Observer};
pub use payload::{Payload, PayloadEstimate};
pub use plan::Plan;
pub use slot::ImageSlot;
pub use stroke::{StrokeEncoder, StrokeMounting};
pub use tracker::{Tracker, TrackerOutput};
pub use transmission::{Gearbox, Transmission};
