//! Cycles of a tick, on your own board.
//!
//! Compiled, but not run on a board: QEMU has no cycle counter. There, and on the host, the program reports that and ends.
//!
//! Cortex-M3, M4, M7 and M33 count cycles in CYCCNT of the DWT, the Cortex-M0 and M0+ only have SysTick; both run at the core's clock. A loop of 64
//! calls is timed, and a loop with each call made twice; the difference is the time of 64 calls, without loop and counter. The shortest of several
//! runs is the one without waits for flash or cache.
//!
//! ```text
//! cargo run -p jred --example 05_board_cycles --profile firmware --target thumbv7em-none-eabihf
//! ```
//!
//! For a board: its memory in memory.x, its probe as the runner (`probe-rs run --chip …`) in .cargo/config.toml. Set clock and flash wait states as
//! your firmware does; after reset most parts run from a slow oscillator without wait states.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[path = "support/cycles.rs"]
mod cycles;
mod support;

use core::hint::black_box;

use cycles::Counter;
use jred::number::Scalar;
use jred::{CurveSet, Image, Model, Phase, Q31, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

type Press<S> = Model<'static, Spline<S>, PRESS>;

/// Calls of a loop, at phases over the whole turn.
const CALLS: u32 = 64;
/// The golden section of 2³²: every call is in another cell.
const STEP: u32 = 0x9e37_79b9;
/// Runs of each loop.
const RUNS: u32 = 8;

/// Cycles of a loop that makes each call `times` times: the shortest run.
fn shortest(counter: &Counter, times: u32, mut call: impl FnMut(Phase)) -> u32 {
    let mut shortest = u32::MAX;
    for _ in 0..RUNS {
        let start = counter.now();
        for k in 0..CALLS {
            let phase = Phase::from_bits(k.wrapping_mul(STEP));
            for _ in 0..times {
                call(black_box(phase));
            }
        }
        shortest = shortest.min(counter.since(start));
    }
    shortest
}

/// Average cycles of `call`, in thousandths; the loop over `times` is the same in both.
fn cycles_of(counter: &Counter, mut call: impl FnMut(Phase)) -> i32 {
    let once = shortest(counter, black_box(1), &mut call);
    let twice = shortest(counter, black_box(2), &mut call);
    milli(twice.saturating_sub(once) as f32 / CALLS as f32)
}

/// Prints the cycles of a call.
fn report<S: Scalar>(
    counter: &Counter,
    number: &str,
    press: &Press<S>,
    omega: S::Speed,
    alpha: S::Acceleration,
    torque: S::Torque,
) {
    let inverse = cycles_of(counter, |phase| {
        black_box(press.torque(phase, black_box(omega), black_box(alpha)));
    });
    let forward = cycles_of(counter, |phase| {
        black_box(press.acceleration(phase, black_box(omega), black_box(torque)));
    });
    // The remaining overhead: the loop over `times`, and the black boxes.
    let empty = cycles_of(counter, |phase| {
        black_box((phase, black_box(omega), black_box(alpha)));
    });
    println!(
        "{number}: torque {inverse}, acceleration {forward} cycles a thousand calls, of each the loop {empty}"
    );
}

fn run() -> Result<(), Failure> {
    let Some(counter) = Counter::start() else {
        println!("no cycle counter counts here: run this on a board");
        return Ok(());
    };
    let single = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let single: Press<f32> = single.model()?;
    let fixed = Image::from_bytes(include_image!("data/press_q31.jred"))?;
    let scale = fixed.scale();
    let fixed: Press<Q31> = fixed.model()?;
    let [omega, alpha, torque] = [10.0, 50.0, 20.0];
    report(&counter, "f32", &single, omega, alpha, torque);
    let (omega, alpha, torque) = (
        scale.omega(omega),
        scale.alpha(alpha),
        scale.to_torque(torque),
    );
    if omega.saturated || alpha.saturated || torque.saturated {
        return Err("the press is not made for these numbers".into());
    }
    report(
        &counter,
        "Q31",
        &fixed,
        omega.value,
        alpha.value,
        torque.value,
    );
    Ok(())
}

program!(run);
