//! Every drive by plain loops over the samples: for comparison of the figures, and of the time.

use std::collections::HashSet;
use std::hint::black_box;

use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_sizing::catalogue::Drive;
use jred_sizing::judge::{Context, Findings, Outcome};
use jred_sizing::select::size::{Group, Selection};

use crate::{Ready, brute};

/// Largest difference of a figure, as a share of its own size or, for a torque, of its terms at their largest.
const TOLERANCE: f64 = 1e-12;

/// The findings of a drive, those over the samples by plain loops.
fn plain_findings(ready: &Ready, index: usize, drive: Drive, findings: &mut Findings) {
    let motor = &ready.motors[index];
    let context = Context::new(&ready.cycle, &ready.site, drive, motor);
    let envelope = &motor.envelope;
    let mut replace = |rule: Rule, value: f64, rating: Option<f64>| {
        let Some(finding) = findings.get(rule) else {
            return;
        };
        let rating = rating.filter(|_| !finding.rating.is_nan());
        findings.set(rule, Finding::new(value, rating.unwrap_or(finding.rating)));
    };
    let rms = brute::rms_torque(&ready.cycle, &context.coefficients);
    replace(Rule::RmsTorque, rms, None);
    let peak = brute::peak(&ready.cycle, &context.coefficients, context.ratio, envelope);
    let limit = envelope.peak_torque(peak.torque, peak.speed);
    replace(Rule::PeakTorque, peak.torque.abs(), Some(limit));
    let top = brute::peak_output_torque(&ready.cycle);
    replace(Rule::GearboxPeak, top, None);
    let exponent = ready.rules.choices.gearbox_mean_exponent.exponent();
    let mean = brute::mean_output_torque(&ready.cycle, exponent);
    replace(Rule::GearboxCubicMean, mean, None);
}

/// Compares verdicts and figures of all drives; panics at the first that differs.
pub(crate) fn every_drive(ready: &Ready) {
    let mut largest = 0.0f64;
    let mut count = 0;
    for (id, drive) in ready.catalogue.drives() {
        let index = id.motor();
        let context = Context::new(&ready.cycle, &ready.site, drive, &ready.motors[index]);
        let findings = context.findings(&ready.rules);
        let mut plain = findings;
        plain_findings(ready, index, drive, &mut plain);
        let outcome = Outcome::of(&ready.rules, &findings);
        let expected = Outcome::of(&ready.rules, &plain);
        let name = drive.name();
        assert_eq!(outcome.verdict, expected.verdict, "{name}");
        assert_eq!(outcome.worst_rule, expected.worst_rule, "{name}");
        assert_eq!(outcome.warnings, expected.warnings, "{name}");
        assert_eq!(
            outcome.beyond_all_limits, expected.beyond_all_limits,
            "{name}"
        );
        for ((rule, found), (_, expected)) in findings.iter().zip(plain.iter()) {
            let off = match rule {
                // Two instants may come equally close with different torques: the share is what counts.
                Rule::PeakTorque if found.rating > 0.0 => {
                    found.value / found.rating - expected.value / expected.rating
                }
                _ => (found.value - expected.value) / expected.value.abs().max(f64::MIN_POSITIVE),
            };
            if off.is_finite() {
                largest = largest.max(off.abs());
                assert!(
                    off.abs() <= TOLERANCE,
                    "{name}, {rule:?}: {found:?} {expected:?}"
                );
            }
        }
        count += 1;
    }
    println!(
        "{count} drives compared with plain loops: the same verdicts, figures within {largest:.1e}"
    );
}

/// Compares what a selection says of all drives with judging each in full; panics at the first that differs.
pub(crate) fn selection(ready: &Ready, mut selection: Selection) {
    let fit: HashSet<String> = selection.fit.drives().map(|drive| drive.name()).collect();
    let mut count = 0;
    for (id, drive) in ready.catalogue.drives() {
        let index = id.motor();
        let context = Context::new(&ready.cycle, &ready.site, drive, &ready.motors[index]);
        let fails = context.outcome(&ready.rules).fails();
        let name = drive.name();
        assert_eq!(fit.contains(&name), !fails, "{name}");
        count += 1;
    }
    let known = |group: &Group| -> Vec<(String, Outcome)> {
        let rows = group.known().iter().map(|c| (c.drive.name(), c.outcome));
        rows.collect()
    };
    let first = [known(&selection.fit), known(&selection.refused)];
    assert_eq!(count, selection.fit.len() + selection.refused.len());
    selection.complete();
    let all = [known(&selection.fit), known(&selection.refused)];
    for (first, all) in first.iter().zip(&all) {
        assert_eq!(first[..], all[..first.len()]);
    }
    println!(
        "{count} drives screened: the verdicts and the first of both lists are those of judging every drive in full"
    );
}

/// All drives by plain loops: what depends on the samples in one loop for each, all else as ever.
pub(crate) fn plain(ready: &Ready) {
    let samples = ready.cycle.samples();
    for (id, drive) in ready.catalogue.drives() {
        let index = id.motor();
        let motor = &ready.motors[index];
        let context = Context::new(&ready.cycle, &ready.site, drive, motor);
        let (mut squares, mut used) = (0.0, 0.0f64);
        for sample in samples {
            let torque = context.coefficients.torque(&sample.loads());
            squares += sample.weight * torque * torque;
            used = used.max(
                motor
                    .envelope
                    .peak_used(torque, sample.speed() * context.ratio),
            );
        }
        black_box((squares, used));
    }
}
