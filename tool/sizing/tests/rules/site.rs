//! Temperature and altitude: S1 torque and currents by formulas of the makers, and their ranges.

use jred_file::model::rule::Rule;
use jred_file::model::rules::{RuleSet, RuleVerdict};
use jred_file::model::surroundings::Surroundings;
use jred_report::list::rule_words::note;
use jred_sizing::catalogue::{Amplifier, Derating, Motor, Thermal};

use super::{Stand, edited, near, press_text};

fn at(ambient: f64, altitude: f64) -> Surroundings {
    Surroundings {
        ambient,
        altitude,
        ..Surroundings::default()
    }
}

fn motor(limit: Option<f64>) -> Motor {
    Motor {
        thermal: Thermal {
            max_temperature: limit,
            ..Thermal::default()
        },
        ..Motor::default()
    }
}

/// The examples of Machine Design (a rise of 100 K at 40 °C, used at 65 °C: 13 % less) and of Kollmorgen (55 °C), Siemens' table over the altitude,
/// and 1 % per kelvin without a known winding temperature.
#[test]
fn the_s1_torque_falls_as_makers_say() {
    let factor = |limit, ambient, altitude| motor(limit).derated(&at(ambient, altitude)).factor;
    near(
        "65 °C",
        factor(Some(140.0), 65.0, 0.0),
        0.75f64.sqrt(),
        1e-12,
    );
    near("65 °C, 13 %", factor(Some(140.0), 65.0, 0.0), 0.87, 0.005);
    near(
        "55 °C",
        factor(Some(140.0), 55.0, 0.0),
        0.85f64.sqrt(),
        1e-12,
    );
    near("practice", factor(None, 55.0, 0.0), 0.85, 1e-12);
    for (altitude, expected) in [(2000.0, 0.95), (3000.0, 0.89), (4000.0, 0.84)] {
        near("altitude", factor(None, 40.0, altitude), expected, 0.005);
    }
    // Cool air compensates for thin air: 90 % of (140 − 30)/(140 − 40) is 99 %.
    near(
        "cool",
        factor(Some(140.0), 30.0, 2000.0),
        0.99f64.sqrt(),
        1e-12,
    );
    for (ambient, altitude) in [(40.0, 0.0), (20.0, 1000.0), (-10.0, -100.0)] {
        near(
            "as in the data sheet",
            factor(Some(140.0), ambient, altitude),
            1.0,
            0.0,
        );
    }
    near(
        "hotter than the winding",
        factor(Some(100.0), 120.0, 0.0),
        0.0,
        0.0,
    );
    let mut of_maker = motor(Some(140.0));
    of_maker.derating.temperature = vec![[40.0, 1.0], [50.0, 0.9], [55.0, 0.7]];
    let derated = of_maker.derated(&at(52.5, 2000.0));
    near("maker", derated.factor, 0.8 * 0.9f64.sqrt(), 1e-12);
    near("end", derated.hottest, 55.0, 0.0);
}

/// The amplifier is in its cabinet: 2.5 % per kelvin and 1 % per 100 m, or the maker's points.
#[test]
fn currents_fall_with_the_temperature_of_the_cabinet() {
    let mut amplifier = Amplifier {
        rated_current: 8.0,
        peak_current: 24.0,
        ..Amplifier::default()
    };
    let mut site = at(50.0, 1500.0);
    let [rated, peak] = amplifier.currents(&site);
    near("rated", rated, 8.0 * 0.75 * 0.95, 1e-12);
    near("peak", peak, 24.0 * 0.75 * 0.95, 1e-12);
    site.cabinet = Some(35.0);
    near(
        "cool cabinet",
        amplifier.currents(&site)[0],
        8.0 * 0.95,
        1e-12,
    );
    amplifier.derating = Derating {
        temperature: vec![[50.0, 1.0], [60.0, 0.5]],
        altitude: vec![[2000.0, 1.0], [3000.0, 0.8]],
    };
    site.cabinet = Some(55.0);
    near("maker", amplifier.currents(&site)[0], 6.0, 1e-12);
}

fn press(surroundings: &str) -> Stand {
    let more = format!("[surroundings]\n{surroundings}\n\n[motion]");
    Stand::new(&edited(&press_text(), "[motion]", &more))
}

/// Every rule uses the reduced S1 torque, and the winding's share of its rise agrees: with a constant S1 torque it is (T_rms/T_S1)².
#[test]
fn rules_judge_the_reduced_torque() {
    let level = |stand: &mut Stand| {
        stand.motor.standstill_torque = stand.motor.rated_torque;
        stand.motor.rated_speed = Some(1e4);
    };
    let mut cool = press("ambient = \"40 degC\"");
    level(&mut cool);
    let of_sheet = cool.found(true, Rule::RmsTorque);
    for (limit, factor) in [(None, 0.85), (Some(140.0), 0.85f64.sqrt())] {
        let mut hot = press("ambient = \"55 degC\"");
        level(&mut hot);
        hot.motor.thermal.max_temperature = limit;
        let rms = hot.found(true, Rule::RmsTorque);
        near("RMS", rms.value, of_sheet.value, 1e-12);
        near("S1", rms.rating, factor * of_sheet.rating, 1e-12);
        let holding = hot.found(true, Rule::HoldingTorque);
        near("standstill", holding.rating, factor * 8.0, 1e-12);
        let winding = hot.found(true, Rule::WindingTemperature);
        let used = (rms.value / rms.rating).powi(2);
        near("winding", winding.value / winding.rating, used, 1e-9);
        let site = hot.found(true, Rule::AmbientTemperature);
        assert_eq!([site.value, site.rating], [55.0, 60.0]);
    }
    // The maker's factor reduces the torque at every speed, so the share uses that torque, too.
    let mut hot = press("ambient = \"55 degC\"");
    level(&mut hot);
    hot.motor.derating.temperature = vec![[40.0, 1.0], [60.0, 0.6]];
    let rms = hot.found(true, Rule::RmsTorque);
    near("S1", rms.rating, 0.7 * of_sheet.rating, 1e-12);
    let winding = hot.found(true, Rule::WindingTemperature);
    let used = (rms.value / rms.rating).powi(2);
    near("winding", winding.value / winding.rating, used, 1e-9);
}

/// Outside its source no rule covers a motor: the site is violated by name, with the limit. A site as in the data sheet is not judged.
#[test]
fn a_site_beyond_all_rules_is_violated() {
    let rules = RuleSet::default();
    let hot = press("ambient = \"299 degC\"");
    let check = hot.check(true, &rules, Rule::AmbientTemperature);
    assert_eq!(check.verdict, RuleVerdict::Fail);
    assert!(note(&check).contains("IEC 60034-1"), "{}", note(&check));
    let cool = press("ambient = \"40 degC\"\naltitude = \"1000 m\"");
    for rule in [
        Rule::AmbientTemperature,
        Rule::CabinetTemperature,
        Rule::Altitude,
    ] {
        assert!(cool.finding(true, &rules, rule).is_none());
    }
    let mut high = press("altitude = \"2500 m\"");
    assert_eq!(
        high.check(true, &rules, Rule::Altitude).verdict,
        RuleVerdict::Pass
    );
    high.motor.derating.altitude = vec![[1000.0, 1.0], [2000.0, 0.9]];
    let check = high.check(true, &rules, Rule::Altitude);
    assert_eq!(
        (check.verdict, check.limit),
        (RuleVerdict::Fail, Some(2000.0))
    );
    assert!(
        note(&check).contains("altitude_derating"),
        "{}",
        note(&check)
    );
}
