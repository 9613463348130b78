//! Coulomb friction that depends on the angle, from a log of both directions.

use std::f64::consts::TAU;

use jred_analysis::identify::{CurvePoint, Identified, identify, without_mean};

use super::plant::{
    Encoder, Log, OTHER, Plant, errors, four_bar, log_of, motion, press, reversing,
};

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

/// A guide's friction follows |x′| and has corners at the dead centres, which eight harmonics round by 7 % of it; the design knows its form, not its size.
#[test]
fn friction_with_the_form_of_the_design_is_found_with_its_corners() {
    let mut plant = press();
    plant.coulomb_corners = 1.5 * plant.coulomb;
    let mut log = log_of(&plant, Encoder::Fine, false, 1, 40.0, reversing);
    let inside = |log: &Log| {
        let found = identify(&log.samples, &log.options).unwrap();
        let off = |p: &CurvePoint| (p.coulomb.value - plant.friction(p.phi)).abs();
        let [inertia, inside, torque] = errors(&plant, &found);
        assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
        let most = found.curves.iter().map(off).fold(0.0, f64::max);
        let of_c = found.curves.iter().filter(|p| off(p) <= p.coulomb.band);
        (most, of_c.count(), inside, found)
    };
    let (rounded, ..) = inside(&log);
    assert!(rounded > 0.06 * plant.coulomb_corners, "{rounded}");
    // Designed with twice the friction.
    let angles = (0..3600).map(|k| f64::from(k) * TAU / 3600.0);
    log.options.friction = angles
        .map(|phi| 1.0 + 3.0 * plant.coulomb * phi.sin().abs())
        .collect();
    let (most, of_c, of_j, found) = inside(&log);
    assert!(most < 0.02 * plant.coulomb_corners, "{most}");
    assert!(of_c > 200 && of_j > 0.6, "{of_c} {of_j}");
    let factor = found.coulomb_shape.unwrap();
    assert!((factor.value - 0.5).abs() < 2.0 * factor.band, "{factor:?}");
    // In one direction it is a part of V′.
    let mut one = log_of(&plant, Encoder::Fine, false, 1, 30.0, |t| {
        motion(t, &OTHER, 1.5 * TAU, 4.0)
    });
    one.options.friction.clone_from(&log.options.friction);
    assert_eq!(
        identify(&one.samples, &one.options).unwrap().coulomb_shape,
        None
    );
}

/// Friction without corners is nearly a sum of the harmonics: as an unknown beside them it would not be determined.
#[test]
fn smooth_friction_of_the_design_is_left_to_the_harmonics() {
    let mut plant = press();
    plant.coulomb_wave = 0.6 * plant.coulomb;
    let mut log = log_of(&plant, Encoder::Fine, false, 1, 40.0, reversing);
    let angles = (0..3600).map(|k| f64::from(k) * TAU / 3600.0);
    log.options.friction = angles.map(|phi| 2.0 + (0.3 * phi.cos()).exp()).collect();
    let found = identify(&log.samples, &log.options).unwrap();
    assert_eq!(found.coulomb_shape, None);
    for point in &found.curves {
        let off = (point.coulomb.value - plant.friction(point.phi)).abs();
        assert!(off < 0.05 * plant.coulomb, "{off} at {}", point.phi);
    }
}

/// The mean of 360 times 0.4 is not 0.4 to the last bit.
#[test]
fn rounding_of_a_constant_is_no_curve() {
    let constant = || (0..360).map(|_| 0.4f64);
    let mean = constant().sum::<f64>() / 360.0;
    assert_ne!(mean.to_bits(), 0.4f64.to_bits());
    assert!(without_mean(constant()).is_empty());
    assert_eq!(without_mean([1.0, 2.0, 6.0].into_iter()), [-2.0, -1.0, 3.0]);
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
