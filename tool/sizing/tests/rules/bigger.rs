//! A stronger motor with the same rotor is never judged worse by a rule about torque.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_sizing::catalogue::{Catalogue, Motor, Winding};

use super::Stand;

const TORQUE_RULES: [Rule; 3] = [Rule::RmsTorque, Rule::PeakTorque, Rule::HoldingTorque];

/// The same motor with all torques and the power multiplied.
fn stronger(motor: &Motor, times: f64) -> Motor {
    let more = |figure: Option<f64>| figure.map(|x| times * x);
    let curve = |points: &[[f64; 2]]| points.iter().map(|[n, m]| [*n, times * m]).collect();
    Motor {
        rated_torque: more(motor.rated_torque),
        standstill_torque: more(motor.standstill_torque),
        peak_torque: more(motor.peak_torque),
        max_power: more(motor.max_power),
        torque_at_max_speed: more(motor.torque_at_max_speed),
        peak_curve: curve(&motor.peak_curve),
        continuous_curve: curve(&motor.continuous_curve),
        // The figures above give the envelope, so it scales with them.
        winding: Winding::default(),
        ..motor.clone()
    }
}

/// Verdict and used share of each rule that applies.
fn judged(stand: &Stand, geared: bool) -> Vec<(Rule, RuleVerdict, f64)> {
    let found = TORQUE_RULES.into_iter().filter_map(|rule| {
        let finding = stand.finding(geared, &stand.file.rules, rule)?;
        let verdict = stand.check(geared, &stand.file.rules, rule).verdict;
        Some((rule, verdict, finding.value / finding.rating))
    });
    found.collect()
}

#[test]
fn a_stronger_motor_never_turns_a_pass_into_a_fail() {
    let mut stand = Stand::press();
    let motors = Catalogue::load(None, None).unwrap().motors;
    let (mut smaller, mut turned) = (0, 0);
    for (motor, geared) in motors
        .iter()
        .flat_map(|motor| [(motor, false), (motor, true)])
    {
        stand.motor = stronger(motor, 1.0);
        let mut before = judged(&stand, geared);
        for times in [1.01, 1.4, 3.0, 20.0] {
            stand.motor = stronger(motor, times);
            let now = judged(&stand, geared);
            assert_eq!(now.len(), before.len());
            for ((rule, verdict, used), (_, then, was)) in now.iter().zip(&before) {
                let what = format!("{}, {rule:?}, {times} times as strong", motor.key);
                assert!(verdict <= then, "{what}: {verdict:?} after {then:?}");
                assert_eq!(used.is_nan(), was.is_nan(), "{what}");
                assert!(used.is_nan() || used <= was, "{what}: {used} after {was}");
                smaller += usize::from(used < was);
                turned += usize::from(verdict < then);
            }
            before = now;
        }
    }
    println!("{smaller} figures smaller, {turned} verdicts better");
    // The test must contain changes.
    assert!(smaller > 4 * motors.len() && turned > motors.len() / 4);
}
