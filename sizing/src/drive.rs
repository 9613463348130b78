//! A drive: a motor, alone or with a gearbox, at the input of the machine's drive train.

use serde::Serialize;

use crate::catalogue::{Gearbox, Motor};
use crate::check::{Check, Verdict};
use crate::duty::{Duty, Figures, Instant};
use crate::envelope::Envelope;
use crate::rules::Rules;

/// rad/s of one revolution per minute.
pub const RPM: f64 = std::f64::consts::PI / 30.0;

/// A candidate: motor and, unless it is coupled directly, gearbox.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'c> {
    /// The motor.
    pub motor: &'c Motor,
    /// The gearbox; `None`: coupled directly.
    pub gearbox: Option<&'c Gearbox>,
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
        match self.gearbox {
            Some(gearbox) => format!("{} + {}", self.motor.key, gearbox.key),
            None => format!("{}, direct", self.motor.key),
        }
    }

    /// What the motor does at an instant: T = J_M·α + J_G·α + T_out/(i·η^±1), with the gearbox's efficiency η
    /// dividing where power flows to the machine and multiplying where it flows back.
    pub fn motor_point(&self, instant: &Instant) -> MotorPoint {
        let alpha = instant.input_alpha * self.ratio();
        let speed = instant.input_speed * self.ratio();
        let mut torque = instant.input_torque;
        if let Some(gearbox) = self.gearbox {
            let back = instant.input_torque * instant.input_speed < 0.0;
            let loss = if back {
                gearbox.efficiency
            } else {
                1.0 / gearbox.efficiency
            };
            torque = torque / gearbox.ratio * loss + gearbox.inertia * alpha;
        }
        torque += self.motor.rotor_inertia * alpha;
        MotorPoint { torque, speed }
    }

    /// λ at an instant.
    fn inertia_ratio(&self, instant: &Instant) -> f64 {
        let ratio = self.ratio();
        let gearbox = self.gearbox.map_or(0.0, |g| g.inertia);
        (instant.input_inertia / (ratio * ratio) + gearbox) / self.motor.rotor_inertia
    }

    /// What the motor does at every instant of the cycle.
    fn motor_points(&self, duty: &Duty) -> Vec<MotorPoint> {
        duty.instants.iter().map(|i| self.motor_point(i)).collect()
    }

    /// The duty at the motor.
    pub fn duty(&self, duty: &Duty) -> MotorDuty {
        self.duty_of(duty, &self.motor_points(duty))
    }

    fn duty_of(&self, duty: &Duty, points: &[MotorPoint]) -> MotorDuty {
        let power = || points.iter().map(|p| p.torque * p.speed);
        let speed = || points.iter().map(|p| p.speed);
        MotorDuty {
            torque: duty.figures_of(points.iter().map(|p| p.torque)),
            speed: duty.figures_of(speed()),
            mean_speed: duty.integral_of(speed().map(f64::abs)) / duty.duration,
            power: duty.figures_of(power()),
            motoring_energy: duty.integral_of(power().map(|p| p.max(0.0))),
            regenerative_energy: duty.integral_of(power().map(|p| (-p).max(0.0))),
            inertia_ratio: duty.figures(|i| self.inertia_ratio(i)),
        }
    }
}

impl<'c> Judged<'c> {
    /// Judges a drive by every rule.
    pub fn new(drive: Drive<'c>, duty: &Duty, rules: &Rules) -> Self {
        let envelope = Envelope::of(drive.motor);
        let points = drive.motor_points(duty);
        let motor_duty = drive.duty_of(duty, &points);
        let mut checks = motor_checks(&drive, duty, &motor_duty, &envelope, rules);
        checks.insert(1, peak_check(&points, &envelope, rules));
        if let Some(gearbox) = drive.gearbox {
            checks.extend(gearbox_checks(gearbox, duty, &motor_duty, rules));
        }
        Self {
            drive,
            duty: motor_duty,
            checks,
            assumptions: assumptions(&drive, &envelope),
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
    pub fn used(&self, rule: &str) -> String {
        let check = self.checks.iter().find(|c| c.rule == rule);
        check.map_or(String::new(), Check::used)
    }

    /// The largest share of a limit that is used. Where a limit is zero (no torque beyond the maximum speed) the
    /// rule for the speed says by how much.
    pub fn worst_use(&self) -> f64 {
        let uses = self.checks.iter().map(Check::use_of_limit);
        uses.filter(|u| u.is_finite()).fold(0.0, f64::max)
    }

    /// How many rules ask for something where the limit is zero, as a peak torque beyond the largest speed: by how much they
    /// are missed cannot be said.
    pub fn beyond_all_limits(&self) -> usize {
        let uses = self.checks.iter().map(Check::use_of_limit);
        uses.filter(|u| u.is_infinite()).count()
    }

    /// Installed power: rated torque times rated speed (W).
    pub fn rated_power(&self) -> f64 {
        self.drive.motor.rated_torque * self.drive.motor.rated_speed
    }
}

/// What was assumed about motor and gearbox, and whose figures are not the maker's own.
fn assumptions(drive: &Drive, envelope: &Envelope) -> Vec<&'static str> {
    let mut assumptions = Vec::new();
    if !drive.motor.from_maker {
        assumptions.push(
            "motor figures not read in the maker's own document: check them against the data sheet",
        );
    }
    if drive.gearbox.is_some_and(|g| !g.from_maker) {
        assumptions
            .push("gearbox figures not read in the maker's own document: check them against the data sheet");
    }
    assumptions.extend(envelope.assumptions());
    assumptions
}

fn motor_checks(
    drive: &Drive,
    duty: &Duty,
    motor: &MotorDuty,
    envelope: &Envelope,
    rules: &Rules,
) -> Vec<Check> {
    let s1 = envelope.continuous_torque(motor.mean_speed);
    let mut checks = vec![Check::share(
        "RMS torque",
        motor.torque.rms,
        Some(s1),
        rules.rms_torque,
        "N m",
        "S1 torque at mean speed",
    )];
    checks.push(Check::share(
        "speed",
        motor.speed.peak() / RPM,
        Some(envelope.max_speed() / RPM),
        rules.speed,
        "rpm",
        "maximum speed",
    ));
    checks.push(Check::share(
        "holding torque",
        duty.hold_torque / drive.ratio(),
        Some(envelope.standstill()),
        rules.gravity_hold,
        "N m",
        "standstill torque",
    ));
    let lambda = motor.inertia_ratio.max;
    let mut inertia = Check::share(
        "inertia ratio",
        lambda,
        Some(1.0),
        rules.inertia_ratio,
        "",
        "rotor inertia",
    );
    inertia.note = format!(
        "largest λ over the cycle; warning above {}, limit {}",
        rules.inertia_ratio_warning, rules.inertia_ratio
    );
    if inertia.verdict == Verdict::Pass && lambda > rules.inertia_ratio_warning {
        inertia.verdict = Verdict::Warn;
    }
    checks.push(inertia);
    checks
}

/// The instant that comes closest to the peak-torque envelope, or passes it furthest.
fn peak_check(points: &[MotorPoint], envelope: &Envelope, rules: &Rules) -> Check {
    let use_at = |point: &MotorPoint| {
        let limit = envelope.peak_torque(point.speed);
        if limit > 0.0 {
            point.torque.abs() / limit
        } else if point.torque == 0.0 {
            0.0
        } else {
            f64::INFINITY
        }
    };
    let worst = points.iter().max_by(|a, b| use_at(a).total_cmp(&use_at(b)));
    let point = worst.copied().unwrap_or(MotorPoint {
        torque: 0.0,
        speed: 0.0,
    });
    let mut check = Check::share(
        "peak torque",
        point.torque.abs(),
        Some(envelope.peak_torque(point.speed)),
        rules.peak_torque,
        "N m",
        "peak torque at that speed",
    );
    check.note = format!(
        "{}, at {:.0} rpm, where the cycle comes closest to the envelope",
        check.note,
        point.speed.abs() / RPM
    );
    check
}

fn gearbox_checks(gearbox: &Gearbox, duty: &Duty, motor: &MotorDuty, rules: &Rules) -> Vec<Check> {
    let peak = duty.figures(|i| i.input_torque).peak();
    // Root-mean-cube torque, weighted with the speed: the load's share of each revolution counts.
    let turning = duty.integral(|i| i.input_speed.abs());
    let cubes = duty.integral(|i| i.input_speed.abs() * i.input_torque.abs().powi(3));
    let cubic_mean = if turning > 0.0 {
        (cubes / turning).cbrt()
    } else {
        0.0
    };
    let mut checks = vec![
        Check::share(
            "gearbox peak torque",
            peak,
            Some(gearbox.peak_torque),
            rules.gearbox_peak,
            "N m",
            "acceleration torque T2B",
        ),
        Check::share(
            "gearbox cubic-mean torque",
            cubic_mean,
            gearbox.rated_torque,
            rules.gearbox_rated,
            "N m",
            "rated torque T2N",
        ),
        Check::share(
            "gearbox mean speed",
            motor.mean_speed / RPM,
            gearbox.rated_speed.map(|s| s / RPM),
            rules.gearbox_speed,
            "rpm",
            "rated input speed n1N",
        ),
        Check::share(
            "gearbox largest speed",
            motor.speed.peak() / RPM,
            Some(gearbox.max_speed / RPM),
            rules.gearbox_speed,
            "rpm",
            "maximum input speed",
        ),
    ];
    checks.extend(cycles_check(duty));
    checks
}

/// Acceleration torques T2B hold for up to 1000 cycles per hour; above that makers ask for a shock factor of their own
/// (WITTENSTEIN, engineering glossary), which the catalogue does not hold: a warning, not a verdict.
fn cycles_check(duty: &Duty) -> Option<Check> {
    const CYCLES: f64 = 1000.0;
    let cycles = 3600.0 / duty.duration;
    (duty.has_starts() && cycles > CYCLES).then(|| Check {
        rule: "gearbox cycles",
        value: cycles,
        limit: None,
        unit: "per hour",
        verdict: Verdict::Warn,
        note: "above 1000 cycles per hour T2B is to be reduced by the maker's shock factor"
            .to_owned(),
    })
}
