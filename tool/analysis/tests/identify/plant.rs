//! A machine whose curves are known exactly, and the log of its drive.
//!
//! The plant is not the identified model: its J, J′ and V′ are those of the mechanism, its motion is integrated here (Runge-Kutta), its encoder
//! counts, and its torque is logged late.

use std::f64::consts::TAU;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use jred::machine::Reducible as _;
use jred_analysis::identify::{Identified, Options, Samples};
use jred_file::model::machine::MachineFile;

use crate::reading::machine;

pub(super) const STEP: f64 = 1e-3;

/// Amplitude share, frequency (Hz) and phase of a motion's waves.
pub(super) type Waves = [[f64; 3]; 4];

/// 60 to 120 rpm.
pub(super) const VARIED: Waves = [
    [0.37, 0.35, 0.3],
    [0.83, 0.25, 1.1],
    [1.93, 0.22, 2.0],
    [3.17, 0.18, 0.7],
];

/// 50 to 130 rpm, at other frequencies.
pub(super) const OTHER: Waves = [
    [0.29, 0.3, 0.9],
    [1.13, 0.3, 0.1],
    [2.41, 0.25, 1.3],
    [3.67, 0.2, 2.2],
];

/// φ, ω, α.
pub(super) fn motion(t: f64, waves: &Waves, mean: f64, swing: f64) -> [f64; 3] {
    waves.iter().fold(
        [mean * t + 0.4, mean, 0.0],
        |[phi, omega, alpha], [hertz, share, phase]| {
            let o = TAU * hertz;
            let (s, c) = (o * t + phase).sin_cos();
            [
                phi + swing * share / o * s,
                omega + swing * share * c,
                alpha - swing * share * o * s,
            ]
        },
    )
}

/// Forwards and back, twenty seconds each way, with the waves of `VARIED`.
pub(super) fn reversing(t: f64) -> [f64; 3] {
    let o = TAU / 40.0;
    let (s, c) = (o * t).sin_cos();
    let most = 2.0 * TAU;
    let [phi, omega, alpha] = motion(t, &VARIED, 0.0, TAU / 2.0);
    [phi + most / o * s, omega + most * c, alpha - most * o * s]
}

/// A machine without process loads, with friction and cogging that are known.
pub(super) struct Plant {
    pub(super) file: MachineFile,
    pub(super) viscous: f64,
    pub(super) coulomb: f64,
    /// Factor of cos φ in Coulomb friction (N·m).
    pub(super) coulomb_wave: f64,
    /// Factor of |sin φ|, whose corners are those of a guide at the dead centres (N·m).
    pub(super) coulomb_corners: f64,
    pub(super) cogging: [f64; 2],
}

pub(super) const COGGING: f64 = 36.0;

pub(super) fn press() -> Plant {
    Plant {
        file: machine("press.toml"),
        viscous: 0.4,
        coulomb: 3.0,
        coulomb_wave: 0.0,
        coulomb_corners: 0.0,
        cogging: [0.25, 0.2],
    }
}

pub(super) fn four_bar() -> Plant {
    Plant {
        file: machine("four-bar.toml"),
        viscous: 0.02,
        coulomb: 0.4,
        coulomb_wave: 0.0,
        coulomb_corners: 0.0,
        cogging: [0.04, 0.03],
    }
}

impl Plant {
    /// J, J′, and the torque that does not accelerate.
    pub(super) fn at(&self, phi: f64, omega: f64) -> [f64; 3] {
        let reduction = self.file.machine.reduction(phi).unwrap();
        let (s, c) = (COGGING * phi).sin_cos();
        let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
        [
            reduction.inertia,
            reduction.inertia_slope,
            reduction.potential_slope
                + self.viscous * omega
                + self.friction(phi) * sign
                + self.cogging[0] * c
                + self.cogging[1] * s,
        ]
    }

    /// Coulomb friction.
    pub(super) fn friction(&self, phi: f64) -> f64 {
        self.coulomb + self.coulomb_wave * phi.cos() + self.coulomb_corners * phi.sin().abs()
    }

    pub(super) fn torque(&self, [phi, omega, alpha]: [f64; 3]) -> f64 {
        let [j, slope, load] = self.at(phi, omega);
        j * alpha + 0.5 * slope * omega * omega + load
    }

    /// J and V′ of the design at the angles of the curves.
    pub(super) fn design(&self) -> Vec<[f64; 2]> {
        let each = (0..360).map(|k| self.file.machine.reduction(f64::from(k).to_radians()));
        let each = each.map(Result::unwrap);
        each.map(|at| [at.inertia, at.potential_slope]).collect()
    }

    pub(super) fn inertias(&self) -> Vec<f64> {
        let phi = (0..360).map(|k| f64::from(k) * TAU / 360.0);
        phi.map(|phi| self.at(phi, 0.0)[0]).collect()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoder {
    /// 4096 counts.
    Coarse,
    /// 10,000 counts with a noise of 0.7 counts.
    Fine,
}

impl Encoder {
    pub(super) const fn counts(self) -> f64 {
        match self {
            Self::Coarse => 4096.0,
            Self::Fine => 10_000.0,
        }
    }
}

pub(super) fn gauss(rng: &mut ChaCha8Rng) -> f64 {
    let [u, v]: [f64; 2] = [rng.random(), rng.random()];
    (-2.0 * (1.0 - u).ln()).sqrt() * (TAU * v).cos()
}

pub(super) struct Log {
    pub(super) samples: Samples,
    pub(super) options: Options,
}

/// A log of `seconds`: open loop, the motion is the reference; closed loop, a controller of 8 Hz on the counted position drives the machine.
pub(super) fn log(plant: &Plant, encoder: Encoder, closed: bool, seed: u64, seconds: f64) -> Log {
    log_of(plant, encoder, closed, seed, seconds, |t| {
        motion(t, &VARIED, 1.5 * TAU, TAU / 2.0)
    })
}

pub(super) fn log_of(
    plant: &Plant,
    encoder: Encoder,
    closed: bool,
    seed: u64,
    seconds: f64,
    reference: impl Fn(f64) -> [f64; 3],
) -> Log {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let count = (seconds / STEP).round() as usize;
    let step = TAU / encoder.counts();
    let zero: f64 = rng.random::<f64>() * step;
    let counted = |phi: f64, rng: &mut ChaCha8Rng| {
        let noise = if encoder == Encoder::Fine {
            0.7 * step * gauss(rng)
        } else {
            0.0
        };
        ((phi + zero + noise) / step).round() * step - zero
    };
    let (mut position, mut torque) = (Vec::new(), Vec::new());
    let inertias = plant.inertias();
    let mean = inertias.iter().sum::<f64>() / inertias.len() as f64;
    let [mut phi, mut omega, _] = reference(0.0);
    let (mut filtered, mut before) = (omega, None);
    for k in 0..count {
        let t = k as f64 * STEP;
        let wanted = reference(t);
        if !closed {
            position.push(counted(wanted[0], &mut rng));
            torque.push(plant.torque(reference(t - STEP)));
            continue;
        }
        let y = counted(phi, &mut rng);
        if let Some(before) = before {
            filtered += STEP / (3e-3 + STEP) * ((y - before) / STEP - filtered);
        }
        before = Some(y);
        let drive = mean * (2500.0 * (wanted[0] - y) + 80.0 * (wanted[1] - filtered) + wanted[2]);
        position.push(y);
        torque.push(drive);
        let slope = |[phi, omega]: [f64; 2]| {
            let [j, slope, load] = plant.at(phi, omega);
            [omega, (drive - load - 0.5 * slope * omega * omega) / j]
        };
        for _ in 0..2 {
            let h = STEP / 2.0;
            let at = [phi, omega];
            let by = |k: [f64; 2], h: f64| [at[0] + h * k[0], at[1] + h * k[1]];
            let k1 = slope(at);
            let k2 = slope(by(k1, h / 2.0));
            let k3 = slope(by(k2, h / 2.0));
            let k4 = slope(by(k3, h));
            phi += h / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0]);
            omega += h / 6.0 * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1]);
        }
    }
    if closed {
        // The log has it a sample late.
        torque.rotate_right(1);
        torque[0] = torque[1];
    }
    let rms = (torque.iter().map(|t| t * t).sum::<f64>() / torque.len() as f64).sqrt();
    for t in &mut torque {
        *t += 0.01 * rms * gauss(&mut rng);
    }
    Log {
        samples: Samples {
            step: STEP,
            faulty: vec![false; count],
            position,
            torque,
        },
        options: Options {
            cogging: vec![COGGING as u32],
            delay: None,
            friction: Vec::new(),
            encoder_step: Some(step),
        },
    }
}

/// Largest error of J, share of the angles inside the band, peak error of the torque of another motion, all against the exact plant.
pub(super) fn errors(plant: &Plant, found: &Identified) -> [f64; 3] {
    let exact = plant.inertias();
    let most = exact.iter().copied().fold(0.0, f64::max);
    let (mut worst, mut inside) = (0.0f64, 0);
    for (point, exact) in found.curves.iter().zip(&exact) {
        let error = (point.inertia.value - exact).abs();
        worst = worst.max(error / most);
        inside += usize::from(error <= point.inertia.band);
    }
    let states = (0..6000).map(|k| motion(f64::from(k) * 2e-3, &OTHER, 1.5 * TAU, 4.0));
    let (mut peak, mut largest) = (0.0f64, 0.0f64);
    for state in states {
        let torque = plant.torque(state);
        largest = largest.max(torque.abs());
        peak = peak.max((found.torque(state[0], state[1], state[2]) - torque).abs());
    }
    [worst, inside as f64 / 360.0, peak / largest]
}

pub(super) const CASES: [(Encoder, bool); 4] = [
    (Encoder::Coarse, false),
    (Encoder::Coarse, true),
    (Encoder::Fine, false),
    (Encoder::Fine, true),
];
