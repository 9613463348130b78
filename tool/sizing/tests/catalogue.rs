//! The catalogue: built-in data, a user's own catalogue, and the drives of both.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod broken;
mod columns;
mod contradictions;
mod database;
mod format;
mod pairing;
mod plausible;
mod spreadsheet;
mod twins;

use std::collections::{BTreeMap, BTreeSet};

use crate::support::{budget, near};
use jred_file::units::RPM;
use jred_sizing::catalogue::Catalogue;

/// The built-in catalogue, each motor once: without its optional brake.
fn built_in() -> Catalogue {
    let mut catalogue = Catalogue::load(None, None).unwrap();
    catalogue.keep(|motor| !motor.key.ends_with("-brake"), |_| true);
    catalogue
}

#[test]
fn the_built_in_catalogue_is_plausible() {
    let catalogue = built_in();
    assert!(catalogue.motors.len() >= 15, "{}", catalogue.motors.len());
    assert!(catalogue.gearboxes.len() >= 6);
    let makers: BTreeSet<&str> = catalogue.motors.iter().map(|m| m.maker.as_str()).collect();
    assert!(makers.len() >= 3, "{makers:?}");
    let keys: BTreeSet<&str> = catalogue.motors.iter().map(|m| m.key.as_str()).collect();
    assert_eq!(keys.len(), catalogue.motors.len());
    for motor in &catalogue.motors {
        let key = &motor.key;
        assert!(motor.source.len() > 20, "{key}");
        let rated_torque = motor.rated_torque.unwrap();
        let rated_speed = motor.rated_speed.unwrap();
        let peak_torque = motor.peak_torque.unwrap();
        let power = rated_torque * rated_speed;
        assert!((30.0..20e3).contains(&power), "{key}: {power} W");
        let rpm = rated_speed / RPM;
        assert!((500.0..6001.0).contains(&rpm), "{key}: {rpm} rpm");
        let overload = peak_torque / rated_torque;
        assert!(
            (2.0..14.5).contains(&overload),
            "{key}: peak/rated {overload}"
        );
        if let Some(standstill) = motor.standstill_torque {
            let share = standstill / rated_torque;
            assert!((1.0..2.7).contains(&share), "{key}: M0/Mn {share}");
            assert!(standstill < peak_torque, "{key}");
        }
        // Rotor inertia grows with the torque to the power 5/3 (similar shape); makers differ by a factor of ten.
        let slimness = motor.rotor_inertia / peak_torque.powf(5.0 / 3.0);
        assert!((5e-7..4e-5).contains(&slimness), "{key}: {slimness:e}");
        // Time to accelerate the bare rotor to rated speed at peak torque.
        let time = motor.rotor_inertia * rated_speed / peak_torque;
        assert!((9e-4..0.2).contains(&time), "{key}: {time} s");
        if let Some(mass) = motor.mass {
            assert!((0.2..20.0).contains(&(rated_torque / mass)), "{key}");
        }
    }
    let keys: BTreeSet<&str> = catalogue.gearboxes.iter().map(|g| g.key.as_str()).collect();
    assert_eq!(keys.len(), catalogue.gearboxes.len());
    for gearbox in &catalogue.gearboxes {
        let key = &gearbox.key;
        assert!(gearbox.source.len() > 20, "{key}");
        assert!((2.0..=220.0).contains(&gearbox.ratio), "{key}");
        assert!((0.8..1.0).contains(&gearbox.efficiency), "{key}");
        if let Some(rated) = gearbox.rated_torque {
            let overload = gearbox.peak_torque.map(|peak| peak / rated);
            let fits = overload.is_none_or(|overload| (1.0..4.0).contains(&overload));
            assert!(fits, "{key}: {overload:?}");
            assert!(
                overload.is_some() || gearbox.maker.starts_with("Apex"),
                "{key}"
            );
        }
        if let Some(speed) = gearbox.rated_speed {
            assert!(speed < gearbox.max_speed.unwrap(), "{key}");
        }
        assert!((1e-6..3e-2).contains(&gearbox.inertia), "{key}");
        if let (Some(stiffness), Some(torque)) = (gearbox.stiffness, gearbox.rated_torque) {
            // The rated torque twists a planetary gearbox by some arcminutes.
            let twist = (torque / stiffness).to_degrees() * 60.0;
            assert!((1.5..10.0).contains(&twist), "{key}: {twist} arcmin");
        }
        // The ratio is part of the type designation.
        assert!(
            gearbox.model.contains(&format!("i={}", gearbox.ratio))
                || gearbox.model.contains(&format!("-{:03}", gearbox.ratio)),
            "{key}: {}",
            gearbox.model
        );
    }
}

/// Rated power and power rate are in the same documents as torque, speed and inertia, but not in the catalogue: they reveal typing errors.
#[test]
fn the_built_in_motors_agree_with_their_rated_power() {
    let catalogue = built_in();
    let mut stated = 0;
    for motor in &catalogue.motors {
        let Some(power) = motor.stated_power else {
            continue;
        };
        let found = motor.rated_torque.unwrap() * motor.rated_speed.unwrap();
        near(&motor.key, found, power, budget::DATA_SHEET_POWER);
        stated += 1;
    }
    let table = include_str!("data/rated_power.csv");
    let (mut powers, mut rates) = (0, 0);
    for row in table.lines().skip(2) {
        let cells: Vec<&str> = row.split(',').collect();
        let motor = catalogue.motors.iter().find(|m| m.key == cells[0]);
        let motor = motor.unwrap_or_else(|| panic!("{row}"));
        let torque = motor.rated_torque.unwrap();
        let power = torque * motor.rated_speed.unwrap();
        near(
            row,
            power,
            cells[1].parse().unwrap(),
            budget::DATA_SHEET_POWER,
        );
        powers += 1;
        if let Ok(rate) = cells[2].parse::<f64>() {
            let found = torque * torque / motor.rotor_inertia;
            near(row, found, 1e3 * rate, budget::DATA_SHEET_POWER);
            rates += 1;
        }
    }
    assert_eq!((powers, rates), (107, 48));
    // Those without a stated power.
    let others = catalogue.motors.len() - stated;
    assert_eq!(others, 19, "17 of Fagor, HG-KN43J, SGMUH-30D");
}

/// The current at rated, standstill and peak torque; peak over M0 over rated torque.
#[test]
fn the_built_in_motors_agree_with_themselves() {
    let (mut constants, mut currents) = (0, 0);
    for motor in &built_in().motors {
        let (key, winding) = (&motor.key, &motor.winding);
        let rated = motor.rated_torque.unwrap();
        let peak = motor.peak_torque.unwrap();
        let standstill = motor.standstill_torque.unwrap_or(rated);
        assert!(rated <= standstill && standstill <= peak, "{key}");
        assert!(
            motor
                .max_speed
                .is_none_or(|most| most >= motor.rated_speed.unwrap()),
            "{key}"
        );
        let Some(current) = winding.rated_current else {
            continue;
        };
        currents += 1;
        // A printed torque constant that differs is left out: the current at the rated torque determines the heat.
        if let Some(constant) = winding.torque_constant {
            near(key, constant * current, rated, 0.05);
            constants += 1;
        }
        if let Some(at_rest) = winding.standstill_current {
            // Friction is part of the rated current.
            near(key, standstill / at_rest, rated / current, 0.09);
        }
        // Saturation takes up to a fifth of the torque; friction, part of the rated current, can raise the apparent value.
        if let Some(most) = winding.peak_current {
            let share = (peak / most) / (rated / current);
            assert!((0.65..1.3).contains(&share), "{key}: {share}");
        }
    }
    assert_eq!((constants, currents), (36, 119));
}

/// Each stated voltage is one of those that the sources name.
#[test]
fn the_built_in_motors_name_their_voltage() {
    let catalogue = built_in();
    let mut counts = BTreeMap::new();
    for motor in &catalogue.motors {
        let stated = [
            motor.mains_voltage,
            motor.bus_voltage,
            motor.max_bus_voltage,
        ];
        let said = if let [Some(mains), None, None] = stated {
            let [class, ac] = [format!("{mains} V class"), format!("{mains} V AC mains")];
            assert!(
                motor.source.contains(&class) || motor.source.contains(&ac),
                "{}: {}",
                motor.key,
                motor.source
            );
            format!("{mains} V AC")
        } else {
            assert_eq!(stated, [None; 3], "{}", motor.key);
            assert!(motor.source.contains("voltage not stated"), "{}", motor.key);
            "not stated".to_owned()
        };
        *counts.entry(said).or_insert(0) += 1;
    }
    let expected = [
        ("100 V AC", 9),
        ("115 V AC", 3),
        ("200 V AC", 44),
        ("230 V AC", 3),
        ("380 V AC", 25),
        ("400 V AC", 1),
        ("not stated", 84),
    ];
    let expected = expected.map(|(said, count)| (said.to_owned(), count));
    assert_eq!(counts, BTreeMap::from(expected));
    let others = catalogue.motors.iter().filter(|motor| !motor.from_maker);
    assert_eq!(others.count(), 26 + 27 + 17 + 6 + 3);
}

#[test]
fn the_built_in_brake_resistors() {
    let catalogue = built_in();
    let found: Vec<[f64; 2]> = catalogue
        .resistors
        .iter()
        .map(|r| [r.resistance, r.rated_power])
        .collect();
    let mut expected = [10.0, 18.0, 23.0, 33.0, 47.0]
        .map(|ohm| [ohm, 450.0])
        .to_vec();
    expected.extend([
        [50.0, 20.0],
        [100.0, 20.0],
        [47.0, 70.0],
        [47.0, 70.0],
        [20.0, 180.0],
        // ABB: SACE and JBR of ACSM1.
        [120.0, 105.0],
        [80.0, 135.0],
        [40.0, 360.0],
        [20.0, 570.0],
        [13.0, 790.0],
        [4.0, 2200.0],
        [44.0, 1000.0],
        [22.0, 2000.0],
        [13.0, 2000.0],
    ]);
    assert_eq!(found, expected);
    assert!(
        catalogue
            .resistors
            .iter()
            .all(|r| r.from_maker && r.source.len() > 20)
    );
}
