//! Torque at rest, and torque that flows back through a gearbox.

use jred_file::model::operation::Operation;
use jred_file::model::rule::Rule;
use jred_file::model::rules::{RuleSet, RuleVerdict};
use jred_report::list::rule_words::note;
use jred_sizing::catalogue::Drive;
use jred_sizing::cycle::form::Coefficients;
use proptest::prelude::*;

use super::{Stand, budget, near, press_text, within};

/// A weight of 120 N m on a 3:1 belt of 96 %, which turns once and then hangs.
const HOIST: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.5 kg m^2"
stage = [{ driver = { teeth = 20, inertia = "0 kg m^2" }, driven = { teeth = 20, inertia = "0 kg m^2" } }]
[[load]]
on = "shaft-2"
moment = "120 N m"
[[load]]
on = "shaft-1"
opposing_moment = "7 N m"
[[load]]
on = "shaft-1"
viscous_moment = "0.5 N m s/rad"
[[drive_train]]
type = "belt"
driver = { radius = "40 mm", inertia = "0 kg m^2" }
driven = { radius = "120 mm", inertia = "0 kg m^2" }
efficiency = "96 %"
[motion]
type = "cycle"
[[motion.segment]]
move = "1 turn"
duration = "2 s"
law = "cycloidal"
[[motion.segment]]
dwell = "3 s"
"#;

fn hoist() -> Stand {
    Stand::new(&HOIST.replace("1 turn", "360 deg"))
}

/// The motor may have to hold against friction; the brake holds without its help.
#[test]
fn a_weight_is_held() {
    let mut stand = hoist();
    stand.brake(9.0);
    let at_input = 120.0 / 3.0;
    near(
        "direct",
        stand.found(false, Rule::HoldingTorque).value,
        at_input / 0.96,
        1e-12,
    );
    near(
        "direct, brake",
        stand.found(false, Rule::BrakeTorque).value,
        at_input,
        1e-12,
    );
    for back in [0.95, 2.0 - 1.0 / 0.95, 0.1] {
        stand.gearbox.back_efficiency = back;
        near(
            "geared",
            stand.found(true, Rule::HoldingTorque).value,
            at_input / (0.96 * 5.0 * 0.95),
            1e-12,
        );
        let brake = stand.found(true, Rule::BrakeTorque);
        near("geared, brake", brake.value, at_input / 5.0, 1e-12);
        assert_eq!(brake.rating, 9.0);
    }
    // A self-locking gearbox holds alone.
    for back in [0.0, -0.4] {
        stand.gearbox.back_efficiency = back;
        assert_eq!(stand.found(true, Rule::HoldingTorque).value, 0.0);
        assert_eq!(stand.found(true, Rule::BrakeTorque).value, 0.0);
        let check = stand.check(true, &RuleSet::default(), Rule::BrakeTorque);
        assert!(note(&check).contains("holds by itself"), "{}", note(&check));
    }
}

/// A motor without a brake lets a weight fall that neither friction nor the gearbox holds: a warning gives the required torque, and the rule is not
/// checked.
#[test]
fn what_falls_without_a_brake_is_said() {
    let rules = RuleSet::default();
    let mut stand = hoist();
    stand.brake(9.0);
    assert!(stand.warnings(true).iter().all(|w| !w.contains("brake")));
    stand.motor.brake = None;
    let warning = stand.warnings(true).remove(0);
    // 120 N m over 3 and 5, times the rule's factor of 1.5; a brake of that torque satisfies the rule.
    assert!(warning.contains("at least 12 N m"), "{warning}");
    for (torque, verdict) in [(12.0, RuleVerdict::Pass), (11.99, RuleVerdict::Fail)] {
        stand.brake(torque);
        assert_eq!(
            stand.check(true, &rules, Rule::BrakeTorque).verdict,
            verdict
        );
    }
    stand.motor.brake = None;
    let check = stand.check(true, &rules, Rule::BrakeTorque);
    assert_eq!(check.verdict, RuleVerdict::NotChecked);
    assert!(note(&check).contains("holding brake"), "{}", note(&check));
    stand.gearbox.back_efficiency = 0.0;
    assert!(stand.finding(true, &rules, Rule::BrakeTorque).is_none());
    assert!(stand.warnings(true).iter().all(|w| !w.contains("brake")));
    // 7 N m of friction do not hold 120 N m, 121 N m do.
    let text = HOIST.replace("1 turn", "360 deg");
    let mut held = Stand::new(&text.replace("\"7 N m\"", "\"121 N m\""));
    held.motor.brake = None;
    assert!(held.finding(true, &rules, Rule::BrakeTorque).is_none());
    assert!(held.warnings(true).iter().all(|w| !w.contains("brake")));
    let mut falls = Stand::new(&text.replace("\"7 N m\"", "\"115 N m\""));
    falls.motor.brake = None;
    assert!(falls.finding(true, &rules, Rule::BrakeTorque).is_some());
}

/// At rest the torque of the time course is within the friction band, at the end that the rule judges.
#[test]
fn the_time_course_rests_where_the_rule_says() {
    let stand = hoist();
    let drive = stand.drive(true);
    let rest = stand.duty.instants.iter().find(|i| i.t > 3.0).unwrap();
    assert_eq!(rest.omega, 0.0);
    let torque = drive.motor_point(rest).torque.abs();
    near(
        "at rest",
        torque,
        stand.found(true, Rule::HoldingTorque).value,
        1e-12,
    );
    let most = stand.cycle.mechanics().rest.largest();
    near("most", most, 40.0 / 0.96, 1e-12);
}

/// Weight and friction without acceleration: lifting against both, and the motor's own friction.
#[test]
fn constant_torque() {
    let mut stand = hoist();
    stand.motor.friction = [0.3, 0.002];
    stand.gearbox.no_load_torque = 0.15;
    // The moment drives the shaft: friction of 7 N m and 0.5 N m s/rad opposes it.
    let fastest = stand
        .duty
        .instants
        .iter()
        .map(|i| i.omega.abs())
        .fold(0.0, f64::max);
    let motor_speed = fastest * 3.0 * 5.0;
    let own = 0.3 + 0.15 + 0.002 * motor_speed;
    let fanuc = jred_file::read::rule_set("fanuc", std::path::Path::new("")).unwrap();
    let found = stand.finding(true, &fanuc, Rule::ConstantTorque).unwrap();
    // A process moment is not a constant load: only friction resists, most at full speed.
    let resisting = (7.0 + 0.5 * fastest) / (3.0 * 0.96);
    near(
        "constant torque",
        found.value,
        resisting / (5.0 * 0.95) + own,
        1e-9,
    );
    assert_eq!(found.rating, 9.0);
    let check = stand.check(true, &fanuc, Rule::ConstantTorque);
    near("limit", check.limit.unwrap(), 0.7 * 9.0, 1e-14);
    assert!(check.source.contains("B-65262EN"), "{}", check.source);
    // The general set does not have the rule.
    assert!(!RuleSet::default().shows(Rule::ConstantTorque));
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(6), ..ProptestConfig::default() })]

    /// A gearbox never outputs more power than it gets, in either direction, locking or not; a friction loss is the same both ways: |τ·n|·(1/η − 1).
    #[test]
    fn losses_are_never_gains(
        torque in -100.0f64..100.0, speed in -50.0f64..50.0,
        efficiency in 0.2f64..1.0, by_friction: bool, ratio in 1.0f64..100.0,
    ) {
        let mut stand = hoist_once();
        stand.1.ratio = ratio;
        stand.1.efficiency = efficiency;
        stand.1.back_efficiency = if by_friction { 2.0 - 1.0 / efficiency } else { efficiency };
        stand.1.no_load_torque = 0.0;
        stand.1.inertia = 0.0;
        let drive = Drive { motor: &stand.0, gearbox: Some(&stand.1), amplifier: None };
        let Coefficients([_, forth, back, _, _]) = drive.coefficients();
        let driven = torque * speed < 0.0;
        let motor = if driven { back * torque } else { forth * torque };
        let loss = motor * speed * ratio - torque * speed;
        let size = (torque * speed).abs();
        prop_assert!(loss >= -1e-12 * size, "{loss}");
        let expected = if driven && !by_friction { size * (1.0 - efficiency) } else { size * (1.0 / efficiency - 1.0) };
        prop_assert!((loss - expected).abs() <= 1e-12 * size / efficiency, "{loss} {expected}");
        // At rest the friction band is centred on the lossless torque.
        if by_friction {
            let centre = 0.5 * (forth + back) * torque;
            prop_assert!((centre - torque / ratio).abs() <= 1e-12 * torque.abs());
        }
    }
}

fn hoist_once() -> (
    jred_sizing::catalogue::Motor,
    jred_sizing::catalogue::Gearbox,
) {
    use std::sync::OnceLock;
    static PARTS: OnceLock<(
        jred_sizing::catalogue::Motor,
        jred_sizing::catalogue::Gearbox,
    )> = OnceLock::new();
    let parts = PARTS.get_or_init(|| {
        let stand = hoist();
        (stand.motor, stand.gearbox)
    });
    parts.clone()
}

/// The press holds its weight and its loads at rest, as in every other derivation.
#[test]
fn the_press_is_held() {
    let stand = Stand::new(&press_text());
    let most = stand.cycle.mechanics().rest.largest();
    let hold = stand.duty.hold_torque;
    within("most", most, hold / 0.97, budget::SAME_SUMS);
}

/// The note on friction is given only for a torque: a motor with nothing to hold has none.
#[test]
fn the_torque_at_rest_is_explained() {
    let words = |moment: &str| {
        let text = HOIST
            .replace("1 turn", "360 deg")
            .replace("120 N m", moment);
        let stand = Stand::new(&text);
        stand.check(false, &stand.file.rules, Rule::HoldingTorque)
    };
    let heavy = words("120 N m");
    assert!(heavy.value.unwrap() > 0.0);
    assert!(
        note(&heavy).contains("friction that opposes the motor"),
        "{heavy:?}"
    );
    let light = words("0 N m");
    assert!(light.value.is_none_or(|value| value == 0.0), "{light:?}");
    assert!(
        !note(&light).contains("friction that opposes the motor"),
        "{light:?}"
    );
}

/// If the load drives, friction helps, but only the part present at any speed: τ·η_back/i − c; if it resists, c + b·n is added.
#[test]
fn a_load_that_drives_is_constant_too() {
    let mut stand = hoist();
    stand.motor.friction = [0.3, 0.002];
    let fanuc = jred_file::read::rule_set("fanuc", std::path::Path::new("")).unwrap();
    let fastest = stand.cycle.peak_speed();
    for [resisting, driving] in [[1.0, 60.0], [40.0, 60.0], [0.0, 9.0]] {
        stand.duty.mechanics.constant = [resisting, driving];
        stand.cycle = jred_sizing::cycle::Cycle::new(&stand.duty);
        for geared in [false, true] {
            let [ratio, there, back] = if geared {
                let gearbox = &stand.gearbox;
                [gearbox.ratio, gearbox.efficiency, gearbox.back_efficiency]
            } else {
                [1.0; 3]
            };
            let resists = resisting / (ratio * there) + 0.3 + 0.002 * ratio * fastest;
            let drives = driving * back / ratio - 0.3;
            let found = stand.finding(geared, &fanuc, Rule::ConstantTorque).unwrap();
            near("constant torque", found.value, resists.max(drives), 1e-12);
        }
    }
}

/// While the machine rests the motor may hold its weight, which heats it: (T/M₀)² of the rated losses for the share of the rest.
#[test]
fn a_weight_that_is_held_at_rest_heats() {
    let mut stand = hoist();
    let mut losses = |holding| {
        stand.file.site.duty.operation = Operation::Intermittent {
            operating: 40.0,
            rest: 60.0,
            holding,
        };
        stand.found(true, Rule::WindingTemperature).value
    };
    let [free, held] = [false, true].map(&mut losses);
    let torque = stand.found(true, Rule::HoldingTorque).value;
    near("at rest", held - free, 0.6 * (torque / 9.0).powi(2), 1e-12);
}
