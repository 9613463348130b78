//! What the general linkage costs on the host: time a position, against the time of one sine with cosine in the same run.
//!
//! ```text
//! cargo bench -p jred --bench linkage
//! ```
//!
//! Times depend on the machine, so nothing is asserted about them. Ratios are: to the reference, by `ceilings.txt`; from
//! one number of positions or links to another; and no position allocates memory. A ratio out of bounds is measured again,
//! at most twice: another program on the machine may have disturbed it. docs/performance.md has the results.
#![cfg(not(target_os = "none"))]

#[path = "support/clock.rs"]
mod clock;
#[path = "support/shapes.rs"]
mod shapes;
mod support;

use std::alloc::{GlobalAlloc, Layout, System};
use std::f64::consts::TAU;
use std::hint::black_box;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};

use clock::{RUNS, Report, best, sin_cos};
use jred::mechanism::{Branch, Mechanism, SixLink};
use jred::{Error, Machine, Reducible};

/// Counts what is allocated.
struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes on to the system's allocator, unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Positions of a run.
const POSITIONS: u32 = 4096;
/// Positions that are timed together.
const PIECE: u32 = 64;

/// Time of one reduction (s), over a turn of so many positions. Timed in pieces shorter than a time slice: on a busy machine
/// every longer run is interrupted.
fn position(machine: &impl Reducible, positions: u32) -> f64 {
    let step = TAU / f64::from(positions);
    let pieces = (0..positions).step_by(PIECE as usize).map(|first| {
        best(|| {
            let mut sum = 0.0;
            for k in first..first + PIECE {
                let reduction = machine.reduction(f64::from(k) * step);
                // What fails would be seen in the sum.
                sum += reduction.map_or(f64::NAN, |r| r.inertia[0]);
            }
            assert!(sum > 0.0, "a position failed");
            black_box(sum);
        })
    });
    pieces.sum::<f64>() / f64::from(positions)
}

/// Judges the cost of a position in sines, and prints its time for a turn.
fn cost(report: &mut Report, name: &str, machine: &impl Reducible) {
    let line = |time: f64| {
        let turn = time * 1e3 * f64::from(POSITIONS);
        format!("{:8.0} {turn:9.2}", time * 1e9)
    };
    report.cost(name, || position(machine, POSITIONS), line);
}

/// The exponent p of time ~ nᵖ between the least squares of the points (n, time).
fn exponent(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let log = points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let (x, y) = log
        .clone()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (top, bottom) = log.fold((0.0, 0.0), |(a, b), (u, v)| {
        (a + (u - x) * (v - y), b + (u - x) * (u - x))
    });
    top / bottom
}

/// A linkage that grows: number of links, size of the largest group, time a position (s).
type Sample = (usize, usize, f64);

macro_rules! grow {
    ($make:ident, $($links:literal $pairs:literal $size:expr),*) => {
        || -> Result<Vec<Sample>, Error> {
            Ok(vec![$({
                let assembly = shapes::$make::<$links, $pairs>($size)?;
                let largest = assembly.linkage().group_sizes().max().unwrap_or(0);
                let links = assembly.links().len();
                (links, largest, position(&Machine::new(assembly), POSITIONS / 8))
            }),*])
        }
    };
}

fn print(samples: &[Sample]) {
    println!("links  largest group  ns a position");
    for (links, largest, time) in samples {
        println!("{links:5} {largest:14} {:14.0}", time * 1e9);
    }
}

fn run() -> Result<u32, Error> {
    let mut report = Report::default();
    let gravity = [0.0, -9.81];
    let six_link = Machine::new(shapes::six_link()?).with_gravity(gravity)?;
    let [crank, rocker, rod, centres, guide] = shapes::SIX_LINK;
    let lengths = [crank, rocker, rod];
    let closed = SixLink::new(lengths, centres, guide, Branch::Right, shapes::six_links()?)?;
    let closed = Machine::new(closed).with_gravity(gravity)?;
    let four_bar = Machine::new(support::four_bar()?).with_gravity(gravity)?;
    let four_bar_linkage =
        Machine::new(support::four_bar_linkage::<256>()?).with_gravity(gravity)?;

    println!("reference: one sine with cosine, {:.1} ns", sin_cos() * 1e9);
    println!("reduction                        ns   ms/4096     sines");
    cost(&mut report, "six-link-closed", &closed);
    cost(&mut report, "six-link-linkage", &six_link);
    cost(&mut report, "four-bar-closed", &four_bar);
    cost(&mut report, "four-bar-linkage", &four_bar_linkage);

    println!("\nnumber of positions, six-link as a linkage");
    for positions in [1024, 16384] {
        let what = format!("time a position, {positions} to 4096 positions");
        report.band(&what, [0.8, 1.25], || {
            position(&six_link, positions) / position(&six_link, 4096)
        });
    }

    println!("\na chain of two-link groups");
    let grown = grow!(
        chain, 3 4 1, 5 7 2, 7 10 3, 9 13 4, 11 16 5, 13 19 6, 15 22 7
    );
    print(&grown()?);
    report.band("exponent of the number of links", [0.8, 1.3], || {
        let samples = grown().unwrap_or_default();
        let points: Vec<_> = samples.iter().map(|s| (s.0 as f64, s.2)).collect();
        exponent(&points)
    });

    println!("\none group that cannot be divided");
    let grown = grow!(
        group, 5 7 1, 7 10 2, 9 13 3, 11 16 4, 13 19 5, 15 22 6
    );
    print(&grown()?);
    report.band("exponent of the size of the group", [0.8, 2.0], || {
        let samples = grown().unwrap_or_default();
        let points: Vec<_> = samples.iter().map(|s| (s.1 as f64, s.2)).collect();
        exponent(&points)
    });

    let before = ALLOCATIONS.load(Ordering::Relaxed);
    position(&six_link, POSITIONS);
    position(&closed, POSITIONS);
    let forces = six_link.forces(1.0, 10.0, 0.0)?;
    black_box(forces);
    let allocated = ALLOCATIONS.load(Ordering::Relaxed) - before;
    println!(
        "\nallocations in {} positions: {allocated}",
        2 * RUNS * POSITIONS
    );
    assert_eq!(allocated, 0, "a position must not allocate");
    assert!(before > 0, "allocations are counted");
    Ok(report.failures())
}

fn main() -> ExitCode {
    match run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(failures) => {
            println!("{failures} out of bounds");
            ExitCode::FAILURE
        }
        Err(error) => {
            println!("FAILED: {error}");
            ExitCode::FAILURE
        }
    }
}
