//! A drive judged by every rule, in words.

use super::Context;
use crate::catalogue::Drive;
use crate::cycle::form::MotorDuty;
use crate::judge::check::Check;
use jred_machine::model::rule::Rule;
use jred_machine::model::rules::{RuleSet, Verdict};

/// A drive judged.
#[derive(Clone, Debug)]
pub struct Judged<'c> {
    /// The drive.
    pub drive: Drive<'c>,
    /// Its duty.
    pub duty: MotorDuty,
    /// Every rule.
    pub checks: Vec<Check>,
    /// What was assumed about motor and gearbox, and whose figures are second-hand.
    pub assumptions: Vec<String>,
}

impl<'c> Judged<'c> {
    /// Judges a drive by every rule, in words.
    pub fn new(context: &Context<'c>, rules: &RuleSet) -> Self {
        Self {
            drive: context.drive,
            duty: context.cycle.motor_duty(&context.drive),
            checks: context.checks(rules),
            assumptions: context.assumptions(),
        }
    }

    /// The worst verdict.
    pub fn verdict(&self) -> Verdict {
        let worst = self.checks.iter().map(|c| c.verdict).max();
        worst.unwrap_or(Verdict::Pass)
    }

    /// Whether no rule is violated.
    pub fn holds(&self) -> bool {
        self.verdict() != Verdict::Fail
    }

    /// The rules that are broken, in one sentence each.
    pub fn reasons(&self) -> String {
        let broken = self.checks.iter().filter(|c| c.verdict == Verdict::Fail);
        broken.map(Check::sentence).collect::<Vec<_>>().join("; ")
    }

    /// How much of a rule's limit is used, in words; nothing if the rule was not applied.
    pub fn used(&self, rule: Rule) -> String {
        let check = self.checks.iter().find(|c| c.id == rule);
        check.map_or(String::new(), Check::used)
    }

    /// Installed power (W); nothing where the catalogue does not say.
    pub fn rated_power(&self) -> Option<f64> {
        self.drive.motor.rated_power()
    }
}
