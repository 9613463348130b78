//! Harmonics: their evaluation, and the equation of motion with them.

use std::f64::consts::TAU;

use crate::support::harmonics::{
    Waves, fitted, model, phases, press, request, series, waves, words_of,
};
use crate::support::{assert_near, budget, config, largest};
use jred::harmonic::{Circular, terms};
use jred::machine::Reducible;
use jred::number::{Number, Real};
use jred::table::{Format, Usage};
use jred::{CurveSet, Harmonic, Phase, curves};
use proptest::prelude::*;

#[test]
fn sine_and_cosine_keep_their_bounds() {
    let error = |found: (f64, f64), phase: Phase| {
        // The nearest quarter turn is subtracted exactly, as a multiple of 2³⁰.
        let quarter = phase.to_bits().wrapping_add(1 << 29) >> 30;
        let x = f64::from(phase.to_bits().wrapping_sub(quarter << 30) as i32) * TAU / 2f64.powi(32);
        let (s, c) = x.sin_cos();
        let (s, c) = [(s, c), (c, -s), (-s, -c), (-c, s)][quarter as usize];
        (found.0 - s).abs().max((found.1 - c).abs())
    };
    let edges = [
        0u32,
        1,
        1 << 29,
        (1 << 29) - 1,
        1 << 30,
        1 << 31,
        3 << 30,
        u32::MAX,
    ];
    let all = || phases(1 << 20).chain(edges.map(Phase::from_bits));
    let single = largest(all().map(|phase| {
        let (s, c) = f32::sin_cos_of(phase);
        error((f64::from(s), f64::from(c)), phase)
    }));
    let double = largest(all().map(|phase| error(f64::sin_cos_of(phase), phase)));
    println!("sine and cosine: f32 {single:e}, f64 {double:e}");
    assert_near(
        "f32",
        single,
        budget::SIN_COS_F32 * 0.75,
        budget::SIN_COS_F32 * 0.25,
    );
    assert!(double <= budget::SIN_COS_F64, "{double:e}");
    // Independent of the quarters: the angle in radians, rounded to 2⁻⁵³ of 2π.
    for phase in all() {
        let (s, c) = f64::sin_cos_of(phase);
        assert_near("sin", s, phase.radians().sin(), 4.0 * budget::SIN_COS_F64);
        assert_near("cos", c, phase.radians().cos(), 4.0 * budget::SIN_COS_F64);
    }
}

/// Relative to the sum of the coefficients' magnitudes.
fn rounding<T>(waves: &Waves) -> f64
where
    T: Circular + Number,
    Harmonic<T>: Format<Number = T, Word = T, Constants = ()>,
{
    let words: Vec<T> = words_of(waves)
        .into_iter()
        .map(<T as Real>::from_f64)
        .collect();
    let model = model::<T, { curves::ALL | terms::GENERAL }>(&words).unwrap();
    // Coefficients as represented by the type.
    let held = |c: &[[f64; 2]]| -> Vec<[f64; 2]> {
        c.iter()
            .map(|p| p.map(|x| Real::to_f64(<T as Real>::from_f64(x))))
            .collect()
    };
    let held = [held(&waves.inertia), held(&waves.load)];
    let size = |c: &[[f64; 2]], weight: &dyn Fn(usize) -> f64| -> f64 {
        c.iter()
            .enumerate()
            .map(|(k, [a, b])| weight(k) * (a.abs() + b.abs()))
            .sum()
    };
    largest(phases(500).flat_map(|phase| {
        let read = model.table().at(phase);
        let [j, dj, _] = series(&held[0], phase.radians());
        let load = series(&held[1], phase.radians())[0];
        [
            (read.inertia - j) / size(&held[0], &|_| 1.0),
            (read.inertia_slope - dj) / size(&held[0], &|k| k as f64),
            (read.load - load) / size(&held[1], &|_| 1.0),
        ]
    }))
}

#[test]
fn evaluation_rounds_as_stated() {
    let cases = crate::support::samples(60, 0x4a01, &waves());
    let single = largest(cases.iter().map(rounding::<f32>));
    let double = largest(cases.iter().map(rounding::<f64>));
    println!("evaluation: f32 {single:e}, f64 {double:e}");
    assert!(
        (budget::HARMONIC_F32 / 10.0..=budget::HARMONIC_F32).contains(&single),
        "{single:e}"
    );
    assert!(double <= budget::HARMONIC_F64, "{double:e}");
}

proptest! {
    #![proptest_config(config(48, 0x4a03))]

    #[test]
    fn forward_inverts_inverse(waves in waves(), omega in -60f64..60.0, alpha in -400f64..400.0, bits: u32) {
        both_ways::<f64>(&waves, omega, alpha, Phase::from_bits(bits), f64::EPSILON);
        both_ways::<f32>(&waves, omega, alpha, Phase::from_bits(bits), f64::from(f32::EPSILON));
        both_ways::<f32>(&waves, 0.0, alpha, Phase::from_bits(bits), f64::from(f32::EPSILON));
    }
}

/// There and back, the torque against the terms of the reduction, and the range of accelerations.
fn both_ways<T>(waves: &Waves, omega: f64, alpha: f64, phase: Phase, epsilon: f64)
where
    T: Circular + Number<Speed = T, Acceleration = T, Torque = T>,
    Harmonic<T>: Format<Number = T, Word = T, Constants = ()>,
{
    let words: Vec<T> = words_of(waves)
        .into_iter()
        .map(<T as Real>::from_f64)
        .collect();
    let model = model::<T, { curves::ALL | terms::GENERAL }>(&words).unwrap();
    let (w, a) = (<T as Real>::from_f64(omega), <T as Real>::from_f64(alpha));
    let torque = model.torque(phase, w, a);
    let terms = waves
        .reduction(phase.radians())
        .unwrap()
        .torque(omega, alpha);
    let size = largest(terms.values())
        .max(largest(words.iter().map(|x| Real::to_f64(*x))) * omega * omega);
    // About twenty roundings of coefficients, waves and the motion.
    assert_near(
        "torque",
        Real::to_f64(torque),
        terms.total(),
        10.0 * budget::TICK_ROUNDINGS * epsilon * size,
    );
    let inertia = model.table().at(phase).inertia;
    let back = model.acceleration(phase, w, torque).value;
    let rounding = budget::TICK_ROUNDINGS * epsilon * size / inertia;
    assert_near("alpha", Real::to_f64(back), Real::to_f64(a), rounding);
    let more = torque + <T as Real>::from_f64(10.0);
    let range = model.acceleration_range(phase, w, torque, more);
    assert_eq!(range.least.value, back);
    assert_eq!(
        range.greatest.value,
        model.acceleration(phase, w, more).value
    );
    let gained = Real::to_f64(range.greatest.value) - Real::to_f64(range.least.value);
    assert_near(
        "range",
        gained,
        10.0 / inertia,
        2.0 * rounding + 4.0 * epsilon * 10.0 / inertia,
    );
}

/// A free machine keeps ½·J·ω²: the slope is that of the same J, in f32 coefficients as well.
#[test]
fn free_machine_keeps_its_energy() {
    let (_, words) = fitted::<f64, { curves::INERTIA | terms::INERTIA_COS }>(
        &press().with_gravity([0.0, 0.0]).unwrap(),
        &request(1.0, 16),
    )
    .unwrap();
    let model = model::<f64, { curves::INERTIA | terms::INERTIA_COS }>(&words).unwrap();
    let energy = |phi: f64, omega: f64| {
        0.5 * model.table().at(Phase::from_radians(phi)).inertia * omega * omega
    };
    let step = TAU / 4096.0;
    let mut omega = 10.0;
    let start = energy(0.0, omega);
    // dω/dφ = α/ω
    let slope = |phi: f64, w: f64| model.acceleration(Phase::from_radians(phi), w, 0.0).value / w;
    for k in 0..2 * 4096 {
        omega = crate::support::rk4(slope, f64::from(k) * step, omega, step);
        let phi = f64::from(k + 1) * step;
        assert_near(
            "energy",
            energy(phi, omega),
            start,
            budget::HARMONIC_ENERGY * start,
        );
    }
    // Energy is exchanged: the speed is not constant.
    let quarter = model.table().at(Phase::from_radians(TAU / 4.0)).inertia
        / model.table().at(Phase::default()).inertia;
    assert!(quarter > 4.0, "{quarter}");
}

/// J = 2 + Σ bₖ·sin kφ and load of cosines alone: tables of half of the terms, against the sums written out.
#[test]
fn curves_of_sines_or_cosines_alone() {
    const SET: CurveSet = curves::LOAD | terms::INERTIA_SIN | terms::LOAD_COS;
    let sines = [0.3, -0.2, 0.05];
    let cosines = [1.5, 0.4, -0.7];
    let mut words = vec![2.0, 3.0];
    words.extend(sines.iter().zip(cosines).flat_map(|(b, a)| [*b, a]));
    let model = model::<f64, SET>(&words).unwrap();
    let sum = |c: [f64; 3], f: &dyn Fn(f64) -> f64| -> f64 {
        let terms = c.iter().zip([1.0, 2.0, 3.0]);
        terms.map(|(c, k)| c * f(k)).sum()
    };
    for phase in phases(100) {
        let phi = phase.radians();
        let read = model.table().at(phase);
        let near = |what: &str, found: f64, expected: f64| {
            assert_near(what, found, expected, budget::IDENTITY * 10.0);
        };
        near("J", read.inertia, 2.0 + sum(sines, &|k| (k * phi).sin()));
        near(
            "J′",
            read.inertia_slope,
            sum(sines, &|k| k * (k * phi).cos()),
        );
        near("load", read.load, 3.0 + sum(cosines, &|k| (k * phi).cos()));
    }
}

/// Attained bounds: all coefficients are positive, so everything is largest at φ = 0.
#[test]
fn usage_is_the_sum_of_the_coefficients() {
    const SET: CurveSet = curves::ALL
        | curves::CONSTANT_COULOMB
        | terms::INERTIA_COS
        | terms::LOAD_COS
        | terms::VISCOUS_COS
        | terms::COULOMB_COS;
    // J, load, b, c and the constant part of c; then a harmonic of each of the four, and another.
    let words = [
        2.0, 0.5, 0.2, 0.3, 0.7, 0.4, 1.5, 0.05, 0.1, 0.2, 0.25, 0.02, 0.04,
    ];
    let model = model::<f32, SET>(&words).unwrap();
    let usage = Usage::of(model.table()).unwrap();
    let read = model.table().at(Phase::default());
    for (what, found, expected) in [
        ("J", usage.inertia, read.inertia),
        ("load", usage.load, read.load),
        ("b", usage.viscous, read.viscous),
        ("c", usage.coulomb, read.coulomb),
        // ½·Σ k·aₖ
        ("½·J′", usage.velocity, 0.5 * (0.4 + 2.0 * 0.2)),
        (
            "T",
            usage.torque,
            0.4 + read.inertia + read.load + read.viscous + read.coulomb,
        ),
    ] {
        assert_near(what, found.into(), expected, 1e-5);
    }
}
