//! T2B with shock factors, the mean torque, the speeds.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::units::RPM;

use super::{Stand, budget, edited, near, press_text};
use jred_report::list::rule_words::note;

/// T2B is divided by the maker's factor for the cycles per hour, linear between the maker's points.
#[test]
fn shock_factors() {
    // One move in 0.5 s: 7200 cycles an hour.
    let mut stand = Stand::press();
    let peak = stand.duty.figures(|i| i.input_torque).peak();
    let warned = stand.check(true, &stand.file.rules, Rule::GearboxCycles);
    assert_eq!(
        (warned.value, warned.limit, warned.verdict),
        (Some(7200.0), Some(1000.0), RuleVerdict::Warn)
    );
    for (points, factor, most) in [
        (vec![], 1.0, 1000.0),
        (
            vec![[1000.0, 1.0], [5000.0, 1.6], [10_000.0, 2.0]],
            1.6 + 0.4 * 2200.0 / 5000.0,
            10_000.0,
        ),
        (vec![[1000.0, 1.0], [7200.0, 1.75]], 1.75, 7200.0),
        (vec![[1000.0, 1.0], [3000.0, 1.5]], 1.5, 3000.0),
        (vec![[8000.0, 1.25], [9000.0, 1.5]], 1.25, 9000.0),
    ] {
        stand.gearbox.shock_factors = points;
        let found = stand.found(true, Rule::GearboxPeak);
        near("peak", found.value, peak, 1e-14);
        near("T2B/f", found.rating, 80.0 / factor, 1e-14);
        let cycles = stand.found(true, Rule::GearboxCycles);
        assert_eq!((cycles.value, cycles.rating), (7200.0, most));
        let check = stand.check(true, &stand.file.rules, Rule::GearboxPeak);
        assert_eq!(
            note(&check).contains("shock factor"),
            factor > 1.0,
            "{}",
            note(&check)
        );
    }
}

/// A gearbox turns as fast as its motor: the ratio times the largest speed of its output.
#[test]
fn the_largest_speed_is_that_of_the_input() {
    let mut stand = Stand::press();
    let fastest = stand.duty.figures(|i| i.input_speed).peak();
    for ratio in [0.5, 3.0, 10.0] {
        stand.gearbox.ratio = ratio;
        let found = stand.found(true, Rule::GearboxSpeed);
        near("speed", found.value, ratio * fastest, 1e-14);
    }
}

/// The exponent of the mean torque: gears or roller bearings.
#[test]
fn mean_torque() {
    let mean = |exponent: f64, stand: &Stand| {
        let duty = &stand.duty;
        let turning = duty.integral(|i| i.input_speed.abs());
        let sum = duty.integral(|i| i.input_speed.abs() * i.input_torque.abs().powf(exponent));
        (sum / turning).powf(1.0 / exponent)
    };
    let stand = Stand::press();
    near(
        "gears",
        stand.found(true, Rule::GearboxCubicMean).value,
        mean(3.0, &stand),
        budget::SAME_SUMS,
    );
    let text = format!(
        "{}\n[rules]\ngearbox_mean_exponent = \"10/3\"\n",
        press_text()
    );
    let stand = Stand::new(&text);
    let found = stand.found(true, Rule::GearboxCubicMean).value;
    near(
        "bearings",
        found,
        mean(10.0 / 3.0, &stand),
        budget::SAME_SUMS,
    );
    assert!(found > mean(3.0, &stand));
    let check = stand.check(true, &stand.file.rules, Rule::GearboxCubicMean);
    assert!(note(&check).contains("10/3"), "{}", note(&check));
}

#[test]
fn without_starts_there_are_no_cycles() {
    let text = press_text();
    let (machine, _) = text.split_once("[motion]").unwrap();
    let text = format!("{machine}\n[motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n");
    let stand = Stand::new(&text);
    assert!(
        stand
            .finding(true, &stand.file.rules, Rule::GearboxCycles)
            .is_none()
    );
    let found = stand.found(true, Rule::GearboxMeanSpeed);
    near("mean speed", found.value, 60.0 * RPM * 15.0, 1e-9);
}

/// A gearbox rule without its figure is not checked, and names the missing data.
#[test]
fn missing_figures_are_named() {
    let mut stand = Stand::new(&edited(&press_text(), "97 %", "96 %"));
    stand.gearbox.rated_torque = None;
    stand.gearbox.stiffness = None;
    for (rule, words) in [
        (Rule::GearboxCubicMean, "rated torque"),
        (Rule::NaturalFrequency, "torsional stiffness of the gearbox"),
    ] {
        let check = stand.check(true, &stand.file.rules, rule);
        assert_eq!(check.verdict, RuleVerdict::NotChecked);
        assert_eq!((check.limit, check.margin), (None, None));
        assert!(note(&check).contains(words), "{}", note(&check));
    }
}

/// The mean torque of a gearbox is named if it is not the cubic one.
#[test]
fn the_exponent_of_roller_bearings_is_said() {
    for (exponent, said) in [("3", false), ("10/3", true)] {
        let rules = format!("[rules]\ngearbox_mean_exponent = \"{exponent}\"\n\n[motion]");
        let stand = Stand::new(&press_text().replacen("[motion]", &rules, 1));
        let check = stand.check(true, &stand.file.rules, Rule::GearboxCubicMean);
        let words = "mean with the exponent 10/3";
        assert_eq!(note(&check).contains(words), said, "{}", note(&check));
    }
}

/// T2B/f_s alone, for motion planning: f_s linear between the maker's points.
#[test]
fn the_acceleration_torque_of_a_cycle_rate() {
    let stand = Stand::press();
    let mut gearbox = stand.gearbox.clone();
    assert_eq!(gearbox.acceleration_torque(5000.0), Some(80.0));
    assert_eq!(gearbox.most_cycles(), 1000.0);
    gearbox.shock_factors = vec![[1000.0, 1.0], [2000.0, 1.15], [3000.0, 1.4]];
    near(
        "between",
        gearbox.acceleration_torque(1500.0).unwrap(),
        80.0 / 1.075,
        1e-12,
    );
    near(
        "beyond",
        gearbox.acceleration_torque(9000.0).unwrap(),
        80.0 / 1.4,
        1e-12,
    );
    assert_eq!(gearbox.most_cycles(), 3000.0);
    gearbox.peak_torque = None;
    assert_eq!(gearbox.acceleration_torque(100.0), None);
}
