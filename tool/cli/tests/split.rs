//! `jred split`: the optimum, the curve and what is refused.

use crate::support::{Columns, jred, near, near_column, squeezed, within};

const PINION: &str = "0.2 kg cm^2";

#[test]
fn two_equal_pinions_follow_the_textbook() {
    let run = jred([
        &"split",
        &"--ratio",
        &"40",
        &"--stages",
        &"2",
        &"--pinion",
        &PINION,
        &"--max-ratio",
        &"100",
        &"--format",
        &"json",
    ])
    .ends(0);
    let json = run.json();
    let ratio = |k: usize| json["optimum"]["ratios"][k].as_f64().unwrap();
    // i₂² = (i₁⁴ − 1)/2
    near(
        "i2²",
        ratio(1).powi(2),
        (ratio(0).powi(4) - 1.0) / 2.0,
        1e-12,
    );
    near("i", ratio(0) * ratio(1), 40.0, 1e-13);
    let (first, pinion) = (ratio(0), 0.2e-4);
    let inertia = pinion * (1.0 + first.powi(2) + first.powi(-2) + 1600.0 / first.powi(4));
    near(
        "J",
        json["optimum"]["J_red_kg_m2"].as_f64().unwrap(),
        inertia,
        1e-13,
    );
    let equal = pinion * (1.0 + 40.0 + 1.0 / 40.0 + 1.0);
    near(
        "J equal",
        json["equal"]["J_red_kg_m2"].as_f64().unwrap(),
        equal,
        1e-13,
    );
    assert_eq!(json["equal_within_bounds"], true);
}

/// The curve passes through the bounds, its rows multiply to the ratio, and none lies below the optimum.
#[test]
fn the_curve_has_its_minimum_at_the_optimum() {
    let arguments = |format: &'static str| {
        jred([
            &"split",
            &"--ratio",
            &"90",
            &"--stages",
            &"3",
            &"--pinion",
            &PINION,
            &"--pinion",
            &"0.5 kg cm^2",
            &"--pinion",
            &"1 kg cm^2",
            &"--load",
            &"0.02 kg m^2",
            &"--points",
            &"61",
            &"--format",
            &format,
        ])
        .ends(0)
    };
    let json = arguments("json").json();
    let best = json["optimum"]["J_red_kg_m2"].as_f64().unwrap();
    let columns = Columns::of_csv(&arguments("csv").out);
    assert_eq!(
        columns.names,
        ["i1", "i2", "i3", "J_red [kg m^2]", "J_red of the smallest"]
    );
    let [i1, i2, i3] = ["i1", "i2", "i3"].map(|name| columns.get(name));
    let (inertia, share) = (
        columns.get("J_red [kg m^2]"),
        columns.get("J_red of the smallest"),
    );
    assert_eq!(i1.len(), 61);
    within("first", i1[0], 1.0, 1e-12);
    within("last", i1[60], 10.0, 1e-12);
    for k in 0..61 {
        near("product", i1[k] * i2[k] * i3[k], 90.0, 1e-12);
        near("share", share[k], inertia[k] / best, 1e-13);
        assert!(share[k] >= 1.0 - 1e-13);
    }
    let least = share.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least < 1.01, "{least}");
    let same = Columns::of_json(&json);
    for name in &columns.names {
        near_column(name, &same.get(name), &columns.get(name), 1e-15);
    }
}

#[test]
fn the_table_says_what_the_equal_split_costs() {
    let run = jred([
        &"split",
        &"--ratio",
        &"40",
        &"--stages",
        &"2",
        &"--pinion",
        &PINION,
        &"--points",
        &"5",
    ])
    .ends(0);
    for words in [
        "total ratio 40 over 2 stages, each from 1 to 10",
        "J = J_pinion·i⁴",
        "optimum i = 4 · 10,",
        "equal split i = 6.32456 · 6.32456, J_red = 0.0008405 kg m^2 at the input",
        "% more",
    ] {
        let text = squeezed(&run.out);
        assert!(text.contains(words), "{words:?} is not in\n{text}");
    }
    let constant = jred([
        &"split",
        &"--ratio",
        &"20",
        &"--stages",
        &"2",
        &"--pinion",
        &PINION,
        &"--driven",
        &"4 kg cm^2",
    ])
    .ends(0);
    // Wheels that do not grow: all the ratio in front, up to the bound.
    assert!(
        squeezed(&constant.out).contains("optimum i = 10 · 2,"),
        "{}",
        constant.out
    );
    assert!(squeezed(&constant.out).contains("driven wheels with the given inertia"));
}

#[test]
fn wrong_options_are_refused_with_their_cure() {
    let refused = |more: &[&str], words: &[&str]| {
        let mut arguments = vec!["split"];
        arguments.extend(more);
        let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_jred"))
            .env("NO_COLOR", "1")
            .env("JRED_PROGRESS", "never")
            .args(&arguments)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        let text = String::from_utf8(output.stderr).unwrap();
        let text: Vec<&str> = text
            .split_whitespace()
            .filter(|word| *word != "│")
            .collect();
        let text = text.join(" ");
        for word in words {
            assert!(text.contains(word), "{word:?} is not in\n{text}");
        }
    };
    refused(
        &["--ratio", "2000", "--stages", "3", "--pinion", PINION],
        &[
            "total ratio is 2000, outside 1 to 1000",
            "--max-ratio",
            "--stages",
        ],
    );
    refused(
        &["--ratio", "0.5", "--stages", "3", "--pinion", PINION],
        &["total ratio is 0.5, outside 1 to 1000", "--min-ratio"],
    );
    refused(
        &["--ratio", "NaN", "--stages", "3", "--pinion", PINION],
        &["it must be a number up to 1e6"],
    );
    refused(
        &["--ratio", "40", "--stages", "5", "--pinion", PINION],
        &["5 is not in 2..=4"],
    );
    refused(
        &[
            "--ratio", "40", "--stages", "3", "--pinion", PINION, "--pinion", PINION,
        ],
        &["--pinion is given 2 times for 3 stages", "once for each"],
    );
    refused(
        &["--ratio", "40", "--stages", "3", "--pinion", "0.2"],
        &["has no unit", "kg m^2"],
    );
    refused(&["--ratio", "40", "--stages", "3"], &["--pinion"]);
    for ratio in ["1e300", "inf", "nan", "1e7"] {
        let given = ["--ratio", ratio, "--stages", "2", "--pinion", PINION];
        refused(&given, &["--ratio", "it must be a number up to 1e6"]);
    }
    refused(
        &[
            "--ratio",
            "40",
            "--stages",
            "2",
            "--pinion",
            PINION,
            "--min-ratio",
            "5",
            "--max-ratio",
            "4",
        ],
        &[
            "largest stage ratio is 4, less than 5",
            "--max-ratio at least",
        ],
    );
}
