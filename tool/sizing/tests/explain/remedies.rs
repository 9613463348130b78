//! The values at which a drive becomes suitable: closed forms, and the machine file with that value.

use std::f64::consts::PI;

use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::rules::{Limit, RuleSet};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::catalogue::Drive;
use jred_sizing::cycle::Cycle;
use jred_sizing::explain::{DutyModel, Lever, Remedies, Remedy};
use jred_sizing::judge::Context;
use jred_sizing::select::size::Selection;

use super::{duty_of, parse};
use crate::direct;
use crate::support::{Folder, budget, edited, near, press_text};

/// A wheel moved by half a turn and back: T = α·(J_M·i + J/i).
const WHEEL: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
stage = [{ driver = { teeth = 20, inertia = "0.5 kg m^2" }, driven = { teeth = 20, inertia = "0.5 kg m^2" } }]
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "180 deg"
duration = "0.5 s"
[[motion.segment]]
law = "polynomial-345"
move = "-180 deg"
duration = "0.5 s"
"#;

/// A motor whose S1 torque of 10 N·m is the same at every speed.
const MOTOR: &str = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],source\n\
     m,A,B,10,100000,1000,80,none\n";

/// Only the RMS torque is judged, up to the S1 torque.
fn only_rms() -> RuleSet {
    let mut rules = RuleSet::default();
    for rule in Rule::ALL {
        rules.set(rule, Limit::default());
    }
    let fail = Some(1.0);
    rules.set(Rule::RmsTorque, Limit { fail, warn: None });
    rules
}

/// The wheel with one motor.
struct Stand {
    catalogue: Catalogue,
    file: MachineFile,
    duty: Duty,
}

impl Stand {
    fn new(motors: &str) -> Self {
        let folder = Folder::new();
        let motors = folder.file("m.csv", motors);
        let file = parse(WHEEL);
        Self {
            catalogue: Catalogue::load(Some(&motors), None).unwrap(),
            duty: duty_of(&file),
            file,
        }
    }

    fn remedies(&self, rules: &RuleSet) -> Remedies {
        let site = &self.file.site;
        let altered = DutyModel::new(&self.file, &self.duty).unwrap();
        let prepared = self.catalogue.prepare(site);
        let drive = direct(&self.catalogue.motors[0]);
        Remedies::new(&altered, site, rules, drive, &prepared[0])
    }
}

fn remedy(remedies: &Remedies, lever: Lever) -> Remedy {
    let mut all = remedies.remedies.iter();
    *all.find(|r| r.lever == lever).unwrap()
}

#[test]
fn ranges_of_a_wheel_in_closed_form() {
    let stand = Stand::new(&MOTOR.replace("B,10,", "B,30,"));
    let rules = only_rms();
    let remedies = stand.remedies(&rules);
    assert!(!remedies.holds);
    let (rotor, load) = (0.008, 1.0);
    let alpha = stand.duty.figures(|i| i.alpha).rms;
    let share = alpha * (rotor + load) / 30.0;
    assert_eq!(remedies.misses.len(), 1);
    assert_eq!(remedies.misses[0].rule, Rule::RmsTorque);
    near(
        "use",
        remedies.misses[0].used.unwrap(),
        share,
        budget::SAME_SUMS,
    );
    near(
        "needed",
        remedies.misses[0].needed.unwrap(),
        share,
        budget::SAME_SUMS,
    );
    // J_M·i² − (M/α)·i + J = 0
    let half = 30.0 / alpha / (2.0 * rotor);
    let root = (half * half - load / rotor).sqrt();
    let found = remedy(&remedies, Lever::IdealGearbox);
    let [low, high] = found.range.unwrap();
    near("least ratio", low.value, half - root, budget::RANGE_END);
    near("largest ratio", high.value, half + root, budget::RANGE_END);
    assert_eq!(low.rule, Some(Rule::RmsTorque));
    assert_eq!(found.change(), Some(low), "from the ratio 1 upwards");
    // T is proportional to 1/s².
    let found = remedy(&remedies, Lever::CycleTime);
    let [low, high] = found.range.unwrap();
    near("cycle time", low.value, share.sqrt(), budget::RANGE_END);
    assert_eq!(high.rule, None, "the slower the better");
    // The cycle time is at most doubled.
    assert!((high.value - 2.0).abs() < 1e-12);
    // α·(J_M + m·J) = M
    let found = remedy(&remedies, Lever::MovingMass);
    let [low, high] = found.range.unwrap();
    near(
        "mass",
        high.value,
        (30.0 / alpha - rotor) / load,
        budget::RANGE_END,
    );
    // Masses are at most halved.
    assert_eq!((low.value, low.rule), (0.5, None));
    // No load, so no such quantity.
    assert!(
        remedies
            .remedies
            .iter()
            .all(|r| r.lever != Lever::ProcessLoad)
    );
}

#[test]
fn no_value_helps_where_the_rotor_alone_is_too_heavy() {
    let stand = Stand::new(&MOTOR.replace(",80,", ",8000000,"));
    let rules = only_rms();
    let remedies = stand.remedies(&rules);
    let found = remedy(&remedies, Lever::MovingMass);
    assert_eq!(found.range, None);
    let best = found.best.unwrap();
    assert!(
        (best.value - 0.5).abs() < 1e-12,
        "the lightest that is tried is the best"
    );
    assert_eq!(best.rule, Some(Rule::RmsTorque));
    let alpha = stand.duty.figures(|i| i.alpha).rms;
    near(
        "use",
        found.best_use.unwrap(),
        alpha * (800.0 + 0.5 * 1.0) / 10.0,
        budget::SAME_SUMS,
    );
    assert_eq!(found.change(), None);
    let miss = &remedies.misses[0];
    assert_eq!(miss.rule, Rule::RmsTorque);
    assert!(miss.used > Some(10.0), "{miss:?}");
}

/// With few steps the peak torque is resolved by instants without a weight, so a range ends at the peak of the motion law: α = 10/√3·s/t².
#[test]
fn a_peak_between_the_steps_ends_the_range() {
    let mut stand = Stand::new(MOTOR);
    let motion = stand.file.motion.as_ref().unwrap();
    stand.duty = Duty::new(&stand.file, motion, 32).unwrap();
    let mut rules = only_rms();
    rules.set(Rule::RmsTorque, Limit::default());
    let fail = Some(0.1);
    rules.set(Rule::PeakTorque, Limit { fail, warn: None });
    let remedies = stand.remedies(&rules);
    // A tenth of 1000 N·m turns two wheels of 0.5 kg·m² and a rotor of 80 kg·cm² by half a turn.
    let shortest = (10.0 / 3.0f64.sqrt() * PI * (1.0 + 80e-4) / 100.0).sqrt() / 0.5;
    let [low, _] = remedy(&remedies, Lever::CycleTime).range.unwrap();
    assert_eq!(low.rule, Some(Rule::PeakTorque));
    near("time", low.value, shortest, budget::PEAK_BETWEEN_STEPS);
}

/// The temperature of a motor that is far too small is meaningless, but it is not the reason for the refusal: the explanation begins with the rule
/// used for ranking.
#[test]
fn what_is_missed_is_what_the_ranking_goes_by() {
    let stand = Stand::new(&MOTOR.replace("1000,80,", "40,800,"));
    let rules = RuleSet::default();
    let cycle = Cycle::new(&stand.duty);
    let prepared = stand.catalogue.prepare(&stand.file.site);
    let drive = direct(&stand.catalogue.motors[0]);
    let context = Context::new(&cycle, &stand.file.site, drive, &prepared[0]);
    let hot = context.findings(&rules).get(Rule::WindingTemperature);
    let hot = rules.use_of_limit(Rule::WindingTemperature, hot.unwrap());
    let outcome = context.outcome(&rules);
    assert!(hot > outcome.worst_use, "{hot} {outcome:?}");
    let remedies = stand.remedies(&rules);
    let first = remedies.misses[0];
    assert_eq!(Some(first.rule), outcome.worst_rule);
    near(
        "use",
        first.used.unwrap(),
        outcome.worst_use,
        budget::SAME_SUMS,
    );
    assert!(remedies.misses.iter().all(|m| !m.rule.follows_time()));
}

/// The press with 25 kN: the remedies of the best refused drives, written into the machine file.
#[test]
fn a_change_written_into_the_machine_file_does_what_was_said() {
    let text = edited(&press_text(), "\"-10 kN\"", "\"-60 kN\"");
    let file = parse(&text);
    let duty = duty_of(&file);
    let catalogue = super::catalogue();
    let motors = catalogue.prepare(&file.site);
    let cycle = Cycle::new(&duty);
    let selection = Selection::new(&catalogue, &motors, &cycle, &file.site, &file.rules);
    let altered = DutyModel::new(&file, &duty).unwrap();
    let all = Remedies::of_nearest(&selection, &altered, 3).unwrap();
    assert_eq!(all.len(), 3);
    let mut checked = 0;
    for (remedies, candidate) in all.iter().zip(selection.refused.known()) {
        assert!(!remedies.holds && !remedies.misses.is_empty());
        for remedy in &remedies.remedies {
            let Some(edge) = remedy.change() else {
                continue;
            };
            let rule = edge.rule.expect("what hinders");
            let outward = (edge.value - remedy.now).signum();
            for (side, holds) in [(1.0, true), (-1.0, false)] {
                let value = edge.value * (1.0 + side * outward * 1e-4);
                let mut gearbox = candidate.drive.gearbox.cloned();
                let text = match remedy.lever {
                    Lever::GearRatio => {
                        gearbox.as_mut().unwrap().ratio = value;
                        text.clone()
                    }
                    Lever::CycleTime => {
                        let move_time = format!("duration = \"{} s\"", 0.4 * value);
                        let text = edited(&text, "duration = \"0.4 s\"", &move_time);
                        edited(
                            &text,
                            "dwell = \"0.1 s\"",
                            &format!("dwell = \"{} s\"", 0.1 * value),
                        )
                    }
                    Lever::ProcessLoad => {
                        edited(&text, "\"-60 kN\"", &format!("\"{} kN\"", -60.0 * value))
                    }
                    Lever::MovingMass | Lever::IdealGearbox => continue,
                };
                let other = parse(&text);
                let cycle = Cycle::new(&duty_of(&other));
                let drive = Drive {
                    gearbox: gearbox.as_ref(),
                    ..candidate.drive
                };
                let context = Context::new(&cycle, &other.site, drive, candidate.motor);
                let findings = context.findings(&file.rules);
                let broken: Vec<Rule> = findings
                    .iter()
                    .filter(|(rule, f)| file.rules.verdict(*rule, *f) == RuleVerdict::Fail)
                    .map(|(rule, _)| rule)
                    .collect();
                let what = format!("{}, {:?} {value}", remedies.drive, remedy.lever);
                if holds {
                    assert!(broken.is_empty(), "{what}: {broken:?}");
                } else {
                    assert!(
                        broken.contains(&rule),
                        "{what}: {broken:?} and not {rule:?}"
                    );
                }
                checked += 1;
            }
        }
    }
    assert!(checked >= 6, "{checked}");
}

/// Changes are limited to a reasonable range: if only three times the mass would help there is no remedy, and the text gives the range. A suitable
/// drive shows its whole range.
#[test]
fn nobody_is_told_to_make_the_machine_heavier() {
    let stand = Stand::new(MOTOR);
    // The drive is suitable for limits from 5.24 times its rating of 10 N m on, by alpha·(0.008 + m)/10.
    let alpha = stand.duty.figures(|i| i.alpha).rms;
    let mut rules = only_rms();
    let remedies = stand.remedies(&rules);
    for lever in [Lever::CycleTime, Lever::MovingMass] {
        let found = remedy(&remedies, lever);
        assert_eq!((found.range, found.change()), (None, None));
    }
    let fail = Some(6.0);
    rules.set(Rule::RmsTorque, Limit { fail, warn: None });
    let remedies = stand.remedies(&rules);
    assert!(remedies.holds);
    let [low, high] = remedy(&remedies, Lever::MovingMass).range.unwrap();
    near("mass", high.value, 60.0 / alpha - 0.008, budget::RANGE_END);
    assert!(low.value <= 0.0 && low.rule.is_none());
}
