//! What a bus lacks and what would mend it: each change alone is enough, a little less is not, and what is asked for closes the question.

use jred_machine::model::supply::{BrakeResistor, Supply};
use jred_sizing::bus::answer::{Answer, Axis};
use jred_sizing::bus::conflict::Conflict;
use jred_sizing::bus::cure::{Bound, Change, Cure};
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::supply::BusData;
use jred_sizing::bus::verdict::{BusCheck, Judged};
use jred_sizing::catalogue::{Catalogue, Motor, Resistor};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::{budget, near, random_curve};

const NOTHING: Supply = Supply {
    given: true,
    capacitance: None,
    chopper_voltage: None,
    max_voltage: None,
    min_resistance: None,
    regenerative: false,
    brake_resistor: None,
};

const RESISTOR: BrakeResistor = BrakeResistor {
    resistance: 47.0,
    power: f64::INFINITY,
    peak_power: None,
    pulse_energy: None,
};

fn answer(curves: &[PowerCurve], supply: &Supply, only_in_step: bool) -> Answer {
    let axis = |curve: &PowerCurve| Axis {
        title: String::new(),
        drive: String::new(),
        curve: curve.clone(),
        data: BusData::new(supply, Some(560.0), None, &Motor::default()),
        holds: true,
    };
    let axes = curves.iter().map(axis).collect();
    Answer::new(axes, only_in_step, supply, &Catalogue::default(), &()).unwrap()
}

/// The supply with these changes, each figure a share beyond what it must be: to the safe side, or if negative to the other.
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

/// The words give each bound with four digits, rounded to the side where it is enough.
fn words_are_enough(cure: &Cure) {
    for change in &cure.changes {
        let (word, value, side) = match change.bound {
            Bound::AtLeast(value) => ("at least", value, 1.0),
            Bound::AtMost(value) => ("at most", value, -1.0),
        };
        let start = format!("{} {word} ", change.key);
        let rest = cure.words.split(&start).nth(1).expect(&cure.words);
        let number: f64 = rest.split(' ').next().unwrap().parse().unwrap();
        assert!(rest.split([' ', ',']).nth(1) == change.unit.split(' ').next());
        let more = side * (number - value) / value;
        assert!((-1e-12..1e-3).contains(&more), "{}: {value}", cure.words);
    }
}

/// Of the changes that an answer proposes every one suffices alone, and none of a resistor asks for more than is needed. A bus that holds
/// asks for nothing.
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
            let used = jred_sizing::bus::cure::share(limits, &figures, period);
            assert!(used <= 1.0, "{used}");
            continue;
        }
        if cure.changes.is_empty() {
            assert!(cure.words.starts_with("regenerative = true"));
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
            cure.words,
            mended.failed()
        );
        if needed && cure.changes[0].key.starts_with("brake_resistor") {
            // Each change is needed: without a thousandth of it, with all others, something fails.
            for k in 0..cure.changes.len() {
                let mut supply = changed(supply, &cure.changes, 1e-9);
                supply = changed(&supply, &cure.changes[k..=k], -1e-3);
                let short = answer(curves, &supply, in_step);
                assert!(!short.failed().is_empty(), "{}: {k}", cure.words);
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
        // No resistor: one, more capacitance, or a supply that takes energy back.
        let bare = Supply {
            max_voltage: Some(790.0),
            ..full
        };
        cures[0] += cures_are_enough(&curve, &bare, true, false);
        // A resistor that is too weak, in one way or in all.
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
        // More than it takes at the chopper's voltage: the bus rises beyond its limit.
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

/// Braking with 6 kW for half a second, once in two: ½·C·(U² − U₀²) = 3 kJ, U²/R = 6 kW, 1.5 kW on average.
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
    // A supply that takes it back: 6 kW at most, 1.5 kW on average.
    let words = &found.cures[2].words;
    assert!(
        words.contains("6000 W peak, at most 1500 W mean"),
        "{words}"
    );

    // With a resistor the capacitance need only keep it off: up to the chopper's voltage.
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
    assert_eq!(what, Judged::Mean);
    near("lacks", lacking, burnt / 2.0 - 10.0, budget::BUS);

    // A resistance below what the chopper may switch is too small, however much it takes.
    let small = Supply {
        brake_resistor: Some(BrakeResistor {
            resistance: 20.0,
            ..RESISTOR
        }),
        min_resistance: Some(30.0),
        ..supply
    };
    let found = answer(&[curve()], &small, true);
    assert_eq!(found.lacks(), [(Judged::Resistance, 10.0)]);
    // One that never comes on: only the resistance is asked for, and no capacitance helps.
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
            .all(|cure| !cure.words.contains("capacitance"))
    );
}

/// Cycles without a common period: what all of them feed back at once, and on average, is enough for any phases.
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
        assert!(found.need.is_none() && !found.failed().is_empty());
        let cure = found
            .cures
            .iter()
            .find(|cure| cure.words.starts_with("brake_resistor"));
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
        assert!(
            found
                .no_search()
                .contains("no common period within 100000 cycles")
        );
    }
    // What is not known is asked for in words.
    let open = Supply {
        capacitance: Some(1e-5),
        max_voltage: Some(750.0),
        ..NOTHING
    };
    let words = &answer(&curves, &open, false).cures[0].words;
    assert!(
        words.ends_with(", with a chopper_voltage below max_voltage"),
        "{words}"
    );
    let long = [brakes(1.0, 1000.0), brakes(1.0007, 400.0)];
    let words = answer(&long, &open, false).no_search();
    assert!(
        words.contains("(10007, 10000 cycles of axes 1, 2)"),
        "{words}"
    );
}

/// Whoever gives what is asked for is not asked for it again, until nothing is open; what is asked for is one of the figures that are not checked.
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
        while let Some(open) = answer(std::slice::from_ref(&brakes), &supply, false)
            .open()
            .into_iter()
            .next()
        {
            let keys = if last {
                open.keys.last()
            } else {
                open.keys.first()
            };
            let keys = keys.unwrap_or_else(|| panic!("{}", open.words));
            assert!(!open.words.is_empty() && !open.figure.is_empty());
            for key in *keys {
                assert!(!asked.contains(key), "{key} twice: {}", open.words);
                let name = key.rsplit('.').next().unwrap();
                assert!(open.words.contains(name), "{key}: {}", open.words);
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
    // With a resistor all of its figures are asked for, where it comes on; a voltage that nothing limits is no question.
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
    // It holds the voltage where it comes on, which is no rise without one.
    let words = &answer(std::slice::from_ref(&brakes), &resistor, false).open()[0].words;
    assert!(
        words.contains("rises from 560 V to 700 V: give max_voltage"),
        "{words}"
    );
    let drives = PowerCurve::new([[0.0, 2500.0], [2.0, 2500.0]], 2.0);
    assert_eq!(keys(&resistor, &drives), ["max_voltage"]);
    // More comes back than is drawn, and nothing takes it.
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
    // What rises is said, from where to where.
    let found = answer(&[brakes], &unbounded, false);
    let highest = (560.0f64.powi(2) + 2.0 * 3500.0 / 1e-4).sqrt();
    let words = &found.open()[0].words;
    assert!(
        words.contains(&format!(
            "from 560 V to {highest:.0} V without a brake resistor"
        )),
        "{words}"
    );
}

/// A figure at its limit satisfies it, on the right side of it; without a figure nothing is known, without a limit it fails.
#[test]
fn checks_hold_on_their_side() {
    let check = |what, figure, limit| BusCheck {
        what,
        figure,
        limit,
    };
    for what in [
        Judged::Voltage,
        Judged::Mean,
        Judged::Peak,
        Judged::Pulse,
        Judged::Resistance,
    ] {
        let upper = what != Judged::Resistance;
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
            Judged::Voltage => ("bus voltage", "V"),
            Judged::Resistance => ("brake resistance", "Ohm"),
            Judged::Mean => ("brake resistor mean power", "W"),
            Judged::Peak => ("brake resistor peak power", "W"),
            Judged::Pulse => ("brake resistor pulse energy", "J"),
        };
        assert_eq!((name, unit), expected);
    }
}

/// Each names its two voltages, which is which, and the keys to change.
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
        let found = conflict.words();
        assert!(found.contains(words), "{found}");
        for voltage in voltages {
            assert!(found.contains(&format!("{voltage} V")), "{found}");
        }
        for key in conflict.keys() {
            assert!(found.contains(key), "{key}: {found}");
        }
    }
    // Where nothing comes back no resistor is needed, and the conflict does not matter.
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

/// Of the resistors that meet what is needed the smallest, of equal ones the cheapest; the maker's own figures come first.
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
        &|r| r.peak_power = None,
        &|r| r.pulse_energy = Some(0.999 * need.pulse),
    ]
    .iter()
    .enumerate()
    {
        assert!(!need.is_met(&other("", change)), "{k}");
    }
    // No figure of the pulse is no objection.
    assert!(need.is_met(&other("", &|r| r.pulse_energy = None)));
    let list = [
        other("small but third-party", &|r| r.from_maker = false),
        other("larger", &|r| r.rated_power *= 2.0),
        other("dear", &|r| r.price = Some(90.0)),
        other("cheap", &|r| r.price = Some(80.0)),
        other("weak", &|r| r.rated_power *= 0.5),
    ];
    let proposed = |list: &[Resistor]| need.proposal(list).map(|r| r.key.clone());
    assert_eq!(proposed(&list).as_deref(), Some("cheap"));
    assert_eq!(proposed(&list[..2]).as_deref(), Some("larger"));
    assert_eq!(
        proposed(&list[..1]).as_deref(),
        Some("small but third-party")
    );
    assert_eq!(proposed(&list[4..]), None);
    // The chopper may not switch what would be needed.
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
            .all(|cure| !cure.words.contains("brake_resistor.resistance"))
    );
    assert!(
        found
            .need
            .unwrap()
            .figures()
            .contains("but the chopper requires at least")
    );
}

/// Two equal axes half a period apart do nothing to the bus, in step everything: what is judged is the worst of all phases, or what they do in step.
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
            crate::support::within("judged", found, expected, 1e-6 * expected);
        }
    }
    // Requirements in words: all of its figures.
    let bare = Supply {
        brake_resistor: None,
        max_voltage: Some(710.0),
        ..supply
    };
    let need = answer(&apart, &bare, false).need.unwrap();
    let words = need.words();
    assert!(
        words.starts_with("requires a brake resistor of at most 350 Ω for ")
            && words.ends_with(&need.figures()),
        "{words}"
    );
}

/// Of two axes half a period apart one takes what the other gives: a common resistor saves what two would burn; in step it saves nothing.
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
    crate::support::within(
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
