//! A gear ratio divided over stages.

use jred_file::math;
use std::borrow::Cow;

use jred::mechanism::synthesis::{RatioSplit, Split};
use jred::number::RangeError;
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use jred_file::number::columns::{Column, Columns};
use jred_file::number::rounding::rounded;

/// A train of stages.
#[derive(Debug)]
pub struct SplitView<'a> {
    /// The train.
    pub train: &'a RatioSplit,
    /// Least and largest ratio of a stage.
    pub bounds: [f64; 2],
    /// Whether driven wheels have the module and width of their pinion; otherwise their inertias are given.
    pub like_pinions: bool,
    /// Points of the curve.
    pub points: u32,
}

/// The JSON of `jred split`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct SplitData {
    /// Total ratio.
    ratio: f64,
    /// The best division.
    optimum: Division,
    /// Equal ratios in all stages.
    equal: Division,
    /// Whether equal ratios keep within the bounds of a stage.
    equal_within_bounds: bool,
}

impl Data for SplitData {
    const FORM: &'static str = "jred-split/1";
    const HAS_COURSE: bool = true;
}

#[derive(Serialize, JsonSchema)]
struct Division {
    /// Ratio of each stage, from the input.
    ratios: Vec<f64>,
    /// Reduced inertia at the input (kg·m²).
    #[serde(rename = "J_red_kg_m2")]
    inertia: f64,
}

impl From<&Split> for Division {
    fn from(split: &Split) -> Self {
        Self {
            ratios: split.ratios.to_vec(),
            inertia: split.inertia,
        }
    }
}

impl SplitView<'_> {
    /// The best division, equal ratios, and the inertia over the ratio of the first stage.
    ///
    /// # Errors
    /// A ratio outside the range of the train.
    pub fn answer(&self) -> Result<Answer<'static>, RangeError> {
        let (train, [low, high]) = (self.train, self.bounds);
        let (best, equal) = (train.optimum(), train.equal());
        let is_within = self.keeps(&equal);
        let data = SplitData {
            ratio: train.ratio(),
            optimum: (&best).into(),
            equal: (&equal).into(),
            equal_within_bounds: is_within,
        };
        let title = format!(
            "total ratio {} over {} stages, each from {} to {}",
            rounded(train.ratio()),
            train.stages(),
            rounded(low),
            rounded(high)
        );
        let mut answer = Answer::new(title, &data);
        answer.fact("optimum", says(&best));
        let more = 100.0 * (equal.inertia / best.inertia - 1.0);
        answer.fact(
            "equal split",
            format!(
                "{}, {} % more{}",
                says(&equal),
                rounded((more * 100.0).round() / 100.0),
                if is_within {
                    ""
                } else {
                    ", outside the bounds of the stages"
                }
            ),
        );
        answer.fact(
            "driven wheels",
            if self.like_pinions {
                "with the module and width of their pinion, J = J_pinion·i⁴"
            } else {
                "with the given inertia"
            },
        );
        answer.heading("for each ratio of the first stage, with the best division of the others");
        answer.course(Cow::Owned(self.curve(&best)?));
        Ok(answer)
    }

    /// Whether every stage is within the bounds, up to rounding.
    fn keeps(&self, split: &Split) -> bool {
        let [low, high] = self.bounds;
        let range = low * (1.0 - 1e-12)..=high * (1.0 + 1e-12);
        split.ratios.iter().all(|ratio| range.contains(ratio))
    }

    /// J_red over the ratio of the first stage in logarithmic steps; the other ratios are optimal.
    fn curve(&self, best: &Split) -> Result<Columns, RangeError> {
        let ratios = (1..=self.train.stages()).map(|k| Column::other(format!("i{k}"), ""));
        let figures = [("J_red", "kg m^2"), ("J_red of the smallest", "")];
        let figures = figures.map(|(name, unit)| Column::other(name, unit));
        let mut columns = Columns::new(ratios.chain(figures));
        let [least, most] = self.train.first_range();
        for k in 0..self.points {
            let share = f64::from(k) / f64::from(self.points - 1);
            // The power is inexact at its ends.
            let first = (least * math::pow(most / least, share)).clamp(least, most);
            let point = self.train.with_first(first)?;
            let figures = [point.inertia, point.inertia / best.inertia];
            columns.push(point.ratios.iter().copied().chain(figures));
        }
        Ok(columns)
    }
}

fn says(split: &Split) -> String {
    let ratios: Vec<String> = split.ratios.iter().map(|ratio| rounded(*ratio)).collect();
    format!(
        "i = {}, J_red = {} kg m^2 at the input",
        ratios.join(" · "),
        rounded(split.inertia)
    )
}
