//! The changes that a drive would need, in words.

use jred_file::number::rounding::{short, told_apart};
use jred_file::units::Vocabulary;
use jred_sizing::explain::{Edge, Lever, Remedy, RuleViolation};

/// The quantity with its current value, and the message; `duration` is the current cycle time (s).
pub(super) fn fact(remedy: &Remedy, duration: f64, words: &Vocabulary) -> [String; 2] {
    let shown = |value: f64| match remedy.lever {
        Lever::GearRatio | Lever::IdealGearbox => short(value),
        Lever::CycleTime => format!("{} s", short(value * duration)),
        Lever::MovingMass | Lever::ProcessLoad => format!("{} %", short(value * 100.0)),
    };
    let text = says(remedy, words, shown);
    let name = format!("{} {}", remedy.lever.name(), shown(remedy.now));
    [name, text]
}

fn says(remedy: &Remedy, words: &Vocabulary, shown: impl Fn(f64) -> String) -> String {
    let at = |edge: &Edge| {
        let rule = edge
            .rule
            .map_or(String::new(), |r| format!(" ({})", r.named(words)));
        format!("{}{rule}", shown(edge.value))
    };
    if let Some([low, high]) = &remedy.range {
        if remedy.change().is_some() {
            // For a refused drive nothing is known beyond the tried values.
            return format!("suitable at {} to {}", at(low), at(high));
        }
        let range = match (low.rule, high.rule) {
            (None, None) => "any value within the range tried".to_owned(),
            (Some(_), None) => format!("{} or more", at(low)),
            (None, Some(_)) => format!("{} or less", at(high)),
            (Some(_), Some(_)) => format!("{} to {}", at(low), at(high)),
        };
        return format!("may be {range}");
    }
    let [least, most] = remedy.lever.choices(remedy.now).map(&shown);
    let Some(best) = &remedy.best else {
        return format!("no value from {least} to {most} helps");
    };
    let rule = best.rule.map_or("a rule", |rule| rule.named(words));
    let used = remedy.best_use.map_or(String::new(), |used| {
        format!(" at {} of its limit", percent(used))
    });
    format!(
        "no value from {least} to {most} helps; at {}, the best, {rule} is still violated{used}",
        shown(best.value)
    )
}

/// Sentence on the use of the limit and on a sufficient limit.
pub(super) fn violation(violation: &RuleViolation, words: &Vocabulary) -> String {
    let name = violation.rule.named(words);
    match (violation.used, violation.needed) {
        (Some(used), Some(needed)) => {
            let [needed, limit] = told_apart([needed, violation.limit]);
            format!(
                "{name} uses {} of its limit (a limit of {needed} instead of {limit} would be satisfied)",
                percent(used)
            )
        }
        _ if violation.rule.is_yes_or_no() => format!("{name} is beyond its limit"),
        _ => format!("{name} is required where its limit is zero"),
    }
}

/// A used share; beyond ten times the limit its digits mean nothing, as in [`Check::used`](jred_sizing::judge::check::Check::used).
fn percent(used: f64) -> String {
    if used > 1.0 && used < 1.000_5 {
        "a little more than 100 %".to_owned()
    } else if used < 10.0 {
        format!("{:.1} %", used * 100.0)
    } else {
        "> 1000 %".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::{fact, violation};
    use jred_file::model::rule::Rule;
    use jred_file::units::Vocabulary;
    use jred_sizing::explain::{Edge, Lever, Remedy, RuleViolation};

    /// Figures beyond ten times the limit have few digits, as in the table of checks.
    #[test]
    fn no_value_helps() {
        let rule = Rule::RmsTorque;
        let remedy = Remedy {
            lever: Lever::MovingMass,
            now: 1.0,
            range: None,
            best: Some(Edge {
                value: 0.5,
                rule: Some(rule),
            }),
            best_use: Some(42.0),
        };
        let expected = "no value from 50 % to 100 % helps; at 50 %, the best, RMS torque is still violated at > 1000 % of its limit";
        assert_eq!(
            fact(&remedy, 1.0, &Vocabulary::ROTARY),
            ["moving masses 100 %", expected]
        );
        let broken = RuleViolation {
            rule,
            used: Some(84.0),
            limit: 10.0,
            needed: Some(840.0),
        };
        assert_eq!(
            violation(&broken, &Vocabulary::ROTARY),
            "RMS torque uses > 1000 % of its limit (a limit of 840 instead of 10 would be satisfied)"
        );
    }
}
