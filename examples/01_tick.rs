//! The tick: which torque does the press need now, and which acceleration will a torque cause?
//!
//! ```text
//! cargo run -p jred --example 01_tick                                               on the host
//! cargo run -p jred --example 01_tick --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use core::num::NonZeroU32;

use jred::{CurveSet, Image, Model, Phase, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

const ENCODER: NonZeroU32 = NonZeroU32::new(4096).unwrap();

fn run() -> Result<(), Failure> {
    // Once, at start-up. The image stays in place, in flash; nothing is copied. Every fault of it shows here; after this line a tick can neither fail
    // nor panic.
    let image = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let press: Model<'_, Spline<f32>, PRESS> = image.model()?;

    let validity = image.validity();
    println!(
        "{} cells, torque exact to {} mN m",
        image.cells(),
        milli(validity.torque_error)
    );
    println!(
        "up to {} mrad/s and {} mrad/s2",
        milli(validity.max_speed),
        milli(validity.max_acceleration)
    );

    // Every tick: a phase from the encoder's count, then one call.
    println!("count   torque for 10 rad/s, 50 rad/s2   acceleration from 100 N m at 10 rad/s");
    for count in (0..4096).step_by(256) {
        let phase = Phase::from_counts(count, ENCODER);
        let needed = press.torque(phase, 10.0, 50.0);
        let gained = press.acceleration(phase, 10.0, 100.0).value;
        println!(
            "{:5} {:10} mN m {:31} mrad/s2",
            count,
            milli(needed),
            milli(gained)
        );
    }
    Ok(())
}

program!(run);
