//! The observer and the monitor: the torque of the load, seen from the encoder alone, and compared with itself.
//!
//! A simulated press, four steps a tick, turns under a noisy torque and an encoder with counts. The observer sees the torque that the table does not
//! contain. The monitor learns it from 64 turns, and goes on with the reference that it kept; then a part jams, and later a heavier die is mounted, whose mass the observer's load gives.
//!
//! ```text
//! cargo run -p jred --example 11_observer                                                    on the host
//! cargo run -p jred --example 11_observer --profile firmware --target thumbv6m-none-eabi     on a Cortex-M0 in QEMU
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;

use jred::axis::monitor::{Cycle, Monitor, Seen, Watch};
use jred::axis::{MotionState, Observed, Observer, Payload, Period};
use jred::number::FrictionSign;
use jred::{
    Acceleration, CurveSet, Image, Model, Phase, Q31, Speed, Spline, Torque, curves, include_image,
};
use support::{Failure, milli, println, program};

/// The curves of the press, as `jred export` prints them.
const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
type Press = Model<'static, Spline<Q31>, PRESS>;

/// Period of a tick (s).
const TICK: f32 = 0.001;
/// Corner frequency of the observer (Hz).
const BANDWIDTH: f32 = 60.0;
/// Speed of the crank (rad/s).
const OMEGA: f32 = 6.0;
/// Largest torque on the crank (N·m).
const LARGEST: f32 = 250.0;
/// Torque of the controller for an error of the speed (N·m·s/rad).
const GAIN: f32 = 4.0;
/// A jam, and the noise of the drive's torque (N·m).
const JAM: f32 = -16.0;
const NOISE: f32 = 1.6;
/// The encoder has 2¹⁸ counts per turn.
const COUNT: u32 = 1 << 14;
/// Parts of the turn that the monitor tells apart.
const BINS: usize = 64;

const WATCH: Watch = Watch {
    largest: LARGEST,
    reference: 32,
    cycles: 10_000,
    false_alarm: 0.001,
};

/// The torque that a die takes at this speed which is half as heavy as all moving parts.
fn die(press: &Press, phase: Phase, omega: Speed<Q31>) -> Torque<Q31> {
    let friction = FrictionSign::OfSpeed(omega);
    let velocity = press
        .torque_terms(phase, omega, Acceleration::default(), friction)
        .velocity;
    Torque::<Q31>::from_bits(velocity.to_bits() / 2)
}

/// The press that is simulated, and the drive's program.
struct Machine {
    press: Press,
    step: Period<Q31>,
    motion: MotionState<Q31>,
    noise: u32,
    /// Number of dies that are mounted, in addition to the usual one.
    dies: i32,
    speed: Speed<Q31>,
    observer: Observer<Q31>,
    seen: Observed<Q31>,
}

impl Machine {
    fn torque(&self, torque: f32) -> Torque<Q31> {
        self.press.table().scale().to_torque(torque).value
    }

    /// A noise between −1 and 1, the same in every run.
    fn random(&mut self) -> f32 {
        self.noise = self
            .noise
            .wrapping_mul(1_664_525)
            .wrapping_add(1_013_904_223);
        (self.noise as i32) as f32 / 2_147_483_648.0
    }

    /// A tick, with a load that nobody knows (N·m).
    fn tick(&mut self, load: f32) {
        // The drive's torque: that of the model, and a controller.
        let rest = Acceleration::default();
        let error = OMEGA - self.press.table().scale().omega_si(self.seen.motion.omega);
        let needed = self.press.torque(self.seen.motion.phase, self.speed, rest);
        let command = needed.saturating_add(self.torque(GAIN * error));

        let noise = NOISE * self.random();
        for _ in 0..4 {
            let MotionState { phase, omega, .. } = self.motion;
            let die = die(&self.press, phase, omega);
            let load = self.torque(load + noise);
            let mut acting = command.saturating_add(load);
            for _ in 0..self.dies {
                acting = acting.saturating_sub(die);
            }
            self.motion.alpha = self.press.acceleration(phase, omega, acting).value;
            self.motion = self.step.later(self.motion).value;
        }
        let measured = Phase::from_bits(self.motion.phase.to_bits() / COUNT * COUNT);

        let friction = FrictionSign::OfSpeed(self.speed);
        self.seen = self
            .observer
            .update(&self.press, measured, command, friction);
    }
}

/// A turn: the ticks with an alarm, and what the cycle showed.
fn turn(machine: &mut Machine, monitor: &mut Monitor<Q31, BINS>) -> (u32, Cycle) {
    let mut jams = 0;
    loop {
        let before = machine.seen.motion.phase.to_bits();
        machine.tick(0.0);
        let MotionState { phase, .. } = machine.seen.motion;
        if phase.to_bits() < before {
            return (jams, monitor.end_cycle());
        }
        jams += u32::from(monitor.tick(phase, machine.seen.load) == Seen::Jam);
    }
}

/// Learns the reference: the words for flash, and the number of turns.
#[inline(never)]
fn reference(
    machine: &mut Machine,
    unit: impl Fn(Phase) -> f32,
) -> Result<([u32; Monitor::<Q31, BINS>::REFERENCE_WORDS], u32), Failure> {
    let mut monitor = Monitor::<Q31, BINS>::new(WATCH, unit, &machine.press)?;
    let mut turns = 0;
    while !monitor.is_watching() {
        turn(machine, &mut monitor);
        turns += 1;
    }
    let mut words = [0; Monitor::<Q31, BINS>::REFERENCE_WORDS];
    let reference = monitor.reference().ok_or("no reference")?;
    for (word, learned) in words.iter_mut().zip(reference) {
        *word = learned;
    }
    Ok((words, turns))
}

/// After a loss of power: watches, with the words that were in flash.
#[inline(never)]
fn watch(machine: &mut Machine, unit: impl Fn(Phase) -> f32, words: &[u32]) -> Result<(), Failure> {
    let press = machine.press;
    let mut monitor = Monitor::<Q31, BINS>::with_reference(words, WATCH, unit, &press)?;
    for eighth in 0..8u32 {
        let phase = Phase::from_bits(eighth << 29);
        let [mean, limit] = monitor.usual(phase).ok_or("a bin is not known")?;
        println!(
            "{:3} deg {:6} mN m +- {:6} mN m",
            45 * eighth,
            milli(mean),
            milli(limit)
        );
    }
    let mut alarms = 0;
    for _ in 0..20 {
        let (jams, cycle) = turn(machine, &mut monitor);
        alarms += jams + u32::from(cycle.wear || cycle.wrong_payload);
    }
    println!("20 turns later: {alarms} alarms");

    // A part jams in the middle of the turn.
    while machine.seen.motion.phase.to_bits() < 1 << 31 {
        machine.tick(0.0);
        monitor.tick(machine.seen.motion.phase, machine.seen.load);
    }
    let start = machine.motion.phase.to_bits();
    let mut ticks = 0;
    loop {
        machine.tick(JAM);
        ticks += 1;
        if monitor.tick(machine.seen.motion.phase, machine.seen.load) == Seen::Jam {
            break;
        }
    }
    let way = machine.motion.phase.to_bits().wrapping_sub(start);
    let way = (u64::from(way) * 36_000) >> 32;
    println!(
        "a jam of {} N m is seen after {ticks} ticks, {way} hundredths of a degree",
        milli(JAM) / 1000
    );
    for _ in 0..100 {
        machine.tick(0.0);
    }
    monitor.end_cycle();

    // Another die.
    machine.dies = 1;
    let mut payload = Payload::new(0.2 * LARGEST, 4096, &machine.observer, &press)?;
    let mut checksum = 0u32;
    for _ in 0..4096 {
        machine.tick(0.0);
        let MotionState { phase, omega, .. } = machine.seen.motion;
        payload.update(machine.seen.load, die(&press, phase, omega));
        checksum = (checksum ^ machine.seen.load.to_bits() as u32).wrapping_mul(16_777_619);
    }
    let estimate = payload.estimate();
    println!(
        "payload {} of 1000 units, explains {} of 1000 of the load",
        milli(estimate.payload),
        milli(estimate.explained)
    );
    let mut turns = 0;
    let cycle = loop {
        let (_, cycle) = turn(machine, &mut monitor);
        turns += 1;
        if cycle.wrong_payload {
            break cycle;
        }
    };
    println!(
        "wrong payload after {turns} turns: {} of 1000 units more, wear: {}",
        milli(cycle.payload),
        cycle.wear
    );
    println!("checksum {checksum:08x}");
    if alarms == 0 && way < 500 {
        Ok(())
    } else {
        Err("the monitor is not as good as it says".into())
    }
}

fn run() -> Result<(), Failure> {
    let image = Image::from_bytes(include_image!("data/press_q31.jred"))?;
    let press: Press = image.model()?;
    let scale = *press.table().scale();
    let observer = Observer::with_bandwidth(BANDWIDTH, TICK, &press)?;
    let mut machine = Machine {
        press,
        step: Period::new(0.25 * TICK, &press)?,
        motion: MotionState::default(),
        noise: 1,
        dies: 0,
        speed: scale.omega(OMEGA).value,
        observer,
        seen: Observed::default(),
    };
    let speed = machine.speed;
    let unit = |phase| -scale.torque_si(die(&press, phase, speed));
    for _ in 0..2500 {
        machine.tick(0.0);
    }
    let (words, turns) = reference(&mut machine, unit)?;
    println!("{turns} turns are the reference\n  phase   usual load    a jam is beyond");
    watch(&mut machine, unit, &words)
}

program!(run);
