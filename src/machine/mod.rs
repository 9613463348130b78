//! Machines: links and joints, loads on them, and their reduction to the drive link.
//!
//! The second step of the way of the data: a [`Mechanism`] says where its links are, their masses and the loads on them make it
//! a [`Machine`](crate::Machine), and at every angle it has a [`Reduction`](crate::Reduction): J, J′, J″ and the torque of
//! the loads. [`motion`] has the laws by which a drive link moves.

pub(crate) mod element;
pub(crate) mod error;
pub(crate) mod joint;
pub(crate) mod kinetostatics;
pub(crate) mod link;
pub(crate) mod load;
pub(crate) mod mechanism;
pub mod motion;
pub(crate) mod reducible;
pub(crate) mod reduction;

pub use element::{Element, MAX_ELEMENTS};
pub use error::{MachineError, PoseError};
pub use joint::{Body, Joint, Joints, MAX_JOINTS, Marker, UnitReactions, Wrench};
pub use kinetostatics::{Forces, Reaction};
pub(crate) use link::Link;
pub use link::{Frame, MassProperties};
pub use load::{Action, Load, LoadCurves, Window};
pub use mechanism::{Frames, Jointed, MAX_LINKS, MAX_STAGES, Mechanism};
pub(crate) use reducible::Reducible;
pub use reduction::{MAX_LOADS, TorqueTerms};
