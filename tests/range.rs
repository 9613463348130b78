//! Proofs when a fixed-point model is built: the terms fit, and then no state wraps.

use std::f64::consts::TAU;

use crate::support::budget::{self, Q31_UNIT};
use crate::support::exact::place_bits;
use crate::support::machines::Wave;
use crate::support::rows::{Fixed, Rows};
use crate::support::{config, scale_of};
use jred::table::{Format, TableError};
use jred::{
    Acceleration, Cubic, CurveSet, Domain, Phase, Q31, Quadratic, Scale, Speed, Spline, curves,
};
use proptest::prelude::*;

const ALL: CurveSet = curves::ALL;
const CONSTANT: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
const CELLS: u32 = 64;

fn built<const SET: CurveSet, L: Fixed>(machine: &Wave, scale: &Scale) -> Result<(), TableError> {
    let rows = Rows::<L>::of(machine, SET, CELLS, scale).unwrap();
    rows.try_model::<SET>(scale).map(|_| ())
}

/// Only J + b + c, exactly: refused from 1 on, for growth of any term.
fn sum_is_bounded<const SET: CurveSet, L: Fixed>() {
    let scale = Scale::SI.for_cells(CELLS, TAU);
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let build = |[j, b, c]: [f64; 3]| {
        let machine = Wave {
            viscous: b * torque / speed,
            coulomb: c * torque,
            ..Wave::bare(j * inertia, 0.0)
        };
        built::<SET, L>(&machine, &scale)
    };
    for share in [
        [0.6, 0.2, 0.2],
        [0.2, 0.6, 0.2],
        [0.2, 0.2, 0.6],
        [0.05, 0.0, 0.95],
        [0.05, 0.95, 0.0],
    ] {
        assert_eq!(build(share.map(|x| x * 0.9999)), Ok(()));
        assert_eq!(
            build(share.map(|x| x * 1.0001)),
            Err(TableError::TorqueRange { cell: 0 })
        );
    }
}

#[test]
fn terms_that_do_not_fit_together_are_refused() {
    sum_is_bounded::<ALL, Spline<Q31>>();
    sum_is_bounded::<ALL, Cubic<Q31>>();
    sum_is_bounded::<ALL, Quadratic<Q31>>();
    sum_is_bounded::<CONSTANT, Spline<Q31>>();
    sum_is_bounded::<CONSTANT, Quadratic<Q31>>();
}

/// A load with one peak is refused in the cells at the peak.
#[test]
fn a_load_that_does_not_fit_is_refused_where_it_does_not() {
    let scale = Scale::SI.for_cells(CELLS, TAU);
    let build = |load: f64| {
        let load = load * f64::from(scale.torque());
        let machine = Wave {
            load,
            ..Wave::bare(0.25 * f64::from(scale.inertia()), 0.0)
        };
        built::<{ curves::LOAD }, Spline<Q31>>(&machine, &scale)
    };
    assert_eq!(build(0.748), Ok(()));
    let refused = build(0.7505);
    assert!(
        matches!(refused, Err(TableError::TorqueRange { cell: 15 | 16 })),
        "{refused:?}"
    );
}

/// ½·J′·ω_b² must fit the torque base: refused just above, accepted just below.
fn velocity_is_bounded<L: Fixed>() {
    let machine = Wave::bare(1.0, 0.25); // ½·J′·ω² is up to 0.125·ω²
    let build = |share: f32, inertia: f32| {
        let scale = scale_of(2.0, 4.0 * share.sqrt(), inertia);
        // With this inertia base the factor is so large that an integer is near: the scale grows by a millionth only.
        let scale = scale.for_cells(CELLS, TAU);
        built::<{ curves::INERTIA }, L>(&machine, &scale)
    };
    assert_eq!(build(0.995, 10_000.0), Ok(()));
    // J' is −0.25·sin φ, largest at a quarter turn: the cells beside knot 16.
    let error = build(1.003, 10_000.0).unwrap_err();
    assert!(
        matches!(error, TableError::VelocityTorque { cell: 13..=16 }),
        "{error:?}"
    );
    // The velocity torque fits, but not together with J.
    let error = build(0.995, 150.0).unwrap_err();
    assert!(
        matches!(error, TableError::TorqueRange { cell: 13..=16 }),
        "{error:?}"
    );
}

#[test]
fn velocity_torque_outside_the_base_is_refused() {
    velocity_is_bounded::<Spline<Q31>>();
    velocity_is_bounded::<Cubic<Q31>>();
    velocity_is_bounded::<Quadratic<Q31>>();
}

fn other_speed_bases<F: Format>(fixed: bool) {
    let machine = Wave::bare(0.5, 0.1);
    let scale = scale_of(2.0, 4.0, 1.5).for_cells(CELLS, TAU);
    let rows = Rows::<F>::of(&machine, curves::INERTIA, CELLS, &scale).unwrap();
    let build = |scale: &Scale| rows.try_model::<{ curves::INERTIA }>(scale).map(|_| ());
    assert_eq!(build(&scale), Ok(()));
    for share in [1.0 - 1e-5, 1.0 + 1e-5, 0.3, 0.01] {
        let other = scale_of(scale.torque(), share * scale.speed(), scale.inertia());
        let expected = if fixed {
            Err(TableError::SpeedBase)
        } else {
            Ok(())
        };
        assert_eq!(build(&other), expected, "{share} of the speed base");
    }
    let overflow = scale_of(1e-30, 1e30, 1.0);
    assert_eq!(build(&overflow), Err(TableError::SpeedBase));
}

#[test]
fn a_speed_base_that_does_not_suit_the_cells_is_refused() {
    other_speed_bases::<Spline<Q31>>(true);
    other_speed_bases::<Cubic<Q31>>(true);
    other_speed_bases::<Quadratic<Q31>>(true);
    other_speed_bases::<Spline<f32>>(false);
    other_speed_bases::<Quadratic<f64>>(false);
}

#[test]
fn a_span_that_is_no_length_is_refused() {
    let machine = Wave::bare(0.5, 0.1);
    let scale = scale_of(2.0, 4.0, 1.5).for_cells(CELLS, TAU);
    let fixed = Rows::<Spline<Q31>>::of(&machine, curves::INERTIA, CELLS, &scale).unwrap();
    let float = Rows::<Spline<f32>>::of(&machine, curves::INERTIA, CELLS, &scale).unwrap();
    for span in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-40] {
        let domain = Domain::Stroke {
            from: 0.0,
            to: span,
        };
        let fixed = Rows {
            domain,
            ..fixed.clone()
        };
        let float = Rows {
            domain,
            ..float.clone()
        };
        let found = fixed.try_model::<{ curves::INERTIA }>(&scale);
        assert!(found.is_err(), "span {span}");
        let found = float.try_model::<{ curves::INERTIA }>(&scale);
        assert!(found.is_err(), "span {span}");
    }
}

/// The model's set must be exactly the table's.
#[test]
fn another_set_of_curves_is_refused() {
    let machine = Wave::bare(0.5, 0.1);
    let rows = |set| Rows::<Spline<f32>>::of(&machine, set, CELLS, &Scale::SI).unwrap();
    let [none, load] = [curves::INERTIA, curves::LOAD].map(rows);
    let refused = |set| Err(TableError::Curves(set));
    assert_eq!(
        none.try_model::<{ curves::LOAD }>(&Scale::SI).map(|_| ()),
        refused(0)
    );
    assert_eq!(
        load.try_model::<{ curves::INERTIA }>(&Scale::SI)
            .map(|_| ()),
        refused(1)
    );
    assert_eq!(
        load.try_model::<{ curves::VISCOUS }>(&Scale::SI)
            .map(|_| ()),
        refused(1)
    );
    assert_eq!(
        load.try_model::<{ ALL }>(&Scale::SI).map(|_| ()),
        refused(1)
    );
    assert!(load.try_model::<{ curves::LOAD }>(&Scale::SI).is_ok());
}

/// A slope of −4008 units, which the tick may round further down, times a factor that nearly makes it −1: it must be refused, otherwise the tick
/// would wrap to +1.
#[test]
fn a_slope_whose_rounding_leaves_the_range_is_refused() {
    let words = [0, -660, -1328, -1996, -2664, -3332, -4000].map(|step| (1 << 18) + step);
    let domain = Domain::stroke(0.0, 2.0).unwrap();
    let rows = Rows::<Spline<Q31>>::plain(words.to_vec(), curves::INERTIA, 4, domain);
    // ½·4 cells/span 2 = 1, and J_b·ω_b²/T_b is the rest of the factor. Two units of Q31 a unit of Q30.
    let edge = 2_147_483_648.0 / 8020.0;
    let scale = |factor: f64| scale_of(1.0, 1.0, factor.floor() as f32);
    let refused = rows
        .try_model::<{ curves::INERTIA }>(&scale(edge))
        .map(|_| ());
    assert_eq!(refused, Err(TableError::VelocityTorque { cell: 0 }));
    // Lower by eight units for each unit of the factor, and by J, which is 0.0015 there.
    let refused = rows.try_model::<{ curves::INERTIA }>(&scale(0.9975 * edge));
    assert_eq!(
        refused.map(|_| ()),
        Err(TableError::TorqueRange { cell: 0 })
    );
    let model = rows.model::<{ curves::INERTIA }>(&scale(0.99 * edge));
    let mut least = i32::MAX;
    for k in 0..4096 {
        let phase = Phase::from_bits(k << 20);
        let torque = model
            .torque(phase, Speed::<Q31>::MIN, Acceleration::default())
            .to_bits();
        assert!(torque < 0, "{k}: {torque}");
        least = least.min(torque);
    }
    assert!(
        f64::from(least) * Q31_UNIT < -0.98,
        "the edge is near: {least}"
    );
}

/// Random words of J and of every curve, up to the ends of the range.
fn words<L: Fixed>() -> impl Strategy<Value = Vec<i32>> {
    let (rows, pitch, curve) = match L::NAME {
        "spline" => (7, 4, 1),
        "cubic" => (4, 16, 4),
        _ => (4, 12, 3),
    };
    let words = prop::collection::vec(any::<i32>(), rows * pitch);
    (words, [0..5u32, 0..5u32, 0..5u32, 0..5u32]).prop_map(move |(words, size)| {
        let word = |(k, word): (usize, i32)| {
            let (column, power) = (k % pitch / curve, k % curve);
            let small = word >> (size[column] + 3);
            match (column, power) {
                (0, 0) => (small >> 2) + (1 << if curve == 1 { 25 } else { 28 }),
                (_, 0) if curve > 1 => small,
                _ => small >> 2,
            }
        };
        words.into_iter().enumerate().map(word).collect()
    })
}

/// At every corner of the state space and at one random state: the exact torque, up to the stated floors. A torque that wrapped would differ by 2³².
fn never_wraps<L: Fixed>(
    words: Vec<i32>,
    factor: u32,
    bits: u32,
    state: [i32; 2],
) -> Result<(), TestCaseError> {
    let domain = Domain::stroke(0.0, 2.0).unwrap();
    let rows = Rows::<L>::plain(words, ALL, 4, domain);
    let scale = scale_of(1.0, 1.0, factor as f32);
    let Ok(model) = rows.try_model::<ALL>(&scale) else {
        return Err(TestCaseError::reject("not a table, or out of range"));
    };
    let phase = Phase::from_bits(bits);
    let read = rows.exact(phase, place_bits::<L>());
    let ends = [i32::MIN, i32::MAX, 0, 1, -1];
    let corners = ends.iter().flat_map(|w| ends.map(|a| [*w, a]));
    for [omega, alpha] in corners.chain([state]) {
        let [w, a] = [omega, alpha].map(|x| f64::from(x) * Q31_UNIT);
        let sign = f64::from(omega.signum());
        let exact = read.inertia * a + f64::from(factor) * read.inertia_slope * w * w - read.load
            + read.viscous * w
            + read.coulomb * sign;
        let (speed, acceleration) = (
            Speed::<Q31>::from_bits(omega),
            Acceleration::<Q31>::from_bits(alpha),
        );
        let torque = model.torque(phase, speed, acceleration);
        // The read error of each curve, and the tick; the slope's floors count `factor` times.
        let slope = if L::NAME == "spline" { 4.25 } else { 2.0 * 3.5 };
        let floors = 12.0 + 4.0 * 2.0 * 4.0 + slope * f64::from(factor);
        let error = f64::from(torque.to_bits()) - exact / Q31_UNIT;
        prop_assert!(
            error.abs() <= floors,
            "{error} units at {omega}, {alpha}: {exact}"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(1024, 0x0071))]

    #[test]
    fn an_accepted_spline_never_wraps(words in words::<Spline<Q31>>(), factor in 1u32..9, bits: u32, state: [i32; 2]) {
        never_wraps::<Spline<Q31>>(words, factor, bits, state)?;
    }

    #[test]
    fn an_accepted_cubic_never_wraps(words in words::<Cubic<Q31>>(), factor in 1u32..9, bits: u32, state: [i32; 2]) {
        never_wraps::<Cubic<Q31>>(words, factor, bits, state)?;
    }

    #[test]
    fn an_accepted_quadratic_never_wraps(words in words::<Quadratic<Q31>>(), factor in 1u32..9, bits: u32, state: [i32; 2]) {
        never_wraps::<Quadratic<Q31>>(words, factor, bits, state)?;
    }
}

/// The sums of the tests above come near the end of the range.
#[test]
fn a_model_may_use_the_range_up_to_its_end() {
    let scale = Scale::SI.for_cells(CELLS, TAU);
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let machine = Wave {
        viscous: 0.2 * torque / speed,
        coulomb: 0.199_98 * torque,
        ..Wave::bare(0.6 * inertia, 0.0)
    };
    let rows = Rows::<Spline<Q31>>::of(&machine, ALL, CELLS, &scale).unwrap();
    let model = rows.model::<ALL>(&scale);
    for (end, expected) in [(i32::MAX, 0.999_98), (i32::MIN, -0.999_98)] {
        let (omega, alpha) = (
            Speed::<Q31>::from_bits(end),
            Acceleration::<Q31>::from_bits(end),
        );
        let found = f64::from(model.torque(Phase::default(), omega, alpha).to_bits()) * Q31_UNIT;
        let units = budget::Q31_TICK_UNITS + budget::Q31_POINTS_UNITS;
        crate::support::assert_near("T", found, expected, units * Q31_UNIT);
    }
}
