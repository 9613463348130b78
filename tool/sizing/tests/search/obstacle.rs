//! Why no ratio satisfies every rule.

use jred_file::model::rule::Rule;
use jred_file::model::rules::Limit;
use jred_file::model::rules::RuleVerdict;
use jred_sizing::select::ratio::Moments;
use jred_sizing::select::ratio::obstacle::Obstacle;
use jred_sizing::select::ratio::ranges::Trial;

use super::ratio::GEARS;
use super::{case, catalogue};
use crate::support::{budget, near, press_text};

/// If no ratio satisfies every rule, the reason is correct: on a grid ten times as fine the named rule is violated everywhere by the reported amount,
/// or the two rules are satisfied only on their sides of a gap.
#[test]
#[ignore = "more than five seconds of a processor"]
fn reasons_where_no_ratio_holds() {
    let catalogue = catalogue();
    let mut seen = [0usize; 3];
    for (text, speed) in [
        (press_text(), Limit::default()),
        (
            press_text().replacen("\"-10 kN\"", "\"-40 kN\"", 1),
            Limit::default(),
        ),
        (
            press_text(),
            Limit {
                fail: Some(0.3),
                warn: None,
            },
        ),
    ] {
        let mut case = case(&text, 100);
        if speed.fail.is_some() {
            case.file.rules.set(Rule::Speed, speed);
        }
        let prepared = catalogue.prepare(&case.file.site);
        let rules = &case.file.rules;
        for (motor, limits) in catalogue.motors.iter().zip(&prepared) {
            let trial = Trial {
                cycle: &case.cycle,
                site: &case.file.site,
                rules,
                motor,
                prepared: limits,
                gear: GEARS[1],
            };
            let best = Moments::new(&case.duty, motor, GEARS[1]).best_ratio();
            let Some(obstacle) = trial.obstacle(best) else {
                assert!(!trial.ranges(best).is_empty(), "{}", motor.key);
                continue;
            };
            assert!(trial.ranges(best).is_empty(), "{}", motor.key);
            let holds = |rule: Rule, ratio: f64| {
                let finding = trial.findings(ratio).get(rule).unwrap();
                rules.verdict(rule, finding) != RuleVerdict::Fail
            };
            let used = |rule: Rule, ratio: f64| {
                rules.use_of_limit(rule, trial.findings(ratio).get(rule).unwrap())
            };
            let fine = || (0..6000).map(|k| 0.01 * 1e6f64.powf(f64::from(k) / 6000.0));
            match obstacle {
                Obstacle::Always {
                    rule,
                    used: least,
                    ratio,
                } => {
                    assert!(
                        least > 1.0 && fine().all(|i| !holds(rule, i)),
                        "{}: {obstacle:?}",
                        motor.key
                    );
                    if least.is_infinite() {
                        // A motor without the brake that the machine needs: the limit is zero.
                        assert!(rule == Rule::BrakeTorque && used(rule, ratio).is_infinite());
                        continue;
                    }
                    near("least", used(rule, ratio), least, 1e-14);
                    let found = fine().map(|i| used(rule, i)).fold(f64::INFINITY, f64::min);
                    near(&motor.key, least, found, budget::LEAST_USE);
                    seen[0] += 1;
                }
                Obstacle::Apart { least, most } => {
                    assert!(
                        least.1 > most.1 && least.0 != most.0,
                        "{}: {obstacle:?}",
                        motor.key
                    );
                    assert!(
                        fine().all(|i| i >= least.1 || !holds(least.0, i)),
                        "{}",
                        motor.key
                    );
                    assert!(
                        fine().all(|i| i <= most.1 || !holds(most.0, i)),
                        "{}",
                        motor.key
                    );
                    assert!(
                        holds(least.0, least.1 * (1.0 + 1e-9))
                            && holds(most.0, most.1 * (1.0 - 1e-9))
                    );
                    seen[1] += 1;
                }
                Obstacle::Together { .. } => seen[2] += 1,
            }
        }
    }
    assert!(seen[0] > 10 && seen[1] > 5, "{seen:?}");
}
