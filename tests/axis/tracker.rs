use core::f64::consts::TAU;

use jred::axis::{Period, Tracker, TrackerOutput};
use jred::table::Format;
use jred::{Domain, Phase, Q15, Q31, Rows16, Scale, Speed, Spline};
use proptest::prelude::*;

use super::machine::in_units;
use crate::support::{assert_near, budget, config, samples, scale_of, value};

/// Feeds the phases of φ(k)/2π, k = 1, 2, …
fn follow(tracker: &mut Tracker, periods: u32, turns: impl Fn(f64) -> f64) -> TrackerOutput {
    let mut last = TrackerOutput::default();
    for k in 1..=periods {
        let turn = turns(f64::from(k)).rem_euclid(1.0);
        last = tracker.update(Phase::from_bits((turn * 4_294_967_296.0) as u32));
    }
    last
}

const UNIT: f64 = 1.0 / 4_294_967_296.0;

/// In ranges a period, and a period squared.
fn speed(tracked: TrackerOutput) -> f64 {
    f64::from(tracked.speed) * UNIT
}

fn acceleration(tracked: TrackerOutput) -> f64 {
    f64::from(tracked.acceleration) * UNIT / 256.0
}

#[test]
fn a_constant_acceleration_is_followed_without_a_lag() {
    for memory in [0.0, 0.5, 0.9, 0.99] {
        for (omega, alpha) in [(0.7, 0.3), (-0.95, 0.5), (0.95, -0.9), (0.0, 0.0)] {
            // Residual of the filter's transient from rest.
            let rest = 1.0 - f64::from(memory);
            let most = (1.3 * rest).min(1.0 / 6.0);
            let (omega, alpha) = (omega * most, alpha * 1e-3 * rest * rest);
            let periods = 5 + (40.0 / (1.0 - f64::from(memory))) as u32;
            let turns = |k: f64| 0.3 + omega * k + 0.5 * alpha * k * k;
            let mut tracker = Tracker::new(memory)
                .unwrap()
                .at(Phase::from_bits((0.3 / UNIT) as u32));
            let last = follow(&mut tracker, periods, turns);
            let k = f64::from(periods);
            let phase = f64::from(last.phase.to_bits()) * UNIT;
            let off = (phase - turns(k) + 0.5).rem_euclid(1.0) - 0.5;
            // Phases are floored to a unit; without memory three of them give the acceleration.
            assert!(off.abs() < 3.0 * UNIT, "{memory} {omega}: phase {off:e}");
            assert_near("speed", speed(last), omega + alpha * k, 4.0 * UNIT);
            assert_near("acceleration", acceleration(last), alpha, 5.0 * UNIT);
        }
    }
}

#[test]
fn the_filter_settles_and_smooths_as_stated() {
    for memory in [0.8f32, 0.9, 0.95] {
        let theta = f64::from(memory);
        let rest = 1.0 - theta;
        // A step of the acceleration: 1 % after 8.4/(1 − θ).
        let alpha = 1e-5;
        let mut tracker = Tracker::new(memory).unwrap();
        let turns = |k: f64| 0.5 * alpha * k * k;
        let near = |k: f64| (k / rest) as u32;
        let mut at = [1.0; 2];
        for (k, left) in [7.4, 9.4].into_iter().zip(&mut at) {
            let last = follow(&mut tracker.at(Phase::default()), near(k), turns);
            *left = (acceleration(last) / alpha - 1.0).abs();
        }
        assert!(at[0] > 0.01 && at[1] < 0.01, "{memory}: {at:?}");

        // White quantisation noise, against the closed forms of Morrison (1969), chapter 13.
        let per = (1.0 + theta).powi(5);
        let of_speed = rest.powi(3) / per * (49.0 + 50.0 * theta + 13.0 * theta * theta) / 2.0;
        let of_acceleration = 6.0 * rest.powi(5) / per;
        let count = 1.0 / 10_000.0;
        let (mut sums, mut number) = ([0.0; 2], 0.0);
        for (k, noise) in samples(200_000, 0x7ac3, &(-0.5..0.5))
            .into_iter()
            .enumerate()
        {
            let turn = (0.5 + noise * count) / UNIT;
            let last = tracker.update(Phase::from_bits(turn as u32));
            if k > 1000 {
                // At the next period: the closed form is for the prediction.
                sums[0] += (speed(last) + acceleration(last)).powi(2);
                sums[1] += acceleration(last).powi(2);
                number += 1.0;
            }
        }
        let [found_speed, found_acceleration] = sums.map(|sum| (sum / number).sqrt() / count);
        let expected = [of_speed, of_acceleration].map(|reduction: f64| (reduction / 12.0).sqrt());
        assert_near("speed noise", found_speed / expected[0], 1.0, budget::NOISE);
        assert_near(
            "acceleration noise",
            found_acceleration / expected[1],
            1.0,
            budget::NOISE,
        );
    }
}

/// Speed, acceleration, and counts of that speed, per period.
fn found<F: Format>(period: f32, tracked: TrackerOutput, scale: Scale) -> [f64; 3] {
    let rates = Period::new(period, &in_units::<F>(Domain::Turn, scale)).unwrap();
    let (omega, alpha) = (rates.omega(tracked), rates.alpha(tracked));
    assert!(!omega.saturated && !alpha.saturated);
    let back = rates.moved(omega.value).to_bits().cast_signed();
    let bases = [scale.speed(), scale.acceleration()].map(f64::from);
    [
        value(omega.value) * bases[0],
        value(alpha.value) * bases[1],
        f64::from(back),
    ]
}

#[test]
fn rates_give_the_motion_in_every_number() {
    let (period, omega, alpha) = (1e-4, 12.0, -340.0);
    let tracked = TrackerOutput {
        phase: Phase::default(),
        speed: (omega * f64::from(period) / TAU / UNIT) as i32,
        acceleration: (alpha * f64::from(period).powi(2) / TAU / UNIT * 256.0) as i32,
        ..TrackerOutput::default()
    };
    let scale = scale_of(100.0, 20.0, 0.2);
    let wanted = [omega, alpha, f64::from(tracked.speed)];
    let check = |name: &str, [omega, alpha, back]: [f64; 3], share: f64| {
        assert_near(&format!("{name} speed"), omega, wanted[0], 20.0 * share);
        assert_near(
            &format!("{name} acceleration"),
            alpha,
            wanted[1],
            500.0 * share,
        );
        // In fixed point to four units of a phase.
        let off = 4.0 + 2.0 * share * wanted[2];
        assert_near(&format!("{name} moved"), back, wanted[2], off);
    };
    check(
        "f64",
        found::<Spline<f64>>(period, tracked, Scale::SI),
        1e-6,
    );
    check(
        "f32",
        found::<Spline<f32>>(period, tracked, Scale::SI),
        1e-6,
    );
    check("q31", found::<Spline<Q31>>(period, tracked, scale), 1e-6);
    check(
        "q15",
        found::<Rows16>(period, tracked, scale),
        1.0 / 32_768.0,
    );

    // Beyond the machine units: limited and flagged, in both directions.
    let short = Period::new(period, &in_units::<Rows16>(Domain::Turn, scale)).unwrap();
    let fast = TrackerOutput {
        speed: 2 * tracked.speed,
        ..tracked
    };
    assert!(short.omega(fast).saturated && short.omega(fast).value == Speed::<Q15>::MAX);
    let rates = Period::new(period, &in_units::<Spline<Q31>>(Domain::Turn, scale)).unwrap();
    for sign in [1, -1] {
        let fast = TrackerOutput {
            speed: 2 * sign * tracked.speed,
            acceleration: 2 * sign * tracked.acceleration,
            ..tracked
        };
        let (omega, alpha) = (rates.omega(fast), rates.alpha(fast));
        assert!(omega.saturated && alpha.saturated);
        let ends = [i32::MIN, i32::MAX];
        assert_eq!(omega.value.to_bits(), ends[usize::from(sign > 0)]);
        assert_eq!(alpha.value.to_bits(), ends[usize::from(sign < 0)]);
    }
}

#[test]
fn filters_that_cannot_be_are_refused() {
    for memory in [f32::NAN, -0.1, 0.991, 1.0] {
        assert!(Tracker::new(memory).is_err(), "{memory}");
    }
    for (bandwidth, period) in [
        (0.0, 1e-4),
        (-5.0, 1e-4),
        (f32::NAN, 1e-4),
        (50.0, 0.0),
        (0.1, 1e-4),
        (50.0, f32::INFINITY),
    ] {
        assert!(
            Tracker::with_bandwidth(bandwidth, period).is_err(),
            "{bandwidth} {period}"
        );
    }
    assert_eq!(
        Tracker::with_bandwidth(50.0, 1e-4).unwrap(),
        Tracker::new(1.0 / (1.0 + TAU as f32 * 50.0 * 1e-4)).unwrap()
    );
    let units = in_units::<Spline<Q31>>(Domain::Turn, Scale::SI);
    for period in [f32::NAN, 0.0, -1.0, f32::INFINITY, 1e-38, 1e38] {
        assert!(Period::new(period, &units).is_err(), "{period}");
    }
}

/// A filter overshoots; at the end of a stroke it stays there.
#[test]
fn a_stroke_does_not_wrap() {
    for memory in [0.0, 0.8, 0.95] {
        let turns = |k: f64| 0.5 - 0.5 * (k * TAU / 400.0).cos();
        let mut tracker = Tracker::new(memory).unwrap();
        // Residual of a change of the acceleration.
        let lag = 0.5 * (TAU / 400.0 / (1.0 - f64::from(memory))).powi(3);
        for k in 1..=2000 {
            let turn = turns(k.into());
            let measured = Phase::from_bits((turn * 4_294_967_295.0) as u32);
            let tracked = tracker.update_stroke(measured);
            let off = f64::from(tracked.phase.to_bits()) * UNIT - turn;
            assert!(off.abs() < 0.02 + lag, "{memory} at {k}: {off}");
        }
    }
}

/// A jump to the other end of a stroke: half of the stroke is used as residual, in either direction.
#[test]
fn a_jump_over_the_stroke_is_half_a_stroke() {
    for memory in [0.0f32, 0.5, 0.9] {
        let jump = |from, to| {
            let mut tracker = Tracker::new(memory).unwrap().at(Phase::from_bits(from));
            tracker.update_stroke(Phase::from_bits(to))
        };
        let [up, down] = [jump(0, u32::MAX), jump(u32::MAX, 0)];
        let gain = 1.0 - f64::from(memory).powi(3);
        let moved = |tracked: TrackerOutput| f64::from(tracked.phase.to_bits()) * UNIT;
        assert_near("up", moved(up), 0.5 * gain, 1e-7);
        assert_near("down", 1.0 - moved(down), 0.5 * gain, 1e-7);
    }
}

#[test]
fn an_acceleration_beyond_its_range_is_limited() {
    let mut tracker = Tracker::new(0.0).unwrap();
    tracker.update(Phase::default());
    assert_eq!(
        tracker.update(Phase::from_bits(1 << 28)).acceleration,
        i32::MAX
    );
    let mut tracker = Tracker::new(0.0).unwrap();
    assert_eq!(
        tracker.update(Phase::from_bits(15 << 28)).acceleration,
        i32::MIN
    );
}

/// A count beyond the end of the stroke keeps the phase of the end: the machine runs into a stop, or the encoder is wrong.
#[test]
fn at_the_end_of_a_stroke_the_speed_comes_to_rest() {
    let from_end = |way: f64, end: u32| {
        let way = (way * 4_294_967_295.0) as u32;
        Phase::from_bits(if end == 0 { u32::MAX - way } else { way })
    };
    for memory in [0.0, 0.5, 0.9, 0.97] {
        for end in [0, u32::MAX] {
            for way in [|k: f64| k / 1000.0, |k: f64| (k / 1000.0).powi(2)] {
                let mut tracker = Tracker::new(memory).unwrap().at(from_end(0.0, end));
                for k in 1..1000 {
                    tracker.update_stroke(from_end(way(k.into()), end));
                }
                let moving = tracker.update_stroke(from_end(1.0, end));
                assert!(speed(moving).abs() > 0.9e-3, "{memory}: {moving:?}");
                assert!((speed(moving) > 0.0) == (end > 0), "{memory}: {moving:?}");
                let mut last = moving;
                for _ in 0..(40.0 / (1.0 - memory)) as u32 {
                    last = tracker.update_stroke(Phase::from_bits(end));
                }
                assert!(
                    last.phase.to_bits().abs_diff(end) < 10,
                    "{memory}: {last:?}"
                );
                assert!(last.speed.abs() < 10, "{memory}: {last:?}");
                assert!(acceleration(last).abs() < 1e-9, "{memory}: {last:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(config(4096, 0x7ac0))]

    /// After any number of wrong counts the filter follows the machine again: no other motion has the same phases.
    #[test]
    fn wrong_counts_are_forgotten(
        memory in prop_oneof![Just(0.0_f32), 0.0..=0.99_f32],
        stroke in any::<bool>(),
        at in any::<u32>(),
        moves in -4_294_967..=4_294_967, // up to a thousandth of a turn a period
        wrong in prop::collection::vec(any::<u32>(), 1..20),
    ) {
        let moves = if stroke { 0 } else { moves };
        let mut tracker = Tracker::new(memory).unwrap().at(Phase::from_bits(at));
        let mut update = |phase| {
            let phase = Phase::from_bits(phase);
            if stroke { tracker.update_stroke(phase) } else { tracker.update(phase) }
        };
        for phase in wrong {
            update(phase);
        }
        // In a stroke a residual is limited to half of it, and at its ends the filter waits.
        let settled = if stroke { 60.0 } else { 20.0 } / (1.0 - memory);
        let (mut place, mut last) = (at, TrackerOutput::default());
        for _ in 0..settled as u32 {
            place = place.wrapping_add_signed(moves);
            last = update(place);
        }
        let off = last.phase.to_bits().wrapping_sub(place).cast_signed();
        prop_assert!(off.abs() < 1 << 24, "phase: {off}");
        let off = last.speed.abs_diff(moves);
        prop_assert!(off < 1 << 22, "speed: {off}");
    }
}

/// A sudden change of the acceleration leaves a residual of at most 0.53·Δα·T²/(1 − θ)², 0.29 from θ = 0.9 on, which is not a jump. The response of
/// the error (1 − z)³/(1 − θ·z)³ to Δα·k²/2 is ½·(c(n − 1) + c(n − 2)) with c(k) = (k + 1)·(k + 2)/2·θᵏ.
#[test]
fn a_change_of_the_acceleration_is_no_jump() {
    for memory in [0.0_f64, 0.12, 0.5, 0.9, 0.97] {
        let rest = 1.0 - memory;
        let alpha = 1e-3 * rest * rest;
        let step = Phase::from_bits((0.53 * alpha / (rest * rest) * 4_294_967_296.0) as u32);
        let mut tracker = Tracker::new(memory as f32).unwrap().with_largest_step(step);
        let c = |k: i32| {
            if k < 0 {
                0.0
            } else {
                f64::from((k + 1) * (k + 2)) / 2.0 * memory.powi(k)
            }
        };
        let mut most = 0.0_f64;
        for n in 1..(20.0 / rest) as i32 {
            let turn = 0.5 * alpha * f64::from(n) * f64::from(n);
            let found = tracker.update(Phase::from_bits(
                (turn.rem_euclid(1.0) * 4_294_967_296.0) as u32,
            ));
            let exact = 0.5 * alpha * (c(n - 1) + c(n - 2)) * 4_294_967_296.0;
            assert_near(
                "the residual",
                found.residual.into(),
                exact,
                4.0 + 1e-3 * exact,
            );
            assert!(!found.jumped, "{memory} {n}: {found:?}");
            most = most.max(exact);
        }
        let share = most / (alpha / (rest * rest) * 4_294_967_296.0);
        assert!(
            share <= if memory < 0.9 { 0.53 } else { 0.29 },
            "{memory}: {share}"
        );
    }
}

#[test]
fn a_count_that_jumps_is_flagged_and_forgotten() {
    for stroke in [false, true] {
        // 0.001 of the range per period; at most 0.002, in either direction.
        let speed = 4_294_967_u32;
        for largest in [2 * speed, (2 * speed).wrapping_neg()] {
            let start = Phase::from_bits(1 << 30);
            let mut tracker = Tracker::new(0.8)
                .unwrap()
                .at(start)
                .with_largest_step(Phase::from_bits(largest));
            let mut flags = Vec::new();
            for k in 1..400_u32 {
                let jump = if k == 200 { 3 * speed } else { 0 };
                let phase = Phase::from_bits((1 << 30) + k * speed + jump);
                let found = if stroke {
                    tracker.update_stroke(phase)
                } else {
                    tracker.update(phase)
                };
                if k == 200 {
                    assert!(
                        found.residual.abs_diff(3 * speed.cast_signed()) < 1000,
                        "{found:?}"
                    );
                }
                if found.jumped {
                    flags.push(k);
                }
            }
            // The jump is flagged, and possibly readings after it that differ from the disturbed prediction; neither the start from rest nor the
            // steady motion is.
            assert!(
                flags.first() == Some(&200) && flags.iter().all(|k| (200..215).contains(k)),
                "{flags:?}"
            );
        }
        // The default largest step is a quarter of the range.
        let mut tracker = Tracker::new(0.8).unwrap();
        let jump = |bits: u32, tracker: &mut Tracker| {
            let phase = Phase::from_bits(bits);
            if stroke {
                tracker.update_stroke(phase)
            } else {
                tracker.update(phase)
            }
            .jumped
        };
        assert!(!jump(1 << 20, &mut tracker) && jump(1 << 31, &mut tracker));
    }
}

/// An acceleration beyond 32 bits is limited by the tracker, and flagged in machine units with any base.
#[test]
fn an_acceleration_that_was_limited_is_flagged() {
    let period = Period::new(0.001, &in_units::<Spline<f32>>(Domain::Turn, Scale::SI)).unwrap();
    let tracked = |acceleration| TrackerOutput {
        acceleration,
        ..TrackerOutput::default()
    };
    assert!(period.alpha(tracked(i32::MAX)).saturated && period.alpha(tracked(i32::MIN)).saturated);
    assert!(!period.alpha(tracked(i32::MAX - 1)).saturated);
    let mut tracker = Tracker::new(0.0).unwrap();
    tracker.update(Phase::from_bits(0));
    let found = tracker.update(Phase::from_bits(1 << 27));
    assert!(
        found.acceleration == i32::MAX && period.alpha(found).saturated,
        "{found:?}"
    );
}
