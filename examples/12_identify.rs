//! J(φ), load and friction of a machine, found by its own drive, and used as feed-forward.
//!
//! A simulated machine turns under a controller that follows a speed with four frequencies. Its drive reads an encoder with 14 bits and a noisy
//! torque. After half a minute it knows the machine, and feeds the torque forward.
//!
//! ```text
//! cargo run -p jred --example 12_identify                                                      on the host
//! cargo run -p jred --example 12_identify --profile firmware --target thumbv7em-none-eabihf    on a Cortex-M4F in QEMU
//! ```
//!
//! The identification takes 8 kB, which a Cortex-M0 with 16 kB has, but not the time.
//! runs on: cortex-m4 cortex-m7 cortex-m33
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use jred::axis::{
    Found, FoundStatus, Identification, IdentificationSettings, MotionState, Period, Tracker,
};
use jred::harmonic::{Circular, terms};
use jred::number::FrictionSign;
use jred::table::{Shape, Table};
use jred::{CurveSet, Harmonic, Model, Phase, curves};
use support::{Failure, milli, println, program};

const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS | terms::GENERAL;
/// Three harmonics.
const HARMONICS: u32 = 3;
const WORDS: usize = 4 + 4 * HARMONICS as usize;
type Machine<'a> = Model<'a, Harmonic<f32>, SET>;

/// Nobody knows it: J (kg·m²), load, b, c; then cosine and sine of J and of the load, three times.
const TRUTH: [f32; WORDS] = [
    0.35, 0.0, 0.3, 2.5, //
    -0.01, 0.02, 4.0, -9.0, //
    -0.14, 0.01, 0.5, 2.0, //
    0.008, 0.0, 0.0, 0.4,
];

/// Period of a tick (s).
const TICK: f32 = 0.001;
/// Mean speed, and the part of each wave (rad/s); their frequencies as phases per tick.
const OMEGA: f32 = 9.0;
const WAVES: [(f32, u32); 4] = [
    (1.1, 1_590_000),
    (0.8, 3_560_000),
    (0.7, 8_290_000),
    (0.6, 13_600_000),
];
/// Torque of the controller for an error of the speed (N·m·s/rad).
const GAIN: f32 = 25.0;
/// The torque's noise is uniform up to this (N·m).
const NOISE: f32 = 0.3;
/// Of an encoder with 2¹⁴ counts.
const COUNT: u32 = 1 << 18;

struct Drive {
    truth: Machine<'static>,
    step: Period<f32>,
    tick: Period<f32>,
    tracker: Tracker,
    motion: MotionState<f32>,
    measured: Phase,
    time: u32,
    noise: u32,
    /// The torque that acts, and sums of squares of the speed's error.
    acted: f32,
    off: f32,
}

impl Drive {
    /// The set-point's speed and acceleration now.
    fn set_point(&self) -> (f32, f32) {
        let mut set = (OMEGA, 0.0);
        for (size, step) in WAVES {
            let (sin, cos) = f32::sin_cos_of(Phase::from_bits(self.time.wrapping_mul(step)));
            let rate = step as f32 * (core::f32::consts::TAU / 4_294_967_296.0 / TICK);
            set = (set.0 + size * sin, set.1 + size * rate * cos);
        }
        set
    }

    /// A tick with this model in the feed-forward: the phase, and the torque that acted before it, as the drive reads them.
    fn tick(&mut self, known: Option<&Machine<'_>>) -> (Phase, f32) {
        for _ in 0..4 {
            let MotionState { phase, omega, .. } = self.motion;
            let alpha = self.truth.acceleration(phase, omega, self.acted);
            self.motion.alpha = alpha.value;
            self.motion = self.step.later(self.motion).value;
        }
        self.measured = Phase::from_bits(self.motion.phase.to_bits() / COUNT * COUNT);
        self.noise = self
            .noise
            .wrapping_mul(1_664_525)
            .wrapping_add(1_013_904_223);
        let noise = NOISE * ((self.noise as i32) as f32 / 2_147_483_648.0);
        let read = (self.measured, self.acted + noise);

        let tracked = self.tracker.update(self.measured);
        let omega = self.tick.omega(tracked).value;
        let (set, alpha) = self.set_point();
        self.time += 1;
        self.acted = GAIN * (set - omega);
        if let Some(known) = known {
            let sliding = FrictionSign::OfSpeed(set);
            self.acted += known.torque_with(self.measured, set, alpha, sliding);
        }
        let off = set - self.motion.omega;
        self.off += off * off;
        read
    }

    /// The root mean square of the speed's error in 4 s (mrad/s).
    fn deviation(&mut self, known: Option<&Machine<'_>>) -> u64 {
        for _ in 0..1000 {
            self.tick(known);
        }
        self.off = 0.0;
        for _ in 0..4000 {
            self.tick(known);
        }
        // Twice the root, so that it can be rounded.
        ((self.off / 4000.0 * 4e6) as u64).isqrt().div_ceil(2)
    }
}

fn run() -> Result<(), Failure> {
    let truth: Machine<'_> = Model::new(Table::new(&TRUTH, Shape::harmonics(HARMONICS, SET))?)?;
    let mut drive = Drive {
        step: Period::new(0.25 * TICK, &truth)?,
        tick: Period::new(TICK, &truth)?,
        tracker: Tracker::with_bandwidth(60.0, TICK)?,
        truth,
        motion: MotionState::default(),
        measured: Phase::default(),
        time: 0,
        noise: 1,
        acted: 0.0,
        off: 0.0,
    };
    let settings = IdentificationSettings {
        period: TICK,
        max_speed: 14.0,
        inertia: 0.5,
        // The torque acted in the period before the phase.
        torque_delay: 0.5 * TICK,
        torque_noise: NOISE / 1.732,
        angle_noise: core::f32::consts::TAU / 16_384.0 / 3.464,
        memory: f32::INFINITY,
    };
    let mut identification = Identification::<f32, WORDS, 256, SET>::new(&settings, &[])?;
    for _ in 0..1000 {
        drive.tick(None);
    }
    // The tick; every 0.4 s the background.
    for _ in 0..75 {
        for _ in 0..400 {
            let (phase, torque) = drive.tick(None);
            identification.add(phase, torque);
        }
        identification.adopt(&identification.equations().solve());
    }
    let found: Found<f32, WORDS> = identification.equations().solve();
    if found.status != FoundStatus::Good {
        return Err("the machine is not identified".into());
    }
    println!(
        "{} rows, residual {} of 1000 parts of the stated noise",
        found.rows,
        milli(found.residual)
    );
    let known: Machine<'_> =
        Model::new(Table::new(found.words(), Shape::harmonics(HARMONICS, SET))?)?;
    println!("  phase     J true    found     +- (mg m2)");
    for eighth in 0..8u32 {
        let phase = Phase::from_bits(eighth << 29);
        // The torque of an acceleration of 1 rad/s2 at rest, less that of none.
        let exact = drive.truth.torque(phase, 0.0, 1.0) - drive.truth.torque(phase, 0.0, 0.0);
        let [inertia, band] = found.inertia(phase);
        println!(
            "{:3} deg   {:6}   {:6}   {:6}",
            45 * eighth,
            milli(exact),
            milli(inertia),
            milli(1000.0 * band)
        );
    }
    let [_, _, viscous, coulomb, ..] = found.coefficients;
    println!(
        "friction {} mN m s and {} mN m",
        milli(viscous),
        milli(coulomb)
    );
    let [without, with] = [drive.deviation(None), drive.deviation(Some(&known))];
    println!("the speed is off by {without} mrad/s without feed-forward, {with} with it");
    Ok(())
}

program!(run);
