//! Tables at the limits of a model: an accepted table never wraps, whatever its numbers.

use crate::support::rows::Rows;
use crate::support::scale_of;
use jred::error::Error;
use jred::machine::{Reducible, Reduction};
use jred::number::RangeError;
use jred::table::TableError;
use jred::tabulate::{Request, tabulate};
use jred::{
    Acceleration, Cubic, CurveSet, Domain, Phase, Q31, Scale, Speed, Spline, Torque, curves,
};

const SPAN: f32 = core::f32::consts::TAU;

/// The scale whose speed base gives this factor of the velocity torque, for 4 cells and the other bases 1.
fn scale(factor: f64) -> Scale {
    scale_of(1.0, (0.5 * factor * f64::from(SPAN)).sqrt() as f32, 1.0)
}

/// The floors of a slope count as often as the factor of the velocity torque: with a factor of half a million they are a thousandth of the number
/// range.
#[test]
fn roundings_of_the_slope_are_in_the_proof() {
    let mut accepted = 0;
    for slope in 1900..2600i32 {
        // For the largest possible velocity torque, except for the floors.
        let factor = (0.999_98 * 1_073_741_824.0 / (f64::from(slope) + 0.8)).floor();
        let a = 8000;
        // Down in two cells, and up again.
        let down = [-slope, 0, -1];
        let words = [
            [a, down[0], down[1], down[2]],
            [a - slope, down[0], down[1], down[2]],
            [a - slope, slope, 0, 0],
            [a, slope, 0, 0],
        ];
        let words = words.as_flattened().to_vec();
        let rows = Rows::<Cubic<Q31>>::plain(words, curves::INERTIA, 4, Domain::Turn);
        for share in [1.0, 0.99] {
            let scale = scale((factor * share).floor());
            let Ok(model) = rows.try_model::<{ curves::INERTIA }>(&scale) else {
                continue;
            };
            accepted += 1;
            for bits in (0..1 << 14).map(|k: u32| k << 18 | 0xffff) {
                let torque = model.torque(
                    Phase::from_bits(bits),
                    Speed::<Q31>::MAX,
                    Acceleration::default(),
                );
                let falling = bits < 1 << 31;
                assert_eq!(
                    torque.to_bits() < 0,
                    falling,
                    "{slope} {bits:#x}: {torque:?}"
                );
            }
        }
    }
    assert!(accepted > 100, "{accepted}");
}

/// 1/J that is correct at the first four evaluated positions of a cell, and far off at its ends.
#[test]
fn a_reciprocal_is_looked_at_everywhere() {
    const SET: CurveSet = curves::RECIPROCAL;
    // (v + 3/8)(v + 1/8)(v − 1/8)(v − 3/8) has no cubic: the cubic through ±e at these places, by Lagrange.
    let nodes = [-0.375, -0.125, 0.125, 0.375];
    let through = |e: f64, v: f64| -> f64 {
        (0..4)
            .map(|k| {
                let sign = if k % 2 == 0 { -e } else { e };
                let others = (0..4).filter(|j| *j != k);
                sign * others
                    .map(|j| (v - nodes[j]) / (nodes[k] - nodes[j]))
                    .product::<f64>()
            })
            .sum()
    };
    let build = |e: f64| {
        // Powers of v by differences at −1, 0, 1 and 2.
        let f = |v: f64| 1.0 + through(e, v);
        let (f0, even, odd) = (f(0.0), f(1.0).midpoint(f(-1.0)), (f(1.0) - f(-1.0)) / 2.0);
        let p2 = even - f0;
        let p3 = (f(2.0) - f0 - 4.0 * p2 - 2.0 * odd) / 6.0;
        let seed = [f0, odd - p3, p2, p3].map(|p| (p / 30.4 * 2f64.powi(31)) as i32);
        let row = [1_020_054_733, 0, 0, 0, seed[0], seed[1], seed[2], seed[3]];
        let words: Vec<i32> = row.iter().copied().cycle().take(32).collect();
        let rows = Rows::<Cubic<Q31>>::plain(words, SET, 4, Domain::Turn);
        rows.try_model::<SET>(&scale(1.0)).map(|model| {
            let torque = Torque::<Q31>::from_bits(1 << 28);
            let alphas = (0..64u32).map(|k| {
                let phase = Phase::from_bits(k << 24 | 0xffff);
                model.acceleration(phase, Speed::default(), torque).value
            });
            alphas
                .map(|alpha| f64::from(alpha.to_bits()))
                .collect::<Vec<_>>()
        })
    };
    assert_eq!(build(0.19), Err(TableError::Reciprocal { cell: 0 }));
    // Where it is accepted, Newton's step squares the remaining error: up to 0.4² at the ends.
    let alphas = build(0.05).unwrap();
    let exact = 2f64.powi(28) / (1_020_054_733.0 / 2f64.powi(30));
    assert!(
        alphas
            .iter()
            .all(|alpha| (alpha / exact - 1.0).abs() < 0.17)
    );
}

/// A curve that no table reaches ends the search at the largest possible table, however many cells are allowed.
#[test]
fn a_search_without_a_limit_ends() {
    struct Ripple;
    impl Reducible for Ripple {
        fn domain(&self) -> Domain {
            Domain::Turn
        }
        fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
            Ok(Reduction::new([1.0, 0.0, 0.0]).with_process((37.0 * phi).sin()))
        }
    }
    let request = Request::new(1e-14)
        .with_max_speed(1.0)
        .with_max_acceleration(1.0)
        .with_max_cells(u32::MAX);
    let (mut scratch, mut words) = (vec![0.0; 3000], vec![0.0f32; 3000]);
    let set = curves::LOAD;
    let found =
        tabulate::<Spline<f32>>(&Ripple, set, &request, &Scale::SI, &mut scratch, &mut words);
    assert!(
        matches!(found, Err(Error::Range(RangeError::BufferTooShort { .. }))),
        "{found:?}"
    );
}

/// A friction that drives, or is NaN, is refused as a table's constant.
#[test]
fn constants_are_looked_at() {
    let words = [1.0f32 / 6.0; 7];
    for (viscous, coulomb) in [
        (-1.0, 0.0),
        (0.0, -1.0),
        (f32::NAN, 0.0),
        (0.0, f32::INFINITY),
    ] {
        let constants = jred::table::Constants {
            inertia: 0.0,
            viscous,
            coulomb,
            gains: [0; 5],
        };
        let set = curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
        let mut rows = Rows::<Spline<f32>>::plain(words.to_vec(), set, 4, Domain::Turn);
        rows.constants = constants;
        assert_eq!(rows.try_table().unwrap_err(), TableError::Constant);
    }
}
