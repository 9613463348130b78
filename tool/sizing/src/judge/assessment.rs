//! A drive checked against every rule.

use super::{Context, motor};
use crate::catalogue::{Drive, Resistor};
use crate::cycle::form::MotorDuty;
use crate::judge::check::Check;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{RuleSet, RuleVerdict};
use jred_file::units::Sentence;

/// An assumption about a drive.
#[derive(Clone, Copy, Debug)]
pub enum Assumption {
    /// The figures of this part, which are not from its maker's own document.
    OtherFigures(&'static str),
    /// That the amplifier runs the motor: no source pairs them.
    Pairing,
    /// The efficiency of the gearbox.
    GearboxEfficiency,
    /// A holding brake of at least this torque (N·m): the catalogue gives none of this motor.
    HoldingBrake(f64),
    /// A figure of the motor's limits.
    Limits(Sentence),
}

/// A drive with the verdict of every rule.
#[derive(Clone, Debug)]
pub struct Assessment<'c> {
    /// The drive.
    pub drive: Drive<'c>,
    /// The brake resistor chosen for it from the catalogue.
    pub resistor: Option<&'c Resistor>,
    /// Its duty.
    pub duty: MotorDuty,
    /// Every rule.
    pub checks: Vec<Check>,
    /// The least torque of a holding brake (N·m), if one is needed and the catalogue gives no brake of this motor.
    pub least_brake: Option<f64>,
    /// Assumptions about motor and gearbox, and second-hand data.
    pub assumptions: Vec<Assumption>,
}

impl<'c> Assessment<'c> {
    /// Checks a drive against every rule, for reports.
    pub fn new(context: &Context<'c>, rules: &RuleSet) -> Self {
        Self {
            drive: context.drive,
            resistor: context.resistor(),
            duty: context.cycle.motor_duty(&context.drive),
            checks: context.checks(rules),
            least_brake: motor::least_brake(context, rules),
            assumptions: context.assumptions(rules),
        }
    }

    /// The worst verdict.
    pub fn verdict(&self) -> RuleVerdict {
        let worst = self.checks.iter().map(|c| c.verdict).max();
        worst.unwrap_or(RuleVerdict::Pass)
    }

    /// Whether no rule is violated.
    pub fn holds(&self) -> bool {
        self.verdict() != RuleVerdict::Fail
    }

    /// Use of the limit of a rule as text; empty if the rule does not apply.
    pub fn used(&self, rule: Rule) -> String {
        let check = self.checks.iter().find(|c| c.id == rule);
        check.map_or(String::new(), Check::used)
    }

    /// Price of its parts with the chosen brake resistor, in the currency of the catalogue; `None` if one has no data.
    pub fn price(&self) -> Option<f64> {
        price(&self.drive, self.resistor)
    }

    /// Installed power (W); `None` if not given.
    pub fn rated_power(&self) -> Option<f64> {
        self.drive.motor.rated_power()
    }
}

/// Price of motor, gearbox, amplifier and the chosen brake resistor; `None` if one has no data.
pub(crate) fn price(drive: &Drive, resistor: Option<&Resistor>) -> Option<f64> {
    Some(drive.price()? + resistor.map_or(Some(0.0), |resistor| resistor.price)?)
}
