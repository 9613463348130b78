//! Temperature and current of a drive: the model for the given data, and texts about missing data.

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::operation::Operation;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_report::list::rule_words::note;
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Amplifier, Gearbox, Motor, Thermal, Winding};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::Context;
use jred_sizing::judge::check::Check;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::motor::winding::COPPER;
use jred_sizing::thermal::{Load, Model};

use super::{budget, near};
use crate::direct;
use crate::support::press_text;

fn cycle() -> Cycle {
    let file = checked::parse("press.toml", &press_text(), Path::new("")).unwrap();
    Cycle::new(&Duty::new(&file, file.motion.as_ref().unwrap(), 1000).unwrap())
}

/// A motor that drives the press without a gearbox.
fn motor() -> Motor {
    Motor {
        key: "m".to_owned(),
        rated_torque: Some(40.0),
        standstill_torque: Some(50.0),
        rated_speed: Some(200.0),
        max_speed: Some(400.0),
        peak_torque: Some(400.0),
        rotor_inertia: 0.01,
        friction: [0.3, 0.002],
        winding: Winding {
            torque_constant: Some(2.0),
            resistance: Some(0.6),
            ..Winding::default()
        },
        thermal: Thermal {
            winding_resistance: Some(0.15),
            housing_resistance: Some(0.35),
            winding_time: Some(40.0),
            housing_time: Some(2400.0),
            max_temperature: Some(155.0),
        },
        ..Motor::default()
    }
}

fn amplifier() -> Amplifier {
    Amplifier {
        key: "a".to_owned(),
        rated_current: 20.0,
        peak_current: 60.0,
        peak_time: Some(2.0),
        ..Amplifier::default()
    }
}

fn checks(motor: &Motor, amplifier: Option<&Amplifier>, site: &Site) -> Vec<Check> {
    let cycle = cycle();
    let prepared = MotorLimits::new(motor, amplifier, site);
    let drive = Drive {
        motor,
        gearbox: None,
        amplifier,
    };
    Context::new(&cycle, site, drive, &prepared).checks(&RuleSet::default())
}

fn check(checks: &[Check], rule: Rule) -> &Check {
    let found = checks.iter().find(|check| check.id == rule);
    found.unwrap_or_else(|| panic!("no {rule:?} in {checks:?}"))
}

fn winding(motor: &Motor, site: &Site) -> Check {
    check(&checks(motor, None, site), Rule::WindingTemperature).clone()
}

/// RMS of current (A) and friction loss (W) by plain sums over the cycle.
fn sums(motor: &Motor) -> (f64, f64) {
    let cycle = cycle();
    let (mut squares, mut friction) = (0.0, 0.0);
    let [coulomb, viscous] = motor.friction;
    let drive = direct(motor);
    for sample in cycle.samples() {
        let current = drive.coefficients().torque(&sample.loads()) / 2.0;
        let speed = sample.speed().abs();
        squares += sample.weight * current * current;
        friction += sample.weight * (coulomb + viscous * speed) * speed;
    }
    (
        (squares / cycle.duration()).sqrt(),
        friction / cycle.duration(),
    )
}

/// The cycle lasts 0.5 s: the hottest point of bodies with 40 s and 2400 s is close above the rise of the mean losses, which has a closed form.
#[test]
fn every_model_that_data_allow() {
    let (site, full) = (Site::default(), motor());
    let (rms, friction) = sums(&full);
    let growth = COPPER / (1.0 + COPPER * 20.0);
    let copper = 1.5 * 0.6 * (1.0 + COPPER * 20.0) * rms * rms;
    let mean = (0.5 * copper + 0.35 * friction) / (1.0 - growth * 0.5 * copper);
    let two = winding(&full, &site);
    let value = two.value.unwrap();
    assert!(
        value > mean && value < 1.02 * mean,
        "{value}, mean losses {mean}"
    );
    near("limit", two.limit.unwrap(), 115.0, budget::THERMAL);
    assert!(
        note(&two).contains("duty type S5") && note(&two).contains("40 °C"),
        "{}",
        note(&two)
    );
    // Thin air is reported where it has an effect, above 1000 m.
    for (altitude, thin) in [(1000.0, false), (1001.0, true)] {
        let mut high = site.clone();
        high.surroundings.altitude = altitude;
        let note = note(&winding(&full, &high));
        assert_eq!(note.contains("less 1 % per 100 m"), thin, "{note}");
    }

    let mut steady = full.clone();
    steady.thermal.winding_time = None;
    steady.thermal.housing_time = None;
    let found = winding(&steady, &site);
    near("mean losses", found.value.unwrap(), mean, budget::SIMPSON);
    assert!(
        note(&found).contains("temperature ripple ignored"),
        "{}",
        note(&found)
    );

    let mut slow = full.clone();
    slow.thermal.housing_time = None;
    let found = winding(&slow, &site).value.unwrap();
    near("housing at rest", found, value, budget::SLOW_HOUSING);
    let mut whole = full.clone();
    whole.thermal.winding_time = None;
    let found = winding(&whole, &site).value.unwrap();
    let one = 0.5 * (copper + friction) / (1.0 - growth * 0.5 * copper);
    near("one body", found, one, budget::SLOW_HOUSING);

    let fixed = Site {
        surroundings: jred_file::model::surroundings::Surroundings {
            resistance_at: Some(120.0),
            ..site.surroundings
        },
        ..site.clone()
    };
    let found = winding(&steady, &fixed).value.unwrap();
    let expected = 0.5 * 1.5 * 0.6 * (1.0 + COPPER * 100.0) * rms * rms + 0.35 * friction;
    near("resistance at 120 °C", found, expected, budget::SIMPSON);

    let mut bare = full.clone();
    bare.winding = Winding::default();
    bare.thermal = Thermal::default();
    let found = winding(&bare, &site);
    assert_eq!((found.unit, found.limit), ("%", Some(100.0)));
    assert!(
        note(&found).starts_with("100 % of the rise at the S1 torque"),
        "{}",
        note(&found)
    );
    assert!(
        note(&found).contains("estimated from the RMS torque"),
        "{}",
        note(&found)
    );
    // Every loss is at least that of the torque, and less than with friction at the largest speed.
    let least = (rms * 2.0 / 50.0).powi(2);
    let value = 0.01 * found.value.unwrap();
    assert!(
        value > least && value < least + 1.0 - 0.8f64.powi(2),
        "{value} {least}"
    );
}

/// The heat of both losses passes through the housing; the copper losses are those at the winding's temperature.
#[test]
fn the_housing_keeps_its_limit_where_it_is_known() {
    let at_most = |housing| {
        let mut site = Site::default();
        site.surroundings.housing = housing;
        site
    };
    let housing = |motor: &Motor, site: &Site| {
        let checks = checks(motor, None, site);
        let found = checks.iter().find(|c| c.id == Rule::HousingTemperature);
        found.cloned()
    };
    let mut steady = motor();
    steady.thermal.winding_time = None;
    steady.thermal.housing_time = None;
    let (rms, friction) = sums(&steady);
    let copper = 1.5 * 0.6 * (1.0 + COPPER * 20.0) * rms * rms;
    let growth = COPPER / (1.0 + COPPER * 20.0);
    let rise = winding(&steady, &Site::default()).value.unwrap();
    let expected = 0.35 * (copper * (1.0 + growth * rise) + friction);

    let found = housing(&steady, &at_most(Some(70.0))).unwrap();
    near("rise", found.value.unwrap(), expected, budget::SIMPSON);
    near("limit", found.limit.unwrap(), 30.0, budget::THERMAL);
    for (margin, verdict) in [(1.01, RuleVerdict::Pass), (0.99, RuleVerdict::Fail)] {
        let found = housing(&steady, &at_most(Some(40.0 + margin * expected)));
        assert_eq!(found.unwrap().verdict, verdict);
    }
    // Bodies with time constants: the mean, except for a ripple.
    let found = housing(&motor(), &at_most(Some(70.0))).unwrap();
    let ripple = found.value.unwrap() / expected - 1.0;
    assert!(ripple.abs() < 0.01, "{ripple}");

    assert!(housing(&steady, &at_most(None)).is_none());
    for part in [0, 1] {
        let mut one = steady.clone();
        if part == 0 {
            one.thermal.winding_resistance = None;
        } else {
            one.thermal.housing_resistance = None;
        }
        let found = housing(&one, &at_most(Some(70.0))).unwrap();
        assert_eq!(found.verdict, RuleVerdict::NotChecked);
        assert!(
            note(&found).contains("thermal resistances"),
            "{}",
            note(&found)
        );
    }
}

/// The hottest point of the course on the page is the judged figure.
#[test]
fn the_course_of_the_temperatures_reaches_the_judged_figure() {
    let (motor, site, cycle) = (motor(), Site::default(), cycle());
    let prepared = MotorLimits::new(&motor, None, &site);
    let drive = direct(&motor);
    let course = Context::new(&cycle, &site, drive, &prepared)
        .rises()
        .unwrap();
    assert!(course.is_sorted_by(|a, b| a.0 < b.0));
    let ends = [course[0].0, course[course.len() - 1].0];
    near("end", ends[1], cycle.duration(), budget::THERMAL);
    assert!(ends[0].abs() < budget::THERMAL);
    let hottest = course.iter().map(|(_, rise)| rise[0]).fold(0.0, f64::max);
    let judged = winding(&motor, &site).value.unwrap();
    near("hottest", hottest, judged, budget::SIMPSON);
}

#[test]
fn what_is_missing_is_said() {
    let site = Site::default();
    let mut open = motor();
    open.thermal.max_temperature = None;
    let found = winding(&open, &site);
    assert_eq!(found.verdict, RuleVerdict::NotChecked);
    assert!(
        note(&found).contains("maximum temperature of the winding"),
        "{}",
        note(&found)
    );
    let cold = Site {
        duty: jred_file::model::operation::Duty {
            operation: Operation::Short { operating: 60.0 },
            kind: Some(2),
        },
        ..Site::default()
    };
    let mut steady = motor();
    steady.thermal.winding_time = None;
    steady.thermal.housing_time = None;
    let found = winding(&steady, &cold);
    assert_eq!(found.verdict, RuleVerdict::NotChecked);
    assert!(
        note(&found).contains("thermal time constants"),
        "{}",
        note(&found)
    );
    let short = winding(&motor(), &cold).value.unwrap();
    assert!(short < winding(&motor(), &site).value.unwrap());
    // Currents without an amplifier, a bus without a supply.
    let all = checks(&motor(), None, &site);
    for (rule, word) in [
        (Rule::RmsCurrent, "amplifier"),
        (Rule::BusVoltage, "voltage"),
    ] {
        let found = check(&all, rule);
        assert_eq!(found.verdict, RuleVerdict::NotChecked, "{rule:?}");
        assert!(note(found).contains(word), "{}", note(found));
    }
}

/// Too little cooling, so the copper losses run away.
#[test]
fn runaway_fails() {
    let mut hot = motor();
    hot.thermal.housing_resistance = Some(50.0);
    let found = winding(&hot, &Site::default());
    assert_eq!((found.verdict, found.value), (RuleVerdict::Fail, None));
    assert!(note(&found).contains("thermal runaway"), "{}", note(&found));
}

#[test]
fn currents_follow_the_torque() {
    let (motor, amplifier) = (motor(), amplifier());
    let all = checks(&motor, Some(&amplifier), &Site::default());
    let (rms, _) = sums(&motor);
    near(
        "RMS",
        check(&all, Rule::RmsCurrent).value.unwrap(),
        rms,
        budget::THERMAL,
    );
    let torque = check(&all, Rule::PeakTorque).value.unwrap();
    let peak = check(&all, Rule::PeakCurrent);
    near("peak", peak.value.unwrap(), torque / 2.0, budget::THERMAL);
    near("its limit", peak.limit.unwrap(), 60.0, budget::THERMAL);
    let overload = check(&all, Rule::Overload);
    near(
        "I²t",
        overload.limit.unwrap(),
        (3600.0 - 400.0) * 2.0,
        budget::THERMAL,
    );
    assert!(
        overload.value.unwrap() > 0.0 && overload.verdict == RuleVerdict::Pass,
        "{overload:?}"
    );
    let mut large = amplifier.clone();
    large.rated_current = 55.0;
    let all = checks(&motor, Some(&large), &Site::default());
    assert_eq!(check(&all, Rule::Overload).value, Some(0.0));
}

/// Friction at the motor's own speed, that of the input times the ratio: c·|n| and b·n², and the copper loss of the smaller torque.
#[test]
fn losses_behind_a_gearbox_are_at_the_speed_of_the_motor() {
    let (cycle, site, ratio) = (cycle(), Site::default(), 4.0);
    let mut motor = motor();
    motor.thermal.winding_time = None;
    motor.thermal.housing_time = None;
    let gearbox = Gearbox {
        ratio,
        efficiency: 1.0,
        back_efficiency: 1.0,
        ..Gearbox::default()
    };
    let drive = Drive {
        motor: &motor,
        gearbox: Some(&gearbox),
        amplifier: None,
    };
    let prepared = MotorLimits::new(&motor, None, &site);
    let coefficients = drive.coefficients();
    let load = Load {
        cycle: &cycle,
        coefficients: &coefficients,
        ratio,
        motor: &motor,
        prepared: &prepared,
    };
    let model = Model::of(&motor, &prepared, &site.surroundings, cycle.duration()).unwrap();
    let found = model.mean_losses(&load);
    let [mut copper, mut friction] = [0.0; 2];
    for sample in cycle.samples() {
        let share = sample.weight / cycle.duration();
        let current = coefficients.torque(&sample.loads()) / 2.0;
        let speed = sample.speed().abs() * ratio;
        copper += share * 1.5 * 0.6 * (1.0 + COPPER * 20.0) * current * current;
        friction += share * (0.3 + 0.002 * speed) * speed;
    }
    near("copper", found.copper, copper, budget::SIMPSON);
    near("friction", found.other, friction, budget::SIMPSON);
}

/// The duty type in the machine file is reported if it differs from that of the cycle.
#[test]
fn a_stated_duty_type_is_compared() {
    let stated = |kind| {
        let mut site = Site::default();
        site.duty.kind = kind;
        note(&winding(&motor(), &site))
    };
    assert!(!stated(None).contains("(given"));
    assert!(!stated(Some(5)).contains("(given"), "{}", stated(Some(5)));
    assert!(
        stated(Some(3)).contains("(given: S3)"),
        "{}",
        stated(Some(3))
    );
}

/// A housing without a time constant counts as slow enough to keep its mean rise through hours of work and rest.
#[test]
fn a_housing_of_unknown_time_does_not_follow_the_rests() {
    let site = Site {
        duty: jred_file::model::operation::Duty {
            operation: Operation::Intermittent {
                operating: 3600.0,
                rest: 3600.0,
                holding: false,
            },
            kind: Some(3),
        },
        ..Site::default()
    };
    let with = |time| {
        let mut motor = motor();
        motor.thermal.housing_time = time;
        winding(&motor, &site).value.unwrap()
    };
    near("unknown", with(None), with(Some(1e9)), 1e-3);
    assert!(
        with(Some(2400.0)) > 1.02 * with(None),
        "the case shows nothing"
    );
}
