//! Fixed point against exact numbers: rounding, saturation, and scales that leave room.

mod support;

use jred::table::curves;
use jred::{Domain, Model, Outcome, Phase, Q31, Reducible, Scale, Table};
use proptest::prelude::*;
use support::budget::Q31_UNIT;
use support::machines::{Wave, spec};
use support::{assert_near, budget, config, largest, model, number, samples, words};

const ALL: u8 = curves::ALL;

/// The terms of the drive torque in machine units, from the curves as the table reads them.
fn terms(
    model: &Model<'_, Q31, ALL>,
    factor: f64,
    phase: Phase,
    [omega, alpha]: [Q31; 2],
) -> [f64; 5] {
    let read = model.table().at(phase);
    let [omega, alpha] = [omega, alpha].map(|x| x.to_bits() as f64 * Q31_UNIT);
    let of = |x: Q31| f64::from(x.to_bits()) * Q31_UNIT;
    let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
    [
        of(read.inertia) * alpha,
        factor * of(read.inertia_slope) * omega * omega,
        -of(read.load),
        of(read.viscous) * omega,
        of(read.coulomb) * sign,
    ]
}

/// Where ½·cells/span·J_b·ω_b²/T_b is a power of two, nothing but the stated floors separates the tick from exact.
#[test]
fn q31_torque_rounds_as_stated() {
    let domain = Domain::stroke(0.0, 16.0).unwrap();
    let scale = Scale::new(32.0, 2.0, 4.0).unwrap();
    let factor = 0.5 * 32.0 / 16.0 * (4.0 * 2.0 * 2.0 / 32.0);
    let wave = (1.5..2.5, 0.1..1.2, -8.0..8.0, 0.4..3.0, 0.4..2.0);
    let machines = samples(40, 0x0011, &wave);
    let states = samples(2000, 0x0012, &(any::<u32>(), any::<i32>(), any::<i32>()));
    let mut errors = Vec::new();
    for (mean, swing, load, viscous, coulomb) in machines {
        let wave = Wave {
            mean,
            swing,
            load,
            viscous,
            coulomb,
            domain,
        };
        let words = words::<Q31, ALL>(&wave, 32, &scale).unwrap();
        let model = model::<Q31, ALL>(&words, 32, domain, &scale);
        for (bits, omega, alpha) in &states {
            let state = [*omega, *alpha].map(Q31::from_bits);
            let exact: f64 = terms(&model, factor, Phase::from_bits(*bits), state)
                .iter()
                .sum();
            let found = model.torque(Phase::from_bits(*bits), state[0], state[1]);
            assert_eq!(found.saturated, !(-1.0..1.0).contains(&exact), "{exact}");
            if !found.saturated {
                errors.push(f64::from(found.value.to_bits()) - exact / Q31_UNIT);
            }
        }
    }
    let count = errors.len() as f64;
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let most = errors.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let bias = errors.iter().sum::<f64>() / count;
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt();
    println!("{count} ticks: {least:.2} to {most:.2} units, bias {bias:.3}, RMS {rms:.3}");
    assert!(count > 50_000.0, "few states saturate");
    let within = |[low, high]: [f64; 2], x: f64| (low..=high).contains(&x);
    assert!(within(budget::Q31_TORQUE_UNITS, least) && within(budget::Q31_TORQUE_UNITS, most));
    assert!(within(budget::Q31_TORQUE_BIAS, bias), "bias {bias}");
    assert!(within(budget::Q31_TORQUE_RMS, rms), "RMS {rms}");
}

/// Around the ends of the range, unit by unit.
#[test]
fn saturation_is_flagged_exactly() {
    let machine = Wave {
        coulomb: 0.75,
        ..Wave::bare(0.5, 0.0)
    };
    let words = words::<Q31, ALL>(&machine, 8, &Scale::SI).unwrap();
    let model = model::<Q31, ALL>(&words, 8, Domain::Turn, &Scale::SI);
    let read = model.table().at(Phase::default());
    let (inertia, friction) = (
        i128::from(read.inertia.to_bits()),
        i128::from(read.coulomb.to_bits()),
    );
    let mut flagged = [0, 0];
    for sign in [1, -1] {
        // J·α + c reaches ±1 near α = ±0.5.
        for k in -200..200 {
            let alpha = sign * ((1 << 30) + k);
            let exact = ((inertia * i128::from(alpha)) >> 31) + i128::from(sign) * friction;
            let clamped = exact.clamp(i128::from(i32::MIN), i128::from(i32::MAX));
            let found = model.torque(
                Phase::default(),
                Q31::from_bits(sign),
                Q31::from_bits(alpha),
            );
            let expected = Outcome {
                value: Q31::from_bits(clamped as i32),
                saturated: clamped != exact,
            };
            assert_eq!(found, expected, "α = {alpha}");
            flagged[usize::from(found.saturated)] += 1;
        }
        // T/J reaches ±1 at T = ±J.
        for k in -40..40 {
            let torque = sign * (inertia as i32 + k);
            let found =
                model.acceleration(Phase::default(), Q31::default(), Q31::from_bits(torque));
            assert_eq!(found.saturated, k >= 0, "T − J = {k}");
            if k >= 0 {
                assert_eq!(found.value, if sign > 0 { Q31::MAX } else { Q31::MIN });
            } else {
                let exact = f64::from(torque) / inertia as f64;
                assert_near(
                    "α",
                    f64::from(found.value.to_bits()) * Q31_UNIT,
                    exact,
                    Q31_UNIT,
                );
            }
        }
    }
    assert!(flagged.iter().all(|count| *count > 300), "{flagged:?}");
}

#[test]
fn conversions_flag_what_does_not_fit() {
    let scale = Scale::new(2.0, 10.0, 0.5).unwrap();
    let omega = |omega: f32| scale.omega::<Q31>(omega);
    assert_eq!(
        [9.999_999, -10.0, 0.0].map(|w| omega(w).saturated),
        [false; 3]
    );
    assert_eq!(
        [10.0, 11.0, -10.000_01, f32::NAN, f32::INFINITY].map(|w| omega(w).saturated),
        [true; 5]
    );
    assert_eq!([10.0, -11.0].map(|w| omega(w).value), [Q31::MAX, Q31::MIN]);
    assert_eq!(omega(5.0).value.to_bits(), 1 << 30);
    assert_eq!(scale.alpha::<Q31>(-1.0).value.to_bits(), -(1 << 29)); // of T_b/J_b = 4
    assert_eq!(scale.to_torque::<Q31>(0.5).value.to_bits(), 1 << 29);
    assert_eq!(
        scale.torque_si(number::<Q31>(0.25)).to_bits(),
        0.5f32.to_bits()
    );
    assert_eq!(
        scale.alpha_si(number::<Q31>(-0.25)).to_bits(),
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

/// Rows of the load and, in the same place, of an inertia; some leave the range.
fn cell_rows() -> impl Strategy<Value = [Vec<i32>; 2]> {
    let rows = prop::collection::vec(-1f64..1.0, 7);
    (rows, -0.25..0.25, -8.0..-1.0).prop_map(|(rows, mean, size)| {
        let load = |row: &f64| number::<Q31>(mean + f64::exp2(size) * row).to_bits();
        let inertia = |row: &f64| number::<Q31>(0.07 * (1.0 + 0.5 * row)).to_bits();
        [
            rows.iter().map(load).collect(),
            rows.iter().map(inertia).collect(),
        ]
    })
}

proptest! {
    #![proptest_config(config(512, 0x0008))]

    /// A cell that is let in is read without a wrap, whatever its size: floors are all that separates it from exact.
    #[test]
    fn sound_cells_never_wrap([load, inertia] in cell_rows(), bits: u32) {
        let words: Vec<i32> = inertia.iter().zip(&load).flat_map(|(j, load)| [*j, *load]).collect();
        let Ok(table) = Table::<Q31>::new(&words, curves::LOAD, 4, false) else {
            return Err(TestCaseError::reject("leaves the range"));
        };
        let phase = Phase::from_bits(bits);
        let (cell, fraction) = phase.cell(4);
        let u = f64::from(fraction) / 4_294_967_296.0;
        // The B-spline's own basis functions (in sixths) and their slopes, not the power form of the code.
        let basis = [
            (1.0 - u).powi(3),
            3.0 * u.powi(3) - 6.0 * u * u + 4.0,
            -3.0 * u.powi(3) + 3.0 * u * u + 3.0 * u + 1.0,
            u.powi(3),
        ];
        let slopes = [-3.0 * (1.0 - u).powi(2), 9.0 * u * u - 12.0 * u, -9.0 * u * u + 6.0 * u + 3.0, 3.0 * u * u];
        let sum = |rows: &[i32], weights: [f64; 4]| -> f64 {
            rows[cell as usize..].iter().zip(weights).map(|(row, weight)| f64::from(*row) * weight).sum()
        };
        let read = table.at(phase);
        for (found, exact, floors) in [
            (read.load, sum(&load, basis), budget::Q31_VALUE_UNITS),
            (read.inertia, sum(&inertia, basis), budget::Q31_VALUE_UNITS),
            (read.inertia_slope, sum(&inertia, slopes), budget::Q31_SLOPE_UNITS),
        ] {
            let error = f64::from(found.to_bits()) - exact;
            prop_assert!((-floors..=budget::Q31_EXACT_UNITS).contains(&error), "{error} units");
        }
    }

    /// No state inside the stated ones saturates, and none does on the way back.
    #[test]
    fn covering_scale_covers_inverse_dynamics(
        spec in spec(), omega in 1.0..200.0, alpha in 1.0..5000.0, w in -1f64..1.0, a in -1f64..1.0, bits: u32,
    ) {
        let machine = spec.machine();
        let scale = Scale::covering(&machine, omega, alpha, 256).unwrap();
        let words = words::<Q31, ALL>(&machine, 128, &scale).unwrap();
        let table = Table::new(&words, 128, true).unwrap();
        let model = Model::<Q31, ALL>::new(table, core::f32::consts::TAU, &scale);
        let model = model.expect("the scale covers the velocity torque");
        for [w, a] in [[w, a], [w.signum(), a.signum()], [-w.signum(), a.signum()]] {
            let (speed, accel) = (scale.omega::<Q31>((omega * w) as f32), scale.alpha::<Q31>((alpha * a) as f32));
            prop_assert!(!speed.saturated && !accel.saturated);
            let torque = model.torque(Phase::from_bits(bits), speed.value, accel.value);
            prop_assert!(!torque.saturated, "torque {torque:?}");
            let back = model.acceleration(Phase::from_bits(bits), speed.value, torque.value);
            prop_assert!(!back.saturated, "acceleration {back:?}");
        }
    }
}

/// An inertia that swings little, a high speed, a small acceleration: the velocity torque alone sets the base.
#[test]
fn covering_scale_covers_the_velocity_torque() {
    let machine = Wave::bare(1.0, 0.01);
    let scale = Scale::covering(&machine, 100.0, 0.1, 256).unwrap();
    let words = words::<Q31, 0>(&machine, 64, &scale).unwrap();
    let table = Table::<Q31>::new(&words, 0, 64, true).unwrap();
    let built = Model::new(table, core::f32::consts::TAU, &scale);
    assert!(built.is_ok(), "{:?} with {scale:?}", built.err());
}

/// A torque as large as the stated motions need, where speed and friction add to it, and where the inertia is least.
#[test]
fn covering_scale_covers_forward_dynamics() {
    let machine = Wave {
        viscous: 0.5,
        ..Wave::bare(1.0, 0.5)
    };
    let scale = Scale::covering(&machine, 10.0, 20.0, 256).unwrap();
    let words = words::<Q31, ALL>(&machine, 64, &scale).unwrap();
    let model = model::<Q31, ALL>(&words, 64, Domain::Turn, &scale);
    let needed = (0..256).map(|k| {
        let place = machine.reduction(f64::from(k) / 40.0).unwrap();
        place.torque(10.0, 20.0).total()
    });
    let torque = scale.to_torque::<Q31>(largest(needed) as f32).value;
    for k in 0..64u32 {
        for speed in [-10.0, 0.0, 10.0] {
            let omega = scale.omega::<Q31>(speed).value;
            let found = model.acceleration(Phase::from_bits(k << 26), omega, torque);
            assert!(!found.saturated, "at {k}/64 of a turn and {speed} rad/s");
        }
    }
}

/// A slope of −1002 units, which the tick may round to −1003, times 2³¹/1002.5 is −1 but for a hair: it must be refused,
/// or the tick would wrap to +1.
#[test]
fn a_slope_whose_rounding_leaves_the_range_is_refused() {
    let words = [0, -165, -332, -499, -666, -833, -1000].map(|step| (1 << 27) + step);
    let table = Table::<Q31>::new(&words, curves::INERTIA, 4, false).unwrap();
    // ½·4 cells/span 2 = 1, and J_b·ω_b²/T_b is the rest of the factor.
    let build = |factor: f32| {
        let scale = Scale::new(1.0, factor.sqrt(), 1.0).unwrap();
        Model::new(table, 2.0, &scale)
    };
    let edge = 2_147_483_648.0 / 1002.5;
    assert!(build(edge).is_err());
    let model = build(0.9 * edge).unwrap();
    for k in 0..4096 {
        let phase = Phase::from_bits(k << 20);
        let torque = model.torque(phase, Q31::MIN, Q31::from_bits(0));
        assert!(torque.value.to_bits() < 0, "{k}: {torque:?}");
    }
}

/// A machine so slow that J′ never counts: the velocity factor is below one unit, and the model is built all the same.
#[test]
fn a_very_slow_machine_has_a_model() {
    let machine = Wave::bare(1.0, 0.25);
    let scale = Scale::new(1e5, 1e-3, 1.5).unwrap();
    let words = words::<Q31, { curves::INERTIA }>(&machine, 64, &scale).unwrap();
    let table = Table::<Q31>::new(&words, curves::INERTIA, 64, true).unwrap();
    let model = Model::new(table, core::f32::consts::TAU, &scale).unwrap();
    // ½·J′·ω² is 1e-7 N·m of 1e5: less than one unit.
    let torque = model.torque(Phase::from_radians(1.0), Q31::MAX, Q31::from_bits(0));
    assert!(torque.value.to_bits().abs() <= 1, "{torque:?}");
}
