//! A motion planned on a host, followed tick by tick: the fastest stroke of the press with its drive, with its torque, at a rate changed by an
//! operator.
//!
//! This command writes the plan, ten rows for a stroke of 0.35 s and a rest of 0.1 s (`scripts/test images`):
//!
//! ```text
//! jred fastest machines/press.toml --torque "50 N m" --motor-speed "3000 rpm" --max-speed "28 rad/s" \
//!     --max-acceleration "220 rad/s^2" --plan examples/data/press_plan.jred
//! ```
//!
//! The program follows it at 100 %, then at 40 %, holds, and continues at 100 % to the end.
//!
//! ```text
//! cargo run -p jred --example 09_plan                                               on the host
//! cargo run -p jred --example 09_plan --profile firmware --target thumbv7em-none-eabihf      on a Cortex-M4F in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use jred::axis::{FeedForward, Override, Plan, PlanFollower, PlanState};
use jred::number::FrictionSign;
use jred::{CurveSet, Image, Model, Phase, Q31, Spline, curves, include_image};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// Period of a tick, and time of a change of the rate from 0 to 100 % (s).
const TICK: f32 = 0.000_5;
const RAMP: f32 = 0.13;
/// More than the plan needs at these rates.
const TICKS: u16 = 2000;

/// The operator's command.
fn commanded(tick: u16) -> Override {
    Override::percent(match tick {
        330..600 => 40,
        600..800 => 0,
        _ => 100,
    })
}

fn tenths(phase: Phase) -> u32 {
    ((u64::from(phase.to_bits()) * 3600) >> 32) as u32
}

const fn name(stage: PlanState) -> &'static str {
    match stage {
        PlanState::Waiting => "waiting",
        PlanState::Running => "running",
        PlanState::Held => "held",
        PlanState::Done => "done",
    }
}

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_q31.jred"))?;
    let press: Model<'_, Spline<Q31>, PRESS> = image.model()?;
    let plan = Plan::from_bytes(include_image!("data/press_plan.jred"), &press)?
        .of_machine(image.machine())?;
    let feed_forward = FeedForward::new(press, image.validity());
    let mut follower = PlanFollower::new(plan, TICK, RAMP, &press)?;
    let scale = image.scale();
    println!(
        "{} rows, {} ms, up to {} mrad/s",
        plan.rows(),
        milli(plan.duration()),
        milli(plan.max_speed())
    );
    println!("tick   stage        at        speed     torque");
    follower.start();
    let (mut most, mut checksum, mut last) = (0.0_f32, 0_u32, None);
    for tick in 0..TICKS {
        let planned = follower.next(commanded(tick));
        let motion = planned.motion;
        let needed = feed_forward.at_reference(motion, FrictionSign::OfSpeed(motion.omega));
        if planned.limited || !needed.status.is_valid() {
            return Err("a motion that the table was not made for".into());
        }
        let torque = scale.torque_si(needed.torque);
        most = most.max(torque.abs());
        checksum = (checksum ^ motion.phase.to_bits() ^ needed.torque.to_bits().cast_unsigned())
            .wrapping_mul(16_777_619);
        let ended = planned.state == PlanState::Done;
        if tick % 50 == 0 || ended {
            let (turns, tenths) = (planned.turns, tenths(motion.phase));
            println!(
                "{:4}   {:7} {} turn {:3}.{} deg {:6} mrad/s {:4} N m",
                tick,
                name(planned.state),
                turns,
                tenths / 10,
                tenths % 10,
                milli(scale.omega_si(motion.omega)),
                milli(torque) / 1000
            );
        }
        if ended {
            last = Some(planned);
            break;
        }
    }
    println!("checksum {checksum:08x}, up to {} N m", milli(most) / 1000);
    match last {
        Some(end) if end.turns == 1 && end.motion.phase.to_bits() == 1 << 31 => Ok(()),
        _ => Err("it did not end at 540 deg".into()),
    }
}

program!(run);
