//! The only door to the plotting library (with its parts in `plot/`): data in, inline SVG out.

use kuva::prelude::*;
use kuva::render::layout::AxisLabelOverlap;
use scale::{Span, nice_step, number, range, to_f64, usable};
use std::sync::Arc;
use svg::finish;

pub(crate) mod canvas;
mod scale;
mod svg;
#[cfg(test)]
mod tests;

pub(crate) const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 340.0;
/// Blank band the library leaves under a legend; it is drawn and then cropped away.
const LEGEND_SLACK: f64 = 22.0;
/// Okabe-Ito without its yellow, which is too faint on white paper, and five more that differ most from these.
pub(crate) const PALETTE: [&str; 12] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#444444", "#7B3FF2",
    "#4B8B00", "#332288", "#7F4F24", "#B00020",
];
/// Where the colours come round again, lines have dashes and dots: neither those of a limit nor none.
const SECOND_ROUND: &str = "9 3 2 3";
/// With more bars than this, the numbers at the bars would run into each other.
const MAX_LABELLED_BARS: usize = 14;

/// One curve. It is broken at points that are not finite; those are not drawn.
pub struct Series<'a> {
    /// Name in the legend; none if empty.
    pub name: &'a str,
    /// The points (x, y) in drawing order.
    pub points: Vec<(f64, f64)>,
    /// How the points are drawn.
    pub style: Style,
}

/// How a [`Series`] is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line, e.g. for a limit.
    Dashed,
    /// Unconnected dots.
    Dots,
}

/// Title and axis labels; the labels carry the unit, e.g. `crank angle φ [deg]`.
pub struct Axes<'a> {
    /// Title above the plot; none if empty.
    pub title: &'a str,
    /// Label of the horizontal axis; one with `[deg]` or `°` gets ticks that suit angles.
    pub x: &'a str,
    /// Label of the (left) vertical axis.
    pub y: &'a str,
}

/// Draws curves and clouds of dots over one pair of axes.
#[must_use]
pub fn lines(axes: &Axes, series: &[Series]) -> String {
    let y = Span::of(range(valid(series).map(|p| p.1)));
    let layout = frame(axes, &x_span(axes, series, &[]), &y, legend(series, 0, ""));
    finish(render_multiple(plots(series, 0), layout))
}

/// Draws `left` and `right` against a vertical axis each. Both axes have the same number of
/// intervals, so that the grid serves both.
#[must_use]
pub fn lines_two_axes(axes: &Axes, left: &[Series], right_label: &str, right: &[Series]) -> String {
    let y = Span::of(range(valid(left).map(|p| p.1)));
    let y2 = Span::with_intervals(range(valid(right).map(|p| p.1)), y.intervals);
    let mut entries = legend(left, 0, "");
    entries.extend(legend(right, left.len(), " (right axis)"));
    let layout = frame(axes, &x_span(axes, left, right), &y, entries)
        .with_y2_range(y2.lo, y2.hi)
        .with_y2_axis_min(y2.lo)
        .with_y2_axis_max(y2.hi)
        .with_y2_label(text(right_label))
        .with_y2_label_wrap(36)
        .with_y2_tick_format(tick_format(&y2));
    let (left, right) = (plots(left, 0), plots(right, left.len()));
    finish(render_twin_y(left, right, layout))
}

/// Draws groups of named bars, e.g. `inertia J·α` with `peak` and `RMS`; equal names have equal
/// colours. Values may be negative; one that is not finite leaves a gap.
#[must_use]
pub fn bars(axes: &Axes, groups: &[(&str, Vec<(&str, f64)>)]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in groups.iter().flat_map(|group| &group.1) {
        if !names.contains(name) {
            names.push(name);
        }
    }
    let slots = groups.iter().map(|g| g.1.len()).max().unwrap_or(0).max(1);
    let labelled = slots * groups.len() <= MAX_LABELLED_BARS;
    let values = groups.iter().flat_map(|g| &g.1).map(|bar| bar.1);
    let (lo, hi) = range(values.chain([0.0]));
    let room = |end: f64| {
        if labelled && end != 0.0 {
            0.1 * (hi - lo)
        } else {
            0.0
        }
    };
    let y = Span::of((lo - room(lo), hi + room(hi)));
    let entries = (0..).zip(&names).filter(|(_, name)| !name.is_empty());
    let entries = entries.map(|(i, name)| entry(name, i, LegendShape::Rect, None));
    let labels: Vec<String> = groups.iter().map(|g| text(g.0)).collect();
    let crowded = labels.iter().any(|s| s.chars().count() * labels.len() > 95);
    let x = Span::new(0.5, 1.0, groups.len().max(1));
    let mut layout = frame(axes, &x, &y, entries.collect()).with_x_categories(labels);
    if crowded {
        layout = layout.with_x_label_overlap(AxisLabelOverlap::Stagger);
    }
    let mut plot = BarPlot::new().with_width(0.7);
    for (middle, (group, members)) in (1..).map(f64::from).zip(groups) {
        let mut drawn = Vec::new();
        for (place, &(name, value)) in (0..).map(f64::from).zip(members) {
            let index = names.iter().position(|n| *n == name).unwrap_or(0);
            drawn.push((if usable(value) { value } else { 0.0 }, colour(index)));
            if labelled && usable(value) {
                let at = middle - 0.35 + 0.7 * (place + 0.5) / to_f64(slots);
                let drop = 0.09 * (y.hi - y.lo) * f64::from(u8::from(value < 0.0));
                let step = 10f64.powf(value.abs().log10().floor() - 2.0);
                let note = number(value, value.abs(), step);
                layout = layout.with_annotation(TextAnnotation::new(note, at, value - drop));
            }
        }
        drawn.resize(slots, (0.0, ""));
        plot = plot.with_group(text(group), drawn);
    }
    finish(render_multiple(vec![plot.into()], layout))
}

fn valid<'a>(series: &'a [Series]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let points = series.iter().flat_map(|s| &s.points).copied();
    points.filter(|p| usable(p.0) && usable(p.1))
}

fn tick_format(span: &Span) -> TickFormat {
    let (size, step) = (span.lo.abs().max(span.hi.abs()), span.step);
    TickFormat::Custom(Arc::new(move |value| number(value, size, step)))
}

/// Lines fill the width, dots get some room.
fn x_span(axes: &Axes, left: &[Series], right: &[Series]) -> Span {
    let (lo, hi) = range(valid(left).chain(valid(right)).map(|p| p.0));
    if left.iter().chain(right).any(|s| s.style == Style::Dots) {
        return Span::of((lo, hi));
    }
    let angle = axes.x.contains("[deg]") || axes.x.contains('°');
    let mut angles = [15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0].into_iter();
    let nice = angles.find(|step| angle && (60.0..=9.0 * step).contains(&(hi - lo)));
    let step = nice.unwrap_or_else(|| nice_step((hi - lo) / 8.0));
    let slack = 1e-9 * step;
    Span {
        lo: lo - slack,
        hi: hi + slack,
        step,
        intervals: 8,
    }
}

/// User text without math markup (`$`) and without what XML cannot hold; the library escapes it.
fn text(raw: &str) -> String {
    let clean = raw.replace(
        |c: char| c.is_control() || c > '\u{FFFD}' && c < '\u{10000}',
        " ",
    );
    clean.replace('$', "\\$")
}

/// Colour of curve number `index`.
pub(crate) fn colour(index: usize) -> &'static str {
    PALETTE[index % PALETTE.len()]
}

/// Dashes of curve number `index`; `None`: a solid line.
pub(crate) fn dashes(index: usize, style: Style) -> Option<&'static str> {
    match style {
        Style::Dashed => Some("5 5"),
        Style::Line if index >= PALETTE.len() => Some(SECOND_ROUND),
        Style::Line | Style::Dots => None,
    }
}

fn line_style(index: usize, style: Style) -> LineStyle {
    dashes(index, style).map_or(LineStyle::Solid, |dashes| LineStyle::Custom(dashes.into()))
}

fn entry(name: &str, index: usize, shape: LegendShape, dashes: Option<String>) -> LegendEntry {
    let (label, color) = (text(name), colour(index).into());
    LegendEntry {
        label,
        color,
        shape,
        dasharray: dashes,
    }
}

fn legend(series: &[Series], first: usize, suffix: &str) -> Vec<LegendEntry> {
    let named = (first..).zip(series).filter(|(_, s)| !s.name.is_empty());
    let make = |(i, s): (usize, &Series)| {
        let dots = s.style == Style::Dots;
        let shape = if dots {
            LegendShape::CircleSize(3.0)
        } else {
            LegendShape::Line
        };
        let dashes = line_style(i, s.style).dasharray();
        entry(&format!("{}{suffix}", s.name), i, shape, dashes)
    };
    named.map(make).collect()
}

/// The library's plots, dots below lines. A lone point becomes a dot whatever its style.
fn plots(series: &[Series], first: usize) -> Vec<Plot> {
    // Without any plot, the library draws no axes either.
    let mut drawn: Vec<Plot> = vec![LinePlot::new().into()];
    for (i, s) in (first..).zip(series) {
        let runs = s.points.split(|p| !usable(p.0) || !usable(p.1));
        for run in runs.filter(|run| !run.is_empty()) {
            let run_points = run.iter().copied();
            drawn.push(if s.style == Style::Dots || run.len() == 1 {
                let dots = ScatterPlot::new().with_data(run_points).with_size(1.7);
                dots.with_color(colour(i)).into()
            } else {
                let line = LinePlot::new().with_data(run_points).with_color(colour(i));
                let line = line.with_line_style(line_style(i, s.style));
                line.with_stroke_width(1.8).into()
            });
        }
    }
    drawn.sort_by_key(|plot| matches!(plot, Plot::Line(_)));
    drawn
}

/// What all plots have in common: size, fonts, thin grid, legend below.
fn frame(axes: &Axes, x: &Span, y: &Span, entries: Vec<LegendEntry>) -> Layout {
    let mut theme = Theme::light();
    theme.grid_color = "#E2E2E2".into();
    let mut layout = Layout::new((x.lo, x.hi), (y.lo, y.hi))
        .with_width(WIDTH)
        .with_height(HEIGHT)
        .with_theme(theme)
        .with_font_family("Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif")
        .with_title_size(15)
        .with_label_size(13)
        .with_ticks(y.intervals)
        .with_x_axis_min(x.lo)
        .with_x_axis_max(x.hi)
        .with_x_tick_step(x.step)
        .with_x_tick_format(tick_format(x))
        .with_y_axis_min(y.lo)
        .with_y_axis_max(y.hi)
        .with_y_tick_step(y.step)
        .with_y_tick_format(tick_format(y))
        .with_x_label(text(axes.x))
        .with_y_label(text(axes.y))
        .with_y_label_wrap(36);
    if !axes.title.is_empty() {
        layout = layout.with_title(text(axes.title)).with_title_wrap(85);
    }
    if y.lo < -0.5 * y.step && y.hi > 0.5 * y.step {
        let zero = ReferenceLine::horizontal(0.0).with_color("#777777");
        layout = layout.with_reference_line(zero.with_dasharray("none"));
    }
    if !entries.is_empty() {
        layout = layout
            .with_height(HEIGHT + LEGEND_SLACK)
            .with_legend_entries(entries)
            .with_legend_position(LegendPosition::OutsideBottomColumns)
            .with_legend_box(false);
    }
    layout
}
