//! The same bits everywhere: digests of random ticks of every format and number type.
//!
//! ```text
//! cargo run --release -p jred-bits-example
//! cargo run -p jred-bits-example --profile firmware --target thumbv7em-none-eabihf
//! scripts/test bits      on the host, on five Cortex-M cores, as WebAssembly and on AArch64
//! ```
//!
//! A tick is a torque and an acceleration at a random phase, speed, acceleration and torque: over the whole range of fixed point, or up to twice the
//! validity of a table in `f32`. A plan's tick is its state at a random time, and its follower's state at a changing rate. Every bit of their results
//! counts. Digests are printed on the way, so that a core without a floating-point unit can stop early and still be compared.
#![cfg_attr(target_os = "none", no_std, no_main)]
#![forbid(unsafe_code)]

#[path = "../../support/mod.rs"]
#[allow(dead_code, reason = "here everything is printed as bits")]
mod support;

use jred::axis::{Override, Plan, PlanFollower};
use jred::harmonic::terms;
use jred::image::Validity;
use jred::number::{Number, Quantity};
use jred::table::Format;
use jred::{
    Cubic, CurveSet, Domain, Harmonic, Image, Model, Outcome, Phase, Pieces, Q15, Q31, Quadratic,
    Rows16, SliderCrankForm, Spline, Spline16, curves, include_image, slider_crank,
};
use support::{Failure, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
/// With a curve of 1/J instead of a division.
const SEED: CurveSet = PRESS | curves::RECIPROCAL;
/// The curves of the saw as harmonics.
const SAW: CurveSet =
    PRESS | terms::INERTIA_COS | terms::LOAD_COS | terms::LOAD_SIN | terms::COULOMB_SIN;

/// The curves and terms of the feeder as a slider-crank.
const FEEDER: CurveSet = curves::LOAD
    | curves::VISCOUS
    | curves::COULOMB
    | curves::CONSTANT_COULOMB
    | slider_crank::terms::INERTIA_COS
    | slider_crank::terms::LOAD_SIN
    | slider_crank::terms::LOAD_COS;

/// Numbers of ticks of each model after which the digests are printed.
const STAGES: [u32; 3] = [10_000, 100_000, 1_000_000];
/// Number of stages: one where single precision is software.
const PRINTED: usize = if cfg!(all(target_os = "none", not(target_abi = "eabihf"))) {
    1
} else {
    STAGES.len()
};

/// State after the ticks of a model.
#[derive(Clone, Copy)]
struct Run {
    random: u32,
    ticks: u32,
    digest: u32,
    saturated: u32,
}

impl Run {
    const fn new() -> Self {
        Self {
            random: 2_463_534_242,
            ticks: 0,
            digest: 2_166_136_261,
            saturated: 0,
        }
    }

    /// Xorshift of G. Marsaglia (*J. Stat. Softw.* 8, 2003).
    fn random(&mut self) -> u32 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 17;
        self.random ^= self.random << 5;
        self.random
    }

    /// FNV-1a of G. Fowler, L. C. Noll and K.-P. Vo, word by word: a single different word always shows.
    fn digest(&mut self, bits: u32) {
        self.digest = (self.digest ^ bits).wrapping_mul(16_777_619);
    }
}

/// A number of the tick as bits.
trait Word: Number {
    /// A random number: of its whole range and smaller ones down to 2⁻⁷ of it, or up to twice the limit.
    fn random(bits: u32, limit: f32) -> Self;
    /// `None` for NaN.
    fn bits(self) -> Option<u32>;
}

impl Word for f32 {
    fn random(bits: u32, limit: f32) -> Self {
        bits.cast_signed() as f32 * (limit / 1_073_741_824.0)
    }
    fn bits(self) -> Option<u32> {
        self.is_finite().then_some(self.to_bits())
    }
}

impl Word for Q31 {
    fn random(bits: u32, _: f32) -> Self {
        Self::from_bits(bits.cast_signed() >> (bits % 8))
    }
    fn bits(self) -> Option<u32> {
        Some(self.to_bits().cast_unsigned())
    }
}

impl Word for Q15 {
    fn random(bits: u32, _: f32) -> Self {
        Self::from_bits((bits >> 16) as i16 >> (bits % 8))
    }
    fn bits(self) -> Option<u32> {
        Some(i32::from(self.to_bits()).cast_unsigned())
    }
}

/// A model: ticks from its place in flash, up to this number.
type Ticks = fn(&mut Run, u32) -> Result<(), Failure>;

/// A name, a format, its curves and its image.
macro_rules! models {
    ($($name:literal: $ticks:ident, $format:ty, $set:ident, $image:literal;)*) => {
        const MODELS: &[(&str, Ticks)] = &[
            $(($name, |run, until| $ticks::<$format, $set>(include_image!($image), run, until))),*
        ];
    };
}

models! {
    "f32 spline         ": of_model, Spline<f32>, PRESS, "../../data/press_f32.jred";
    "f32 spline, a piece": of_piece, Spline<f32>, PRESS, "../../data/press_f32.jred";
    "f32 cubic          ": of_model, Cubic<f32>, PRESS, "../data/f32_cubic.jred";
    "f32 quadratic      ": of_model, Quadratic<f32>, PRESS, "../data/f32_quadratic.jred";
    "f32 harmonics      ": of_model, Harmonic<f32>, SAW, "../data/f32_harmonic.jred";
    "f32 slider-crank   ": of_model, SliderCrankForm, FEEDER, "../data/f32_slider_crank.jred";
    "q31 spline         ": of_model, Spline<Q31>, PRESS, "../../data/press_q31.jred";
    "q31 cubic, 1/J     ": of_model, Cubic<Q31>, SEED, "../data/q31_cubic_seed.jred";
    "q31 quadratic, 1/J ": of_model, Quadratic<Q31>, SEED, "../data/q31_quadratic_seed.jred";
    "q31 spline16, 1/J  ": of_model, Spline16, SEED, "../data/q31_spline16_seed.jred";
    "q15 rows           ": of_model, Rows16, PRESS, "../data/q15_rows.jred";
    "q15 rows, 1/J      ": of_model, Rows16, SEED, "../data/q15_rows_seed.jred";
    "f32 plan           ": of_plan, Spline<f32>, PRESS, "../../data/press_f32.jred";
    "q31 plan           ": of_plan, Spline<Q31>, PRESS, "../../data/press_q31.jred";
    "q15 plan           ": of_plan, Rows16, PRESS, "../data/q15_rows.jred";
}

fn of_model<F: Format<Number: Word>, const SET: CurveSet>(
    image: &[u8],
    run: &mut Run,
    until: u32,
) -> Result<(), Failure> {
    let image = Image::from_bytes(image)?;
    let model: Model<'_, F, SET> = image.model()?;
    ticks::<F::Number>(
        run,
        until,
        image.validity(),
        |phase, omega, alpha| model.torque(phase, omega, alpha),
        |phase, omega, torque| model.acceleration(phase, omega, torque),
    )
}

/// The plan of the press, repeated at a rate that changes every few ticks, and at random times.
fn of_plan<F: Format<Number: Word>, const SET: CurveSet>(
    image: &[u8],
    run: &mut Run,
    until: u32,
) -> Result<(), Failure> {
    let model: Model<'_, F, SET> = Image::from_bytes(image)?.model()?;
    let plan = include_image!("../../data/press_plan.jred");
    let plan = Plan::from_bytes(plan, &model)?;
    let follower = PlanFollower::new(plan, 0.000_5, 0.13, &model);
    let mut follower = follower.and_then(PlanFollower::repeating)?;
    follower.start();
    let mut rate = Override::FULL;
    while run.ticks < until {
        if run.ticks.is_multiple_of(128) {
            rate = Override::percent(run.random() % 128);
        }
        let planned = follower.next(rate);
        // Up to half a second, slightly longer than the plan.
        let place = plan.at(u64::from(run.random()) << 7);
        for (motion, turns, limited) in [
            (planned.motion, planned.turns, planned.limited),
            (place.value.motion, place.value.turns, place.saturated),
        ] {
            run.digest(motion.phase.to_bits());
            run.digest(turns.cast_unsigned());
            for result in [motion.omega.number(), motion.alpha.number()] {
                run.digest(result.bits().ok_or("a result is not a number")?);
            }
            run.digest(limited.into());
            run.saturated += u32::from(limited);
        }
        run.ticks += 1;
    }
    Ok(())
}

/// The whole turn as one piece that starts at some phase.
fn of_piece<F: Format<Number: Word>, const SET: CurveSet>(
    image: &[u8],
    run: &mut Run,
    until: u32,
) -> Result<(), Failure> {
    let image = Image::from_bytes(image)?;
    let turn: Pieces<'_, F, SET, 1> = Pieces::new(
        Domain::Turn,
        [(Phase::from_bits(0x1234_5679), image.model()?)],
    )?;
    ticks::<F::Number>(
        run,
        until,
        image.validity(),
        |phase, omega, alpha| turn.torque(phase, omega, alpha),
        |phase, omega, torque| turn.acceleration(phase, omega, torque),
    )
}

fn ticks<N: Word>(
    run: &mut Run,
    until: u32,
    validity: Validity,
    torque: impl Fn(Phase, N::Speed, N::Acceleration) -> N::Torque,
    acceleration: impl Fn(Phase, N::Speed, N::Torque) -> Outcome<N::Acceleration>,
) -> Result<(), Failure> {
    // N m, for f32
    const MOST_TORQUE: f32 = 500.0;
    while run.ticks < until {
        let phase = Phase::from_bits(run.random());
        // At standstill there is no friction.
        let standstill = run.ticks.is_multiple_of(16);
        let omega = match run.random() {
            _ if standstill => N::default(),
            bits => N::random(bits, validity.max_speed),
        };
        let omega = Quantity::of(omega);
        let alpha = Quantity::of(N::random(run.random(), validity.max_acceleration));
        let needed = torque(phase, omega, alpha);
        let drive = Quantity::of(N::random(run.random(), MOST_TORQUE));
        let gained = acceleration(phase, omega, drive);
        for result in [needed.number(), gained.value.number()] {
            run.digest(result.bits().ok_or("a result is not a number")?);
        }
        run.digest(gained.saturated.into());
        run.saturated += u32::from(gained.saturated);
        run.ticks += 1;
    }
    Ok(())
}

fn run() -> Result<(), Failure> {
    let mut runs = [Run::new(); MODELS.len()];
    for until in STAGES.into_iter().take(PRINTED) {
        println!("model                  digest  saturated");
        for ((name, ticks), run) in MODELS.iter().zip(&mut runs) {
            ticks(run, until)?;
            println!("{}  {:08x}  {:9}", name, run.digest, run.saturated);
        }
        println!("{until} ticks of each");
    }
    Ok(())
}

program!(run);
