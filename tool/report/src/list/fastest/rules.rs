//! How the rules of sizing judge the motion, and what was lowered for them.

use jred_file::model::rule::Rule;
use jred_file::number::rounding::{percent, short};
use jred_motion::fastest::ruled::{Cap, Judged};
use jred_sizing::judge::check::Check;

use super::View;
use crate::answer::Answer;

impl View<'_> {
    /// The rules that the motion keeps, and those that it does not.
    pub(super) fn rules(&self, judged: &Judged, answer: &mut Answer) {
        let kept: Vec<String> = judged
            .kept()
            .map(|check| {
                format!("{} {}", check.rule, check.used())
                    .trim_end()
                    .to_owned()
            })
            .collect();
        answer.fact("rules kept", kept.join(", "));
        let caps: Vec<String> = (judged.caps.iter())
            .map(|(cap, value)| self.cap(*cap, *value))
            .collect();
        if !caps.is_empty() {
            answer.fact("for them", caps.join(", "));
        }
        for check in judged.violated() {
            let says = format!(
                "{}: `jred size` refuses the motion{}",
                check.sentence(),
                cure(judged, check)
            );
            answer.fact("not kept", says);
        }
    }

    /// What was lowered, and to how much.
    fn cap(&self, cap: Cap, value: f64) -> String {
        let words = self.words();
        let (torque, speed) = (words.torque, words.speed);
        match cap {
            Cap::MotorTorque => format!(
                "motor {torque} at most {} of what the reserve leaves",
                percent(value)
            ),
            Cap::GearboxTorque => format!("gearbox torque at most {} N m", short(value)),
            Cap::Speed => format!(
                "motor speed at most {} {}",
                short(value / speed.scale),
                speed.unit
            ),
            Cap::RmsTorque => format!("RMS {torque} at most {} {}", short(value), torque.unit),
        }
    }
}

/// What keeps a rule that the motion violates.
fn cure(judged: &Judged, check: &Check) -> &'static str {
    if judged.sought.contains(&check.id) {
        return "; no slower motion that was tried keeps it";
    }
    match check.id {
        Rule::RmsTorque | Rule::WindingTemperature | Rule::HousingTemperature => {
            "; --max-rms s1 keeps it"
        }
        _ => "; the motion is not made for it",
    }
}
