//! `jred split`: divides a total gear ratio over stages for the smallest reduced inertia.

use jred::mechanism::synthesis::{OpenStage, OpenTrain, RatioSplit, WheelInertia};
use jred::number::RangeError;
use miette::{Result, miette};

use crate::options;
use jred_report::answer::Answer;
use jred_report::list::split;

/// The result of `jred split`.
///
/// # Errors
/// Contradictory options, or bounds within which the stages cannot reach the ratio.
pub fn run(options: &options::Split) -> Result<Answer<'static>> {
    let view = split::SplitView {
        train: &train(options)?,
        bounds: [options.min_ratio, options.max_ratio],
        like_pinions: options.driven.is_empty(),
        points: options.points,
    };
    view.answer().map_err(|error| miette!("{error}"))
}

fn train(options: &options::Split) -> Result<RatioSplit> {
    let stages = usize::from(options.stages);
    let drivers = each(&options.pinion, stages, "pinion")?;
    let driven = if options.driven.is_empty() {
        drivers
            .iter()
            .copied()
            .map(WheelInertia::LikePinion)
            .collect()
    } else {
        let wheels = each(&options.driven, stages, "driven")?;
        wheels
            .into_iter()
            .map(WheelInertia::Constant)
            .collect::<Vec<_>>()
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

/// One value per stage, from a single value or one for each.
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
