//! The same cycle in fixed point, for cores without a floating-point unit, and its cost in accuracy.
//!
//! Numbers are per-unit: a `Speed<Q31>` of 1 is the speed base in the image's `Scale`, an `Acceleration<Q31>` of 1 the acceleration base, a
//! `Torque<Q31>` of 1 the torque base; mixing them up does not compile. Results out of range are limited and flagged; nothing wraps.
//!
//! ```text
//! cargo run -p jred --example 03_press_q31 --profile firmware --target thumbv6m-none-eabi
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use core::f32::consts::{PI, TAU};

use jred::machine::motion::{Law, Move};
use jred::{Acceleration, CurveSet, Image, Model, Outcome, Q31, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Period of a tick (s).
const TICK: f32 = 0.001;
/// The cycle lasts 0.5 s: 0.4 s for the stroke, then 0.1 s at rest.
const TICKS: u32 = 500;
/// Limit of the round trip's error in units of 2⁻³¹: a torque is a multiple of 4 of them, and J is more than 0.18 of its base.
const BOUND: u32 = 4 * 6;
/// Largest difference (N·m) between the torques in fixed point and in single precision.
const DIFFERENCE: f32 = 0.001;

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_q31.jred"))?;
    let press: Model<'_, Spline<Q31>, PRESS> = image.model()?;
    let scale = image.scale();
    println!(
        "1.0 is {} mN m, {} mrad/s, {} mrad/s2",
        milli(scale.torque()),
        milli(scale.speed()),
        milli(scale.acceleration())
    );
    // For comparison only: firmware carries one of the two images.
    let float = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let float: Model<'_, Spline<f32>, PRESS> = float.model()?;
    let stroke = Move::new(Law::Polynomial345, PI, TAU, 0.4)?;

    println!("  ms     phase   torque bits     torque   acceleration bits");
    let (mut worst, mut apart, mut saturated, mut checksum) = (0u32, 0.0f32, 0u32, 0u32);
    for tick in 0..TICKS {
        let wanted = stroke.at(tick as f32 * TICK);
        let phase = image.domain().phase(wanted.phi);
        // SI to machine units, here from the motion law; a drive that plans in machine units needs no conversion.
        let omega = scale.omega(wanted.omega);
        let alpha = scale.alpha(wanted.alpha);
        let torque = press.torque(phase, omega.value, alpha.value);
        let back = press.acceleration(phase, omega.value, torque);

        worst = worst.max(back.value.to_bits().abs_diff(alpha.value.to_bits()));
        let exact = float.torque(phase, wanted.omega, wanted.alpha);
        apart = apart.max((scale.torque_si(torque) - exact).abs());
        for flag in [omega.saturated, alpha.saturated, back.saturated] {
            saturated += u32::from(flag);
        }
        for bits in [torque.to_bits(), back.value.to_bits()] {
            checksum = (checksum ^ bits as u32).wrapping_mul(16_777_619);
        }
        if tick % 20 == 0 {
            println!(
                "{:4}  {:08x}  {:08x} {:8} mN m  {:08x} {:7} mrad/s2",
                tick,
                phase.to_bits(),
                torque.to_bits(),
                milli(scale.torque_si(torque)),
                back.value.to_bits(),
                milli(scale.alpha_si(back.value))
            );
        }
    }
    println!("checksum of all {TICKS} ticks {checksum:08x}, saturated {saturated}");
    println!("largest round-trip difference {worst} units of 2^-31");
    println!(
        "largest torque difference from f32 {} uN m",
        milli(apart * 1000.0)
    );

    // Beyond the bases the result is the end of the range, and the flag reports that.
    let too_much: Outcome<Acceleration<Q31>> = scale.alpha(1.0e6);
    println!(
        "1e6 rad/s2: {:08x}, saturated {}",
        too_much.value.to_bits(),
        too_much.saturated
    );

    if worst > BOUND {
        Err("the round trip does not come back to the acceleration it started from".into())
    } else if apart > DIFFERENCE {
        Err("fixed point and single precision disagree".into())
    } else {
        Ok(())
    }
}

program!(run);
