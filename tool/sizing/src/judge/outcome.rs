//! Result of a drive in numbers.

use super::{Findings, Record, RuleBits};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::rules::RuleSet;
use jred_file::model::rules::RuleVerdict;

/// Result of a drive in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The worst verdict.
    pub verdict: RuleVerdict,
    /// The largest finite share of a limit that is used. Where a limit is zero (no torque beyond the maximum speed), the rule for the speed gives the
    /// excess.
    pub worst_use: f64,
    /// The rule with this share; of several, the first in the order of reports.
    pub worst_rule: Option<Rule>,
    /// Number of rules with a warning.
    pub warnings: u8,
    /// The rules that could not be checked because data are missing.
    pub not_checked: RuleBits,
    /// Whether the voltage that the motor or the amplifier is made for is not given.
    pub voltage_unknown: bool,
    /// Number of violated rules without a share of the limit: the limit is zero, or a part is not made for the supply.
    pub beyond_all_limits: u8,
    /// The violated rules, as far as they were judged.
    pub violated: RuleBits,
}

impl Outcome {
    /// Outcome without findings.
    pub const NOTHING: Self = Self {
        verdict: RuleVerdict::Pass,
        worst_use: 0.0,
        worst_rule: None,
        warnings: 0,
        not_checked: RuleBits::NONE,
        voltage_unknown: false,
        beyond_all_limits: 0,
        violated: RuleBits::NONE,
    };

    /// Outcome of these findings under a rule set.
    pub fn of(rules: &RuleSet, findings: &Findings) -> Self {
        let mut tally = Tally::new(rules, Self::NOTHING);
        for (rule, finding) in findings.iter() {
            tally.set(rule, finding);
        }
        tally.outcome
    }

    /// Whether a rule is violated.
    pub const fn fails(&self) -> bool {
        matches!(self.verdict, RuleVerdict::Fail)
    }

    fn uses(&mut self, rule: Rule, used: f64) {
        let first = |other: Rule| used >= self.worst_use && rule < other;
        if used > self.worst_use || self.worst_rule.is_some_and(first) {
            self.worst_use = used;
            self.worst_rule = Some(rule);
        }
    }
}

/// Evaluates findings one by one, in any order, and adds them to an outcome.
pub(super) struct Tally<'r> {
    rules: &'r RuleSet,
    pub(super) outcome: Outcome,
}

impl<'r> Tally<'r> {
    /// Continues from an outcome.
    pub(super) const fn new(rules: &'r RuleSet, outcome: Outcome) -> Self {
        Self { rules, outcome }
    }
}

impl Record for Tally<'_> {
    #[inline]
    fn set(&mut self, rule: Rule, finding: Finding) {
        let outcome = &mut self.outcome;
        let verdict = self.rules.verdict(rule, finding);
        if verdict == RuleVerdict::Off {
            return;
        }
        outcome.verdict = outcome.verdict.max(verdict);
        outcome.warnings += u8::from(verdict == RuleVerdict::Warn);
        if verdict == RuleVerdict::NotChecked {
            outcome.not_checked.add(rule);
            outcome.voltage_unknown |= rule.is_of_voltage() && finding.rating.is_nan();
        }
        let fails = verdict == RuleVerdict::Fail;
        if fails {
            outcome.violated.add(rule);
        }
        let mut used = self.rules.use_of_limit(rule, finding);
        // A violation that a brake resistor cures ranks before one that needs another motor or gearbox.
        if fails && rule == Rule::BusVoltage {
            used = 1.0;
        }
        // No change of machine or motion makes a part fit for a supply that it is not made for.
        let by_parts = rule.is_of_voltage() || rule == Rule::BrakeResistance;
        if used.is_infinite() || fails && by_parts {
            outcome.beyond_all_limits += 1;
        } else {
            outcome.uses(rule, used);
        }
    }
}
