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
    Checked, Counter, Counting, Encoder, FeedForward, Gearbox, Limited, Motion, Mounting, Period,
    Ramp, TorqueLimits, Tracker, Transmission,
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
/// What the encoder shows when the program starts.
const START: i64 = 1234;

/// What the interrupt of the drive works with.
struct Axis<'a> {
    counter: Counter<16>,
    tracker: Tracker,
    tick: Period<f32>,
    lead: Period<f32>,
    ramp: Ramp<f32>,
    press: FeedForward<'a, Spline<f32>, PRESS>,
    gearbox: Transmission<f32>,
    limits: TorqueLimits<f32>,
}

/// What it has found: the speed of the crank, the torque on it, and the motor's torque within its limits.
struct Found {
    count: i64,
    speed: f32,
    needed: Checked<f32>,
    motor: Limited<f32>,
}

impl<'a> Axis<'a> {
    fn new(image: &Image<'a>) -> Result<Self, Failure> {
        let model: Model<'a, Spline<f32>, PRESS> = image.model()?;
        let wrong = |_| "a figure of the axis is wrong";
        Ok(Self {
            counter: Counter::at(START),
            // From where the machine is: elsewhere the filter would start with a jump.
            tracker: Tracker::with_bandwidth(60.0, TICK)
                .map_err(wrong)?
                .at(ENCODER.phase_wide(START)),
            tick: Period::new(TICK, &model).map_err(wrong)?,
            lead: Period::new(LEAD, &model).map_err(wrong)?,
            ramp: Ramp::new(0.05, &model).map_err(wrong)?,
            press: FeedForward::new(model, image.validity()),
            gearbox: Transmission::new(GEARBOX, &model).map_err(wrong)?,
            limits: TorqueLimits::new(-6.0, 6.0).map_err(wrong)?,
        })
    }

    /// Of the timer's register, and of the speed and the acceleration that the crank shall have.
    #[inline(never)]
    fn interrupt(&mut self, register: u16, [omega, alpha]: [f32; 2]) -> Found {
        let count = self.counter.extend(register.into());
        let tracked = self.tracker.update(ENCODER.phase_wide(count));
        let speed = self.tick.omega(tracked).value;
        let reference = Motion {
            phase: tracked.phase,
            omega,
            alpha,
        };
        // Where the machine will be when the torque acts; friction by the sign of the set-point.
        let measured = Motion {
            omega: speed,
            ..reference
        };
        let later = self.lead.later(measured).value;
        let friction = self.ramp.at(omega);
        let needed = self
            .press
            .at_measured(later.phase, later.omega, reference, friction);
        let motor = self.gearbox.motor(needed.torque, omega, alpha).value;
        Found {
            count,
            speed,
            needed,
            motor: self.limits.limited(motor), // its `torque` goes to the current controller
        }
    }
}

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let mut axis = Axis::new(&image)?;
    // A turn in 0.5 s: the set-point, and the machine, which follows it.
    let turn = Move::new(Law::Polynomial345, 0.0, TAU, 0.5).map_err(|_| "the move is not valid")?;
    let (mut limited, mut checksum, mut worst) = (0u32, 0u32, 0.0f32);
    println!("tick   count     speed  of crank  set-point    needed    motor   clipped");
    for k in 0..TICKS {
        let wanted = turn.at(f32::from(k) * TICK);
        // What the timer's register shows.
        let register = (1234 - (wanted.phi / TAU * COUNTS) as i32) as u16;
        let found = axis.interrupt(register, [wanted.omega, wanted.alpha]);

        if !found.needed.status.is_valid() {
            return Err("the table was not made for this motion".into());
        }
        limited += u32::from(found.motor.clipped != 0.0);
        worst = worst.max((found.speed - wanted.omega).abs());
        for bits in [found.speed.to_bits(), found.motor.torque.to_bits()] {
            checksum = (checksum ^ bits).wrapping_mul(16_777_619);
        }
        if k % 50 == 0 {
            println!(
                "{:4} {:7} {:9} mrad/s {:9} {:9} N m {:5} mN m {:5}",
                k,
                found.count,
                milli(found.speed),
                milli(wanted.omega),
                milli(found.needed.torque) / 1000,
                milli(found.motor.torque),
                milli(found.motor.clipped)
            );
        }
    }
    println!("checksum {checksum:08x}, {limited} of {TICKS} ticks limited");
    println!("largest error of the speed {} mrad/s", milli(worst));
    if worst < 1.0 {
        Ok(())
    } else {
        Err("the filter does not follow".into())
    }
}

program!(run);
