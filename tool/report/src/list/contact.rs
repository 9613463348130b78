//! Text about a one-sided contact that a motion loses.

use jred_analysis::contact::Separation;
use jred_file::math;
use jred_file::model::axis::Axis;
use jred_file::number::rounding::short;
use jred_motion::contact::ContactLimits;

/// Place, time and force of the loss.
fn state(broken: &ContactLimits) -> String {
    let lost = &broken.lost;
    format!(
        "{} at {}, after {} s: {}",
        lost.parted.what(),
        lost.parted.state(),
        short(lost.t),
        lost.parted.required_force()
    )
}

/// For results that are computed as if the contact did not separate.
pub fn warning(parted: &Separation) -> String {
    format!(
        "{} ({}): {}; results are valid only if contact is maintained by other means",
        parted.what(),
        parted.state(),
        parted.required_force()
    )
}

/// For a fastest motion, with the limits that keep the contact.
pub fn of_fastest(broken: &ContactLimits, axis: &Axis) -> String {
    let Some(limits) = broken.limits else {
        return format!("{}; {}", state(broken), broken.lost.parted.cure());
    };
    let [_, column] = axis.coordinate.rates();
    let options = ["max-acceleration", "max-deceleration"].iter().zip(limits);
    let options = options.filter_map(|(name, limit)| {
        let limit = rounded_down(axis.rate(limit?));
        Some(format!("--{name} \"{} {}\"", short(limit), column.unit))
    });
    let options: Vec<String> = options.collect();
    let kept = if broken.lost.joint.rope {
        "it stays taut"
    } else {
        "it stays"
    };
    format!("{}; with {} {kept}", state(broken), options.join(" "))
}

/// For a motion of a given time.
pub fn of_gentlest(broken: &ContactLimits) -> String {
    format!(
        "{}; give the move more time, or {}",
        state(broken),
        broken.lost.parted.cure()
    )
}

/// Rounds down to three digits.
fn rounded_down(value: f64) -> f64 {
    let digit = 10f64.powi(math::log10(value).floor() as i32 - 2);
    (value / digit).floor() * digit
}

#[cfg(test)]
mod tests {
    use super::rounded_down;

    #[test]
    fn a_limit_is_rounded_down() {
        for (value, expected) in [(129.97, 129.0), (0.012_349, 0.012_3), (1.0, 1.0)] {
            let found = rounded_down(value);
            assert!((found - expected).abs() < 1e-12 * expected, "{found}");
        }
    }
}
