//! Shares of the rated rise if only S1 torques are known: p = T²/M₀² + max(0, 1 − S1(n)²/M₀²).

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::operation::Operation;
use jred_file::model::site::Site;
use jred_file::model::surroundings::Surroundings;
use jred_sizing::catalogue::{Motor, Thermal};
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::thermal::loss_curve::PeakRise;
use jred_sizing::thermal::network::Losses;
use jred_sizing::thermal::{Load, Model, allowed_rise};

use super::near;
use crate::direct;
use crate::support::press_text;

/// The press cycle takes half a second: a motor with a time constant of minutes has the mean of p, one without a time constant exactly. From cold,
/// after a time t the rise is that of one body, mean·(1 − e^(−t/τ)).
#[test]
fn the_rise_is_the_mean_of_the_shares() {
    let file = checked::parse("press.toml", &press_text(), Path::new("")).unwrap();
    let cycle = Cycle::new(&Duty::new(&file, file.motion.as_ref().unwrap(), 1000).unwrap());
    let motor = |time| Motor {
        rated_torque: Some(30.0),
        standstill_torque: Some(50.0),
        rated_speed: Some(8.0),
        max_speed: Some(400.0),
        peak_torque: Some(400.0),
        rotor_inertia: 0.01,
        thermal: Thermal {
            housing_time: time,
            ..Thermal::default()
        },
        ..Motor::default()
    };
    let mean = |motor: &Motor, prepared: &MotorLimits| {
        let drive = direct(motor);
        let [mut sum, mut less] = [0.0; 2];
        for sample in cycle.samples() {
            let torque = drive.coefficients().torque(&sample.loads()) / 50.0;
            let s1 = prepared.envelope.continuous_torque(sample.speed()) / 50.0;
            sum += sample.weight * (torque * torque + (1.0 - s1 * s1).max(0.0));
            less += sample.weight * torque * torque;
        }
        [sum, less].map(|sum| sum / cycle.duration())
    };
    for time in [None, Some(300.0)] {
        let motor = motor(time);
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        let drive = direct(&motor);
        let coefficients = drive.coefficients();
        let load = Load {
            cycle: &cycle,
            coefficients: &coefficients,
            ratio: 1.0,
            motor: &motor,
            prepared: &prepared,
        };
        let [mean, of_torque] = mean(&motor, &prepared);
        assert!(
            mean > 1.2 * of_torque,
            "the S1 torque falls: {mean} {of_torque}"
        );
        let surroundings = Surroundings::default();
        let model = Model::of(&motor, &prepared, &surroundings, cycle.duration())
            .ok()
            .unwrap();
        let rise = |operation: &Operation| {
            let heating = model.heating(&load, operation, Losses::default()).ok()?;
            assert!(heating.relative && !heating.housing);
            assert_eq!(heating.ripple, time.is_some());
            match heating.hottest {
                PeakRise::Rise([rise, _]) => Some(rise),
                PeakRise::Runaway => panic!("runaway"),
            }
        };
        // The ripple of half a second in 300 s, and linear interpolation between samples.
        near("S1", rise(&Operation::Continuous).unwrap(), mean, 3e-3);
        let short = rise(&Operation::Short { operating: 120.0 });
        assert_eq!(short.is_some(), time.is_some());
        if let Some(short) = short {
            near("S2", short, mean * -(-120.0f64 / 300.0).exp_m1(), 3e-3);
        }
    }
}

/// Up to the largest temperature, at least 40 °C below it for the rated rise; 1 % less for every 100 m above 1000 m. Without a known temperature: the
/// rated rise in an ambient of 40 °C at most.
#[test]
fn the_rise_that_is_allowed() {
    let motor = |limit| Motor {
        thermal: Thermal {
            max_temperature: limit,
            ..Thermal::default()
        },
        ..Motor::default()
    };
    let at = |ambient, altitude| Surroundings {
        ambient,
        altitude,
        ..Surroundings::default()
    };
    let warm = motor(Some(155.0));
    for (surroundings, kelvins) in [
        (at(40.0, 0.0), 115.0),
        (at(60.0, 500.0), 95.0),
        (at(20.0, 2000.0), 0.9 * 135.0),
    ] {
        near(
            "K",
            allowed_rise(&warm, &surroundings, false).unwrap(),
            kelvins,
            1e-12,
        );
        near(
            "share",
            allowed_rise(&warm, &surroundings, true).unwrap(),
            kelvins / 115.0,
            1e-12,
        );
    }
    // A limit at or below the reference gives no rated rise.
    for unknown in [motor(None), motor(Some(40.0)), motor(Some(30.0))] {
        near(
            "share",
            allowed_rise(&unknown, &at(40.0, 3000.0), true).unwrap(),
            0.8,
            1e-12,
        );
        // Above the reference the S1 torque is reduced: the rise stays the rated one.
        assert_eq!(allowed_rise(&unknown, &at(40.5, 0.0), true), Some(1.0));
        near("S1", unknown.derated(&at(40.5, 0.0)).factor, 0.995, 1e-12);
    }
    assert_eq!(allowed_rise(&motor(None), &at(20.0, 0.0), false), None);
}
