//! Arbitrary figures: no panic, no NaN.

use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Motor, Winding};
use jred_sizing::motor::envelope::{Envelope, MotorLimits};
use proptest::prelude::*;

use super::{amplifier, bare, site};

fn odd() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(-0.0),
        Just(f64::INFINITY),
        Just(f64::NEG_INFINITY),
        Just(f64::NAN),
        Just(f64::MIN_POSITIVE),
        Just(f64::MAX),
        Just(1e300),
        Just(1e-300),
        -10.0f64..10.0,
        1e-3f64..1e3,
        any::<f64>(),
    ]
}

fn maybe() -> impl Strategy<Value = Option<f64>> {
    proptest::option::weighted(0.8, odd())
}

fn points() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop_oneof![
        2 => Just(Vec::new()),
        1 => proptest::collection::vec([odd(), odd()], 0..5),
    ]
}

fn motors() -> impl Strategy<Value = Motor> {
    (
        [maybe(), maybe(), maybe(), maybe(), maybe(), maybe()],
        [maybe(), maybe(), maybe(), maybe(), maybe(), maybe()],
        [maybe(), maybe(), maybe(), maybe()],
        [points(), points()],
        any::<bool>(),
    )
        .prop_map(|(a, b, c, [peak, continuous], sine)| Motor {
            rated_torque: a[0],
            rated_speed: a[1],
            standstill_torque: a[2],
            peak_torque: a[3],
            max_speed: a[4],
            max_power: a[5],
            corner_speed: c[0],
            torque_at_max_speed: c[1],
            bus_voltage: c[2],
            peak_curve: peak,
            continuous_curve: continuous,
            winding: Winding {
                commutation: if sine {
                    Commutation::Sine
                } else {
                    Commutation::Block
                },
                torque_constant: b[0],
                voltage_constant: b[1],
                resistance: b[2],
                inductance: b[3],
                pole_pairs: b[4],
                peak_current: b[5],
                ..Winding::default()
            },
            ..bare()
        })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4000,
        rng_seed: proptest::test_runner::RngSeed::Fixed(0x5eed_00b2),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    #[ignore = "more than five seconds of a processor"]
    fn no_figures_make_a_nan(
        motor in motors(),
        current in odd(),
        bus in odd(),
        amplified in any::<bool>(),
        speeds in proptest::collection::vec(odd(), 4),
        torque in odd(),
    ) {
        let amplifier = amplifier(current, Some(bus));
        let prepared = MotorLimits::new(&motor, amplified.then_some(&amplifier), &site(bus));
        let envelope = &prepared.envelope;
        let own = [0.0, 0.5, 1.0].map(|share| share * envelope.max_speed());
        let ends = [false, true].map(|braking| envelope.limit(braking).pieces().to_vec()).concat();
        let ends = ends.iter().flat_map(|p| [p.from, p.to]);
        for speed in speeds.into_iter().chain(own).chain(ends).filter(|n| !n.is_nan()) {
            for sign in [1.0, -1.0] {
                let peak = envelope.peak_torque(sign, speed);
                prop_assert!(peak >= 0.0, "peak {peak} at {speed}: {envelope:?}");
            }
            let s1 = envelope.continuous_torque(speed);
            prop_assert!(s1 >= 0.0, "S1 {s1} at {speed}: {envelope:?}");
            if torque.is_finite() && speed.is_finite() {
                let used = envelope.peak_used(torque, speed);
                prop_assert!(used >= 0.0, "use {used} at {speed}: {envelope:?}");
                if let Some(current) = prepared.current(torque, speed) {
                    prop_assert!(current >= 0.0, "{current} A of {torque} at {speed}: {prepared:?}");
                }
            }
        }
        prop_assert!(envelope.max_speed() >= 0.0);
        prop_assert!(envelope.standstill() >= 0.0);
        prop_assert_eq!(Envelope::at(&motor, amplified.then_some(&amplifier), &site(bus)), prepared.envelope);
    }
}

/// Without torque, above the largest speed: zero torque uses 0 of it, any other all of it.
#[test]
fn nothing_uses_nothing_of_no_torque() {
    let motor = Motor {
        peak_torque: Some(8.0),
        max_speed: Some(300.0),
        ..Motor::default()
    };
    let envelope = Envelope::of(&motor);
    for (torque, speed, used) in [
        (0.0, 301.0, 0.0),
        (1.0, 301.0, f64::INFINITY),
        (-1.0, 301.0, f64::INFINITY),
        (0.0, 100.0, 0.0),
        (-2.0, 100.0, 0.25),
        (8.0, 300.0, 1.0),
    ] {
        assert_eq!(envelope.peak_used(torque, speed), used, "{torque} {speed}");
    }
}
