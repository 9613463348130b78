//! The tick and what belongs to it: models over tables, their images in flash, the duty meter.

pub mod duty;
pub mod harmonic;
pub(crate) mod image;
mod model;
mod pieces;
mod range;
pub mod short;

pub use image::{Aligned, HEADER_WORDS, Image, ImageError, VERSION, Validity, encode, image_words};
pub use model::{AccelerationRange, Model};
pub use pieces::{Part, Pieces};
pub use range::Usage;
pub(crate) use range::check;
