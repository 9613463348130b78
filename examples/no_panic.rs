//! A link gate: this program links for a Cortex-M only if no panic can be reached from the calls below.
//!
//! Its panic handler calls a function that does not exist. Where the optimiser proves that no call can panic, the handler
//! is thrown away; one forgotten index, and the linker says `undefined symbol: a_panic_is_reachable`.
//!
//! `scripts/test gates` builds it three times: as it is; with `--cfg gate_panic`, which must not link; and with
//! `--cfg gate_double`, where the search for double-precision routines must find some; otherwise it must find none.
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
use jred::machine::motion::{Law, Move};
use jred::table::Format;
use jred::{
    Cubic, Image, ImageError, Model, Outcome, Phase, Pieces, Q31, Quadratic, Rows16, Set, Spline,
    Spline16, curves, include_image,
};

/// The curves of the press, as `jred export` prints them.
const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Constant friction.
const CONSTANTS: Set = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// Every curve.
const EVERY: Set = curves::ALL | curves::RECIPROCAL;

/// Everything that firmware calls, with arguments unknown to the optimiser.
fn calls() -> Result<(), ImageError> {
    let (float, fixed) = (
        include_image!("data/press_f32.jred"),
        include_image!("data/press_q31.jred"),
    );
    every_tick::<Spline<f32>, PRESS>(float)?;
    every_tick::<Spline<Q31>, PRESS>(fixed)?;
    // Refused, because the images have other layouts and sets; the linker does not know.
    let other = [
        every_tick::<Cubic<f32>, { curves::ALL }>(float),
        every_tick::<Quadratic<f32>, CONSTANTS>(float),
        every_tick::<Spline<Q31>, EVERY>(fixed),
        every_tick::<Cubic<Q31>, EVERY>(fixed),
        every_tick::<Quadratic<Q31>, { curves::LOAD | curves::RECIPROCAL }>(fixed),
        every_tick::<Spline16, EVERY>(fixed),
        every_tick::<Rows16, { curves::ALL }>(fixed),
        every_tick::<Rows16, EVERY>(fixed),
        every_tick::<Rows16, { CONSTANTS | curves::RECIPROCAL }>(fixed),
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

    if cfg!(gate_panic) {
        black_box([1, 2, 3][black_box(1usize)]);
    }
    if cfg!(gate_double) {
        black_box(Phase::from_radians(black_box(1.0)).radians());
    }
    Ok(())
}

fn every_tick<F: Format, const SET: Set>(bytes: &'static [u8]) -> Result<(), ImageError> {
    let image = Image::from_bytes(black_box(bytes))?;
    let model: Model<'_, F, SET> = image.model()?;
    let scale = image.scale();
    let phase = image.domain().phase(black_box(1.0));
    let omega: Outcome<F::Number> = scale.omega(black_box(10.0));
    let alpha: Outcome<F::Number> = scale.alpha(black_box(50.0));
    let limit: Outcome<F::Number> = scale.to_torque(black_box(100.0));
    let torque = model.torque(phase, omega.value, alpha.value);
    let back = model.acceleration(phase, omega.value, limit.value);
    let range = model.acceleration_range(phase, omega.value, torque, limit.value);
    let mut torques = black_box([F::Number::default(); 3]);
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

fn every_meter(window: Window<f32>) {
    let mut limits = Limits::new().with_speed(black_box(300.0));
    limits.continuous = Curve::new(black_box(&[[0.0, 3.0], [300.0, 2.0]])).ok();
    limits.peak = Curve::new(black_box(&[[0.0, 9.0], [200.0, 9.0], [300.0, 4.0]])).ok();
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
