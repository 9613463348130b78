//! Monte Carlo: draws, probabilities in closed form, shares, messages.

use std::path::Path;

use super::{RACK, study};
use crate::support::{Folder, jred, near, press_text, within};
use jred_machine::model::rule::Rule;
use jred_machine::model::tolerance::Tolerance;
use jred_machine::units::RPM;
use jred_sizing::select::filter::Filter;
use jred_sizing::study::cell::Cell;
use jred_sizing::study::common::Study;
use jred_sizing::study::one::One;
use jred_sizing::study::task::Task as _;
use jred_sizing::study::tolerance::summary::{Probability, quantile};
use jred_sizing::study::tolerance::{Samples, Scatter};

/// Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine 17 (1998), table I, method 3.
#[test]
fn wilsons_interval_of_published_cases() {
    for (k, n, from, to) in [
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ] {
        let [low, high] = Probability::new(k, n).unwrap().interval;
        within("from", low, from, 5e-5);
        within("to", high, to, 5e-5);
    }
    assert_eq!(Probability::new(0, 0), None);
    let sorted = [1.0, 2.0, 4.0, 8.0];
    assert_eq!(quantile(&sorted, 0.5), Some(3.0));
    assert_eq!(quantile(&sorted, 0.0), Some(1.0));
    assert_eq!(quantile(&sorted, 1.0), Some(8.0));
    assert_eq!(quantile(&[], 0.5), None);
}

fn samples<'s>(
    study: &'s Study,
    one: &'s One,
    tolerances: &[(&str, &str)],
    count: u64,
) -> Samples<'s> {
    let scatter = |(path, text): &(&str, &str)| {
        Scatter::new(study, &Tolerance::parse(path, text).unwrap()).unwrap()
    };
    Samples {
        study,
        one,
        scatters: tolerances.iter().map(scatter).collect(),
        rules: vec![Rule::Speed],
        count,
        seed: 7,
    }
}

/// Draws have the mean and the spread that the file says, and do not depend on each other's order.
#[test]
fn draws_have_their_moments() {
    const N: u64 = 40_000;
    let (_folder, study) = study(RACK, 64);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let samples = samples(
        &study,
        &one,
        &[("rack.mass", "normal 2 %"), ("pinion.radius", "±0.3 mm")],
        N,
    );
    let values: Vec<Vec<f64>> = (0..N).map(|k| samples.values(k)).collect();
    assert_eq!(samples.values(123), values[123]);
    let moments = |k: usize| {
        let mean = values.iter().map(|v| v[k]).sum::<f64>() / N as f64;
        let variance = values.iter().map(|v| (v[k] - mean).powi(2)).sum::<f64>() / N as f64;
        (mean, variance.sqrt())
    };
    // Five standard errors: σ/√n of the mean, σ/√(2n) of the deviation and less for a bounded one.
    let (mean, deviation) = moments(0);
    within("mass", mean, 85.0, 5.0 * 1.7 / 200.0);
    within(
        "its deviation",
        deviation,
        1.7,
        5.0 * 1.7 / (2.0 * 40_000.0f64).sqrt(),
    );
    let (mean, deviation) = moments(1);
    let sigma = 0.3 / 3.0f64.sqrt();
    within("radius", mean, 30.0, 5.0 * sigma / 200.0);
    within(
        "its deviation",
        deviation,
        sigma,
        5.0 * sigma / (2.0 * 40_000.0f64).sqrt(),
    );
    assert!(values.iter().all(|v| (29.7..=30.3).contains(&v[1])));
    let correlation = values
        .iter()
        .map(|v| (v[0] - 85.0) / 1.7 * (v[1] - 30.0) / sigma)
        .sum::<f64>()
        / N as f64;
    within("correlation", correlation, 0.0, 5.0 / 200.0);
}

/// The speed's share of its limit is proportional to the speed: with ±20 % about a share of 0.89 it holds in
/// (1/0.89 − 1 + 0.2)/0.4 of all machines.
#[test]
fn a_probability_in_closed_form() {
    const N: u64 = 2000;
    let conveyor = include_str!("../../../../machines/conveyor.toml");
    let text = format!(
        "{conveyor}\n[rules]\nspeed = \"50 %\"\ninertia_ratio = 900\ninertia_ratio_warning = 900\n"
    );
    let (_folder, study) = study(&text, 16);
    let one = One::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
    let samples = samples(&study, &one, &[("motion.speed", "20 %")], N);
    let mut hold = 0;
    for k in 0..N {
        let row = samples.row(k);
        let speed = row[0].number().unwrap();
        let share = speed * RPM * 5.0 / 500.0;
        near("share", row[3].number().unwrap(), share, 1e-12);
        assert_eq!(row[1] == Cell::from("holds"), share <= 1.0);
        hold += u64::from(share <= 1.0);
    }
    let share = 850.0 * RPM * 5.0 / 500.0;
    let expected = (1.0 / share - 1.0 + 0.2) / 0.4;
    let found = Probability::new(hold, N).unwrap();
    let deviation = (expected * (1.0 - expected) / N as f64).sqrt();
    within("probability", found.share, expected, 4.0 * deviation);
}

/// The command: the table of the file, shares that merge to the whole, a summary from the merged file.
#[test]
fn the_command_sums_up_shares_as_one_run() {
    let folder = Folder::new();
    let text = press_text()
        + "\n[tolerance]\n\"slider.mass\" = \"±5 %\"\n\"crank.length\" = { normal = \"0.1 mm\" }\n";
    let press = folder.file("press.toml", text);
    let [whole, merged] = ["whole.csv", "merged.csv"].map(|name| folder.path(name));
    let run = |out: &Path, more: &[&str], code: i32| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_jred"));
        command.arg("tolerance").arg(&press).args([
            "--samples",
            "60",
            "--steps",
            "64",
            "--tolerance",
            "drive_train.0.belt_mass=10%",
        ]);
        let output = command.args(more).arg("--out").arg(out).output().unwrap();
        assert!(
            output.status.code() == Some(code) || code < 0,
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).unwrap()
    };
    let summary = run(&whole, &[], -1);
    assert!(
        summary.contains("60 machines, seed 1") && summary.contains("every rule"),
        "{summary}"
    );
    assert!(
        summary.contains("mechanism.slider.mass uniform ± 2.1 kg"),
        "{summary}"
    );
    assert!(
        summary.contains("mechanism.crank.length normal ± 0.1 mm"),
        "{summary}"
    );
    let parts: Vec<_> = (0..2)
        .map(|k| {
            let part = folder.path(&format!("part-{k}.csv"));
            let share = run(&part, &["--shard", &format!("{k}/2")], -1);
            assert!(
                share.contains("30 machines") && share.contains("one share"),
                "{share}"
            );
            part
        })
        .collect();
    jred([&"merge", &merged, &parts[0], &parts[1]]).ends(0);
    assert_eq!(
        std::fs::read(&merged).unwrap(),
        std::fs::read(&whole).unwrap()
    );
    assert_eq!(run(&merged, &["--resume"], -1), summary);
    // Another seed is another study.
    let other = run(&merged, &["--resume", "--seed", "2"], 2);
    assert!(other.is_empty(), "{other}");
}

/// Draws that cannot be built are counted apart: of the others the share that holds a rule is that of the rows.
#[test]
fn draws_that_cannot_be_built_are_counted_apart() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let out = folder.path("rows.csv");
    // A crank longer than the rod cannot turn.
    let run = jred([
        &"tolerance",
        &press,
        &"--steps",
        &"64",
        &"--samples",
        &"80",
        &"--seed",
        &"3",
        &"--tolerance",
        &"crank.length=normal:100mm",
        &"--out",
        &out,
    ])
    .ends(1);
    let text = std::fs::read_to_string(&out).unwrap();
    let refused = text
        .lines()
        .filter(|line| line.contains("machine refused"))
        .count();
    assert!((5..75).contains(&refused), "{refused}");
    let built = 80 - refused;
    let words = format!("{refused} of 80 machines drawn cannot be built");
    assert!(run.out.contains(&words), "{words}: {}", run.out);
    assert!(
        run.out.contains(&format!("shares are of {built} machines")),
        "{}",
        run.out
    );
    // The speed does not depend on the crank: it holds in all that could be built.
    let speed = run
        .out
        .lines()
        .find(|line| line.starts_with(" speed"))
        .unwrap();
    assert_eq!(speed.split_whitespace().nth(1), Some("100"), "{speed}");
    let header: Vec<&str> = run
        .out
        .lines()
        .skip(1)
        .take_while(|line| !line.contains('─'))
        .collect();
    let header = header.join(" ");
    for word in ["95 %", "use at", "machines", "interval"] {
        assert!(header.contains(word), "{word}: {header}");
    }
    let csv = jred([
        &"tolerance",
        &press,
        &"--steps",
        &"16",
        &"--samples",
        &"2",
        &"--tolerance",
        &"slider.mass=5%",
        &"--format",
        &"csv",
    ]);
    assert!(csv.out.starts_with("rule,machines that hold it [%],surely above [%],surely below [%],5 % of machines use at most,"), "{}", csv.out);
    for line in run.out.lines().skip(1).take(16) {
        assert!(line.chars().count() <= 120, "{line}");
    }
}

#[test]
fn wrong_tolerances_are_said() {
    let folder = Folder::new();
    let press =
        |line: &str| folder.file("press.toml", press_text() + "\n[tolerance]\n" + line + "\n");
    let says = |line: &str, words: &[&str]| jred([&"tolerance", &press(line)]).ends(2).says(words);
    says(
        "\"slider.mass\" = \"5\"",
        &["has no unit", "write \"±5 %\""],
    );
    says("\"slider.mass\" = \"-5 %\"", &["must be greater than zero"]);
    says(
        "\"slider.mass\" = \"5 mm\"",
        &["mechanism.slider.mass", "42 kg", "cannot be 5 mm"],
    );
    says(
        "\"slider.mas\" = \"5 %\"",
        &[
            "no quantity \"slider.mas\"",
            "did you mean \"slider.mass\"?",
        ],
    );
    says(
        "\"slider.mass\" = { gauss = \"5 %\" }",
        &["unknown key `gauss`"],
    );
    says("\"slider.mass\" = 5", &["must be a text"]);
    says("\"gravity.1\" = \"5 %\"", &["is a share of zero"]);
    let none = folder.file("none.toml", press_text());
    jred([&"tolerance", &none])
        .ends(2)
        .says(&["no quantity has a tolerance", "[tolerance]"]);
    let argument = jred([&"tolerance", &none, &"--tolerance", &"slider.mass"]);
    argument.ends(2).says(&["has no \"=\""]);
    let drive = jred([&"sensitivity", &none, &"--drive", &"sgmsh-10"]);
    drive.ends(2).says(&["no \"sgmsh-10\"", "did you mean"]);
}
