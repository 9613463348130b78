use core::f64::consts::TAU;

use jred::axis::{MotionState, Period};
use jred::machine::Reducible;
use jred::{
    Acceleration, Cubic, CurveSet, Domain, Phase, Q15, Q31, Rows16, Scale, Speed, Spline, curves,
};

use super::machine::{WAVE, in_units, si, with_model};
use crate::support::{assert_near, quantity, samples, scale_of, value};

/// Runge-Kutta steps of the exact machine under a constant torque: angle and speed after `time`.
fn driven(torque: f64, [phi, omega]: [f64; 2], time: f64) -> [f64; 2] {
    let alpha = |[phi, omega]: [f64; 2]| WAVE.reduction(phi).unwrap().acceleration(omega, torque);
    let steps = 64;
    let h = time / f64::from(steps);
    let mut at = [phi, omega];
    for _ in 0..steps {
        let step = |by: [f64; 2], h: f64| [at[0] + h * by[0], at[1] + h * by[1]];
        let k1 = [at[1], alpha(at)];
        let p2 = step(k1, h / 2.0);
        let k2 = [p2[1], alpha(p2)];
        let p3 = step(k2, h / 2.0);
        let k3 = [p3[1], alpha(p3)];
        let p4 = step(k3, h);
        let k4 = [p4[1], alpha(p4)];
        for j in 0..2 {
            at[j] += h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
        }
    }
    at
}

#[test]
fn the_middle_of_a_tick_is_one_order_better() {
    const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        for (bits, from, alpha) in samples(
            40,
            0xff02,
            &(proptest::num::u32::ANY, 2.0..8.0, -60.0..60.0),
        ) {
            let phase = Phase::from_bits(bits);
            let phi = f64::from(bits) / 4_294_967_296.0 * TAU;
            let missed = |time: f64| {
                let to = from + alpha * time;
                let period = Period::new(time as f32, &model).unwrap();
                let middle = period.between(phase, from, to).value;
                let torque = |m: MotionState<f64>| model.torque(m.phase, m.omega, m.alpha);
                let start = MotionState {
                    phase,
                    omega: from,
                    alpha,
                };
                [middle, start].map(|motion| driven(torque(motion), [phi, from], time)[1] - to)
            };
            let [coarse, fine] = [missed(0.02), missed(0.01)];
            // Second order at the start: a quarter. Third order in the middle: an eighth, unless it is zero by chance.
            assert!(
                coarse[0].abs() < 0.2 * coarse[1].abs() + 2e-4,
                "{phi}: {coarse:?}"
            );
            assert!(
                fine[0].abs() < 0.16 * coarse[0].abs() + 2e-6,
                "{phi}: {coarse:?} {fine:?}"
            );
        }
    });
}

/// The middle of a period: mean of the speeds, half of the distance, change of speed over time, in every number type.
#[test]
fn the_middle_of_a_tick_is_the_mean() {
    let scale = scale_of(150.0, 10.0, 1.5);
    let time = 0.001;
    let double = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let long = in_units::<Spline<Q31>>(Domain::Turn, scale);
    let short = in_units::<Rows16>(Domain::Turn, scale);
    let double = Period::new(time as f32, &double).unwrap();
    let long = Period::new(time as f32, &long).unwrap();
    let short = Period::new(time as f32, &short).unwrap();
    for (from, to) in [
        (3.0, 3.02),
        (-4.0, -4.05),
        (-0.02, 0.03),
        (9.9, 9.85),
        (0.0, 0.0),
    ] {
        let check = |name: &str, phase: Phase, [omega, alpha]: [f64; 2], unit: f64| {
            let moved = f64::from(phase.to_bits().cast_signed()) / 4_294_967_296.0 * TAU;
            let mean = 0.5 * (from + to);
            assert_near(&format!("{name} speed"), omega, mean, 10.0 * unit);
            let way = 0.5 * mean * time;
            assert_near(
                &format!("{name} angle"),
                moved,
                way,
                5.0 * unit * time + 5e-9,
            );
            // The speeds are rounded before they are subtracted.
            let gain = (to - from) / time;
            assert_near(
                &format!("{name} acceleration"),
                alpha,
                gain,
                10.0 * unit / time + 1e-5 * gain.abs(),
            );
        };
        let middle = double.between(Phase::default(), from, to).value;
        check("f64", middle.phase, [middle.omega, middle.alpha], 1e-9);
        let speeds = [from, to].map(|omega| si::<Q31>(&scale, [omega, 0.0]).0);
        let middle = long.between(Phase::default(), speeds[0], speeds[1]).value;
        let found = [value(middle.omega) * 10.0, value(middle.alpha) * 100.0];
        // The speeds have single precision.
        check("q31", middle.phase, found, 1e-7);
        let speeds = [from, to].map(|omega| si::<Q15>(&scale, [omega, 0.0]).0);
        let middle = short.between(Phase::default(), speeds[0], speeds[1]).value;
        let found = [value(middle.omega) * 10.0, value(middle.alpha) * 100.0];
        check("q15", middle.phase, found, 1.0 / 32_768.0);
    }
}

#[test]
fn a_lead_time_is_made_up_for() {
    let scale = scale_of(150.0, 10.0, 1.5);
    let double = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let long = in_units::<Spline<Q31>>(Domain::Turn, scale);
    let short = in_units::<Rows16>(Domain::Turn, scale);
    for (omega, alpha, lead) in [
        (3.0, -40.0, 0.002),
        (-7.0, 80.0, 0.001),
        (0.0, 90.0, 0.01),
        (5.0, 0.0, 0.000_1),
    ] {
        let [moved, later] = [
            omega * lead + 0.5 * alpha * lead * lead,
            omega + alpha * lead,
        ];
        let check = |name: &str, phase: Phase, found: f64, error: f64| {
            let turned = f64::from(phase.to_bits().cast_signed()) / 4_294_967_296.0 * TAU;
            assert_near(&format!("{name} angle"), turned, moved, error * lead + 1e-8);
            assert_near(&format!("{name} speed"), found, later, error);
        };
        let start = MotionState {
            phase: Phase::default(),
            omega,
            alpha,
        };
        let after = Period::new(lead as f32, &double)
            .unwrap()
            .later(start)
            .value;
        check("f64", after.phase, after.omega, 1e-6);
        let (w, a) = si::<Q31>(&scale, [omega, alpha]);
        let start = MotionState {
            phase: Phase::default(),
            omega: w,
            alpha: a,
        };
        let after = Period::new(lead as f32, &long).unwrap().later(start).value;
        check("q31", after.phase, value(after.omega) * 10.0, 1e-5);
        let (w, a) = si::<Q15>(&scale, [omega, alpha]);
        let start = MotionState {
            phase: Phase::default(),
            omega: w,
            alpha: a,
        };
        let after = Period::new(lead as f32, &short).unwrap().later(start).value;
        check("q15", after.phase, value(after.omega) * 10.0, 2e-3);
    }
}

#[test]
fn a_limited_motion_is_flagged_and_a_stroke_ends() {
    let scale = scale_of(10.0, 30.0, 1.0);
    let model = in_units::<Spline<Q31>>(Domain::Turn, scale);
    let time = Period::new(0.001, &model).unwrap();
    let fast: Speed<Q31> = quantity(0.8);
    assert!(
        time.between(Phase::default(), Speed::default(), fast)
            .saturated
    );
    assert!(!time.between(Phase::default(), fast, fast).saturated);
    let strong = in_units::<Spline<Q31>>(Domain::Turn, scale_of(1000.0, 30.0, 1.0));
    let long = Period::new(0.05, &strong).unwrap();
    let start = MotionState {
        phase: Phase::default(),
        omega: fast,
        alpha: Acceleration::<Q31>::MAX,
    };
    assert!(long.later(start).saturated);
    assert!(
        !long
            .later(MotionState {
                alpha: Acceleration::default(),
                ..start
            })
            .saturated
    );
    // At most a quarter of a turn per period at the speed base.
    assert!(Period::new(0.25 * TAU as f32 / 30.0 * 1.01, &model).is_err());
    assert!(Period::new(0.25 * TAU as f32 / 30.0 * 0.99, &model).is_ok());
    // Up to half a turn, also in floating point.
    let lead = Period::new(0.006, &in_units::<Spline<f64>>(Domain::Turn, Scale::SI)).unwrap();
    let ahead = lead.later(MotionState {
        phase: Phase::default(),
        omega: 100.0 * core::f64::consts::PI / 4.0,
        alpha: 0.0,
    });
    assert_near(
        "turns",
        f64::from(ahead.value.phase.to_bits()) / 4_294_967_296.0,
        0.075,
        1e-6,
    );
    let ahead = lead.later(MotionState {
        phase: Phase::default(),
        omega: 450.0,
        alpha: 0.0,
    });
    assert_near(
        "turns",
        f64::from(ahead.value.phase.to_bits()) / 4_294_967_296.0,
        450.0 * 0.006 / TAU,
        1e-6,
    );

    let stroke = Domain::stroke(0.0, 0.5).unwrap();
    let time = Period::new(0.01, &in_units::<Spline<f64>>(stroke, Scale::SI)).unwrap();
    for (phase, omega, end) in [(0xffff_0000, 1.0, u32::MAX), (0x0001_0000, -1.0, 0)] {
        let start = MotionState {
            phase: Phase::from_bits(phase),
            omega,
            alpha: 0.0,
        };
        assert_eq!(time.later(start).value.phase.to_bits(), end);
        assert_eq!(
            time.between(start.phase, omega, omega)
                .value
                .phase
                .to_bits(),
            end
        );
    }
}

/// Rounded down, a motion would drop by a unit in each tick with almost no change.
#[test]
fn a_short_motion_gains_alike_both_ways() {
    let scale = scale_of(150.0, 10.0, 1.5);
    let tick = Period::new(0.000_1, &in_units::<Rows16>(Domain::Turn, scale)).unwrap();
    for alpha in samples(200, 0xff14, &(0.0..90.0)) {
        let gain = |alpha: f64| {
            let (_, a) = si::<Q15>(&scale, [0.0, alpha]);
            (
                value(tick.gained(a).value),
                value(a) * 100.0 * 0.000_1 / 10.0,
            )
        };
        let [(up, exact), (down, _)] = [gain(alpha), gain(-alpha)];
        let unit = 1.0 / 32_768.0;
        assert_near("up", up, exact, 0.51 * unit);
        assert_near("down", down, -exact, 0.51 * unit + 1.1e-3 * unit);
    }
}
