//! Drives against the duty: brute force, limits of the motor, ranking.

use jred_analysis::duty::Duty;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_report::list::rule_words::{reasons, sentence};
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Catalogue, Gearbox, Motor};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::Assessment;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::select::size::{Candidate, Certainty, Selection};

use super::{catalogue, duty_of, read};
use crate::brute;
use crate::support::{budget, near, press_text, within};

/// Data borrowed by a selection.
struct Ready {
    catalogue: Catalogue,
    motors: Vec<MotorLimits>,
    cycle: Cycle,
    site: Site,
    rules: RuleSet,
}

impl Ready {
    fn new(duty: &Duty) -> Self {
        let (catalogue, site) = (catalogue(), Site::default());
        Self {
            motors: catalogue.prepare(&site),
            catalogue,
            cycle: Cycle::new(duty),
            site,
            rules: RuleSet::default(),
        }
    }

    fn selection(&self) -> Selection<'_> {
        Selection::new(
            &self.catalogue,
            &self.motors,
            &self.cycle,
            &self.site,
            &self.rules,
        )
    }
}

/// A drive of these parts, without an amplifier.
pub(super) const fn drive<'c>(motor: &'c Motor, gearbox: Option<&'c Gearbox>) -> Drive<'c> {
    Drive {
        motor,
        gearbox,
        amplifier: None,
    }
}

/// Every figure of every drive, computed again from the instants by plain formulas.
#[test]
fn every_drive_by_brute_force() {
    let file = read(&press_text());
    let duty = brute::sampled(duty_of(&file, 400));
    let cycle = 0.5;
    let ready = Ready::new(&duty);
    let mut selection = ready.selection();
    selection.complete();
    for candidate in selection
        .fit
        .known()
        .iter()
        .chain(selection.refused.known())
    {
        let judged = selection.judged(candidate);
        let motor = judged.drive.motor;
        let rotor = motor.rotor_inertia + motor.brake.map_or(0.0, |brake| brake.inertia);
        let (mut squares, mut mean, mut back, mut forth, mut turns) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut least, mut most, mut fastest) = (f64::MAX, f64::MIN, 0.0f64);
        let (mut lambda_least, mut lambda_most, mut lambda_mean) = (f64::MAX, 0.0f64, 0.0);
        for instant in &duty.instants {
            let (load, speed) = (instant.input_torque, instant.input_speed);
            // Power first, then torque: the motor's power is that of the load, the loss, and the change of energy in rotor and gearbox.
            let (torque, motor_speed, lambda) = match judged.drive.gearbox {
                None => (
                    load + rotor * instant.input_alpha,
                    speed,
                    instant.input_inertia / rotor,
                ),
                Some(g) => {
                    let through = if load * speed >= 0.0 {
                        load / g.ratio / g.efficiency
                    } else {
                        load / g.ratio * g.efficiency
                    };
                    let turning = rotor + g.inertia;
                    (
                        through + turning * g.ratio * instant.input_alpha,
                        speed * g.ratio,
                        (instant.input_inertia / g.ratio / g.ratio + g.inertia) / rotor,
                    )
                }
            };
            let weight = instant.weight;
            squares += weight * torque * torque;
            mean += weight * torque;
            let power = torque * motor_speed;
            if power < 0.0 {
                back -= weight * power;
            } else {
                forth += weight * power;
            }
            turns += weight * motor_speed.abs();
            (least, most) = (least.min(torque), most.max(torque));
            fastest = fastest.max(motor_speed.abs());
            (lambda_least, lambda_most) = (lambda_least.min(lambda), lambda_most.max(lambda));
            lambda_mean += weight * lambda / cycle;
        }
        let found = &judged.duty;
        let name = judged.drive.name();
        let rms = (squares / cycle).sqrt();
        let same = |what: &str, found: f64, expected: f64, scale: f64| {
            within(
                &format!("{name}: {what}"),
                found,
                expected,
                budget::SAME_SUMS * scale,
            );
        };
        same("RMS", found.torque.rms, rms, rms);
        same("mean", found.torque.mean, mean / cycle, rms);
        same("least", found.torque.min, least, rms);
        same("most", found.torque.max, most, rms);
        same("fastest", found.speed.peak(), fastest, fastest);
        same("mean speed", found.mean_speed, turns / cycle, fastest);
        same("regenerative", found.regenerative_energy, back, forth);
        same("motoring", found.motoring_energy, forth, forth);
        same(
            "mean power",
            found.power.mean,
            (forth - back) / cycle,
            forth,
        );
        let lambda = found.inertia_ratio;
        same("λ", lambda.min, lambda_least, lambda_most);
        same("λ", lambda.mean, lambda_mean, lambda_most);
        same("λ", lambda.max, lambda_most, lambda_most);
        // A loss is never a gain: the motor's net energy is at least that taken at the machine's input.
        let taken = duty.integral(|i| i.input_torque * i.input_speed);
        assert!(forth - back >= taken * (1.0 - 1e-6), "{name}");
        check_rules(&judged);
    }
}

/// The rules for which the catalogue always has data.
fn check_rules(judged: &Assessment) {
    let name = judged.drive.name();
    let of_motor = [
        Rule::RmsTorque,
        Rule::PeakTorque,
        Rule::Speed,
        Rule::HoldingTorque,
        Rule::InertiaRatio,
    ];
    // With two cycles a second, the warning about T2B is one of the gearbox's.
    let of_gearbox = [
        Rule::GearboxPeak,
        Rule::GearboxCubicMean,
        Rule::GearboxMeanSpeed,
        Rule::GearboxSpeed,
        Rule::GearboxCycles,
    ];
    let value = |rule: Rule| {
        let check = judged.checks.iter().find(|c| c.id == rule);
        check.and_then(|c| c.value)
    };
    assert!(of_motor.iter().all(|rule| value(*rule).is_some()), "{name}");
    for rule in of_gearbox {
        let applies = judged.drive.gearbox.is_some();
        assert_eq!(value(rule).is_some(), applies, "{name}: {rule:?}");
    }
}

/// Twice the ratio: half the torque, twice the speed, a quarter of the inertia (lossless and without inertia).
#[test]
fn scaling_with_the_ratio() {
    let catalogue = catalogue();
    let file = read(&press_text());
    let duty = duty_of(&file, 400);
    let mut motor = catalogue.motors[0].clone();
    motor.rotor_inertia = 1e-12;
    let gearbox = |ratio: f64| {
        let mut gearbox = catalogue.gearboxes[0].clone();
        gearbox.ratio = ratio;
        gearbox.inertia = 0.0;
        gearbox.efficiency = 1.0;
        gearbox.back_efficiency = 1.0;
        gearbox.no_load_torque = 0.0;
        gearbox
    };
    let cycle = Cycle::new(&duty);
    let direct = cycle.motor_duty(&drive(&motor, None));
    for ratio in [1.0, 2.0, 4.0, 8.5] {
        let gearbox = gearbox(ratio);
        let geared = cycle.motor_duty(&drive(&motor, Some(&gearbox)));
        near("torque", geared.torque.rms, direct.torque.rms / ratio, 1e-8);
        near(
            "peak",
            geared.torque.peak(),
            direct.torque.peak() / ratio,
            1e-8,
        );
        near(
            "speed",
            geared.speed.peak(),
            direct.speed.peak() * ratio,
            1e-14,
        );
        near("power", geared.power.rms, direct.power.rms, 1e-8);
        near("largest power", geared.power.max, direct.power.max, 1e-8);
        near("least power", geared.power.min, direct.power.min, 1e-8);
        let lambda = direct.inertia_ratio.max / (ratio * ratio);
        near("λ", geared.inertia_ratio.max, lambda, 1e-14);
    }
    // An efficiency makes driving harder by 1/η, and driven operation easier by η.
    let mut lossy = gearbox(4.0);
    lossy.efficiency = 0.5;
    lossy.back_efficiency = 0.5;
    lossy.no_load_torque = 0.0;
    let drive = drive(&motor, Some(&lossy));
    for instant in &duty.instants {
        let ideal = instant.input_torque / 4.0;
        let found = drive.motor_point(instant).torque;
        let factor = if instant.input_torque * instant.input_speed < 0.0 {
            0.5
        } else {
            2.0
        };
        within(
            "torque",
            found,
            ideal * factor,
            1e-6 * duty.figures(|i| i.input_torque).peak(),
        );
    }
}

#[test]
fn ranking() {
    let file = read(&press_text());
    let duty = duty_of(&file, 400);
    let ready = Ready::new(&duty);
    let mut selection = ready.selection();
    selection.complete();
    let (fit, refused) = (selection.fit.known(), selection.refused.known());
    assert!(fit.len() > 10 && refused.len() > 100);
    let catalogue = &ready.catalogue;
    assert_eq!(fit.len() + refused.len(), catalogue.count());
    let mut names: Vec<String> = fit.iter().chain(refused).map(|j| j.drive.name()).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), fit.len() + refused.len());
    for candidate in refused {
        let judged = selection.judged(candidate);
        let broken = judged
            .checks
            .iter()
            .filter(|c| c.verdict == RuleVerdict::Fail);
        let broken: Vec<_> = broken.collect();
        assert!(!broken.is_empty());
        for check in broken {
            // A voltage or an overload that nothing bounds has no value.
            let (Some(value), Some(limit)) = (check.value, check.limit) else {
                assert!(matches!(check.id, Rule::BusVoltage | Rule::Overload));
                continue;
            };
            assert!(value > limit, "{}: {value} against {limit}", check.rule);
            assert!(reasons(&judged).contains(check.rule));
            assert!(check.margin.is_none_or(|margin| margin < 0.0));
        }
        let unbounded = candidate.outcome.beyond_all_limits > 0;
        assert!(unbounded || candidate.outcome.worst_use >= 1.0);
    }
    for candidate in fit {
        let judged = selection.judged(candidate);
        assert!(judged.holds());
        assert!(candidate.outcome.worst_use <= 1.0);
        for check in &judged.checks {
            let held = check.margin.is_none_or(|margin| margin >= 0.0);
            assert!(
                held || check.verdict == RuleVerdict::Warn,
                "{}",
                sentence(check)
            );
        }
    }
    for pair in fit.windows(2) {
        let key = |c: &Candidate| {
            (
                Certainty::of(&c.drive, &c.outcome),
                // With the digits of a data sheet: equal powers differ in their last bit.
                c.drive.motor.rated_power().map(|power| power as f32),
                c.drive.motor.rated_torque,
                c.outcome.warnings > 0,
                c.drive
                    .amplifier
                    .map_or(f64::INFINITY, |amplifier| amplifier.rated_current),
                c.drive.gearbox.map_or(Some(0.0), |g| g.rated_torque),
            )
        };
        assert!(
            key(&pair[0]) <= key(&pair[1]),
            "{:?} {:?}",
            key(&pair[0]),
            key(&pair[1])
        );
    }
    for pair in refused.windows(2) {
        let key = |c: &Candidate| (c.outcome.beyond_all_limits, c.outcome.worst_use as f32);
        assert!(key(&pair[0]) <= key(&pair[1]));
    }
}

/// Text about a refused drive.
#[test]
fn reasons_read_well() {
    let file = read(&press_text());
    let ready = Ready::new(&duty_of(&file, 100));
    let selection = ready.selection();
    for candidate in &selection.first_refused(usize::MAX) {
        let reasons = reasons(&selection.judged(candidate));
        for blemish in ["  ", " )", "inf", "NaN"] {
            assert!(!reasons.contains(blemish), "{blemish:?} in: {reasons}");
        }
    }
}
