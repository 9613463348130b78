//! The inertia ratio: the judged figure of the curve λ(φ), and limits by moves per minute.

use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;

use super::{Stand, budget, edited, near, press_text};
use jred_report::list::rule_words::note;

#[test]
fn the_judged_figure_is_chosen() {
    let plain = Stand::press();
    let duty = &plain.duty;
    let lambda = |i: &jred_analysis::duty::Instant| (i.input_inertia / 25.0 + 0.8e-4) / 8e-4;
    let total = duty.duration;
    let mean = duty.integral(lambda) / total;
    let expected = [
        (
            "min",
            duty.instants.iter().map(lambda).fold(f64::MAX, f64::min),
        ),
        ("mean", mean),
        ("max", duty.instants.iter().map(lambda).fold(0.0, f64::max)),
    ];
    near(
        "default",
        plain.found(true, Rule::InertiaRatio).value,
        expected[2].1,
        budget::SAME_SUMS,
    );
    for (word, expected) in expected {
        let stand = Stand::new(&format!(
            "{}\n[rules]\ninertia_ratio_of = \"{word}\"\n",
            press_text()
        ));
        near(
            word,
            stand.found(true, Rule::InertiaRatio).value,
            expected,
            budget::SAME_SUMS,
        );
        let check = stand.check(true, &stand.file.rules, Rule::InertiaRatio);
        let words = match word {
            "min" => "smallest λ",
            "mean" => "mean λ",
            _ => "largest λ",
        };
        assert!(note(&check).contains(words), "{}", note(&check));
        // A ratio has no unit: the value is the number itself.
        assert_eq!(check.unit, "");
        near(word, check.value.unwrap(), expected, budget::SAME_SUMS);
    }
    // The RMS of the load's inertia, then reduced.
    let stand = Stand::new(&format!(
        "{}\n[rules]\ninertia_ratio_of = \"rms\"\n",
        press_text()
    ));
    let rms = (duty.integral(|i| i.input_inertia.powi(2)) / total).sqrt();
    let expected = (rms / 25.0 + 0.8e-4) / 8e-4;
    near(
        "rms",
        stand.found(true, Rule::InertiaRatio).value,
        expected,
        budget::SAME_SUMS,
    );
}

/// 3 above 100 moves per minute, 5 above 60, and below that the data sheet's, which is missing here.
#[test]
fn limits_by_moves_per_minute() {
    let set = jred_file::read::rule_set("mitsubishi-mr-j2s", std::path::Path::new("")).unwrap();
    for (pause, moves, limit) in [
        ("100 ms", 120.0, Some(3.0)),
        ("400 ms", 75.0, Some(5.0)),
        ("2 s", 25.0, None),
    ] {
        let stand = Stand::new(&edited(
            &press_text(),
            "dwell = \"0.1 s\"",
            &format!("dwell = \"{pause}\""),
        ));
        near(
            "moves",
            stand.cycle.mechanics().move_rate * 60.0,
            moves,
            1e-9,
        );
        let check = stand.check(true, &set, Rule::InertiaRatio);
        assert_eq!(check.limit, limit, "{pause}");
        assert!(
            note(&check).contains(&format!("{moves} moves per minute")),
            "{}",
            note(&check)
        );
        if limit.is_none() {
            assert_eq!(check.verdict, RuleVerdict::NotChecked);
        }
    }
}
