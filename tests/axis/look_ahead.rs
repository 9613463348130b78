use core::f64::consts::TAU;

use jred::axis::{AxisError, Braking, Direction, LookAhead, Period};
use jred::machine::Reducible;
use jred::table::Format;
use jred::{Cubic, CurveSet, Domain, Model, Phase, Q31, Scale, Spline, curves};

use super::machine::{WAVE, with_model, with_model_of};
use crate::support::machines::Wave;
use crate::support::{assert_near, scale_of};

pub(super) const SET: CurveSet = curves::LOAD | curves::CONSTANT_COULOMB;
pub(super) const BRAKING: Braking = Braking {
    torque: 8.0,
    deceleration: f32::INFINITY,
    helped: true,
};
/// The wave without the terms that a look-ahead neglects.
pub(super) const INVISCID: Wave = Wave {
    viscous: 0.0,
    ..WAVE
};
/// Fast, except from half to three quarters of the turn.
pub(super) const FAST: f32 = 10.0;
const SLOW: f32 = 3.0;

fn limit(phase: Phase) -> f32 {
    if phase.to_bits() >> 30 == 2 {
        SLOW
    } else {
        FAST
    }
}

pub(super) fn turns(phase: Phase) -> f64 {
    f64::from(phase.to_bits()) / 4_294_967_296.0
}

pub(super) fn with_ahead<F: Format, const NODES: usize>(
    scale: Scale,
    direction: Direction,
    braking: Braking,
    limit: fn(Phase) -> f32,
    with: impl FnOnce(Model<'_, F, SET>, LookAhead<F::Number, NODES>),
) {
    with_model_of::<F, SET>(&INVISCID, scale, |model| {
        let period = Period::new(0.000_5, &model).unwrap();
        let ahead = LookAhead::new(&model, direction, braking, limit, &period).unwrap();
        with(model, ahead);
    });
}

/// Runge-Kutta steps of f(φ, x) from `at` on.
fn stepped(mut x: f64, at: f64, step: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
    let k1 = f(at, x);
    let k2 = f(at + step / 2.0, x + step / 2.0 * k1);
    let k3 = f(at + step / 2.0, x + step / 2.0 * k2);
    let k4 = f(at + step, x + step * k3);
    x += step / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    x
}

/// d(ω²)/dφ of the exact machine under the brake, moving forward.
fn braked(phi: f64, square: f64) -> f64 {
    let reduction = INVISCID.reduction(phi).unwrap();
    2.0 * reduction.acceleration(square.max(1e-12).sqrt(), -8.0)
}

#[test]
fn the_limit_is_what_the_brake_can_do() {
    // Backwards from the slow part in small steps: the exact machine cannot slow down in time from any higher speed. The machine is slow an interval
    // earlier.
    let steps = 100_000;
    let check = |direction, nodes: u32, speed_at: &dyn Fn(Phase) -> f32, slack: f64| {
        let start = TAU / 2.0 - TAU / f64::from(nodes);
        let step = -start / f64::from(steps);
        let mut ideal = vec![f64::from(SLOW * SLOW)];
        for k in 0..steps {
            let square = *ideal.last().unwrap();
            ideal.push(stepped(square, start + f64::from(k) * step, step, braked));
        }
        for k in 0..nodes / 2 {
            let phase = Phase::from_bits(k * (u32::MAX / nodes + 1));
            let phi = turns(phase) * TAU;
            let exact = ideal[((phi - start) / step).round() as usize]
                .sqrt()
                .min(FAST.into());
            // The wave is symmetric.
            let found = match direction {
                Direction::Forward => speed_at(phase),
                Direction::Backward => speed_at(Phase::from_bits(!phase.to_bits())),
            };
            let share = f64::from(found) / exact;
            assert!(
                share < 1.0 + 2e-4,
                "{direction:?} at {phi}: {found}, {exact}"
            );
            assert!(
                share > 1.0 - slack,
                "{direction:?} at {phi}: {found}, {exact}"
            );
        }
    };
    // The slow part, mirrored.
    let mirrored = |phase: Phase| {
        if (!phase.to_bits()) >> 30 == 2 {
            SLOW
        } else {
            FAST
        }
    };
    for (direction, limit) in [
        (Direction::Forward, limit as fn(Phase) -> f32),
        (Direction::Backward, mirrored),
    ] {
        with_ahead::<Cubic<f64>, 64>(Scale::SI, direction, BRAKING, limit, |_, ahead| {
            check(direction, 64, &|phase| ahead.speed_at(phase, FAST), 0.01);
        });
        // Four times as many nodes: at most a quarter of the difference.
        with_ahead::<Cubic<f64>, 256>(Scale::SI, direction, BRAKING, limit, |_, ahead| {
            check(
                direction,
                256,
                &|phase| ahead.speed_at(phase, FAST),
                0.03 / 4.0,
            );
        });
        with_ahead::<Spline<f32>, 64>(Scale::SI, direction, BRAKING, limit, |_, ahead| {
            check(direction, 64, &|phase| ahead.speed_at(phase, FAST), 0.01);
        });
        with_ahead::<Cubic<Q31>, 64>(
            scale_of(250.0, 12.0, 1.5),
            direction,
            BRAKING,
            limit,
            |_, ahead| {
                check(direction, 64, &|phase| ahead.speed_at(phase, FAST), 0.01);
            },
        );
    }
}

#[test]
fn a_slow_part_is_slow_to_its_ends() {
    // Slow parts that begin and end at nodes, between them, at the start of the turn and across it.
    for (from, to) in [
        (0.5, 0.75),
        (0.511, 0.533),
        (0.0, 0.1),
        (0.9, 1.0),
        (0.95, 1.05),
    ] {
        with_model_of::<Spline<f32>, SET>(&INVISCID, Scale::SI, |model| {
            let period = Period::new(0.000_5, &model).unwrap();
            let slow = |phase: Phase| {
                let at = turns(phase);
                (at >= from && at < to) || (at + 1.0 >= from && at + 1.0 < to)
            };
            let limit = |phase| if slow(phase) { SLOW } else { FAST };
            for direction in [Direction::Forward, Direction::Backward] {
                let ahead =
                    LookAhead::<f32, 128>::new(&model, direction, BRAKING, limit, &period).unwrap();
                for k in 0..4096_u32 {
                    let phase = Phase::from_bits(k << 20);
                    let found = ahead.speed_at(phase, FAST);
                    assert!(
                        !slow(phase) || found <= SLOW * 1.000_1,
                        "{from} to {to} at {}: {found}",
                        turns(phase)
                    );
                    assert!(found <= FAST * 1.000_1);
                }
            }
        });
    }
}

#[test]
fn a_deceleration_is_kept() {
    let braking = Braking {
        deceleration: 2.0,
        ..BRAKING
    };
    with_ahead::<Cubic<f64>, 64>(Scale::SI, Direction::Forward, braking, limit, |_, ahead| {
        // Backwards from an interval before half a turn, linear in the square: the deceleration minus the margin for a tick of 0.5 ms.
        let slope = 2.0 * 2.0 * (1.0 - 2.0 * 2.0 * 0.000_5 / f64::from(FAST));
        for k in 16..31_u32 {
            let phi = f64::from(k) / 64.0 * TAU;
            let found = ahead.speed_at(Phase::from_bits(k << 26), FAST);
            let exact = (9.0 + slope * (TAU * 31.0 / 64.0 - phi)).sqrt();
            assert_near(&format!("at {phi}"), found.into(), exact, 1e-4);
        }
    });
}

#[test]
fn a_weak_brake_keeps_what_is_possible_on_a_turn() {
    // J from 0.32 at half a turn to 1.68 at its start. For ω ≤ 10 throughout, the energy at the start must not exceed ½·J·10² plus the brake's work
    // up to there, at any position.
    let wave = Wave {
        swing: 0.68,
        load: 0.0,
        coulomb: 0.0,
        ..INVISCID
    };
    with_model_of::<Cubic<f64>, SET>(&wave, Scale::SI, |model| {
        let period = Period::new(0.000_5, &model).unwrap();
        for torque in [0.1_f32, 1.0, 2.0, 10.0] {
            let braking = Braking { torque, ..BRAKING };
            for direction in [Direction::Forward, Direction::Backward] {
                let ahead =
                    LookAhead::<f64, 64>::new(&model, direction, braking, |_| FAST, &period)
                        .unwrap();
                // The limiting position ahead: with a weak brake, half a turn away.
                let least = (0..10_000)
                    .map(|k| TAU / 10_000.0 * f64::from(k))
                    .map(|phi| (1.0 + 0.68 * phi.cos()) * 100.0 + 2.0 * phi * f64::from(torque))
                    .fold(f64::INFINITY, f64::min);
                let exact = (least / 1.68).sqrt().min(10.0);
                let found = f64::from(ahead.speed_at(Phase::default(), FAST));
                assert_near(&format!("{torque}"), found, exact, 2e-3 * exact);
                assert_near(
                    "half a turn",
                    ahead.speed_at(Phase::from_bits(1 << 31), FAST).into(),
                    10.0,
                    1e-3,
                );
            }
        }
    });
}

#[test]
fn a_stroke_ends_at_rest() {
    let wave = Wave {
        domain: Domain::stroke(0.5, 2.5).unwrap(),
        load: 0.0,
        coulomb: 0.0,
        swing: 0.0,
        ..INVISCID
    };
    with_model_of::<Cubic<f64>, SET>(&wave, Scale::SI, |model| {
        let period = Period::new(0.000_5, &model).unwrap();
        let both = [Direction::Forward, Direction::Backward].map(|direction| {
            LookAhead::<f64, 65>::new(&model, direction, BRAKING, |_| 4.0, &period).unwrap()
        });
        // α = −8: ω² = 16 until a metre before the end, then linear to 0.
        for k in 0..=64 {
            let share = f64::from(k) / 64.0;
            let phase = Phase::from_bits((share * 4_294_967_296.0) as u32);
            for (ahead, left) in both.iter().zip([1.0 - share, share]) {
                let exact = (16.0 * 2.0 * left).sqrt().min(4.0);
                assert_near(
                    &format!("{k}"),
                    ahead.speed_at(phase, 4.0).into(),
                    exact,
                    2e-3,
                );
                // ω²/16 m to stop: before the end or not.
                let omega = if ahead.direction() == Direction::Forward {
                    3.1
                } else {
                    -3.1
                };
                let found = ahead.stop(phase, omega);
                let ends = 3.1 * 3.1 / 16.0 > 2.0 * left;
                assert_eq!(found.beyond, ends, "{k}: {found:?}");
                let way = if ends { left } else { 3.1 * 3.1 / 32.0 };
                let moved = (turns(found.phase) - turns(phase)).abs();
                assert_near(&format!("{k}"), moved, way, 1e-5);
                assert_eq!(found.turns, 0);
            }
        }
    });
}

#[test]
fn what_cannot_be_looked_ahead_is_refused() {
    with_model::<Spline<f32>, { SET | curves::CONSTANT_VISCOUS }>(Scale::SI, |model| {
        let period = Period::new(0.001, &model).unwrap();
        let made = |braking, limit: f32| {
            LookAhead::<f32, 32>::new(&model, Direction::Forward, braking, |_| limit, &period)
        };
        assert!(made(BRAKING, 10.0).is_ok());
        // The load is 3 at a quarter turn, friction 0.5.
        let torque = |torque, helped| {
            made(
                Braking {
                    torque,
                    helped,
                    ..BRAKING
                },
                10.0,
            )
        };
        assert!(torque(2.52, true).is_ok());
        let refused = torque(2.48, true).unwrap_err();
        assert!(
            matches!(refused, AxisError::Overpowered { phase, .. } if (turns(phase) - 0.25).abs() < 0.05)
        );
        assert_eq!(
            format!("{refused}; {}", refused.cure()),
            // 3·sin φ at 30 of 128 nodes, less the 0.5 of friction.
            "at 234/1000 of the range the load drives the machine with 2.486, more than the braking torque of 2.48; \
             give more braking torque, or a counterbalance to the load"
        );
        assert!(torque(3.02, false).is_ok() && torque(2.98, false).is_err());
        for braking in [
            Braking {
                torque: 0.0,
                ..BRAKING
            },
            Braking {
                torque: f32::NAN,
                ..BRAKING
            },
            Braking {
                torque: f32::INFINITY,
                ..BRAKING
            },
            Braking {
                deceleration: 0.0,
                ..BRAKING
            },
            Braking {
                deceleration: f32::NAN,
                ..BRAKING
            },
        ] {
            assert!(made(braking, 10.0).is_err(), "{braking:?}");
        }
        for limit in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e30, 1e-30, 200.0] {
            assert!(made(BRAKING, limit).is_err(), "{limit}");
        }
        // At this speed an interval takes longer than ticks can be counted.
        let slow = Period::new(0.000_1, &model).unwrap();
        let crawl = LookAhead::<f32, 4>::new(&model, Direction::Forward, BRAKING, |_| 0.001, &slow);
        assert!(
            matches!(crawl, Err(AxisError::OutOfRange { .. })),
            "{crawl:?}"
        );
        let few = LookAhead::<f32, 3>::new(&model, Direction::Forward, BRAKING, |_| 1.0, &period);
        assert!(few.is_err());
    });
    // J from 0.1 to 1.9 in half a turn: four nodes do not resolve it.
    let uneven = Wave {
        swing: 0.9,
        ..INVISCID
    };
    with_model_of::<Spline<f32>, SET>(&uneven, Scale::SI, |model| {
        let period = Period::new(0.001, &model).unwrap();
        let of = LookAhead::<f32, 8>::new(&model, Direction::Forward, BRAKING, |_| 1.0, &period);
        assert!(of.is_err());
        let of = LookAhead::<f32, 64>::new(&model, Direction::Forward, BRAKING, |_| 1.0, &period);
        assert!(of.is_ok());
    });
    // A speed above its base.
    with_model_of::<Cubic<Q31>, SET>(&INVISCID, scale_of(250.0, 12.0, 1.5), |model| {
        let period = Period::new(0.000_5, &model).unwrap();
        let of = |limit: f32| {
            LookAhead::<Q31, 32>::new(&model, Direction::Forward, BRAKING, |_| limit, &period)
        };
        assert!(of(11.0).is_ok() && of(20.0).is_err());
    });
}
