//! The catalogue: what is built in, how a user's own is read, and which drives it gives.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod broken;
mod contradictions;
mod database;
mod format;
mod pairing;
mod plausible;
mod spreadsheet;

use std::collections::BTreeSet;

use jred_machine::units::RPM;
use jred_sizing::catalogue::Catalogue;

fn built_in() -> Catalogue {
    Catalogue::load(None, None).unwrap()
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
        assert!((50.0..20e3).contains(&power), "{key}: {power} W");
        let rpm = rated_speed / RPM;
        assert!((500.0..6001.0).contains(&rpm), "{key}: {rpm} rpm");
        let overload = peak_torque / rated_torque;
        assert!(
            (1.5..10.0).contains(&overload),
            "{key}: peak/rated {overload}"
        );
        if let Some(standstill) = motor.standstill_torque {
            let share = standstill / rated_torque;
            assert!((1.0..2.0).contains(&share), "{key}: M0/Mn {share}");
            assert!(standstill < peak_torque, "{key}");
        }
        // Rotors grow with the torque to the power 5/3 (similar shape); makers differ by a factor of ten.
        let slimness = motor.rotor_inertia / peak_torque.powf(5.0 / 3.0);
        assert!((5e-7..2e-5).contains(&slimness), "{key}: {slimness:e}");
        // Time to accelerate the bare rotor to rated speed at peak torque.
        let time = motor.rotor_inertia * rated_speed / peak_torque;
        assert!((1e-3..0.2).contains(&time), "{key}: {time} s");
        if let Some(mass) = motor.mass {
            assert!((0.2..20.0).contains(&(rated_torque / mass)), "{key}");
        }
    }
    // Torque constants are stated at 20 °C or 100 °C, torques with hot windings.
    let currents = catalogue.motors.iter().filter_map(|motor| {
        let winding = &motor.winding;
        let given = winding.torque_constant.zip(winding.rated_current);
        given.map(|(k_t, i)| (&motor.key, k_t * i / motor.rated_torque.unwrap()))
    });
    let currents: Vec<_> = currents.collect();
    assert_eq!(currents.len(), 12);
    for (key, share) in currents {
        assert!((0.95..1.35).contains(&share), "{key}: {share}");
    }
    let keys: BTreeSet<&str> = catalogue.gearboxes.iter().map(|g| g.key.as_str()).collect();
    assert_eq!(keys.len(), catalogue.gearboxes.len());
    for gearbox in &catalogue.gearboxes {
        let key = &gearbox.key;
        assert!(gearbox.source.len() > 20, "{key}");
        assert!((2.0..=200.0).contains(&gearbox.ratio), "{key}");
        assert!((0.8..1.0).contains(&gearbox.efficiency), "{key}");
        if let Some(rated) = gearbox.rated_torque {
            let overload = gearbox.peak_torque.unwrap() / rated;
            assert!((1.0..4.0).contains(&overload), "{key}: {overload}");
        }
        if let Some(speed) = gearbox.rated_speed {
            assert!(speed < gearbox.max_speed.unwrap(), "{key}");
        }
        assert!((1e-6..1e-2).contains(&gearbox.inertia), "{key}");
        if let (Some(stiffness), Some(torque)) = (gearbox.stiffness, gearbox.rated_torque) {
            // The rated torque twists a planetary gearbox by some arcminutes.
            let twist = (torque / stiffness).to_degrees() * 60.0;
            assert!((3.0..10.0).contains(&twist), "{key}: {twist} arcmin");
        }
        // The ratio is part of the type designation.
        assert!(
            gearbox.model.contains(&format!("i={}", gearbox.ratio)),
            "{key}: {}",
            gearbox.model
        );
    }
}

#[test]
fn the_built_in_brake_resistors() {
    let catalogue = built_in();
    let found: Vec<[f64; 2]> = catalogue
        .resistors
        .iter()
        .map(|r| [r.resistance, r.rated_power])
        .collect();
    let expected = [10.0, 18.0, 23.0, 33.0, 47.0].map(|ohm| [ohm, 450.0]);
    assert_eq!(found, expected);
    assert!(
        catalogue
            .resistors
            .iter()
            .all(|r| r.from_maker && r.source.len() > 20)
    );
}
