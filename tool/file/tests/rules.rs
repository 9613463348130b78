//! The rule sets, and what a machine file says about rules, stiffness and the tool.
// Copied figures are exact.
#![allow(clippy::float_cmp)]

mod chosen;
mod sets;

use crate::reading::refuses;
use crate::support::{phrases, press_text, rows};
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Finding, RuleSet, RuleVerdict};

/// A mean speed that is 1500 rpm by hand, and rounded up, is at a limit of 1500 rpm; what is more by a millionth is beyond it.
#[test]
fn a_figure_at_its_limit_satisfies_the_rule() {
    let rules = RuleSet::default();
    let share = |rule| rules.limit(rule).fail.or(rules.limit(rule).warn).unwrap();
    for (rule, beyond) in [
        (Rule::GearboxMeanSpeed, 1e-6),
        (Rule::NaturalFrequency, -1e-6),
    ] {
        let rating = 1_500.000_000_000_000_2;
        let limit = share(rule) * rating;
        let verdict = |value: f64| rules.verdict(rule, Finding::new(value, rating));
        assert_eq!(verdict(limit), RuleVerdict::Pass);
        assert_eq!(verdict(limit * (1.0 + beyond * 1e-8)), RuleVerdict::Pass);
        assert!(verdict(limit * (1.0 + beyond)) > RuleVerdict::Pass);
    }
}

#[test]
fn a_wrong_tool_is_refused() {
    let cases = r#"
        [tool]\nplay = "0.1 mm" => neither `point` nor `link`
        [tool]\npoint = "slidr"\nplay = "0.1 mm" => slidr | slider
        [tool]\npoint = "slider" => `play` | missing
        [tool]\npoint = "slider"\nplay = "0.1 deg" => `play` | a length
        [tool]\npoint = "slider"\nplay = "0 mm" => `play` | greater than zero
        [tool]\nlink = "slider"\nplay = "0.1 deg" => does not turn
        [tool]\npoint = "crank"\nplay = "0.1 mm" => does not move
        [tool]\npoint = "slider"\nlink = "rod"\nplay = "0.1 mm" => has both `point` and `link`
    "#;
    for [section, words] in rows(cases) {
        refuses(&format!("{}\n{section}\n", press_text()), &phrases(&words));
    }
}

#[test]
fn a_wrong_stiffness_is_refused() {
    let cases = r#"
        [stiffness] => neither `shaft` nor `backlash`
        [stiffness]\nshaft = "0 N m/rad" => `shaft` | greater than zero
        [stiffness]\nshaft = "12 kN" => `shaft` | torsional stiffness
        [stiffness]\nbacklash = "-1 deg" => `backlash` | negative
        [stiffness]\nshaft = "12 kN m/rad"\nat = "crank" => `at` | drive-link
        [stiffness]\nshafts = "12 kN m/rad" => shafts
    "#;
    for [section, words] in rows(cases) {
        refuses(&format!("{}\n{section}\n", press_text()), &phrases(&words));
    }
}
