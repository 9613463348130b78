//! Whole catalogues: the same verdicts as by plain loops, in an order independent of threads.

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::site::Site;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::{Context, Outcome};
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::select::size::{Candidate, FIRST, Group, Selection};

use crate::brute;
use crate::support::{budget, press_text};

struct Ready {
    catalogue: Catalogue,
    motors: Vec<MotorLimits>,
    cycle: Cycle,
    site: Site,
    rules: RuleSet,
}

/// Some of the built-in motors and gearboxes of all makers, the gearboxes with six times as many ratios.
pub(crate) fn with_more_ratios() -> Catalogue {
    let mut catalogue = Catalogue::load(None, None).unwrap();
    let motors = catalogue.motors.iter().map(|motor| motor.key.clone());
    let gearboxes = catalogue
        .gearboxes
        .iter()
        .map(|gearbox| gearbox.key.clone());
    let [motors, gearboxes]: [Vec<String>; 2] =
        [motors.step_by(4).collect(), gearboxes.step_by(4).collect()];
    catalogue.keep(
        |motor| motors.contains(&motor.key),
        |gearbox| gearboxes.contains(&gearbox.key),
    );
    let gearboxes = catalogue.gearboxes.clone();
    for factor in [0.5, 0.7, 1.3, 1.7, 2.3] {
        catalogue.gearboxes.extend(gearboxes.iter().map(|gearbox| {
            let mut other = gearbox.clone();
            other.key = format!("{}-{factor}", gearbox.key);
            other.ratio *= factor;
            other
        }));
    }
    catalogue
}

/// The press and the built-in catalogue with many more ratios: enough suitable and unsuitable drives.
fn ready() -> Ready {
    let file = checked::parse("press.toml", &press_text(), Path::new("")).unwrap();
    let duty = brute::sampled(Duty::new(&file, file.motion.as_ref().unwrap(), 400).unwrap());
    let catalogue = with_more_ratios();
    let site = Site::default();
    Ready {
        motors: catalogue.prepare(&site),
        catalogue,
        cycle: Cycle::new(&duty),
        site,
        rules: RuleSet::default(),
    }
}

impl Ready {
    fn selection(&self) -> Selection<'_> {
        Selection::new(
            &self.catalogue,
            &self.motors,
            &self.cycle,
            &self.site,
            &self.rules,
        )
    }

    /// The outcome of a drive with the figures over the samples by plain loops.
    fn plain_outcome(&self, candidate: &Candidate) -> Outcome {
        let context = Context::new(&self.cycle, &self.site, candidate.drive, candidate.motor);
        let mut findings = context.findings(&self.rules);
        let envelope = &context.motor.envelope;
        let peak = brute::peak(&self.cycle, &context.coefficients, context.ratio, envelope);
        let limit = envelope.peak_torque(peak.torque, peak.speed);
        let mut replace = |rule: Rule, value: f64, rating: Option<f64>| {
            if let Some(found) = findings.get(rule) {
                let rating = rating.filter(|rating| rating.is_finite());
                findings.set(rule, Finding::new(value, rating.unwrap_or(found.rating)));
            }
        };
        replace(Rule::PeakTorque, peak.torque.abs(), Some(limit));
        replace(
            Rule::RmsTorque,
            brute::rms_torque(&self.cycle, &context.coefficients),
            None,
        );
        replace(
            Rule::GearboxPeak,
            brute::peak_output_torque(&self.cycle),
            None,
        );
        let exponent = self.rules.choices.gearbox_mean_exponent.exponent();
        replace(
            Rule::GearboxCubicMean,
            brute::mean_output_torque(&self.cycle, exponent),
            None,
        );
        let mut outcome = Outcome::of(&self.rules, &findings);
        if outcome.verdict == RuleVerdict::Fail {
            // Rules over time are not judged for a refused drive.
            outcome.not_checked = candidate.outcome.not_checked;
        }
        outcome
    }
}

#[test]
fn every_verdict_is_that_of_plain_loops() {
    let ready = ready();
    let mut selection = ready.selection();
    selection.complete();
    let [fit, refused] = [&selection.fit, &selection.refused].map(Group::known);
    assert!(fit.len() > 10 && refused.len() > FIRST);
    for candidate in fit.iter().chain(refused) {
        let expected = ready.plain_outcome(candidate);
        let found = candidate.outcome;
        let name = candidate.drive.name();
        assert_eq!(found.verdict, expected.verdict, "{name}");
        let less = found.worst_use < expected.worst_use
            || found.beyond_all_limits < expected.beyond_all_limits;
        if found.verdict == RuleVerdict::Fail && less {
            // Rules over time were not evaluated.
            continue;
        }
        assert_eq!(found.worst_rule, expected.worst_rule, "{name}");
        assert_eq!(
            found.beyond_all_limits, expected.beyond_all_limits,
            "{name}"
        );
        let off = (found.worst_use / expected.worst_use - 1.0).abs();
        assert!(off <= budget::PREPARED_CYCLE, "{name}: off by {off:e}");
    }
}
