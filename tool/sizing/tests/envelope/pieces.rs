//! Properties of the pieces of a limit.

use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Motor, Winding};
use jred_sizing::motor::envelope::{Curvature, Envelope, Limit, LimitPiece};
use proptest::prelude::*;

use super::{bare, budget};

fn motors() -> impl Strategy<Value = Motor> {
    (
        (0.01f64..5.0, 0.05f64..20.0, 1e-4f64..0.1, 1u32..12),
        (24.0f64..700.0, 0.2f64..40.0, 0.3f64..3.0),
        any::<bool>(),
        any::<bool>(),
        proptest::option::of(1.05f64..2.0),
    )
        .prop_map(|(winding, (bus, peak, speed), sine, weakens, saturates)| {
            let (k_t, resistance, inductance, pairs) = winding;
            let no_load = if sine {
                bus * 3f64.sqrt() / 2f64.sqrt() / k_t
            } else {
                bus / k_t
            };
            Motor {
                rated_torque: Some(0.4 * peak),
                peak_torque: Some(peak),
                max_speed: weakens.then_some(no_load * speed),
                bus_voltage: Some(bus),
                winding: Winding {
                    commutation: if sine {
                        Commutation::Sine
                    } else {
                        Commutation::Block
                    },
                    torque_constant: Some(k_t),
                    resistance: Some(resistance),
                    inductance: Some(inductance),
                    pole_pairs: Some(f64::from(pairs)),
                    peak_current: saturates.map(|more| more * peak / k_t),
                    ..Winding::default()
                },
                ..bare()
            }
        })
}

fn shape_holds(piece: &LimitPiece, scale: f64) -> Result<(), TestCaseError> {
    // Effect of the rounding of the speed on the torque.
    let rise = (piece.torque(piece.to) - piece.torque(piece.from)).abs();
    let rounding = 8.0 * f64::EPSILON * piece.to * rise / (piece.to - piece.from);
    let slack = budget::PIECE_SHAPE * scale + rounding;
    let at = |share: f64| piece.torque(piece.from + share * (piece.to - piece.from));
    for j in 0..40 {
        let [low, high] = [f64::from(j) / 40.0, f64::from(j + 1) / 40.0];
        let [first, middle, last] = [at(low), at(0.5 * (low + high)), at(high)];
        match piece.shape {
            Curvature::Straight => {
                prop_assert!((middle - 0.5 * (first + last)).abs() <= slack);
            }
            Curvature::Concave => {
                prop_assert!(
                    middle >= 0.5 * (first + last) - slack,
                    "{piece:?} {low} {:e}",
                    (0.5 * (first + last) - middle) / scale
                );
            }
            Curvature::Monotone => {
                prop_assert!(middle >= first.min(last) - slack, "{piece:?} {low}");
                let falls = at(1.0) <= at(0.0);
                let along = if falls {
                    last <= first + slack
                } else {
                    last >= first - slack
                };
                prop_assert!(along, "{piece:?} {low}");
            }
        }
    }
    Ok(())
}

fn promises(limit: &Limit, scale: f64, driving: bool) -> Result<(), TestCaseError> {
    let pieces = limit.pieces();
    prop_assert!(
        !pieces.is_empty() && pieces.len() <= 16,
        "{} pieces",
        pieces.len()
    );
    prop_assert_eq!(pieces[0].from, 0.0);
    for pair in pieces.windows(2) {
        prop_assert_eq!(pair[0].to, pair[1].from);
        let [left, right] = [pair[0].torque(pair[0].to), pair[1].torque(pair[1].from)];
        prop_assert!(
            right <= left + budget::PIECE_JOINT * scale,
            "{left} {right}"
        );
    }
    let mut before = f64::INFINITY;
    for piece in pieces {
        shape_holds(piece, scale)?;
        for k in 0..=20 {
            let torque = piece.torque(piece.from + f64::from(k) / 20.0 * (piece.to - piece.from));
            prop_assert!(torque >= 0.0);
            if driving {
                prop_assert!(torque <= before + budget::PIECE_JOINT * scale);
                before = torque;
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        rng_seed: proptest::test_runner::RngSeed::Fixed(0x5eed_000b),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn pieces_join_and_bend_as_they_say(motor in motors()) {
        let envelope = Envelope::of(&motor);
        let scale = motor.peak_torque.unwrap();
        promises(envelope.limit(false), scale, true)?;
        promises(envelope.limit(true), scale, false)?;
    }

    #[test]
    fn braking_reaches_at_least_what_driving_does(motor in motors(), share in 0.0f64..1.0) {
        let envelope = Envelope::of(&motor);
        let speed = share * envelope.max_speed();
        let [driving, braking] = [1.0, -1.0].map(|sign| envelope.peak_torque(sign, speed));
        prop_assert!(braking >= driving * (1.0 - 1e-9), "{braking} {driving}");
    }
}
