//! Messages about remedies.

use super::remedy::{Edge, Lever, Remedy, RuleViolation};
use jred_file::number::rounding::{short, told_apart};
use jred_file::units::Vocabulary;

impl Remedy {
    /// The closest value at which every rule is satisfied, and the rule at its limit there; `None` if no value helps or the current one is suitable.
    pub fn change(&self) -> Option<Edge> {
        let [low, high] = self.range?;
        if self.now < low.value {
            Some(low)
        } else if self.now > high.value {
            Some(high)
        } else {
            None
        }
    }

    /// The message; `duration` is the current cycle time (s).
    pub fn sentence(&self, duration: f64, words: &Vocabulary) -> String {
        let shown = |value: f64| match self.lever {
            Lever::GearRatio | Lever::IdealGearbox => short(value),
            Lever::CycleTime => format!("{} s", short(value * duration)),
            Lever::MovingMass | Lever::ProcessLoad => format!("{} %", short(value * 100.0)),
        };
        let at = |edge: &Edge| {
            let rule = edge
                .rule
                .map_or(String::new(), |r| format!(" ({})", r.named(words)));
            format!("{}{rule}", shown(edge.value))
        };
        let (name, now) = (self.lever.name(), shown(self.now));
        if let Some([low, high]) = &self.range {
            if self.change().is_some() {
                // For a refused drive nothing is known beyond the tried values.
                return format!("{name} {now}: suitable at {} to {}", at(low), at(high));
            }
            let range = match (low.rule, high.rule) {
                (None, None) => "any value within the range tried".to_owned(),
                (Some(_), None) => format!("{} or more", at(low)),
                (None, Some(_)) => format!("{} or less", at(high)),
                (Some(_), Some(_)) => format!("{} to {}", at(low), at(high)),
            };
            return format!("{name} {now}: may be {range}");
        }
        let [least, most] = self.lever.choices(self.now).map(shown);
        let Some(best) = &self.best else {
            return format!("{name} {now}: no value from {least} to {most} helps");
        };
        let rule = best.rule.map_or("a rule", |rule| rule.named(words));
        let used = self.best_use.map_or(String::new(), |used| {
            format!(" at {} of its limit", percent(used))
        });
        format!(
            "{name} {now}: no value from {least} to {most} helps; at {}, the best, {rule} is still violated{used}",
            shown(best.value)
        )
    }
}

impl RuleViolation {
    /// Sentence on the use of the limit and on a sufficient limit.
    pub fn sentence(&self, words: &Vocabulary) -> String {
        let name = self.rule.named(words);
        match (self.used, self.needed) {
            (Some(used), Some(needed)) => {
                let [needed, limit] = told_apart([needed, self.limit]);
                format!(
                    "{name} uses {} of its limit (a limit of {needed} instead of {limit} would be satisfied)",
                    percent(used)
                )
            }
            _ if self.rule.is_yes_or_no() => format!("{name} is beyond its limit"),
            _ => format!("{name} is required, but there is none"),
        }
    }
}

/// A used share; beyond ten times the limit its digits mean nothing, as in [`Check::used`](crate::judge::check::Check::used).
fn percent(used: f64) -> String {
    if used > 1.0 && used < 1.000_5 {
        "a little more than 100 %".to_owned()
    } else if used < 10.0 {
        format!("{:.1} %", used * 100.0)
    } else {
        "> 1000 %".to_owned()
    }
}
