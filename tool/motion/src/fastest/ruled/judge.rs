//! Judges motions by the rules of `jred size`.

use jred_analysis::duty::{Duty, DutyError, Sampling};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_sizing::catalogue::{Drive, Resistor};
use jred_sizing::judge::Context;
use jred_sizing::judge::Findings;
use jred_sizing::judge::check::Check;
use jred_sizing::motor::envelope::MotorLimits;

use super::Cap;
use crate::trace::Trace;

/// Share of a limit that a motion may use. A reserve leaves a millionth less than all of it, and a profile that is read back has other last digits.
const USABLE_SHARE: f64 = 1.0 - 5e-7;

/// Judges motions of a drive by the rules of `jred size`.
#[derive(Clone, Debug)]
pub struct Judge<'a> {
    file: &'a MachineFile,
    drive: Drive<'a>,
    prepared: MotorLimits,
    resistors: &'a [Resistor],
    sampling: Sampling,
}

impl<'a> Judge<'a> {
    /// A judge for a drive in a machine, with the sampling of its duty.
    pub fn new(file: &'a MachineFile, drive: Drive<'a>, sampling: Sampling) -> Self {
        Self {
            file,
            drive,
            prepared: MotorLimits::new(drive.motor, drive.amplifier, &file.site),
            resistors: &[],
            sampling,
        }
    }

    /// With brake resistors to choose from, as `jred size` has them.
    #[must_use]
    pub const fn with_resistors(mut self, resistors: &'a [Resistor]) -> Self {
        self.resistors = resistors;
        self
    }

    fn with<T>(&self, trace: &Trace, of: impl FnOnce(&Context) -> T) -> Result<T, DutyError> {
        // Like a profile that is read back.
        let cyclic = self.file.motion.as_ref().is_none_or(|own| own.cyclic);
        let motion = Motion::nodes(trace.nodes(), cyclic);
        let file = MachineFile {
            motion: Some(motion.clone()),
            ..self.file.clone()
        };
        let duty = Duty::new(&file, &motion, self.sampling)?;
        let cycle = jred_sizing::cycle::Cycle::new(&duty);
        let context = Context::new(&cycle, &file.site, self.drive, &self.prepared);
        Ok(of(&context.with_resistors(self.resistors)))
    }

    /// The findings of all rules in a motion.
    ///
    /// # Errors
    /// The duty cannot be computed.
    pub fn findings(&self, trace: &Trace) -> Result<Findings, DutyError> {
        self.with(trace, |context| context.findings(&self.file.rules))
    }

    /// The checks of the file's rules, with messages.
    ///
    /// # Errors
    /// The duty cannot be computed.
    pub fn checks(&self, trace: &Trace) -> Result<Vec<Check>, DutyError> {
        self.with(trace, |context| context.checks(&self.file.rules))
    }

    /// The largest use of a limit that a cap can lower.
    pub(super) fn used(&self, findings: &Findings, cap: Cap, heat: bool) -> f64 {
        let own = findings
            .iter()
            .filter(|(rule, _)| Cap::of(*rule, heat) == Some(cap));
        let used = own.map(|(rule, finding)| self.file.rules.use_of_limit(rule, finding));
        used.fold(0.0, f64::max) / USABLE_SHARE
    }
}

/// The judgement of a motion, and the lowered caps.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// All rules.
    pub checks: Vec<Check>,
    /// The rules that the search tries to satisfy.
    pub sought: Vec<Rule>,
    /// The values that were lowered at every instant.
    pub caps: Vec<(Cap, f64)>,
}

impl Judgement {
    /// Rules of the search that are satisfied.
    pub fn kept(&self) -> impl Iterator<Item = &Check> {
        let sought = |check: &&Check| self.sought.contains(&check.id);
        let held = |check: &&Check| check.verdict == RuleVerdict::Pass;
        self.checks.iter().filter(sought).filter(held)
    }

    /// Violated rules, each a reason for `jred size` to refuse the motion.
    pub fn violated(&self) -> impl Iterator<Item = &Check> {
        let all = self.checks.iter();
        all.filter(|check| check.verdict == RuleVerdict::Fail)
    }
}
