//! Why no ratio holds every rule, and the table that says so.

use jred_machine::model::rule::Rule;
use jred_machine::model::rules::Limit;
use jred_machine::model::rules::Verdict;
use jred_sizing::select::ratio::Moments;
use jred_sizing::select::ratio::obstacle::Obstacle;
use jred_sizing::select::ratio::ranges::Trial;

use super::ratio::GEARS;
use super::{case, catalogue};
use crate::support::{budget, jred, near, press_file, press_text};

/// Where no ratio holds every rule, the reason is the true one: over a grid ten times as fine the named rule is broken
/// everywhere and by as much as said, or the two rules hold on their sides of a gap only.
#[test]
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
                rules.verdict(rule, finding) != Verdict::Fail
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
            assert!(!obstacle.words().is_empty());
        }
    }
    assert!(seen[0] > 10 && seen[1] > 5, "{seen:?}");
}

/// The table fits on a page, says why there is no range, and can be cut to what is asked for.
#[test]
fn the_table_of_ratios_is_narrow_and_can_be_cut() {
    let press = press_file();
    let full = jred([&"ratio", &press]).ends(0).out;
    let table = |text: &str| -> Vec<String> {
        let lines = text.lines().skip(1);
        lines
            .take_while(|l| !l.starts_with("alpha:"))
            .map(str::to_owned)
            .collect()
    };
    let lines = table(&full);
    assert!(lines.len() > 30);
    for line in &lines {
        assert!(
            line.chars().count() <= 120,
            "{} columns: {line}",
            line.chars().count()
        );
    }
    let rows = jred([&"ratio", &press, &"--format", &"json"])
        .ends(0)
        .json();
    let rows = rows["rows"].as_array().unwrap();
    let mut reasons = 0;
    for row in rows {
        assert_eq!(
            row["ratio from"].is_null(),
            row["why none"].is_string(),
            "{row}"
        );
        reasons += usize::from(row["why none"].is_string());
    }
    assert!(reasons > 3, "{reasons}");
    let cut = jred([&"ratio", &press, &"--top", &"2", &"--format", &"json"])
        .ends(0)
        .json();
    let held: Vec<_> = rows
        .iter()
        .filter(|row| row["why none"].is_null())
        .take(2)
        .collect();
    assert_eq!(
        cut["rows"].as_array().unwrap().iter().collect::<Vec<_>>(),
        held
    );
    let notes = cut["notes"].to_string();
    assert!(
        notes.contains(&format!("motors without a suitable ratio: {reasons}")),
        "{notes}"
    );
    let some = jred([&"ratio", &press, &"--motor", &"FXM*", &"--format", &"json"])
        .ends(0)
        .json();
    let some = some["rows"].as_array().unwrap();
    let named = |row: &&serde_json::Value| row["motor"].as_str().unwrap().starts_with("fxm");
    assert_eq!(some.len(), rows.iter().filter(named).count());
    assert!(some.iter().all(|row| named(&row)) && !some.is_empty());
    jred([&"ratio", &press, &"--motor", &"nobody*"])
        .ends(2)
        .says(&["passes the filter"]);
    jred([&"ratio", &press, &"--top", &"0"]).ends(2);
}
