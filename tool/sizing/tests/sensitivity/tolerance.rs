//! Monte Carlo: draws, and probabilities in closed form.

use super::{RACK, study};
use crate::support::{near, within};
use jred_file::model::rule::Rule;
use jred_file::model::tolerance::Tolerance;
use jred_file::units::RPM;
use jred_sizing::cell::Cell;
use jred_sizing::select::filter::Filter;
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::common::Study;
use jred_sizing::study::task::RowSource as _;
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
    one: &'s ChosenDrive,
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
        unknown: Vec::new(),
        count,
        seed: 7,
    }
}

/// Samples have the mean and the deviation of the file, independent of their order.
#[test]
fn draws_have_their_moments() {
    const N: u64 = 40_000;
    let (_folder, study) = study(RACK, 64);
    let one = ChosenDrive::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
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

/// The speed's share of its limit is proportional to the speed: with ±20 % about a share of 0.89 the rule is satisfied in (1/0.89 − 1 + 0.2)/0.4 of
/// all machines.
#[test]
fn a_probability_in_closed_form() {
    const N: u64 = 2000;
    let conveyor = include_str!("../../../../machines/conveyor.toml");
    let text = format!(
        "{conveyor}\n[rules]\nspeed = \"50 %\"\ninertia_ratio = 900\ninertia_ratio_warning = 900\n"
    );
    let (_folder, study) = study(&text, 16);
    let one = ChosenDrive::choose(&study, Some("strong+five"), &Filter::default(), None).unwrap();
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

/// A quantity has one tolerance in a machine file, and one on the command line, which replaces that of the file.
#[test]
fn a_quantity_has_one_tolerance() {
    let text = |lines: &str| format!("{RACK}\n[tolerance]\n{lines}\n");
    let given = |text: &str| Tolerance::parse("rack.mass", text).unwrap();
    let (_folder, once) = study(&text("\"rack.mass\" = \"5 %\""), 16);
    let all = Scatter::all(&once, &[given("2 %")]).unwrap();
    assert_eq!(all.len(), 1);
    within("amount", all[0].amount, 0.02 * 85.0, 1e-12);
    let refused = |study: &Study, tolerances: &[Tolerance]| {
        let refused = Scatter::all(study, tolerances).unwrap_err();
        let report = format!("{:?}", miette::Report::new(refused));
        assert!(
            report.contains("mechanism.rack.mass has two tolerances"),
            "{report}"
        );
        report
    };
    refused(&once, &[given("2 %"), given("3 %")]);
    let (_folder, twice) = study(
        &text("\"rack.mass\" = \"5 %\"\n\"mechanism.rack.mass\" = \"50 %\""),
        16,
    );
    let report = refused(&twice, &[]);
    for line in [
        "\"rack.mass\" = \"5 %\"",
        "\"mechanism.rack.mass\" = \"50 %\"",
        "the first",
        "the second",
    ] {
        assert!(report.contains(line), "{line} is not in {report}");
    }
}
