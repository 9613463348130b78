//! The press of `machines/press.toml` from textbook formulas, without code of the tool.
//!
//! In-line slider-crank, crank pivot at the origin, guide along x:
//! x_B = r·cos φ + √(l² − r²·sin²φ), the rod's angle from sin β = −(r/l)·sin φ. Speeds come from the analytic first
//! derivatives, forces from Lagrange's equation with numerical derivatives of momentum and energies.

use std::f64::consts::{PI, TAU};

use super::numerics::derivative;

/// The example without its title, comments and simulation. The constants below are these figures.
pub(crate) const STATED: &str = r#"
gravity = ["9.81 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
offset = "0 mm"
branch = "right"
flywheel = "0.05 kg m^2"
[mechanism.crank]
length = "30 mm"
mass = "9 kg"
inertia = "0.018 kg m^2"
com = ["6 mm", "0 mm"]
[mechanism.rod]
length = "180 mm"
mass = "6.5 kg"
inertia = "0.03 kg m^2"
com = ["55 mm", "0 mm"]
[mechanism.slider]
mass = "42 kg"
[[load]]
name = "pressing force"
on = "slider"
force = ["-10 kN", "0 N"]
between = ["315 deg", "360 deg"]
ramp = "15 deg"
[[load]]
name = "guide friction"
on = "slider"
opposing_force = "150 N"
[[load]]
name = "crank bearings"
on = "crank"
viscous_moment = "0.4 N m s/rad"
[[drive_train]]
type = "belt"
driver = { radius = "40 mm", inertia = "0.0006 kg m^2" }
driven = { radius = "120 mm", inertia = "0.03 kg m^2" }
belt_mass = "0.6 kg"
efficiency = "97 %"
pretension = "1 kN"
[motion]
type = "cycle"
start = "180 deg"
[[motion.segment]]
law = "polynomial-345"
move = "360 deg"
duration = "0.4 s"
[[motion.segment]]
dwell = "0.1 s"
"#;

const R: f64 = 0.03;
const L: f64 = 0.18;
const GRAVITY_X: f64 = 9.81;
const FLYWHEEL: f64 = 0.05;
const CRANK: [f64; 3] = [9.0, 0.018, 0.006]; // mass, inertia, centre of mass along the crank
const ROD: [f64; 3] = [6.5, 0.03, 0.055];
const SLIDER: f64 = 42.0;
const PRESSING: f64 = 10e3;
const GUIDE: f64 = 150.0;
const BEARINGS: f64 = 0.4;
/// Ratio of the belt.
pub(crate) const RATIO: f64 = 3.0;
pub(crate) const BELT_EFFICIENCY: f64 = 0.97;
/// Driver pulley, and the belt's mass at the driver's rim.
const DRIVER: f64 = 0.0006 + 0.6 * 0.04 * 0.04;
const DRIVEN: f64 = 0.03;
/// Length of the move and of the cycle (s).
pub(crate) const MOVE: f64 = 0.4;
/// Length of the cycle (s).
pub(crate) const CYCLE: f64 = 0.5;

/// x_B.
pub(crate) fn slider(phi: f64) -> f64 {
    R * phi.cos() + (L * L - (R * phi.sin()).powi(2)).sqrt()
}

/// dx_B/dφ.
pub(crate) fn slider_speed(phi: f64) -> f64 {
    let (sin, cos) = phi.sin_cos();
    -R * sin - R * R * sin * cos / (L * L - R * R * sin * sin).sqrt()
}

/// x_B and its first two derivatives.
pub(crate) fn slider_derivatives(phi: f64) -> [f64; 3] {
    let (sin, cos) = phi.sin_cos();
    let q = (L * L - R * R * sin * sin).sqrt();
    // q·q′ = −r²·sin φ·cos φ
    let slope = -R * R * sin * cos / q;
    let bend = (-R * R * (cos * cos - sin * sin) - slope * slope) / q;
    [R * cos + q, -R * sin + slope, -R * cos + bend]
}

/// J_red without the drive train: twice the kinetic energy at ω = 1.
pub(crate) fn inertia(phi: f64) -> f64 {
    FLYWHEEL + shares(phi).iter().sum::<f64>()
}

/// Shares of crank, rod and slider in J_red.
pub(crate) fn shares(phi: f64) -> [f64; 3] {
    let (sin, cos) = phi.sin_cos();
    let turn = -R * cos / (L * L - R * R * sin * sin).sqrt(); // dβ/dφ
    let rod_x = -R * sin - ROD[2] * (-R / L * sin) * turn;
    let rod_y = R * cos * (1.0 - ROD[2] / L);
    [
        CRANK[1] + CRANK[0] * CRANK[2] * CRANK[2],
        ROD[0] * (rod_x * rod_x + rod_y * rod_y) + ROD[1] * turn * turn,
        SLIDER * slider_speed(phi).powi(2),
    ]
}

/// The whole drive train at the drive link.
pub(crate) fn train() -> f64 {
    DRIVEN + DRIVER * RATIO * RATIO
}

/// U: weight acts along +x.
pub(crate) fn potential(phi: f64) -> f64 {
    let along_rod = (L * L - (R * phi.sin()).powi(2)).sqrt() / L;
    let moments = CRANK[0] * CRANK[2] * phi.cos()
        + ROD[0] * (R * phi.cos() + ROD[2] * along_rod)
        + SLIDER * slider(phi);
    -GRAVITY_X * moments
}

/// Share of the pressing force that acts: 0 at 315° and 360°, 1 from 330° to 345°, with quintic ramps.
fn window(phi: f64) -> f64 {
    let degrees = phi.to_degrees().rem_euclid(360.0);
    let ramp = |z: f64| z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z);
    match degrees {
        d if d < 315.0 => 0.0,
        d if d < 330.0 => ramp((d - 315.0) / 15.0),
        d if d < 345.0 => 1.0,
        d => ramp((360.0 - d) / 15.0),
    }
}

/// Torque of the pressing force on the crank.
pub(crate) fn process(phi: f64) -> f64 {
    -PRESSING * window(phi) * slider_speed(phi)
}

/// Viscous coefficient at the crank.
pub(crate) fn viscous(_phi: f64) -> f64 {
    BEARINGS
}

/// Guide friction at the crank.
pub(crate) fn coulomb(phi: f64) -> f64 {
    GUIDE * slider_speed(phi).abs()
}

/// φ(t), ω(t), α(t) of the cycle: the 3-4-5 polynomial over one turn, then rest.
pub(crate) fn motion(t: f64) -> [f64; 3] {
    let z = (t / MOVE).clamp(0.0, 1.0);
    [
        PI + TAU * z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z),
        TAU / MOVE * 30.0 * (z * (1.0 - z)).powi(2),
        TAU / (MOVE * MOVE) * (60.0 * z - 180.0 * z * z + 120.0 * z.powi(3)),
    ]
}

/// The drive torque at the crank, without drive train: d(J·ω)/dt − ∂K/∂φ + ∂U/∂φ against the loads.
pub(crate) fn crank_torque(t: f64) -> f64 {
    let [phi, omega, _] = motion(t);
    if omega == 0.0 {
        return derivative(potential, phi, 1e-3);
    }
    // The polynomial continues smoothly beyond the ends of the move, which suffices for differences.
    let momentum = |t: f64| {
        let z = t / MOVE;
        let phi = PI + TAU * z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z);
        inertia(phi) * TAU / MOVE * 30.0 * (z * (1.0 - z)).powi(2)
    };
    derivative(momentum, t, 1e-4) - 0.5 * omega * omega * derivative(inertia, phi, 1e-3)
        + derivative(potential, phi, 1e-3)
        - process(phi)
        + viscous(phi) * omega
        + coulomb(phi) * omega.signum()
}

/// The other method for the same torque: power balance, d(K + U)/dt plus the power of the loads, divided by the speed.
pub(crate) fn crank_torque_by_power(t: f64) -> f64 {
    let energy = |t: f64| {
        let [phi, omega, _] = motion(t);
        0.5 * inertia(phi) * omega * omega + potential(phi)
    };
    let [phi, omega, _] = motion(t);
    let taken = -process(phi) * omega + BEARINGS * omega * omega + coulomb(phi) * omega.abs();
    (derivative(energy, t, 1e-4) + taken) / omega
}

/// One instant at the input of the belt.
#[derive(Clone, Copy)]
pub(crate) struct Input {
    pub(crate) torque: f64,
    pub(crate) speed: f64,
    pub(crate) alpha: f64,
    pub(crate) inertia: f64,
}

/// Through the belt: the torque of the driven pulley, then the loss, then the driver pulley.
pub(crate) fn input(t: f64) -> Input {
    let [phi, omega, alpha] = motion(t);
    let delivered = crank_torque(t) + DRIVEN * alpha;
    let power_flows_on = delivered * omega >= 0.0;
    let torque = if power_flows_on {
        delivered / (RATIO * BELT_EFFICIENCY)
    } else {
        delivered * BELT_EFFICIENCY / RATIO
    };
    Input {
        torque: torque + DRIVER * RATIO * alpha,
        speed: RATIO * omega,
        alpha: RATIO * alpha,
        inertia: DRIVER + (DRIVEN + inertia(phi)) / (RATIO * RATIO),
    }
}

/// A motor with a gearbox: ratio, η, inertia of gearbox and rotor.
#[derive(Clone, Copy)]
pub(crate) struct Geared {
    pub(crate) ratio: f64,
    pub(crate) efficiency: f64,
    pub(crate) gearbox: f64,
    pub(crate) rotor: f64,
}

impl Geared {
    /// Motor torque and speed.
    pub(crate) fn motor(&self, at: &Input) -> [f64; 2] {
        let loss = if at.torque * at.speed < 0.0 {
            self.efficiency
        } else {
            1.0 / self.efficiency
        };
        let own = (self.rotor + self.gearbox) * self.ratio * at.alpha;
        [at.torque * loss / self.ratio + own, self.ratio * at.speed]
    }

    pub(crate) fn inertia_ratio(&self, at: &Input) -> f64 {
        (at.inertia / (self.ratio * self.ratio) + self.gearbox) / self.rotor
    }
}

/// Figures of a quantity over the cycle, by the trapezoidal rule at equal steps (not Simpson's, as in the tool).
pub(crate) struct Figures {
    pub(crate) min: f64,
    pub(crate) mean: f64,
    pub(crate) max: f64,
    pub(crate) rms: f64,
}

/// Figures of the values at equal steps over `CYCLE`.
pub(crate) fn figures(values: &[f64]) -> Figures {
    use super::numerics::trapezoid;
    let step = CYCLE / (values.len() - 1) as f64;
    let squares = trapezoid(step, values.iter().map(|x| x * x));
    Figures {
        min: values.iter().copied().fold(f64::INFINITY, f64::min),
        mean: trapezoid(step, values.iter().copied()) / CYCLE,
        max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        rms: (squares / CYCLE).sqrt(),
    }
}

/// The input at `count` + 1 equally spaced times of the cycle.
pub(crate) fn cycle(count: usize) -> Vec<Input> {
    (0..=count)
        .map(|k| input(CYCLE * k as f64 / count as f64))
        .collect()
}
