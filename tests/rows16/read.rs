//! Values read from a table against the machine, for every set, on a turn and on a stroke.

use jred::machine::{Reducible, Reduction};
use jred::table::Usage;
use jred::{CurveSet, Domain, Phase, curves};

use super::{Short, read_at, row_words};
use crate::support::{budget, grid, largest, scale_of};
use jred::Rows16;
use jred::table::Format as _;

/// Curves that are not polynomials, with sizes far below 1.
struct Smooth(Domain);

impl Reducible for Smooth {
    fn domain(&self) -> Domain {
        self.0
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        let (sin, cos) = phi.sin_cos();
        let inertia = 0.15 * sin.exp();
        let inertia = [inertia, cos * inertia, (cos * cos - sin) * inertia];
        Ok(Reduction::new(inertia)
            .with_process(0.05 * (cos.exp() - 1.0))
            .with_viscous(0.02 * (2.0 + (2.0 * phi).sin()))
            // A magnitude with two kinks.
            .with_coulomb(0.03 * sin.abs()))
    }
}

fn domains() -> [Domain; 2] {
    [Domain::Turn, Domain::stroke(-0.5, 1.5).unwrap()]
}

/// Largest errors of J, V, load, b, c, 1/J, in units of 2⁻¹⁵ (of 2⁻¹⁵ of 1/J).
fn errors(set: CurveSet, domain: Domain, cells: u32) -> [f64; 6] {
    let scale = scale_of(1.0, 0.9, 1.0);
    let machine = Smooth(domain);
    let rows = Short::of(&machine, set, cells, &scale).unwrap();
    assert_eq!(rows.words.len(), cells as usize * row_words(set));
    assert_eq!(rows.table().words(), rows.words);
    assert_eq!((rows.table().cells(), rows.table().set()), (cells, set));
    let table = rows.table();
    let has = |of: CurveSet| if set & of == 0 { 0.0 } else { 1.0 };
    let mut found = [0.0; 6];
    let places = 16 * cells;
    let start = machine.reduction(domain.position(0.0)).unwrap();
    for (phase, position) in grid(domain, places) {
        let exact = machine.reduction(position).unwrap();
        let [inertia, velocity, load, b, c, reciprocal] = read_at(&table, phase);
        let of = |curve: CurveSet, constant: CurveSet, here: f64, at_start: f64| {
            if set & curve != 0 {
                here
            } else {
                has(constant) * at_start
            }
        };
        let viscous = of(
            curves::VISCOUS,
            curves::CONSTANT_VISCOUS,
            exact.viscous,
            start.viscous,
        );
        let coulomb = of(
            curves::COULOMB,
            curves::CONSTANT_COULOMB,
            exact.coulomb,
            start.coulomb,
        );
        let parts = [
            inertia - exact.inertia,
            velocity - 0.5 * exact.inertia_slope * 0.81,
            load - has(curves::LOAD) * exact.load_torque(),
            b - 0.9 * viscous,
            c - coulomb,
            reciprocal * exact.inertia - has(curves::RECIPROCAL),
        ];
        for (most, part) in found.iter_mut().zip(parts) {
            *most = largest([*most, 32_768.0 * part]);
        }
    }
    found
}

#[test]
fn every_set_holds_its_curves() {
    let mut worst = [0.0f64; 6];
    for set in (0..64).filter(|set| Rows16::accepts(*set)) {
        for domain in domains() {
            let found = errors(set, domain, 300);
            for (most, part) in worst.iter_mut().zip(found) {
                *most = most.max(part);
            }
        }
    }
    for (found, most) in worst.into_iter().zip(budget::ROWS16_CURVES) {
        assert!(found <= most, "{worst:?}");
        assert!(found >= 0.5 * most, "budget too wide: {worst:?}");
    }
}

/// The error of V falls with the square of the cell's width: three times as many cells, a ninth of it.
#[test]
fn more_cells_err_less() {
    for (domain, cells) in domains().into_iter().zip([[16, 48], [5, 15]]) {
        let [few, many] = cells.map(|cells| errors(curves::LOAD, domain, cells)[1]);
        let ratio = few / many;
        assert!((6.0..12.0).contains(&ratio), "{few} / {many}");
    }
}

#[test]
fn value_and_slope_hardly_step_at_knots() {
    let scale = scale_of(1.0, 0.9, 1.0);
    let rows = Short::of(&Smooth(Domain::Turn), curves::LOAD, 60, &scale).unwrap();
    let table = rows.table();
    let step = |of: usize| {
        let steps = (1..=60u64).map(|knot| {
            let bits = ((knot << 32) / 60 + 1) as u32;
            let at = |bits| read_at(&table, Phase::from_bits(bits))[of];
            32_768.0 * (at(bits) - at(bits.wrapping_sub(1 << 16)))
        });
        largest(steps)
    };
    // J, V, load.
    for found in [0, 1, 2].map(step) {
        assert!((0.4..=budget::ROWS16_STEP).contains(&found), "{found}");
    }
}

#[test]
fn usage_is_the_largest_size() {
    let scale = scale_of(1.0, 0.9, 1.0);
    for domain in domains() {
        let rows = Short::of(&Smooth(domain), curves::ALL, 100, &scale).unwrap();
        let table = rows.table();
        let most = Usage::of(&table).unwrap();
        let read: Vec<[f64; 6]> = (0..20_000u32)
            .map(|k| read_at(&table, Phase::from_bits(k * 214_748)))
            .collect();
        for (stated, of) in [
            (
                most.inertia,
                &(|v: &[f64; 6]| v[0]) as &dyn Fn(&[f64; 6]) -> f64,
            ),
            (most.velocity, &|v| v[1]),
            (most.load, &|v| v[2]),
            (most.viscous, &|v| v[3]),
            (most.coulomb, &|v| v[4]),
            (most.torque, &|v| v[..5].iter().map(|x| x.abs()).sum()),
        ] {
            let found = largest(read.iter().map(of));
            let stated = f64::from(stated);
            assert!(
                found <= stated && found >= 0.97 * stated,
                "{found} {stated}"
            );
        }
    }
}
