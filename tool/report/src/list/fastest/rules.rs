//! Verdicts of the sizing rules on the motion, and the limits lowered for them.

use jred_file::model::rule::Rule;
use jred_file::number::rounding::{percent, short};
use jred_motion::fastest::ruled::{Cap, Judgement};
use jred_sizing::judge::check::Check;

use super::FastestView;
use crate::answer::Answer;
use crate::list::rule_words::sentence;

impl FastestView<'_> {
    /// The rules that the motion satisfies, and those that it violates.
    pub(super) fn rules(&self, judged: &Judgement, answer: &mut Answer) {
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
                sentence(check),
                cure(judged, check)
            );
            answer.fact("not kept", says);
        }
    }

    /// A lowered limit.
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

/// The cure for a violated rule.
fn cure(judged: &Judgement, check: &Check) -> &'static str {
    if judged.sought.contains(&check.id) {
        return "; no slower motion that was tried satisfies it";
    }
    match check.id {
        Rule::RmsTorque | Rule::WindingTemperature | Rule::HousingTemperature => {
            "; --max-rms s1 satisfies it"
        }
        _ => "; the motion does not account for it",
    }
}
