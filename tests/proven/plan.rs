//! A row of a plan and its follower: random coefficients, instants and rates.

use core::f64::consts::TAU;

use super::claim;
use crate::axis::machine::in_units;
use crate::support::images::sealed;
use crate::support::search::extremes;
use jred::axis::plan::{Errors, HEADER_WORDS, Knot, encode, image_len};
use jred::axis::{MachineUnits, Override, Plan, PlanFollower};
use jred::{Domain, Scale, Spline};

const SCRIPT: &str = include_str!("../proofs/plan.g");

/// Coefficients, speed, instant and rate.
const GENES: usize = 7;

/// Units of the time of the row, whose window is a second.
const LENGTH: u32 = (1 << 30) - 1;

/// Errors: position, speed and acceleration in units of the coefficients, with 2⁻ᵉ of them for an acceleration, and the shares of a follower.
fn errors<M: MachineUnits<Number = f64>>(
    genes: &[u32],
    finer: u32,
    frame: &[u32],
    model: &M,
) -> Option<[f64; 5]> {
    let &[c2, c3, c4, c5, speed, instant, rate] = genes else {
        return None;
    };
    // The sum of 2, 6, 12 and 20 of them is less than 2³¹.
    let c = [(c2, 4), (c3, 5), (c4, 6), (c5, 7)].map(|(gene, less)| gene.cast_signed() >> less);
    let speed = speed.cast_signed() >> 3;
    let exact = |factors: [i32; 4], u: f64| -> f64 {
        let terms = c.iter().zip(factors);
        terms.rev().fold(0.0, |sum, (c, factor)| {
            sum * u + f64::from(*c) * f64::from(factor)
        })
    };
    let way = |u: f64| exact([1; 4], u) * u * u;
    let gained = |u: f64| exact([2, 3, 4, 5], u) * u;
    let end = f64::from(LENGTH) / 2f64.powi(30);
    let moved = |u: f64| (f64::from(speed) * u).floor();

    let mut words = frame.to_vec();
    let mut row = |k: usize, content: [u32; 8]| {
        words[HEADER_WORDS + 8 * k..][..8].copy_from_slice(&content);
    };
    let [c2, c3, c4, c5] = c.map(i32::cast_unsigned);
    let middle = 1_i64 << 33;
    let place = |position: i64| [position as u32, ((position >> 32) << 8) as u32];
    let [low, high] = place(middle);
    row(
        0,
        [0, low, high | finer, speed.cast_unsigned(), c2, c3, c4, c5],
    );
    let [low, high] = place(middle + (moved(end) + way(end)) as i64);
    let last = (f64::from(speed) + gained(end)) as i32;
    row(1, [LENGTH, low, high, last.cast_unsigned(), 0, 0, 0, 0]);
    let words = sealed(words);

    let plan = Plan::new(&words, model).ok()?;
    // Factors from units of the plan are single-precision numbers: integers are recovered.
    let unit = f64::from(TAU as f32) / 2f64.powi(32);
    let counts = |x: f64, e: u32| (x / (unit * f64::from(1_u32 << e))).round();
    // 31 bits of the position.
    let u = instant.min(u32::MAX - 7) & !1;
    let here = plan.at(u64::from(u) << 8).value;
    let u = f64::from(u) / 2f64.powi(32);
    let position = i64::from(here.turns) << 32 | i64::from(here.motion.phase.to_bits());
    let raised = exact([2, 6, 12, 20], u) / f64::from(1_u32 << finer);

    let percent = rate % 101;
    let share = f64::from((percent << 24) / 100) / 2f64.powi(24);
    let mut follower = PlanFollower::new(plan, 1e-3, 0.1, model).unwrap();
    follower.start();
    let slower = follower.next(Override::percent(percent)).motion;
    let begins = counts(plan.at(0).value.motion.alpha, finer);
    Some([
        (position - middle) as f64 - moved(u) - way(u),
        counts(here.motion.omega, 0) - f64::from(speed) - gained(u),
        counts(here.motion.alpha, finer) - raised,
        counts(slower.omega, 0) - f64::from(speed) * share,
        counts(slower.alpha, finer) - begins * share * share,
    ])
}

/// Two rows of a plan with these units: positions, speeds and coefficients are in units of the range over powers of a second.
fn frame(finer: u32) -> Vec<u32> {
    let knot = |t| Knot {
        t,
        omega: 1.0,
        position: t,
        alpha: [0.0; 2],
    };
    let mut words = vec![0; image_len(2)];
    let knots = [knot(0.0), knot(1.0)];
    encode(&knots, Domain::Turn, 0, Errors::default(), &mut words).unwrap();
    words[3] = u32::from_le_bytes([0, 30, 0, finer as u8]);
    words
}

/// No instant of a row exceeds the claims of the script, and some come near.
#[test]
fn a_plan_keeps_the_proven_bounds() {
    let names = ["position", "speed", "acceleration", "share", "twice"];
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    for finer in [0, 3] {
        let frame = frame(finer);
        for (k, name) in names.into_iter().enumerate() {
            let [low, high] = claim(SCRIPT, name);
            let [least, most] = extremes(0x91a4, GENES, |genes| {
                Some(errors(genes, finer, &frame, &model)?[k])
            });
            println!("{name}, {finer}: {least:.3} to {most:.3} of {low} to {high}");
            // Exact values are rounded to 2⁻²⁰.
            assert!(
                low - 1e-6 <= least && most <= high + 1e-6,
                "{name}: {least} to {most}"
            );
            let reached = if name == "acceleration" && finer > 0 {
                0.1
            } else {
                0.6
            };
            assert!(least <= reached * low, "{name}: {least} of {low}");
        }
    }
}
