//! Curves below the limits of motors of every kind: never above, and not needlessly low.

use jred::duty::{Curve, MAX_POINTS};
use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Catalogue, Motor, Winding};
use jred_sizing::meter::{LowerCurve, continuous, peak};
use jred_sizing::motor::envelope::Envelope;
use proptest::prelude::*;

use crate::support::budget;

const SPEEDS: u32 = 10_000;

/// Checks a curve against the limit at many speeds, its own points and their neighbours.
fn holds(what: &str, curve: &LowerCurve, end: f64, limit: impl Fn(f64) -> f64) {
    assert!((1..=MAX_POINTS).contains(&curve.points.len()), "{curve:?}");
    let read = Curve::new(&curve.points).unwrap();
    let even = (0..SPEEDS).map(|k| (1.01 * end * f64::from(k) / f64::from(SPEEDS)) as f32);
    let own = curve.points.iter();
    let own = own.flat_map(|[speed, _]| [speed.next_down(), *speed, speed.next_up()]);
    let (mut most, mut largest, mut missed) = (f64::INFINITY, 0.0f64, 0.0f64);
    let mut speeds: Vec<f32> = even.chain(own).filter(|speed| *speed >= 0.0).collect();
    speeds.sort_by(f32::total_cmp);
    for speed in speeds {
        let (found, exact) = (f64::from(read.at(speed)), limit(f64::from(speed)));
        assert!(
            found <= exact,
            "{what}: {found} above {exact} at {speed} of {end}, {curve:?}"
        );
        // A limit that is not finite is not checked.
        if exact.is_finite() {
            most = most.min(exact);
            largest = largest.max(most);
            missed = missed.max(most - found);
        }
    }
    let stated = curve.shortfall + budget::METER_BETWEEN;
    assert!(
        missed <= stated * largest,
        "{what}: {} of the largest torque below, {stated} allowed, {curve:?}",
        missed / largest
    );
    assert!(
        curve.shortfall <= budget::METER_SHORTFALL,
        "{what}: {curve:?}"
    );
}

fn every_curve(what: &str, motor: &Motor) {
    let envelope = Envelope::of(motor);
    let end = envelope.max_speed().min(jred::duty::MOST_SPEED);
    for share in [0.8, 1.0] {
        if let Some(curve) = continuous(&envelope, share) {
            let limit = |speed| share * envelope.continuous_torque(speed);
            holds(&format!("{what}, S1"), &curve, end, limit);
        } else {
            assert!(
                envelope.continuous_torque(0.5 * end).is_infinite(),
                "{what}"
            );
        }
        if let Some(curve) = peak(&envelope, share) {
            let of = |sign, speed| envelope.peak_torque(sign, speed);
            let limit = |speed| share * of(1.0, speed).min(of(-1.0, speed));
            holds(&format!("{what}, peak"), &curve, end, limit);
        } else {
            assert!(envelope.peak_torque(1.0, 0.5 * end).is_infinite(), "{what}");
        }
    }
}

#[test]
fn motors_of_the_catalogue() {
    for motor in &Catalogue::load(None, None).unwrap().motors {
        every_curve(&motor.key, motor);
    }
}

fn motor() -> impl Strategy<Value = Motor> {
    let points = || prop::collection::vec((1e-3..1.0f64, 0.0..1.0f64), 1..9);
    let s1 = prop_oneof![
        (0.1..1.0f64, 0.3..1.2f64, 0.05..1.0f64).prop_map(|(standstill, share, speed)| Motor {
            standstill_torque: Some(standstill),
            rated_torque: Some(share * standstill),
            rated_speed: Some(300.0 * speed),
            ..Motor::default()
        }),
        (points(), proptest::option::of(0.1..2.0f64)).prop_map(|(steps, standstill)| Motor {
            continuous_curve: falling(&steps, 1.0),
            standstill_torque: standstill,
            ..Motor::default()
        }),
    ];
    let short = prop_oneof![
        (0.2..4.0f64, 0.05..1.0f64, 0.0..1.0f64)
            .prop_map(|(peak, corner, share)| Motor {
                peak_torque: Some(peak),
                max_speed: Some(300.0),
                corner_speed: Some(300.0 * corner),
                torque_at_max_speed: Some(share * peak),
                ..Motor::default()
            })
            .boxed(),
        points()
            .prop_map(|steps| Motor {
                peak_curve: falling(&steps, 4.0),
                ..Motor::default()
            })
            .boxed(),
        (
            (0.05..2.0f64, 0.0..0.02f64, any::<bool>()),
            proptest::option::of(0.3..3.0f64),
        )
            .prop_map(|((resistance, inductance, block), speed)| Motor {
                peak_torque: Some(4.0),
                bus_voltage: Some(96.0),
                max_speed: speed.map(|share| share * 300.0),
                winding: Winding {
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
                },
                ..Motor::default()
            })
            .boxed(),
        Just(Motor::default()).boxed(),
    ];
    (s1, short, proptest::option::of(10.0..300.0f64)).prop_map(|(s1, short, power)| Motor {
        standstill_torque: s1.standstill_torque,
        rated_torque: s1.rated_torque,
        rated_speed: s1.rated_speed,
        continuous_curve: s1.continuous_curve,
        max_power: power,
        ..short
    })
}

fn falling(steps: &[(f64, f64)], mut torque: f64) -> Vec<[f64; 2]> {
    let mut speed = 0.0;
    let mut points = vec![[speed, torque]];
    for (step, drop) in steps {
        speed += 60.0 * step;
        torque *= 1.0 - 0.6 * drop;
        points.push([speed, torque]);
    }
    points
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 100,
        rng_seed: proptest::test_runner::RngSeed::Fixed(0x5eed_0017),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn motors_of_every_kind(motor in motor()) {
        every_curve("random", &motor);
    }
}

/// A curve of straight lines is matched at its knees: only roundings remain.
#[test]
fn straight_lines_are_met_in_their_knees() {
    let points = vec![[0.0, 3.0], [100.3, 2.5], [200.7, 1.0]];
    let motor = Motor {
        peak_curve: points
            .iter()
            .map(|[speed, torque]| [*speed, 2.0 * torque])
            .collect(),
        continuous_curve: points.clone(),
        max_speed: Some(200.7),
        ..Motor::default()
    };
    let envelope = Envelope::of(&motor);
    for (curve, scale) in [
        (continuous(&envelope, 1.0), 1.0),
        (peak(&envelope, 1.0), 2.0),
    ] {
        let curve = curve.unwrap();
        assert!(curve.shortfall < 1e-5, "{curve:?}");
        for [speed, torque] in &points {
            let near = |p: &&[f32; 2]| (f64::from(p[0]) - speed).abs() < 1e-4;
            let found = curve.points.iter().find(near);
            let found = found.map_or(scale * torque, |point| f64::from(point[1]));
            assert!((found - scale * torque).abs() < 1e-4, "{curve:?}");
        }
    }
}

/// A motor rated near rest: its constant power falls to a tenth between two possible points.
#[test]
fn constant_power_from_a_low_speed_on() {
    for (torque, rated_speed) in [(20.0, 0.5), (20.0, 4.0), (0.02, 1.0)] {
        let motor = Motor {
            rated_torque: Some(torque),
            rated_speed: Some(rated_speed),
            max_speed: Some(300.0),
            ..Motor::default()
        };
        let envelope = Envelope::of(&motor);
        let curve = continuous(&envelope, 1.0).unwrap();
        holds("low", &curve, 300.0, |speed| {
            envelope.continuous_torque(speed)
        });
    }
}
