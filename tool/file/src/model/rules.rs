//! A rule set: the rules that are checked, with their limits and sources.
//!
//! The built-in sets are files of `tool/file/rules`; `docs/sizing-rules.md` lists them with their sources.

use serde::Serialize;

use crate::model::rule::{Rule, Sense};

mod change;
mod choice;
mod verdict;

pub use change::{Change, Changes, Contradiction, RuleSetting, shown};
pub use choice::{Choices, InertiaOf, MeanTorque, Moves};
pub use verdict::{Finding, RuleVerdict};

/// The limits of one rule, as shares of its rating. `None`: no such limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Limit {
    /// Beyond this the rule is violated.
    pub fail: Option<f64>,
    /// Beyond this a warning is given.
    pub warn: Option<f64>,
}

impl Limit {
    /// Whether the rule is checked.
    pub const fn is_set(&self) -> bool {
        self.fail.is_some() || self.warn.is_some()
    }
}

/// Limits of the sizing rules. All can be overridden in `[rules]` of the machine file, and all are printed.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleSet {
    /// Name of the chosen set.
    pub name: String,
    /// Short description of the set.
    pub title: String,
    /// Choices between values that a rule may check.
    pub choices: Choices,
    limits: [Limit; Rule::COUNT],
    off: [bool; Rule::COUNT],
    sources: [String; Rule::COUNT],
    /// Changes by the machine file, kept so that they can be applied to another set.
    own: Changes,
}

impl RuleSet {
    /// A set without limits.
    pub fn empty(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            choices: Choices::default(),
            limits: [Limit::default(); Rule::COUNT],
            off: [false; Rule::COUNT],
            sources: std::array::from_fn(|_| String::new()),
            own: Changes::default(),
        }
    }

    /// The limits of a rule.
    pub const fn limit(&self, rule: Rule) -> Limit {
        self.limits[rule as usize]
    }

    /// Sets the limits of a rule.
    pub const fn set(&mut self, rule: Rule, limit: Limit) {
        self.limits[rule as usize] = limit;
    }

    /// Whether the rule was switched off on purpose.
    pub const fn is_off(&self, rule: Rule) -> bool {
        self.off[rule as usize]
    }

    /// Whether reports show the rule: it has a limit, or was switched off on purpose.
    pub const fn shows(&self, rule: Rule) -> bool {
        self.is_off(rule) || self.limit(rule).is_set()
    }

    /// Source of the rule's limits.
    pub fn source(&self, rule: Rule) -> &str {
        &self.sources[rule as usize]
    }

    /// Verdict of a finding under a rule.
    pub fn verdict(&self, rule: Rule, finding: Finding) -> RuleVerdict {
        let limit = self.limit(rule);
        if !limit.is_set() {
            return RuleVerdict::Off;
        }
        if !finding.is_known() {
            return RuleVerdict::NotChecked;
        }
        let beyond = |share: Option<f64>| {
            share.is_some_and(|share| {
                let limit = share * finding.rating;
                match rule.sense() {
                    Sense::AtMost => finding.value > limit * (1.0 + ROUNDING),
                    Sense::AtLeast => finding.value < limit * (1.0 - ROUNDING),
                }
            })
        };
        if beyond(limit.fail) {
            RuleVerdict::Fail
        } else if beyond(limit.warn) {
            RuleVerdict::Warn
        } else {
            RuleVerdict::Pass
        }
    }

    /// Use of the limit by a finding; zero if there is no limit, or if a yes-or-no rule is satisfied; infinite if the limit is zero and the value is
    /// not.
    #[inline]
    pub fn use_of_limit(&self, rule: Rule, finding: Finding) -> f64 {
        use_of(self.limit(rule).fail, rule, finding)
    }

    /// Use of the displayed limit: the warning limit if there is no other.
    pub fn use_shown(&self, rule: Rule, finding: Finding) -> f64 {
        let limit = self.limit(rule);
        use_of(limit.fail.or(limit.warn), rule, finding)
    }
}

/// Share of a limit that is the error of a duty: a mean speed of 1500 rpm satisfies a limit of 1500 rpm, whatever its last digits.
const ROUNDING: f64 = 1e-9;

#[inline]
fn use_of(share: Option<f64>, rule: Rule, finding: Finding) -> f64 {
    let Some(share) = share.filter(|_| finding.is_known()) else {
        return 0.0;
    };
    let limit = share * finding.rating;
    let (top, bottom) = match rule.sense() {
        Sense::AtMost => (finding.value, limit),
        Sense::AtLeast => (limit, finding.value),
    };
    if rule.is_yes_or_no() && top <= bottom * (1.0 + ROUNDING) {
        0.0
    } else if bottom > 0.0 {
        top / bottom
    } else if top > 0.0 {
        f64::INFINITY
    } else {
        0.0
    }
}
