//! Checking a drive: value and rating of every rule as plain numbers. What they rest on is added later, for the drives that are shown.
//!
//! Each family of rules is a file of [`judge`](self): it measures ([`Findings::set`]) and says what a check rests on ([`Grounds`]). A rule that does
//! not apply to a drive, such as a gearbox rule to a direct drive, is omitted from the findings. A rule that applies but lacks data of the catalogue
//! or of the machine file is set with [`Finding::UNKNOWN`]. The sentences are made in the package of reports.

use crate::catalogue::{Drive, Resistor};
use crate::cycle::Cycle;
use crate::cycle::form::Coefficients;
use crate::judge::check::Check;
use crate::motor::envelope::MotorLimits;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{Finding, RuleSet, RuleVerdict};
use jred_file::model::site::Site;
use jred_file::units::Vocabulary;

mod assessment;
pub mod bill;
mod bits;
mod brake;
pub mod check;
mod cure;
mod electric;
mod elements;
mod gearbox;
mod grounds;
mod motor;
mod outcome;
pub mod overload;
mod screen;
mod site;
mod stiffness;
mod thermal;
mod voltage;

pub(crate) use assessment::price;
pub use assessment::{Assessment, Assumption};
pub use bits::RuleBits;
pub use cure::cure;
pub(crate) use elements::OF_ELEMENTS;
pub use grounds::{Grounds, SupplySource};
pub use outcome::Outcome;
pub(crate) use screen::Screen;

/// The findings of all rules that apply to a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Findings {
    found: [Finding; Rule::COUNT],
    /// The rules that apply.
    apply: RuleBits,
}

impl Default for Findings {
    fn default() -> Self {
        Self {
            found: [Finding::new(0.0, 0.0); Rule::COUNT],
            apply: RuleBits::NONE,
        }
    }
}

/// Receiver of findings: [`Findings`] stores them, [`Outcome`] evaluates them immediately.
trait Record {
    /// Takes the finding of a rule, which makes the rule apply. Each rule is found once.
    fn set(&mut self, rule: Rule, finding: Finding);
}

impl Record for Findings {
    fn set(&mut self, rule: Rule, finding: Finding) {
        Self::set(self, rule, finding);
    }
}

impl Findings {
    /// Sets the finding of a rule, which makes the rule apply.
    pub const fn set(&mut self, rule: Rule, finding: Finding) {
        self.found[rule as usize] = finding;
        self.apply.add(rule);
    }

    /// The finding of a rule, if it applies.
    pub const fn get(&self, rule: Rule) -> Option<Finding> {
        if self.apply.has(rule) {
            Some(self.found[rule as usize])
        } else {
            None
        }
    }

    /// The rules that apply, with their findings, in the order of reports.
    pub fn iter(&self) -> impl Iterator<Item = (Rule, Finding)> {
        (self.apply.iter()).map(|rule| (rule, self.found[rule as usize]))
    }
}

/// All inputs for checking a drive.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// The duty, prepared.
    pub cycle: &'a Cycle,
    /// Site of the drive: supply, surroundings, stiffness, tool.
    pub site: &'a Site,
    /// The drive.
    pub drive: Drive<'a>,
    /// Limits of its motor at this supply.
    pub motor: &'a MotorLimits,
    /// Its ratio.
    pub ratio: f64,
    /// Its motor torque as a linear form.
    pub coefficients: Coefficients,
    /// Brake resistors to choose from, if the machine file gives no resistor.
    pub resistors: &'a [Resistor],
}

impl<'a> Context<'a> {
    /// The context of one drive.
    pub fn new(cycle: &'a Cycle, site: &'a Site, drive: Drive<'a>, motor: &'a MotorLimits) -> Self {
        Self {
            cycle,
            site,
            drive,
            motor: motor.on(drive.amplifier),
            ratio: drive.ratio(),
            coefficients: drive.coefficients(),
            resistors: &[],
        }
    }

    /// The same with brake resistors to choose from.
    #[must_use]
    pub const fn with_resistors(self, resistors: &'a [Resistor]) -> Self {
        Self { resistors, ..self }
    }

    /// The brake resistor chosen for the drive: the smallest one that fits, if the bus needs one and the machine file gives no resistor.
    pub fn resistor(&self) -> Option<&'a Resistor> {
        electric::chosen_resistor(self)
    }

    /// The same for another drive with the same motor and amplifier.
    pub(crate) fn with(&self, drive: Drive<'a>) -> Self {
        Self {
            drive,
            ratio: drive.ratio(),
            coefficients: drive.coefficients(),
            ..*self
        }
    }

    /// The same in another cycle.
    pub(crate) const fn in_cycle<'b>(&self, cycle: &'b Cycle) -> Context<'b>
    where
        'a: 'b,
    {
        Context { cycle, ..*self }
    }

    /// Names and units of its motor's figures.
    pub const fn vocabulary(&self) -> &'static Vocabulary {
        self.drive.motor.kind.vocabulary()
    }

    /// Assumptions about the drive, and second-hand data.
    pub fn assumptions(&self, rules: &RuleSet) -> Vec<Assumption> {
        let Drive {
            motor,
            gearbox,
            amplifier,
        } = self.drive;
        let parts = [
            ("motor", motor.from_maker),
            ("gearbox", gearbox.is_none_or(|g| g.from_maker)),
            ("amplifier", amplifier.is_none_or(|a| a.from_maker)),
        ];
        let from_others = parts.into_iter().filter(|(_, from_maker)| !from_maker);
        let mut assumptions: Vec<Assumption> = from_others
            .map(|(part, _)| Assumption::OtherFigures(part))
            .collect();
        if amplifier.is_some() && !self.drive.is_paired() {
            assumptions.push(Assumption::Pairing);
        }
        if gearbox.is_some_and(|g| g.efficiency_assumed) {
            assumptions.push(Assumption::GearboxEfficiency);
        }
        assumptions.extend(motor::least_brake(self, rules).map(Assumption::HoldingBrake));
        let limits = self.motor.envelope.assumed().iter();
        assumptions.extend(limits.copied().map(Assumption::Limits));
        assumptions
    }

    /// The findings of all rules that apply.
    pub fn findings(&self, rules: &RuleSet) -> Findings {
        let mut findings = Findings::default();
        self.measure_directly(rules, &mut findings);
        self.follow_time(&mut findings);
        findings
    }

    /// The rules that need no time course: see [`Rule::follows_time`]. The rule set selects the figure where there is more than one.
    pub fn measure_directly(&self, rules: &RuleSet, findings: &mut Findings) {
        voltage::measure(self.motor, findings);
        site::measure(self, findings);
        gearbox::measure_alone(self, rules, findings);
        stiffness::measure(self, findings);
        elements::measure(self, findings);
        motor::measure_speed(self.cycle, self.motor, self.ratio, findings);
        motor::measure_inertia(self, rules, findings);
        motor::measure_torques(self, findings);
        brake::measure(self, findings);
        motor::measure_peak(self, findings);
        gearbox::measure_stop(self, findings);
        electric::measure(self, findings);
    }

    /// The rules that follow a state over time.
    pub fn follow_time(&self, findings: &mut Findings) {
        let peak_current = findings.get(Rule::PeakCurrent).map(|found| found.value);
        thermal::follow(self, findings);
        electric::follow(self, peak_current, findings);
    }

    /// Time (s) and rises of winding and housing (K) over the cycle; `None` if they cannot be computed.
    pub fn rises(&self) -> Option<Vec<(f64, [f64; 2])>> {
        thermal::course(self)
    }

    /// Voltage of the DC bus over the cycle, \[time (s), voltage (V)\]; empty without data.
    pub fn bus_voltage(&self) -> Vec<[f64; 2]> {
        electric::trace(self)
    }

    /// The checks under a rule set.
    pub fn checks(&self, rules: &RuleSet) -> Vec<Check> {
        let findings = self.findings(rules);
        findings
            .iter()
            .filter(|(rule, _)| rules.shows(*rule))
            .map(|(rule, finding)| self.check(rules, rule, finding))
            .collect()
    }

    /// The check of one rule, if it applies.
    pub fn check_of(&self, rules: &RuleSet, rule: Rule) -> Option<Check> {
        let finding = self.findings(rules).get(rule)?;
        Some(self.check(rules, rule, finding))
    }

    fn check(&self, rules: &RuleSet, rule: Rule, finding: Finding) -> Check {
        let grounds = self.grounds(rules, rule, finding);
        Check::new(rules, rule, finding, grounds, self.vocabulary())
    }

    fn grounds(&self, rules: &RuleSet, rule: Rule, finding: Finding) -> Grounds {
        use Rule::{
            Altitude, AmbientTemperature, AmplifierVoltage, Backlash, BeltForce, BeltPretension,
            BeltTension, BrakeResistance, BrakeTorque, BrakeWork, BusVoltage, CabinetTemperature,
            ConstantTorque, GearboxAxial, GearboxCubicMean, GearboxCycles, GearboxEmergency,
            GearboxMeanSpeed, GearboxPeak, GearboxRadial, GearboxSpeed, HoldingTorque,
            HousingTemperature, InertiaRatio, MotorVoltage, NaturalFrequency, Overload,
            PeakCurrent, PeakTorque, PinionForce, ResistorPeak, ResistorPower, ResistorPulse,
            RmsCurrent, RmsTorque, ScrewBuckling, ScrewForce, ScrewSpeed, Speed,
            WindingTemperature,
        };
        match rule {
            RmsTorque | PeakTorque | Speed | HoldingTorque | ConstantTorque | InertiaRatio
            | BrakeTorque => motor::grounds(self, rules, rule),
            BrakeWork => brake::stopped(self),
            AmbientTemperature | CabinetTemperature | Altitude => site::grounds(self),
            GearboxPeak | GearboxCubicMean | GearboxEmergency | GearboxMeanSpeed | GearboxSpeed
            | GearboxCycles => gearbox::grounds(self, rules, rule, finding),
            WindingTemperature | HousingTemperature => thermal::grounds(self),
            MotorVoltage => voltage::of_motor(self),
            AmplifierVoltage => voltage::of_amplifier(self),
            GearboxRadial | GearboxAxial => elements::of_shaft(self),
            BeltTension | BeltForce | BeltPretension | ScrewForce | ScrewBuckling | ScrewSpeed
            | PinionForce => elements::grounds(self, rule),
            NaturalFrequency => stiffness::of_frequency(self),
            Backlash => stiffness::of_backlash(self),
            RmsCurrent | PeakCurrent | Overload | BusVoltage | BrakeResistance | ResistorPower
            | ResistorPeak | ResistorPulse => electric::grounds(self, rule, finding),
        }
    }

    /// The worst verdict and the largest use of a limit. Rules that follow time are checked only if all others are
    /// satisfied.
    pub fn outcome(&self, rules: &RuleSet) -> Outcome {
        self.ranked(rules).1
    }

    /// The findings and the outcome for the ranking: without the rules that follow time, if another rule is violated.
    pub fn ranked(&self, rules: &RuleSet) -> (Findings, Outcome) {
        let mut findings = Findings::default();
        self.measure_directly(rules, &mut findings);
        let outcome = Outcome::of(rules, &findings);
        if outcome.verdict == RuleVerdict::Fail {
            return (findings, outcome);
        }
        self.follow_time(&mut findings);
        let outcome = Outcome::of(rules, &findings);
        (findings, outcome)
    }
}

/// The violated rule; of several, the one with the largest use of its limit.
pub fn broken(rules: &RuleSet, findings: &Findings) -> Option<Rule> {
    let broken = findings
        .iter()
        .filter(|(rule, finding)| rules.verdict(*rule, *finding) == RuleVerdict::Fail);
    let used = broken.map(|(rule, finding)| (rules.use_of_limit(rule, finding), rule));
    used.max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, rule)| rule)
}
