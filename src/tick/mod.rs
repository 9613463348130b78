//! The tick: models over tables, their images in flash, the duty meter.

pub mod duty;
mod image;
mod model;
mod pieces;
mod units;

pub use image::{
    Aligned, HEADER_WORDS, Image, ImageCheck, ImageError, VERSION, Validity, encode, identify,
    image_len,
};
pub(crate) use image::{Beginning, Progress, covered, seal};
pub use model::{AccelerationRange, AnyModel, Model, TorqueTerms};
pub use pieces::Pieces;
pub use units::{MachineUnits, Units};
