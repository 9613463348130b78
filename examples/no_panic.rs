//! A link gate: this program links for a Cortex-M only if no panic can be reached from the calls below.
//!
//! Its panic handler calls a function that does not exist. Where the optimiser proves that no call can panic, the handler
//! is thrown away; one forgotten index, and the linker says `undefined symbol: a_panic_is_reachable`.
//!
//! `scripts/test gates` builds it three times: as it is; with `GATE_PANIC=1`, which must not link; and with
//! `GATE_DOUBLE=1`, where the search for double-precision routines must find some; otherwise it must find none.
#![cfg_attr(target_os = "none", no_std, no_main)]
#![cfg_attr(
    target_os = "none",
    allow(
        unsafe_code,
        reason = "a symbol that does not exist, for the linker to miss"
    )
)]

use core::hint::black_box;
use core::num::NonZeroU32;

use jred::duty::{Curve, Limits, Meter, Window};
use jred::motion::{Law, Move};
use jred::table::{Cubic, Layout, Quadratic, Spline, Spline16, curves};
use jred::{Image, ImageError, Model, Outcome, Phase, Pieces, Q15, Q31, Scalar, include_image};

/// The curves of the press, as `jred export` prints them.
const PRESS: u8 = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Everything that firmware calls, with arguments unknown to the optimiser.
fn calls() -> Result<(), ImageError> {
    let (float, fixed) = (
        include_image!("data/press_f32.jred"),
        include_image!("data/press_q31.jred"),
    );
    every_tick::<f32, PRESS, Spline>(float)?;
    every_tick::<Q31, PRESS, Spline>(fixed)?;
    // Refused, because the images have other layouts and sets; the linker does not know.
    let other = [
        every_tick::<f32, { curves::ALL }, Cubic>(float),
        every_tick::<f32, { curves::EVERY & !curves::RECIPROCAL }, Quadratic>(float),
        every_tick::<Q31, { curves::EVERY }, Spline>(fixed),
        every_tick::<Q31, { curves::EVERY }, Cubic>(fixed),
        every_tick::<Q31, { curves::LOAD | curves::RECIPROCAL }, Quadratic>(fixed),
        every_tick::<Q31, { curves::EVERY }, Spline16>(fixed),
        every_short_tick::<{ curves::ALL }>(fixed),
        every_short_tick::<{ curves::EVERY }>(fixed),
    ];
    let _ = black_box(other);

    let stroke = Move::new(
        Law::Polynomial345,
        black_box(0.0f32),
        black_box(core::f32::consts::TAU),
        black_box(0.4),
    );
    if let Ok(stroke) = stroke {
        black_box(stroke.at(black_box(0.1)));
    }
    if let Some(per_turn) = NonZeroU32::new(black_box(4096)) {
        let sum = Phase::from_counts(black_box(1), per_turn) + Phase::from_bits(black_box(2));
        black_box((sum - Phase::from_radians_f32(black_box(1.0))).cell(black_box(100)));
        #[cfg(feature = "micromath")]
        black_box(sum.sin_cos_approx());
    }

    every_meter(Window::SinceStart);
    every_meter(Window::Exponential(600.0));

    if option_env!("GATE_PANIC").is_some() {
        black_box([1, 2, 3][black_box(1usize)]);
    }
    if option_env!("GATE_DOUBLE").is_some() {
        black_box(Phase::from_radians(black_box(1.0)).radians());
    }
    Ok(())
}

fn every_tick<S: Scalar, const SET: u8, L: Layout>(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let model: Model<'_, S, SET, L> = image.model()?;
    let scale = image.scale();
    let phase = image.domain().phase(black_box(1.0));
    let omega: Outcome<S> = scale.omega(black_box(10.0));
    let alpha: Outcome<S> = scale.alpha(black_box(50.0));
    let limit: Outcome<S> = scale.to_torque(black_box(100.0));
    let torque = model.torque(phase, omega.value, alpha.value);
    let back = model.acceleration(phase, omega.value, limit.value);
    let range = model.acceleration_range(phase, omega.value, torque, limit.value);
    let mut torques = black_box([S::default(); 3]);
    let done = model.torques(
        black_box(&[phase; 3]),
        black_box(&[omega.value; 3]),
        black_box(&[alpha.value; 3]),
        &mut torques,
    );
    black_box((
        scale.torque_si(torque),
        scale.alpha_si(back.value),
        range,
        done,
        torques,
    ));
    let half = Phase::from_bits(1 << 31);
    if let Ok(pieces) = Pieces::new(black_box([(Phase::default(), model), (half, model)])) {
        black_box(pieces.torque(phase, omega.value, alpha.value));
        black_box(pieces.acceleration(phase, omega.value, torque));
    }
    Ok(())
}

fn every_short_tick<const SET: u8>(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let model = image.short_model::<SET>()?;
    let scale = image.scale();
    let phase = image.domain().phase(black_box(1.0));
    let omega: Outcome<Q15> = scale.omega(black_box(10.0));
    let alpha: Outcome<Q15> = scale.alpha(black_box(50.0));
    let torque = model.torque(phase, omega.value, alpha.value);
    let back = model.acceleration(phase, omega.value, torque);
    let range = model.acceleration_range(phase, omega.value, Q15::MIN, Q15::MAX);
    black_box((scale.torque_si(torque), scale.alpha_si(back.value), range));
    Ok(())
}

fn every_meter(window: Window<f32>) {
    let limits = Limits {
        continuous: Curve::new(black_box(&[[0.0, 3.0], [300.0, 2.0]])).ok(),
        peak: Curve::new(black_box(&[[0.0, 9.0], [200.0, 9.0], [300.0, 4.0]])).ok(),
        speed: Some(black_box(300.0)),
        ..Limits::default()
    };
    if let Ok(mut meter) = Meter::new(limits, black_box(1e-3), black_box(window)) {
        for _ in 0..black_box(3) {
            meter.tick(black_box(1.0), black_box(100.0), black_box(5.0));
        }
        meter.count_cycle();
        black_box((meter.figures(), meter.verdicts()));
        meter.restart();
        black_box(&meter);
    }
}

#[cfg(not(target_os = "none"))]
fn main() -> Result<(), ImageError> {
    calls()
}

#[cfg(target_os = "none")]
mod target {
    use cortex_m_semihosting::debug;

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        // SAFETY: never called; a program that could call it does not link.
        unsafe extern "C" {
            safe fn a_panic_is_reachable() -> !;
        }
        a_panic_is_reachable()
    }

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let status = match super::calls() {
            Ok(()) => debug::EXIT_SUCCESS,
            Err(_) => debug::EXIT_FAILURE,
        };
        loop {
            debug::exit(status);
        }
    }
}
