//! Rule sets as data: what comes with the tool, what a machine file changes, what is refused.

use std::collections::BTreeSet;
use std::path::Path;

use jred_file::model::rule::{Rule, Sense};
use jred_file::model::rules::Finding;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::rules::{Limit, RuleSet};
use jred_file::read as machine_file;

use crate::reading::read;
use crate::support::{near, press_text};

pub(super) fn with_rules(rules: &str) -> String {
    format!("{}\n[rules]\n{rules}\n", press_text())
}

pub(super) fn set(name: &str) -> RuleSet {
    machine_file::rule_set(name, Path::new(""))
        .unwrap_or_else(|report| panic!("{name}: {report:?}"))
}

/// Every file of the folder is a set, every set reads, and says where each limit comes from.
#[test]
fn every_set_reads() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("rules");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            entry
                .unwrap()
                .path()
                .file_stem()
                .unwrap()
                .to_str()
                .unwrap()
                .to_owned()
        })
        .collect();
    let names: BTreeSet<String> = machine_file::rule_set_names().map(str::to_owned).collect();
    assert_eq!(names, files);
    for name in &names {
        let set = set(name);
        assert_eq!(&set.name, name);
        assert!(!set.title.is_empty());
        for rule in Rule::ALL.into_iter().filter(|rule| set.shows(*rule)) {
            assert!(set.source(rule).len() > 3, "{name}: {}", rule.key());
        }
    }
    assert_eq!(RuleSet::default(), set("general"));
    // Every rule but that of one maker is judged by the general set.
    for rule in Rule::ALL {
        assert_eq!(
            RuleSet::default().shows(rule),
            rule != Rule::ConstantTorque,
            "{}",
            rule.key()
        );
    }
    let keys: BTreeSet<&str> = Rule::ALL
        .iter()
        .flat_map(|rule| [rule.key(), rule.warning_key()])
        .collect();
    assert_eq!(keys.len(), 2 * Rule::COUNT);
}

/// The published figures.
#[test]
fn the_figures_of_the_sets() {
    let limits = |name: &str, rule: Rule| {
        let Limit { fail, warn } = set(name).limit(rule);
        (fail, warn)
    };
    for (name, rule, fail, warn) in [
        ("general", Rule::RmsTorque, Some(0.8), None),
        ("general", Rule::PeakTorque, Some(0.8), None),
        ("general", Rule::Speed, Some(0.9), None),
        ("general", Rule::HoldingTorque, Some(0.6), None),
        ("general", Rule::InertiaRatio, Some(10.0), Some(5.0)),
        ("general", Rule::GearboxCycles, None, Some(1.0)),
        ("general", Rule::NaturalFrequency, None, Some(10.0)),
        ("fanuc", Rule::ConstantTorque, Some(0.7), None),
        ("fanuc", Rule::HoldingTorque, Some(0.6), None),
        ("fanuc", Rule::InertiaRatio, Some(5.0), Some(3.0)),
        ("fanuc", Rule::RmsTorque, Some(0.8), None),
        ("fanuc-contouring", Rule::InertiaRatio, Some(3.0), Some(1.0)),
        ("fanuc-contouring", Rule::ConstantTorque, Some(0.7), None),
        ("parker", Rule::InertiaRatio, Some(10.0), None),
        (
            "precision-gearhead",
            Rule::PeakTorque,
            Some(1.0 / 1.3),
            None,
        ),
        ("safety-factor-1.5", Rule::RmsTorque, Some(1.0 / 1.5), None),
        ("safety-factor-2", Rule::PeakTorque, Some(0.5), None),
        ("beckhoff-ax8000", Rule::Overload, Some(1.0), Some(0.8)),
    ] {
        let (found, warned) = limits(name, rule);
        for (found, expected) in [(found, fail), (warned, warn)] {
            assert_eq!(
                found.is_some(),
                expected.is_some(),
                "{name}: {}",
                rule.key()
            );
            if let (Some(found), Some(expected)) = (found, expected) {
                near(rule.key(), found, expected, 1e-12);
            }
        }
    }
}

/// Every key of every rule: limit, warning, both at once, off.
#[test]
fn every_key_can_be_set() {
    for rule in Rule::ALL {
        let (key, warning) = (rule.key(), rule.warning_key());
        let [limit, warn] = match rule.sense() {
            Sense::AtMost => [0.5, 0.25],
            Sense::AtLeast => [0.5, 0.75],
        };
        let expected = Limit {
            fail: Some(limit),
            warn: Some(warn),
        };
        for text in [
            format!("{key} = {limit}\n{warning} = {warn}"),
            format!("{key} = {{ limit = {limit}, warning = {warn}, source = \"we say so\" }}"),
        ] {
            let rules = read(&with_rules(&text)).rules;
            assert_eq!(rules.limit(rule), expected, "{key}");
            assert!(!rules.is_off(rule));
            let said = if text.contains("we say so") {
                "we say so"
            } else {
                "[rules] of the machine file"
            };
            assert_eq!(rules.source(rule), said);
        }
        let rules = read(&with_rules(&format!("{key} = \"off\""))).rules;
        assert!(rules.is_off(rule) && rules.shows(rule));
        for finding in [
            Finding::new(1e9, 1.0),
            Finding::new(-1.0, 1.0),
            Finding::UNKNOWN,
        ] {
            assert_eq!(rules.verdict(rule, finding), RuleVerdict::Off, "{key}");
            assert_eq!(rules.use_of_limit(rule, finding), 0.0);
        }
    }
}

/// Limits are held at the limit, and violated just beyond; nothing known is never passed.
#[test]
fn verdicts_turn_at_the_limit() {
    let rules = RuleSet::default();
    let lambda = |value: f64| rules.verdict(Rule::InertiaRatio, Finding::new(value, 1.0));
    assert_eq!(
        [5.0, 5.000_001, 10.0, 10.000_001].map(lambda),
        [
            RuleVerdict::Pass,
            RuleVerdict::Warn,
            RuleVerdict::Warn,
            RuleVerdict::Fail
        ]
    );
    let frequency = |value: f64| rules.verdict(Rule::NaturalFrequency, Finding::new(value, 2.0));
    assert_eq!(
        [19.999, 20.0].map(frequency),
        [RuleVerdict::Warn, RuleVerdict::Pass]
    );
    for finding in [
        Finding::UNKNOWN,
        Finding::new(1.0, f64::NAN),
        Finding::new(f64::NAN, 1.0),
    ] {
        assert_eq!(
            rules.verdict(Rule::RmsTorque, finding),
            RuleVerdict::NotChecked
        );
    }
    // A warning alone is no limit of which a share could be used.
    assert_eq!(
        rules.use_of_limit(Rule::GearboxCycles, Finding::new(5000.0, 1000.0)),
        0.0
    );
    assert_eq!(
        rules.use_shown(Rule::GearboxCycles, Finding::new(5000.0, 1000.0)),
        5.0
    );
    assert_eq!(
        rules.use_of_limit(Rule::PeakTorque, Finding::new(1.0, 0.0)),
        f64::INFINITY
    );
}
