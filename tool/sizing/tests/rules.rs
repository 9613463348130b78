//! The mechanical rules: each figure against an independent derivation.
// Zeros and copied figures are exact.
#![allow(clippy::float_cmp)]

mod backlash;
mod bigger;
mod bill;
mod brake;
mod elements;
mod emergency;
mod gearbox;
mod holding;
mod inertia;
mod judged;
mod lasting;
mod moves;
mod overload;
mod rigidity;
mod site;
mod voltage;
mod words;

use std::path::Path;

use crate::support::{Folder, budget, edited, near, press_text, rows, within};
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::rules::{Limit, RuleSet};
use jred_file::units::Vocabulary;
use jred_report::list::rule_words::{assumptions, note};
use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Brake, Catalogue, Gearbox, Motor};
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::check::Check;
use jred_sizing::judge::{Context, Grounds};
use jred_sizing::motor::envelope::MotorLimits;

fn read(text: &str) -> MachineFile {
    checked::parse("machine.toml", text, Path::new("")).unwrap()
}

/// A motor with every figure of the envelope.
const MOTOR: &str = "\
key,maker,model,rated_torque [N m],rated_speed [rpm],standstill_torque [N m],peak_torque [N m],max_speed [rpm],\
rotor_inertia [kg cm^2],peak_corner_speed [rpm],peak_torque_at_max_speed [N m],source,figures_from
m,Maker,Model,8,3000,9,30,5000,8,2500,10,Sheet,maker
";
const GEARBOX: &str = "\
key,maker,model,ratio,rated_output_torque [N m],peak_output_torque [N m],emergency_output_torque [N m],\
rated_input_speed [rpm],max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source,figures_from
g,Maker,Model,5,40,80,160,3000,6000,0.8,95,Sheet,maker
";

/// A machine with its motion prepared, and one drive for it.
struct Stand {
    file: MachineFile,
    duty: Duty,
    cycle: Cycle,
    motor: Motor,
    gearbox: Gearbox,
}

impl Stand {
    fn new(text: &str) -> Self {
        let file = read(text);
        let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 2000).unwrap();
        let cycle = Cycle::new(&duty);
        let folder = Folder::new();
        let paths = [folder.file("m.csv", MOTOR), folder.file("g.csv", GEARBOX)];
        let mut catalogue = Catalogue::load(Some(&paths[0]), Some(&paths[1])).unwrap();
        Self {
            file,
            duty,
            cycle,
            motor: catalogue.motors.remove(0),
            gearbox: catalogue.gearboxes.remove(0),
        }
    }

    fn press() -> Self {
        Self::new(&press_text())
    }

    fn drive(&self, geared: bool) -> Drive<'_> {
        Drive {
            motor: &self.motor,
            gearbox: Some(&self.gearbox).filter(|_| geared),
            amplifier: None,
        }
    }

    fn prepared(&self) -> MotorLimits {
        let alone = Catalogue {
            motors: vec![self.motor.clone()],
            ..Catalogue::default()
        };
        alone.prepare(&self.file.site).remove(0)
    }

    /// Assumptions and warnings of the result.
    fn warnings(&self, geared: bool) -> Vec<String> {
        let prepared = self.prepared();
        let drive = self.drive(geared);
        let context = Context::new(&self.cycle, &self.file.site, drive, &prepared);
        assumptions(&drive, &context.assumptions(&RuleSet::default()))
    }

    /// A rule's finding, if it applies.
    fn finding(&self, geared: bool, rules: &RuleSet, rule: Rule) -> Option<Finding> {
        let prepared = self.prepared();
        let context = Context::new(&self.cycle, &self.file.site, self.drive(geared), &prepared);
        context.findings(rules).get(rule)
    }

    /// A rule's finding under the machine file's rules; it must apply.
    fn found(&self, geared: bool, rule: Rule) -> Finding {
        self.finding(geared, &self.file.rules, rule).unwrap()
    }

    /// A rule as text; it must be shown.
    fn check(&self, geared: bool, rules: &RuleSet, rule: Rule) -> Check {
        let prepared = self.prepared();
        let context = Context::new(&self.cycle, &self.file.site, self.drive(geared), &prepared);
        let checks = context.checks(rules);
        checks.into_iter().find(|check| check.id == rule).unwrap()
    }

    fn brake(&mut self, torque: f64) {
        self.motor.brake = Some(Brake {
            torque,
            ..Brake::default()
        });
    }
}

/// The check of an inertia ratio.
fn ratio(rules: &RuleSet, finding: Finding) -> Check {
    let words = &Vocabulary::ROTARY;
    Check::new(rules, Rule::InertiaRatio, finding, Grounds::None, words)
}

/// A warning names its limit next to the one for refusal.
#[test]
fn a_warning_names_its_limit() {
    let note = |value: f64| {
        let finding = Finding::new(value, 1.0);
        note(&ratio(&RuleSet::default(), finding))
    };
    assert_eq!(note(6.0), "10 times the rotor's inertia; warning above 5");
    assert_eq!(note(4.0), "10 times the rotor's inertia");
}

/// If the peak is reported with its speed, it is that of the point closest to the envelope.
#[test]
fn the_place_of_the_peak_is_said() {
    let stand = Stand::press();
    let check = stand.check(true, &stand.file.rules, Rule::PeakTorque);
    let words = note(&check);
    let (before, _) = words
        .split_once(" rpm, where the cycle comes closest to the envelope")
        .expect(&words);
    let number: f64 = before.rsplit(' ').next().unwrap().parse().unwrap();
    let prepared = stand.prepared();
    let context = Context::new(&stand.cycle, &stand.file.site, stand.drive(true), &prepared);
    let peak = stand
        .cycle
        .peak(&context.coefficients, 5.0, &prepared.envelope);
    within(
        "rpm",
        number.abs(),
        peak.speed.abs() / jred_file::units::RPM,
        1.0,
    );
}

/// The use of a limit is printed up to ten times.
#[test]
fn a_use_of_a_limit_is_said_up_to_ten_times() {
    let used = |value: f64| {
        let mut rules = RuleSet::default();
        let limit = Limit {
            fail: Some(1.0),
            warn: None,
        };
        rules.set(Rule::InertiaRatio, limit);
        ratio(&rules, Finding::new(value, 1.0)).used()
    };
    assert_eq!([0.5, 10.0, 10.01].map(used), ["50 %", "1000 %", "> 1000 %"]);
}
