//! Machines: links and joints, loads on them, and their reduction to the drive link.

pub(crate) mod element;
pub(crate) mod error;
pub mod joint;
pub(crate) mod kinetostatics;
pub(crate) mod link;
pub(crate) mod load;
pub(crate) mod mechanism;
pub mod motion;
pub(crate) mod reduction;

pub use element::{Element, MAX_ELEMENTS};
pub use error::{MachineError, PoseError};
pub use joint::{Body, Joint, Marker, Wrench};
pub use kinetostatics::{Forces, Reaction};
pub use link::{Frame, Link};
pub use load::{Action, Load, LoadCurves, Window};
pub use mechanism::{Jointed, Mechanism};
pub use reduction::{MAX_LOADS, Machine, Reducible, Reduction, TorqueTerms};
