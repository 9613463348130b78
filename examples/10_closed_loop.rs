//! The worth of a table: a press under the controller of its drive, with and without feed-forward.
//!
//! The idle stroke of the press of `machines/press.toml`, 120 a minute. The machine moves by its exact mechanics, in double precision; the controller
//! computes in single precision, sees an encoder's counts and reaches the machine a tick and a current loop late. `docs/closed-loop.md` describes the
//! loop, and has more machines, speeds and errors of the model.
//!
//! ```text
//! cargo run -p jred --example 10_closed_loop                                               on the host
//! cargo run -p jred --example 10_closed_loop --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
//!
//! A machine under construction needs more stack than the 16 KiB of the Cortex-M0 of the examples.
//!
//! runs on: cortex-m3 cortex-m4 cortex-m7 cortex-m33
//! computes in: double precision
#![cfg_attr(target_os = "none", no_std, no_main)]

#[path = "support/closed_loop.rs"]
mod closed_loop;
mod support;

use core::f32::consts::{PI, TAU};

use closed_loop::{COUNTS, Cascade, Figures, LEAD, Stepped, TICK, run as run_loop};
use jred::axis::{FeedForward, MotionState};
use jred::error::Error;
use jred::image::Validity;
use jred::machine::motion::{Law, Move};
use jred::machine::{Action, Link, Load, Machine, MassProperties, Reducible as _};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use jred::number::FrictionSign;
use jred::table::words_len;
use jred::tabulate::{fill, scratch_len};
use jred::{CurveSet, Model, Phase, Scale, Spline, curves};
use support::{Failure, milli, println, program};

const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
const CELLS: u32 = 32;
/// A stroke takes 0.4 s; a rest follows. In ticks.
const STROKE: u16 = 1600;
const CYCLE: u16 = 2000;
/// Places over which the inertia is averaged.
const PLACES: u32 = 64;

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        println!("{error}");
        Self::Claim("the machine was refused")
    }
}

/// The press without its pressing force, with the belt in front of it.
fn press() -> Result<Machine<SliderCrank>, Error> {
    let dimensions = SliderCrankDimensions {
        crank: 0.03,
        rod: 0.18,
        offset: 0.0,
    };
    let crank = Link::new(MassProperties {
        mass: 9.0,
        inertia: 0.018,
        com: [0.006, 0.0],
    })?;
    let rod = Link::new(MassProperties {
        mass: 6.5,
        inertia: 0.03,
        com: [0.055, 0.0],
    })?;
    let links = [crank, rod, Link::point_mass(42.0)?];
    let guide = Load::new(SliderCrank::SLIDER, Action::OpposingForce(150.0))?;
    let bearings = Load::new(SliderCrank::CRANK, Action::ViscousMoment(0.4))?;
    let mechanism = SliderCrank::new(dimensions, Branch::Right, links)?;
    Ok(Machine::new(mechanism)
        .with_gravity([9.81, 0.0])?
        .with_flywheel(0.05 + 0.044_04)?
        .with_load(guide)?
        .with_load(bearings)?)
}

/// The mean of its inertia (kg·m²).
fn mean_inertia(machine: &Machine<SliderCrank>) -> Result<f32, Error> {
    let mut sum = 0.0;
    for place in 0..PLACES {
        let phi = f64::from(place) / f64::from(PLACES) * core::f64::consts::TAU;
        sum += machine.reduction(phi)?.inertia;
    }
    Ok((sum / f64::from(PLACES)) as f32)
}

/// Root mean square of the feedback torque, and the largest following error, of the second of two cycles.
fn measure(
    machine: &Machine<SliderCrank>,
    inertia: f32,
    ahead: impl Fn(MotionState<f32>) -> f32,
) -> Result<Figures, Failure> {
    // From top dead centre to top dead centre.
    let stroke = Move::new(Law::Polynomial345, PI, TAU, f32::from(STROKE) * TICK)?;
    let at = |time: f32| {
        let state = stroke.at(time);
        MotionState {
            phase: Phase::from_radians_f32(state.phi),
            omega: state.omega,
            alpha: state.alpha,
        }
    };
    let wanted = |tick: u32| {
        let time = (tick % u32::from(CYCLE)) as f32 * TICK;
        [at(time), at(time + LEAD)]
    };
    let start = core::f64::consts::PI;
    let mut plant = Stepped::new(machine, start).map_err(Error::from)?;
    let mut controller = Cascade::new(inertia, COUNTS, start)?;
    let mut figures = Figures::default();
    run_loop(
        &mut plant,
        &mut controller,
        2 * u32::from(CYCLE),
        wanted,
        ahead,
        |tick, seen| {
            if tick >= u32::from(CYCLE) {
                figures.add(seen);
            }
        },
    )
    .map_err(Error::from)?;
    Ok(figures)
}

fn run() -> Result<(), Failure> {
    let machine = press()?;
    let inertia = mean_inertia(&machine)?;
    let mut scratch = [0.0; scratch_len(CELLS, PRESS)];
    let mut words = [0.0; words_len::<Spline<f32>>(CELLS, PRESS)];
    let table = fill(&machine, PRESS, CELLS, &Scale::SI, &mut scratch, &mut words)?;
    let model: Model<'_, Spline<f32>, PRESS> = Model::new(table)?;
    let validity = Validity {
        max_speed: 35.0,
        max_acceleration: 250.0,
        torque_error: 0.1,
    };
    let model = FeedForward::new(model, validity);

    println!("mean inertia {} g m2", milli(inertia));
    println!("feed-forward        RMS feedback torque    largest following error");
    let mut squares = [0.0; 3];
    for (way, name) in ["none", "mean inertia", "jred"].into_iter().enumerate() {
        let figures = measure(&machine, inertia, |motion| match way {
            0 => 0.0,
            1 => inertia * motion.alpha,
            _ => {
                let friction = FrictionSign::OfSpeed(motion.omega);
                model.at_reference(motion, friction).torque
            }
        })?;
        squares[way] = figures.mean_square();
        println!(
            "{:<12} {:16} mN m {:20} urad",
            name,
            ((figures.mean_square() * 1e6) as u64).isqrt(),
            milli(figures.error * 1000.0)
        );
    }
    // At least 20 times less.
    if squares[2] * 400.0 < squares[1] {
        Ok(())
    } else {
        Err("the table is not worth 20 times its mean inertia".into())
    }
}

program!(run);
