//! As fast as the drive allows: a press follows a commanded speed, presses slowly, and at every tick knows where it would stop.
//!
//! The drive has 200 N·m on the crank up to 12 rad/s, falling to 100 at 25, and brakes with 60. Between 315° and 360°, where the press works, it must
//! not exceed 8 rad/s. The program commands 20 rad/s all the time and then a stop. The governor slows down ahead of the work, accelerates after it
//! with the full torque of the drive, and never requests more torque than the drive has.
//!
//! ```text
//! cargo run -p jred --example 08_governor                                               on the host
//! cargo run -p jred --example 08_governor --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use jred::axis::{
    Braking, Direction, Envelope, Governor, Limit, Limits, LookAhead, MotionState, Period,
};
use jred::{CurveSet, Image, Model, Phase, Q31, Speed, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Period of a tick (s), and the number of ticks; a stop is commanded from `STOP` on.
const TICK: f32 = 0.000_5;
const TICKS: u16 = 2400;
const STOP: u16 = 2000;
/// Torque of the drive on the crank: speed (rad/s) and torque (N·m); and the braking torque.
const DRIVING: [[f32; 2]; 2] = [[12.0, 200.0], [25.0, 100.0]];
const BRAKE: f32 = 60.0;

/// Nodes of the look-ahead: 2 kB.
const NODES: usize = 128;

/// The greatest speed (rad/s).
fn limit(phase: Phase) -> f32 {
    if is_working(phase) { 8.0 } else { 20.0 }
}

/// From 315° to 360°.
fn is_working(phase: Phase) -> bool {
    phase.to_bits() >= 7 << 29
}

fn degrees(phase: Phase) -> u32 {
    ((u64::from(phase.to_bits()) * 360) >> 32) as u32
}

fn name(by: Option<Limit>) -> &'static str {
    match by {
        None => "none",
        Some(Limit::Torque) => "torque",
        Some(Limit::Acceleration) => "acceleration",
        Some(Limit::Speed) => "speed",
        Some(Limit::Ahead) => "what lies ahead",
        Some(Limit::Range) => "range of numbers",
    }
}

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_q31.jred"))?;
    let press: Model<'_, Spline<Q31>, PRESS> = image.model()?;
    let scale = image.scale();
    let tick = Period::new(TICK, &press)?;
    let envelope = Envelope::new(DRIVING, BRAKE, &press)?;
    let limits = Limits::new(envelope, 22.0, 1400.0, tick, &press)?;
    let braking = Braking {
        torque: BRAKE,
        deceleration: f32::INFINITY,
        helped: false, // the workpiece may be missing
    };
    let ahead = LookAhead::<Q31, NODES>::new(&press, Direction::Forward, braking, limit, &tick)?;
    let governor = Governor::one_way(&ahead);

    let fast = scale.omega(20.0).value;
    let mut motion = MotionState::default();
    let (mut most, mut least, mut checksum) = (0.0_f32, 0.0_f32, 0_u32);
    let mut promised = Phase::default();
    println!("tick     at     speed    torque  limited by       stops at");
    for k in 0..TICKS {
        let commanded = if k < STOP { fast } else { Speed::default() };
        let governed = governor.govern(&limits, &press, &motion, commanded);
        motion.alpha = governed.alpha;
        let torque = press.torque_with(motion.phase, motion.omega, motion.alpha, governed.friction);
        let stop = ahead.stop(motion.phase, motion.omega);
        if k == STOP {
            promised = stop.phase;
        }

        let [speed, needed] = [scale.omega_si(motion.omega), scale.torque_si(torque)];
        most = most.max(needed);
        least = least.min(needed);
        checksum = (checksum ^ motion.phase.to_bits() ^ torque.to_bits().cast_unsigned())
            .wrapping_mul(16_777_619);
        if is_working(motion.phase) && speed > 8.1 {
            return Err("it works too fast".into());
        }
        if k % 100 == 0 {
            println!(
                "{:4} {:4} deg {:6} mrad/s {:4} N m  {:15} {:4} deg",
                k,
                degrees(motion.phase),
                milli(speed),
                milli(needed) / 1000,
                name(governed.by),
                degrees(stop.phase)
            );
        }
        motion = tick.later(motion).value;
    }
    println!(
        "checksum {checksum:08x}, torque from {} to {} N m",
        milli(least) / 1000,
        milli(most) / 1000
    );
    let (stopped, said) = (degrees(motion.phase), degrees(promised));
    println!("stopped at {stopped} deg, where {said} deg were said to be the farthest");
    if scale.omega_si(motion.omega) < 0.001 && stopped <= said {
        Ok(())
    } else {
        Err("it did not stop in time".into())
    }
}

program!(run);
