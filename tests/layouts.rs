//! The three layouts against the exact machine, against each other, at knots, across the turn and at the ends of a stroke.

mod halves;

use std::f64::consts::TAU;

use crate::support::machines::spec;
use crate::support::rows::Rows;
use crate::support::{assert_near, budget, config, grid, largest, scale_of};
use jred::machine::{Reducible, Reduction};
use jred::number::{Number, Scalar};
use jred::table::Format;
use jred::{Cubic, CurveSet, Domain, Phase, Q31, Quadratic, Scale, Spline, curves};
use proptest::prelude::*;

const ALL: CurveSet = curves::ALL;

/// Curves that are not polynomials, with exact slopes: sizes of one.
struct Smooth(Domain);

impl Reducible for Smooth {
    fn domain(&self) -> Domain {
        self.0
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        let (sin, cos) = phi.sin_cos();
        let inertia = 0.2 * sin.exp();
        Ok(
            Reduction::new([inertia, cos * inertia, (cos * cos - sin) * inertia])
                .with_process(0.1 * (cos.exp() - 1.0))
                .with_viscous(0.02 * (2.0 + (2.0 * phi).sin()))
                .with_coulomb(0.03 * (2.0 + (3.0 * phi).cos())),
        )
    }
}

/// Largest errors of the values and of the slope per cell, in machine units, over a grid with every knot and both ends.
fn errors<F: Format>(domain: Domain, cells: u32, scale: &Scale) -> [f64; 2] {
    let machine = Smooth(domain);
    let rows = Rows::<F>::of(&machine, ALL, cells, scale).unwrap();
    let table = rows.table();
    let mut found = [0.0; 2];
    let places = 24 * cells;
    for (phase, position) in grid(domain, places) {
        let exact = machine.reduction(position).unwrap();
        let read = table.at(phase);
        let [torque, speed, inertia] =
            [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
        let values = [
            read.inertia - exact.inertia / inertia,
            read.load - exact.load_torque() / torque,
            read.viscous - exact.viscous * speed / torque,
            read.coulomb - exact.coulomb / torque,
        ];
        let slope = read.inertia_slope - exact.inertia_slope / inertia;
        found[0] = largest(values).max(found[0]);
        found[1] = largest([slope * domain.span() / f64::from(cells)]).max(found[1]);
    }
    found
}

/// The slope is per cell here, which is one order more.
fn converges<F: Format>(orders: [i32; 2]) {
    for domain in [Domain::Turn, Domain::stroke(-0.4, 1.3).unwrap()] {
        for cells in [48, 96] {
            let [coarse, fine] = [cells, 2 * cells].map(|n| errors::<F>(domain, n, &Scale::SI));
            for (k, order) in orders.iter().enumerate() {
                let ratio = coarse[k] / fine[k];
                println!(
                    "{} {domain:?} {cells}: {:.1e}, ratio {ratio:.2}",
                    F::NAME,
                    coarse[k]
                );
                let expected = f64::from(1 << order);
                assert_near("order", ratio, expected, budget::ORDER_SHARE * expected);
            }
        }
    }
}

#[test]
fn errors_fall_with_the_order_of_the_spline() {
    converges::<Spline<f64>>([4, 4]);
    converges::<Cubic<f64>>([4, 4]);
    converges::<Quadratic<f64>>([3, 3]);
}

/// As in f64 in every number type, up to the type's own roundings.
fn agrees_with_f64<F: Format, E: Format>(roundings: [f64; 2]) {
    let scale = scale_of(1.0, 2.0, 1.0);
    for domain in [Domain::Turn, Domain::stroke(-0.4, 1.3).unwrap()] {
        for cells in [8, 37, 250] {
            let exact = errors::<E>(domain, cells, &scale);
            let found = errors::<F>(domain, cells, &scale);
            let [value, slope] = [found[0] - exact[0], found[1] - exact[1]];
            println!(
                "{} {} {cells}: {value:.1e} {slope:.1e}",
                <F::Number as Number>::NAME,
                F::NAME
            );
            // A position of 16 bits shifts the value along the slope, which is below 2.5 times the width of a cell.
            let place = if F::Number::FIXED && F::NAME == "quadratic" {
                2.5 * domain.span() / f64::from(cells) / 65_536.0
            } else {
                0.0
            };
            assert_near("value", found[0], exact[0], roundings[0] + place);
            assert_near("slope", found[1], exact[1], roundings[1] + place);
        }
    }
}

#[test]
fn every_number_type_reads_the_same_curves() {
    let f32 = [budget::F32_READ; 2];
    agrees_with_f64::<Spline<f32>, Spline<f64>>(f32);
    agrees_with_f64::<Cubic<f32>, Cubic<f64>>(f32);
    agrees_with_f64::<Quadratic<f32>, Quadratic<f64>>(f32);
    agrees_with_f64::<Spline<Q31>, Spline<f64>>(budget::Q31_READ);
    agrees_with_f64::<Cubic<Q31>, Cubic<f64>>(budget::Q31_READ);
    agrees_with_f64::<Quadratic<Q31>, Quadratic<f64>>(budget::Q31_READ);
}

/// A Cubic is the Spline's own curve.
fn cubic_is_the_spline<S: Scalar>(machine: &impl Reducible, cells: u32, bits: u32, roundings: f64) {
    let scale = Scale::covering(machine, 60.0, 900.0, 64).unwrap();
    let scale = scale.for_cells(cells, TAU);
    let Ok(spline) = Rows::<Spline<S>>::of(machine, ALL, cells, &scale) else {
        return; // too few cells
    };
    let cubic = Rows::<Cubic<S>>::of(machine, ALL, cells, &scale).unwrap();
    let phase = Phase::from_bits(bits);
    let [a, b] = [spline.table().at(phase), cubic.table().at(phase)];
    let h = machine.domain().span() / f64::from(cells);
    for (what, a, b) in [
        ("J", a.inertia, b.inertia),
        ("J' a cell", h * a.inertia_slope, h * b.inertia_slope),
        ("load", a.load, b.load),
        ("b", a.viscous, b.viscous),
        ("c", a.coulomb, b.coulomb),
    ] {
        assert_near(what, b, a, roundings);
    }
}

/// Value and slope on both sides of every knot, and across the turn: equal up to the change within the phases between.
fn smooth_at_knots<F: Format>(rows: &Rows<F>, roundings: [f64; 2]) {
    let table = rows.table();
    let cells = rows.cells;
    let turn = rows.domain == Domain::Turn;
    for knot in u32::from(!turn)..cells {
        // The first phase in the cell after the knot.
        let bits = (u64::from(knot) << 32).div_ceil(u64::from(cells)) as u32;
        let after = Phase::from_bits(bits);
        let before = Phase::from_bits(bits.wrapping_sub(1));
        assert_eq!(after.cell(cells).0, knot);
        assert_eq!(before.cell(cells).0, (knot + cells - 1) % cells);
        let [a, b] = [table.at(before), table.at(after)];
        // Two phases are cells·2⁻³² of a cell apart; with 16 bits per cell one step more.
        let apart = f64::from(cells) / 4_294_967_296.0
            + if F::Number::FIXED && F::NAME == "quadratic" {
                1.0 / 65_536.0
            } else {
                0.0
            };
        // Slopes and curvatures of these curves are below 1, per cell below h and h².
        let h = rows.domain.span() / f64::from(cells);
        let moved = apart * h.max(h * h);
        for (what, a, b, roundings) in [
            ("J", a.inertia, b.inertia, roundings[0]),
            (
                "J' a cell",
                h * a.inertia_slope,
                h * b.inertia_slope,
                roundings[1],
            ),
            ("load", a.load, b.load, roundings[0]),
            ("b", a.viscous, b.viscous, roundings[0]),
            ("c", a.coulomb, b.coulomb, roundings[0]),
        ] {
            let jump = b - a;
            assert_near(what, jump, 0.0, roundings + moved);
        }
    }
}

fn smooth_everywhere<F: Format>(roundings: [f64; 2]) {
    let scale = scale_of(1.0, 2.0, 1.0);
    for domain in [Domain::Turn, Domain::stroke(-0.4, 1.3).unwrap()] {
        for cells in [8, 13, 64, 300] {
            let rows = Rows::<F>::of(&Smooth(domain), ALL, cells, &scale).unwrap();
            smooth_at_knots(&rows, roundings);
        }
    }
}

#[test]
fn value_and_slope_meet_at_every_knot() {
    let f64 = [budget::SPLINE_END; 2];
    smooth_everywhere::<Spline<f64>>(f64);
    smooth_everywhere::<Cubic<f64>>(f64);
    smooth_everywhere::<Quadratic<f64>>(f64);
    let f32 = [budget::F32_READ; 2];
    smooth_everywhere::<Spline<f32>>(f32);
    smooth_everywhere::<Cubic<f32>>(f32);
    smooth_everywhere::<Quadratic<f32>>(f32);
    smooth_everywhere::<Spline<Q31>>(budget::Q31_READ);
    smooth_everywhere::<Cubic<Q31>>(budget::Q31_READ);
    smooth_everywhere::<Quadratic<Q31>>(budget::Q31_READ);
}

proptest! {
    #![proptest_config(config(128, 0x0081))]

    #[test]
    fn a_cubic_is_the_spline(spec in spec(), cells in 8u32..300, bits: u32) {
        let machine = spec.machine();
        cubic_is_the_spline::<f64>(&machine, cells, bits, budget::SPLINE_END);
        cubic_is_the_spline::<f32>(&machine, cells, bits, budget::F32_READ);
        cubic_is_the_spline::<Q31>(&machine, cells, bits, budget::Q31_READ[1]);
    }
}
