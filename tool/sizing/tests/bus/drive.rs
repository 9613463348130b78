//! The power of one drive, and the rule for the resistance of its brake resistor.

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_file::model::supply::{BrakeResistor, Supply};
use jred_report::list::rule_words::note;
use jred_sizing::bus;
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Amplifier, Motor, Resistor, Winding};
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::judge::Context;
use jred_sizing::judge::check::Check;
use jred_sizing::motor::envelope::MotorLimits;

use super::{budget, near};
use crate::support::press_text;
use crate::{direct, press_duty};

fn cycle() -> Cycle {
    let file = checked::parse("press.toml", &press_text(), Path::new("")).unwrap();
    Cycle::new(&Duty::new(&file, file.motion.as_ref().unwrap(), 1000).unwrap())
}

/// A motor that drives the press without a gearbox, in field weakening at 30 V.
pub(crate) fn motor() -> Motor {
    Motor {
        key: "m".to_owned(),
        rated_torque: Some(40.0),
        rated_speed: Some(200.0),
        max_speed: Some(400.0),
        peak_torque: Some(400.0),
        rotor_inertia: 0.01,
        winding: Winding {
            torque_constant: Some(2.0),
            resistance: Some(0.6),
            inductance: Some(5e-3),
            pole_pairs: Some(5.0),
            ..Winding::default()
        },
        ..Motor::default()
    }
}

/// P = T·ω + 3/2·R·I² + p₀ + p₁·I, with the field-weakening current in I only while the motor drives.
#[test]
fn field_weakening_is_drawn_and_not_fed_back() {
    let (cycle, motor) = (cycle(), motor());
    let site = Site {
        bus_voltage: Some(30.0),
        ..Site::default()
    };
    let amplifier = Amplifier {
        rated_current: 100.0,
        peak_current: 400.0,
        losses: [20.0, 8.0],
        ..Amplifier::default()
    };
    let prepared = MotorLimits::new(&motor, Some(&amplifier), &site);
    assert!(prepared.circuit.is_some_and(|circuit| circuit.weakens));
    let drive = Drive {
        motor: &motor,
        gearbox: None,
        amplifier: Some(&amplifier),
    };
    let coefficients = drive.coefficients();
    let curve = bus::power(
        &cycle,
        &coefficients,
        1.0,
        &motor,
        &prepared,
        Some(&amplifier),
    );
    let (mut weakened, mut braked) = (0, 0);
    for sample in cycle.samples() {
        let torque = coefficients.torque(&sample.loads());
        let speed = sample.speed();
        let along = torque.abs() / 2.0;
        let total = prepared.current(torque, speed).unwrap();
        let current = if torque * speed < 0.0 { along } else { total };
        let expected = torque * speed + 1.5 * 0.6 * current * current + 20.0 + 8.0 * current;
        let at = |p: &&[f64; 2]| p[0] == sample.t;
        let found = curve.points().iter().find(at).unwrap();
        near("power", found[1], expected, budget::BUS);
        if total > 1.01 * along {
            weakened += usize::from(torque * speed > 0.0);
            braked += usize::from(torque * speed < 0.0);
        }
    }
    assert!(weakened > 50 && braked > 50, "{weakened} {braked}");
}

/// The rule's check with a resistor of 20 Ω.
fn resistance(amplifier: Option<f64>, supply: Option<f64>) -> Check {
    let (cycle, motor) = (cycle(), motor());
    let site = Site {
        bus_voltage: Some(560.0),
        supply: Supply {
            given: true,
            capacitance: Some(1e-6),
            chopper_voltage: Some(780.0),
            max_voltage: Some(820.0),
            min_resistance: supply,
            regenerative: false,
            brake_resistor: Some(BrakeResistor {
                resistance: 20.0,
                power: 1e6,
                peak_power: Some(1e6),
                pulse_energy: Some(1e6),
            }),
        },
        ..Site::default()
    };
    let amplifier = Amplifier {
        rated_current: 100.0,
        peak_current: 400.0,
        min_resistance: amplifier,
        ..Amplifier::default()
    };
    let prepared = MotorLimits::new(&motor, Some(&amplifier), &site);
    let drive = Drive {
        motor: &motor,
        gearbox: None,
        amplifier: Some(&amplifier),
    };
    let rules = RuleSet::default();
    let checks = Context::new(&cycle, &site, drive, &prepared).checks(&rules);
    let power = checks.iter().find(|c| c.id == Rule::ResistorPower).unwrap();
    assert!(
        power.value.unwrap() > 0.0,
        "the resistor comes on: {power:?}"
    );
    let mut checks = checks.into_iter();
    checks.find(|c| c.id == Rule::BrakeResistance).unwrap()
}

#[test]
fn a_resistor_too_small_for_the_amplifier() {
    let low = resistance(Some(30.0), None);
    assert_eq!(
        (low.verdict, low.value, low.limit, low.unit),
        (RuleVerdict::Fail, Some(20.0), Some(30.0), "Ohm")
    );
    assert!(
        note(&low).contains("minimum resistance of the chopper"),
        "{}",
        note(&low)
    );
    assert_eq!(resistance(Some(20.0), None).verdict, RuleVerdict::Pass);
    // The machine file takes precedence.
    assert_eq!(
        resistance(Some(30.0), Some(15.0)).verdict,
        RuleVerdict::Pass
    );
    let unknown = resistance(None, None);
    assert_eq!(unknown.verdict, RuleVerdict::NotChecked);
    assert!(note(&unknown).contains("no data"), "{}", note(&unknown));
}

/// The findings of a resistor of 1 MW at this chopper voltage, with these of its other ratings.
fn unrated(chopper: f64, peak_power: Option<f64>, pulse_energy: Option<f64>) -> [Option<bool>; 3] {
    let (cycle, motor) = (cycle(), motor());
    let site = Site {
        bus_voltage: Some(560.0),
        supply: Supply {
            given: true,
            capacitance: Some(1e-6),
            chopper_voltage: Some(chopper),
            max_voltage: Some(1e6),
            min_resistance: None,
            regenerative: false,
            brake_resistor: Some(BrakeResistor {
                resistance: 20.0,
                power: 1e6,
                peak_power,
                pulse_energy,
            }),
        },
        ..Site::default()
    };
    let prepared = MotorLimits::new(&motor, None, &site);
    let drive = direct(&motor);
    let findings = Context::new(&cycle, &site, drive, &prepared).findings(&RuleSet::default());
    [
        Rule::ResistorPeak,
        Rule::ResistorPulse,
        Rule::BrakeResistance,
    ]
    .map(|rule| findings.get(rule).map(|finding| finding.is_known()))
}

/// A resistor that switches on needs each of its ratings; one that never does is judged only by those given.
#[test]
fn ratings_of_a_resistor_are_asked_for_where_it_comes_on() {
    let (on, off) = (570.0, 9e5);
    let known = Some(1e6);
    assert_eq!(unrated(on, None, None), [Some(false); 3]);
    assert_eq!(
        unrated(on, known, None),
        [Some(true), Some(false), Some(false)]
    );
    assert_eq!(
        unrated(on, None, known),
        [Some(false), Some(true), Some(false)]
    );
    assert_eq!(unrated(off, None, None), [None; 3]);
    assert_eq!(unrated(off, known, None), [Some(true), None, None]);
    assert_eq!(unrated(off, None, known), [None, Some(true), None]);
}

/// The energy regenerated in a cycle is reported with the voltage, as the integral of the power.
#[test]
fn the_energy_that_comes_back_is_said() {
    let (cycle, motor) = (cycle(), motor());
    let site = Site {
        bus_voltage: Some(560.0),
        supply: Supply {
            given: true,
            capacitance: Some(1e-3),
            max_voltage: Some(900.0),
            ..Supply::default()
        },
        ..Site::default()
    };
    let prepared = MotorLimits::new(&motor, None, &site);
    let drive = direct(&motor);
    let checks = Context::new(&cycle, &site, drive, &prepared).checks(&RuleSet::default());
    let check = checks.iter().find(|c| c.id == Rule::BusVoltage).unwrap();
    let [_, back] =
        bus::power(&cycle, &drive.coefficients(), 1.0, &motor, &prepared, None).energies();
    let words = note(check);
    let (before, _) = words.split_once(" J are fed back per cycle").expect(&words);
    let number: f64 = before.rsplit(['"', ' ']).next().unwrap().parse().unwrap();
    near("energy", number, back, 1e-3);
}

/// The course on the page repeats after a cycle and reaches the judged voltage; it exists only with data of the bus.
#[test]
fn the_course_of_the_voltage_reaches_the_judged_figure() {
    let (cycle, motor) = (cycle(), motor());
    let mut site = Site {
        bus_voltage: Some(560.0),
        supply: Supply {
            given: true,
            capacitance: Some(1e-3),
            max_voltage: Some(900.0),
            ..Supply::default()
        },
        ..Site::default()
    };
    let prepared = MotorLimits::new(&motor, None, &site);
    let drive = direct(&motor);
    let context = Context::new(&cycle, &site, drive, &prepared);
    let course = context.bus_voltage();
    let findings = context.findings(&RuleSet::default());
    let judged = findings.get(Rule::BusVoltage).unwrap().value;
    let highest = course.iter().map(|point| point[1]).fold(0.0, f64::max);
    near("highest", highest, judged, 1e-9);
    assert!(judged > 561.0, "nothing comes back: {judged} V");
    assert!(course.is_sorted_by(|a, b| a[0] <= b[0]));
    let [first, last] = [course[0], course[course.len() - 1]];
    near("its length", last[0] - first[0], cycle.duration(), 1e-9);
    near("it repeats", last[1], first[1], 1e-9);
    site.bus_voltage = None;
    let prepared = MotorLimits::new(&motor, None, &site);
    let context = Context::new(&cycle, &site, drive, &prepared);
    assert!(context.bus_voltage().is_empty());
}

/// A motor that turns without torque in field weakening draws the loss of the weakening current.
#[test]
fn idling_in_the_weakened_field_is_not_free() {
    let mut duty = press_duty(100);
    for instant in &mut duty.instants {
        (
            instant.input_speed,
            instant.input_alpha,
            instant.input_torque,
        ) = (60.0, 0.0, 0.0);
    }
    let (cycle, motor) = (Cycle::new(&duty), motor());
    let site = Site {
        bus_voltage: Some(30.0),
        ..Site::default()
    };
    let amplifier = Amplifier {
        rated_current: 100.0,
        peak_current: 400.0,
        ..Amplifier::default()
    };
    let prepared = MotorLimits::new(&motor, Some(&amplifier), &site);
    let coefficients = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
    let current = prepared.current(0.0, 60.0).unwrap();
    assert!(current > 1.0, "{current} A weaken the field");
    let curve = bus::power(&cycle, &coefficients, 1.0, &motor, &prepared, None);
    for [_, power] in curve.points() {
        near("power", *power, 1.5 * 0.6 * current * current, budget::BUS);
    }
}

/// The resistor's mean power is its energy of a cycle over the cycle time.
#[test]
fn the_mean_power_of_a_resistor_is_its_energy_over_the_cycle() {
    let (cycle, motor) = (cycle(), motor());
    let resistor = BrakeResistor {
        resistance: 20.0,
        power: 1e6,
        peak_power: Some(1e6),
        pulse_energy: Some(1e6),
    };
    let site = Site {
        bus_voltage: Some(560.0),
        supply: Supply {
            given: true,
            capacitance: Some(1e-6),
            chopper_voltage: Some(570.0),
            max_voltage: Some(1e6),
            min_resistance: Some(1.0),
            regenerative: false,
            brake_resistor: Some(resistor),
        },
        ..Site::default()
    };
    let prepared = MotorLimits::new(&motor, None, &site);
    let drive = direct(&motor);
    let findings = Context::new(&cycle, &site, drive, &prepared).findings(&RuleSet::default());
    let figure = |rule| findings.get(rule).unwrap().value;
    let curve = bus::power(&cycle, &drive.coefficients(), 1.0, &motor, &prepared, None);
    let [_, back] = curve.energies();
    // The regenerated energy minus the capacitor's share, in each of a few stretches of braking.
    let kept = 0.5 * 1e-6 * (570.0f64.powi(2) - 560.0f64.powi(2));
    let burnt = figure(Rule::ResistorPower) * cycle.duration();
    assert!(back > 100.0 * kept, "{back} J come back");
    assert!(
        burnt < back && burnt > back - 20.0 * kept,
        "{burnt} J of {back} J"
    );
    assert!(figure(Rule::ResistorPulse) <= burnt * (1.0 + 1e-12));
}

/// Checks of the press on an amplifier with an internal resistor of this power (W), with a catalogue of one resistor.
fn internal(power: f64, resistors: &[Resistor]) -> (Vec<Check>, Option<String>) {
    let (cycle, motor) = (cycle(), motor());
    let site = Site {
        bus_voltage: Some(560.0),
        supply: Supply {
            given: true,
            capacitance: None,
            chopper_voltage: Some(780.0),
            max_voltage: Some(820.0),
            min_resistance: Some(25.0),
            regenerative: false,
            brake_resistor: None,
        },
        ..Site::default()
    };
    let amplifier = Amplifier {
        key: "a-7".to_owned(),
        rated_current: 100.0,
        peak_current: 400.0,
        absorbable_energy: Some(0.5),
        internal_resistor: Some(BrakeResistor {
            resistance: 40.0,
            power,
            peak_power: None,
            pulse_energy: None,
        }),
        ..Amplifier::default()
    };
    let prepared = MotorLimits::new(&motor, Some(&amplifier), &site);
    let drive = Drive {
        motor: &motor,
        gearbox: None,
        amplifier: Some(&amplifier),
    };
    let context = Context::new(&cycle, &site, drive, &prepared).with_resistors(resistors);
    let chosen = context.resistor().map(|resistor| resistor.key.clone());
    (context.checks(&RuleSet::default()), chosen)
}

/// The resistor of the amplifier comes first; where its power is not sufficient, one of the catalogue that is made for the amplifier replaces it.
#[test]
fn the_internal_resistor_comes_first() {
    let external = |fits: &str| Resistor {
        key: "r".to_owned(),
        resistance: 30.0,
        rated_power: 1e5,
        peak_power: Some(1e6),
        pulse_energy: Some(1e6),
        fits: fits.to_owned(),
        ..Resistor::default()
    };
    let find = |checks: &[Check], rule| checks.iter().find(|c| c.id == rule).cloned();
    let (checks, chosen) = internal(1e5, &[external("")]);
    assert_eq!(chosen, None);
    let power = find(&checks, Rule::ResistorPower).unwrap();
    assert!(
        power.value.unwrap() > 0.0 && power.limit == Some(1e5),
        "{power:?}"
    );
    assert!(find(&checks, Rule::BrakeResistance).is_none());
    assert!(find(&checks, Rule::ResistorPeak).is_none());
    let mean = power.value.unwrap();
    for (fits, expected) in [("", Some("r")), ("a-*", Some("r")), ("b-1; b-2", None)] {
        let (checks, chosen) = internal(0.9 * mean, &[external(fits)]);
        assert_eq!(chosen.as_deref(), expected, "{fits}");
        let voltage = find(&checks, Rule::BusVoltage).unwrap();
        assert_eq!(
            voltage.verdict == RuleVerdict::Pass,
            expected.is_some(),
            "{voltage:?}"
        );
    }
}

/// The absorbable energy lifts the bus from the supply voltage exactly to the voltage of the chopper.
#[test]
fn absorbable_energy_is_a_capacitance() {
    let amplifier = Amplifier {
        absorbable_energy: Some(12.0),
        chopper_voltage: Some(390.0),
        ..Amplifier::default()
    };
    let capacitance = amplifier.bus_capacitance(Some(320.0)).unwrap();
    let stored = 0.5 * capacitance * (390.0f64.powi(2) - 320.0f64.powi(2));
    near("energy", stored, 12.0, budget::BUS);
    assert_eq!(amplifier.bus_capacitance(None), None);
    assert_eq!(amplifier.bus_capacitance(Some(400.0)), None);
}
