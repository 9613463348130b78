//! A machine in f64 behind a controller with a noisy torque and an encoder, as an observer and a monitor see it.

use core::f64::consts::TAU;

use jred::machine::{FreeMotion, Reducible as _};
use jred::{Phase, Scale};

use crate::support::machines::Wave;
use crate::support::scale_of;

/// Numbers with the standard normal distribution, the same in every run (xorshift, G. Marsaglia 2003; G. Box and M. Muller 1958).
#[derive(Clone, Debug)]
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    /// Between 0 and 1, without both.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }

    pub(crate) fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

/// Period of a tick (s).
pub(crate) const TICK: f64 = 1e-3;
/// Speed of the set-point (rad/s): a turn is 1000 ticks.
pub(crate) const OMEGA: f64 = TAU;
/// Counts of the encoder per turn of the crank: 17 bits on the motor, behind a gear of 20.
const COUNTS: f64 = 131_072.0 * 20.0;

/// A crank whose J varies as 3 : 1, with a load of one wave per turn, and friction.
pub(crate) const CRANK: Wave = Wave {
    mean: 1.0,
    swing: 0.5,
    load: 30.0,
    viscous: 0.5,
    coulomb: 2.0,
    domain: jred::Domain::Turn,
};

/// One unit of payload.
pub(crate) const PAYLOAD: Wave = Wave {
    mean: 0.05,
    swing: 0.03,
    load: 2.0,
    viscous: 0.0,
    coulomb: 0.0,
    domain: jred::Domain::Turn,
};

/// Bases of fixed point for the machine with its payloads.
pub(crate) fn bases() -> Scale {
    scale_of(100.0, 8.0, 4.0)
}

/// The machine with this payload, and friction and load that its model has wrong by this share.
pub(crate) fn machine(payload: f64, wrong: f64) -> Wave {
    Wave {
        mean: CRANK.mean + payload * PAYLOAD.mean,
        swing: CRANK.swing + payload * PAYLOAD.swing,
        load: (1.0 + wrong) * CRANK.load + payload * PAYLOAD.load,
        coulomb: (1.0 + wrong) * CRANK.coulomb,
        ..CRANK
    }
}

/// Largest torque of the drive over a turn (N·m).
pub(crate) fn peak() -> f64 {
    let torque = |k: i32| {
        let here = CRANK.reduction(TAU * f64::from(k) / 1000.0).unwrap();
        here.torque(OMEGA, 0.0).total().abs()
    };
    (0..1000).map(torque).fold(0.0, f64::max)
}

/// The machine in motion.
#[derive(Clone, Debug)]
pub(crate) struct Plant {
    pub(crate) machine: Wave,
    pub(crate) motion: FreeMotion,
    /// σ of the torque (N·m).
    pub(crate) noise: f64,
    source: Noise,
    ticks: u32,
}

impl Plant {
    pub(crate) fn new(machine: Wave, noise: f64, seed: u64) -> Self {
        let motion = FreeMotion::new(&machine, 0.0, OMEGA).unwrap();
        Self {
            machine,
            motion,
            noise,
            source: Noise(seed),
            ticks: 0,
        }
    }

    /// Another payload, at the same speed.
    pub(crate) fn load(&mut self, payload: f64) {
        self.machine = machine(payload, 0.1);
        self.motion =
            FreeMotion::new(&self.machine, self.motion.phi(), self.motion.omega()).unwrap();
    }

    /// Angle within the turn (rad).
    pub(crate) fn angle(&self) -> f64 {
        self.motion.phi().rem_euclid(TAU)
    }

    /// The torque of the drive for the next tick (N·m): the model's, and a controller on the set-point.
    pub(crate) fn command(&self) -> f64 {
        let set = OMEGA * TICK * f64::from(self.ticks);
        let model = CRANK.reduction(set).unwrap().torque(OMEGA, 0.0).total();
        let (phi, omega) = (self.motion.phi(), self.motion.omega());
        model + 400.0 * (set - phi) + 40.0 * (OMEGA - omega)
    }

    /// A tick under the drive's torque and that of a load which the model does not know; the encoder's phase after it.
    pub(crate) fn tick(&mut self, command: f64, load: f64) -> Phase {
        let torque = command + load + self.noise * self.source.normal();
        self.motion.advance(&self.machine, torque, TICK).unwrap();
        // Angles stay small, or their rounding would grow over ten thousand turns.
        self.ticks += 1;
        if self.ticks == 1000 && self.motion.phi() > TAU {
            self.ticks = 0;
            let [phi, omega] = [self.motion.phi() - TAU, self.motion.omega()];
            self.motion = FreeMotion::new(&self.machine, phi, omega).unwrap();
        }
        let turn = (self.angle() / TAU * COUNTS).floor() / COUNTS;
        Phase::from_bits((turn * 4_294_967_296.0) as u32)
    }
}
