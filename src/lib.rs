#![no_std]
#![forbid(unsafe_code)]
//! guide to come

mod error;
mod link;
mod load;
mod math;
pub mod mechanism;
pub mod motion;
pub mod table;
mod phase;
mod reduction;
mod transfer;

pub use error::Error;
pub use link::{Frame, Link};
pub use load::{Action, Load, LoadCurves, Window};
pub use math::Real;
pub use mechanism::Mechanism;
pub use phase::{Domain, Phase};
pub use reduction::{MAX_LOADS, Machine, Reducible, Reduction, TorqueTerms};
pub use transfer::Transfer;

mod sealed {
    /// Keeps the number traits closed: their contracts are tested type by type.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}
