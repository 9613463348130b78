//! Cost of the general linkage on the host: instructions per position and their growth; times for information; no memory.
//!
//! ```text
//! cargo bench -p jred --bench linkage
//! ```
//!
//! Valgrind counts the instructions, and `ceilings.txt` limits them and their growth with the number of positions or links. Times depend on the
//! machine and are only printed. docs/performance.md has the results.
#![cfg(not(target_os = "none"))]

#[path = "support/bench.rs"]
mod bench;
#[path = "support/ceilings.rs"]
mod ceilings;
#[path = "support/memory.rs"]
mod memory;
#[path = "support/shapes.rs"]
mod shapes;
mod support;

use jred::mechanism::SixLinkDimensions;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::process::ExitCode;

use bench::{Bench, best};
use jred::error::Error;
use jred::machine::{Machine, Mechanism, Reducible};
use jred::mechanism::{Branch, SixLink};
use memory::{Counting, Memory};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Positions of a run.
const POSITIONS: u32 = 4096;
/// Positions timed together, in less than a time slice: a busy machine interrupts every longer run.
const PIECE: u32 = 64;

/// Reductions at `count` positions from `first` on, of a turn of `positions`.
fn reduce(machine: &impl Reducible, first: u32, count: u32, positions: u32) {
    let step = TAU / f64::from(positions);
    let mut sum = 0.0;
    for k in first..first + count {
        let reduction = machine.reduction(f64::from(k) * step);
        // A failure would make the sum NaN.
        sum += reduction.map_or(f64::NAN, |r| r.inertia);
    }
    assert!(sum > 0.0, "a position failed");
    black_box(sum);
}

/// Time of one reduction (s), over a turn of `positions`.
fn time(machine: &impl Reducible, positions: u32) -> f64 {
    let pieces = (0..positions).step_by(PIECE as usize);
    let pieces = pieces.map(|first| best(|| reduce(machine, first, PIECE, positions)));
    pieces.sum::<f64>() / f64::from(positions)
}

/// Instructions of a reduction, over a turn of `positions`.
fn count(bench: &mut Bench, name: &str, machine: &impl Reducible, positions: u32) -> Option<f64> {
    let count = bench.count(name, || reduce(machine, 0, positions, positions))?;
    Some(count as f64 / f64::from(positions))
}

/// Checks the instructions per position, and prints its time.
fn cost(bench: &mut Bench, name: &str, machine: &impl Reducible) {
    let line = |time: f64| {
        let turn = time * 1e3 * f64::from(POSITIONS);
        format!("{:8.0} {turn:9.2}", time * 1e9)
    };
    let count = bench.count(name, || reduce(machine, 0, POSITIONS, POSITIONS));
    let time = || time(machine, POSITIONS);
    bench.cost_of(name, POSITIONS, count, time, line);
}

/// The exponent p of time ~ nᵖ, the least-squares fit of the points (n, time).
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

/// A growing linkage: number of links, size of the largest group, instructions and time (s) per position.
type Sample = (usize, usize, Option<f64>, f64);

macro_rules! grow {
    ($bench:ident, $make:ident, $($links:literal $pairs:literal $size:expr),*) => {
        vec![$({
            let assembly = shapes::$make::<$links, $pairs>($size)?;
            let largest = assembly.linkage().group_sizes().max().unwrap_or(0);
            let links = assembly.links().len();
            let machine = Machine::new(assembly);
            let name = format!("{}-{links}", stringify!($make));
            let count = count($bench, &name, &machine, POSITIONS / 8);
            let time = if $bench.counts() { 0.0 } else { time(&machine, POSITIONS / 8) };
            (links, largest, count, time)
        }),*]
    };
}

/// Prints the growth of the cost per position, and checks the exponent with respect to `size`.
fn growth(
    bench: &mut Bench,
    what: &str,
    band: [f64; 2],
    samples: &[Sample],
    size: fn(&Sample) -> usize,
) {
    println!("links  largest group  instructions a position       ns");
    for (links, largest, count, time) in samples {
        let count = count.unwrap_or(f64::NAN);
        println!("{links:5} {largest:14} {count:24.0} {:8.0}", time * 1e9);
    }
    let points: Option<Vec<_>> = samples
        .iter()
        .map(|s| Some((size(s) as f64, s.2?)))
        .collect();
    bench.band(what, band, points.map(|points| exponent(&points)));
}

fn run(bench: &mut Bench) -> Result<(), Error> {
    let gravity = [0.0, -9.81];
    let six_link = Machine::new(shapes::six_link()?).with_gravity(gravity)?;
    let [crank, rocker, rod, centres, guide] = shapes::SIX_LINK;
    let lengths = [crank, rocker, rod];
    let closed = SixLink::new(
        SixLinkDimensions {
            crank: lengths[0],
            rocker: lengths[1],
            rod: lengths[2],
            centres,
            below: guide,
        },
        Branch::Right,
        shapes::six_links()?,
    )?;
    let closed = Machine::new(closed).with_gravity(gravity)?;
    let four_bar = Machine::new(support::four_bar()?).with_gravity(gravity)?;
    let four_bar_linkage =
        Machine::new(support::four_bar_linkage::<256>()?).with_gravity(gravity)?;

    println!("reduction                            ns   ms/4096  instructions");
    cost(bench, "six-link-closed", &closed);
    cost(bench, "six-link-linkage", &six_link);
    cost(bench, "four-bar-closed", &four_bar);
    cost(bench, "four-bar-linkage", &four_bar_linkage);
    bench.control("six-link-linkage", POSITIONS, |positions| {
        reduce(&six_link, 0, positions, positions);
    });

    println!("\nnumber of positions, six-link as a linkage");
    let middle = count(bench, "positions-4096", &six_link, 4096);
    for positions in [1024, 16384] {
        let name = format!("positions-{positions}");
        let count = count(bench, &name, &six_link, positions);
        let what = format!("instructions a position, {positions} to 4096 positions");
        bench.band(&what, [0.9, 1.1], count.zip(middle).map(|(a, b)| a / b));
    }

    println!("\na chain of two-link groups");
    let samples = grow!(
        bench, chain, 3 4 1, 5 7 2, 7 10 3, 9 13 4, 11 16 5, 13 19 6, 15 22 7
    );
    growth(
        bench,
        "exponent of the number of links",
        [0.8, 1.3],
        &samples,
        |s| s.0,
    );

    println!("\none group that cannot be divided");
    let samples = grow!(
        bench, group, 5 7 1, 7 10 2, 9 13 3, 11 16 4, 13 19 5, 15 22 6
    );
    growth(
        bench,
        "exponent of the size of the group",
        [0.8, 2.0],
        &samples,
        |s| s.1,
    );

    if bench.counts() {
        return Ok(());
    }
    let nothing = Memory::default();
    let turn = memory::of(|| {
        reduce(&six_link, 0, POSITIONS, POSITIONS);
        reduce(&closed, 0, POSITIONS, POSITIONS);
        black_box(six_link.forces(1.0, 10.0, 0.0))
    });
    println!("\n{} positions: {turn:?}", 2 * POSITIONS);
    if turn != nothing {
        bench.fail("a position must not allocate");
    }
    if memory::of(|| black_box(vec![0u8; 64])) == nothing {
        bench.fail("allocations are not counted");
    }
    Ok(())
}

fn main() -> ExitCode {
    Bench::main(run)
}
