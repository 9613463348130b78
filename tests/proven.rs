//! The arithmetic of a tick: bounds that Gappa proves from the scripts in `tests/proofs` (`scripts/test proofs`), and a search over the ticks
//! themselves that tries to exceed them.
//!
//! The exact value is the tick's formula in double precision, from the table's words and the position that the tick reads.

mod f32;
mod plan;
mod q15;
mod q31;

use crate::support::budget::{self, Proven};
use crate::support::search::extremes;

/// The claim of a script about `name`, after its arrow.
fn claim(script: &str, name: &str) -> [f64; 2] {
    let (_, goals) = script.split_once("->\n").unwrap();
    let start = format!("\n{name} in [");
    let goals = format!("\n{goals}");
    let (_, range) = goals.split_once(&start).unwrap();
    let (range, _) = range.split_once(']').unwrap();
    let (low, high) = range.split_once(", ").unwrap();
    [low, high].map(|number| number.parse().unwrap())
}

#[track_caller]
fn same(claimed: [f64; 2], expected: [f64; 2], what: &str) {
    let bits = |range: [f64; 2]| range.map(f64::to_bits);
    assert_eq!(bits(claimed), bits(expected), "{what}: {claimed:?}");
}

/// The bounds of the budget equal those of the scripts.
#[test]
fn bounds_are_the_proven_ones() {
    let scripts = [
        (
            "spline",
            include_str!("proofs/q31_spline.g"),
            budget::Q31_SPLINE,
        ),
        (
            "cubic",
            include_str!("proofs/q31_cubic.g"),
            budget::Q31_CUBIC,
        ),
        (
            "quadratic",
            include_str!("proofs/q31_quadratic.g"),
            budget::Q31_QUADRATIC,
        ),
        ("rows", include_str!("proofs/q15_rows.g"), budget::Q15_ROWS),
        (
            "f32 rows",
            include_str!("proofs/f32_rows.g"),
            budget::F32_ROWS,
        ),
        (
            "f32 spline",
            include_str!("proofs/f32_spline.g"),
            budget::F32_SPLINE,
        ),
    ];
    for (name, script, proven) in scripts {
        same(claim(script, "torque"), proven.torque, name);
        if script.contains("\nslope in") {
            same(claim(script, "slope"), proven.slope, name);
        }
    }
    let rounding = claim(include_str!("proofs/q15_rows.g"), "rounding");
    same(
        rounding,
        [-budget::ROWS16_TORQUE, budget::ROWS16_TORQUE],
        "rounding",
    );
    let scale = include_str!("proofs/scale.g");
    let [low, high] = claim(scale, "whole").map(|units| units / 16_777_216.0);
    assert!(-low <= budget::WHOLE_FACTOR && high <= budget::WHOLE_FACTOR);
    let [low, high] = claim(scale, "factor -/ FACTOR");
    assert!(-low <= budget::FACTOR_ROUNDING && high <= budget::FACTOR_ROUNDING);
}

/// No tick exceeds the bound for a velocity torque of `whole` slopes per cell, and some come as near as stated.
#[track_caller]
fn holds(
    what: &str,
    proven: &Proven,
    whole: f64,
    genes: usize,
    error: impl Fn(&[u32]) -> Option<f64>,
) {
    let [low, high] = [0, 1].map(|end| proven.torque[end] + whole * proven.slope[end]);
    let [least, most] = extremes(0x7a11_5eed, genes, error);
    println!("{what}: {least:.3} to {most:.3} of {low} to {high}");
    assert!(
        low - proven.exact <= least && most <= high + proven.exact,
        "{what}: {least} to {most}, proven are {low} to {high}"
    );
    assert!(
        least <= proven.reached * low && most >= proven.reached * high,
        "{what}: {least} to {most} of {low} to {high}"
    );
}
