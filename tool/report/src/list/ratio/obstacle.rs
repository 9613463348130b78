//! Why a motor satisfies the rules at no ratio, in words.

use jred_file::number::rounding::significant;
use jred_sizing::select::ratio::obstacle::Obstacle;

/// The message.
pub(super) fn words(obstacle: &Obstacle) -> String {
    let shown = |x: f64| significant(x, 3);
    match *obstacle {
        Obstacle::Always { rule, used, .. } if rule.is_of_voltage() => format!(
            "{}: {} % of its limit, whatever the ratio",
            rule.name(),
            shown(used * 100.0)
        ),
        Obstacle::Always { rule, used, ratio } if !used.is_finite() => format!(
            "{}: nothing of its limit is left at any ratio; at best at ratio {}",
            rule.name(),
            shown(ratio)
        ),
        Obstacle::Together { rule, used, ratio } if !used.is_finite() => format!(
            "not all rules at once: at ratio {}, the best, nothing is left of the limit of {}",
            shown(ratio),
            rule.name()
        ),
        Obstacle::Always { rule, used, ratio } => format!(
            "{}: {} % of its limit at best, at ratio {}",
            rule.name(),
            shown(used * 100.0),
            shown(ratio)
        ),
        Obstacle::Apart { least, most } => format!(
            "{} needs {} or more, {} {} or less",
            least.0.name(),
            shown(least.1),
            most.0.name(),
            shown(most.1)
        ),
        Obstacle::Together { rule, used, ratio } => format!(
            "not all rules at once: at ratio {}, the best, {} uses {} % of its limit",
            shown(ratio),
            rule.name(),
            shown(used * 100.0)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::words;
    use jred_file::model::rule::Rule;
    use jred_sizing::select::ratio::obstacle::Obstacle;

    /// Each reason as text: a voltage does not depend on the ratio, and a limit of zero has no share.
    #[test]
    fn reasons_in_words() {
        let always = |rule, used| Obstacle::Always {
            rule,
            used,
            ratio: 12.34,
        };
        let together = |used| Obstacle::Together {
            rule: Rule::Speed,
            used,
            ratio: 12.34,
        };
        let [voltage, torque, speed] =
            [Rule::MotorVoltage, Rule::RmsTorque, Rule::Speed].map(Rule::name);
        for (obstacle, expected) in [
            (
                always(Rule::MotorVoltage, 1.25),
                format!("{voltage}: 125 % of its limit, whatever the ratio"),
            ),
            (
                always(Rule::RmsTorque, 1.25),
                format!("{torque}: 125 % of its limit at best, at ratio 12.3"),
            ),
            (
                always(Rule::RmsTorque, f64::INFINITY),
                format!(
                    "{torque}: nothing of its limit is left at any ratio; at best at ratio 12.3"
                ),
            ),
            (
                Obstacle::Apart {
                    least: (Rule::RmsTorque, 20.0),
                    most: (Rule::Speed, 10.0),
                },
                format!("{torque} needs 20 or more, {speed} 10 or less"),
            ),
            (
                together(1.25),
                format!(
                    "not all rules at once: at ratio 12.3, the best, {speed} uses 125 % of its limit"
                ),
            ),
            (
                together(f64::INFINITY),
                format!(
                    "not all rules at once: at ratio 12.3, the best, nothing is left of the limit of {speed}"
                ),
            ),
        ] {
            assert_eq!(words(&obstacle), expected);
        }
    }
}
