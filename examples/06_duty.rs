//! The duty meter: a press that checks its own sizing.
//!
//! Each tick the press table gives the torque for the motion; a real drive would feed the measured torque. After a cycle the meter has the figures of
//! `jred size`, and compares them with the motor's limits.
//!
//! ```text
//! cargo run -p jred --example 06_duty                                               on the host
//! cargo run -p jred --example 06_duty --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use jred::duty::{Curve, Limits, Meter, Verdict, Window};
use jred::machine::motion::{Law, Move};
use jred::{CurveSet, Image, Model, Phase, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Period of a tick (s).
const STEP: f32 = 0.5e-3;
/// Ticks of the crank's turn, and of the rest after it.
const TURN: u16 = 1200;
const REST: u16 = 400;
/// Ratio between motor and crank.
const RATIO: f32 = 5.0;
/// Inertia of rotor and gearbox at the motor (kg·m²).
const ROTOR: f32 = 0.0029;

/// Limits of the motor: S1 torque and peak torque over speed, N·m over rad/s.
const CONTINUOUS: [[f32; 2]; 2] = [[0.0, 14.4], [209.0, 11.2]];
const PEAK: [[f32; 2]; 3] = [[0.0, 43.0], [160.0, 43.0], [209.0, 25.0]];

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::NotChecked => "not checked",
        Verdict::Satisfied => "satisfied",
        Verdict::Exceeded => "EXCEEDED",
    }
}

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_f32.jred"))?;
    let press: Model<'_, Spline<f32>, PRESS> = image.model()?;
    let turn = Move::new(
        Law::Polynomial345,
        0.0,
        core::f32::consts::TAU,
        f32::from(TURN) * STEP,
    )?;

    let limits = Limits::new()
        .with_continuous(Curve::new(&CONTINUOUS)?)
        .with_peak(Curve::new(&PEAK)?)
        .with_speed(209.0)
        .with_output_peak(220.0)
        .with_output_mean(110.0)
        .with_cycles_per_hour(1000.0);
    let mut meter = Meter::new(limits, STEP, Window::SinceStart)?;

    for _ in 0..2 {
        for k in 0..TURN + REST {
            let state = turn.at((f32::from(k) + 0.5) * STEP);
            let phase = Phase::from_radians_f32(state.phi);
            let output = press.torque(phase, state.omega, state.alpha);
            let torque = output / RATIO + ROTOR * RATIO * state.alpha;
            meter.tick(torque, RATIO * state.omega, output);
        }
        meter.count_cycle();
    }
    // A failed sensor is reported, and does not affect the figures.
    meter.tick(f32::NAN, 0.0, 0.0);

    let figures = meter.figures();
    println!("RMS torque          {:9} mN m", milli(figures.rms_torque));
    println!("peak torque         {:9} mN m", milli(figures.peak_torque));
    println!("mean speed          {:9} mrad/s", milli(figures.mean_speed));
    println!("largest speed       {:9} mrad/s", milli(figures.peak_speed));
    println!("gearbox, cubic mean {:9} mN m", milli(figures.output_mean));
    println!("gearbox, peak       {:9} mN m", milli(figures.output_peak));
    println!(
        "energy in, back     {:9} mJ {} mJ",
        milli(figures.motoring_energy),
        milli(figures.regenerative_energy)
    );
    println!(
        "share of peak curve {:9} of 1000",
        milli(figures.peak_share.unwrap_or_default())
    );
    println!(
        "{} cycles in {} ms, {} ticks, {} invalid",
        figures.cycles,
        milli(figures.duration),
        figures.ticks,
        figures.invalid
    );
    // The bits reveal every difference between host and target.
    println!(
        "{:08x} {:08x} {:08x}",
        figures.rms_torque.to_bits(),
        figures.output_mean.to_bits(),
        figures.regenerative_energy.to_bits()
    );

    let verdicts = meter.verdicts();
    println!("RMS torque at mean speed: {}", word(verdicts.rms_torque));
    println!("torque-speed curve:       {}", word(verdicts.peak_torque));
    println!("speed:                    {}", word(verdicts.speed));
    println!("gearbox peak:             {}", word(verdicts.output_peak));
    println!("gearbox cubic mean:       {}", word(verdicts.output_mean));
    println!(
        "brake resistor:           {}",
        word(verdicts.regenerative_power)
    );
    println!(
        "cycles an hour:           {}",
        word(verdicts.cycles_per_hour)
    );
    println!("readings:                 {}", word(verdicts.readings));
    Ok(())
}

program!(run);
