//! A chart of the report: an SVG picture for paper and browsers without scripts, and data for the page's script.

use serde_json::{Value, json};

use crate::plot::{Axes, Series, Style, colour, dashes, in_units, lines, lines_two_axes};

/// A chart.
pub(super) struct Chart {
    /// The picture.
    pub(super) svg: String,
    /// Data for the script.
    data: Value,
}

/// Kind of chart in the script.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ChartKind {
    /// Curves over a common axis.
    Course,
    /// Curves over time: their cursors move together, and with the point in the plane.
    Time,
    /// Points of a plane in any order.
    Plane,
}

impl ChartKind {
    const fn name(self) -> &'static str {
        match self {
            Self::Course => "course",
            Self::Time => "time",
            Self::Plane => "plane",
        }
    }
}

impl Chart {
    /// Curves over one pair of axes.
    pub(super) fn new(form: ChartKind, axes: &Axes, series: &[Series]) -> Self {
        Self {
            svg: lines(axes, series),
            data: in_units(axes, series, None, |axes, left, right| {
                data(form, axes, left, right)
            }),
        }
    }

    /// Curves over two vertical axes.
    pub(super) fn two_axes(axes: &Axes, left: &[Series], label: &str, right: &[Series]) -> Self {
        Self {
            svg: lines_two_axes(axes, left, label, right),
            data: in_units(axes, left, Some((label, right)), |axes, left, right| {
                data(ChartKind::Course, axes, left, right)
            }),
        }
    }

    /// Adds the time of every point of series number `series`, by which the cursors over time find it.
    pub(super) fn with_times(mut self, series: usize, times: impl Iterator<Item = f64>) -> Self {
        if let Some(found) = self.data["series"].get_mut(series) {
            found["t"] = times.map(number).collect();
        }
        self
    }

    /// The data, for a page that draws it itself.
    pub(super) fn named(mut self, name: &str) -> Value {
        self.data["name"] = name.into();
        self.data
    }

    /// The data for an element of the page, escaped so that user text cannot end it.
    pub(super) fn json(&self) -> String {
        self.data.to_string().replace('<', "\\u003c")
    }
}

/// Series with the same abscissae share one list of them.
fn data(form: ChartKind, axes: &Axes, left: &[Series], second: Option<(&str, &[Series])>) -> Value {
    let (right_label, right) = second.unwrap_or_default();
    let mut places: Vec<Value> = Vec::new();
    let mut one = |index: usize, series: &Series, right: bool| {
        let style = match series.style {
            Style::Line => "line",
            Style::Dashed => "dashed",
            Style::Dots => "dots",
        };
        let x: Value = series.points.iter().map(|p| number(p.0)).collect();
        let y: Value = series.points.iter().map(|p| number(p.1)).collect();
        let known = places.iter().position(|other| *other == x);
        let at = known.unwrap_or_else(|| {
            places.push(x);
            places.len() - 1
        });
        json!({
            "name": series.name,
            "style": style,
            "colour": colour(index),
            "dash": dashes(index, series.style),
            "right": right,
            "at": at,
            "y": y,
        })
    };
    let all = left.iter().map(|s| (s, false));
    let all = all.chain(right.iter().map(|s| (s, true))).enumerate();
    let series: Vec<Value> = all
        .map(|(index, (series, right))| one(index, series, right))
        .collect();
    json!({
        "form": form.name(),
        "x": axes.x.label,
        "y": axes.y,
        "right": right_label,
        "places": places,
        "series": series,
    })
}

/// Six digits; null at a gap.
fn number(x: f64) -> Value {
    if !x.is_finite() {
        return Value::Null;
    }
    let digits = format!("{x:.5e}");
    let rounded: f64 = digits.parse().unwrap_or(x);
    if rounded.fract() == 0.0 && rounded.abs() < 1e15 {
        return json!(rounded as i64);
    }
    json!(rounded)
}
