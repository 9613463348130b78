//! The report of a search for a table, and machines without a table.

use std::f64::consts::TAU;

use crate::support::machines::Wave;
use crate::support::rows::Rows;
use crate::support::{assert_near, largest, scale_of};
use jred::error::Error;
use jred::machine::{PoseError, Reducible, Reduction};
use jred::table::{Format, words_len};
use jred::tabulate::{EXHAUSTIVE, Request, TableFigures, measure, scratch_len, tabulate};
use jred::{Cubic, CurveSet, Domain, Q31, Quadratic, Rows16, Scale, Spline, curves};

fn request(torque_error: f64, max_cells: u32) -> Request {
    Request::new(torque_error)
        .with_max_speed(8.0)
        .with_max_acceleration(20.0)
        .with_max_cells(max_cells)
}

/// The report of the search, and the measured errors of a table of as many cells.
fn found<F: Format>(
    machine: &impl Reducible,
    set: CurveSet,
    request: &Request,
    scale: &Scale,
) -> [TableFigures; 2] {
    let mut words = vec![F::Word::default(); words_len::<F>(request.max_cells, set)];
    let mut scratch = vec![0.0; scratch_len(request.max_cells, set)];
    let found = tabulate::<F>(machine, set, request, scale, &mut scratch, &mut words).unwrap();
    let rows = Rows::<F>::of(machine, set, found.cells, &found.scale).unwrap();
    let measured = measure(machine, &rows.table(), request).unwrap();
    [found, measured]
}

/// J varies faster in one half of the turn, where the error is largest; the load has its sharpest bend in the other.
struct TwoPlaces;

impl Reducible for TwoPlaces {
    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let (sin, cos) = phi.sin_cos();
        // 1/(a − cos) has its peak at 0 or, of its mirror image, at π.
        let peak = |a: f64, cos: f64, sin: f64| {
            let d = a - cos;
            [
                1.0 / d,
                -sin / (d * d),
                (2.0 * sin * sin / d - cos) / (d * d),
            ]
        };
        let [j, j1, j2] = peak(1.05, cos, sin);
        let load = peak(1.02, -cos, -sin)[0];
        Ok(Reduction::new([1.0 + 0.01 * j, 0.01 * j1, 0.01 * j2]).with_process(0.004 * load))
    }
}

/// Beyond the sizes that are all tried, most candidates are evaluated near their worst position only; the figures of the result are still those of
/// all positions.
#[test]
fn figures_of_a_large_table_are_those_of_all_its_places() {
    for (torque_error, least) in [(1e-5, EXHAUSTIVE), (1e-3, 0)] {
        let request = request(torque_error, 2000);
        let [said, mut measured] =
            found::<Spline<f64>>(&TwoPlaces, curves::LOAD, &request, &Scale::SI);
        assert!(said.cells > least, "{said:?}");
        // The curves are symmetric: the worst position may be its mirror image.
        measured.worst = said.worst;
        assert_eq!(said, measured);
        assert!(said.torque_error <= torque_error && said.torque_error > 0.5 * torque_error);
        // The minimum: one cell less is not sufficient.
        let rows = Rows::<Spline<f64>>::of(&TwoPlaces, curves::LOAD, said.cells - 1, &Scale::SI);
        let fewer = measure(&TwoPlaces, &rows.unwrap().table(), &request).unwrap();
        assert!(fewer.torque_error > torque_error, "{fewer:?}");
    }
}

fn holds<F: Format>(wave: &Wave, scale: Scale, torque_error: f64) {
    let request = request(torque_error, 400);
    for set in [
        curves::ALL,
        curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB,
    ] {
        let [said, _] = found::<F>(wave, set, &request, &scale);
        assert!(said.torque_error <= torque_error, "{} {said:?}", F::NAME);
    }
}

/// A table of 16 bits in machine units: every curve counts in its own units, b in those of torque over speed.
#[test]
fn errors_are_in_si_units_in_every_format() {
    let wave = Wave {
        mean: 1.0,
        swing: 0.2,
        load: 3.0,
        viscous: 0.4,
        coulomb: 0.5,
        domain: Domain::Turn,
    };
    // Full torque of 60 N·m; the roundings of 16-bit words count at full speed and acceleration.
    let scale = scale_of(60.0, 8.0, 1.6);
    holds::<Spline<f64>>(&wave, Scale::SI, 1e-3);
    holds::<Cubic<f32>>(&wave, Scale::SI, 1e-3);
    holds::<Quadratic<Q31>>(&wave, scale, 1e-2);
    holds::<Rows16>(&wave, scale, 0.05);
}

/// A winder: J, its load or one of its frictions grows with every turn.
struct Grows(fn(f64) -> [f64; 4]);

impl Reducible for Grows {
    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let [inertia, load, viscous, coulomb] = (self.0)(phi);
        Ok(Reduction::new([inertia, 0.0, 0.0])
            .with_process(load)
            .with_viscous(viscous)
            .with_coulomb(coulomb))
    }
}

/// One turn does not represent all turns: no table is made.
#[test]
fn what_differs_from_turn_to_turn_is_refused() {
    let repeats = Grows(|phi| [2.0 + phi.cos(), phi.sin(), 0.1, 0.5]);
    assert_eq!(repeats.check_repeats(), Ok(()));
    let growing: [fn(f64) -> [f64; 4]; 4] = [
        |phi| [2.0 + 0.01 * phi, 1.0, 0.1, 0.5],
        |phi| [2.0, 1.0 + 0.01 * phi, 0.1, 0.5],
        |phi| [2.0, 1.0, 0.1 + 0.01 * phi, 0.5],
        |phi| [2.0, 1.0, 0.1, 0.5 + 0.01 * phi],
    ];
    for machine in growing.map(Grows) {
        assert!(matches!(
            machine.check_repeats(),
            Err(PoseError::NotPeriodic { .. })
        ));
        let made = Rows::<Spline<f64>>::of(&machine, curves::ALL, 32, &Scale::SI);
        assert!(
            matches!(made, Err(Error::Pose(PoseError::NotPeriodic { .. }))),
            "{made:?}"
        );
    }
    // A growth of a sixth of a millionth is a rounding.
    let nearly = Grows(|phi| [1.0 + phi / TAU * 3e-7, 0.0, 0.0, 0.0]);
    assert_eq!(nearly.check_repeats(), Ok(()));
}

/// Control points are stored relative to the middle of J: roundings in single precision are a share of the swing, not of J.
#[test]
fn a_large_constant_inertia_costs_no_digits() {
    let wave = Wave::bare(1000.0, 0.01);
    let rows = Rows::<Spline<f32>>::of(&wave, curves::INERTIA, 64, &Scale::SI).unwrap();
    let table = rows.table();
    let worst = largest((0..1000u32).map(|k| {
        let phase = jred::Phase::from_bits(k.wrapping_mul(4_294_967));
        let exact = wave.reduction(phase.radians()).unwrap();
        table.at(phase).inertia_slope - exact.inertia_slope
    }));
    // J′ of a cubic spline of 64 cells has an error of at most 0.01·(2π/64)³/24.
    let cut = 0.01 * (TAU / 64.0f64).powi(3) / 24.0;
    assert!(worst < 1.5 * cut, "{worst:e}, {cut:e}");
    assert_near("constant", rows.constants.inertia.into(), 1000.0, 1e-3);
}
