use core::f64::consts::TAU;

use jred::axis::{Observed, Observer};
use jred::machine::{FreeMotion, Reducible as _};
use jred::number::FrictionSign;
use jred::table::{Format, SpeedOf, TorqueOf};
use jred::{CurveSet, Domain, Model, Phase, Q31, Rows16, Scale, Spline, curves};

use super::machine::{with_model, with_model_of};
use super::watched::Noise;
use crate::support::machines::Wave;
use crate::support::{assert_near, budget, scale_of, value};

const UNIT: f64 = 1.0 / 4_294_967_296.0;
const BARE: CurveSet = curves::INERTIA;

/// The share of a load that is seen n periods after it began, from (1 − θ)³·½·(1 + q)/(1 − θ·q)³: sums of a negative binomial distribution.
fn seen(theta: f64, n: i32) -> f64 {
    let rest = 1.0 - theta;
    let three_lags = |n: i32| {
        if n < 1 {
            return 0.0;
        }
        let m = f64::from(n);
        let tail = 1.0 + m * rest + 0.5 * m * (m + 1.0) * rest * rest;
        1.0 - theta.powi(n) * tail
    };
    0.5 * (three_lags(n) + three_lags(n - 1))
}

/// Phase of an angle.
fn phase(phi: f64) -> Phase {
    Phase::from_bits(((phi / TAU).rem_euclid(1.0) / UNIT) as u32)
}

fn torque<F: Format>(model: &Model<'_, F, BARE>, torque: f64) -> TorqueOf<F> {
    model.table().scale().to_torque(torque as f32).value
}

/// Loads observed for a constant J = 1 kg·m² under a torque, with a load from the first period on, one per period.
fn observed<F: Format>(scale: Scale, bandwidth: f32, drive: f64, load: f64) -> Vec<f64> {
    const PERIOD: f64 = 1e-3;
    let mut loads = Vec::new();
    with_model_of::<F, BARE>(&Wave::bare(1.0, 0.0), scale, |model| {
        let mut observer = Observer::with_bandwidth(bandwidth, PERIOD as f32, &model).unwrap();
        let drive = (drive, torque(&model, drive));
        let alpha = drive.0 + load;
        for k in 1..=600 {
            let time = PERIOD * f64::from(k);
            let measured = phase(0.5 * alpha * time * time);
            let friction = FrictionSign::OfSpeed(SpeedOf::<F>::default());
            let found = observer.update(&model, measured, drive.1, friction);
            assert!(!found.limited && !found.jumped);
            loads.push(value(found.load) * f64::from(scale_in(&model)));
        }
    });
    loads
}

fn scale_in<F: Format>(model: &Model<'_, F, BARE>) -> f32 {
    model.table().scale().torque()
}

#[test]
fn a_load_settles_as_the_closed_form_says() {
    for bandwidth in [10.0f32, 30.0, 60.0, 120.0] {
        let theta = f64::from(1.0 / (1.0 + core::f32::consts::TAU * bandwidth * 1e-3));
        let loads = observed::<Spline<f64>>(Scale::SI, bandwidth, 3.0, 5.0);
        for (n, load) in (1..).zip(&loads) {
            let expected = 5.0 * seen(theta, n);
            assert_near("load", *load, expected, budget::OBSERVED);
        }
        // As the documentation says: half, 90 %, 99 %.
        let rest = 1.0 - theta;
        for (share, periods) in [(0.5, 2.7), (0.9, 5.3), (0.99, 8.4)] {
            let first = loads.iter().position(|load| *load >= 5.0 * share).unwrap() + 1;
            // The discrete filter is a few periods earlier than the continuous one.
            let at = first as f64 * rest;
            assert!(at <= periods + 0.01 && at >= periods - 5.0 * rest, "{at}");
        }
        let most = loads.iter().fold(0.0, |most, load| load.max(most));
        assert!(most < 5.0 + budget::OBSERVED, "{most}");
    }
}

#[test]
fn fixed_point_observes_the_same() {
    let scale = scale_of(50.0, 20.0, 2.0);
    for bandwidth in [20.0, 60.0] {
        let exact = observed::<Spline<f64>>(Scale::SI, bandwidth, 3.0, 5.0);
        let check = |name: &str, loads: &[f64], off: f64| {
            for (load, exact) in loads.iter().zip(&exact) {
                assert_near(name, *load, *exact, off);
            }
        };
        let single = observed::<Spline<f32>>(Scale::SI, bandwidth, 3.0, 5.0);
        check("f32", &single, budget::OBSERVED);
        let long = observed::<Spline<Q31>>(scale, bandwidth, 3.0, 5.0);
        check("q31", &long, budget::OBSERVED);
        let short = observed::<Rows16>(scale, bandwidth, 3.0, 5.0);
        check("q15", &short, 50.0 * budget::OBSERVED_Q15);
    }
}

/// J varies as 3 : 1 over a turn. Wherever a load begins, it is seen as with a constant J.
#[test]
fn a_variable_inertia_settles_the_same() {
    const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
    const PERIOD: f64 = 5e-4;
    let wave = Wave {
        swing: 0.5,
        ..super::machine::WAVE
    };
    let (omega, bandwidth) = (TAU, 25.0);
    let theta = 1.0 / (1.0 + TAU * bandwidth * PERIOD);
    let (mut most, mut before) = (0.0_f64, 0.0_f64);
    with_model_of::<Spline<f64>, SET>(&wave, Scale::SI, |model| {
        for place in 0..16 {
            let start = TAU * f64::from(place) / 16.0;
            let mut plant = FreeMotion::new(&wave, start, omega).unwrap();
            let mut observer = Observer::with_bandwidth(bandwidth as f32, PERIOD as f32, &model)
                .unwrap()
                .at(phase(start));
            for k in -2000..600 {
                let load = if k < 0 { 0.0 } else { 5.0 };
                let here = wave.reduction(plant.phi()).unwrap();
                let drive = here.torque(plant.omega(), 0.0).total() + 5.0 * (omega - plant.omega());
                plant.advance(&wave, drive + load, PERIOD).unwrap();
                let friction = FrictionSign::OfSpeed(omega);
                let found = observer.update(&model, phase(plant.phi()), drive, friction);
                if k >= -1000 {
                    let off = (found.load - load * seen(theta, k + 1)).abs();
                    let side = if k < 0 { &mut before } else { &mut most };
                    *side = side.max(off);
                    assert_near("speed", found.motion.omega, plant.omega(), 0.1);
                }
            }
        }
    });
    assert!(before < budget::OBSERVED_BIAS, "{before}");
    assert!(most < 0.002 * 5.0 && most > 0.001 * 5.0, "{most}");
}

#[test]
fn the_encoder_makes_the_noise_of_the_tracker() {
    let (period, bandwidth) = (1e-3_f32, 30.0_f32);
    let theta = f64::from(1.0 / (1.0 + core::f32::consts::TAU * bandwidth * period));
    with_model_of::<Spline<f32>, BARE>(&Wave::bare(2.0, 0.0), Scale::SI, |model| {
        let mut observer = Observer::with_bandwidth(bandwidth, period, &model).unwrap();
        let count = 1e-4;
        let mut noise = Noise(7);
        let (mut squares, mut number) = (0.0, 0.0);
        for k in 0..100_000 {
            let turn = (noise.uniform() - 0.5) * count;
            let friction = FrictionSign::OfSpeed(0.0);
            let found = observer.update(&model, phase(turn * TAU), 0.0, friction);
            if k > 1000 {
                squares += f64::from(found.load).powi(2);
                number += 1.0;
            }
        }
        let found = f64::sqrt(squares / number);
        let rest: f64 = 1.0 - theta;
        let share = (rest.powi(5) / (2.0 * (1.0 + theta).powi(5))).sqrt();
        let expected = 2.0 * TAU * count / f64::from(period).powi(2) * share;
        assert_near("noise", found / expected, 1.0, budget::NOISE);
    });
}

/// The machine stands; what is wrong in one tick is reported, and forgotten.
#[test]
fn a_torque_that_is_nan_is_flagged_and_forgotten() {
    with_model::<Spline<f32>, BARE>(Scale::SI, |model| {
        let mut observer = Observer::with_bandwidth(50.0, 1e-3, &model).unwrap();
        let rest = FrictionSign::OfSpeed(0.0);
        for torque in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let found = observer.update(&model, Phase::default(), torque, rest);
            assert!(found.limited, "{torque}");
            let mut last = Observed::default();
            for _ in 0..300 {
                last = observer.update(&model, Phase::default(), 0.0, rest);
                assert!(last.load.is_finite() && last.motion.omega.is_finite());
            }
            assert!(!last.limited && !last.jumped, "{torque}: {last:?}");
            assert_near("load", last.load.into(), 0.0, 1e-3);
        }
        let jumped = observer.update(&model, Phase::from_bits(1 << 31), 0.0, rest);
        assert!(jumped.jumped);
        let mut last = jumped;
        for _ in 0..300 {
            last = observer.update(&model, Phase::from_bits(1 << 31), 0.0, rest);
        }
        assert!(!last.jumped && last.load.abs() < 1.0, "{last:?}");
    });
}

/// A weight on a stroke, held by the drive at either end.
#[test]
fn a_stroke_does_not_wrap() {
    let wave = Wave {
        domain: Domain::Stroke { from: 0.0, to: 0.5 },
        ..Wave::bare(2.0, 0.0)
    };
    with_model_of::<Spline<f32>, BARE>(&wave, Scale::SI, |model| {
        for end in [0, u32::MAX] {
            let mut observer = Observer::with_bandwidth(50.0, 1e-3, &model)
                .unwrap()
                .at(Phase::from_bits(end));
            for _ in 0..500 {
                let rest = FrictionSign::OfSpeed(0.0);
                let found = observer.update(&model, Phase::from_bits(end), 20.0, rest);
                assert!(!found.jumped && !found.limited, "{found:?}");
            }
            let found = observer.update(
                &model,
                Phase::from_bits(end),
                20.0,
                FrictionSign::OfSpeed(0.0),
            );
            assert_near("held", found.load.into(), -20.0, 0.1);
        }
    });
}

#[test]
fn observers_that_cannot_be_are_refused() {
    fn refused<F: Format>(scale: Scale) {
        with_model::<F, BARE>(scale, |model| {
            for (bandwidth, period) in [
                (0.0, 1e-3),
                (f32::NAN, 1e-3),
                (-1.0, 1e-3),
                (0.1, 1e-4),
                (50.0, 0.0),
                (50.0, f32::NAN),
                (50.0, f32::INFINITY),
            ] {
                let observer = Observer::<F::Number>::with_bandwidth(bandwidth, period, &model);
                assert!(observer.is_err(), "{bandwidth} {period}");
            }
        });
    }
    refused::<Spline<f32>>(Scale::SI);
    refused::<Spline<Q31>>(scale_of(150.0, 10.0, 1.5));
}
