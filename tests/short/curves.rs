//! What a table reads, against the machine, for every set, on a turn and on a stroke.

use jred::short::{CurveValues, row_words, usage};
use jred::table::curves;
use jred::{Domain, Error, Phase, Reducible, Reduction, Scale};

use crate::short::Short;
use crate::support::{budget, largest};

/// Curves that are not polynomials, with sizes far below 1.
struct Smooth(Domain);

impl Reducible for Smooth {
    fn domain(&self) -> Domain {
        self.0
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, Error> {
        let (sin, cos) = phi.sin_cos();
        let inertia = 0.15 * sin.exp();
        Ok(Reduction {
            inertia: [inertia, cos * inertia, (cos * cos - sin) * inertia],
            potential_energy: [0.0, 0.0],
            process: 0.05 * (cos.exp() - 1.0),
            viscous: 0.02 * (2.0 + (2.0 * phi).sin()),
            // A magnitude with two kinks.
            coulomb: 0.03 * sin.abs(),
        })
    }
}

fn domains() -> [Domain; 2] {
    [Domain::Turn, Domain::stroke(-0.5, 1.5).unwrap()]
}

/// Largest errors of J, V, load, b, c, 1/J, in units of 2⁻¹⁵ (of 2⁻¹⁵ of 1/J).
fn errors(set: u8, domain: Domain, cells: u32) -> [f64; 6] {
    let scale = Scale::new(1.0, 0.9, 1.0).unwrap();
    let machine = Smooth(domain);
    let rows = Short::of(&machine, set, cells, &scale).unwrap();
    assert_eq!(rows.words.len(), cells as usize * row_words(set));
    assert_eq!(rows.table().words(), rows.words);
    assert_eq!((rows.table().cells(), rows.table().curves()), (cells, set));
    let table = rows.table();
    let has = |of: u8| if set & of == 0 { 0.0 } else { 1.0 };
    let mut found = [0.0; 6];
    let places = 16 * cells;
    for k in 0..=places {
        let place = (u64::from(k) << 32) / u64::from(places);
        let phase = Phase::from_bits(u32::try_from(place).unwrap_or(u32::MAX));
        let turns = f64::from(phase.to_bits()) / 4_294_967_296.0;
        let exact = machine.reduction(domain.position(turns)).unwrap();
        let start = machine.reduction(domain.position(0.0)).unwrap();
        let read = table.at(phase);
        let of = |curve: u8, constant: u8, here: f64, at_start: f64| {
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
            read.inertia - exact.inertia[0],
            read.velocity - 0.5 * exact.inertia[1] * 0.81,
            read.load - has(curves::LOAD) * exact.load_torque(),
            read.viscous - 0.9 * viscous,
            read.coulomb - coulomb,
            read.reciprocal * exact.inertia[0] - has(curves::RECIPROCAL),
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
    for set in 0..=curves::EVERY {
        for domain in domains() {
            let found = errors(set, domain, 300);
            for (most, part) in worst.iter_mut().zip(found) {
                *most = most.max(part);
            }
        }
    }
    for (found, most) in worst.into_iter().zip(budget::SHORT_CURVES) {
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

/// A constant beside its curve adds to it.
#[test]
fn a_curve_holds_what_its_constant_leaves() {
    let [with, without] = [
        curves::ALL | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB,
        curves::ALL,
    ]
    .map(|set| errors(set, domains()[1], 100));
    for (with, without) in with.into_iter().zip(without) {
        assert!((with - without).abs() <= 1.0, "{with} {without}");
    }
}

#[test]
fn value_and_slope_hardly_step_at_knots() {
    let scale = Scale::new(1.0, 0.9, 1.0).unwrap();
    let rows = Short::of(&Smooth(Domain::Turn), curves::LOAD, 60, &scale).unwrap();
    let table = rows.table();
    let step = |of: &dyn Fn(CurveValues) -> f64| {
        let steps = (1..=60u64).map(|knot| {
            let bits = ((knot << 32) / 60 + 1) as u32;
            let at = |bits| of(table.at(Phase::from_bits(bits)));
            32_768.0 * (at(bits) - at(bits.wrapping_sub(1 << 16)))
        });
        largest(steps)
    };
    for found in [
        step(&|v| v.inertia),
        step(&|v| v.velocity),
        step(&|v| v.load),
    ] {
        assert!((0.4..=budget::SHORT_STEP).contains(&found), "{found}");
    }
}

#[test]
fn usage_is_the_largest_size() {
    let scale = Scale::new(1.0, 0.9, 1.0).unwrap();
    for domain in domains() {
        let rows = Short::of(&Smooth(domain), curves::ALL, 100, &scale).unwrap();
        let table = rows.table();
        let most = usage(&table);
        let read: Vec<CurveValues> = (0..20_000u32)
            .map(|k| table.at(Phase::from_bits(k * 214_748)))
            .collect();
        for (stated, of) in [
            (
                most.inertia,
                &(|v: &CurveValues| v.inertia) as &dyn Fn(&CurveValues) -> f64,
            ),
            (most.velocity, &|v| v.velocity),
            (most.load, &|v| v.load),
            (most.viscous, &|v| v.viscous),
            (most.coulomb, &|v| v.coulomb),
            (most.torque, &|v| {
                v.inertia + v.velocity.abs() + v.load.abs() + v.viscous + v.coulomb
            }),
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
