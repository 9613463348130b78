//! The example press: the accuracy of 16 bits, and the tabulator's report.

use std::f64::consts::TAU;

use jred::error::Error;
use jred::machine::Reducible;
use jred::table::words_len;
use jred::tabulate::{Request, measure, scratch_len, tabulate};
use jred::{CurveSet, Phase, Rows16, Scale, curves};
use proptest::prelude::*;

use super::{Short, model, q15};
use crate::support::harmonics::press;
use crate::support::{budget, largest, samples, value};

const OMEGA: f64 = 40.0;
const ALPHA: f64 = 800.0;
const SET: CurveSet = curves::LOAD;

fn request(torque_error: f64) -> Request {
    Request::new(torque_error)
        .with_max_speed(OMEGA)
        .with_max_acceleration(ALPHA)
        .with_max_cells(1024)
}

/// Largest drive torque at full speed and acceleration.
fn peak() -> f64 {
    let machine = press();
    largest((0..3600).flat_map(|k| {
        let reduced = machine.reduction(TAU * f64::from(k) / 3600.0).unwrap();
        [-1.0, 1.0].map(|sign| reduced.torque(OMEGA, sign * ALPHA).total())
    }))
}

fn scale() -> Scale {
    Scale::limited_to(&press(), OMEGA, ALPHA, 1440).unwrap()
}

fn tabulated(share: f64) -> Result<(Short, jred::tabulate::TableFigures), Error> {
    let mut scratch = vec![0.0; scratch_len(1024, SET)];
    let mut words = vec![0; words_len::<Rows16>(1024, SET)];
    let request = request(share * peak());
    let found = tabulate::<Rows16>(&press(), SET, &request, &scale(), &mut scratch, &mut words)?;
    let rows = Short::of(&press(), SET, found.cells, &scale())?;
    assert_eq!(rows.words, words[..words_len::<Rows16>(found.cells, SET)]);
    Ok((rows, found))
}

/// The figures of `docs/table-image.md`.
#[test]
fn sizes_are_the_stated_ones() {
    for (share, cells) in budget::ROWS16_PRESS_CELLS {
        let (rows, found) = tabulated(share).unwrap();
        assert_eq!(found.cells, cells, "{share}");
        let error = found.torque_error / peak();
        assert!(error <= share && error > 0.9 * share, "{share}: {error}");
        assert_eq!(found.scale, scale());
        // One cell less is not sufficient.
        let less = Short::of(&press(), SET, cells - 1, &scale()).unwrap();
        let request = request(share * peak());
        let missed = measure(&press(), &less.table(), &request).unwrap();
        assert!(missed.torque_error > request.torque_error);
        let again = measure(&press(), &rows.table(), &request).unwrap();
        assert_eq!(again.torque_error.to_bits(), found.torque_error.to_bits());
    }
}

/// 16 bits reach no further, with any number of cells.
#[test]
fn the_floor_is_the_stated_one() {
    let [least, most] = budget::ROWS16_FLOOR;
    let request = request(1.0);
    let best = (300..1024)
        .step_by(40)
        .map(|cells| {
            let rows = Short::of(&press(), SET, cells, &scale()).unwrap();
            let found = measure(&press(), &rows.table(), &request).unwrap();
            found.torque_error
        })
        .fold(f64::INFINITY, f64::min);
    let share = best / peak();
    assert!((least..=most).contains(&share), "{share}");
    let error = tabulated(1e-4).unwrap_err();
    let Error::TorqueErrorNotReached { asked, reached, .. } = error else {
        panic!("{error}");
    };
    assert!(reached > asked && reached < 1.1 * best, "{reached} {best}");
}

/// No tick exceeds the stated error at any speed and acceleration within the range; some come near.
#[test]
fn no_tick_errs_more_than_stated() {
    let (machine, scale) = (press(), scale());
    let (rows, found) = tabulated(3e-4).unwrap();
    let model = model::<SET>(&rows);
    let base = f64::from(scale.torque());
    let speed = f64::from(scale.speed());
    let acceleration = f64::from(scale.acceleration());
    let limit = |most: f64, base: f64| (32_768.0 * most / base).floor() as i16;
    let (full_speed, full) = (limit(OMEGA, speed), limit(ALPHA, acceleration));
    let random = (any::<u32>(), -full_speed..=full_speed, -full..=full);
    let mut worst = 0.0f64;
    for (bits, omega, alpha) in samples(60_000, 0x5144, &random) {
        let phase = Phase::from_bits(bits);
        let corner = bits % 2 == 0;
        let omega = if corner { full_speed } else { omega };
        let alpha = match (corner, alpha > 0) {
            (true, true) => full,
            (true, false) => -full,
            _ => alpha,
        };
        let (omega, alpha) = (q15(omega), q15(alpha));
        let torque = value(model.torque(phase, omega, alpha)) * base;
        let exact = machine.reduction(phase.radians()).unwrap();
        let exact = exact
            .torque(value(omega) * speed, value(alpha) * acceleration)
            .total();
        worst = worst.max((torque - exact).abs());
    }
    assert!(worst <= found.bound, "{worst} {}", found.bound);
    assert!(
        worst >= 0.6 * found.torque_error,
        "{worst} {}",
        found.torque_error
    );
}
