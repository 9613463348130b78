//! A drive in closed loop with a simulated machine: the controller and its encoder in single precision, the machine in double precision.
//!
//! ```text
//! set-point ─┬─► ahead by LEAD ─► feed-forward ────────────────┐
//!            └─► position P, speed PI ─► feedback torque ──► + ─► a tick's delay ─► current loop ─► machine
//!                      ▲                                                                              │
//!                      └──────────────── Tracker ◄─ Encoder ◄─ count ◄────────────────────────────────┘
//! ```

use core::f32::consts::TAU;
use core::f64;

use jred::Phase;
use jred::axis::{AxisError, Encoder, MotionState, Mounting, Tracker};
use jred::machine::{FreeMotion, PoseError, Reducible};

/// Period of the controller (s).
pub(crate) const TICK: f32 = 0.000_25;
/// Counts of the encoder in a turn of the drive link: 10 000 on a motor behind a ratio of 20.
pub(crate) const COUNTS: u32 = 200_000;
/// Corner frequency of the filter that finds the speed (Hz).
const FILTER: f32 = 250.0;
/// Bandwidth of the speed controller (Hz).
const BANDWIDTH: f32 = 30.0;
/// Share of a step of the torque that the current loop still misses after half a tick.
const REST: f64 = 0.6;
/// Its time constant (s), half a tick/ln(1/REST): a bandwidth of 650 Hz.
pub(crate) const LAG: f64 = 0.000_244_701_9;
/// From a command to its torque (s): the delay of a tick, half a tick in which it is held, and the lag of the current loop.
pub(crate) const LEAD: f32 = 1.5 * TICK + LAG as f32;

/// Position P and speed PI, without any knowledge of the machine but a mean inertia J̄.
///
/// With ω_b = 2π·BANDWIDTH the speed controller has the gain J̄·ω_b and the integral time 4/ω_b, the position controller the gain ω_b/4: for a constant
/// inertia all three poles are real.
pub(crate) struct Cascade {
    encoder: Encoder,
    /// Counts in a turn of the drive link.
    counts: u32,
    tracker: Tracker,
    /// Gain of the speed controller (N·m·s/rad).
    gain: f32,
    /// The integral part (N·m).
    integral: f32,
}

impl Cascade {
    /// For a mean inertia (kg·m²) and an encoder with these counts in a turn, with the machine at rest at a position (rad).
    pub(crate) fn new(inertia: f32, counts: u32, phi: f64) -> Result<Self, AxisError> {
        let encoder = Encoder::new(Mounting::direct(counts))?;
        let start = encoder.phase_wide(count(phi, counts));
        Ok(Self {
            encoder,
            counts,
            tracker: Tracker::with_bandwidth(FILTER, TICK)?.at(start),
            gain: inertia * TAU * BANDWIDTH,
            integral: 0.0,
        })
    }

    /// The feedback torque (N·m) of a tick.
    pub(crate) fn feedback(&mut self, count: i64, wanted: MotionState<f32>) -> f32 {
        const RATE: f32 = TAU * BANDWIDTH / 4.0;
        let phase = self.encoder.phase_wide(count);
        let tracked = self.tracker.update(phase);
        let omega = tracked.speed as f32 * (UNIT / TICK);
        let error = wanted.omega - omega + RATE * apart(wanted.phase, phase);
        let push = self.gain * error;
        self.integral += push * (RATE * TICK);
        push + self.integral
    }
}

/// Angle of a unit of a phase (rad).
const UNIT: f32 = TAU / 4_294_967_296.0;

/// From one phase to another, the shorter way (rad).
fn apart(to: Phase, from: Phase) -> f32 {
    to.to_bits().wrapping_sub(from.to_bits()).cast_signed() as f32 * UNIT
}

/// The encoder's count at a position (rad).
fn count(phi: f64, counts: u32) -> i64 {
    let place = phi * (f64::from(counts) / f64::consts::TAU);
    let whole = place as i64;
    whole - i64::from((whole as f64) > place)
}

/// The motor's torque (N·m) within a tick: the response of the current loop to a step.
#[derive(Clone, Copy)]
pub(crate) struct Course {
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Course {
    /// The course of the second half of the tick, and that of the next tick on.
    fn half(self) -> Self {
        let from = self.to + (self.from - self.to) * REST;
        Self { from, ..self }
    }

    /// The mean over half a tick.
    fn mean(self) -> f64 {
        let half = 0.5 * f64::from(TICK);
        self.to + (self.from - self.to) * (1.0 - REST) * (LAG / half)
    }
}

/// A machine under a motor.
pub(crate) trait Plant {
    /// Why it stops.
    type Error;

    /// Position of the drive link (rad).
    fn phi(&self) -> f64;

    /// Moves for a tick under the motor's torque.
    fn advance(&mut self, torque: Course) -> Result<(), Self::Error>;
}

/// A machine that moves in two equal steps a tick: without a library of solvers, so on any core.
pub(crate) struct Stepped<'m, M> {
    machine: &'m M,
    motion: FreeMotion,
}

impl<'m, M: Reducible> Stepped<'m, M> {
    /// At rest at a position (rad).
    pub(crate) fn new(machine: &'m M, phi: f64) -> Result<Self, PoseError> {
        let motion = FreeMotion::new(machine, phi, 0.0)?;
        Ok(Self { machine, motion })
    }
}

impl<M: Reducible> Plant for Stepped<'_, M> {
    type Error = PoseError;

    fn phi(&self) -> f64 {
        self.motion.phi()
    }

    fn advance(&mut self, torque: Course) -> Result<(), PoseError> {
        let half = 0.5 * f64::from(TICK);
        self.motion.advance(self.machine, torque.mean(), half)?;
        self.motion
            .advance(self.machine, torque.half().mean(), half)
    }
}

/// A tick as an observer sees it.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    /// Torque of the feedback (N·m).
    pub(crate) feedback: f32,
    /// Set-point minus true position (rad).
    pub(crate) error: f32,
}

/// Runs a number of ticks. `wanted` is the set-point of a tick, now and [`LEAD`] later; `ahead` the feed-forward for the later one.
pub(crate) fn run<P: Plant>(
    plant: &mut P,
    controller: &mut Cascade,
    ticks: u32,
    wanted: impl Fn(u32) -> [MotionState<f32>; 2],
    ahead: impl Fn(MotionState<f32>) -> f32,
    mut observe: impl FnMut(u32, Seen),
) -> Result<(), P::Error> {
    // The torque of the motor, and the command that it gets next.
    let (mut torque, mut command) = (0.0, 0.0);
    for tick in 0..ticks {
        let [now, later] = wanted(tick);
        let feedback = controller.feedback(count(plant.phi(), controller.counts), now);
        let ahead = ahead(later);
        let error = apart(now.phase, Phase::from_radians(plant.phi()));
        observe(tick, Seen { feedback, error });
        let course = Course {
            from: torque,
            to: command,
        };
        plant.advance(course)?;
        torque = course.half().half().from;
        command = f64::from(ahead + feedback);
    }
    Ok(())
}

/// Root mean square of the feedback torque, and the largest following error.
#[derive(Clone, Copy, Default)]
pub(crate) struct Figures {
    squares: f64,
    ticks: u32,
    /// Largest following error (rad).
    pub(crate) error: f32,
}

impl Figures {
    /// Adds a tick.
    pub(crate) fn add(&mut self, seen: Seen) {
        self.squares += f64::from(seen.feedback) * f64::from(seen.feedback);
        self.ticks += 1;
        self.error = self.error.max(seen.error.abs());
    }

    /// Mean square of the feedback torque (N²·m²).
    pub(crate) fn mean_square(&self) -> f64 {
        self.squares / f64::from(self.ticks.max(1))
    }
}
