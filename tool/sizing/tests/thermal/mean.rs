//! Mean losses against plain loops over the samples: random cycles, S1 curves of every kind, saturating iron.

use jred_analysis::duty::{Duty, Instant};
use jred_file::model::site::Site;
use jred_file::model::surroundings::Surroundings;
use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Motor, Winding};
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::cycle::{Cycle, LoadSample};
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::thermal::mean::rms_current;
use jred_sizing::thermal::{Load, Model};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

use super::budget;
use crate::cycle::random::{coefficients, duty};

fn runner(cases: u32) -> TestRunner {
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[11; 32]))
}

/// S1 torques: from two figures, from points that fall with any slope, with or without a standstill torque above or below them, and limited by a
/// largest power.
fn continuous() -> impl Strategy<Value = Motor> {
    let figures =
        (0.2..3.0f64, 0.0..1.2f64, 0.0..1.0f64).prop_map(|(standstill, share, speed)| Motor {
            standstill_torque: (speed < 0.9).then_some(standstill),
            rated_torque: Some(share.max(0.1) * standstill),
            rated_speed: (speed > 0.1).then_some(100.0 * speed),
            ..Motor::default()
        });
    let steps = prop::collection::vec((1e-4..1.0f64, 0.0..1.0f64), 1..6);
    let points = (steps, proptest::option::of(0.5..4.0f64)).prop_map(|(steps, standstill)| {
        let (mut speed, mut torque) = (0.0, 3.0);
        let mut points = vec![[speed, torque]];
        for (step, drop) in steps {
            speed += 40.0 * step;
            torque *= 1.0 - drop;
            points.push([speed, torque]);
        }
        Motor {
            standstill_torque: standstill,
            continuous_curve: points,
            ..Motor::default()
        }
    });
    let motors = prop_oneof![2 => figures.boxed(), 2 => points.boxed()];
    (motors, proptest::option::of(0.5..300.0f64)).prop_map(|(mut motor, power)| {
        motor.max_power = power;
        motor
    })
}

/// The same under short-time limits: none, a constant one, a falling one that crosses the S1 torque, the voltage line of a winding.
fn motor() -> impl Strategy<Value = Motor> {
    let limit = prop_oneof![
        2 => Just(None).boxed(),
        2 => (0.3..4.0f64, 0.0..1.0f64, 0.1..1.0f64).prop_map(Some).boxed(),
    ];
    let winding = proptest::option::of((0.05..3.0f64, 0.0..0.02f64, any::<bool>()));
    (continuous(), limit, winding, 0.1..1.5f64).prop_map(|(mut motor, limit, winding, top)| {
        let speed = 100.0 * top;
        match (limit, winding) {
            (Some((peak, share, corner)), _) => {
                motor.peak_torque = Some(peak);
                motor.max_speed = Some(speed);
                motor.corner_speed = Some(corner * speed);
                motor.torque_at_max_speed = Some(share * peak);
            }
            (None, Some((resistance, inductance, block))) => {
                motor.bus_voltage = Some(48.0);
                motor.peak_torque = Some(6.0);
                motor.winding = Winding {
                    torque_constant: Some(0.4),
                    resistance: Some(resistance),
                    inductance: Some(inductance),
                    pole_pairs: Some(4.0),
                    commutation: if block {
                        Commutation::Block
                    } else {
                        Commutation::Sine
                    },
                    ..Winding::default()
                };
            }
            (None, None) => motor.max_speed = (top > 0.4).then_some(speed),
        }
        motor
    })
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, scale: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= budget::PREPARED_CYCLE * scale,
        "{what}: {found:e} instead of {expected:e}, off by {:e} of the scale",
        off / scale
    );
}

#[test]
#[ignore = "more than five seconds of a processor"]
fn relative_losses_are_those_of_a_plain_loop() {
    let every = (duty(), coefficients(), 0.2..300.0, motor());
    let check = |(duty, c, ratio, motor): (_, Coefficients, f64, Motor)| {
        let cycle = Cycle::new(&duty);
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        let envelope = &prepared.envelope;
        // Ratios that stay within the curve, reach its end or exceed it.
        let ratio = ratio / cycle.peak_speed().max(1e-3);
        let model = Model::of(&motor, &prepared, &Surroundings::default(), 1.0);
        let Ok(model @ Model::Relative { standstill, .. }) = model else {
            // A limit of zero torque at standstill.
            prop_assert_eq!(envelope.standstill(), 0.0);
            return Ok(());
        };
        let found = model.mean_losses(&Load {
            cycle: &cycle,
            coefficients: &c,
            ratio,
            motor: &motor,
            prepared: &prepared,
        });
        let (mut copper, mut other, mut weight) = (0.0, 0.0, 0.0);
        for sample in cycle.samples() {
            let root = c.torque(&sample.loads()) / standstill;
            let s1 = envelope.continuous_torque(sample.speed() * ratio) / standstill;
            copper += sample.weight * root * root;
            other += sample.weight * (1.0 - s1 * s1).max(0.0);
            weight += sample.weight;
        }
        let largest = super::brute::scale(&cycle, &c) / standstill;
        let mean = |sum: f64| sum / cycle.duration();
        near("torque", found.copper, mean(copper), largest * largest);
        near("speed", found.other, mean(other), mean(weight));
        Ok(())
    };
    runner(12_000).run(&every, check).unwrap();
}

/// A constant S1 torque loses nothing with speed: the mean is (T_rms/M₀)², as in the rule for the RMS torque.
#[test]
fn a_level_s1_torque_leaves_the_rms() {
    let check = |(duty, c): (_, Coefficients)| {
        let cycle = Cycle::new(&duty);
        let motor = Motor {
            rated_torque: Some(2.0),
            ..Motor::default()
        };
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        let model = Model::of(&motor, &prepared, &Surroundings::default(), 1.0).unwrap();
        let found = model.mean_losses(&Load {
            cycle: &cycle,
            coefficients: &c,
            ratio: 3.0,
            motor: &motor,
            prepared: &prepared,
        });
        let share = cycle.rms_torque(&c) / 2.0;
        prop_assert_eq!([found.copper, found.other], [share * share, 0.0]);
        Ok(())
    };
    runner(200).run(&(duty(), coefficients()), check).unwrap();
}

/// A torque constant that saturates from some share of the largest torque on, with and without field weakening.
#[test]
fn rms_currents_are_those_of_a_plain_loop() {
    let every = (
        duty(),
        coefficients(),
        (0.0..1.5f64, 1.01..3.0f64, 1.0..10.0f64),
        proptest::option::of(0.2..2.0f64),
    );
    let check = |(duty, c, (knee, steep, slope), top): (_, Coefficients, _, Option<f64>)| {
        let cycle = Cycle::new(&duty);
        let peak = cycle.peak_torque(&c);
        if peak == 0.0 || knee * peak < 1e-12 {
            return Ok(());
        }
        let motor = Motor {
            rated_torque: Some(knee * peak),
            peak_torque: Some(2.0 * peak),
            // Above the no-load speed of some.
            max_speed: top.map(|top| top * 48.0 / slope),
            bus_voltage: Some(48.0),
            winding: Winding {
                torque_constant: Some(slope),
                peak_current: Some(2.0 * peak * steep / slope),
                resistance: Some(0.1 * slope / peak),
                inductance: Some(0.01 * slope / peak),
                pole_pairs: Some(2.0),
                ..Winding::default()
            },
            ..Motor::default()
        };
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        let ratio = 24.0 / slope / cycle.peak_speed().max(1e-3);
        let found = rms_current(&cycle, &c, ratio, &prepared).unwrap();
        let (mut squares, mut largest) = (0.0, 0.0f64);
        for sample in cycle.samples() {
            let torque = c.torque(&sample.loads());
            let current = prepared.current(torque, sample.speed() * ratio).unwrap();
            squares += sample.weight * current * current;
            largest = largest.max(current);
        }
        let scale = largest + steep / slope * super::brute::scale(&cycle, &c);
        near("current", found, (squares / cycle.duration()).sqrt(), scale);
        Ok(())
    };
    runner(4000).run(&every, check).unwrap();
}

/// An instant without a weight, at which no amplifier could supply the current, does not change the mean.
#[test]
fn an_instant_without_weight_adds_no_current() {
    let check = |(duty, c): (Duty, Coefficients)| {
        let motor = Motor {
            rated_torque: Some(1.0),
            max_speed: Some(400.0),
            bus_voltage: Some(48.0),
            winding: Winding {
                torque_constant: Some(1.0),
                resistance: Some(0.1),
                inductance: Some(1e-3),
                pole_pairs: Some(2.0),
                peak_current: Some(100.0),
                ..Winding::default()
            },
            ..Motor::default()
        };
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        prop_assert!(prepared.circuit.as_ref().is_some_and(|c| c.weakens));
        let mut more = duty.clone();
        let instant = Instant {
            weight: 0.0,
            input_torque: 1e200,
            ..duty.instants[0]
        };
        more.instants.push(instant);
        let [found, with] =
            [&duty, &more].map(|duty| rms_current(&Cycle::new(duty), &c, 1.0, &prepared).unwrap());
        prop_assert!(found.is_finite());
        prop_assert_eq!(found, with);
        Ok(())
    };
    runner(100).run(&(duty(), coefficients()), check).unwrap();
}

/// The search for the largest current with field weakening finds what a look at every sample finds.
#[test]
fn the_largest_weakened_current_is_that_of_every_sample() {
    let check = |((duty, c), ratio): ((Duty, Coefficients), f64)| {
        let cycle = Cycle::new(&duty);
        let loads = cycle.samples().iter();
        let [torque, speed] = loads.fold([1e-3_f64; 2], |[torque, speed], sample| {
            let one = c.torque(&sample.loads()).abs();
            [torque.max(one), speed.max(ratio * sample.speed().abs())]
        });
        // The induced voltage passes 48 V at half the largest speed.
        let flux = 48.0 / speed;
        let motor = Motor {
            rated_torque: Some(0.5 * torque),
            max_speed: Some(2.0 * speed),
            bus_voltage: Some(48.0),
            winding: Winding {
                torque_constant: Some(flux),
                resistance: Some(0.05 * 48.0 * flux / torque),
                inductance: Some(0.1 * 48.0 * flux / torque / speed),
                pole_pairs: Some(2.0),
                peak_current: Some(2.0 * torque / flux),
                ..Winding::default()
            },
            ..Motor::default()
        };
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        prop_assert!(prepared.circuit.as_ref().is_some_and(|c| c.weakens));
        let current = |sample: &LoadSample| {
            (prepared.current(c.torque(&sample.loads()), sample.speed() * ratio)).unwrap()
        };
        let most = cycle.samples().iter().map(current).fold(0.0, f64::max);
        let found = cycle.peak_current(&c, ratio, &prepared);
        prop_assert!((found - most).abs() <= 1e-12 * most, "{found} {most}");
        Ok(())
    };
    let inputs = ((duty(), coefficients()), 0.1..100.0);
    runner(1000).run(&inputs, check).unwrap();
}

/// An S1 curve of one point at rest is constant over the speed.
#[test]
fn a_curve_of_one_point_is_level() {
    let check = |(duty, c): (Duty, Coefficients)| {
        let motor = Motor {
            continuous_curve: vec![[0.0, 3.0]],
            ..Motor::default()
        };
        let cycle = Cycle::new(&duty);
        let prepared = MotorLimits::new(&motor, None, &Site::default());
        let model = Model::of(&motor, &prepared, &Surroundings::default(), 1.0).unwrap();
        let load = Load {
            cycle: &cycle,
            coefficients: &c,
            ratio: 2.0,
            motor: &motor,
            prepared: &prepared,
        };
        prop_assert_eq!(model.mean_losses(&load).other, 0.0);
        Ok(())
    };
    runner(20).run(&(duty(), coefficients()), check).unwrap();
}
