//! One cycle of the press at 1 kHz in single precision: feed-forward torque, and the inverse.
//!
//! Each tick takes the motion's φ, ω, α, computes the torque for it (inverse dynamics) and the acceleration by this torque (forward dynamics), which
//! must be the original α.
//!
//! ```text
//! cargo run -p jred --example 02_press_f32 --profile firmware --target thumbv7m-none-eabi
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use core::f32::consts::{PI, TAU};

use jred::machine::motion::{Law, Move};
use jred::{CurveSet, Image, Model, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Period of a tick (s).
const TICK: f32 = 0.001;
/// The cycle lasts 0.5 s: 0.4 s for the stroke, then 0.1 s at rest.
const TICKS: u32 = 500;
/// Limit of the round trip's error (rad/s²).
const BOUND: f32 = 0.001;

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
    // From top dead centre (180 deg) to top dead centre; before and after, the crank is at rest. The 3-4-5 polynomial needs no sine, and in f32 no
    // double precision.
    let stroke = Move::new(Law::Polynomial345, PI, TAU, 0.4)?;

    println!("  ms     phase   torque bits     torque   acceleration bits");
    let (mut worst, mut saturated, mut checksum) = (0.0f32, 0u32, 0u32);
    for tick in 0..TICKS {
        let wanted = stroke.at(tick as f32 * TICK);
        let phase = image.domain().phase(wanted.phi);
        let torque = press.torque(phase, wanted.omega, wanted.alpha);
        let alpha = press.acceleration(phase, wanted.omega, torque);

        worst = worst.max((alpha.value - wanted.alpha).abs());
        saturated += u32::from(alpha.saturated);
        for bits in [torque.to_bits(), alpha.value.to_bits()] {
            checksum = (checksum ^ bits).wrapping_mul(16_777_619);
        }
        if tick % 20 == 0 {
            println!(
                "{:4}  {:08x}  {:08x} {:8} mN m  {:08x} {:7} mrad/s2",
                tick,
                phase.to_bits(),
                torque.to_bits(),
                milli(torque),
                alpha.value.to_bits(),
                milli(alpha.value)
            );
        }
    }
    println!("checksum of all {TICKS} ticks {checksum:08x}, saturated {saturated}");
    println!(
        "largest round-trip difference {} urad/s2",
        milli(worst * 1000.0)
    );
    if worst < BOUND {
        Ok(())
    } else {
        Err("the round trip does not come back to the acceleration it started from".into())
    }
}

program!(run);
