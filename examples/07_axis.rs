//! From an encoder's count to the torque command of the motor: what an interrupt of a drive does.
//!
//! The press turns behind a gearbox of 20; its encoder of 10 000 counts sits on the motor, counts down, and reads 1234 at φ = 0, in a counter of
//! 16 bits that overflows three times a turn. The program moves the press, makes the counts that this encoder would show, and from them alone gets
//! phase, speed and acceleration, and the motor's torque.
//!
//! ```text
//! cargo run -p jred --example 07_axis                                               on the host
//! cargo run -p jred --example 07_axis --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use core::f32::consts::TAU;

use jred::axis::{
    Counter, Counting, Encoder, FeedForward, Gearbox, Motion, Mounting, Period, Ramp, TorqueLimits,
    Tracker, Transmission,
};
use jred::machine::motion::{Law, Move};
use jred::{Image, Model, Set, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// A figure that is wrong does not compile.
const ENCODER: Encoder = match Encoder::new(Mounting {
    counts_per_turn: 10_000,
    gear: [20, 1],
    counting: Counting::Down,
    home: 1234,
}) {
    Ok(encoder) => encoder,
    Err(_) => panic!("the encoder's figures"),
};
/// Counts of a turn of the crank.
const COUNTS: f32 = 200_000.0;

const GEARBOX: Gearbox = Gearbox {
    ratio: 20.0,
    efficiency: 0.95,
    rotor: 0.000_3,
};
/// Time of a tick, and from a command to the torque (s).
const TICK: f32 = 0.000_5;
const LEAD: f32 = 0.000_2;
const TICKS: u16 = 1000;

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
    let (domain, scale) = (image.domain(), image.scale());
    let feed_forward = FeedForward::new(press, image.validity());

    let wrong = |_| "a figure of the axis is wrong";
    let tick = Period::new(TICK, domain, scale).map_err(wrong)?;
    let lead = Period::new(LEAD, domain, scale).map_err(wrong)?;
    let ramp = Ramp::new(0.05, scale).map_err(wrong)?;
    let gearbox = Transmission::new::<f32>(GEARBOX, scale).map_err(wrong)?;
    let limits = TorqueLimits::new(-6.0, 6.0).map_err(wrong)?;
    let mut tracker = Tracker::with_bandwidth(60.0, TICK).map_err(wrong)?;
    let mut counter = Counter::<16>::at(1234);

    // A turn in 0.5 s, as the set-point; and the counts of an encoder on a machine that follows it.
    let turn = Move::new(Law::Polynomial345, 0.0, TAU, 0.5).map_err(|_| "the move is not valid")?;
    let (mut saturated, mut checksum, mut worst) = (0u32, 0u32, 0.0f32);
    println!("tick  count     speed    wanted   needed     motor   clipped");
    for k in 0..TICKS {
        let wanted = turn.at(f32::from(k) * TICK);
        // What the timer's register shows.
        let register = (1234 - (wanted.phi / TAU * COUNTS) as i32) as u16;

        // From here on it is the interrupt of the drive.
        let count = counter.extend(register.into());
        let tracked = tracker.update(ENCODER.phase_wide(count));
        let speed: f32 = tick.omega(tracked).value;
        let reference = Motion {
            phase: tracked.phase,
            omega: wanted.omega,
            alpha: wanted.alpha,
        };
        let friction = ramp.at(reference.omega);
        let needed = feed_forward.at_reference(lead.later(reference), friction);
        let motor = gearbox.motor(needed.torque, reference.omega, reference.alpha);
        let command = limits.limited(motor.value);
        // To here: `command.torque` goes to the current controller.

        if !needed.status.is_valid() {
            return Err("the table was not made for this motion".into());
        }
        saturated += u32::from(command.clipped != 0.0);
        worst = worst.max((speed - wanted.omega).abs());
        for bits in [speed.to_bits(), command.torque.to_bits()] {
            checksum = (checksum ^ bits).wrapping_mul(16_777_619);
        }
        if k % 50 == 0 {
            println!(
                "{:4} {:7} {:6} mrad/s {:6} {:6} N m {:6} mN m {:6}",
                k,
                count,
                milli(speed),
                milli(wanted.omega),
                milli(needed.torque) / 1000,
                milli(command.torque),
                milli(command.clipped)
            );
        }
    }
    println!("checksum {checksum:08x}, {saturated} of {TICKS} ticks limited");
    println!("largest error of the speed {} mrad/s", milli(worst));
    if worst < 1.0 {
        Ok(())
    } else {
        Err("the filter does not follow".into())
    }
}

program!(run);
