//! Motor and amplifier against the voltage of the supply: limits by hand, from √2·U and the 10 % of IEC 60038.

use std::f64::consts::SQRT_2;

use super::{Context, Finding, Rule, RuleSet, Stand, budget, near, press_text, read};
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_report::list::rule_words::{self, note};
use jred_sizing::bus::supply::BusData;
use jred_sizing::catalogue::{Amplifier, Basis, Catalogue, Drive, Motor};
use jred_sizing::motor::envelope::{Envelope, MotorLimits};
use jred_sizing::select::rank::{Objective, rank};
use jred_sizing::select::size::{Certainty, Selection};

fn motor(mains: Option<f64>, figures: Option<f64>, largest: Option<f64>) -> Motor {
    Motor {
        mains_voltage: mains,
        bus_voltage: figures,
        max_bus_voltage: largest,
        ..Motor::default()
    }
}

fn amplifier(mains: f64) -> Amplifier {
    Amplifier {
        key: "a".to_owned(),
        rated_current: 10.0,
        peak_current: 30.0,
        mains_voltage: Some(mains),
        ..Amplifier::default()
    }
}

/// The highest mains of each class with tolerance, rectified; a voltage outside all classes counts as its own.
#[test]
fn the_largest_voltage_of_every_class() {
    for (mains, highest) in [
        (100.0, 127.0),
        (115.0, 127.0),
        (200.0, 240.0),
        (230.0, 240.0),
        (240.0, 240.0),
        (277.0, 277.0),
        (380.0, 480.0),
        (400.0, 480.0),
        (480.0, 480.0),
        (500.0, 500.0),
        (690.0, 690.0),
    ] {
        let made = motor(Some(mains), None, None).made_for().unwrap();
        near(
            &format!("{mains} V"),
            made.largest,
            1.1 * SQRT_2 * highest,
            budget::CLOSED_FORM,
        );
        assert_eq!(made.basis, Basis::Mains([mains, highest]));
        let amplified = amplifier(mains).made_for().unwrap();
        assert_eq!(amplified, made);
    }
    // The voltage of the figures: extra-low voltage up to 60 V, then the class of the mains.
    for (bus, largest) in [
        (12.0, 60.0),
        (48.0, 60.0),
        (60.0, 60.0),
        (72.0, 1.1 * 72.0),
        (282.0, 1.1 * SQRT_2 * 240.0),
        (325.0, 1.1 * SQRT_2 * 240.0),
        (540.0, 1.1 * SQRT_2 * 480.0),
        (600.0, 1.1 * SQRT_2 * 480.0),
        (750.0, 1.1 * 750.0),
    ] {
        let made = motor(None, Some(bus), None).made_for().unwrap();
        near(
            &format!("{bus} V DC"),
            made.largest,
            largest,
            budget::CLOSED_FORM,
        );
    }
    // The insulation's voltage comes first, then the mains; without data nothing is known.
    let stated = motor(Some(230.0), Some(320.0), Some(800.0))
        .made_for()
        .unwrap();
    assert_eq!((stated.largest, stated.basis), (800.0, Basis::Stated));
    let mains = motor(Some(400.0), Some(320.0), None).made_for().unwrap();
    assert_eq!(mains.basis, Basis::Mains([400.0, 480.0]));
    assert_eq!(motor(None, None, None).made_for(), None);
    assert_eq!(Amplifier::default().made_for(), None);
    let trip = Amplifier {
        max_voltage: Some(410.0),
        ..Amplifier::default()
    };
    assert_eq!(trip.made_for().unwrap().largest, 410.0);
}

fn press_at(supply: &str) -> Stand {
    Stand::new(&format!("{}\n[supply]\n{supply}\n", press_text()))
}

#[test]
fn a_motor_for_another_voltage_is_refused() {
    let verdict = |stand: &Stand| {
        stand
            .check(true, &stand.file.rules, Rule::MotorVoltage)
            .verdict
    };
    for (mains, class, expected) in [
        (400.0, 200.0, RuleVerdict::Fail),
        (277.0, 200.0, RuleVerdict::Fail),
        (240.0, 200.0, RuleVerdict::Pass),
        (230.0, 200.0, RuleVerdict::Pass),
        (200.0, 400.0, RuleVerdict::Pass),
        (480.0, 400.0, RuleVerdict::Pass),
        (500.0, 400.0, RuleVerdict::Fail),
        (200.0, 100.0, RuleVerdict::Fail),
    ] {
        let mut stand = press_at(&format!("mains_voltage = \"{mains} V\""));
        stand.motor.mains_voltage = Some(class);
        assert_eq!(
            verdict(&stand),
            expected,
            "{class} V class on {mains} V mains"
        );
        let found = stand.found(true, Rule::MotorVoltage);
        near(
            "figure",
            found.value,
            1.1 * SQRT_2 * mains,
            budget::CLOSED_FORM,
        );
    }
    // Figures at 48 V, on 400 V mains and on 60 V.
    let mut stand = press_at("mains_voltage = \"400 V\"");
    stand.motor.bus_voltage = Some(48.0);
    assert_eq!(verdict(&stand), RuleVerdict::Fail);
    assert_eq!(stand.found(true, Rule::MotorVoltage).rating, 60.0);
    let mut low = press_at("bus_voltage = \"60 V\"");
    low.motor.bus_voltage = Some(48.0);
    assert_eq!(verdict(&low), RuleVerdict::Pass);
    // A bus voltage is used as given, without the tolerance of mains.
    let mut bus = press_at("bus_voltage = \"650 V\"");
    bus.motor.max_bus_voltage = Some(650.0);
    assert_eq!(verdict(&bus), RuleVerdict::Pass);
    bus.motor.max_bus_voltage = Some(649.0);
    assert_eq!(verdict(&bus), RuleVerdict::Fail);
}

#[test]
fn what_is_said_about_it() {
    let mut stand = press_at("mains_voltage = \"400 V\"");
    stand.motor.mains_voltage = Some(200.0);
    let sentence = |stand: &Stand| {
        rule_words::sentence(&stand.check(true, &stand.file.rules, Rule::MotorVoltage))
    };
    let said = sentence(&stand);
    for words in [
        "motor voltage 622.3 V, limit 373.4 V",
        "\"m\" is not made for that",
        "400 V mains",
        "transformer",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    stand.motor.mains_voltage = None;
    let check = stand.check(true, &stand.file.rules, Rule::MotorVoltage);
    assert_eq!(check.verdict, RuleVerdict::NotChecked);
    assert!(
        note(&check).contains("neither mains_voltage nor max_bus_voltage"),
        "{}",
        note(&check)
    );
    let mut nowhere = Stand::press();
    nowhere.motor.mains_voltage = Some(200.0);
    let check = nowhere.check(true, &nowhere.file.rules, Rule::MotorVoltage);
    assert_eq!(check.verdict, RuleVerdict::NotChecked);
    assert!(note(&check).contains("[supply]"), "{}", note(&check));
}

/// The limit is a share like those of other rules.
#[test]
fn a_rule_set_changes_the_limit() {
    let mut stand = press_at("mains_voltage = \"400 V\"\n[rules]\nmotor_voltage = \"170 %\"");
    stand.motor.mains_voltage = Some(200.0);
    let verdict = |stand: &Stand| {
        stand
            .check(true, &stand.file.rules, Rule::MotorVoltage)
            .verdict
    };
    // 400/240 = 1.667.
    assert_eq!(verdict(&stand), RuleVerdict::Pass);
    stand.file = read(&format!(
        "{}\n[rules]\nmotor_voltage = \"off\"\n",
        press_text()
    ));
    assert_eq!(verdict(&stand), RuleVerdict::Off);
}

fn findings(stand: &Stand, amplifier: &Amplifier) -> [Option<Finding>; 2] {
    let drive = Drive {
        amplifier: Some(amplifier),
        ..stand.drive(true)
    };
    let site = &stand.file.site;
    let prepared = MotorLimits::new(&stand.motor, None, site);
    let prepared = prepared.with(&stand.motor, std::iter::once(amplifier), site);
    let context = Context::new(&stand.cycle, site, drive, &prepared);
    let found = context.findings(&stand.file.rules);
    [Rule::MotorVoltage, Rule::AmplifierVoltage].map(|rule| found.get(rule))
}

#[test]
fn an_amplifier_for_another_voltage_is_refused() {
    let rules = RuleSet::default();
    let mut stand = press_at("mains_voltage = \"400 V\"");
    stand.motor.mains_voltage = Some(400.0);
    for (mains, expected) in [
        (230.0, RuleVerdict::Fail),
        (400.0, RuleVerdict::Pass),
        (480.0, RuleVerdict::Pass),
    ] {
        let [motor, found] = findings(&stand, &amplifier(mains));
        assert_eq!(
            rules.verdict(Rule::AmplifierVoltage, found.unwrap()),
            expected,
            "{mains}"
        );
        assert_eq!(
            rules.verdict(Rule::MotorVoltage, motor.unwrap()),
            RuleVerdict::Pass
        );
    }
    // Without a supply the motor is judged at that of the amplifier, and the amplifier is not checked.
    let mut stand = Stand::press();
    stand.motor.mains_voltage = Some(200.0);
    let [motor, found] = findings(&stand, &amplifier(400.0));
    near(
        "supply",
        motor.unwrap().value,
        1.1 * SQRT_2 * 400.0,
        budget::CLOSED_FORM,
    );
    assert_eq!(
        rules.verdict(Rule::MotorVoltage, motor.unwrap()),
        RuleVerdict::Fail
    );
    assert_eq!(
        rules.verdict(Rule::AmplifierVoltage, found.unwrap()),
        RuleVerdict::NotChecked
    );
    assert!(
        stand
            .finding(true, &rules, Rule::AmplifierVoltage)
            .is_none()
    );
}

/// Larger motors that are certain come before smaller ones that are not, in any ranking.
#[test]
fn what_is_in_doubt_ranks_last() {
    let stand = press_at("mains_voltage = \"400 V\"");
    let of = |key: &str, torque: f64, mains: Option<f64>, from_maker: bool| Motor {
        key: key.to_owned(),
        rated_torque: Some(torque * 8.0),
        peak_torque: Some(torque * 30.0),
        standstill_torque: Some(torque * 9.0),
        mass: Some(torque),
        mains_voltage: mains,
        from_maker,
        ..stand.motor.clone()
    };
    let mut catalogue = Catalogue {
        motors: vec![
            of("unknown-other", 1.0, None, false),
            of("unknown", 1.1, None, true),
            of("other", 1.2, Some(400.0), false),
            of("sure", 1.3, Some(400.0), true),
            of("wrong", 1.0, Some(200.0), true),
        ],
        gearboxes: vec![stand.gearbox.clone()],
        ..Catalogue::default()
    };
    catalogue.gearboxes[0].peak_torque = Some(1e3);
    let motors = catalogue.prepare(&stand.file.site);
    let rules = RuleSet::default();
    let mut selection = Selection::new(&catalogue, &motors, &stand.cycle, &stand.file.site, &rules);
    let keys = |selection: &Selection| {
        let known = selection
            .fit
            .known()
            .iter()
            .filter(|c| c.drive.gearbox.is_some());
        known.map(|c| c.drive.motor.key.clone()).collect::<Vec<_>>()
    };
    // Uncertain drives are listed with their figures: of unknown voltages the smaller comes first.
    let expected = ["sure", "other", "unknown-other", "unknown"];
    assert_eq!(keys(&selection), expected);
    for objective in [Objective::Mass, Objective::Power, Objective::Energy] {
        rank(&mut selection, objective);
        assert_eq!(keys(&selection), expected, "{objective:?}");
    }
    let classes = selection.classes();
    let classes: Vec<_> = classes
        .iter()
        .map(|class| {
            let first = class.first.drive.motor.key.as_str();
            (class.certainty, class.count, class.rank, first)
        })
        .collect();
    assert_eq!(
        classes,
        [
            (Certainty::MakersIncomplete, 1, 1, "sure"),
            (Certainty::OthersIncomplete, 1, 2, "other"),
            (Certainty::Voltage, 2, 3, "unknown-other")
        ]
    );
    let ranking = selection.ranking(stand.motor.kind.vocabulary());
    let said = [
        "makers' own figures first",
        "figures from others",
        "unknown voltage",
    ];
    let said = said.map(|words| ranking.find(words).unwrap());
    assert!(said.is_sorted(), "{ranking}");
    let refused = selection.refused.known().iter();
    assert!(refused.clone().any(|c| c.drive.motor.key == "wrong"));
    assert!(
        refused
            .clone()
            .all(|c| c.drive.gearbox.is_none() || c.drive.motor.key == "wrong")
    );
}

/// The insulation's voltage also limits the bus over the cycle: the chopper may switch on above it.
#[test]
fn the_bus_keeps_within_the_insulation() {
    let stand =
        press_at("mains_voltage = \"400 V\"\nchopper_voltage = \"780 V\"\nmax_voltage = \"820 V\"");
    let Site {
        supply,
        bus_voltage,
        ..
    } = &stand.file.site;
    let highest = |largest| {
        let motor = motor(Some(400.0), None, largest);
        BusData::new(supply, *bus_voltage, None, &motor).max_voltage
    };
    assert_eq!(
        [None, Some(750.0), Some(900.0)].map(highest),
        [Some(820.0), Some(750.0), Some(820.0)]
    );
}

/// Figures at given mains are figures after their rectifier: converted to the actual bus like those at a given bus voltage.
#[test]
fn figures_at_mains_are_converted() {
    let mut by_bus = Stand::press().motor;
    by_bus.bus_voltage = Some(400.0 * SQRT_2);
    let by_mains = Motor {
        bus_voltage: None,
        mains_voltage: Some(400.0),
        ..by_bus.clone()
    };
    for volts in [450.0, 400.0 * SQRT_2, 650.0] {
        let site = Site {
            bus_voltage: Some(volts),
            ..Site::default()
        };
        let [a, b] = [&by_bus, &by_mains].map(|motor| Envelope::at(motor, None, &site));
        assert_eq!(a, b, "{volts}");
        let expected = by_bus.max_speed.unwrap() * (volts / (400.0 * SQRT_2)).min(1.0);
        near(
            "largest speed",
            a.max_speed(),
            expected,
            budget::CLOSED_FORM,
        );
    }
    // An amplifier's mains give its bus voltage if the machine file has none.
    let on = Envelope::at(&by_mains, Some(&amplifier(320.0)), &Site::default());
    near(
        "on an amplifier",
        on.max_speed(),
        by_mains.max_speed.unwrap() * 0.8,
        budget::CLOSED_FORM,
    );
}

/// A motor not made for the supply is named with its voltage before any request for data, then the amplifier; a suitable one, or one without data, is
/// not named.
#[test]
fn a_part_unfit_for_the_supply_is_named() {
    let unfit = |mains: Option<f64>, motor_class: Option<f64>, amplifier_class: Option<f64>| {
        let site = Site {
            mains_voltage: mains,
            ..Site::default()
        };
        let motor = motor(motor_class, None, None);
        let amplifier = amplifier_class.map(amplifier);
        let rules = RuleSet::default();
        MotorLimits::new(&motor, amplifier.as_ref(), &site).unfit(&rules)
    };
    let [low, high] = [Some(200.0), Some(400.0)];
    let said = |found: Option<String>, part: &str| {
        let words = found.unwrap();
        let begin = format!(
            "the {part} is not made for this supply: up to 622.3 V on the bus, 373.4 V allowed"
        );
        assert!(words.starts_with(&begin), "{words}");
    };
    said(unfit(high, low, None), "motor");
    said(unfit(high, low, low), "motor");
    said(unfit(high, high, low), "amplifier");
    said(unfit(high, None, low), "amplifier");
    assert_eq!(unfit(high, high, high), None);
    assert_eq!(unfit(low, high, high), None);
    assert_eq!(unfit(high, None, None), None);
    assert_eq!(unfit(None, low, None), None);
}

/// Without a supply in the machine file that of the amplifier is used: its mains, otherwise its bus voltage.
#[test]
fn the_supply_of_an_amplifier_is_said() {
    let mut stand = Stand::press();
    stand.motor.max_bus_voltage = Some(900.0);
    let note = |amplifier: &Amplifier| {
        let prepared = MotorLimits::new(&stand.motor, Some(amplifier), &stand.file.site);
        let drive = Drive {
            amplifier: Some(amplifier),
            ..stand.drive(true)
        };
        let context = Context::new(&stand.cycle, &stand.file.site, drive, &prepared);
        let checks = context.checks(&RuleSet::default());
        let check = checks.iter().find(|c| c.id == Rule::MotorVoltage).unwrap();
        note(check)
    };
    let mains = note(&amplifier(400.0));
    assert!(
        mains.contains("400 V mains + 10 %, rectified, of the amplifier"),
        "{mains}"
    );
    let mut bus = amplifier(400.0);
    (bus.mains_voltage, bus.bus_voltage) = (None, Some(560.0));
    let bus = note(&bus);
    assert!(bus.contains("bus voltage of the amplifier, 560 V"), "{bus}");
}
