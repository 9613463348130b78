//! Requirements of a drive from any maker: the rules, solved for the ratings of motor, brake, gearbox and amplifier.
//!
//! At one gear ratio the duty leaves two free figures of the motor: the inertia J of its rotor (with brake) and its torque. The torque is T = J·i·a + τ
//! (a: acceleration, τ: load at the motor), so
//!
//! ```text
//! T_rms²(J) = ⟨τ²⟩ + 2·J·i·⟨a·τ⟩ + J²·i²·⟨a²⟩,   T_peak(J) = max |J·i·a + τ|, convex in J
//! ```
//!
//! The rule of the inertia ratio gives the smallest rotor. From there the S1 torque has a least value over J. A motor with `1 + allowance` times that
//! torque satisfies the RMS rule for the rotors of a *window*, whose ends are roots of the quadratic; the peak torque is required at both ends. A motor
//! with these torques and a rotor in the window satisfies every rule that can be checked without its winding, and none of the figures can be smaller
//! (test `a_motor_just_inside_passes_and_just_outside_fails`).

mod corner;
mod gearbox;
mod regeneration;

use serde::Serialize;

use crate::catalogue::{Amplifier, Brake, Drive, Gearbox, Motor, MotorKind};
use crate::cycle::Cycle;
use crate::cycle::form::Coefficients;
use crate::judge::{Context, Findings, OF_ELEMENTS};
use crate::motor::envelope::MotorLimits;
use crate::select::fit::input_kind;
use crate::select::ratio::Gear;
use jred_analysis::duty::mechanics::MotorBrake;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::units::RPM;

pub use gearbox::GearboxRequirement;
pub use regeneration::Regeneration;

/// Ratios of planetary gearboxes with one and two stages, as makers offer them.
const USUAL_RATIOS: [f64; 20] = [
    3.0, 4.0, 5.0, 7.0, 8.0, 10.0, 12.0, 15.0, 16.0, 20.0, 25.0, 28.0, 32.0, 35.0, 40.0, 50.0,
    64.0, 70.0, 80.0, 100.0,
];

/// Largest speed of usual motors (rad/s).
pub const USUAL_SPEED: f64 = 6000.0 * RPM;

/// Times until a holding brake has its torque (s), for which its work is stated.
pub const CLOSING_TIMES: [f64; 2] = [0.02, 0.1];

/// Most ratios that are listed if none are asked for.
const MOST_RATIOS: usize = 10;

/// A machine that needs a drive, and the choices that its duty leaves open.
#[derive(Clone, Copy, Debug)]
pub struct Inquiry<'a> {
    /// The machine, with its rules and its site.
    pub file: &'a MachineFile,
    /// Its prepared duty.
    pub cycle: &'a Cycle,
    /// Inertia and efficiency of the gearbox.
    pub gear: Gear,
    /// S1 torque above the least possible, as a share of it.
    pub allowance: f64,
}

/// The ratings that a drive needs at one ratio; SI units. For a linear motor read force for torque, mass for inertia.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Requirement {
    /// Gear ratio; `None`: coupled directly.
    pub ratio: Option<f64>,
    /// Smallest and largest inertia of rotor and brake; no largest: any.
    #[serde(rename = "rotor inertia [kg m^2]")]
    #[schemars(with = "[Option<f64>; 2]")]
    pub rotor: [f64; 2],
    /// Smallest inertia of rotor and brake that the rule of the inertia ratio allows; zero without a limit.
    #[serde(rename = "smallest rotor inertia [kg m^2]")]
    pub smallest_rotor: f64,
    /// S1 torque at the mean speed, in the surroundings of the data sheet.
    #[serde(rename = "S1 torque [N m]")]
    pub s1_torque: f64,
    /// S1 torque at standstill: for the loads that last, and not below that at the mean speed.
    #[serde(rename = "standstill torque [N m]")]
    pub standstill_torque: f64,
    /// The part of it for the loads that last at rest.
    #[serde(rename = "lasting torque at rest [N m]")]
    pub held_torque: f64,
    /// Mean speed, at which the S1 torque is required.
    #[serde(rename = "mean speed [rad/s]")]
    pub mean_speed: f64,
    /// Largest speed.
    #[serde(rename = "maximum speed [rad/s]")]
    pub max_speed: f64,
    /// Peak torque.
    #[serde(rename = "peak torque [N m]")]
    pub peak_torque: f64,
    /// Peak torque over speed: (rad/s, N·m), not rising.
    #[serde(rename = "peak torque over speed [rad/s, N m]")]
    pub envelope: Vec<[f64; 2]>,
    /// Torque of the holding brake; `None`: the machine stays where it is without current.
    #[serde(rename = "brake torque [N m]")]
    pub brake_torque: Option<f64>,
    /// Work of this brake in the worst stop by it alone, with any rotor of the window, if it has its torque after 20 ms and after 100 ms; infinite: it
    /// holds the machine but does not stop it; `None` also for a window without an end.
    #[serde(rename = "brake work if closed after 20 ms and 100 ms [J]")]
    #[schemars(with = "Option<[Option<f64>; 2]>")]
    pub brake_work: Option<[f64; 2]>,
    /// Continuous and peak current of the amplifier, times the torque constant of the motor, as its data sheet
    /// states them.
    #[serde(rename = "continuous and peak current times torque constant [N m]")]
    pub currents: [f64; 2],
    /// Energy that flows back.
    pub regeneration: Regeneration,
    /// Whether shafts and drive train alone satisfy the rules of natural frequency and backlash, so that a gearbox can, and the machine's belts,
    /// screws and pinions theirs.
    pub possible: bool,
    /// The gearbox; `None`: coupled directly.
    pub gearbox: Option<GearboxRequirement>,
    /// Mean square of the motor torque as a polynomial of the rotor's inertia: constant, linear, square.
    #[serde(rename = "mean square torque by rotor inertia")]
    pub mean_square: [f64; 3],
}

/// Required torques of a motor with a given rotor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
pub struct TorqueNeed {
    /// Inertia of rotor and brake.
    #[serde(rename = "rotor inertia [kg m^2]")]
    pub rotor: f64,
    /// S1 torque at the mean speed, in the surroundings of the data sheet.
    #[serde(rename = "S1 torque [N m]")]
    pub s1_torque: f64,
    /// Peak torque.
    #[serde(rename = "peak torque [N m]")]
    pub peak_torque: f64,
}

impl Inquiry<'_> {
    /// The ratios to ask for: direct coupling and the usual ones that keep the motor within `max_speed` (rad/s), the largest ten, or all `within` a
    /// range. A linear motor is coupled directly.
    pub fn usual_ratios(&self, max_speed: f64, within: Option<[f64; 2]>) -> Vec<Option<f64>> {
        if input_kind(self.file) == MotorKind::Linear {
            return vec![None];
        }
        let fits = |ratio: &f64| {
            let inside = within.is_none_or(|[from, to]| (from..=to).contains(ratio));
            inside && self.max_speed(*ratio) <= max_speed
        };
        let all = std::iter::once(1.0).chain(USUAL_RATIOS).filter(fits);
        let ratios: Vec<Option<f64>> = all.map(|ratio| (ratio > 1.0).then_some(ratio)).collect();
        let skipped = match within {
            Some(_) => 0,
            None => ratios.len().saturating_sub(MOST_RATIOS),
        };
        ratios.into_iter().skip(skipped).collect()
    }

    /// The share of its rating that a rule allows; one without a limit.
    fn share(&self, rule: Rule) -> f64 {
        let limit = self.file.rules.limit(rule);
        limit.fail.or(limit.warn).unwrap_or(1.0)
    }

    /// Largest speed of the motor (rad/s) at a ratio.
    fn max_speed(&self, ratio: f64) -> f64 {
        self.cycle.peak_speed() * ratio / self.share(Rule::Speed)
    }

    fn gearbox(&self, ratio: Option<f64>) -> Option<Gearbox> {
        ratio.map(|ratio| Gearbox {
            emergency_torque: Some(f64::INFINITY),
            ..self.gear.with_ratio(ratio)
        })
    }

    /// The motor's coefficients with a rotor.
    fn coefficients(&self, ratio: Option<f64>, rotor: f64) -> Coefficients {
        self.with(ratio, &self.motor(rotor), |drive| drive.coefficients())
    }

    /// A motor without limits.
    fn motor(&self, rotor: f64) -> Motor {
        Motor {
            kind: input_kind(self.file),
            rotor_inertia: rotor,
            ..Motor::default()
        }
    }

    fn with<T>(&self, ratio: Option<f64>, motor: &Motor, take: impl FnOnce(Drive) -> T) -> T {
        let gearbox = self.gearbox(ratio);
        take(Drive {
            motor,
            gearbox: gearbox.as_ref(),
            amplifier: None,
        })
    }

    /// Findings of all rules that need no time course, with a motor.
    fn findings(&self, ratio: Option<f64>, motor: &Motor) -> Findings {
        let site = &self.file.site;
        let limits = MotorLimits::new(motor, None, site);
        let mut findings = Findings::default();
        self.with(ratio, motor, |drive| {
            Context::new(self.cycle, site, drive, &limits)
                .measure_directly(&self.file.rules, &mut findings);
        });
        findings
    }

    /// The rating that a rule requires: its figure over the allowed share.
    fn required(&self, findings: &Findings, rule: Rule) -> f64 {
        let value = findings.get(rule).map_or(0.0, |found| found.value);
        value / self.share(rule)
    }

    /// ⟨τ²⟩, 2·i·⟨a·τ⟩ and i²·⟨a²⟩ at a ratio, without the losses of the motor.
    fn mean_square(&self, ratio: Option<f64>) -> [f64; 3] {
        let without = self.coefficients(ratio, 0.0);
        let step = ratio.unwrap_or(1.0);
        let mut with = without;
        // The scale at which both parts are alike, so that their difference keeps its digits.
        let per_inertia = self
            .cycle
            .rms_torque(&Coefficients([step, 0.0, 0.0, 0.0, 0.0]));
        let load = self.cycle.rms_torque(&without);
        let scale = if per_inertia > 0.0 && load > 0.0 {
            load / per_inertia
        } else {
            1.0
        };
        with.0[0] += scale * step;
        let both = self.cycle.rms_torque(&with);
        let square = per_inertia * per_inertia;
        let linear = (both * both - load * load - square * scale * scale) / scale;
        [load * load, linear, square]
    }

    /// Factor of the S1 torque at the site, of a motor without derating data of its maker.
    pub fn derating(&self) -> f64 {
        self.motor(1.0).derated(&self.file.site.surroundings).factor
    }

    /// Share of a data sheet's S1 torque that the RMS torque may be: the limit of the rule, and the factor of the site.
    fn s1_share(&self) -> f64 {
        self.share(Rule::RmsTorque) * self.derating()
    }

    /// The required torques of a motor with a rotor at a ratio.
    pub fn needs(&self, ratio: Option<f64>, rotor: f64) -> TorqueNeed {
        let coefficients = self.coefficients(ratio, rotor);
        TorqueNeed {
            rotor,
            s1_torque: self.cycle.rms_torque(&coefficients) / self.s1_share(),
            peak_torque: self.cycle.peak_torque(&coefficients) / self.share(Rule::PeakTorque),
        }
    }

    /// The smallest rotor (with brake) that the rule of the inertia ratio allows, from the findings with a rotor of 1 kg·m²; zero without a limit.
    fn smallest_rotor(&self, measured: &Findings) -> f64 {
        let limited = self.file.rules.limit(Rule::InertiaRatio).is_set();
        let found = measured.get(Rule::InertiaRatio);
        // λ is proportional to one over the rotor's inertia.
        let found = found.filter(|found| limited && found.is_known());
        found.map_or(0.0, |found| {
            found.value / (found.rating * self.share(Rule::InertiaRatio))
        })
    }

    /// The requirement at a ratio; `None`: coupled directly.
    pub fn requirement(&self, ratio: Option<f64>) -> Requirement {
        let squares @ [constant, linear, square] = self.mean_square(ratio);
        let measured = self.findings(ratio, &self.motor(1.0));
        let smallest = self.smallest_rotor(&measured);
        let best = if square > 0.0 {
            smallest.max(-0.5 * linear / square)
        } else {
            smallest
        };
        let least = self.cycle.rms_torque(&self.coefficients(ratio, best));
        let allowed = least * (1.0 + self.allowance);
        // square·J² + linear·J + constant = allowed², around −linear/(2·square).
        let rotor = if square > 0.0 {
            let half = 0.5 * linear / square;
            let root = (half * half - (constant - allowed * allowed) / square)
                .max(0.0)
                .sqrt();
            [smallest.max(-half - root), -half + root]
        } else {
            [smallest, f64::INFINITY]
        };
        let s1_torque = allowed / self.s1_share();
        let factor = self.derating();
        let lasting = [Rule::HoldingTorque, Rule::ConstantTorque].map(|rule| {
            let is_set = self.file.rules.limit(rule).is_set();
            if is_set {
                self.required(&measured, rule)
            } else {
                0.0
            }
        });
        let held_torque = lasting[0].max(lasting[1]) / factor;
        // The winding is judged by the S1 torque at standstill, and no motor has less there than at speed.
        let standstill_torque = held_torque.max(s1_torque);
        let ends = rotor.map(|end| if end.is_finite() { end } else { rotor[0] });
        let [first, last] = ends.map(|end| {
            let coefficients = self.coefficients(ratio, end);
            self.cycle.peak_torque(&coefficients)
        });
        let drawn = first.max(last);
        // No motor has less peak torque than S1 torque.
        let peak_torque = (drawn / self.share(Rule::PeakTorque)).max(standstill_torque);
        let [mean_speed, max_speed] = [self.cycle.mean_speed(), self.cycle.peak_speed()]
            .map(|speed| speed * ratio.unwrap_or(1.0));
        let max_speed = max_speed / self.share(Rule::Speed);
        // A machine without the rule asks for no brake.
        let brake_torque = (measured.get(Rule::BrakeTorque))
            .filter(|_| self.file.rules.limit(Rule::BrakeTorque).is_set())
            .map(|found| found.value / self.share(Rule::BrakeTorque));
        let brake_work = brake_torque.filter(|_| rotor[1].is_finite());
        let brake_work = brake_work.map(|torque| self.brake_work(ratio, ends, torque));
        let site = &self.file.site.surroundings;
        let derated = Amplifier::default().derated(site).factor;
        let mut found = Requirement {
            ratio,
            rotor,
            smallest_rotor: smallest,
            s1_torque,
            standstill_torque,
            held_torque,
            mean_speed,
            max_speed,
            peak_torque,
            envelope: Vec::new(),
            brake_torque,
            brake_work,
            currents: [
                allowed / self.share(Rule::RmsCurrent) / derated,
                drawn / self.share(Rule::PeakCurrent) / derated,
            ],
            regeneration: self.regeneration(ratio, ends, peak_torque),
            possible: true,
            gearbox: None,
            mean_square: squares,
        };
        found.envelope = self.envelope(&found, ends);
        found.gearbox = ratio.map(|ratio| self.gearbox_requirement(ratio, &found, ends));
        found.possible = self.is_possible(&found, &measured);
        found
    }

    /// Work of a brake in the worst stop by it alone, for [`CLOSING_TIMES`]. With the inertia J it falls and rises: ½·J·ω₀² + ω₀·d·t + ½·d²·t²/J when
    /// the brake closes, convex in J, so one end of the window has the most.
    fn brake_work(&self, ratio: Option<f64>, ends: [f64; 2], torque: f64) -> [f64; 2] {
        let step = ratio.unwrap_or(1.0);
        CLOSING_TIMES.map(|time| {
            let works = ends.map(|rotor| {
                let brake = MotorBrake {
                    torque,
                    time,
                    inertia: self.coefficients(ratio, rotor).0[0] / step,
                    ratio: step,
                };
                self.cycle.mechanics().run_on.worst(&brake).work
            });
            works[0].max(works[1]) / self.share(Rule::BrakeWork)
        })
    }

    /// Whether belts, screws and pinions satisfy their rules, and shafts and drive train leave room for a gearbox, or, coupled directly, satisfy the
    /// rules themselves.
    fn is_possible(&self, found: &Requirement, measured: &Findings) -> bool {
        let rules = &self.file.rules;
        let fails = |rule| rules.limit(rule).fail.is_some();
        let satisfied = |rule: &Rule| {
            let found = measured.get(*rule);
            found.is_none_or(|found| rules.verdict(*rule, found) != RuleVerdict::Fail)
        };
        if !OF_ELEMENTS.iter().all(satisfied) {
            return false;
        }
        match &found.gearbox {
            Some(gearbox) => {
                let soft = gearbox.stiffness.is_some_and(f64::is_infinite);
                let loose = gearbox.backlash.is_some_and(|play| play < 0.0);
                !(soft && fails(Rule::NaturalFrequency) || loose && fails(Rule::Backlash))
            }
            None => [Rule::NaturalFrequency, Rule::Backlash]
                .iter()
                .all(satisfied),
        }
    }

    /// The rules of the site that a motor without derating data of its maker violates.
    pub fn beyond_site(&self) -> Vec<Rule> {
        let measured = self.findings(None, &self.motor(1.0));
        let rules = &self.file.rules;
        let fails = |rule: &Rule| {
            let found = measured.get(*rule);
            found.is_some_and(|found| rules.verdict(*rule, found) == RuleVerdict::Fail)
        };
        [Rule::AmbientTemperature, Rule::Altitude]
            .into_iter()
            .filter(fails)
            .collect()
    }

    /// Magnitudes of speed and torque over the cycle with the largest rotor of the window (rad/s, N·m).
    pub fn duty_points(&self, found: &Requirement) -> Vec<[f64; 2]> {
        let [from, to] = found.rotor;
        let rotor = if to.is_finite() { to } else { from };
        self.points(found.ratio, rotor).collect()
    }

    /// Magnitudes of speed and torque over the cycle with a rotor (rad/s, N·m).
    fn points(&self, ratio: Option<f64>, rotor: f64) -> impl Iterator<Item = [f64; 2]> {
        let coefficients = self.coefficients(ratio, rotor);
        let ratio = ratio.unwrap_or(1.0);
        self.cycle.samples().iter().map(move |sample| {
            let torque = coefficients.torque(&sample.loads());
            [(sample.speed() * ratio).abs(), torque.abs()]
        })
    }
}

impl Requirement {
    /// The S1 power: torque at the mean speed (W).
    pub fn power(&self) -> f64 {
        self.s1_torque * self.mean_speed
    }

    /// The smallest motor of the requirement, with a rotor: an entry of a catalogue.
    pub fn smallest_motor(&self, kind: MotorKind, rotor: f64) -> Motor {
        let s1 = self.standstill_torque;
        Motor {
            kind,
            rotor_inertia: rotor,
            rated_torque: Some(s1),
            standstill_torque: Some(s1),
            rated_speed: Some(self.max_speed),
            max_speed: Some(self.max_speed),
            corner_speed: Some(self.max_speed),
            peak_torque: Some(self.peak_torque),
            brake: self.brake_torque.map(|torque| Brake {
                torque,
                ..Brake::default()
            }),
            ..Motor::default()
        }
    }
}
