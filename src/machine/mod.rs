//! Machines: links and joints, loads on them, and their reduction to the drive link.
//!
//! The second step of the data flow. A [`Mechanism`] gives the positions of its links; with their masses and loads it is a
//! [`Machine`], which has a [`Reduction`] at every angle: J, J′, J″ and the torque of the loads. [`motion`] has the
//! motion laws of a drive link, the only part available without the feature `mechanics`.

#[cfg(feature = "mechanics")]
pub(crate) mod element;
#[cfg(feature = "mechanics")]
pub(crate) mod error;
#[cfg(feature = "mechanics")]
mod free_motion;
#[cfg(feature = "mechanics")]
pub(crate) mod joint;
#[cfg(feature = "mechanics")]
pub(crate) mod joint_friction;
#[cfg(feature = "mechanics")]
pub(crate) mod kinetostatics;
#[cfg(feature = "mechanics")]
pub(crate) mod link;
#[cfg(feature = "mechanics")]
pub(crate) mod load;
#[cfg(feature = "mechanics")]
pub(crate) mod mechanism;
pub mod motion;
#[cfg(feature = "mechanics")]
pub(crate) mod reducible;
#[cfg(feature = "mechanics")]
pub(crate) mod reduction;

#[cfg(feature = "mechanics")]
pub use element::{Element, ElementLaw, MAX_ELEMENTS};
#[cfg(feature = "mechanics")]
pub use error::{MachineError, PoseError};
// Not part of 1.0: only tests use it yet, so that its interface may change.
#[cfg(feature = "mechanics")]
#[doc(hidden)]
pub use free_motion::FreeMotion;
#[cfg(feature = "mechanics")]
pub use joint::{Body, Joint, Joints, MAX_JOINTS, Marker, UnitReactions, Wrench};
#[cfg(feature = "mechanics")]
pub use joint_friction::{FrictionState, JointFriction, MAX_FRICTIONS};
#[cfg(feature = "mechanics")]
pub use kinetostatics::{Forces, Reaction};
#[cfg(feature = "mechanics")]
pub use link::{Frame, Link, MassProperties};
#[cfg(feature = "mechanics")]
pub use load::{Action, Load, LoadCurves, Window};
#[cfg(feature = "mechanics")]
pub use mechanism::{Frames, Jointed, MAX_LINKS, MAX_STAGES, Mechanism};
#[cfg(feature = "mechanics")]
pub use reducible::Reducible;
#[cfg(feature = "mechanics")]
pub use reduction::{MAX_LOADS, Machine, Reduction, TorqueTerms};
