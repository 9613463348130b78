//! A cycle prepared once against plain loops over its samples: every figure, for random cycles, drives and envelopes.

mod between;
mod catalogue;
mod drive;
pub(crate) mod random;
mod screen;

use crate::brute;
use crate::support::budget;
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use random::{coefficients, duty, envelope};

/// A runner whose cases are the same on every run.
fn runner(cases: u32) -> TestRunner {
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]))
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, scale: f64) {
    assert!(
        (found - expected).abs() <= budget::PREPARED_CYCLE * scale,
        "{what}: {found:e} instead of {expected:e}, scale {scale:e}, off by {:e} of it",
        (found - expected).abs() / scale
    );
}

/// Linear and quadratic figures of the torque, and those of the power.
#[test]
fn figures_are_those_of_the_samples() {
    let every = (duty(), coefficients(), 0.2..300.0);
    let check = |(duty, c, ratio): (_, Coefficients, f64)| {
        let cycle = Cycle::new(&duty);
        let scale = brute::scale(&cycle, &c);
        near(
            "RMS",
            cycle.rms_torque(&c),
            brute::rms_torque(&cycle, &c),
            scale,
        );
        near(
            "mean",
            cycle.mean_torque(&c),
            brute::mean_torque(&cycle, &c),
            scale,
        );
        let found = cycle.torque_extremes(&c);
        for (found, expected) in found.into_iter().zip(brute::extremes(&cycle, &c)) {
            near("extreme", found, expected, scale);
        }
        near(
            "peak",
            cycle.peak_torque(&c),
            found[1].max(-found[0]),
            scale,
        );
        let power = scale * cycle.peak_speed() * ratio;
        let energies = cycle.energies(&c, ratio);
        let expected = brute::energies(&cycle, &c, ratio);
        for (found, expected) in energies.into_iter().zip(expected) {
            near("energy", found, expected, power * cycle.duration());
            assert!(found >= 0.0);
        }
        Ok(())
    };
    runner(4000).run(&every, check).unwrap();
}

/// The peak against envelopes of every kind. Bounds must be valid for every sample of a stretch, otherwise the largest is missed.
#[test]
#[ignore = "more than five seconds of a processor"]
fn the_peak_is_that_of_the_samples() {
    let every = (duty(), coefficients(), 0.2..300.0, envelope());
    let check = |(duty, c, ratio, envelope): (_, Coefficients, f64, _)| {
        let cycle = Cycle::new(&duty);
        // Ratios that stay within the envelope's speed, reach its end or exceed it.
        let ratio =
            ratio / 100.0 * f64::min(envelope_end(&envelope), 1e4) / cycle.peak_speed().max(1e-3);
        let found = cycle.peak(&c, ratio, &envelope);
        let expected = brute::peak(&cycle, &c, ratio, &envelope);
        if expected.used.is_infinite() {
            assert_eq!(found, expected);
            return Ok(());
        }
        let limit = envelope.peak_torque(found.torque, found.speed);
        let scale = if limit.is_finite() {
            brute::scale(&cycle, &c) / limit
        } else {
            1.0
        };
        near("share", found.used, expected.used, scale);
        let own = envelope.peak_used(found.torque, found.speed);
        assert!(found.used.total_cmp(&own).is_eq());
        Ok(())
    };
    runner(12_000).run(&every, check).unwrap();
}

fn envelope_end(envelope: &jred_sizing::motor::envelope::Envelope) -> f64 {
    envelope.limit(false).end()
}
