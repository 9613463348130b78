//! Splines and tables: exact at knots, closed, of the stated order, and refused when they are not sound.

mod support;

use std::f64::consts::TAU;

use jred::table::{
    CubicSpline, MAX_CELLS, MIN_CELLS, control_points, curves, fit_bounded, fit_periodic,
};
use jred::{Model, Phase, Q31, Reducible, Scalar, Scale, Table, TableError};
use proptest::prelude::*;
use support::machines::{Wave, spec};
use support::{assert_near, budget, config, largest, number, words};

fn periodic(samples: &[f64]) -> CubicSpline<Vec<f64>> {
    let mut control = vec![0.0; control_points(samples.len())];
    fit_periodic(samples, &mut control).unwrap();
    CubicSpline::new(control).unwrap()
}

fn bounded(samples: &[f64]) -> CubicSpline<Vec<f64>> {
    let mut control = vec![0.0; control_points(samples.len() - 1)];
    fit_bounded(samples, &mut control).unwrap();
    CubicSpline::new(control).unwrap()
}

proptest! {
    #![proptest_config(config(128, 0x0004))]

    #[test]
    fn splines_pass_through_their_samples(samples in prop::collection::vec(-5.0..5.0, 5..70)) {
        let cells = samples.len() as f64;
        let turn = periodic(&samples);
        let stroke = bounded(&samples);
        for (k, sample) in samples.iter().enumerate() {
            let k = k as f64;
            let knot = budget::SPLINE_KNOT * 5.0;
            assert_near("periodic", turn.at(k / cells)[0], *sample, knot * cells);
            assert_near("bounded", stroke.at(k / (cells - 1.0))[0], *sample, knot * cells);
        }
        assert_eq!((turn.cells(), stroke.cells()), (samples.len(), samples.len() - 1));
        // The turn closes with value, slope and curvature.
        let [start, end] = [turn.at(0.0), turn.at(1.0)];
        for (order, (a, b)) in start.iter().zip(end).enumerate() {
            let size = 30.0 * cells.powi(order as i32);
            assert_near("closure", b, *a, budget::SPLINE_END * size);
        }
        // Not-a-knot: the first two cells are one cubic, so its third difference over them is constant; likewise the last.
        for ends in [0.0, cells - 3.0] {
            let curvature = |k: f64| stroke.at((ends + k) / (cells - 1.0))[2];
            let second = curvature(0.0) - 2.0 * curvature(1.0) + curvature(2.0);
            assert_near("not-a-knot", second, 0.0, budget::SPLINE_END * 300.0 * cells.powi(2));
        }
    }

    #[test]
    fn bounded_ends_reproduce_a_cubic(c in [-3.0..3.0, -3.0..3.0, -3.0..3.0, -3.0f64..3.0], cells in 4usize..100) {
        let value = |x: f64| c[0] + x * (c[1] + x * (c[2] + x * c[3]));
        let samples: Vec<f64> = (0..=cells).map(|k| value(k as f64 / cells as f64)).collect();
        let curve = bounded(&samples);
        for k in 0..=37 {
            let x = f64::from(k) / 37.0;
            let expected = [value(x), c[1] + x * (2.0 * c[2] + 3.0 * c[3] * x), 2.0 * c[2] + 6.0 * c[3] * x];
            for (order, (found, expected)) in curve.at(x).iter().zip(expected).enumerate() {
                let size = 30.0 * (cells as f64).powi(order as i32);
                assert_near("cubic", *found, expected, budget::SPLINE_END * size);
            }
        }
        let bits = |x: f64| curve.at(x).map(f64::to_bits);
        prop_assert_eq!(bits(-1.0), bits(0.0));
        prop_assert_eq!(bits(2.0), bits(1.0));
    }

    #[test]
    fn a_constant_stays_constant(value in 0.1..5.0, cells in 4u32..300) {
        let machine = Wave::bare(value, 0.0);
        let words = words::<f64, { curves::INERTIA }>(&machine, cells, &Scale::SI).unwrap();
        let table = Table::<f64, { curves::INERTIA }>::new(&words, cells, true).unwrap();
        for k in 0..50u32 {
            let read = table.at(Phase::from_bits(k.wrapping_mul(0x9E37_79B9)));
            assert_near("J", read.inertia, value, budget::SPLINE_KNOT * value);
            assert_near("J'", read.inertia_slope, 0.0, budget::SPLINE_KNOT * value);
            prop_assert_eq!((read.load, read.viscous, read.coulomb), (0.0, 0.0, 0.0));
        }
    }

    /// The table is the spline through the machine's samples, curve by curve, in the order of the bits.
    #[test]
    fn table_reads_its_spline(spec in spec(), cells in 4u32..80, bits: u32) {
        let machine = spec.machine();
        let Ok(words) = words::<f64, { curves::ALL }>(&machine, cells, &Scale::SI) else {
            return Err(TestCaseError::reject("too few cells for this machine"));
        };
        let table = Table::<f64, { curves::ALL }>::new(&words, cells, true).unwrap();
        let read = table.at(Phase::from_bits(bits));
        let x = f64::from(bits) / 4_294_967_296.0;
        let at = |curve: &dyn Fn(&jred::Reduction) -> f64| {
            let places = (0..cells).map(|k| TAU * f64::from(k) / f64::from(cells));
            let samples: Vec<f64> = places.map(|phi| curve(&machine.reduction(phi).unwrap())).collect();
            (periodic(&samples).at(x), budget::SPLINE_END * largest(samples))
        };
        let (inertia, size) = at(&|r| r.inertia[0]);
        assert_near("J", read.inertia, inertia[0], size);
        assert_near("J' a cell", read.inertia_slope, inertia[1] / f64::from(cells), 4.0 * size);
        for (found, (expected, size)) in [
            (read.load, at(&|r| r.load_torque())),
            (read.viscous, at(&|r| r.viscous)),
            (read.coulomb, at(&|r| r.coulomb)),
        ] {
            assert_near("curve", found, expected[0], size);
        }
    }
}

/// Largest error of value and slope on a dense grid, for `cells` cells.
fn errors(
    cells: usize,
    fit: impl Fn(&[f64]) -> CubicSpline<Vec<f64>>,
    turn: bool,
    f: impl Fn(f64) -> [f64; 2],
) -> [f64; 2] {
    let knots = if turn { cells } else { cells + 1 };
    let samples: Vec<f64> = (0..knots).map(|k| f(k as f64 / cells as f64)[0]).collect();
    let curve = fit(&samples);
    let places = (0..=32 * cells).map(|k| k as f64 / (32 * cells) as f64);
    [0, 1].map(|order| largest(places.clone().map(|x| curve.at(x)[order] - f(x)[order])))
}

#[test]
fn value_converges_with_order_4_and_slope_with_3() {
    let turn = |x: f64| {
        let (sin, cos) = (TAU * x).sin_cos();
        [sin.exp(), TAU * cos * sin.exp()]
    };
    let stroke = |x: f64| [(2.0 * x).exp(), 2.0 * (2.0 * x).exp()];
    for cells in [64, 128] {
        for [coarse, fine] in [
            [cells, 2 * cells].map(|n| errors(n, periodic, true, turn)),
            [cells, 2 * cells].map(|n| errors(n, bounded, false, stroke)),
        ] {
            println!(
                "{cells} cells: {coarse:?}, orders {:.2} {:.2}",
                coarse[0] / fine[0],
                coarse[1] / fine[1]
            );
            assert_near(
                "order 4",
                coarse[0] / fine[0],
                16.0,
                16.0 * budget::ORDER_SHARE,
            );
            assert_near(
                "order 3",
                coarse[1] / fine[1],
                8.0,
                8.0 * budget::ORDER_SHARE,
            );
        }
    }
}

/// Four good rows and three more: J of one over a turn.
fn good<S: Scalar>() -> Vec<S::Word> {
    vec![number::<S>(0.0625).to_word(); control_points(MIN_CELLS)]
}

fn refused<S: Scalar>(words: &[S::Word], cells: u32, periodic: bool) -> TableError {
    Table::<S, { curves::INERTIA }>::new(words, cells, periodic).unwrap_err()
}

fn refused_with<S: Scalar>(index: usize, value: S) -> TableError {
    let mut words = good::<S>();
    words[index] = value.to_word();
    refused::<S>(&words, 4, false)
}

#[test]
fn every_kind_of_unsound_table_is_refused() {
    assert!(Table::<f32, { curves::INERTIA }>::new(&good::<f32>(), 4, true).is_ok());
    assert!(Table::<Q31, { curves::INERTIA }>::new(&good::<Q31>(), 4, true).is_ok());

    assert_eq!(
        refused::<f32>(&good::<f32>(), 3, true),
        TableError::Cells(3)
    );
    assert_eq!(
        refused::<f32>(&good::<f32>(), MAX_CELLS + 1, true),
        TableError::Cells(MAX_CELLS + 1)
    );
    assert_eq!(
        refused::<f32>(&good::<f32>(), u32::MAX, true),
        TableError::Cells(u32::MAX)
    );
    for given in [0, 6, 8] {
        let words = vec![0.1f32; given];
        let needed = 7;
        assert_eq!(
            refused::<f32>(&words, 4, true),
            TableError::Length {
                needed,
                given: given as u32
            }
        );
    }
    // A number spoils the first cell that reads it, whichever of the four it is.
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e31] {
        for (index, cell) in [(0, 0), (3, 0), (4, 1), (6, 3)] {
            assert_eq!(
                refused_with(index, value),
                TableError::Range { curve: 0, cell }
            );
        }
    }
    assert_eq!(
        refused_with(2, f64::NAN),
        TableError::Range { curve: 0, cell: 0 }
    );
    for value in [Q31::MAX, Q31::MIN] {
        assert_eq!(
            refused_with(5, value),
            TableError::Range { curve: 0, cell: 2 }
        );
    }
    // J = 0 and J < 0 at a knot, J < 0 between knots only.
    assert_eq!(
        refused_with(1, -0.03125f32),
        TableError::NoInertia { cell: 0 }
    );
    assert_eq!(
        refused_with(6, -0.3125f32),
        TableError::NoInertia { cell: 3 }
    );
    let mut words = vec![number::<Q31>(1.0 / 32.0).to_bits(); 7];
    words[6] = number::<Q31>(-5.0 / 32.0).to_bits(); // J is 0 at the end of the last cell
    assert_eq!(
        refused::<Q31>(&words, 4, false),
        TableError::NoInertia { cell: 3 }
    );
    words[6] += 1 << 12;
    assert!(
        Table::<Q31, { curves::INERTIA }>::new(&words, 4, false).is_ok(),
        "2e-6 above zero"
    );
    let nothing = vec![0.0f32; 7];
    assert_eq!(
        refused::<f32>(&nothing, 4, true),
        TableError::NoInertia { cell: 0 }
    );
    // Any of the six rows that must repeat.
    for index in [0, 1, 2, 4, 5, 6] {
        let mut words = good::<f32>();
        words[index] *= 1.5;
        assert_eq!(
            refused::<f32>(&words, 4, true),
            TableError::NotClosed { curve: 0 }
        );
        assert!(
            Table::<f32, { curves::INERTIA }>::new(&words, 4, false).is_ok(),
            "a stroke need not close"
        );
    }
    // Curves are named by their place in the row.
    let mut rows = [0.0625f32, 0.0, 0.0].repeat(7);
    assert!(Table::<f32, { curves::LOAD | curves::COULOMB }>::new(&rows, 4, true).is_ok());
    rows[2] = 1.0;
    let error = Table::<f32, { curves::LOAD | curves::COULOMB }>::new(&rows, 4, true).unwrap_err();
    assert_eq!(error, TableError::NotClosed { curve: 2 });
    rows[3 * 5 + 1] = f32::NAN;
    let error = Table::<f32, { curves::LOAD | curves::COULOMB }>::new(&rows, 4, true).unwrap_err();
    assert_eq!(error, TableError::Range { curve: 1, cell: 2 });
}

/// c₁ + 4c₂ + c₃, six times J at the end of the last cell, is −7 units: single precision rounds it to +32.
#[test]
fn inertia_just_below_zero_is_refused() {
    let knot = 1 << 26;
    let words = [
        knot,
        knot,
        knot,
        knot,
        knot + 13,
        knot + 5,
        -(5 * knot + 40),
    ];
    assert_eq!(
        refused::<Q31>(&words, 4, false),
        TableError::NoInertia { cell: 3 }
    );
}

/// A dip below zero of a millionth of the control points, within the roundings of single precision.
#[test]
fn inertia_that_rounds_to_below_zero_is_refused() {
    let words = [
        -0.677_158_36f32,
        0.940_116_35,
        -0.470_057_85,
        0.940_116_17,
        0.3,
        0.3,
        0.3,
    ];
    assert!(matches!(
        refused::<f32>(&words, 4, false),
        TableError::NoInertia { .. }
    ));
}

/// The torque ½·J′·ω_b² must fit the torque base of fixed point: refused just above, accepted just below.
#[test]
fn velocity_torque_outside_the_base_is_refused() {
    let machine = Wave::bare(1.0, 0.25); // ½·J′·ω² is up to 0.125·ω²
    let build = |speed: f32| {
        let scale = Scale::new(2.0, speed, 1.5).unwrap();
        let words = words::<Q31, { curves::INERTIA }>(&machine, 64, &scale).unwrap();
        let table = Table::<Q31, { curves::INERTIA }>::new(&words, 64, true).unwrap();
        Model::new(table, core::f32::consts::TAU, &scale).map(|_| ())
    };
    assert_eq!(build(3.99), Ok(()));
    // J' is −0.25·sin φ, largest at a quarter turn: the cells beside knot 16.
    let error = build(4.02).unwrap_err();
    assert!(
        matches!(error, TableError::VelocityTorque { cell: 13..=16 }),
        "{error:?}"
    );
    for span in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let words =
            words::<Q31, { curves::INERTIA }>(&machine, 64, &Scale::new(2.0, 1.0, 1.5).unwrap())
                .unwrap();
        let table = Table::<Q31, { curves::INERTIA }>::new(&words, 64, true).unwrap();
        let refused = Model::new(table, span, &Scale::new(2.0, 1.0, 1.5).unwrap());
        assert!(refused.is_err(), "span {span}");
    }
}

#[test]
fn absent_curves_cost_no_memory() {
    let widths = [0, 1, 2, 4, 3, 7].map(curves::width);
    assert_eq!(widths, [1, 2, 2, 2, 3, 4]);
}
