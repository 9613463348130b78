//! `jred split`: the division of a total gear ratio over stages that makes the reduced inertia smallest.

use jred::mechanism::synthesis::{Driven, OpenStage, OpenTrain, RatioSplit, Split};
use jred::number::RangeError;
use miette::{Result, miette};
use serde_json::{Map, Value, json};

use crate::options;
use jred_machine::number::columns::{Column, Columns};
use jred_machine::number::rounding::rounded;
use jred_report::table::output;
use jred_report::table::output::Format;

/// The result of `jred split`, written as asked for.
///
/// # Errors
/// Options that do not fit together, or bounds within which the stages cannot give the ratio.
pub fn run(options: &options::Split) -> Result<String> {
    let train = train(options)?;
    let (best, equal) = (train.optimum(), train.equal());
    let columns = curve(&train, &best, options.points)?;
    Ok(match options.format {
        Format::Csv => output::write(&columns, Format::Csv, ""),
        Format::Table => output::write(
            &columns,
            Format::Table,
            &summary(&train, options, &best, &equal),
        ),
        Format::Json => {
            let mut map = Map::new();
            map.insert("ratio".into(), json!(train.ratio()));
            map.insert("optimum".into(), split(&best));
            map.insert("equal".into(), split(&equal));
            map.insert("equal_within_bounds".into(), within(&equal, options).into());
            output::json_parts(&columns, map, Map::new()).collect()
        }
    })
}

fn train(options: &options::Split) -> Result<RatioSplit> {
    let stages = usize::from(options.stages);
    let drivers = each(&options.pinion, stages, "pinion")?;
    let driven = if options.driven.is_empty() {
        drivers.iter().copied().map(Driven::LikePinion).collect()
    } else {
        let wheels = each(&options.driven, stages, "driven")?;
        wheels.into_iter().map(Driven::Constant).collect::<Vec<_>>()
    };
    let open: Vec<OpenStage> = drivers
        .into_iter()
        .zip(driven)
        .map(|(driver, driven)| OpenStage { driver, driven })
        .collect();
    let bounds = [options.min_ratio, options.max_ratio];
    RatioSplit::new(OpenTrain {
        ratio: options.ratio,
        stages: &open,
        output: options.load.unwrap_or(0.0),
        bounds,
    })
    .map_err(|error| {
        let help = match error {
            RangeError::OutOfRange {
                what: "total ratio",
                max,
                value,
                ..
            } if value > max => "allow a larger --max-ratio, or more --stages",
            RangeError::OutOfRange {
                what: "total ratio",
                ..
            } => "allow a smaller --min-ratio, or fewer --stages",
            _ => "ratios must be greater than zero, and --max-ratio at least --min-ratio",
        };
        miette!(help = help, "the ratio cannot be divided: {error}")
    })
}

/// One value for each stage, from one for all or one for each.
fn each(given: &[f64], stages: usize, option: &str) -> Result<Vec<f64>> {
    match given {
        [all] => Ok(vec![*all; stages]),
        _ if given.len() == stages => Ok(given.to_vec()),
        _ => Err(miette!(
            help = "give it once for all stages, or once for each stage, starting at the input",
            "--{option} is given {} times for {stages} stages",
            given.len()
        )),
    }
}

/// J_red over the ratio of the first stage, in equal steps of its logarithm, the other stages divided as is best then.
fn curve(train: &RatioSplit, best: &Split, points: u32) -> Result<Columns> {
    let ratios = (1..=train.stages()).map(|k| Column::other(format!("i{k}"), ""));
    let figures = [("J_red", "kg m^2"), ("J_red of the smallest", "")];
    let figures = figures.map(|(name, unit)| Column::other(name, unit));
    let mut columns = Columns::new(ratios.chain(figures));
    let [least, most] = train.first_range();
    for k in 0..points {
        let share = f64::from(k) / f64::from(points - 1);
        // At its ends the power is not exact.
        let first = (least * (most / least).powf(share)).clamp(least, most);
        let point = train
            .with_first(first)
            .map_err(|error| miette!("{error}"))?;
        let figures = [point.inertia, point.inertia / best.inertia];
        columns.push(point.ratios.iter().copied().chain(figures));
    }
    Ok(columns)
}

fn split(split: &Split) -> Value {
    json!({ "ratios": split.ratios.as_slice(), "J_red_kg_m2": split.inertia })
}

/// Whether every stage is within the bounds, but for rounding.
fn within(split: &Split, options: &options::Split) -> bool {
    let (low, high) = (
        options.min_ratio * (1.0 - 1e-12),
        options.max_ratio * (1.0 + 1e-12),
    );
    split
        .ratios
        .iter()
        .all(|ratio| (low..=high).contains(ratio))
}

fn summary(train: &RatioSplit, options: &options::Split, best: &Split, equal: &Split) -> String {
    let line = |name: &str, split: &Split| {
        let ratios: Vec<String> = split.ratios.iter().map(|ratio| rounded(*ratio)).collect();
        format!(
            "{name}: i = {}, J_red = {} kg m^2 at the input",
            ratios.join(" · "),
            rounded(split.inertia)
        )
    };
    let wheels = if options.driven.is_empty() {
        "driven wheels with the module and width of their pinion, J = J_pinion·i⁴"
    } else {
        "driven wheels with the given inertia"
    };
    let more = 100.0 * (equal.inertia / best.inertia - 1.0);
    let bounds = if within(equal, options) {
        ""
    } else {
        ", outside the bounds of the stages"
    };
    format!(
        "total ratio {} over {} stages, each from {} to {}; {wheels}\n{}\n{}, {} % more{bounds}\n\
         for each ratio of the first stage, with the best division of the others:",
        rounded(train.ratio()),
        train.stages(),
        rounded(options.min_ratio),
        rounded(options.max_ratio),
        line("optimum", best),
        line("equal split", equal),
        rounded((more * 100.0).round() / 100.0),
    )
}
