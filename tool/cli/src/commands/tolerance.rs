//! `jred tolerance`.

use miette::{Result, miette};

use crate::commands::vary::{stopped, study};
use crate::commands::{Done, print};
use crate::options::search::Tolerance as Options;
use crate::rows::run::run;
use jred_machine::model::rules::{Limit, RuleSet};
use jred_machine::model::tolerance::Tolerance;
use jred_report::table::output::Format;
use jred_report::table::rows::Form;
use jred_report::table::sheet::{Reading, Sheet};
use jred_sizing::study::cell::Cell;
use jred_sizing::study::common::Study;
use jred_sizing::study::one::One;
use jred_sizing::study::tolerance::summary::{Probability, Summary, quantile};
use jred_sizing::study::tolerance::{Samples, Scatter};

/// Runs `jred tolerance`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn tolerance(options: &Options) -> Result<Done> {
    let filter = options.search.filter();
    let study = study(&options.file, &options.supply, &filter)?;
    options.search.check(&study.catalogue, &[])?;
    let scatters = scatters(&study, &options.tolerance)?;
    let one = One::choose(
        &study,
        options.drive.as_deref(),
        &filter,
        options.search.rank,
    )?;
    let machine = study.machine(&[])?;
    let findings = one.findings(&machine);
    let limits = &machine.file.rules;
    let known = findings
        .iter()
        .filter(|(rule, finding)| finding.is_known() && limits.limit(*rule) != Limit::default());
    let samples = Samples {
        study: &study,
        one: &one,
        scatters,
        rules: known.map(|(rule, _)| rule).collect(),
        count: options.samples,
        seed: options.seed,
    };
    let words = one.drive().motor.kind.vocabulary();
    let unknown: Vec<&str> = findings
        .iter()
        .filter(|(_, f)| !f.is_known())
        .map(|(rule, _)| rule.named(words))
        .collect();
    let mut plan = options.rows.plan();
    // Without a file the summary is what is printed; rows go to a file.
    let format = match plan.form {
        Form::Table => Format::Table,
        Form::Csv => Format::Csv,
        Form::Json => Format::Json,
    };
    if plan.out.is_none() {
        plan.form = Form::Table;
    }
    let mut summary = Summary::new(samples.scatters.len(), samples.rules.len());
    let ended = run(&samples, &plan, &mut |_, cells| summary.add(cells))?;
    let rules = &machine.file.rules;
    let mut sheet = sheet(&samples, &summary, rules);
    if !unknown.is_empty() {
        sheet
            .notes
            .push(format!("not checked, data missing: {}", unknown.join(", ")));
    }
    if plan.shard.is_some() {
        sheet.notes.push(
            "this is one share; after `jred merge`, run the same command with --out and --resume, without --shard, for the summary of all"
                .to_owned(),
        );
    }
    print(&sheet.write(if plan.out.is_some() {
        Format::Table
    } else {
        format
    }))?;
    if !ended.is_complete() {
        return stopped(ended, &plan);
    }
    Ok(if summary.hold == summary.machines {
        Done::Holds
    } else {
        Done::Violated
    })
}

/// Those of the machine file, each replaced by one of the command line for the same quantity, and the others of it.
fn scatters(study: &Study, arguments: &[String]) -> Result<Vec<Scatter>> {
    let given = arguments.iter().map(|text| {
        let parsed = match text.split_once('=') {
            Some((path, amount)) => Tolerance::parse(path.trim(), amount),
            None => Err("it has no \"=\"".to_owned()),
        };
        parsed.map_err(|why| {
            miette!(
                help = "write PATH=5%, PATH=0.1mm or PATH=normal:2%",
                "--tolerance {text:?} cannot be used: {why}"
            )
        })
    });
    let given = given.collect::<Result<Vec<_>>>()?;
    let mut scatters: Vec<Scatter> = Vec::new();
    for tolerance in study.nominal.tolerances.iter().chain(&given) {
        let scatter = Scatter::new(study, tolerance)?;
        match scatters.iter_mut().find(|s| s.quantity == scatter.quantity) {
            Some(earlier) => *earlier = scatter,
            None => scatters.push(scatter),
        }
    }
    if scatters.is_empty() {
        return Err(miette!(
            help = "add a [tolerance] with lines such as \"slider.mass\" = \"±5 %\", or give --tolerance slider.mass=5%",
            "no quantity has a tolerance"
        ));
    }
    Ok(scatters)
}

const COLUMNS: [&str; 9] = [
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

/// The same for a table.
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

fn sheet(samples: &Samples, summary: &Summary, rules: &RuleSet) -> Sheet {
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
                jred_machine::number::rounding::short(s.amount),
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
            "{} of {} machines drawn cannot be built and are not counted; --out FILE writes the reason for each",
            summary.refused, summary.machines
        ));
    }
    if summary.unchecked > 0 {
        notes.push(format!(
            "in {} machines a rule cannot be checked: they count as violations",
            summary.unchecked
        ));
    }
    Sheet {
        schema: "jred-tolerance/1",
        title: format!(
            "{}: {}, {} machines, seed {}",
            samples.study.nominal.title,
            samples.one.name(),
            summary.machines,
            samples.seed
        ),
        reading: Some(Reading {
            columns: READING.map(str::to_owned).to_vec(),
            rows: rows.clone(),
            whole: 1,
        }),
        columns: COLUMNS.map(str::to_owned).to_vec(),
        rows,
        notes,
    }
}
