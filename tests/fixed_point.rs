//! Fixed point against exact numbers: every rounding of a tick, and saturation of an acceleration.

use crate::support::budget::Q31_UNIT;
use crate::support::exact::place_bits;
use crate::support::machines::Wave;
use crate::support::rows::{Fixed, Rows};
use crate::support::{budget, config, quantity, samples, scale_of, value};
use jred::{
    Acceleration, Cubic, CurveSet, Domain, Model, Outcome, Phase, Q31, Quadratic, Scale, Speed,
    Spline, Torque, curves,
};
use proptest::prelude::*;

const ALL: CurveSet = curves::ALL;

/// The drive torque in machine units, from the curves as the table reads them.
fn torque<L: Fixed>(
    model: &Model<'_, L, ALL>,
    factor: f64,
    phase: Phase,
    omega: Speed<Q31>,
    alpha: Acceleration<Q31>,
) -> f64 {
    let read = model.table().at(phase);
    let (omega, alpha) = (value(omega), value(alpha));
    let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
    let table = model.table();
    let slope = read.inertia_slope * f64::from(table.domain().span()) / f64::from(table.cells());
    let terms = [
        read.inertia * alpha,
        factor * slope * omega * omega,
        -read.load,
        read.viscous * omega,
        read.coulomb * sign,
    ];
    terms.iter().sum()
}

/// Only the stated floors separate the tick from exact, in units of 2⁻³¹.
fn rounds_as_stated<L: Fixed>() {
    let domain = Domain::stroke(0.0, 16.0).unwrap();
    let scale = scale_of(32.0, 2.0, 8.0);
    let wave = (1.5..2.5, 0.1..1.2, -6.0..6.0, 0.4..2.5, 0.4..2.0);
    let machines = samples(40, 0x0011, &wave);
    let states = samples(2000, 0x0012, &(any::<u32>(), any::<i32>(), any::<i32>()));
    let mut errors = Vec::new();
    for (k, (mean, swing, load, viscous, coulomb)) in machines.into_iter().enumerate() {
        let wave = Wave {
            mean,
            swing,
            load,
            viscous,
            coulomb,
            domain,
        };
        // ½·cells/span·J_b·ω_b²/T_b is cells/32: one and three.
        let factor = [1.0, 3.0][k % 2];
        let rows = Rows::<L>::of(&wave, ALL, 32 * factor as u32, &scale).unwrap();
        let model = rows.model::<ALL>(&scale);
        for (bits, omega, alpha) in &states {
            let (omega, alpha) = (
                Speed::<Q31>::from_bits(*omega),
                Acceleration::<Q31>::from_bits(*alpha),
            );
            let phase = Phase::from_bits(*bits);
            let found = model.torque(phase, omega, alpha);
            errors.push((value(found) - torque(&model, factor, phase, omega, alpha)) / Q31_UNIT);
        }
    }
    let count = errors.len() as f64;
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let most = errors.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let bias = errors.iter().sum::<f64>() / count;
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt();
    println!(
        "{} {count} ticks: {least:.2} to {most:.2} units, bias {bias:.3}, RMS {rms:.3}",
        L::NAME
    );
    let [low, high] = budget::Q31_TORQUE_UNITS;
    assert!(low <= least && most <= high, "{least} to {most}");
    assert!(
        least < 0.8 * low && most > 0.5 * high,
        "the stated range is reached: {least} to {most}"
    );
    let within = |[low, high]: [f64; 2], x: f64| (low..=high).contains(&x);
    assert!(within(budget::Q31_TORQUE_BIAS, bias), "bias {bias}");
    assert!(within(budget::Q31_TORQUE_RMS, rms), "RMS {rms}");
}

#[test]
fn q31_torque_rounds_as_stated() {
    rounds_as_stated::<Spline<Q31>>();
    rounds_as_stated::<Cubic<Q31>>();
    rounds_as_stated::<Quadratic<Q31>>();
}

/// Around the ends of the range, unit by unit: T − c·sgn ω against ±J.
fn saturates_exactly<L: Fixed>() {
    let machine = Wave {
        coulomb: 0.125,
        ..Wave::bare(0.5, 0.0)
    };
    let scale = Scale::SI.for_cells(8, core::f64::consts::TAU);
    let rows = Rows::<L>::of(&machine, ALL, 8, &scale).unwrap();
    let model = rows.model::<ALL>(&scale);
    let read = model.table().at(Phase::default());
    let [inertia, friction] = [read.inertia, read.coulomb].map(|x| (x / Q31_UNIT) as i32);
    assert!(friction > 0);
    for sign in [1, -1] {
        for k in -40..40 {
            for omega in [sign, 0, -sign] {
                let net = sign * (inertia + k);
                let drive = Torque::<Q31>::from_bits(net + omega * friction);
                let omega = Speed::<Q31>::from_bits(omega);
                let found = model.acceleration(Phase::default(), omega, drive);
                assert_eq!(found.saturated, k >= 0, "T − J = {k}");
                if k >= 0 {
                    let ends = [Acceleration::<Q31>::MIN, Acceleration::<Q31>::MAX];
                    assert_eq!(found.value, ends[usize::from(sign > 0)]);
                } else {
                    // Towards zero.
                    let exact = (i64::from(net) << 31) / i64::from(inertia);
                    assert_eq!(i64::from(found.value.to_bits()), exact);
                }
            }
        }
        // The net torque itself is up to 1 + c.
        let [end, other] = if sign > 0 {
            [i32::MAX, i32::MIN]
        } else {
            [i32::MIN, i32::MAX]
        };
        let (omega, torque) = (
            Speed::<Q31>::from_bits(other),
            Torque::<Q31>::from_bits(end),
        );
        let found = model.acceleration(Phase::default(), omega, torque);
        assert_eq!(
            found,
            Outcome {
                value: Acceleration::<Q31>::from_bits(end),
                saturated: true
            }
        );
    }
}

#[test]
fn saturation_is_flagged_exactly() {
    saturates_exactly::<Spline<Q31>>();
    saturates_exactly::<Cubic<Q31>>();
    saturates_exactly::<Quadratic<Q31>>();
}

#[test]
fn conversions_flag_what_does_not_fit() {
    let scale = scale_of(2.0, 10.0, 0.5);
    let omega = |omega: f32| scale.omega::<Speed<Q31>>(omega);
    assert_eq!(
        [9.999_999, -10.0, 0.0].map(|w| omega(w).saturated),
        [false; 3]
    );
    assert_eq!(
        [10.0, 11.0, -10.000_01, f32::NAN, f32::INFINITY].map(|w| omega(w).saturated),
        [true; 5]
    );
    assert_eq!(
        [10.0, -11.0].map(|w| omega(w).value),
        [Speed::<Q31>::MAX, Speed::<Q31>::MIN]
    );
    assert_eq!(omega(5.0).value.to_bits(), 1 << 30);
    assert_eq!(
        scale.alpha::<Acceleration<Q31>>(-1.0).value.to_bits(),
        -(1 << 29)
    ); // of T_b/J_b = 4
    assert_eq!(scale.to_torque::<Torque<Q31>>(0.5).value.to_bits(), 1 << 29);
    assert_eq!(
        scale.torque_si(quantity::<Torque<Q31>>(0.25)).to_bits(),
        0.5f32.to_bits()
    );
    assert_eq!(
        scale.omega_si(quantity::<Speed<Q31>>(-0.25)).to_bits(),
        (-2.5f32).to_bits()
    );
    assert_eq!(
        scale
            .alpha_si(quantity::<Acceleration<Q31>>(-0.25))
            .to_bits(),
        (-1.0f32).to_bits()
    );
    assert_eq!(
        scale.omega::<f32>(25.0),
        Outcome {
            value: 2.5,
            saturated: false
        }
    );
}

/// Words of random curves, of any size up to the range and beyond.
fn cell_words<L: Fixed>() -> impl Strategy<Value = Vec<i32>> {
    let (rows, per_row) = if L::NAME == "spline" { (7, 2) } else { (4, 8) };
    let words = prop::collection::vec(any::<i32>(), rows * per_row);
    (words, 1..12u32, 0..3u32).prop_map(move |(words, size, more)| {
        let positive = |k: usize| {
            if L::NAME == "spline" {
                k.is_multiple_of(2)
            } else {
                k.is_multiple_of(8)
            }
        };
        let tame = |(k, word): (usize, i32)| {
            if positive(k) {
                // J, which must not vanish.
                (word >> (6 + more)) + (1 << (if L::NAME == "spline" { 26 } else { 29 }))
            } else {
                word >> (size + more)
            }
        };
        words.into_iter().enumerate().map(tame).collect()
    })
}

/// An accepted cell is read without a wrap, for any size: only floors separate it from exact.
fn reads_without_a_wrap<L: Fixed>(
    words: Vec<i32>,
    bits: u32,
    [value, slope]: [[f64; 2]; 2],
) -> Result<(), TestCaseError> {
    let domain = Domain::stroke(0.0, 1.0).unwrap();
    let rows = Rows::<L>::plain(words, curves::LOAD, 4, domain);
    let Ok(table) = rows.try_table() else {
        return Err(TestCaseError::reject("leaves the range"));
    };
    let phase = Phase::from_bits(bits);
    let (read, exact) = (table.at(phase), rows.exact(phase, place_bits::<L>()));
    let bits = if L::NAME == "spline" { 2.0 } else { 1.0 };
    // J in Q30, its slope times two in Spline, the load in Q29. A cell is a quarter of the stroke.
    for (found, exact, per_raw, [low, high]) in [
        (read.load, exact.load, 4.0, value),
        (read.inertia, exact.inertia, 2.0, value),
        (
            read.inertia_slope / 4.0,
            exact.inertia_slope,
            2.0 / bits,
            slope,
        ),
    ] {
        let error = (found - exact) / Q31_UNIT / per_raw;
        prop_assert!(
            (low - budget::Q31_EXACT_UNITS..=high + budget::Q31_EXACT_UNITS).contains(&error),
            "{error} units"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(512, 0x0008))]

    #[test]
    fn sound_cells_never_wrap_in_spline(words in cell_words::<Spline<Q31>>(), bits: u32) {
        reads_without_a_wrap::<Spline<Q31>>(words, bits, budget::Q31_SPLINE_READ)?;
    }

    #[test]
    fn sound_cells_never_wrap_in_cubic(words in cell_words::<Cubic<Q31>>(), bits: u32) {
        reads_without_a_wrap::<Cubic<Q31>>(words, bits, budget::Q31_CUBIC_READ)?;
    }

    #[test]
    fn sound_cells_never_wrap_in_quadratic(words in cell_words::<Quadratic<Q31>>(), bits: u32) {
        reads_without_a_wrap::<Quadratic<Q31>>(words, bits, budget::Q31_QUADRATIC_READ)?;
    }
}
