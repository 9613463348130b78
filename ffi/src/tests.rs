//! C sees the same as Rust.

use jred::{CurveSet, Q31, Spline, curves, include_image};

use crate::memory::Memory;

mod encoder;
mod follower;
mod header;
mod numbers;
mod sets;
mod slider_crank;
mod ticks;

const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

type Press = Memory<Spline<f32>>;

#[allow(improper_ctypes, reason = "C sees the memory of a model as bytes")]
unsafe extern "C" {
    fn jred_spline_f32_load(
        memory: *mut Press,
        set: CurveSet,
        words: *const u32,
        length: usize,
    ) -> i32;
    fn jred_spline_q31_load(
        memory: *mut Memory<Spline<Q31>>,
        set: CurveSet,
        words: *const u32,
        length: usize,
    ) -> i32;
}

fn words(bytes: &[u8]) -> Vec<u32> {
    let (words, _) = bytes.as_chunks();
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

/// The image of the press.
fn press() -> Vec<u32> {
    words(include_image!("../../examples/data/press_f32.jred"))
}
