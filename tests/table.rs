//! Tables: values as put in, and refusal of invalid tables.

use std::f64::consts::TAU;

use crate::support::machines::{Wave, spec};
use crate::support::rows::{Meaning as _, Plain, Rows};
use crate::support::{assert_near, budget, config, largest};
use jred::machine::{Reducible, Reduction};
use jred::number::Role;
use jred::table::{
    Constants, CubicSpline, Format, MAX_CELLS, MIN_CELLS, TableError, control_points, fit_periodic,
    words_len,
};
use jred::{Cubic, Domain, Phase, Q31, Quadratic, Scale, Spline, Spline16, curves};
use proptest::prelude::*;

fn a_constant_stays_constant<L: Format>(value: f64, cells: u32) {
    let machine = Wave::bare(value, 0.0);
    let rows = Rows::<L>::of(&machine, curves::INERTIA, cells, &Scale::SI).unwrap();
    for k in 0..50u32 {
        let read = rows
            .table()
            .at(Phase::from_bits(k.wrapping_mul(0x9E37_79B9)));
        assert_near("J", read.inertia, value, budget::SPLINE_KNOT * value);
        let per_cell = read.inertia_slope * TAU / f64::from(cells);
        assert_near("J'", per_cell, 0.0, budget::SPLINE_KNOT * value);
        assert_eq!((read.load, read.viscous, read.coulomb), (0.0, 0.0, 0.0));
    }
}

/// The curve through the machine's samples at the knots, curve by curve, in the order of the bits.
fn reads_its_spline<L: Format>(machine: &impl Reducible, cells: u32, bits: u32) {
    let Ok(rows) = Rows::<L>::of(machine, curves::ALL, cells, &Scale::SI) else {
        return; // too few cells for this machine
    };
    let read = rows.table().at(Phase::from_bits(bits));
    let x = f64::from(bits) / 4_294_967_296.0;
    let at = |curve: &dyn Fn(&Reduction) -> f64| {
        let places = (0..cells).map(|k| TAU * f64::from(k) / f64::from(cells));
        let samples: Vec<f64> = places
            .map(|phi| curve(&machine.reduction(phi).unwrap()))
            .collect();
        let mut control = vec![0.0; control_points(samples.len())];
        fit_periodic(&samples, &mut control).unwrap();
        let spline = CubicSpline::new(control).unwrap();
        (spline.at(x), budget::SPLINE_END * largest(samples))
    };
    let (inertia, size) = at(&|r| r.inertia);
    assert_near("J", read.inertia, inertia[0], size);
    let slope = inertia[1] / f64::from(cells);
    let found = read.inertia_slope * TAU / f64::from(cells);
    assert_near("J' a cell", found, slope, 4.0 * size);
    for (found, (expected, size)) in [
        (read.load, at(&|r| r.load_torque())),
        (read.viscous, at(&|r| r.viscous)),
        // Roundings decide between equal signs of a constant magnitude: not needed here.
        (read.coulomb, at(&|r| r.coulomb)),
    ] {
        assert_near("curve", found, expected[0], size);
    }
}

proptest! {
    #![proptest_config(config(128, 0x0004))]

    #[test]
    fn constants_stay_constant(value in 0.1..5.0, cells in 4u32..300) {
        a_constant_stays_constant::<Spline<f64>>(value, cells);
        a_constant_stays_constant::<Cubic<f64>>(value, cells);
        a_constant_stays_constant::<Quadratic<f64>>(value, cells);
    }

    #[test]
    fn table_reads_its_spline(spec in spec(), cells in 8u32..80, bits: u32) {
        let machine = spec.machine();
        reads_its_spline::<Spline<f64>>(&machine, cells, bits);
        reads_its_spline::<Cubic<f64>>(&machine, cells, bits);
    }
}

/// Four cells with J = 0.375 throughout.
fn good<F: Plain>() -> Rows<F> {
    let word = |value| F::Word::of(Role::Inertia, value);
    let words = match F::NAME {
        "spline" => vec![word(0.0625); control_points(MIN_CELLS)],
        _ => [0.375, 0.0, 0.0, 0.0].map(word).repeat(MIN_CELLS),
    };
    Rows::plain(words, curves::INERTIA, MIN_CELLS as u32, Domain::Turn)
}

fn stroke() -> Domain {
    Domain::stroke(0.0, 1.0).unwrap()
}

#[track_caller]
fn refused<F: Format>(rows: &Rows<F>) -> TableError {
    rows.try_table().map(|_| ()).unwrap_err()
}

/// With another word, over a stroke, where no end needs to close.
#[track_caller]
fn refused_with<F: Plain>(index: usize, word: F::Word) -> TableError {
    let mut rows = Rows {
        domain: stroke(),
        ..good::<F>()
    };
    rows.words[index] = word;
    refused(&rows)
}

fn refused_in_every_layout<F: Plain>() {
    let rows = good::<F>();
    assert!(rows.try_table().is_ok());
    for cells in [0, 1, 3, MAX_CELLS + 1, u32::MAX] {
        let rows = Rows {
            cells,
            ..rows.clone()
        };
        assert_eq!(refused(&rows), TableError::Cells(cells));
    }
    let needed = rows.words.len() as u32;
    assert_eq!(words_len::<F>(4, curves::INERTIA), needed as usize);
    for given in [0, needed - 1, needed + 1] {
        let words = vec![F::Word::default(); given as usize];
        let rows = Rows {
            words,
            ..rows.clone()
        };
        assert_eq!(refused(&rows), TableError::Length { needed, given });
    }
    // An unknown bit, or a friction both as a curve and as a constant.
    for set in [64, 128, 255, 18, 36, 63, u16::MAX] {
        let rows = Rows {
            set,
            ..rows.clone()
        };
        assert_eq!(refused(&rows), TableError::Curves(set));
    }
    let words = vec![F::Word::default(); needed as usize];
    let nothing = Rows {
        words,
        ..rows.clone()
    };
    assert_eq!(refused(&nothing), TableError::NoInertia { cell: 0 });
    // The constant counts as well.
    let raised = Constants {
        inertia: F::Word::of(Role::Inertia, 0.25),
        ..rows.constants
    };
    let raised = Rows {
        constants: raised,
        ..nothing
    };
    if F::NAME == "spline" {
        assert!(raised.try_table().is_ok());
    } else {
        assert_eq!(refused(&raised), TableError::NoInertia { cell: 0 });
    }
}

#[test]
fn every_layout_refuses_what_is_no_table() {
    refused_in_every_layout::<Spline<f32>>();
    refused_in_every_layout::<Cubic<f32>>();
    refused_in_every_layout::<Quadratic<f32>>();
    refused_in_every_layout::<Spline<f64>>();
    refused_in_every_layout::<Quadratic<f64>>();
    refused_in_every_layout::<Spline<Q31>>();
    refused_in_every_layout::<Cubic<Q31>>();
    refused_in_every_layout::<Quadratic<Q31>>();
}

/// An invalid number affects the first cell that reads it, in any of its words.
#[test]
fn numbers_out_of_range_are_refused_with_their_cell() {
    let range = |cell| TableError::Range { curve: 0, cell };
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e31] {
        for (index, cell) in [(0, 0), (3, 0), (4, 1), (6, 3)] {
            assert_eq!(refused_with::<Spline<f32>>(index, value), range(cell));
        }
        for (index, cell) in [(0, 0), (3, 0), (6, 1), (15, 3)] {
            assert_eq!(refused_with::<Cubic<f32>>(index, value), range(cell));
        }
        for (index, cell) in [(0, 0), (2, 0), (5, 1), (14, 3)] {
            assert_eq!(refused_with::<Quadratic<f32>>(index, value), range(cell));
        }
        let mut rows = good::<Spline<f32>>();
        rows.constants.inertia = value;
        assert_eq!(refused(&rows), range(0));
    }
    assert_eq!(refused_with::<Spline<f64>>(2, f64::NAN), range(0));
    for value in [i32::MAX, i32::MIN] {
        assert_eq!(refused_with::<Spline<Q31>>(5, value), range(2));
        for index in [4, 5, 6, 7] {
            assert_eq!(refused_with::<Cubic<Q31>>(index, value), range(1));
        }
        for index in [8, 9, 10] {
            assert_eq!(refused_with::<Quadratic<Q31>>(index, value), range(2));
        }
    }
    // Words that no cell reads may have any value.
    let mut rows = good::<Quadratic<Q31>>();
    rows.words[11] = i32::MIN;
    assert!(rows.try_table().is_ok());
}

/// A single-precision word of NaN or infinity among the other constants.
#[test]
fn constants_that_are_not_finite_are_refused() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e31] {
        for (set, viscous, coulomb) in [
            (curves::CONSTANT_VISCOUS, value, 0.0),
            (curves::CONSTANT_COULOMB, 0.0, value),
        ] {
            let mut rows = Rows {
                set,
                ..good::<Spline<f32>>()
            };
            rows.constants.viscous = viscous;
            rows.constants.coulomb = coulomb;
            let model = rows.try_model::<{ curves::CONSTANT_VISCOUS }>(&Scale::SI);
            let other = rows.try_model::<{ curves::CONSTANT_COULOMB }>(&Scale::SI);
            assert!(model.is_err() && other.is_err(), "{set} of {value}");
        }
    }
}

/// J = 0 and J < 0 at a knot, J < 0 between knots only.
#[test]
fn inertia_must_be_positive_between_knots_too() {
    let none = |cell| TableError::NoInertia { cell };
    assert_eq!(refused_with::<Spline<f32>>(1, -0.03125), none(0));
    assert_eq!(refused_with::<Spline<f32>>(6, -0.3125), none(3));
    // 0.375 + x·(1.7·x − 1.6) dips to −0.0015 at x = 0.47; with a slope of −1.55 it does not.
    let dip = |slope: f32| {
        let mut rows = good::<Cubic<f32>>();
        rows.words[4..8].copy_from_slice(&[0.375, slope, 1.7, 0.0]);
        rows
    };
    assert_eq!(refused(&dip(-1.6)), none(1));
    let mut words = vec![(1 << 30) / 32; 7];
    words[6] = -5 * ((1 << 30) / 32); // J is 0 at the end of the last cell
    let rows =
        |words: &[i32]| Rows::<Spline<Q31>>::plain(words.to_vec(), curves::INERTIA, 4, stroke());
    assert_eq!(refused(&rows(&words)), none(3));
    words[6] += 1 << 7;
    assert_eq!(refused(&rows(&words)), none(3), "1e-7 above zero");
    words[6] += 1 << 11;
    assert!(rows(&words).try_table().is_ok(), "2e-6 above zero");
    // In powers about the middle of the cell: 0.1 + 0.3·x is −0.05 at the start.
    let tilted = |value: f64, slope: f64| {
        let word = |x| i32::try_from((x * f64::from(1 << 30)) as i64).unwrap();
        let row = [word(value), word(slope), 0, 0];
        Rows::<Quadratic<Q31>>::plain(row.repeat(4), curves::INERTIA, 4, stroke())
    };
    assert_eq!(refused(&tilted(0.1, 0.3)), none(0));
    assert_eq!(refused(&tilted(0.1, -0.3)), none(0));
    assert!(tilted(0.1, 0.19).try_table().is_ok());
}

/// Any of the six rows that must repeat; rows of polynomials repeat by construction.
#[test]
fn a_turn_that_does_not_close_is_refused() {
    for index in [0, 1, 2, 4, 5, 6] {
        let mut rows = good::<Spline<f32>>();
        rows.words[index] *= 1.5;
        assert_eq!(refused(&rows), TableError::NotClosed { curve: 0 });
        rows.domain = stroke();
        assert!(rows.try_table().is_ok(), "a stroke need not close");
    }
    // Curves are named by their place in the row.
    let set = curves::LOAD | curves::COULOMB;
    let words = [0.0625f32, 0.0, 0.0].repeat(7);
    let mut rows = Rows::<Spline<f32>>::plain(words, set, 4, Domain::Turn);
    assert!(rows.try_table().is_ok());
    rows.words[2] = 1.0;
    assert_eq!(refused(&rows), TableError::NotClosed { curve: 2 });
    rows.words[3 * 5 + 1] = f32::NAN;
    assert_eq!(refused(&rows), TableError::Range { curve: 1, cell: 2 });
}

/// For words that contain two curves the first one is named.
#[test]
fn a_turn_of_halves_that_does_not_close_is_refused() {
    let wave = Wave {
        load: 0.1,
        viscous: 0.1,
        coulomb: 0.1,
        ..Wave::bare(0.5, 0.1)
    };
    let scale = Scale::SI.for_cells(32, TAU);
    let mut rows = Rows::<Spline16>::of(&wave, curves::ALL, 32, &scale).unwrap();
    for (word, curve) in [(0, 0), (1, 2), (2, 0), (3, 2), (5, 2)] {
        let before = rows.words[word];
        rows.words[word] ^= 1;
        assert_eq!(refused(&rows), TableError::NotClosed { curve }, "{word}");
        rows.words[word] = before;
    }
    assert!(rows.try_table().is_ok());
}

/// c₁ + 4c₂ + c₃, six times J at the end of the last cell, is −7 units, below the resolution of single precision there.
#[test]
fn inertia_just_below_zero_is_refused() {
    let knot = 1 << 24;
    let words = vec![
        knot,
        knot,
        knot,
        knot,
        knot + 13,
        knot + 5,
        -(5 * knot + 40),
    ];
    let rows = Rows::<Spline<Q31>>::plain(words, curves::INERTIA, 4, stroke());
    assert_eq!(refused(&rows), TableError::NoInertia { cell: 3 });
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
    let rows = Rows::<Spline<f32>>::plain(words.to_vec(), curves::INERTIA, 4, stroke());
    assert!(matches!(refused(&rows), TableError::NoInertia { .. }));
}

#[test]
fn absent_curves_cost_no_memory() {
    let widths = [0, 1, 2, 4, 3, 7, 8, 15, 16, 32, 63].map(curves::width);
    assert_eq!(widths, [1, 2, 2, 2, 3, 4, 2, 5, 1, 1, 5]);
    let words = |set| {
        [
            words_len::<Spline<f32>>(10, set),
            words_len::<Cubic<f32>>(10, set),
            words_len::<Quadratic<f32>>(10, set),
        ]
    };
    assert_eq!(words(curves::INERTIA), [13, 40, 40]);
    assert_eq!(words(curves::LOAD), [26, 80, 80]);
    assert_eq!(words(curves::LOAD | curves::RECIPROCAL), [39, 120, 120]);
    assert_eq!(words(curves::ALL), [52, 160, 120]);
    assert_eq!(words(curves::ALL | curves::RECIPROCAL), [65, 200, 160]);
}
