use core::f64::consts::TAU;
use jred::number::FrictionSign;

use jred::axis::{
    Braking, Direction, Envelope, FeedForward, Governor, Limit, Limits, LookAhead, MotionState,
    Period,
};
use jred::image::Validity;
use jred::table::Format;
use jred::{Cubic, CurveSet, Domain, Phase, Q31, Quadratic, Rows16, Scale, Spline, curves};

use super::machine::{WAVE, si, with_model, with_model_of};
use crate::support::machines::Wave;
use crate::support::{scale_of, value};

const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
const TICK: f32 = 0.000_5;
/// 8 N·m up to 6 rad/s, 4 at 12; 8 when braking.
const POINTS: [[f32; 2]; 2] = [[6.0, 8.0], [12.0, 4.0]];
const BRAKE: f32 = 8.0;

/// Fast, except from half to three quarters of the turn.
fn limit(phase: Phase) -> f32 {
    if phase.to_bits() >> 30 == 2 { 3.0 } else { 9.0 }
}

/// State of a governed machine in a tick, in SI units.
struct Tick {
    phase: Phase,
    omega: f64,
    alpha: f64,
    torque: f64,
    by: Option<Limit>,
    /// Speed limit at this position.
    most: f64,
}

/// The motion of a governed machine that follows `commanded` (rad/s, of the time) for this many seconds.
fn governed<F: Format>(scale: Scale, seconds: f32, commanded: fn(f32) -> f64) -> Vec<Tick> {
    let mut ticks = Vec::new();
    with_model::<F, SET>(scale, |model| {
        let scale = *model.table().scale();
        let period = Period::new(TICK, &model).unwrap();
        let envelope = Envelope::new(POINTS, BRAKE, &model).unwrap();
        let limits = Limits::new(envelope, 11.0, 40.0, period, &model).unwrap();
        let braking = Braking {
            torque: 0.97 * BRAKE,
            deceleration: 40.0,
            helped: true,
        };
        let ahead = |direction| {
            LookAhead::<F::Number, 64>::new(&model, direction, braking, limit, &period).unwrap()
        };
        let [forward, backward] = [Direction::Forward, Direction::Backward].map(ahead);
        let governor = Governor::both_ways(&forward, &backward).unwrap();
        let [torque_base, speed, alpha_base] =
            [scale.torque(), scale.speed(), scale.acceleration()].map(f64::from);
        let mut motion = MotionState::default();
        for k in 0..(seconds / TICK) as u32 {
            let (wanted, _) = si::<F::Number>(&scale, [commanded(k as f32 * TICK), 0.0]);
            let governed = governor.govern(&limits, &model, &motion, wanted);
            motion.alpha = governed.alpha;
            let torque =
                model.torque_with(motion.phase, motion.omega, motion.alpha, governed.friction);
            let way = if motion.omega < Default::default() {
                &backward
            } else {
                &forward
            };
            ticks.push(Tick {
                phase: motion.phase,
                omega: value(motion.omega) * speed,
                alpha: value(motion.alpha) * alpha_base,
                torque: value(torque) * torque_base,
                by: governed.by,
                most: way.speed_at(motion.phase, 9.0).into(),
            });
            motion = period.later(motion).value;
        }
    });
    ticks
}

fn kept<F: Format>(scale: Scale, error: f64) {
    let ticks = governed::<F>(scale, 8.0, |time| if time < 4.0 { 10.0 } else { -10.0 });
    let mut seen = [0; 4];
    for tick in &ticks {
        let Tick {
            omega,
            torque,
            most,
            ..
        } = *tick;
        let phi = f64::from(tick.phase.to_bits()) / 4_294_967_296.0 * TAU;
        let at = format!("{} at {phi}: {omega} rad/s, {torque} N·m", F::NAME);
        // The drive's torque, of which the look-ahead takes 0.97.
        let driving = if omega.abs() <= 6.0 {
            8.0
        } else {
            8.0 - (omega.abs() - 6.0) * 4.0 / 6.0
        };
        let along = torque * omega.signum();
        assert!(along < driving + error, "{at}");
        assert!(along > -8.0 - error, "{at}");
        assert!(
            omega.abs() < most * (1.0 + 2e-3) + error,
            "{at}, at most {most}"
        );
        assert!(tick.alpha.abs() < 40.0 + error, "{at}");
        match tick.by {
            None => seen[0] += 1,
            Some(Limit::Torque) => seen[1] += 1,
            Some(Limit::Ahead) => seen[2] += 1,
            Some(Limit::Acceleration) => seen[3] += 1,
            Some(other) => panic!("{other:?}"),
        }
    }
    assert!(seen[1] > 100 && seen[2] > 100, "{seen:?}");
    // It passes the turn repeatedly in both directions.
    for way in [1.0, -1.0] {
        let fast = ticks.iter().filter(|tick| tick.omega * way > 5.0).count();
        assert!(fast > 200, "{fast}");
    }
}

#[test]
fn the_governor_keeps_torque_and_speed() {
    kept::<Cubic<f64>>(Scale::SI, 1e-3);
    kept::<Spline<f32>>(Scale::SI, 2e-3);
    let scale = scale_of(250.0, 11.5, 1.5);
    kept::<Cubic<Q31>>(scale, 2e-3);
    kept::<Quadratic<Q31>>(scale, 4e-3);
    kept::<Rows16>(scale, 0.15);
}

#[test]
fn the_governor_does_not_chatter() {
    let ticks = governed::<Cubic<f64>>(Scale::SI, 4.0, |_| 10.0);
    // A command that switches between driving and braking would change by 15 rad/s² every tick; this one rises and falls a few times per turn.
    let changes = ticks
        .windows(2)
        .map(|pair| (pair[1].alpha - pair[0].alpha).abs());
    let passed: f64 = ticks.iter().map(|tick| tick.omega * f64::from(TICK)).sum();
    let [range, a_turn] = [25.0, changes.sum::<f64>() / (passed / TAU)];
    assert!(a_turn < 6.0 * range, "{a_turn}");
    // Where the look-ahead is active, the machine is at the limit and loses no time.
    let bound: Vec<&Tick> = ticks
        .iter()
        .filter(|tick| tick.by == Some(Limit::Ahead))
        .collect();
    let left = bound
        .iter()
        .map(|tick| 1.0 - tick.omega / tick.most)
        .fold(0.0, f64::max);
    assert!(left < 0.02, "{left}");
}

#[test]
fn what_cannot_be_kept_ahead_is_flagged_and_a_slow_machine_may_be_strong() {
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let period = Period::new(TICK, &model).unwrap();
        let braking = Braking {
            torque: BRAKE,
            deceleration: f32::INFINITY,
            helped: true,
        };
        let run = |peak: f32, most: f32, limit: fn(Phase) -> f32, turns: u32| {
            let envelope = Envelope::new([[12.0, peak]], peak, &model).unwrap();
            let limits = Limits::new(envelope, 11.0, most, period, &model).unwrap();
            let ahead =
                LookAhead::<f64, 64>::new(&model, Direction::Forward, braking, limit, &period)
                    .unwrap();
            let governor = Governor::one_way(&ahead);
            let mut motion = MotionState::default();
            let (mut flagged, mut fastest_change) = (0, 0.0_f64);
            for _ in 0..turns {
                let governed = governor.govern(&limits, &model, &motion, 9.0);
                motion.alpha = governed.alpha;
                fastest_change = fastest_change.max(governed.alpha);
                let above =
                    motion.omega > 1.03 * f64::from(ahead.speed_at(motion.phase, 9.0)) + 0.1;
                let said = governed.unkept == Some(Limit::Ahead);
                assert!(said || !above, "{motion:?}");
                flagged += u32::from(said);
                motion = period.later(motion).value;
            }
            (flagged, fastest_change)
        };
        // The look-ahead assumes 8 N·m, the limits permit only 2 rad/s²: too fast into the slow part.
        assert!(run(8.0, 2.0, limit, 16_000).0 > 100);
        assert_eq!(run(8.0, 2.0, |_| 9.0, 16_000).0, 0);
        // A slow machine with a strong drive starts with its full torque: 300 N·m minus friction for J = 1.25.
        let (_, alpha) = run(300.0, 1000.0, |_| 0.5, 10);
        assert!((alpha - 299.5 / 1.25).abs() < 0.5, "{alpha}");
    });
}

#[test]
fn at_rest_the_torque_is_one_that_the_drive_has() {
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let period = Period::new(TICK, &model).unwrap();
        let braking = Braking {
            torque: BRAKE,
            deceleration: 40.0,
            helped: true,
        };
        let made = |direction| {
            LookAhead::<f64, 64>::new(&model, direction, braking, |_| 9.0, &period).unwrap()
        };
        let [forward, backward] = [Direction::Forward, Direction::Backward].map(made);
        let governor = Governor::both_ways(&forward, &backward).unwrap();
        // The load pulls forward with 3, friction holds 0.5. A weak drive cannot hold it; one of 2.8 can with the help of friction.
        for (peak, wanted, least) in [
            (1.0_f32, 0.0, 1.5),
            (2.8, 0.0, 0.0),
            (4.0, 9.0, 3.0),
            (4.0, -9.0, -0.6),
        ] {
            let envelope = Envelope::new([[12.0, peak]], peak, &model).unwrap();
            let limits = Limits::new(envelope, 11.0, 100.0, period, &model).unwrap();
            let motion = MotionState {
                phase: Phase::from_bits(1 << 30),
                ..MotionState::default()
            };
            let governed = governor.govern(&limits, &model, &motion, wanted);
            let torque = model.torque_with(motion.phase, 0.0, governed.alpha, governed.friction);
            let held = governed.alpha == 0.0;
            assert!(
                held || torque.abs() < f64::from(peak) + 1e-4,
                "{peak}: {torque}"
            );
            // Held by friction: the torque missing for balance is at most c.
            assert!(
                !held || torque.abs() < f64::from(peak) + 0.5,
                "{peak}: {torque}"
            );
            assert!(
                if wanted < 0.0 {
                    governed.alpha < least + 0.11
                } else {
                    governed.alpha > least - 1e-4
                },
                "{governed:?}"
            );
        }
    });
}

#[test]
fn a_commanded_speed_that_is_possible_is_reached() {
    let ticks = governed::<Cubic<f64>>(Scale::SI, 3.0, |_| 2.0);
    let last = &ticks[ticks.len() - 1000..];
    assert!(
        last.iter()
            .all(|tick| tick.by.is_none() && (tick.omega - 2.0).abs() < 1e-6)
    );
    // At rest it stays at rest.
    let ticks = governed::<Spline<f32>>(Scale::SI, 3.0, |time| if time < 1.5 { 9.0 } else { 0.0 });
    let last = &ticks[ticks.len() - 1000..];
    assert!(
        last.iter().all(|tick| tick.omega.abs() < 1e-6),
        "{}",
        last[0].omega
    );
}

#[test]
fn one_way_is_one_way() {
    with_model::<Spline<f32>, SET>(Scale::SI, |model| {
        let period = Period::new(TICK, &model).unwrap();
        let envelope = Envelope::new(POINTS, BRAKE, &model).unwrap();
        let limits = Limits::new(envelope, 11.0, 40.0, period, &model).unwrap();
        let braking = Braking {
            torque: BRAKE,
            deceleration: 40.0,
            helped: true,
        };
        let made = |direction| {
            LookAhead::<f32, 64>::new(&model, direction, braking, limit, &period).unwrap()
        };
        let [forward, backward] = [Direction::Forward, Direction::Backward].map(made);
        assert!(Governor::both_ways(&backward, &forward).is_err());
        assert!(Governor::both_ways(&forward, &forward).is_err());
        for (ahead, way) in [(&forward, 1.0), (&backward, -1.0)] {
            let governor = Governor::one_way(ahead);
            let mut motion = MotionState::default();
            for wanted in [way * 3.0, -way * 3.0] {
                for _ in 0..3000 {
                    motion.alpha = governor.govern(&limits, &model, &motion, wanted).alpha;
                    motion = period.later(motion).value;
                    assert!(motion.omega * way > -1e-3, "{motion:?}");
                }
                let expected = (way * 3.0 * (wanted * way).signum().max(0.0)).abs();
                assert!((motion.omega.abs() - expected).abs() < 1e-3, "{motion:?}");
            }
        }
        let governor = Governor::one_way(&forward);
        for (omega, wanted) in [
            (f32::NAN, 1.0),
            (1.0, f32::NAN),
            (f32::INFINITY, 1.0),
            (1.0, f32::INFINITY),
        ] {
            let motion = MotionState {
                omega,
                ..MotionState::default()
            };
            let found = governor.govern(&limits, &model, &motion, wanted);
            assert!(found.alpha.is_finite(), "{omega} {wanted}: {found:?}");
            assert!(found.unkept.is_some() || wanted.is_infinite(), "{found:?}");
        }
    });
}

#[test]
fn a_stroke_is_stopped_at_its_end() {
    let wave = Wave {
        domain: Domain::stroke(0.5, 2.5).unwrap(),
        ..WAVE
    };
    with_model_of::<Cubic<Q31>, SET>(&wave, scale_of(250.0, 11.5, 1.5), |model| {
        let scale = *model.table().scale();
        let period = Period::new(TICK, &model).unwrap();
        let envelope = Envelope::new(POINTS, BRAKE, &model).unwrap();
        let limits = Limits::new(envelope, 11.0, 40.0, period, &model).unwrap();
        let braking = Braking {
            torque: 0.97 * BRAKE,
            deceleration: 40.0,
            helped: true,
        };
        let made = |direction| {
            LookAhead::<Q31, 65>::new(&model, direction, braking, |_| 8.0, &period).unwrap()
        };
        let [forward, backward] = [Direction::Forward, Direction::Backward].map(made);
        let governor = Governor::both_ways(&forward, &backward).unwrap();
        let mut motion = MotionState::default();
        for way in [1.0, -1.0, 1.0] {
            let (wanted, _) = si::<Q31>(&scale, [way * 8.0, 0.0]);
            let mut fastest = 0.0_f64;
            let mut end_speed = 0.0_f64;
            for _ in 0..4000 {
                motion.alpha = governor.govern(&limits, &model, &motion, wanted).alpha;
                let before = motion.phase.to_bits();
                motion = period.later(motion).value;
                let omega = value(motion.omega) * f64::from(scale.speed());
                fastest = fastest.max(omega.abs());
                let clipped = [0, u32::MAX].contains(&motion.phase.to_bits());
                if clipped && before != motion.phase.to_bits() {
                    end_speed = end_speed.max(omega.abs());
                }
            }
            // It was fast, and at the end it came to rest by itself.
            let end = f64::from(motion.phase.to_bits()) / 4_294_967_296.0;
            let expected = if way > 0.0 { 1.0 } else { 0.0 };
            assert!(fastest > 2.0, "{fastest}");
            assert!((end - expected).abs() < 2e-3, "{way}: {end}");
            assert!(end_speed < 0.05, "{way}: {end_speed}");
            // Up to the rounding of a tick.
            assert!(value(motion.omega).abs() < 1e-8, "{way}: {motion:?}");
        }
    });
}

/// Friction at rest takes a speed within the table's validity, not the numerical value of the acceleration.
#[test]
fn a_start_from_rest_is_a_valid_motion() {
    fn starts<F: Format>(scale: Scale) {
        with_model::<F, SET>(scale, |model| {
            let scale = *model.table().scale();
            let period = Period::new(TICK, &model).unwrap();
            let envelope = Envelope::new([[12.0, 60.0]], BRAKE, &model).unwrap();
            // More rad/s² than the table is valid for in rad/s.
            let limits = Limits::new(envelope, 9.0, 40.0, period, &model).unwrap();
            let braking = Braking {
                torque: 0.97 * BRAKE,
                deceleration: 40.0,
                helped: true,
            };
            let ahead = |direction| {
                LookAhead::<_, 64>::new(&model, direction, braking, limit, &period).unwrap()
            };
            let [forward, backward] = [Direction::Forward, Direction::Backward].map(ahead);
            let governor = Governor::both_ways(&forward, &backward).unwrap();
            let validity = Validity {
                max_speed: 10.0,
                max_acceleration: 40.0,
                torque_error: 0.0,
            };
            let feed_forward = FeedForward::new(model, validity);
            for way in [1.0, -1.0] {
                let mut motion = MotionState::default();
                let (commanded, _) = si::<F::Number>(&scale, [way * 5.0, 0.0]);
                let governed = governor.govern(&limits, &model, &motion, commanded);
                motion.alpha = governed.alpha;
                assert!(
                    way * value(motion.alpha) * f64::from(scale.acceleration()) > 10.0,
                    "{motion:?}"
                );
                let FrictionSign::OfSpeed(against) = governed.friction else {
                    panic!("all of c");
                };
                assert!(way * value(against) > 0.0, "{against:?}");
                let found = feed_forward.at_reference(motion, governed.friction);
                assert!(found.status.is_valid(), "{}: {motion:?}", F::NAME);
            }
        });
    }
    starts::<Cubic<f64>>(Scale::SI);
    starts::<Spline<f32>>(Scale::SI);
    starts::<Cubic<Q31>>(scale_of(250.0, 11.5, 1.5));
    starts::<Rows16>(scale_of(250.0, 11.5, 1.5));
}

/// Look-ahead and limits have the same deceleration, and the drive has more torque than it takes: the machine brakes from the top speed to nearly
/// rest within its limits, in 64 ticks or more.
#[test]
fn the_deceleration_of_the_limits_gives_no_false_alarm() {
    fn alarms<F: Format>(scale: Scale) {
        with_model::<F, SET>(scale, |model| {
            let scale = *model.table().scale();
            for (tick, most, top) in [
                (0.000_5_f32, 40.0_f32, 9.0_f32),
                (0.000_5, 10.0, 9.0),
                (0.001, 40.0, 9.0),
                (0.003, 40.0, 9.0),
                (0.000_1, 70.0, 3.0),
                (0.000_5, 60.0, 2.0),
            ] {
                let period = Period::new(tick, &model).unwrap();
                let envelope = Envelope::new([[10.5, 120.0]], 120.0, &model).unwrap();
                let limits = Limits::new(envelope, 10.0, most, period, &model).unwrap();
                let braking = Braking {
                    torque: 116.0,
                    deceleration: most,
                    helped: true,
                };
                let slow = |phase: Phase| {
                    if phase.to_bits() >> 30 == 2 {
                        0.05 * top
                    } else {
                        top
                    }
                };
                let ahead = LookAhead::<F::Number, 64>::new(
                    &model,
                    Direction::Forward,
                    braking,
                    slow,
                    &period,
                )
                .unwrap();
                let governor = Governor::one_way(&ahead);
                let (wanted, _) = si::<F::Number>(&scale, [top.into(), 0.0]);
                let mut motion = MotionState::default();
                let (mut turns, mut fastest) = (0, 0.0_f64);
                for _ in 0..100_000 {
                    let governed = governor.govern(&limits, &model, &motion, wanted);
                    assert_eq!(
                        governed.unkept,
                        None,
                        "{} {tick} {most} {top}: {motion:?}",
                        F::NAME
                    );
                    motion.alpha = governed.alpha;
                    fastest = fastest.max(value(motion.omega) * f64::from(scale.speed()));
                    let next = period.later(motion).value;
                    turns += u32::from(next.phase.to_bits() < motion.phase.to_bits());
                    motion = next;
                    if turns > 1 {
                        break;
                    }
                }
                assert!(turns > 0 || tick < 0.000_2, "it comes round");
                assert!(
                    fastest > 0.9 * f64::from(top).min((f64::from(most) * 3.0).sqrt()),
                    "{fastest}"
                );
            }
        });
    }
    alarms::<Cubic<f64>>(Scale::SI);
    alarms::<Spline<f32>>(Scale::SI);
    alarms::<Cubic<Q31>>(scale_of(250.0, 11.5, 1.5));
}

/// A command of NaN gives the possible acceleration nearest to 0, and the active limit is named.
#[test]
fn a_command_that_is_no_number_stays_within_what_is_possible() {
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let period = Period::new(TICK, &model).unwrap();
        let braking = Braking {
            torque: BRAKE,
            deceleration: 40.0,
            helped: true,
        };
        let ahead =
            LookAhead::<f64, 64>::new(&model, Direction::Forward, braking, |_| 9.0, &period)
                .unwrap();
        let governor = Governor::one_way(&ahead);
        // A weak drive: at a quarter turn the load pulls with 3 N·m, friction is 0.5 and 0.1·ω, J is 1.
        let envelope = Envelope::new([[12.0, 1.0]], 1.0, &model).unwrap();
        let limits = Limits::new(envelope, 11.0, 100.0, period, &model).unwrap();
        let motion = MotionState {
            phase: Phase::from_bits(1 << 30),
            omega: 2.0,
            alpha: 0.0,
        };
        let governed = governor.govern(&limits, &model, &motion, f64::NAN);
        // ½·J′·ω² = −0.125·4.
        let least = -1.0 + 3.0 - 0.5 - 0.2 + 0.5;
        assert!((governed.alpha - least).abs() < 1e-4, "{governed:?}");
        assert_eq!(governed.by, Some(Limit::Torque));
        assert_eq!(governed.unkept, Some(Limit::Speed));
        // A strong drive: zero acceleration, no active limit, and the command is flagged as not kept.
        let envelope = Envelope::new([[12.0, 8.0]], 8.0, &model).unwrap();
        let limits = Limits::new(envelope, 11.0, 100.0, period, &model).unwrap();
        let governed = governor.govern(&limits, &model, &motion, f64::NAN);
        assert_eq!((governed.alpha.to_bits(), governed.by), (0, None));
        assert_eq!(governed.unkept, Some(Limit::Speed));
    });
}
