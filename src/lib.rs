#![no_std]
#![forbid(unsafe_code)]
//! guide to come

mod error;
mod fixed;
mod image;
mod link;
mod load;
mod math;
pub mod mechanism;
mod model;
pub mod motion;
mod phase;
mod reduction;
mod scalar;
mod scale;
pub mod table;
pub mod tabulate;
mod transfer;

pub use error::Error;
pub use image::{Aligned, HEADER_WORDS, Image, ImageError, VERSION, Validity, encode, image_words};
pub use link::{Frame, Link};
pub use load::{Action, Load, LoadCurves, Window};
pub use math::Real;
pub use mechanism::Mechanism;
pub use model::Model;
pub use phase::{Domain, Phase};
pub use reduction::{MAX_LOADS, Machine, Reducible, Reduction, TorqueTerms};
pub use scalar::{Outcome, Q31, Scalar};
pub use scale::Scale;
pub use table::{Table, TableError};
pub use transfer::Transfer;

mod sealed {
    /// Keeps the number traits closed: their contracts are tested type by type.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for crate::Q31 {}
}
