//! The flywheel that a steady cycle needs, on each shaft.

use jred_analysis::steady::SteadyError;

use super::{checked, of, try_of, unbalanced_rotor};
use crate::support::{budget, edited, near, press_text};

/// The flywheel for δ against bisection over files with a flywheel written into them.
#[test]
fn the_flywheel_is_that_of_a_search_by_hand() {
    let press = press_text();
    let wanted = 0.02;
    let found = checked(try_of(&press, Some(wanted)));
    let flywheel = found.flywheel.unwrap();
    near(
        "delta",
        flywheel.cycle.figures.delta,
        wanted,
        budget::STEADY_FLYWHEEL,
    );
    let own = found.cycle.unwrap().figures.delta;
    assert!(own > 2.0 * wanted, "{own}");
    let with = |inertia: f64| {
        edited(
            &press,
            "\"0.05 kg m^2\"",
            &format!("\"{:?} kg m^2\"", 0.05 + inertia),
        )
    };
    let delta = |inertia: f64| of(&with(inertia)).cycle.unwrap().figures.delta;
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if delta(middle) > wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    near("inertia", flywheel.inertia, 0.5 * (low + high), 1e-5);
    // The classical value is of the same size, and not the same.
    let ratio = flywheel.classical.inertia / flywheel.inertia;
    assert!(
        (0.5..2.0).contains(&ratio) && (ratio - 1.0).abs() > 1e-3,
        "{ratio}"
    );
}

/// Each shaft of the press's drive train needs the flywheel that a search by hand finds there: with the losses of a stage in between it is not that on the drive
/// link by the squared ratio, and without losses it is.
#[test]
fn a_flywheel_on_each_shaft() {
    let press = press_text();
    let wanted = 0.02;
    let driver = "driver = { radius = \"40 mm\", inertia = \"0.0006 kg m^2\" }";
    let with = |text: &str, inertia: f64| {
        let there = driver.replace("0.0006", &format!("{:?}", 0.0006 + inertia));
        of(&edited(text, driver, &there)).cycle.unwrap().figures
    };
    let lossless = edited(&press, "efficiency = \"97 %\"", "efficiency = \"100 %\"");
    for (text, by_ratio) in [(&lossless, true), (&press, false)] {
        let found = checked(try_of(text, Some(wanted))).flywheel.unwrap();
        let [motor, link] = found.places.as_slice() else {
            panic!("{:?}", found.places);
        };
        assert_eq!([motor.shaft, link.shaft], [0, 1]);
        let [motor, link] = [motor, link].map(|place| place.wheel.as_ref().unwrap());
        let there = with(text, motor.inertia);
        near("delta", there.delta, wanted, budget::STEADY_FLYWHEEL);
        near("RMS", motor.motor_torque.rms, there.motor_torque.rms, 1e-9);
        near("losses", motor.losses, there.energy.losses, 1e-9);
        near("speed", motor.speed, 3.0 * there.mean_speed, 1e-9);
        near(
            "energy",
            motor.stored,
            0.5 * motor.inertia * motor.speed.powi(2),
            1e-12,
        );
        let share = 9.0 * motor.inertia / link.inertia;
        assert_eq!((share - 1.0).abs() < 1e-7, by_ratio, "{share}");
        assert!((share - 1.0).abs() < 0.1, "{share}");
        near("drive link", link.inertia, found.inertia, 1e-15);
        near(
            "motor",
            found.inertia_at_motor.unwrap(),
            motor.inertia,
            1e-15,
        );
        // In front of the belt the flywheel leaves the peaks to it; behind it, it takes them.
        assert!(
            motor.delivered[0] > 2.0 * link.delivered[0],
            "{motor:?} {link:?}"
        );
    }
}

/// Two stages: without losses each shaft needs the same flywheel by its squared ratio, and what a stage delivers is the torque of the motor less what the shafts
/// in front of it take, by the ratio.
#[test]
fn a_flywheel_between_two_stages() {
    let text = &unbalanced_rotor(
        "0.01 kg m^2",
        "[[load]]\non = \"rotor\"\nopposing_moment = \"5 N m\"\n\
        [[drive_train]]\ntype = \"gear-train\"\nstage = [\n\
        { driver = { teeth = 20, inertia = \"0 kg m^2\" }, driven = { teeth = 40, inertia = \"0 kg m^2\" } },\n\
        { driver = { teeth = 20, inertia = \"0 kg m^2\" }, driven = { teeth = 60, inertia = \"0 kg m^2\" } }]",
        "dc_motor = { no_load_speed = \"240 rad/s\", stall_torque = \"4 N m\" }",
    );
    let flywheel = checked(try_of(text, Some(0.02))).flywheel.unwrap();
    let places = flywheel.places.iter();
    let places: Vec<_> = places.map(|place| place.wheel.as_ref().unwrap()).collect();
    let ratios = [6.0, 3.0, 1.0];
    assert_eq!(places.len(), 3);
    for (place, ratio) in places.iter().zip(ratios) {
        near(
            "inertia",
            place.inertia * ratio * ratio,
            flywheel.inertia,
            1e-7,
        );
        near("stored", place.stored, places[2].stored, 1e-7);
    }
    // On the drive link the motor alone drives both stages, without inertia in between.
    let peak = places[2].motor_torque.peak;
    near("stage 1", places[2].delivered[0], 2.0 * peak, 1e-4);
    near("stage 2", places[2].delivered[1], 6.0 * peak, 1e-4);
    // Between them, the first stage alone.
    near(
        "stage 1",
        places[1].delivered[0],
        2.0 * places[1].motor_torque.peak,
        1e-4,
    );
    assert!(
        places[1].delivered[1] > 1.5 * places[2].delivered[1],
        "{places:?}"
    );
}

/// Where a motor hardly reacts to the speed and δ is small, the classical method is right: the exact inertia approaches it.
#[test]
fn the_classical_flywheel_is_the_limit_of_a_soft_motor() {
    let text = &unbalanced_rotor(
        "0.01 kg m^2",
        "[[load]]\non = \"rotor\"\nopposing_moment = \"5 N m\"",
        "at = \"crank\"\n\
        dc_motor = { no_load_speed = \"4000 rad/s\", stall_torque = \"5.05 N m\" }",
    );
    let found = checked(try_of(text, Some(0.001)));
    let flywheel = found.flywheel.unwrap();
    // ΔW = 2·m·g·r, ω = 4000·(1 − 5/5.05)
    let classical = flywheel.classical;
    near("work", classical.work, 2.0 * 20.0 * 9.81 * 0.1, 1e-9);
    near("speed", classical.speed, 4000.0 * (1.0 - 5.0 / 5.05), 1e-4);
    near("own", classical.own, 0.01 + 0.2, 1e-12);
    near(
        "inertia",
        flywheel.inertia + classical.own,
        classical.total,
        1e-5,
    );
}

/// So it is behind a drive train with losses: the motor feeds them all the time, and no flywheel stores them.
#[test]
fn losses_of_a_drive_train_are_in_no_flywheel() {
    let text = &unbalanced_rotor(
        "0.01 kg m^2",
        "[[load]]\non = \"rotor\"\nopposing_moment = \"5 N m\"\n\
        [[drive_train]]\ntype = \"belt\"\ndriver = { radius = \"40 mm\", inertia = \"0 kg m^2\" }\n\
        driven = { radius = \"80 mm\", inertia = \"0 kg m^2\" }\nefficiency = \"80 %\"",
        "at = \"motor\"\n\
        dc_motor = { no_load_speed = \"8000 rad/s\", stall_torque = \"3.15625 N m\" }",
    );
    let flywheel = checked(try_of(text, Some(0.001))).flywheel.unwrap();
    let classical = flywheel.classical;
    near("work", classical.work, 2.0 * 20.0 * 9.81 * 0.1, 1e-9);
    near(
        "speed",
        classical.speed,
        4000.0 * (1.0 - 3.125 / 3.15625),
        1e-4,
    );
    let exact = flywheel.inertia + classical.own;
    near("inertia", exact, classical.total, 1e-4);
    // In front of the belt a flywheel gives and takes its energy through it, each time with losses, which this motor does not cover.
    let why = flywheel.places[0].no_flywheel.as_ref().unwrap();
    let stops = matches!(why, SteadyError::NoFlywheel { reached: None, .. });
    assert!(stops, "{why:?}");
}
