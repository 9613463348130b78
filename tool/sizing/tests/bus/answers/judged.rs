//! Judged figures, requested data, and the text about them.

use jred_file::model::supply::{BrakeResistor, Supply};
use jred_report::list::bus::words;
use jred_sizing::bus::conflict::Conflict;
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::verdict::{BusCheck, BusQuantity};
use jred_sizing::catalogue::Resistor;

use super::super::near;
use super::{NOTHING, RESISTOR, answer};
use crate::support::within;

/// Data that were given are not requested again, until nothing is open; only figures that are not checked are requested.
#[test]
fn questions_are_closed_by_what_they_ask_for() {
    let brakes = PowerCurve::new(
        [[0.0, 2500.0], [1.5, 2500.0], [1.5, -7000.0], [2.0, -7000.0]],
        2.0,
    );
    // By the first list of keys, or by the last.
    for last in [false, true] {
        let mut supply = NOTHING;
        let mut asked = Vec::new();
        loop {
            let found = answer(std::slice::from_ref(&brakes), &supply, false);
            let all = found.open();
            let Some(open) = all.first() else { break };
            let words = words::missing(&found, open);
            let keys = if last {
                open.keys.last()
            } else {
                open.keys.first()
            };
            let keys = keys.unwrap_or_else(|| panic!("{words}"));
            assert!(!words.is_empty() && !open.figure.is_empty());
            for key in *keys {
                assert!(!asked.contains(key), "{key} twice: {words}");
                let name = key.rsplit('.').next().unwrap();
                assert!(words.contains(name), "{key}: {words}");
                asked.push(key);
                match *key {
                    "capacitance" => supply.capacitance = Some(5e-4),
                    "max_voltage" => supply.max_voltage = Some(820.0),
                    "regenerative" => supply.regenerative = true,
                    key => panic!("{key}"),
                }
            }
        }
        let expected: &[&str] = if last {
            &["regenerative", "max_voltage"]
        } else {
            &["capacitance", "max_voltage"]
        };
        assert_eq!(asked, expected);
    }
    // With a resistor that switches on all of its figures are requested; an unlimited voltage is not.
    let resistor = Supply {
        capacitance: Some(1e-4),
        chopper_voltage: Some(700.0),
        brake_resistor: Some(RESISTOR),
        ..NOTHING
    };
    let keys = |supply: &Supply, curve: &PowerCurve| -> Vec<&str> {
        let open = answer(std::slice::from_ref(curve), supply, false).open();
        open.iter()
            .flat_map(|open| open.keys.iter().copied().flatten().copied())
            .collect()
    };
    assert_eq!(
        keys(&resistor, &brakes),
        [
            "max_voltage",
            "min_resistance",
            "brake_resistor.peak_power",
            "brake_resistor.pulse_energy"
        ]
    );
    // The resistor holds its switch-on voltage, which is not a rise without one.
    let found = answer(std::slice::from_ref(&brakes), &resistor, false);
    let words = words::missing(&found, &found.open()[0]);
    assert!(
        words.contains("rises from 560 V to 700 V: give max_voltage"),
        "{words}"
    );
    let drives = PowerCurve::new([[0.0, 2500.0], [2.0, 2500.0]], 2.0);
    assert_eq!(keys(&resistor, &drives), ["max_voltage"]);
    // More is regenerated than drawn, and nothing absorbs it.
    let hoist = PowerCurve::new(
        [[0.0, 100.0], [1.0, 100.0], [1.0, -300.0], [2.0, -300.0]],
        2.0,
    );
    let unbounded = Supply {
        capacitance: Some(1e-4),
        ..NOTHING
    };
    let found = answer(&[hoist], &unbounded, false);
    assert!(found.judged()[0].is_infinite() && found.open().is_empty());
    assert!(!found.holds() && found.failed()[0].limit.is_none());
    // The text gives start and end of the rise.
    let found = answer(&[brakes], &unbounded, false);
    let highest = (560.0f64.powi(2) + 2.0 * 3500.0 / 1e-4).sqrt();
    let words = words::missing(&found, &found.open()[0]);
    assert!(
        words.contains(&format!(
            "from 560 V to {highest:.0} V without a brake resistor"
        )),
        "{words}"
    );
}

/// A figure at its limit satisfies it, from the correct side. Without a figure nothing is known; without a limit it fails.
#[test]
fn checks_hold_on_their_side() {
    let check = |what, figure, limit| BusCheck {
        what,
        figure,
        limit,
    };
    for what in [
        BusQuantity::Voltage,
        BusQuantity::Mean,
        BusQuantity::Peak,
        BusQuantity::Pulse,
        BusQuantity::Resistance,
    ] {
        let upper = what != BusQuantity::Resistance;
        for (figure, holds) in [(99.0, upper), (100.0, true), (101.0, !upper)] {
            assert_eq!(
                check(what, figure, Some(100.0)).holds(),
                Some(holds),
                "{what:?} {figure}"
            );
        }
        assert_eq!(check(what, f64::NAN, Some(100.0)).holds(), None);
        assert_eq!(check(what, f64::INFINITY, None).holds(), Some(false));
        let (name, unit) = (check(what, 1.0, None).name(), check(what, 1.0, None).unit());
        let expected = match what {
            BusQuantity::Voltage => ("bus voltage", "V"),
            BusQuantity::Resistance => ("brake resistance", "Ohm"),
            BusQuantity::Mean => ("brake resistor mean power", "W"),
            BusQuantity::Peak => ("brake resistor peak power", "W"),
            BusQuantity::Pulse => ("brake resistor pulse energy", "J"),
        };
        assert_eq!((name, unit), expected);
    }
}

/// Each names its two voltages with their meaning, and the keys to change.
#[test]
fn conflicts_name_their_voltages() {
    for (conflict, voltages, words) in [
        (
            Conflict::Supply {
                supply: 700.0,
                highest: 650.0,
            },
            [700.0, 650.0],
            "always above its maximum of 650 V: the supply keeps it at 700 V",
        ),
        (
            Conflict::Supply {
                supply: 650.0,
                highest: 650.0,
            },
            [650.0, 650.0],
            "keeps the bus at its maximum voltage, 650 V",
        ),
        (
            Conflict::LateChopper {
                chopper: 850.0,
                highest: 800.0,
            },
            [850.0, 800.0],
            "switches on at 850 V, which is not below the maximum bus voltage of 800 V",
        ),
        (
            Conflict::EarlyChopper {
                chopper: 500.0,
                supply: 560.0,
            },
            [500.0, 560.0],
            "switches on at 500 V, and the supply keeps the bus at 560 V",
        ),
    ] {
        let found = words::conflict(&conflict);
        assert!(found.contains(words), "{found}");
        for voltage in voltages {
            assert!(found.contains(&format!("{voltage} V")), "{found}");
        }
        for key in conflict.keys() {
            assert!(found.contains(key), "{key}: {found}");
        }
    }
    // Without regenerated energy no resistor is needed, and the conflict is irrelevant.
    let late = Supply {
        capacitance: Some(1e-4),
        chopper_voltage: Some(850.0),
        max_voltage: Some(800.0),
        ..NOTHING
    };
    let drives = PowerCurve::new([[0.0, 100.0], [1.0, 100.0]], 1.0);
    let brakes = PowerCurve::new(
        [[0.0, 2500.0], [1.5, 2500.0], [1.5, -6000.0], [2.0, -6000.0]],
        2.0,
    );
    assert_eq!(answer(&[drives], &late, false).conflict(), None);
    let found = answer(&[brakes], &late, false);
    assert!(matches!(found.conflict(), Some(Conflict::LateChopper { .. })) && found.need.is_none());
}

/// Of the sufficient resistors the smallest, of equal ones the cheapest; the maker's own figures come first.
#[test]
fn the_smallest_resistor_that_is_enough_is_proposed() {
    let brakes = PowerCurve::new(
        [[0.0, 2500.0], [1.5, 2500.0], [1.5, -6000.0], [2.0, -6000.0]],
        2.0,
    );
    let supply = Supply {
        capacitance: Some(1e-4),
        chopper_voltage: Some(700.0),
        max_voltage: Some(800.0),
        min_resistance: Some(40.0),
        ..NOTHING
    };
    let need = answer(&[brakes], &supply, true).need.unwrap();
    let enough = Resistor {
        key: "enough".to_owned(),
        resistance: 60.0,
        rated_power: need.mean,
        peak_power: Some(need.peak),
        pulse_energy: Some(need.pulse),
        from_maker: true,
        ..Resistor::default()
    };
    let other = |key: &str, change: &dyn Fn(&mut Resistor)| {
        let mut resistor = Resistor {
            key: key.to_owned(),
            ..enough.clone()
        };
        change(&mut resistor);
        resistor
    };
    assert!(need.is_met(&enough) && need.is_possible());
    for resistance in [40.0, need.largest_resistance] {
        assert!(need.is_met(&other("", &|r| r.resistance = resistance)));
    }
    for (k, change) in [
        (&|r: &mut Resistor| r.resistance = 39.9) as &dyn Fn(&mut Resistor),
        &|r| r.resistance = 1.001 * need.largest_resistance,
        &|r| r.rated_power *= 0.999,
        &|r| r.peak_power = Some(0.999 * need.peak),
        &|r| r.pulse_energy = Some(0.999 * need.pulse),
    ]
    .iter()
    .enumerate()
    {
        assert!(!need.is_met(&other("", change)), "{k}");
    }
    // A missing figure does not exclude it; one with a peak power comes first.
    assert!(need.is_met(&other("", &|r| r.pulse_energy = None)));
    let unknown = other("unknown", &|r| r.peak_power = None);
    assert!(need.is_met(&unknown));
    let pair = [unknown, other("larger", &|r| r.rated_power *= 2.0)];
    let first = |list: &[Resistor]| need.proposal(list, None).map(|r| r.key.clone());
    assert_eq!(first(&pair).as_deref(), Some("larger"));
    assert_eq!(first(&pair[..1]).as_deref(), Some("unknown"));
    let list = [
        other("small but third-party", &|r| r.from_maker = false),
        other("larger", &|r| r.rated_power *= 2.0),
        other("dear", &|r| r.price = Some(90.0)),
        other("cheap", &|r| r.price = Some(80.0)),
        other("weak", &|r| r.rated_power *= 0.5),
    ];
    let proposed = |list: &[Resistor]| need.proposal(list, None).map(|r| r.key.clone());
    assert_eq!(proposed(&list).as_deref(), Some("cheap"));
    assert_eq!(proposed(&list[..2]).as_deref(), Some("larger"));
    assert_eq!(
        proposed(&list[..1]).as_deref(),
        Some("small but third-party")
    );
    assert_eq!(proposed(&list[4..]), None);
    // The chopper cannot switch the required resistance.
    let impossible = Supply {
        min_resistance: Some(2.0 * need.largest_resistance),
        ..supply
    };
    let brakes = PowerCurve::new(
        [[0.0, 2500.0], [1.5, 2500.0], [1.5, -6000.0], [2.0, -6000.0]],
        2.0,
    );
    let found = answer(&[brakes], &impossible, true);
    assert!(!found.need.unwrap().is_possible());
    assert!(
        found
            .cures
            .iter()
            .all(|cure| !words::cure(cure).contains("brake_resistor.resistance"))
    );
    assert!(words::resistor(&found.need.unwrap()).contains("but the chopper requires at least"));
}

/// Two equal axes half a period apart cancel on the bus, in step they add up: judged are the worst phases, or those in step.
#[test]
fn the_worst_phases_are_judged() {
    let brakes = PowerCurve::new(
        [[0.0, 900.0], [1.0, 900.0], [1.0, -700.0], [2.0, -700.0]],
        2.0,
    );
    let supply = Supply {
        capacitance: Some(1e-5),
        chopper_voltage: Some(700.0),
        max_voltage: Some(800.0),
        brake_resistor: Some(BrakeResistor {
            power: 1e4,
            ..RESISTOR
        }),
        ..NOTHING
    };
    let stored = 0.5 * 1e-5 * (700.0f64.powi(2) - 560.0f64.powi(2));
    let apart = [brakes.clone(), brakes.shifted(1.0)];
    for (curves, in_step, burns) in [
        (&apart, true, false),
        (&apart, false, true),
        (&[brakes.clone(), brakes], true, true),
    ] {
        let found = answer(curves, &supply, in_step);
        let [voltage, mean, peak, pulse] = found.judged();
        let expected = if burns {
            [700.0, 0.5 * (1400.0 - stored), 1400.0, 1400.0 - stored]
        } else {
            [560.0, 0.0, 0.0, 0.0]
        };
        for (found, expected) in [voltage, mean, peak, pulse].into_iter().zip(expected) {
            within("judged", found, expected, 1e-6 * expected);
        }
    }
    // The required figures in the text: all of them.
    let bare = Supply {
        brake_resistor: None,
        max_voltage: Some(710.0),
        ..supply
    };
    let need = answer(&apart, &bare, false).need.unwrap();
    let words = words::needed(&need);
    assert!(
        words.starts_with("requires a brake resistor of at most 350 Ω for ")
            && words.ends_with(&words::resistor(&need)),
        "{words}"
    );
}

/// Two axes half a period apart, one drawing the energy of the other: a common resistor saves what two would dissipate; in step it saves nothing.
#[test]
fn what_a_common_resistor_saves() {
    let brakes = PowerCurve::new(
        [[0.0, 900.0], [1.0, 900.0], [1.0, -700.0], [2.0, -700.0]],
        2.0,
    );
    let supply = Supply {
        capacitance: Some(1e-12),
        chopper_voltage: Some(700.0),
        max_voltage: Some(1e4),
        brake_resistor: Some(RESISTOR),
        ..NOTHING
    };
    let apart = [brakes.clone(), brakes.shifted(1.0)];
    near(
        "apart",
        answer(&apart, &supply, true).saved().unwrap(),
        700.0,
        1e-6,
    );
    let together = [brakes.clone(), brakes.clone()];
    within(
        "in step",
        answer(&together, &supply, true).saved().unwrap(),
        0.0,
        1e-6,
    );
    assert_eq!(answer(&[brakes], &supply, true).saved(), None);
    let bare = Supply {
        brake_resistor: None,
        ..supply
    };
    assert_eq!(answer(&together, &bare, true).saved(), None);
}
