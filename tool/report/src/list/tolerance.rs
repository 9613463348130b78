//! A Monte Carlo study of a drive as a sheet.

use crate::answer::sheet::Sheet;
use crate::table::reading::Reading;
use jred_file::model::rules::RuleSet;
use jred_file::number::rounding::short;
use jred_file::number::words::counted;
use jred_sizing::cell::Cell;
use jred_sizing::study::tolerance::Samples;
use jred_sizing::study::tolerance::summary::{Probability, Summary, quantile};

/// Name and version of the form in JSON, and its columns.
pub(crate) const FORM: &str = "jred-tolerance/1";
pub(crate) const COLUMNS: [&str; 9] = [
    "rule",
    "machines that hold it [%]",
    "surely above [%]",
    "surely below [%]",
    "5 % of machines use at most",
    "50 % of machines use at most",
    "95 % of machines use at most",
    "99 % of machines use at most",
    "largest use",
];

/// The columns for reading.
const READING: [&str; 9] = [
    "rule",
    "machines that satisfy it [%]",
    "95 % interval from [%]",
    "95 % interval to [%]",
    "5 % of machines use at most",
    "50 % of machines use at most",
    "95 % of machines use at most",
    "99 % of machines use at most",
    "largest use",
];

/// Every rule with the share of machines that satisfy it; `rules` are those of the machine.
pub fn sheet(samples: &Samples, summary: &Summary, rules: &RuleSet) -> Sheet {
    let built = summary.built();
    let words = samples.one.drive().motor.kind.vocabulary();
    let probability = |k: u64| -> Vec<Cell> {
        let p = Probability::new(k, built);
        let percent = |x: Option<f64>| Cell::from(x.map(|x| x * 100.0));
        vec![
            percent(p.map(|p| p.share)),
            percent(p.map(|p| p.interval[0])),
            percent(p.map(|p| p.interval[1])),
        ]
    };
    let mut rows = vec![{
        let mut cells = vec!["every rule".into()];
        cells.extend(probability(summary.hold));
        cells.resize(COLUMNS.len(), Cell::Empty);
        cells
    }];
    for (rule, shares) in samples.rules.iter().zip(&summary.shares) {
        let mut sorted = shares.clone();
        sorted.sort_by(f64::total_cmp);
        let within = sorted.iter().filter(|used| **used <= 1.0).count() as u64;
        let warns = rules.limit(*rule).fail.is_none();
        let name = if warns {
            format!("{} (warning)", rule.named(words))
        } else {
            rule.named(words).to_owned()
        };
        let mut cells = vec![name.into()];
        cells.extend(probability(within));
        cells.extend(
            [0.05, 0.5, 0.95, 0.99, 1.0].map(|part| match quantile(&sorted, part) {
                Some(used) if used.is_infinite() => "no limit".into(),
                used => Cell::from(used),
            }),
        );
        rows.push(cells);
    }
    let scattering: Vec<String> = (samples.scatters.iter())
        .map(|s| {
            format!(
                "{} {} ± {} {}",
                s.path,
                s.shape.name(),
                short(s.amount),
                s.unit
            )
        })
        .collect();
    let mut notes = vec![
        format!("scattering: {}", scattering.join("; ")),
        format!(
            "use: share of the limit, 1 is the limit; 95 % interval: Wilson's confidence interval of the probability; shares are \
             of {built} machines"
        ),
    ];
    if summary.refused > 0 {
        notes.push(format!(
            "not counted, because they cannot be built: {} of {} drawn; --out FILE writes the reason for each",
            summary.refused,
            counted(summary.machines as usize, "machine", "machines")
        ));
    }
    if summary.unchecked > 0 {
        notes.push(format!(
            "in {} a rule cannot be checked: this counts as a violation",
            counted(summary.unchecked as usize, "machine", "machines")
        ));
    }
    if !samples.unknown.is_empty() {
        let unknown: Vec<&str> = samples
            .unknown
            .iter()
            .map(|rule| rule.named(words))
            .collect();
        notes.push(format!("not checked, data missing: {}", unknown.join(", ")));
    }
    Sheet {
        schema: FORM,
        title: format!(
            "{}: {}, {}, seed {}",
            samples.study.nominal.title,
            samples.one.name(),
            counted(summary.machines as usize, "machine", "machines"),
            samples.seed
        ),
        reading: Some(Reading::new(READING, rows.clone(), 1)),
        columns: COLUMNS.map(str::to_owned).to_vec(),
        rows,
        notes,
        lead: 0,
    }
}
