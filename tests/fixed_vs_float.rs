//! Tabulation: the smallest table, as exact as it says, in every number type.

mod support;

use jred::table::{MIN_CELLS, control_points, curves};
use jred::tabulate::{Request, Tabulated, measure, scratch_len, tabulate};
use jred::{Domain, Phase, Q31, Reducible, Scalar, Scale, Table};
use support::budget::Q31_UNIT;
use support::machines::{Wave, spec};
use support::{assert_near, budget, largest, model, samples, words, zeros};

const ALL: u8 = curves::ALL;

use proptest::prelude::any;

fn table_of<S: Scalar>(
    machine: &impl Reducible,
    request: &Request,
    scale: &Scale,
) -> (Tabulated, Vec<S::Word>) {
    let mut scratch = vec![0.0; scratch_len(request.max_cells, ALL)];
    let mut words = zeros::<S>(control_points(request.max_cells as usize) * curves::width(ALL));
    let found = tabulate::<S, Spline>(machine, ALL, request, scale, &mut scratch, &mut words).unwrap();
    words.truncate(control_points(found.cells as usize) * curves::width(ALL));
    (found, words)
}

/// Ticks of random machines against the exact reduction: the table's stated error and the arithmetic's rounding.
fn ticks_keep_the_stated_error<S: Scalar>(seed: u64, rounding: f64) {
    let (mut worst, mut square, mut sum, mut count) = (0.0, 0.0, 0.0, 0.0);
    let states = samples(300, seed + 1, &(any::<u32>(), -1.0..1.0, -1.0..1.0));
    for spec in samples(12, seed, &spec()) {
        let machine = spec.machine();
        let (top_speed, top) = (40.0, 600.0);
        let scale = Scale::covering(&machine, top_speed, top, 256).unwrap();
        let base = f64::from(scale.torque());
        let request = Request {
            torque_error: 2e-4 * base,
            omega: top_speed,
            alpha: top,
            max_cells: 512,
        };
        let (found, words) = table_of::<S>(&machine, &request, &scale);
        let model = model::<S, ALL>(&words, found.cells, Domain::Turn, &scale);
        for (bits, w, a) in &states {
            let phase = Phase::from_bits(*bits);
            let (omega, alpha) = (
                scale.omega::<S>((top_speed * w) as f32).value,
                scale.alpha::<S>((0.9 * top * a) as f32).value,
            );
            let exact = machine.reduction(phase.radians()).unwrap();
            let terms = exact.torque(
                omega.to_f64() * f64::from(scale.speed()),
                alpha.to_f64() * f64::from(scale.acceleration()),
            );
            let torque = model.torque(phase, omega, alpha).value.to_f64();
            let error = torque - terms.total() / base;
            let size = largest(terms.values()) / base;
            let allowed = budget::DENSE_GRID * found.torque_error / base
                + rounding
                + budget::FACTOR_ROUNDING * size;
            assert_near("torque", torque, terms.total() / base, allowed);
            let drive = scale.to_torque::<S>(terms.total() as f32).value;
            let expected = exact.acceleration(
                omega.to_f64() * f64::from(scale.speed()),
                drive.to_f64() * base,
            );
            let back = model.acceleration(phase, omega, drive).value.to_f64()
                * f64::from(scale.acceleration());
            assert_near(
                "acceleration",
                back,
                expected,
                budget::DENSE_GRID * allowed * base / exact.inertia[0],
            );
            let share = error * base / found.torque_error;
            worst = largest([worst, share]);
            (square, sum, count) = (square + share * share, sum + share, count + 1.0);
        }
    }
    let (rms, bias) = (f64::sqrt(square / count), sum / count);
    println!(
        "{}: error over stated error: largest {worst:.3}, RMS {rms:.3}, bias {bias:.1e}",
        S::NAME
    );
    assert!(
        rms < 0.5 && bias.abs() < budget::TABLE_BIAS,
        "RMS {rms}, bias {bias}"
    );
    assert!(worst > 0.3, "a stated error three times too large: {worst}");
}

#[test]
fn single_precision_ticks_keep_the_stated_error() {
    ticks_keep_the_stated_error::<f32>(0x0021, budget::TICK_ROUNDINGS * f64::from(f32::EPSILON));
}

#[test]
fn q31_ticks_keep_the_stated_error() {
    ticks_keep_the_stated_error::<Q31>(0x0021, budget::Q31_TICK_UNITS * Q31_UNIT);
}

/// The bound of `tabulate`, written anew, on nine times as many places (the checked ones among them).
fn dense<S: Scalar>(
    machine: &impl Reducible,
    table: &Table<'_, S, ALL>,
    request: &Request,
    scale: &Scale,
) -> f64 {
    let [t, w, j] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let places = 72 * table.cells();
    largest((0..places).map(|k| {
        let phi = machine
            .domain()
            .position((f64::from(k) + 0.5) / f64::from(places));
        let (exact, read) = (
            machine.reduction(phi).unwrap(),
            table.at(machine.domain().phase(phi)),
        );
        let slope =
            read.inertia_slope.to_f64() * j * f64::from(table.cells()) / machine.domain().span();
        (j * read.inertia.to_f64() - exact.inertia[0]).abs() * request.alpha
            + (slope - exact.inertia[1]).abs() * request.omega.powi(2) / 2.0
            + (t * read.load.to_f64() - exact.load_torque()).abs()
            + (t / w * read.viscous.to_f64() - exact.viscous).abs() * request.omega
            + (t * read.coulomb.to_f64() - exact.coulomb).abs()
    }))
}

#[test]
fn tabulate_finds_the_smallest_table_that_holds_everywhere() {
    let mut worst = [f64::INFINITY, 0.0];
    for (k, spec) in samples(8, 0x0031, &spec()).iter().enumerate() {
        let machine = spec.machine();
        let scale = Scale::covering(&machine, 40.0, 600.0, 256).unwrap();
        let torque_error = f64::from(scale.torque()) * [0.2, 1e-2, 1e-3, 1e-4][k % 4];
        let request = Request {
            torque_error,
            omega: 40.0,
            alpha: 600.0,
            max_cells: 400,
        };
        let (found, rows) = table_of::<Q31>(&machine, &request, &scale);
        let table = Table::<Q31>::new(&rows, ALL, found.cells, true).unwrap();
        assert!(found.torque_error <= torque_error);
        assert_eq!(
            measure(&machine, &table, &request, &scale)
                .unwrap()
                .torque_error
                .to_bits(),
            found.torque_error.to_bits()
        );
        let ratio = dense(&machine, &table, &request, &scale) / found.torque_error;
        worst = [worst[0].min(ratio), worst[1].max(ratio)];
        // No smaller table does.
        for cells in MIN_CELLS as u32..found.cells {
            let Ok(rows) = words::<Q31, ALL>(&machine, cells, &scale) else {
                continue;
            };
            let table = Table::<Q31>::new(&rows, ALL, cells, true).unwrap();
            let reached = measure(&machine, &table, &request, &scale)
                .unwrap()
                .torque_error;
            assert!(
                reached > torque_error,
                "{cells} cells reach {reached} N·m, {} were taken",
                found.cells
            );
        }
        println!("{} cells, dense over stated {ratio:.3}", found.cells);
    }
    // Four cells are tried, too.
    let request = Request {
        torque_error: 1.0,
        omega: 10.0,
        alpha: 10.0,
        max_cells: 64,
    };
    let machine = Wave::bare(1.0, 0.001);
    assert_eq!(table_of::<f64>(&machine, &request, &Scale::SI).0.cells, 4);
    assert!(
        worst[0] >= 1.0 / budget::DENSE_GRID && worst[1] <= budget::DENSE_GRID,
        "{worst:?}"
    );
}
