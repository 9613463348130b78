//! Shared by the test files.
#![allow(dead_code, reason = "every test file uses its own part")]

pub(crate) mod budget;
pub(crate) mod cams;
#[cfg(feature = "micromath")]
pub(crate) mod cranks;
pub(crate) mod derivatives;
pub(crate) mod exact;
pub(crate) mod forces;
pub(crate) mod golden;
pub(crate) mod harmonics;
pub(crate) mod images;
pub(crate) mod jointed;
pub(crate) mod machines;
pub(crate) mod rows;
pub(crate) mod search;

use jred::machine::{Link, MassProperties};
use jred::number::{Bases, Number as _, Quantity};
use jred::{Domain, Phase, Scale};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// The same cases in every run, and no files written.
pub(crate) fn config(cases: u32, seed: u64) -> Config {
    Config {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(seed),
        max_global_rejects: 100 * cases,
        ..Config::default()
    }
}

/// `count` values of a strategy, the same in every run: for figures over many cases (largest, RMS, bias).
pub(crate) fn samples<T: Strategy>(count: u32, seed: u64, strategy: &T) -> Vec<T::Value> {
    let mut runner = TestRunner::new(config(count, seed));
    let mut next = || strategy.new_tree(&mut runner).unwrap().current();
    (0..count).map(|_| next()).collect()
}

/// A link of this mass (kg), this inertia about its centre of mass (kg·m²), and this centre of mass (m).
pub(crate) fn link_of(mass: f64, inertia: f64, com: [f64; 2]) -> Link {
    Link::new(MassProperties { mass, inertia, com }).unwrap()
}

/// Machine units with these bases of torque, speed and inertia.
pub(crate) fn scale_of(torque: f32, speed: f32, inertia: f32) -> Scale {
    let bases = Bases {
        torque,
        speed,
        inertia,
    };
    Scale::new(bases).unwrap()
}

/// An error's message with its cure; for a quantity outside its range the message alone, which is complete.
pub(crate) fn spoken(error: impl Into<jred::error::Error>) -> String {
    match error.into() {
        range @ jred::error::Error::Range(_) => range.to_string(),
        error => format!("{error}; {}", error.cure()),
    }
}

/// Fails on NaN, too.
#[track_caller]
pub(crate) fn assert_near(what: &str, found: f64, expected: f64, budget: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= budget,
        "{what}: {found:e}, expected {expected:e}, off by {error:e} > {budget:e}"
    );
}

/// `parts` + 1 phases from one end of the range to the other, with their positions.
pub(crate) fn grid(domain: Domain, parts: u32) -> impl Iterator<Item = (Phase, f64)> {
    (0..=parts).map(move |k| {
        let place = (u64::from(k) << 32) / u64::from(parts);
        let phase = Phase::from_bits(u32::try_from(place).unwrap_or(u32::MAX));
        let turns = f64::from(phase.to_bits()) / 4_294_967_296.0;
        (phase, domain.position(turns))
    })
}

/// f′(x) by central differences, extrapolated twice: order 6.
pub(crate) fn derivative(f: impl Fn(f64) -> f64, x: f64, step: f64) -> f64 {
    let central = |h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
    let [a, b, c] = [central(step), central(step / 2.0), central(step / 4.0)];
    let [ab, bc] = [b + (b - a) / 3.0, c + (c - b) / 3.0];
    bc + (bc - ab) / 15.0
}

/// One step of the classical Runge-Kutta method for y′ = f(x, y).
pub(crate) fn rk4(f: impl Fn(f64, f64) -> f64, x: f64, y: f64, h: f64) -> f64 {
    let k1 = f(x, y);
    let k2 = f(x + h / 2.0, y + h / 2.0 * k1);
    let k3 = f(x + h / 2.0, y + h / 2.0 * k2);
    let k4 = f(x + h, y + h * k3);
    y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
}

/// Largest magnitude.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, v| v.abs().max(most))
}

/// The nearest speed, acceleration or torque in machine units.
pub(crate) fn quantity<Q: Quantity>(value: f64) -> Q {
    Q::of(Q::Number::from_f64(value).unwrap())
}

/// The value in machine units.
pub(crate) fn value<Q: Quantity>(quantity: Q) -> f64 {
    quantity.number().to_f64()
}
