//! Inverse dynamics of a million samples, compared with NumPy on the same table, and the time to make a table.
//!
//! ```text
//! cargo bench -p jred --bench batch
//! ```
//!
//! Valgrind counts the instructions, and `ceilings.txt` limits them; the search for a table is limited by its number of reductions. Times depend on
//! the machine and are only printed. `python3 benches/batch.py` runs NumPy where installed; its torques are compared with these. docs/performance.md
//! has the results.
#![cfg(not(target_os = "none"))]

#[path = "support/bench.rs"]
mod bench;
#[path = "support/ceilings.rs"]
mod ceilings;

use jred::mechanism::SliderCrankDimensions;
use std::cell::Cell;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::{fs, io};

use bench::{Bench, best, once};
use jred::error::Error;
use jred::harmonic::{self, terms};
use jred::machine::{Action, Link, Load, Machine, Reducible, Reduction};
use jred::mechanism::{Branch, SliderCrank};
use jred::number::{Number, Quantity};
use jred::table::{Format, Shape, Table, words_len};
use jred::tabulate::{Request, fill, scratch_len, tabulate};
use jred::{
    Cubic, CurveSet, Domain, Harmonic, Model, Phase, Q31, Quadratic, Scale, Spline, Spline16,
    curves,
};

/// Samples of a timed batch, and of a batch whose instructions are counted.
const SAMPLES: usize = 1_000_000;
const COUNTED: u32 = 10_000;
/// Cells of the batch's table.
const CELLS: u32 = 128;
/// Its curves: inertia and load, constant friction.
const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// Largest speed and acceleration (rad/s, rad/s²).
const OMEGA: f64 = 60.0;
const ALPHA: f64 = 400.0;
/// Largest difference between two batches in f32, relative to the largest torque: roundings of 2⁻²⁴ in a tick and in the place.
const DIFFERENCE: f64 = 1e-6;

/// λ = 0.25, 10 kg at the slider, largest inertia 5.25 times the least; weight acts along the guide.
fn slider_crank() -> Result<Machine<SliderCrank>, Error> {
    let massless = Link::MASSLESS;
    let slider = Link::point_mass(10.0)?;
    let links = [massless, massless, slider];
    let mechanism = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.05,
            rod: 0.2,
            offset: 0.0,
        },
        Branch::Right,
        links,
    )?;
    Ok(Machine::new(mechanism)
        .with_gravity([9.81, 0.0])?
        .with_flywheel(0.0063)?)
}

fn with_friction() -> Result<Machine<SliderCrank>, Error> {
    let crank = SliderCrank::CRANK;
    Ok(slider_crank()?
        .with_load(Load::new(crank, Action::ViscousMoment(0.02))?)?
        .with_load(Load::new(crank, Action::OpposingMoment(0.3))?)?)
}

/// The largest torque in the range (N·m).
fn peak(machine: &impl Reducible) -> Result<f64, Error> {
    let mut most = 0.0f64;
    for k in 0..3600 {
        let point = machine.reduction(f64::from(k) * TAU / 3600.0)?;
        for alpha in [ALPHA, -ALPHA] {
            most = most.max(point.torque(OMEGA, alpha).total().abs());
        }
    }
    Ok(most)
}

/// Phases, speeds, accelerations, and memory for torques.
struct Batch<S: Number> {
    phases: Vec<Phase>,
    omegas: Vec<S::Speed>,
    alphas: Vec<S::Acceleration>,
    torques: Vec<S::Torque>,
}

impl<S: Number> Batch<S> {
    /// Phases of a turn in order, or consecutive ones far apart: by 2³²/φ, φ the golden ratio.
    fn new(ordered: bool, samples: usize) -> Self {
        let step = if ordered { 4295 } else { 0x9e37_79b9 };
        let wave = |k: u32, step: f64, size: f64| {
            S::from_f64((f64::from(k) * step).sin() * size).unwrap_or_default()
        };
        let each = || 0..samples as u32;
        Self {
            phases: each()
                .map(|k| Phase::from_bits(k.wrapping_mul(step)))
                .collect(),
            omegas: each()
                .map(|k| Quantity::of(wave(k, 0.010, OMEGA)))
                .collect(),
            alphas: each()
                .map(|k| Quantity::of(wave(k, 0.013, ALPHA)))
                .collect(),
            torques: vec![S::Torque::default(); samples],
        }
    }

    fn run<F: Format<Number = S>>(&mut self, model: &Model<'_, F, SET>) {
        let count = model.torques(
            black_box(&self.phases),
            black_box(&self.omegas),
            black_box(&self.alphas),
            black_box(&mut self.torques),
        );
        assert_eq!(count, self.phases.len());
    }

    /// The shortest time for all samples (s), of many runs.
    fn time<F: Format<Number = S>>(&mut self, model: &Model<'_, F, SET>) -> f64 {
        let runs = (0..BATCHES).map(|_| once(|| self.run(model)));
        runs.fold(f64::INFINITY, f64::min)
    }
}

/// The table, filled.
fn words<F: Format>(machine: &impl Reducible) -> Result<(Vec<F::Word>, Shape<F>), Error> {
    let mut scratch = vec![0.0; scratch_len(CELLS, SET)];
    let mut words = vec![F::Word::default(); words_len::<F>(CELLS, SET)];
    let shape = fill::<F>(machine, SET, CELLS, &Scale::SI, &mut scratch, &mut words)?.shape();
    Ok((words, shape))
}

/// Runs of a batch: 3 ms each, so that some of them are not interrupted.
const BATCHES: u32 = 31;

/// Both orders of phases with one number type and layout: cost per hundred samples.
fn batch<F: Format>(bench: &mut Bench, machine: &impl Reducible) -> Result<(), Error> {
    let (words, shape) = words::<F>(machine)?;
    let table = Table::<F>::new(&words, shape).map_err(Error::Table)?;
    let model = Model::<F, SET>::new(table).map_err(Error::Table)?;
    for (order, ordered) in [("ordered", true), ("random", false)] {
        let name = format!("batch-{}-{}-{order}", <F::Number as Number>::NAME, F::NAME);
        let mut counted = Batch::<F::Number>::new(ordered, COUNTED as usize);
        let count = bench.count(&name, || counted.run(&model));
        bench.cost_of(
            &name,
            COUNTED / 100,
            count,
            || {
                let mut batch = Batch::<F::Number>::new(ordered, SAMPLES);
                batch.time(&model) * 100.0 / SAMPLES as f64
            },
            |time| format!("{:9.2} {:9.0}", time * 1e7, 1e-6 * 100.0 / time),
        );
    }
    Ok(())
}

/// NumPy with the same cubic table and samples.
fn numpy(bench: &mut Bench, machine: &impl Reducible, peak: f64) -> Result<(), Error> {
    let (words, shape) = words::<Cubic<f32>>(machine)?;
    let table = Table::new(&words, shape).map_err(Error::Table)?;
    let model = Model::<Cubic<f32>, SET>::new(table).map_err(Error::Table)?;
    let constants = shape.constants;
    for (order, ordered) in [("ordered", true), ("random", false)] {
        let mut batch = Batch::<f32>::new(ordered, SAMPLES);
        let mut own = batch.time(&model);
        let [viscous, coulomb] = [constants.viscous, constants.coulomb];
        let torques = match numpy_torques(&words, [viscous, coulomb], &batch) {
            Ok(Some(answer)) => answer,
            Ok(None) => {
                println!(
                    "NUMPY IS MISSING (python3 -c 'import numpy' fails): not compared with it"
                );
                return Ok(());
            }
            Err(error) => {
                bench.fail(&format!("benches/batch.py: {error}"));
                return Ok(());
            }
        };
        // The other half of the runs follows, so that both see the same machine load.
        own = own.min(batch.time(&model));
        let (version, time, torques) = torques;
        let pairs = batch.torques.iter().zip(&torques);
        let difference = pairs.map(|(a, b)| f64::from((a - b).abs())).fold(
            if torques.len() == SAMPLES {
                0.0
            } else {
                f64::NAN
            },
            f64::max,
        );
        println!(
            "{order:8} NumPy {version}: {:.1} M/s, jred {:.0} M/s: {:.0} times as many; largest difference {:.1e} of the peak torque",
            1e-6 * SAMPLES as f64 / time,
            1e-6 * SAMPLES as f64 / own,
            time / own,
            difference / peak,
        );
        // NaN fails, too.
        let agrees = difference <= DIFFERENCE * peak;
        if !agrees {
            bench.fail(&format!(
                "NumPy and jred differ by more than {DIFFERENCE:e}"
            ));
        }
    }
    Ok(())
}

type Numpy = (String, f64, Vec<f32>);

/// NumPy's version, its best time (s) and its torques; `None` without NumPy.
fn numpy_torques(
    words: &[f32],
    constants: [f32; 2],
    batch: &Batch<f32>,
) -> io::Result<Option<Numpy>> {
    let there = Command::new("python3")
        .args(["-c", "import numpy"])
        .output();
    if !there.is_ok_and(|output| output.status.success()) {
        return Ok(None);
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    fs::create_dir_all(folder)?;
    let phases: Vec<u32> = batch.phases.iter().map(|p| p.to_bits()).collect();
    for (name, bytes) in [
        ("table", bytemuck::cast_slice(words)),
        ("constants", bytemuck::cast_slice(&constants)),
        ("phase", bytemuck::cast_slice(&phases)),
        ("omega", bytemuck::cast_slice(&batch.omegas)),
        ("alpha", bytemuck::cast_slice(&batch.alphas)),
    ] {
        fs::write(folder.join(name), bytes)?;
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/batch.py");
    let output = Command::new("python3").arg(script).arg(folder).output()?;
    if !output.status.success() {
        return Err(io::Error::other(String::from_utf8_lossy(&output.stderr)));
    }
    let answer = String::from_utf8_lossy(&output.stdout);
    let mut answer = answer.split_whitespace();
    let version = answer.next().unwrap_or_default().to_owned();
    let time = answer.next().and_then(|time| time.parse().ok());
    let time = time.ok_or_else(|| io::Error::other("no time"))?;
    let torques = fs::read(folder.join("torque"))?;
    let (numbers, _) = torques.as_chunks::<4>();
    let torques = numbers.iter().map(|bytes| f32::from_le_bytes(*bytes));
    Ok(Some((version, time, torques.collect())))
}

/// Counts the reductions of a machine.
struct Counted<'m, M>(&'m M, Cell<u32>);

impl<M: Reducible> Reducible for Counted<'_, M> {
    fn domain(&self) -> Domain {
        self.0.domain()
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, jred::machine::PoseError> {
        self.1.set(self.1.get() + 1);
        self.0.reduction(phi)
    }

    fn check_repeats(&self) -> Result<(), jred::machine::PoseError> {
        self.0.check_repeats()
    }
}

/// Greatest number of cells in the search for a table.
const MOST: u32 = 16_384;

/// The smallest table for an error, as a share of the peak torque.
fn table<F: Format>(
    bench: &mut Bench,
    machine: &impl Reducible,
    peak: f64,
    share: f64,
    scale: &Scale,
) -> Result<(), Error> {
    let set = curves::LOAD;
    let request = Request::new(share * peak)
        .with_max_speed(OMEGA)
        .with_max_acceleration(ALPHA)
        .with_max_cells(MOST);
    let mut scratch = vec![0.0; scratch_len(MOST, set)];
    let mut words = vec![F::Word::default(); words_len::<F>(MOST, set)];
    let counted = Counted(machine, Cell::new(0));
    let found = tabulate::<F>(&counted, set, &request, scale, &mut scratch, &mut words)?;
    if bench.counts() {
        return Ok(());
    }
    let time = best(|| tabulate::<F>(machine, set, &request, scale, &mut scratch, &mut words));
    bench.judge(
        &format!(
            "table-{}-{}-{share:e}",
            <F::Number as Number>::NAME,
            F::NAME
        ),
        u64::from(counted.1.get()),
        &format!("{:9.3} {:9} cells", time * 1e3, found.cells),
    );
    Ok(())
}

/// The fewest harmonics for an error.
fn harmonics<T>(
    bench: &mut Bench,
    name: &str,
    machine: &impl Reducible,
    peak: f64,
    share: f64,
) -> Result<(), Error>
where
    T: harmonic::Circular + Number,
    Harmonic<T>: Format<Number = T, Word = T, Constants = ()>,
{
    const SET: CurveSet = curves::LOAD | terms::SYMMETRIC;
    const MOST: u32 = 16;
    let request = Request::new(share * peak)
        .with_max_speed(OMEGA)
        .with_max_acceleration(ALPHA)
        .with_max_cells(MOST);
    let mut scratch = [0.0; harmonic::scratch_len(MOST)];
    let mut words = vec![T::default(); words_len::<Harmonic<T>>(MOST, SET)];
    let mut run = || harmonic::fit(machine, SET, &request, &mut scratch, &mut words);
    let found = run()?.harmonics;
    bench.cost(
        &format!("harmonics-{name}-{share:e}"),
        1,
        || {
            black_box(run()).ok();
        },
        |time| format!("{:9.3} {found:9} harmonics", time * 1e3),
    );
    Ok(())
}

fn run(bench: &mut Bench) -> Result<(), Error> {
    let machine = with_friction()?;
    println!(
        "torques                              ns a sample, million/s, instructions a hundred samples"
    );
    batch::<Cubic<f32>>(bench, &machine)?;
    batch::<Spline<f32>>(bench, &machine)?;
    batch::<Cubic<f64>>(bench, &machine)?;
    batch::<Spline<f64>>(bench, &machine)?;
    if !bench.counts() {
        println!();
        numpy(bench, &machine, peak(&machine)?)?;
    }

    let machine = slider_crank()?;
    let peak = peak(&machine)?;
    let covering = Scale::covering(&machine, OMEGA, ALPHA, 1440)?;
    println!(
        "\ntable for an error                   ms, size, reductions; harmonics: instructions"
    );
    table::<Spline16>(bench, &machine, peak, 1e-3, &covering)?;
    table::<Quadratic<Q31>>(bench, &machine, peak, 1e-4, &covering)?;
    table::<Spline<Q31>>(bench, &machine, peak, 1e-6, &covering)?;
    table::<Cubic<f32>>(bench, &machine, peak, 1e-6, &Scale::SI)?;
    table::<Cubic<f64>>(bench, &machine, peak, 1e-6, &Scale::SI)?;
    table::<Spline<f64>>(bench, &machine, peak, 1e-6, &Scale::SI)?;
    table::<Spline<f64>>(bench, &machine, peak, 1e-9, &Scale::SI)?;
    harmonics::<f32>(bench, "f32", &machine, peak, 1e-6)?;
    harmonics::<f64>(bench, "f64", &machine, peak, 1e-6)?;
    harmonics::<f64>(bench, "f64", &machine, peak, 1e-9)
}

fn main() -> ExitCode {
    Bench::main(run)
}
