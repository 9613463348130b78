//! Tabulation: the smallest table, as accurate as stated, in every number type and layout.

use crate::support::budget::Q31_UNIT;
use crate::support::machines::{Wave, spec};
use crate::support::rows::Rows;
use crate::support::{assert_near, budget, largest, samples, value};
use jred::machine::Reducible;
use jred::number::Number;
use jred::table::{AccelerationOf, Format, MIN_CELLS, SpeedOf, Table, TorqueOf, words_len};
use jred::tabulate::{CHECKS_PER_CELL, Request, TableFigures, measure, scratch_len, tabulate};
use jred::{Cubic, CurveSet, Phase, Q31, Quadratic, Scale, Spline, curves};
use proptest::prelude::any;

const ALL: CurveSet = curves::ALL;

fn table_of<F: Format>(
    machine: &impl Reducible,
    request: &Request,
    scale: &Scale,
) -> (TableFigures, Rows<F>) {
    let mut scratch = vec![0.0; scratch_len(request.max_cells, ALL)];
    let mut words = vec![F::Word::default(); words_len::<F>(request.max_cells, ALL)];
    let found = tabulate::<F>(machine, ALL, request, scale, &mut scratch, &mut words).unwrap();
    let rows = Rows::of(machine, ALL, found.cells, &found.scale).unwrap();
    words.truncate(rows.words.len());
    assert_eq!(words, rows.words);
    (found, rows)
}

/// Ticks of random machines against the exact reduction: the table's stated error and the arithmetic's rounding.
fn ticks_keep_the_stated_error<F: Format>(seed: u64, rounding: f64) {
    let (mut worst, mut square, mut sum, mut count) = (0.0, 0.0, 0.0, 0.0);
    let states = samples(300, seed + 1, &(any::<u32>(), -1.0..1.0, -1.0..1.0));
    for spec in samples(12, seed, &spec()) {
        let machine = spec.machine();
        let (top_speed, top) = (40.0, 600.0);
        let scale = Scale::covering(&machine, top_speed, top, 256).unwrap();
        let base = f64::from(scale.torque());
        let request = Request::new(2e-4 * base)
            .with_max_speed(top_speed)
            .with_max_acceleration(top)
            .with_max_cells(512);
        let (found, rows) = table_of::<F>(&machine, &request, &scale);
        let scale = found.scale;
        let base = f64::from(scale.torque());
        let model = rows.model::<ALL>(&scale);
        for (bits, w, a) in &states {
            let phase = Phase::from_bits(*bits);
            let (omega, alpha) = (
                scale.omega::<SpeedOf<F>>((top_speed * w) as f32).value,
                scale
                    .alpha::<AccelerationOf<F>>((0.9 * top * a) as f32)
                    .value,
            );
            let exact = machine.reduction(phase.radians()).unwrap();
            let terms = exact.torque(
                value(omega) * f64::from(scale.speed()),
                value(alpha) * f64::from(scale.acceleration()),
            );
            let torque = value(model.torque(phase, omega, alpha));
            let error = torque - terms.total() / base;
            let size = largest(terms.values()) / base;
            let allowed = budget::DENSE_GRID * found.torque_error / base
                + rounding
                + budget::FACTOR_ROUNDING * size;
            assert_near("torque", torque, terms.total() / base, allowed);
            let drive = scale.to_torque::<TorqueOf<F>>(terms.total() as f32).value;
            let expected =
                exact.acceleration(value(omega) * f64::from(scale.speed()), value(drive) * base);
            let back = value(model.acceleration(phase, omega, drive).value)
                * f64::from(scale.acceleration());
            assert_near(
                "acceleration",
                back,
                expected,
                budget::DENSE_GRID * allowed * base / exact.inertia,
            );
            let share = error * base / found.torque_error;
            worst = largest([worst, share]);
            (square, sum, count) = (square + share * share, sum + share, count + 1.0);
        }
    }
    let (rms, bias) = (f64::sqrt(square / count), sum / count);
    println!(
        "{} {}: error over stated error: largest {worst:.3}, RMS {rms:.3}, bias {bias:.1e}",
        <F::Number as Number>::NAME,
        F::NAME
    );
    assert!(
        rms < 0.5 && bias.abs() < budget::TABLE_BIAS,
        "RMS {rms}, bias {bias}"
    );
    assert!(worst > 0.3, "a stated error three times too large: {worst}");
}

#[test]
fn single_precision_ticks_keep_the_stated_error() {
    let rounding = budget::TICK_ROUNDINGS * f64::from(f32::EPSILON);
    ticks_keep_the_stated_error::<Spline<f32>>(0x0021, rounding);
    ticks_keep_the_stated_error::<Cubic<f32>>(0x0021, rounding);
    ticks_keep_the_stated_error::<Quadratic<f32>>(0x0021, rounding);
}

#[test]
fn q31_ticks_keep_the_stated_error() {
    let rounding = budget::Q31_TICK_UNITS * Q31_UNIT;
    ticks_keep_the_stated_error::<Spline<Q31>>(0x0021, rounding);
    ticks_keep_the_stated_error::<Cubic<Q31>>(0x0021, rounding);
    ticks_keep_the_stated_error::<Quadratic<Q31>>(0x0021, rounding);
}

/// The bound of `tabulate`, reimplemented on a denser set of positions that are not among the checked ones.
fn dense<F: Format>(
    machine: &impl Reducible,
    table: &Table<'_, F>,
    request: &Request,
    scale: &Scale,
) -> f64 {
    let [t, w, j] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let places = 71 * table.cells();
    largest((0..places).map(|k| {
        let phi = machine
            .domain()
            .position((f64::from(k) + 0.5) / f64::from(places));
        let (exact, read) = (
            machine.reduction(phi).unwrap(),
            table.at(machine.domain().phase(phi)),
        );
        let slope = read.inertia_slope * j;
        (j * read.inertia - exact.inertia).abs() * request.max_acceleration
            + (slope - exact.inertia_slope).abs() * request.max_speed.powi(2) / 2.0
            + (t * read.load - exact.load_torque()).abs()
            + (t / w * read.viscous - exact.viscous).abs() * request.max_speed
            + (t * read.coulomb - exact.coulomb).abs()
    }))
}

fn finds_the_smallest<F: Format>() {
    let mut worst = [f64::INFINITY, 0.0];
    for (k, spec) in samples(8, 0x0031, &spec()).iter().enumerate() {
        let machine = spec.machine();
        let scale = Scale::covering(&machine, 40.0, 600.0, 256).unwrap();
        let torque_error = f64::from(scale.torque()) * [0.2, 1e-2, 1e-3, 2e-4][k % 4];
        let request = Request::new(torque_error)
            .with_max_speed(40.0)
            .with_max_acceleration(600.0)
            .with_max_cells(400);
        let (found, rows) = table_of::<F>(&machine, &request, &scale);
        let table = rows.table();
        assert!(found.torque_error <= torque_error);
        let again = measure(&machine, &table, &request).unwrap();
        assert_eq!(again.torque_error.to_bits(), found.torque_error.to_bits());
        let places = f64::from(found.cells * CHECKS_PER_CELL);
        let spacing = machine.domain().span() / places;
        assert_near("spacing", found.spacing, spacing, 1e-15 * spacing);
        assert!(found.bound > found.torque_error);
        assert!(found.bound < budget::BOUND_SLACK * found.torque_error);
        let everywhere = dense(&machine, &table, &request, &found.scale);
        assert!(everywhere <= found.bound, "{everywhere} {found:?}");
        let ratio = everywhere / found.torque_error;
        worst = [worst[0].min(ratio), worst[1].max(ratio)];
        // No smaller table is sufficient.
        for cells in MIN_CELLS as u32..found.cells {
            let scale = if F::Number::FIXED {
                scale.for_cells(cells, machine.domain().span())
            } else {
                scale
            };
            let Ok(rows) = Rows::<F>::of(&machine, ALL, cells, &scale) else {
                continue;
            };
            if rows.try_model::<ALL>(&scale).is_err() {
                continue;
            }
            let reached = measure(&machine, &rows.table(), &request);
            let reached = reached.unwrap().torque_error;
            assert!(
                reached > torque_error,
                "{cells} cells reach {reached} N·m, {} were taken",
                found.cells
            );
        }
        println!(
            "{} {}: {} cells, dense over stated {ratio:.4}",
            <F::Number as Number>::NAME,
            F::NAME,
            found.cells
        );
    }
    let least = match F::NAME {
        "quadratic" => budget::DENSE_GRID_QUADRATIC,
        _ => 1.0 / budget::DENSE_GRID,
    };
    assert!(
        worst[0] >= least && worst[1] <= budget::DENSE_GRID,
        "{worst:?}"
    );
}

#[test]
fn tabulate_finds_the_smallest_table_that_holds_everywhere() {
    finds_the_smallest::<Spline<Q31>>();
    finds_the_smallest::<Cubic<Q31>>();
    finds_the_smallest::<Quadratic<f32>>();
    // Four cells are tried, too.
    let request = Request::new(1.0)
        .with_max_speed(10.0)
        .with_max_acceleration(10.0)
        .with_max_cells(64);
    let machine = Wave::bare(1.0, 0.001);
    let cells = table_of::<Spline<f64>>(&machine, &request, &Scale::SI)
        .0
        .cells;
    assert_eq!(cells, 4);
}
