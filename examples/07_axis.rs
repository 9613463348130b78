//! From an encoder count to the torque command of the motor: the interrupt of a drive.
//!
//! The press turns behind a gearbox of ratio 20. Its encoder of 10 000 counts is on the motor, counts down, and reads 1234 at φ = 0, in a 16-bit
//! counter that overflows three times per turn. The program moves the press, generates the counts of this encoder, and from them alone gets phase,
//! speed and acceleration, and the motor's torque.
//!
//! ```text
//! cargo run -p jred --example 07_axis                                               on the host
//! cargo run -p jred --example 07_axis --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use core::f32::consts::TAU;

use jred::axis::{
    CheckedTorque, Counter, Counting, Encoder, FeedForward, FrictionRamp, Gearbox, LimitedTorque,
    MotionState, Mounting, Period, TorqueLimits, Tracker, Transmission,
};
use jred::machine::motion::{Law, Move};
use jred::{CurveSet, Image, Model, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// A wrong figure does not compile.
const ENCODER: Encoder = match Encoder::new(Mounting {
    counts_per_turn: 10_000,
    gear: [20, 1],
    counting: Counting::Down,
    homing_offset: 1234,
}) {
    Ok(encoder) => encoder,
    Err(_) => panic!("the encoder's figures"),
};
/// Counts per turn of the crank.
const COUNTS: f32 = 200_000.0;

const GEARBOX: Gearbox = Gearbox {
    ratio: 20.0,
    efficiency: 0.95,
    rotor: 0.000_3,
};
/// Period of a tick, and delay from a command to the torque (s).
const TICK: f32 = 0.000_5;
const LEAD: f32 = 0.000_2;
const TICKS: u16 = 1000;
/// Count of the encoder when the program starts.
const START: i64 = 1234;

/// State of the drive's interrupt.
struct Axis<'a> {
    counter: Counter<16>,
    tracker: Tracker,
    tick: Period<f32>,
    lead: Period<f32>,
    ramp: FrictionRamp<f32>,
    press: FeedForward<'a, Spline<f32>, PRESS>,
    gearbox: Transmission<f32>,
    limits: TorqueLimits<f32>,
}

/// Its results: the speed of the crank, the torque on it, and the motor's torque within its limits.
struct Found {
    count: i64,
    speed: f32,
    needed: CheckedTorque<f32>,
    motor: LimitedTorque<f32>,
}

impl<'a> Axis<'a> {
    fn new(image: &Image<'a>) -> Result<Self, Failure> {
        let model: Model<'a, Spline<f32>, PRESS> = image.model()?;
        Ok(Self {
            counter: Counter::at(START),
            // Start at the machine's position, otherwise the filter would start with a jump.
            tracker: Tracker::with_bandwidth(60.0, TICK)?.at(ENCODER.phase_wide(START)),
            tick: Period::new(TICK, &model)?,
            lead: Period::new(LEAD, &model)?,
            ramp: FrictionRamp::new(0.05, &model)?,
            press: FeedForward::new(model, image.validity()),
            gearbox: Transmission::new(GEARBOX, &model)?,
            limits: TorqueLimits::new(-6.0, 6.0)?,
        })
    }

    /// For the timer's register, and the set-points of the crank's speed and acceleration.
    #[inline(never)]
    fn interrupt(&mut self, register: u16, [omega, alpha]: [f32; 2]) -> Found {
        let count = self.counter.extend(register.into());
        let tracked = self.tracker.update(ENCODER.phase_wide(count));
        let speed = self.tick.omega(tracked).value;
        let reference = MotionState {
            phase: tracked.phase,
            omega,
            alpha,
        };
        // Position of the machine when the torque acts; friction by the sign of the set-point.
        let measured = MotionState {
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
    let turn = Move::new(Law::Polynomial345, 0.0, TAU, 0.5)?;
    let (mut limited, mut checksum, mut worst) = (0u32, 0u32, 0.0f32);
    println!("tick   count     speed  of crank  set-point    needed    motor   clipped");
    for k in 0..TICKS {
        let wanted = turn.at(f32::from(k) * TICK);
        // The value of the timer's register.
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
