//! A follower of a plan: its time, its rate, and the resulting motion.

use core::f64::consts::TAU;

use jred::axis::plan::{Knot, PlanError, PlanPoint, with_ramp};
use jred::axis::{MachineUnits, Override, Plan, PlanFollower, PlanState};
use jred::number::{Number, Quantity as _};
use jred::{Domain, Q31, Rows16, Scale, Spline};

use super::machine::in_units;
use super::plan::{evenly, exact, found, image, trapezoid};
use crate::support::scale_of;

/// Each tick has the plan's position at that time, for any tick period: an error of 2⁻⁴⁰ s per tick.
#[test]
fn a_follower_is_on_time() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let words = image(&trapezoid(), Domain::Turn);
    let plan = Plan::new(&words, &model).unwrap();
    for period in [0.000_25_f32, 0.000_062_5, 0.001, 0.003_7] {
        let mut follower = PlanFollower::new(plan, period, 0.5, &model).unwrap();
        for _ in 0..3 {
            let planned = follower.next(Override::FULL);
            assert_eq!(planned.state, PlanState::Waiting);
            assert_eq!((planned.motion.omega, planned.motion.alpha), (0.0, 0.0));
        }
        follower.start();
        let mut ticks = 0_u32;
        loop {
            let planned = follower.next(Override::FULL);
            if planned.state == PlanState::Done {
                break;
            }
            assert_eq!(planned.state, PlanState::Running);
            let place = PlanPoint {
                motion: planned.motion,
                turns: planned.turns,
            };
            let [position, omega, _] = found(&place, &model);
            let [at, v, _] = exact(f64::from(ticks) * f64::from(period));
            assert!((position - at).abs() < 1.5e-7, "{ticks}: {position} {at}");
            assert!((omega - v).abs() < 3e-7, "{ticks}: {omega} {v}");
            ticks += 1;
        }
        let all = (5.5 / f64::from(period)).ceil();
        assert!(
            (f64::from(ticks) - all).abs() <= 1.0,
            "{period}: {ticks} {all}"
        );
        let end = follower.next(Override::FULL);
        assert_eq!((end.state, end.motion.omega), (PlanState::Done, 0.0));
        follower.reset();
        assert_eq!(follower.next(Override::FULL).state, PlanState::Waiting);
    }
}

/// With a continuously changing rate the speed is the derivative of the position, and the acceleration that of the speed.
#[test]
fn an_override_is_a_motion() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let words = image(&trapezoid(), Domain::Turn);
    let plan = Plan::new(&words, &model).unwrap();
    let period = 0.000_5;
    let mut follower = PlanFollower::new(plan, period as f32, 0.4, &model).unwrap();
    follower.start();
    let rate = |k: u32| {
        Override::percent(match k {
            1000..3000 => 40,
            3000..4000 => 0,
            4000..6000 => 70,
            _ => 100,
        })
    };
    let mut rows: Vec<([f64; 3], PlanState)> = Vec::new();
    for k in 0..20_000 {
        let planned = follower.next(rate(k));
        let place = PlanPoint {
            motion: planned.motion,
            turns: planned.turns,
        };
        rows.push((found(&place, &model), planned.state));
        if planned.state == PlanState::Done {
            break;
        }
    }
    let mut corners = 0;
    for pair in rows.windows(2) {
        let [[x0, v0, a0], [x1, v1, a1]] = [pair[0].0, pair[1].0];
        // Small corners, where a ramp ends within a tick, are between both.
        if (a1 - a0).abs() > 0.03 {
            corners += 1;
            continue;
        }
        assert!(
            (x1 - x0 - period * 0.5 * (v0 + v1)).abs() < 5e-8,
            "{pair:?}"
        );
        let mean = (v1 - v0) / period;
        assert!(
            mean > a0.min(a1) - 4e-4 && mean < a0.max(a1) + 4e-4,
            "{pair:?}"
        );
    }
    // Three of the plan, and two or three of each ramp, which ends within a tick.
    assert!((11..=15).contains(&corners), "{corners}");
    let held = rows.iter().filter(|row| row.1 == PlanState::Held).count();
    // A thousand ticks minus the 320 of the ramp from 40 % to 0.
    assert!((679..=681).contains(&held), "{held}");
    assert_eq!(rows.last().unwrap().1, PlanState::Done);
    // At 40 % in the first part, φ = 0.5 + s²: the speed of the plan times 0.4, its acceleration times 0.16.
    let ([position, omega, alpha], _) = rows[2900];
    let time = (position - 0.5).sqrt();
    assert!((omega - 0.4 * 2.0 * time).abs() < 2e-7, "{omega} {time}");
    assert!((alpha - 0.16 * 2.0).abs() < 1e-6, "{alpha}");
}

/// A plan that ends where it begins repeats without a pause; any other is refused.
#[test]
fn a_closed_plan_is_repeated() {
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    let words = image(&trapezoid(), Domain::Turn);
    let open = PlanFollower::new(Plan::new(&words, &model).unwrap(), 0.001, 0.0, &model).unwrap();
    assert_eq!(open.repeating().map(|_| ()), Err(PlanError::Open));
    // One turn per second at constant speed.
    let knot = |t, position| Knot {
        t,
        position,
        omega: TAU,
        alpha: [0.0; 2],
    };
    let words = image(&[knot(0.0, 1.0), knot(1.0, 1.0 + TAU)], Domain::Turn);
    let plan = Plan::new(&words, &model).unwrap();
    let mut follower = PlanFollower::new(plan, 0.001, 0.0, &model)
        .unwrap()
        .repeating()
        .unwrap();
    follower.start();
    for k in 0..5000 {
        let planned = follower.next(Override::FULL);
        assert_eq!(planned.state, PlanState::Running);
        assert!((f64::from(planned.motion.omega) - TAU).abs() < 1e-5);
        let turns = 1.0 / TAU + f64::from(k) * f64::from(0.001_f32);
        let phase = f64::from(planned.motion.phase.to_bits()) / 2f64.powi(32);
        let apart = phase - turns;
        assert!((apart - apart.round()).abs() < 1e-8, "{k}: {phase} {turns}");
    }
    for (period, ramp) in [(2.0, 0.0), (0.0, 0.0), (0.001, -1.0), (0.001, f32::NAN)] {
        assert!(matches!(
            PlanFollower::new(plan, period, ramp, &model),
            Err(PlanError::Axis(_))
        ));
    }
}

/// A plan with a shortest ramp refuses shorter ones; a plan whose shortest ramp is infinite or unknown accepts any.
#[test]
fn a_ramp_that_is_too_short_is_refused() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let mut words = image(&trapezoid(), Domain::Turn);
    let unknown = Plan::new(&words, &model).unwrap().least_ramp();
    assert_eq!(unknown.to_bits(), 0.0_f32.to_bits());
    for (least, ramp, follows) in [
        (0.2_f32, 0.2_f32, true),
        (0.2, 0.199_99, false),
        (0.2, 0.0, false),
        (0.0, 0.0, true),
        (f32::INFINITY, 0.1, true),
    ] {
        with_ramp(&mut words, least).unwrap();
        let plan = Plan::new(&words, &model).unwrap();
        assert_eq!(plan.least_ramp().to_bits(), least.to_bits());
        let made = PlanFollower::new(plan, 0.001, ramp, &model);
        assert_eq!(made.is_ok(), follows, "{least} {ramp}");
        if let Err(error) = made {
            assert!(error.to_string().contains("the shortest ramp"), "{error}");
        }
    }
    for wrong in [-1.0, f32::NAN] {
        assert!(with_ramp(&mut words, wrong).is_err());
    }
    assert!(with_ramp(&mut [1; 40], 0.1).is_err());
}

/// A ramp of minutes at ticks of microseconds, each of which changes the rate by less than 2⁻²⁵, takes the requested time: its speed, acceleration
/// and distance are those of the closed form.
#[test]
fn a_long_ramp_takes_its_time() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let words = evenly(16.0);
    let plan = Plan::new(&words, &model).unwrap();
    for (period, ramp) in [
        (0.000_025_f32, 1000.0_f32),
        (0.000_062_5, 700.0),
        (0.000_003, 30.0),
    ] {
        let mut follower = PlanFollower::new(plan, period, ramp, &model).unwrap();
        follower.start();
        // The first tick has the commanded rate.
        let first = follower.next(Override::percent(1));
        let per_tick = f64::from(period) / f64::from(ramp);
        let began = first.motion.omega / 2.0;
        assert!((began - 0.01).abs() < 1e-7, "{began}");
        let mut last = first;
        let ticks = 200_000;
        for _ in 0..ticks {
            last = follower.next(Override::FULL);
        }
        // The rate of a tick is the one reached by the ticks before it.
        let changes = f64::from(ticks) - 1.0;
        let rate = began + changes * per_tick;
        let speed = last.motion.omega / 2.0;
        // Single precision of period over ramp, and of the factor of speeds.
        let allowed = 2f64.powi(-22) * changes * per_tick + 2f64.powi(-24) * rate;
        assert!((speed - rate).abs() < allowed, "{period}: {speed} {rate}");
        let alpha = 2.0 / f64::from(ramp);
        let found_alpha = last.motion.alpha;
        assert!(
            (found_alpha - alpha).abs() < 2f64.powi(-22) * alpha,
            "{period}: {found_alpha} {alpha}"
        );
        // One tick at the first rate, then the mean of both ends of each. The position in a row of 16 s is resolved to 32 s·2⁻³².
        let time = f64::from(period) * (began + changes * 0.5 * (began + rate));
        let place = PlanPoint {
            motion: last.motion,
            turns: last.turns,
        };
        let [position, ..] = found(&place, &model);
        assert!(
            (position - 2.0 * time).abs() < 2f64.powi(-22) * 2.0 * time + 2e-8,
            "{period}: {position} {}",
            2.0 * time
        );
    }
}

/// The acceleration of a ramp, ω·dr/dt, to the last digit of the number type and the single precision of a factor: also in 16 bits at a short tick,
/// where the speed gained per tick is a small part of a digit.
#[test]
fn a_ramp_is_as_fine_as_its_numbers() {
    fn check<N: Number>(model: &impl MachineUnits<Number = N>, digit: f64) {
        let words = evenly(100.0);
        let plan = Plan::new(&words, model).unwrap();
        let base = f64::from(model.scale().acceleration());
        let mut worst = 0.0_f64;
        for (period, ramp) in [
            (0.000_5_f32, 0.1_f32),
            (0.000_5, 0.037),
            (0.000_062_5, 0.9),
            (0.000_025, 7.3),
        ] {
            let mut follower = PlanFollower::new(plan, period, ramp, model).unwrap();
            follower.start();
            follower.next(Override::percent(90));
            for (commanded, sign) in [(Override::FULL, 1.0), (Override::percent(50), -1.0)] {
                follower.next(commanded);
                let planned = follower.next(commanded);
                assert!(!planned.limited);
                let alpha = planned.motion.alpha.number().to_f64() * base;
                let exact = sign * 2.0 / f64::from(ramp);
                let error = (alpha - exact).abs();
                let allowed = digit * base + 2f64.powi(-22) * exact.abs();
                assert!(error < allowed, "{ramp}: {alpha} {exact}");
                worst = worst.max(error / (digit * base));
            }
        }
        // The bound is tight: a fifth of a digit would be exceeded.
        assert!(digit == 0.0 || worst > 0.2, "{worst}");
    }
    let scale = scale_of(100.0, 10.0, 0.5);
    check(&in_units::<Spline<f64>>(Domain::Turn, Scale::SI), 0.0);
    check(&in_units::<Spline<f32>>(Domain::Turn, Scale::SI), 0.0);
    // A factor gives an integer of four digits, rounded down; so is a Q15.
    check(
        &in_units::<Spline<Q31>>(Domain::Turn, scale),
        10.0 * 2f64.powi(-31),
    );
    check(
        &in_units::<Rows16>(Domain::Turn, scale),
        1.0001 * 2f64.powi(-15),
    );
}
