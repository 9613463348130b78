//! Coulomb friction that depends on the angle, from a log of both directions.

use std::f64::consts::TAU;

use jred_analysis::identify::{Identified, identify};

use super::plant::{Encoder, Plant, errors, four_bar, log_of, press, reversing};

fn found(plant: &Plant, seed: u64) -> Identified {
    let log = log_of(plant, Encoder::Fine, false, seed, 40.0, reversing);
    let found = identify(&log.samples, &log.options).unwrap();
    assert_eq!(found.faults, [], "a clean log");
    assert!((found.excitation.forward - 0.5).abs() < 0.05);
    let [inertia, inside, torque] = errors(plant, &found);
    println!(
        "J {inertia:.4}, inside {inside:.2}, torque {torque:.4}, {:?}",
        found.coulomb_waves
    );
    assert!(
        inertia < 0.01 && torque < 0.02 && inside > 0.6,
        "{inertia} {torque} {inside}"
    );
    found
}

#[test]
fn friction_over_the_angle_is_found() {
    for mut plant in [press(), four_bar()] {
        plant.coulomb_wave = 0.6 * plant.coulomb;
        let found = found(&plant, 1);
        let outside = found.curves.iter().filter(|point| {
            let off = (point.coulomb.value - plant.friction(point.phi)).abs();
            assert!(off < 0.05 * plant.coulomb, "{off} at {}", point.phi);
            off > point.coulomb.band
        });
        assert!(outside.count() < 150, "c is outside its band");
        assert!(!found.coulomb_waves.is_empty() && found.mean_load.is_some());
    }
}

#[test]
fn constant_friction_stays_one_number() {
    for plant in [press(), four_bar()] {
        let found = found(&plant, 2);
        assert_eq!(found.coulomb_waves, []);
        assert!((found.coulomb.value - plant.coulomb).abs() < 2.0 * found.coulomb.band);
        assert!(
            found
                .curves
                .iter()
                .all(|point| point.coulomb == found.coulomb)
        );
        // As narrow as a number that 40 s at this noise give: a hundredth of c.
        assert!(
            found.coulomb.band < 0.02 * plant.coulomb,
            "{}",
            found.coulomb.band
        );
    }
}

/// 3 s forwards and back have about 620 rows: 35 unknowns with c over the angle need 700, 25 with a constant c need 500.
#[test]
fn a_short_log_has_constant_friction() {
    let plant = Plant {
        cogging: [0.0; 2],
        ..four_bar()
    };
    let there_and_back = |t: f64| {
        let (o, most) = (TAU / 3.0, 3.0 * TAU);
        let (s, c) = (o * t).sin_cos();
        [most / o * (1.0 - c), most * s, most * o * c]
    };
    let mut log = log_of(&plant, Encoder::Fine, false, 1, 3.0, there_and_back);
    log.options.cogging.clear();
    let found = identify(&log.samples, &log.options).unwrap();
    assert!(found.coulomb_waves.is_empty() && found.mean_load.is_some());
}
