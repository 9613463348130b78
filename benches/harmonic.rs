//! Time from a machine to its harmonics on this computer: `cargo bench -p jred --bench harmonic`. Figures for `docs/harmonics.md`; without limits.

use jred::mechanism::SliderCrankDimensions;
use std::hint::black_box;
use std::time::Instant;

use jred::error::Error;
use jred::harmonic::{fit, scratch_len, terms};
use jred::machine::{Link, Machine};
use jred::mechanism::{Branch, SliderCrank};
use jred::table::{Shape, Table, words_len};
use jred::tabulate::Request;
use jred::{CurveSet, Harmonic, Model, Phase, curves};

const SET: CurveSet = curves::LOAD | terms::SYMMETRIC;
/// The model with these coefficients.
fn model(words: &[f32], harmonics: u32) -> Result<Model<'_, Harmonic<f32>, SET>, Error> {
    let table = Table::new(words, Shape::harmonics(harmonics, SET)).map_err(Error::Table)?;
    Model::new(table).map_err(Error::Table)
}

/// Shortest time of many runs, in µs.
fn time(what: &str, runs: u32, mut work: impl FnMut()) {
    let mut once = || {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    let best = (0..runs).map(|_| once()).fold(f64::INFINITY, f64::min);
    println!("{what:<60} {:9.2} µs", best * 1e6);
}

fn main() -> Result<(), Error> {
    let massless = Link::MASSLESS;
    let ram = Link::point_mass(10.0)?;
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.05,
            rod: 0.2,
            offset: 0.0,
        },
        Branch::Right,
        [massless, massless, ram],
    )?;
    let machine = Machine::new(mechanism)
        .with_gravity([9.81, 0.0])?
        .with_flywheel(0.0063)?;
    let mut scratch = [0.0; scratch_len(16)];
    let mut words = [0.0f64; words_len::<Harmonic<f64>>(16, SET)];
    let mut single = [0.0f32; words_len::<Harmonic<f64>>(16, SET)];
    for torque_error in [1e-3, 1e-5, 1e-7] {
        let request = Request::new(torque_error)
            .with_max_speed(60.0)
            .with_max_acceleration(400.0)
            .with_max_cells(16);
        let found = fit(&machine, SET, &request, &mut scratch, &mut words)?;
        let what = format!(
            "fit f64 to {torque_error:e} N m: {} harmonics, {} samples",
            found.harmonics, found.samples
        );
        time(&what, 200, || {
            let found = fit(&machine, SET, &request, &mut scratch, &mut words);
            black_box(found).ok();
        });
    }
    let request = Request::new(1e-4)
        .with_max_speed(60.0)
        .with_max_acceleration(400.0)
        .with_max_cells(16);
    let found = fit(&machine, SET, &request, &mut scratch, &mut single)?;
    let single = single.get(..found.words).unwrap_or_default();
    let what = format!("show J positive, f32, {} harmonics", found.harmonics);
    time(&what, 200, || {
        black_box(model(single, found.harmonics)).ok();
    });
    let model = model(single, found.harmonics)?;
    time("1000 torques, f32", 200, || {
        for k in 0..1000u32 {
            let phase = Phase::from_bits(k.wrapping_mul(0x9e37_79b9));
            black_box(model.torque(black_box(phase), 10.0, 20.0));
        }
    });
    Ok(())
}
