//! Each change alone is sufficient, and slightly less is not.

use jred_file::model::supply::{BrakeResistor, Supply};
use jred_report::list::bus::words;
use jred_sizing::bus::cure::{Bound, Change, Cure, share};
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::verdict::BusQuantity;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::super::{budget, near, random_curve};
use super::{NOTHING, RESISTOR, answer};

/// The supply with these changes, each figure beyond its bound by a share: on the safe side, or if negative on the other.
fn changed(supply: &Supply, changes: &[Change], beyond: f64) -> Supply {
    let mut supply = *supply;
    let mut resistor = supply.brake_resistor.unwrap_or(RESISTOR);
    let (mut at_least, mut at_most) = (None, None);
    for change in changes {
        let value = match change.bound {
            Bound::AtLeast(value) => value * (1.0 + beyond),
            Bound::AtMost(value) => value * (1.0 - beyond),
        };
        match (change.key, change.bound) {
            ("capacitance", _) => supply.capacitance = Some(1e-6 * value),
            ("brake_resistor.power", _) => resistor.power = value,
            ("brake_resistor.peak_power", _) => resistor.peak_power = Some(value),
            ("brake_resistor.pulse_energy", _) => resistor.pulse_energy = Some(value),
            ("brake_resistor.resistance", Bound::AtLeast(_)) => at_least = Some(value),
            ("brake_resistor.resistance", Bound::AtMost(_)) => at_most = Some(value),
            (key, _) => panic!("{key}"),
        }
        if change.key.starts_with("brake_resistor") {
            supply.brake_resistor = Some(BrakeResistor::clone(&resistor));
        }
    }
    if let Some(resistance) = at_most.or(at_least)
        && let Some(resistor) = &mut supply.brake_resistor
    {
        resistor.resistance = resistance;
    }
    supply
}

/// The text gives each bound with four digits, rounded to the sufficient side.
fn words_are_enough(cure: &Cure) {
    let words = words::cure(cure);
    for change in &cure.changes {
        let (word, value, side) = match change.bound {
            Bound::AtLeast(value) => ("at least", value, 1.0),
            Bound::AtMost(value) => ("at most", value, -1.0),
        };
        let start = format!("{} {word} ", change.key);
        let rest = words.split(&start).nth(1).expect(&words);
        let number: f64 = rest.split(' ').next().unwrap().parse().unwrap();
        assert!(rest.split([' ', ',']).nth(1) == change.unit.split(' ').next());
        let more = side * (number - value) / value;
        assert!((-1e-12..1e-3).contains(&more), "{words}: {value}");
    }
}

/// Every proposed change suffices alone, and none requires a larger resistor than needed. A bus that satisfies all rules has no cures.
#[track_caller]
fn cures_are_enough(curves: &[PowerCurve], supply: &Supply, in_step: bool, needed: bool) -> usize {
    let found = answer(curves, supply, in_step);
    assert_eq!(found.holds(), found.failed().is_empty());
    if found.failed().is_empty() {
        assert!(found.cures.is_empty() && found.lacks().is_empty());
        return 0;
    }
    for cure in &found.cures {
        words_are_enough(cure);
        if let Some(phases) = &cure.phases {
            let figures = found.shared.at(phases).unwrap();
            let limits = found.limits();
            let period = found.power.as_ref().unwrap().period();
            let used = share(limits, &figures, period);
            assert!(used <= 1.0, "{used}");
            continue;
        }
        if cure.changes.is_empty() {
            assert!(words::cure(cure).starts_with("regenerative = true"));
            let back = Supply {
                regenerative: true,
                brake_resistor: None,
                ..*supply
            };
            assert!(answer(curves, &back, in_step).failed().is_empty());
            continue;
        }
        let mended = answer(curves, &changed(supply, &cure.changes, 1e-9), in_step);
        assert!(
            mended.failed().is_empty(),
            "{}: {:?}",
            words::cure(cure),
            mended.failed()
        );
        if needed && cure.changes[0].key.starts_with("brake_resistor") {
            // Each change is needed: with a thousandth less of it, and all others, a rule fails.
            for k in 0..cure.changes.len() {
                let mut supply = changed(supply, &cure.changes, 1e-9);
                supply = changed(&supply, &cure.changes[k..=k], -1e-3);
                let short = answer(curves, &supply, in_step);
                assert!(!short.failed().is_empty(), "{}: {k}", words::cure(cure));
            }
        }
    }
    found.cures.len()
}

#[test]
fn each_cure_alone_is_enough() {
    let mut random = ChaCha8Rng::seed_from_u64(21);
    let full = Supply {
        capacitance: Some(470e-6),
        chopper_voltage: Some(780.0),
        max_voltage: Some(780.0 + 1e-6),
        ..NOTHING
    };
    let mut cures = [0; 4];
    for _ in 0..25 {
        let curve = [random_curve(&mut random, 0.8, 6000.0)];
        // Without a resistor: add one, add capacitance, or use a supply that takes energy back.
        let bare = Supply {
            max_voltage: Some(790.0),
            ..full
        };
        cures[0] += cures_are_enough(&curve, &bare, true, false);
        // A resistor that is too weak, in one figure or in all.
        let weak = BrakeResistor {
            resistance: 30.0,
            power: 10f64.powf(random.random_range(1.0..4.0)),
            peak_power: Some(10f64.powf(random.random_range(2.0..4.0))),
            pulse_energy: Some(10f64.powf(random.random_range(2.0..4.0))),
        };
        let weak = Supply {
            brake_resistor: Some(weak),
            max_voltage: Some(900.0),
            ..full
        };
        cures[1] += cures_are_enough(&curve, &weak, true, true);
        // More power than it dissipates at the chopper's voltage: the bus exceeds its limit.
        let high = Supply {
            brake_resistor: Some(BrakeResistor {
                resistance: 400.0,
                ..RESISTOR
            }),
            ..full
        };
        cures[2] += cures_are_enough(&curve, &high, true, false);
        let two = [curve[0].clone(), random_curve(&mut random, 0.4, 4000.0)];
        cures[3] += cures_are_enough(&two, &bare, false, false);
        cures[3] += cures_are_enough(&two, &weak, false, false);
    }
    assert!(cures.iter().all(|count| *count > 12), "{cures:?}");
}

/// Braking with 6 kW for half a second in every two: ½·C·(U² − U₀²) = 3 kJ, U²/R = 6 kW, 1.5 kW on average.
#[test]
fn cures_by_hand() {
    let curve = || {
        PowerCurve::new(
            [[0.0, 2500.0], [1.5, 2500.0], [1.5, -6000.0], [2.0, -6000.0]],
            2.0,
        )
    };
    let supply = Supply {
        capacitance: Some(1e-4),
        chopper_voltage: Some(700.0),
        max_voltage: Some(800.0),
        ..NOTHING
    };
    let found = answer(&[curve()], &supply, true);
    assert_eq!(found.cures.len(), 3, "{:?}", found.cures);
    let stored = 0.5 * 1e-4 * (700.0f64.powi(2) - 560.0f64.powi(2));
    let need = found.need.unwrap();
    near("mean", need.mean, (3000.0 - stored) / 2.0, budget::BUS);
    near("peak", need.peak, 6000.0, budget::BUS);
    near("pulse", need.pulse, 3000.0 - stored, budget::BUS);
    near(
        "resistance",
        need.largest_resistance,
        490e3 / 6000.0,
        budget::BUS,
    );
    // All of it in the capacitor.
    let Bound::AtLeast(capacitance) = found.cures[1].changes[0].bound else {
        panic!()
    };
    let expected = 2.0 * 3000.0 / (800.0f64.powi(2) - 560.0f64.powi(2));
    near("C", 1e-6 * capacitance, expected, budget::BUS);
    // A supply that takes it back: 6 kW peak, 1.5 kW on average.
    let words = words::cure(&found.cures[2]);
    assert!(
        words.contains("6000 W peak, at most 1500 W mean"),
        "{words}"
    );

    // With a resistor the capacitance only has to keep the voltage below the chopper's.
    let with = Supply {
        brake_resistor: Some(BrakeResistor {
            power: 10.0,
            ..RESISTOR
        }),
        ..supply
    };
    let found = answer(&[curve()], &with, true);
    let Bound::AtLeast(capacitance) = found.cures[1].changes[0].bound else {
        panic!()
    };
    let expected = 2.0 * 3000.0 / (700.0f64.powi(2) - 560.0f64.powi(2));
    near("C", 1e-6 * capacitance, expected, budget::BUS);
    let burnt = 3000.0 - stored;
    assert_eq!(found.lacks().len(), 1);
    let (what, lacking) = found.lacks()[0];
    assert_eq!(what, BusQuantity::Mean);
    near("lacks", lacking, burnt / 2.0 - 10.0, budget::BUS);

    // A resistance below the chopper's least one is too small, whatever its power.
    let small = Supply {
        brake_resistor: Some(BrakeResistor {
            resistance: 20.0,
            ..RESISTOR
        }),
        min_resistance: Some(30.0),
        ..supply
    };
    let found = answer(&[curve()], &small, true);
    assert_eq!(found.lacks(), [(BusQuantity::Resistance, 10.0)]);
    // A resistor that never switches on: only the resistance is judged, and no capacitance helps.
    let gentle = PowerCurve::new([[0.0, 100.0], [1.0, 100.0], [1.0, -5.0], [2.0, -5.0]], 2.0);
    let found = answer(&[gentle], &small, true);
    let keys: Vec<&str> = found.cures[0]
        .changes
        .iter()
        .map(|change| change.key)
        .collect();
    assert_eq!(keys, ["brake_resistor.resistance"]);
    assert!(matches!(
        found.cures[0].changes[0].bound,
        Bound::AtLeast(30.0)
    ));
    assert!(
        found
            .cures
            .iter()
            .all(|cure| !words::cure(cure).contains("capacitance"))
    );
}

/// Cycles without a common period: the simultaneous peak of all axes, and the mean, bound any phases.
#[test]
fn without_a_common_period_the_bounds_are_enough() {
    let brakes = |period: f64, back: f64| {
        PowerCurve::new(
            [
                [0.0, 3000.0],
                [0.5 * period, 3000.0],
                [0.5 * period, -back],
                [period, -back],
            ],
            period,
        )
    };
    let curves = [brakes(1.0, 1000.0), brakes(std::f64::consts::SQRT_2, 400.0)];
    for (least, possible) in [(None, true), (Some(100.0), true), (Some(1000.0), false)] {
        let supply = Supply {
            capacitance: Some(1e-5),
            chopper_voltage: Some(700.0),
            max_voltage: Some(750.0),
            min_resistance: least,
            ..NOTHING
        };
        let found = answer(&curves, &supply, false);
        assert!(!found.failed().is_empty());
        // The bounds: 500 W and 200 W fed back in the mean, 1400 W at once; a pulse has none.
        let need = found.need.unwrap();
        near("mean", need.mean, 700.0, budget::BUS);
        near("peak", need.peak, 1400.0, budget::BUS);
        assert!(need.pulse.is_nan());
        assert_eq!(need.is_possible(), possible);
        let cure = found
            .cures
            .iter()
            .find(|cure| words::cure(cure).starts_with("brake_resistor"));
        assert_eq!(cure.is_some(), possible);
        let Some(cure) = cure else { continue };
        let bound = |key: &str, upper: bool| {
            let of = cure.changes.iter().filter(|change| change.key == key);
            of.map(|change| change.bound).find_map(|bound| match bound {
                Bound::AtMost(value) if upper => Some(value),
                Bound::AtLeast(value) if !upper => Some(value),
                _ => None,
            })
        };
        near(
            "R",
            bound("brake_resistor.resistance", true).unwrap(),
            750.0 * 750.0 / 1400.0,
            budget::BUS,
        );
        near(
            "mean",
            bound("brake_resistor.power", false).unwrap(),
            700.0,
            budget::BUS,
        );
        near(
            "peak",
            bound("brake_resistor.peak_power", false).unwrap(),
            1400.0,
            budget::BUS,
        );
        assert_eq!(bound("brake_resistor.resistance", false), least);
        assert!(words::no_search(&found).contains("no common period within 100000 cycles"));
    }
    // Missing data are requested in the text.
    let open = Supply {
        capacitance: Some(1e-5),
        max_voltage: Some(750.0),
        ..NOTHING
    };
    let words = words::cure(&answer(&curves, &open, false).cures[0]);
    assert!(
        words.ends_with(", with a chopper_voltage below max_voltage"),
        "{words}"
    );
    let long = [brakes(1.0, 1000.0), brakes(1.0007, 400.0)];
    let words = words::no_search(&answer(&long, &open, false));
    assert!(
        words.contains("(10007, 10000 cycles of axes 1, 2)"),
        "{words}"
    );
}

/// Figures of five digits and more are also rounded to four, to the sufficient side.
#[test]
fn large_figures_are_rounded_to_the_safe_side() {
    let curve = PowerCurve::new(
        [
            [0.0, 99e3],
            [1.5, 99e3],
            [1.5, -123_456.7],
            [2.0, -123_456.7],
        ],
        2.0,
    );
    let supply = Supply {
        capacitance: Some(1e-3),
        chopper_voltage: Some(700.0),
        max_voltage: Some(800.0),
        ..NOTHING
    };
    let found = answer(&[curve], &supply, true);
    for cure in &found.cures {
        words_are_enough(cure);
    }
    let words = words::cure(&found.cures[0]);
    assert!(
        words.contains("brake_resistor.peak_power at least 123500 W"),
        "{words}"
    );
}

/// A supply at the bus's voltage limit can take energy back; one above the limit is not a cure.
#[test]
fn a_supply_at_the_limit_may_take_energy_back() {
    let curve = || {
        PowerCurve::new(
            [[0.0, 900.0], [1.0, 900.0], [1.0, -700.0], [2.0, -700.0]],
            2.0,
        )
    };
    for (highest, helps) in [(560.1, true), (560.0, true), (559.9, false)] {
        let supply = Supply {
            capacitance: Some(1e-4),
            max_voltage: Some(highest),
            ..NOTHING
        };
        let found = answer(&[curve()], &supply, true);
        assert!(!found.failed().is_empty());
        let back = found
            .cures
            .iter()
            .any(|cure| words::cure(cure).starts_with("regenerative = true"));
        assert_eq!(back, helps, "{highest}: {:?}", found.cures);
    }
}

/// Two axes whose braking exceeds a resistor in step and cancels half a period apart: shifting is a cure, unless the resistance is below the
/// chopper's least one.
#[test]
fn phases_do_not_mend_a_resistance() {
    let curve = || {
        PowerCurve::new(
            [[0.0, 900.0], [1.0, 900.0], [1.0, -700.0], [2.0, -700.0]],
            2.0,
        )
    };
    for (least, helps) in [
        (None, true),
        (Some(46.9), true),
        (Some(47.0), true),
        (Some(47.1), false),
    ] {
        let supply = Supply {
            capacitance: Some(1e-5),
            chopper_voltage: Some(700.0),
            max_voltage: Some(800.0),
            min_resistance: least,
            brake_resistor: Some(BrakeResistor {
                power: 10.0,
                ..RESISTOR
            }),
            ..NOTHING
        };
        let found = answer(&[curve(), curve()], &supply, true);
        assert!(!found.failed().is_empty());
        let shifted = found.cures.iter().find_map(|cure| cure.phases.as_ref());
        assert_eq!(shifted.is_some(), helps, "{least:?}: {:?}", found.cures);
        if let Some(phases) = shifted {
            near("half a period apart", phases[1], 1.0, 0.2);
        }
    }
}
