//! What C sees is what Rust has.

use jred::{Set, Spline, curves, include_image};

use crate::memory::Memory;

mod follower;
mod header;
mod numbers;
mod sets;
mod slider_crank;
mod ticks;

const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

type Press = Memory<Spline<f32>>;

fn words(bytes: &[u8]) -> Vec<u32> {
    let (words, _) = bytes.as_chunks();
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

/// The image of the press.
fn press() -> Vec<u32> {
    words(include_image!("../../examples/data/press_f32.jred"))
}
