//! Checks many drives against one cycle, each only as far as necessary.
//!
//! Every drive needs a verdict, but only the few that rank first need the exact use of their limits. The rules that decide the verdict of a drive
//! also bound its rank. The rules of a gearbox do not depend on the motor and are judged once for all drives with it. The peak torque is mostly
//! decided by [bounds](crate::cycle::Cycle::peak_against), without a search for the peak.
//!
//! The verdicts are those of [`Context::outcome`], and so is the order of the first drives (`tests/cycle/screen.rs`).

use super::outcome::Tally;
use super::{
    Context, Outcome, Record as _, brake, electric, elements, gearbox, motor, site, stiffness,
    thermal, voltage,
};
use crate::catalogue::{Drive, DriveId, Gearbox, Motor, Resistor};
use crate::cycle::{Cycle, PeakCheck};
use crate::motor::envelope::MotorLimits;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Finding, RuleSet};
use jred_file::model::site::Site;

/// Data common to all drives.
#[derive(Clone, Debug)]
pub(crate) struct Screen<'c> {
    cycle: &'c Cycle,
    site: &'c Site,
    rules: &'c RuleSet,
    /// Brake resistors to choose from.
    resistors: &'c [Resistor],
    /// Outcome of the gearbox rules for each gearbox.
    alone: Vec<Outcome>,
    direct: Outcome,
}

impl<'c> Screen<'c> {
    /// Judges each gearbox by itself. `motors`: the motors for them, with their limits.
    pub(crate) fn new(
        cycle: &'c Cycle,
        site: &'c Site,
        rules: &'c RuleSet,
        gearboxes: &'c [Gearbox],
        any: Option<(&'c Motor, &'c MotorLimits)>,
    ) -> Self {
        let alone = |gearbox: Option<&'c Gearbox>| {
            let Some((motor, limits)) = any else {
                return Outcome::NOTHING;
            };
            let drive = Drive {
                motor,
                gearbox,
                amplifier: None,
            };
            by_itself(&Context::new(cycle, site, drive, limits), rules)
        };
        Self {
            cycle,
            site,
            rules,
            resistors: &[],
            alone: gearboxes.iter().map(|g| alone(Some(g))).collect(),
            direct: alone(None),
        }
    }

    /// The same with brake resistors to choose from.
    pub(crate) fn with_resistors(self, resistors: &'c [Resistor]) -> Self {
        Self { resistors, ..self }
    }

    /// Whether a drive fits, with its outcome as far as that needed. The verdict is exact. If the drive fits, the warnings and the rules without data
    /// are exact too. Shares of limits and the number of violated limits of zero are at most those of [`Context::outcome`].
    pub(crate) fn judge(&self, id: DriveId, drive: Drive<'c>, limits: &'c MotorLimits) -> Outcome {
        let alone = match id.gearbox() {
            Some(index) => self.alone[index],
            None => self.direct,
        };
        let mut tally = Tally::new(self.rules, alone);
        let motor = limits.on(drive.amplifier);
        voltage::measure(motor, &mut tally);
        motor::measure_speed(self.cycle, motor, drive.ratio(), &mut tally);
        if tally.outcome.fails() {
            return tally.outcome;
        }
        let context = Context::new(self.cycle, self.site, drive, limits);
        let context = context.with_resistors(self.resistors);
        site::measure(&context, &mut tally);
        motor::measure_inertia(&context, self.rules, &mut tally);
        motor::measure_torques(&context, &mut tally);
        brake::measure(&context, &mut tally);
        gearbox::measure_stop(&context, &mut tally);
        if tally.outcome.fails() {
            return tally.outcome;
        }
        match self.peak(&context) {
            PeakCheck::Below => {}
            // Only a lower bound of the use of the envelope is known.
            PeakCheck::Beyond { used } => tally.set(Rule::PeakTorque, Finding::new(used, 1.0)),
            PeakCheck::Open => motor::measure_peak(&context, &mut tally),
        }
        if tally.outcome.fails() {
            return tally.outcome;
        }
        let current = electric::measure(&context, &mut tally);
        if tally.outcome.fails() {
            return tally.outcome;
        }
        thermal::follow(&context, &mut tally);
        electric::follow(&context, current, &mut tally);
        tally.outcome
    }

    /// The peak torque relative to the lower of its limits (failure, warning), as far as bounds can decide.
    fn peak(&self, context: &Context) -> PeakCheck {
        let limit = self.rules.limit(Rule::PeakTorque);
        let [low, high] = match (limit.warn, limit.fail) {
            (None, None) => return PeakCheck::Below,
            (Some(share), None) => [share, f64::INFINITY],
            (None, Some(share)) => [share; 2],
            (Some(warn), Some(fail)) => [warn.min(fail), fail],
        };
        let envelope = &context.motor.envelope;
        (context.cycle).peak_against(&context.coefficients, context.ratio, envelope, [low, high])
    }
}

/// Outcome of the rules that do not depend on the motor.
fn by_itself(context: &Context, rules: &RuleSet) -> Outcome {
    let mut tally = Tally::new(rules, Outcome::NOTHING);
    gearbox::measure_alone(context, rules, &mut tally);
    stiffness::measure(context, &mut tally);
    elements::measure(context, &mut tally);
    tally.outcome
}
