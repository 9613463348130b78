//! The calls of a drive's firmware, each a separate function so that its instructions can be counted.
//!
//! They are compiled as in firmware: several calls on one model, the image known only at run time, an encoder of 10 000 and one of 4096 counts. The
//! program is never run; `cargo xtask perf` follows its code.
#![no_std]
#![no_main]

mod ahead;
mod around;
mod command;
mod models;
mod port;

use core::hint::black_box;
use core::ptr::write_volatile;

use cortex_m_rt::entry;
use jred::axis::{Encoder, Mounting};
use jred::table::Format;
use jred::{CurveSet, Image, Model, curves, slider_crank};
use panic_halt as _;

use port::read;

/// The curves of the press of the examples.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
/// In fixed point, with 1/J instead of a division.
const FIXED: CurveSet = PRESS | curves::RECIPROCAL;

/// As a slider-crank in closed form: the weight of its crank has a part in sin φ.
const CRANK: CurveSet = PRESS | slider_crank::terms::LOAD_SIN;

const fn encoder(counts_per_turn: u32) -> Encoder {
    match Encoder::new(Mounting::direct(counts_per_turn)) {
        Ok(encoder) => encoder,
        Err(_) => panic!("counts"),
    }
}
const TEN_THOUSAND: Encoder = encoder(10_000);
const POWER_OF_TWO: Encoder = encoder(4096);

/// A table image from outside the program.
fn words() -> &'static [u32] {
    static mut IMAGE: [u32; 512] = [0; 512];
    for k in 0..512 {
        unsafe { write_volatile(&raw mut IMAGE[k], read(k)) }
    }
    // Of any length: the compiler would know that a slider-crank of 512 words is refused.
    let image: &[u32] = unsafe { &*&raw const IMAGE };
    black_box(image)
}

fn model<F: Format, const SET: CurveSet>() -> Model<'static, F, SET> {
    match Image::new(words()).and_then(|image| image.model()) {
        Ok(model) => model,
        Err(_) => panic!("the image"),
    }
}

#[entry]
fn main() -> ! {
    loop {
        models::run();
        around::run();
        command::run();
        ahead::run();
    }
}
