//! A press and a four-bar in closed form, in f64, and what a drive sees of them: the machines that an identification must find.

use core::f64::consts::TAU;

use jred::Phase;

use super::watched::Noise;

const GRAVITY: f64 = 9.81;

/// Period of a tick (s).
pub(crate) const TICK: f64 = 1e-3;

/// J, J′ and the torque V′ against the weights.
type Curves = fn(f64) -> [f64; 3];

/// A machine with constant friction and cogging of one order.
#[derive(Clone, Copy)]
pub(crate) struct Plant {
    pub(crate) curves: Curves,
    pub(crate) viscous: f64,
    pub(crate) coulomb: f64,
    pub(crate) cogging: [f64; 2],
    /// RMS of the torque of [`vary`].
    pub(crate) rms: f64,
}

pub(crate) const ORDER: u32 = 36;

pub(crate) const PRESS: Plant = Plant {
    curves: press,
    viscous: 0.4,
    coulomb: 3.0,
    cogging: [0.25, 0.2],
    rms: 12.6,
};

pub(crate) const FOUR_BAR: Plant = Plant {
    curves: four_bar,
    viscous: 0.02,
    coulomb: 0.4,
    cogging: [0.04, 0.03],
    rms: 2.24,
};

/// A mass whose centre has these derivatives by φ: J, J′.
fn mass(mass: f64, [x, y]: [[f64; 2]; 2]) -> [f64; 2] {
    [
        mass * (x[0] * x[0] + y[0] * y[0]),
        2.0 * mass * (x[0] * x[1] + y[0] * y[1]),
    ]
}

fn sum(parts: &[[f64; 2]]) -> [f64; 2] {
    parts.iter().fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d])
}

/// Slider-crank with a vertical ram: crank 30 mm, rod 180 mm, ram 42 kg.
fn press(phi: f64) -> [f64; 3] {
    const R: f64 = 0.03;
    const U: f64 = 0.055;
    let (s, c) = phi.sin_cos();
    let rho = (0.18_f64 * 0.18 - R * R * s * s).sqrt();
    let slider = [
        -R * s - R * R * s * c / rho,
        -R * c - R * R * ((c * c - s * s) / rho + R * R * s * s * c * c / rho.powi(3)),
    ];
    let turn = [
        -R * c / rho,
        R * s / rho - R.powi(3) * s * c * c / rho.powi(3),
    ];
    let (sin, cos) = (-R * s / 0.18, rho / 0.18);
    let x = [
        -R * s - U * turn[0] * sin,
        -R * c - U * (turn[1] * sin + turn[0] * turn[0] * cos),
    ];
    let y = [
        R * c + U * turn[0] * cos,
        -R * s + U * (turn[1] * cos - turn[0] * turn[0] * sin),
    ];
    let [inertia, slope] = sum(&[
        [0.02 + 0.018 + 9.0 * 0.006 * 0.006, 0.0],
        mass(6.5, [x, y]),
        mass(0.03, [turn, [0.0; 2]]),
        mass(42.0, [slider, [0.0; 2]]),
    ]);
    let load = -GRAVITY * (42.0 * slider[0] + 6.5 * x[0] - 9.0 * 0.006 * s);
    [inertia, slope, load]
}

/// A point at (along, across) of a link at an angle with these derivatives, from a point with these.
fn point(
    from: [[f64; 2]; 2],
    angle: f64,
    [first, second]: [f64; 2],
    along: f64,
    across: f64,
) -> [[f64; 2]; 2] {
    let (s, c) = angle.sin_cos();
    let (x, y) = (along * c - across * s, along * s + across * c);
    [
        [
            from[0][0] - first * y,
            from[0][1] - second * y - first * first * x,
        ],
        [
            from[1][0] + first * x,
            from[1][1] + second * x - first * first * y,
        ],
    ]
}

/// Crank 60 mm, coupler 220 mm, rocker 130 mm, in a vertical plane.
fn four_bar(phi: f64) -> [f64; 3] {
    const A: f64 = 0.06;
    const B: f64 = 0.22;
    const C: f64 = 0.13;
    let (s, c) = phi.sin_cos();
    let (dx, dy) = (0.21 - A * c, -0.04 - A * s);
    let d = dx.hypot(dy);
    let beta = dy.atan2(dx) + ((B * B + d * d - C * C) / (2.0 * B * d)).acos();
    let (ex, ey) = (A * c + B * beta.cos() - 0.21, A * s + B * beta.sin() + 0.04);
    let gamma = ey.atan2(ex);
    let between = gamma - beta;
    let coupler = -A * (gamma - phi).sin() / (B * between.sin());
    let rocker = -A * (beta - phi).sin() / (C * between.sin());
    let change = |angle: f64, first: f64, ratio: f64| {
        let (s, c) = angle.sin_cos();
        let (bs, bc) = between.sin_cos();
        -ratio * (c * (first - 1.0) * bs - s * bc * (rocker - coupler)) / (bs * bs)
    };
    let coupler = [coupler, change(gamma - phi, rocker, A / B)];
    let rocker = [rocker, change(beta - phi, coupler[0], A / C)];
    let ground = [[0.0; 2]; 2];
    let crank = point(ground, phi, [1.0, 0.0], A, 0.0);
    let middle = point(crank, beta, coupler, 0.11, 0.0);
    let end = point(ground, gamma, rocker, 0.165, -0.012);
    let [inertia, slope] = sum(&[
        [0.01 + 0.0014 + 1.4 * 0.018 * 0.018, 0.0],
        mass(0.9, middle),
        mass(0.0045, [coupler, [0.0; 2]]),
        mass(3.2, end),
        mass(0.056, [rocker, [0.0; 2]]),
    ]);
    let load = GRAVITY * (1.4 * 0.018 * c + 0.9 * middle[1][0] + 3.2 * end[1][0]);
    [inertia, slope, load]
}

/// A motion: phase, speed, acceleration at a time.
pub(crate) type Motion = fn(f64) -> [f64; 3];

fn waves(time: f64, speed: f64, waves: [[f64; 3]; 4]) -> [f64; 3] {
    let mut motion = [0.4 + speed * time, speed, 0.0];
    for [frequency, size, start] in waves {
        let w = TAU * frequency;
        let (s, c) = (w * time + start).sin_cos();
        motion[0] += size / w * s;
        motion[1] += size * c;
        motion[2] -= size * w * s;
    }
    motion
}

/// 60 to 120 rpm with four frequencies.
pub(crate) fn vary(time: f64) -> [f64; 3] {
    let sizes = [
        [0.37, 0.35, 0.3],
        [0.83, 0.25, 1.1],
        [1.93, 0.22, 2.0],
        [3.17, 0.18, 0.7],
    ];
    waves(
        time,
        1.5 * TAU,
        sizes.map(|[f, size, start]| [f, 0.5 * TAU * size, start]),
    )
}

/// Another one, 50 to 130 rpm.
pub(crate) fn other(time: f64) -> [f64; 3] {
    let sizes = [
        [0.29, 0.3, 0.9],
        [1.13, 0.3, 0.1],
        [2.41, 0.25, 1.3],
        [3.67, 0.2, 2.2],
    ];
    waves(
        time,
        1.5 * TAU,
        sizes.map(|[f, size, start]| [f, 4.0 * size, start]),
    )
}

/// Six turns in four seconds, with the speed of [`vary`] or so, again and again.
pub(crate) fn repeated(time: f64) -> [f64; 3] {
    let sizes = [
        [0.25, 0.35, 0.3],
        [0.75, 0.25, 1.1],
        [2.0, 0.22, 2.0],
        [3.25, 0.18, 0.7],
    ];
    waves(
        time,
        1.5 * TAU,
        sizes.map(|[f, size, start]| [f, 0.5 * TAU * size, start]),
    )
}

/// 90 rpm.
pub(crate) fn constant(time: f64) -> [f64; 3] {
    waves(time, 1.5 * TAU, [[1.0, 0.0, 0.0]; 4])
}

/// Forward and back by more than a turn.
pub(crate) fn swing(time: f64) -> [f64; 3] {
    let sizes = [
        [0.31, 0.75, 0.3],
        [0.83, 0.3, 1.1],
        [1.93, 0.2, 2.0],
        [1.0, 0.0, 0.0],
    ];
    waves(
        time,
        0.0,
        sizes.map(|[f, size, start]| [f, 11.0 * size, start]),
    )
}

impl Plant {
    /// The torque that a motion takes.
    pub(crate) fn torque(&self, [phi, omega, alpha]: [f64; 3]) -> f64 {
        let [inertia, slope, load] = (self.curves)(phi);
        inertia * alpha + 0.5 * slope * omega * omega + load + self.losses(phi, omega)
    }

    fn losses(&self, phi: f64, omega: f64) -> f64 {
        let (s, c) = (f64::from(ORDER) * phi).sin_cos();
        self.viscous * omega
            + self.coulomb * omega.signum()
            + self.cogging[0] * c
            + self.cogging[1] * s
    }

    fn alpha(&self, [phi, omega]: [f64; 2], torque: f64) -> f64 {
        let [inertia, slope, load] = (self.curves)(phi);
        (torque - load - self.losses(phi, omega) - 0.5 * slope * omega * omega) / inertia
    }

    /// A step of Runge and Kutta under a constant torque.
    fn step(&self, [phi, omega]: [f64; 2], torque: f64, h: f64) -> [f64; 2] {
        let slope = |s: [f64; 2]| [s[1], self.alpha(s, torque)];
        let at = |k: [f64; 2], h: f64| [phi + h * k[0], omega + h * k[1]];
        let a = slope([phi, omega]);
        let b = slope(at(a, 0.5 * h));
        let c = slope(at(b, 0.5 * h));
        let d = slope(at(c, h));
        let mean = |i: usize| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0;
        at([mean(0), mean(1)], h)
    }
}

/// An encoder: counts per turn, and jitter in counts.
#[derive(Clone, Copy)]
pub(crate) struct Encoder {
    pub(crate) counts: f64,
    pub(crate) jitter: f64,
}

pub(crate) const BITS_12: Encoder = Encoder {
    counts: 4096.0,
    jitter: 0.0,
};

pub(crate) const COUNTS_10K: Encoder = Encoder {
    counts: 10_000.0,
    jitter: 0.7,
};

impl Encoder {
    /// Standard deviation of its noise (rad).
    pub(crate) fn noise(&self) -> f64 {
        TAU / self.counts * (self.jitter * self.jitter + 1.0 / 12.0).sqrt()
    }

    fn read(&self, phi: f64, zero: f64, noise: &mut Noise) -> f64 {
        let turns = phi / TAU * self.counts + zero + self.jitter * noise.normal();
        ((turns + 0.5).floor() - zero) / self.counts * TAU
    }
}

/// Phase of an angle.
fn phase(phi: f64) -> Phase {
    Phase::from_bits(((phi / TAU).rem_euclid(1.0) * 4_294_967_296.0) as u64 as u32)
}

/// The record of a drive: in each tick the phase, and a torque with 1 % of noise that is read a period late.
pub(crate) fn recorded(
    plant: &Plant,
    encoder: Encoder,
    motion: Motion,
    seed: u64,
    ticks: usize,
) -> Vec<(Phase, f64)> {
    let mut noise = Noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let zero = noise.uniform();
    (0..ticks)
        .map(|k| {
            let time = k as f64 * TICK;
            let measured = encoder.read(motion(time)[0], zero, &mut noise);
            let torque = plant.torque(motion(time - TICK)) + 0.01 * plant.rms * noise.normal();
            (phase(measured), torque)
        })
        .collect()
}

/// The same behind a controller that follows the motion by the noisy encoder; the torque of a period is constant, and recorded a period later.
pub(crate) fn controlled(
    plant: &Plant,
    encoder: Encoder,
    motion: Motion,
    seed: u64,
    ticks: usize,
) -> Vec<(Phase, f64)> {
    let mut noise = Noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let zero = noise.uniform();
    let mean = (0..360)
        .map(|k| (plant.curves)(f64::from(k) * TAU / 360.0)[0])
        .sum::<f64>()
        / 360.0;
    let [phi, omega, _] = motion(0.0);
    let (mut state, mut filtered, mut last, mut before) = ([phi, omega], omega, phi, 0.0);
    (0..ticks)
        .map(|k| {
            let [phi, omega, alpha] = motion(k as f64 * TICK);
            let measured = encoder.read(state[0], zero, &mut noise);
            if k > 0 {
                filtered += TICK / (3.0 * TICK + TICK) * ((measured - last) / TICK - filtered);
            }
            last = measured;
            let torque = mean * (2500.0 * (phi - measured) + 80.0 * (omega - filtered) + alpha);
            for _ in 0..4 {
                state = plant.step(state, torque, 0.25 * TICK);
            }
            let read = if k == 0 { torque } else { before };
            before = torque;
            (phase(measured), read + 0.01 * plant.rms * noise.normal())
        })
        .collect()
}
