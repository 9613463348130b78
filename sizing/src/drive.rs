//! A drive: a motor, alone or with a gearbox, at the input of the machine's drive train.

use serde::Serialize;

use crate::catalogue::{Amplifier, Gearbox, Motor};
use crate::check::{Check, Verdict};
use crate::duty::{Figures, Instant};
use crate::judge::Context;
use crate::rule::Rule;
use crate::rules::RuleSet;

/// rad/s of one revolution per minute.
pub const RPM: f64 = std::f64::consts::PI / 30.0;

/// A candidate: motor and, unless it is coupled directly, gearbox.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'c> {
    /// The motor.
    pub motor: &'c Motor,
    /// The gearbox; `None`: coupled directly.
    pub gearbox: Option<&'c Gearbox>,
    /// The servo amplifier; `None`: not chosen.
    pub amplifier: Option<&'c Amplifier>,
}

/// The motor torque as a linear form in the five loads of an instant: see [`loads`].
///
/// ```text
/// T = (J_M + J_G)·i·α + τ₊/(i·η) + τ₋·η_back/i + b·i·n + c·sgn n
/// ```
///
/// α, n and τ are acceleration, speed and torque at the gearbox output; τ₊ is the torque where power flows to the machine
/// (and at rest), τ₋ where it flows back; J_M and J_G inertia of rotor and gearbox, i the ratio, η the efficiencies, b and c
/// viscous and Coulomb friction of motor and gearbox at the motor shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients(pub [f64; LOADS]);

/// Number of loads of an instant.
pub const LOADS: usize = 5;

/// The five loads of an instant: α, τ₊, τ₋, n, sgn n.
pub fn loads(instant: &Instant) -> [f64; LOADS] {
    loads_of(
        instant.input_alpha,
        instant.input_torque,
        instant.input_speed,
    )
}

/// The five loads of acceleration (rad/s²), torque (N·m) and speed (rad/s) at the gearbox output.
#[inline]
pub fn loads_of(alpha: f64, torque: f64, speed: f64) -> [f64; LOADS] {
    let [driving, back] = if torque * speed < 0.0 {
        [0.0, torque]
    } else {
        [torque, 0.0]
    };
    let sign = if speed == 0.0 { 0.0 } else { speed.signum() };
    [alpha, driving, back, speed, sign]
}

impl Coefficients {
    /// The motor torque (N·m) under these loads.
    #[inline]
    pub fn torque(&self, loads: &[f64; LOADS]) -> f64 {
        let [a, b, c, d, e] = self.0;
        let [alpha, driving, back, speed, sign] = loads;
        a * alpha + (b * driving + c * back) + (d * speed + e * sign)
    }
}

/// Torque and speed of the motor at one instant.
#[derive(Clone, Copy, Debug)]
pub struct MotorPoint {
    /// Torque (N·m).
    pub torque: f64,
    /// Speed (rad/s).
    pub speed: f64,
}

/// The duty seen by the motor.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MotorDuty {
    /// Motor torque (N·m).
    #[serde(rename = "torque [N m]")]
    pub torque: Figures,
    /// Motor speed (rad/s).
    #[serde(rename = "speed [rad/s]")]
    pub speed: Figures,
    /// Mean of the speed's magnitude (rad/s).
    #[serde(rename = "mean |speed| [rad/s]")]
    pub mean_speed: f64,
    /// Mechanical power at the motor shaft (W).
    #[serde(rename = "power [W]")]
    pub power: Figures,
    /// Energy that the motor puts in over a cycle (J).
    #[serde(rename = "motoring energy [J]")]
    pub motoring_energy: f64,
    /// Energy that comes back to the motor over a cycle (J).
    #[serde(rename = "regenerative energy [J]")]
    pub regenerative_energy: f64,
    /// Inertia ratio λ = (load and gearbox at the motor)/(rotor), over the cycle.
    #[serde(rename = "inertia ratio")]
    pub inertia_ratio: Figures,
}

/// A drive judged.
#[derive(Clone, Debug)]
pub struct Judged<'c> {
    /// The drive.
    pub drive: Drive<'c>,
    /// Its duty.
    pub duty: MotorDuty,
    /// Every rule.
    pub checks: Vec<Check>,
    /// What was assumed about motor and gearbox, and whose figures are second-hand.
    pub assumptions: Vec<&'static str>,
}

impl Drive<'_> {
    /// Gear ratio between motor and drive train.
    pub fn ratio(&self) -> f64 {
        self.gearbox.map_or(1.0, |g| g.ratio)
    }

    /// Name for tables.
    pub fn name(&self) -> String {
        let mut name = match self.gearbox {
            Some(gearbox) => format!("{} + {}", self.motor.key, gearbox.key),
            None => format!("{}, direct", self.motor.key),
        };
        if let Some(amplifier) = self.amplifier {
            name += " on ";
            name += &amplifier.key;
        }
        name
    }

    /// Inertia of the rotor with its brake (kg·m²).
    pub fn rotor(&self) -> f64 {
        self.motor.rotor_inertia + self.motor.brake.map_or(0.0, |brake| brake.inertia)
    }

    /// The motor torque as a linear form in the loads.
    pub fn coefficients(&self) -> Coefficients {
        let motor = self.motor;
        let rotor = self.rotor();
        let [coulomb, viscous] = motor.friction;
        match self.gearbox {
            None => Coefficients([rotor, 1.0, 1.0, viscous, coulomb]),
            Some(g) => Coefficients([
                (rotor + g.inertia) * g.ratio,
                1.0 / (g.ratio * g.efficiency),
                g.back_efficiency / g.ratio,
                viscous * g.ratio,
                coulomb + g.no_load_torque,
            ]),
        }
    }

    /// What the motor does at an instant.
    pub fn motor_point(&self, instant: &Instant) -> MotorPoint {
        MotorPoint {
            torque: self.coefficients().torque(&loads(instant)),
            speed: instant.input_speed * self.ratio(),
        }
    }

    /// λ for an inertia at the gearbox output: (J/i² + J_G)/J_M, where J_M is the rotor with its brake.
    pub fn inertia_ratio(&self, inertia: f64) -> f64 {
        let ratio = self.ratio();
        let gearbox = self.gearbox.map_or(0.0, |g| g.inertia);
        (inertia / (ratio * ratio) + gearbox) / self.rotor()
    }
}

impl<'c> Judged<'c> {
    /// Judges a drive by every rule, in words.
    pub fn new(context: &Context<'c>, rules: &RuleSet) -> Self {
        Self {
            drive: context.drive,
            duty: context.cycle.motor_duty(&context.drive),
            checks: context.checks(rules),
            assumptions: context.assumptions(),
        }
    }

    /// The worst verdict.
    pub fn verdict(&self) -> Verdict {
        let worst = self.checks.iter().map(|c| c.verdict).max();
        worst.unwrap_or(Verdict::Pass)
    }

    /// Whether no rule is violated.
    pub fn holds(&self) -> bool {
        self.verdict() != Verdict::Fail
    }

    /// The rules that are broken, in one sentence each.
    pub fn reasons(&self) -> String {
        let broken = self.checks.iter().filter(|c| c.verdict == Verdict::Fail);
        broken.map(Check::sentence).collect::<Vec<_>>().join("; ")
    }

    /// How much of a rule's limit is used, in words; nothing if the rule was not applied.
    pub fn used(&self, rule: Rule) -> String {
        let check = self.checks.iter().find(|c| c.id == rule);
        check.map_or(String::new(), Check::used)
    }

    /// Installed power (W); nothing where the catalogue does not say.
    pub fn rated_power(&self) -> Option<f64> {
        self.drive.motor.rated_power()
    }
}
