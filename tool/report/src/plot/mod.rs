//! Charts as inline SVG: curves and clouds of dots over one or two vertical axes, with a legend.

use jred_file::math;
use legend::Legend;
use scale::{Span, nice_step, range, usable};
use svg::{Anchor, Ink, Svg};

use crate::units;
use jred_file::model::coordinate::Coordinate;

mod legend;
mod scale;
pub(crate) mod svg;
#[cfg(test)]
mod tests;

pub(crate) const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 340.0;
/// Font sizes (px): title, axis names, numbers and legend.
const TITLE: f64 = 15.0;
const NAME: f64 = 13.0;
const NUMBER: f64 = 12.0;
/// Length of a tick (px).
const TICK: f64 = 5.0;
/// Line spacing as a multiple of the font size.
const LEADING: f64 = 1.3;
/// Largest deviation of a curve from its points (px): a thirtieth of its width.
const THINNING: f64 = 0.06;
/// Okabe-Ito without its yellow, which is too faint on white paper, and the five colours that differ most from these.
pub(crate) const PALETTE: [&str; 12] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#444444", "#7B3FF2",
    "#4B8B00", "#332288", "#7F4F24", "#B00020",
];
/// Dashes and dots of lines whose colours repeat; they differ from a limit's dashes.
const SECOND_ROUND: [u32; 4] = [9, 3, 2, 3];

/// One curve, broken at points that are not finite.
pub struct Series<'a> {
    /// Name in the legend; empty: no entry.
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
    /// Title above the plot; empty: no title.
    pub title: &'a str,
    /// The horizontal axis.
    pub x: Axis<'a>,
    /// Label of the (left) vertical axis.
    pub y: &'a str,
}

/// A horizontal axis.
#[derive(Clone, Copy, Debug)]
pub struct Axis<'a> {
    /// Its label, with the unit.
    pub label: &'a str,
    /// Whether the numbers are degrees; ticks then suit angles.
    pub degrees: bool,
}

impl<'a> Axis<'a> {
    /// An axis of numbers other than degrees.
    #[must_use]
    pub const fn new(label: &'a str) -> Self {
        let degrees = false;
        Self { label, degrees }
    }

    /// The axis of positions of the drive link.
    #[must_use]
    pub const fn of(coordinate: Coordinate) -> Axis<'static> {
        Axis {
            label: coordinate.axis(),
            degrees: matches!(coordinate, Coordinate::Angle),
        }
    }
}

/// Draws curves and clouds of dots over one pair of axes.
#[must_use]
pub fn lines(axes: &Axes, series: &[Series]) -> String {
    in_units(axes, series, None, draw)
}

/// Draws `left` and `right` with a vertical axis each. Both axes have the same number of intervals and share the grid.
#[must_use]
pub fn lines_two_axes(axes: &Axes, left: &[Series], right_label: &str, right: &[Series]) -> String {
    in_units(axes, left, Some((right_label, right)), draw)
}

/// The curves of a second vertical axis, with its label.
type Second<'a, 'b> = Option<(&'a str, &'a [Series<'b>])>;

/// Calls `draw` with axes and curves in the units of results: a label with a unit converts the numbers along its axis.
pub(crate) fn in_units<T>(
    axes: &Axes,
    left: &[Series],
    second: Second,
    draw: impl FnOnce(&Axes, &[Series], Second) -> T,
) -> T {
    if units::is_si() {
        return draw(axes, left, second);
    }
    let (right_label, right) = second.unwrap_or_default();
    let [x, y, y2] = [axes.x.label, axes.y, right_label].map(units::title);
    let names = |series: &[Series]| -> Vec<String> {
        let names = series.iter().map(|curve| units::title(curve.name));
        names.map(|(name, _)| name.into_owned()).collect()
    };
    let all = [names(left), names(right)];
    let of = |own: Option<&units::Conversion>, x: f64| own.map_or(x, |own| own.of(x));
    let [first, others] =
        [(left, &all[0], y.1), (right, &all[1], y2.1)].map(|(curves, names, own)| {
            let curves = curves.iter().zip(names).map(|(curve, name)| Series {
                name,
                points: (curve.points.iter())
                    .map(|point| (of(x.1, point.0), of(own, point.1)))
                    .collect(),
                style: curve.style,
            });
            curves.collect::<Vec<_>>()
        });
    let axes = Axes {
        title: axes.title,
        x: Axis {
            label: &x.0,
            ..axes.x
        },
        y: &y.0,
    };
    draw(&axes, &first, second.map(|_| (&*y2.0, &*others)))
}

/// A vertical axis with its wrapped name and its numbers.
struct VerticalAxis {
    span: Span,
    name: Vec<String>,
    ticks: Vec<(f64, String)>,
}

impl VerticalAxis {
    fn new(span: Span, name: &str) -> Self {
        Self {
            ticks: span.ticks(),
            span,
            name: wrapped(name, 36),
        }
    }

    /// Width beside the plot (px).
    fn room(&self) -> f64 {
        let numbers = self.ticks.iter().map(|(_, text)| width(text, NUMBER));
        let lines = self.name.len() as f64 * LEADING * NAME;
        TICK + 3.0 + numbers.fold(0.0, f64::max) + 8.0 + lines
    }
}

/// The rectangle between the axes with its ranges.
struct Frame<'a> {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    x: &'a Span,
}

impl Frame<'_> {
    fn x(&self, x: f64) -> f64 {
        self.left + self.x.share(x) * (self.right - self.left)
    }

    fn y(&self, span: &Span, y: f64) -> f64 {
        self.bottom - span.share(y) * (self.bottom - self.top)
    }

    fn middle(&self) -> [f64; 2] {
        [
            self.left.midpoint(self.right),
            self.top.midpoint(self.bottom),
        ]
    }
}

fn draw(axes: &Axes, left: &[Series], second: Option<(&str, &[Series])>) -> String {
    let right = second.map_or(&[][..], |(_, right)| right);
    let x = x_span(axes, left, right);
    let y = VerticalAxis::new(Span::of(range(valid(left).map(|p| p.1))), axes.y);
    let y2 = second.map(|(name, right)| {
        let values = range(valid(right).map(|p| p.1));
        VerticalAxis::new(Span::with_intervals(values, y.span.intervals), name)
    });
    let title = wrapped(axes.title, 85);
    let ends = WIDTH - y2.as_ref().map_or(24.0, VerticalAxis::room);
    let legend = Legend::new(left, right, [y.room(), ends]);
    let name = wrapped(axes.x.label, 85);
    let frame = Frame {
        left: y.room(),
        right: ends,
        top: 12.0 + title.len() as f64 * LEADING * TITLE,
        bottom: HEIGHT - TICK - 26.0 - name.len() as f64 * LEADING * NAME - legend.height(),
        x: &x,
    };
    let mut svg = Svg::new(WIDTH, HEIGHT);
    grid(&mut svg, &frame, &y, y2.as_ref());
    for (k, line) in (1..).map(f64::from).zip(&title) {
        let at = [frame.middle()[0], 4.0 + k * LEADING * TITLE];
        svg.text(at, Anchor::Middle, &format!("font-size=\"{TITLE}\""), line);
    }
    for (k, line) in (1..).map(f64::from).zip(&name) {
        let at = [
            frame.middle()[0],
            frame.bottom + TICK + 14.0 + k * LEADING * NAME,
        ];
        svg.text(at, Anchor::Middle, &format!("font-size=\"{NAME}\""), line);
    }
    // Dots below lines.
    let numbered = || {
        let left = left.iter().map(|series| (series, &y.span));
        let second = y2.as_ref().map_or(&y.span, |y2| &y2.span);
        left.chain(right.iter().map(move |series| (series, second)))
            .enumerate()
    };
    for dots in [true, false] {
        for (index, (series, span)) in numbered() {
            let place = |p: &(f64, f64)| [frame.x(p.0), frame.y(span, p.1)];
            for run in series.points.split(|p| !usable(p.0) || !usable(p.1)) {
                // A single point becomes a dot in any style.
                let as_dots = series.style == Style::Dots || run.len() == 1;
                if run.is_empty() || as_dots != dots {
                    continue;
                }
                let points: Vec<[f64; 2]> = run.iter().map(place).collect();
                if dots {
                    svg.dots(&points, colour(index), 3.4);
                } else {
                    let mut ink = Ink::line(colour(index), 1.8);
                    ink.dashes = dashes(index, series.style);
                    svg.path(&thinned(&points), false, &ink);
                }
            }
        }
    }
    legend.draw(&mut svg);
    svg.finish()
}

/// Grid, axes, ticks with their numbers, and the names of the vertical axes.
fn grid(svg: &mut Svg, frame: &Frame, y: &VerticalAxis, y2: Option<&VerticalAxis>) {
    let Frame {
        left,
        right,
        top,
        bottom,
        ..
    } = *frame;
    let look = format!("font-size=\"{NUMBER}\"");
    let below = frame.x.ticks();
    svg.open("stroke=\"#E2E2E2\"", "");
    for (x, _) in &below {
        svg.rule([frame.x(*x), top], [frame.x(*x), bottom]);
    }
    for (at, _) in &y.ticks {
        let at = frame.y(&y.span, *at);
        svg.rule([left, at], [right, at]);
    }
    svg.close();
    let (lo, hi, step) = (y.span.lo, y.span.hi, y.span.step);
    svg.open("stroke=\"#777777\"", "");
    if lo < -0.5 * step && hi > 0.5 * step {
        let zero = frame.y(&y.span, 0.0);
        svg.rule([left, zero], [right, zero]);
    }
    svg.close();
    svg.open("stroke=\"black\"", "");
    svg.rule([left, bottom], [right, bottom]);
    for (x, _) in &below {
        svg.rule([frame.x(*x), bottom], [frame.x(*x), bottom + TICK]);
    }
    for (axis, x, way) in [(Some(y), left, -1.0), (y2, right, 1.0)] {
        let Some(axis) = axis else { continue };
        svg.rule([x, top], [x, bottom]);
        for (at, _) in &axis.ticks {
            let at = frame.y(&axis.span, *at);
            svg.rule([x, at], [x + way * TICK, at]);
        }
    }
    svg.close();
    for (x, text) in &below {
        svg.text(
            [frame.x(*x), bottom + TICK + 12.0],
            Anchor::Middle,
            &look,
            text,
        );
    }
    let [_, middle] = frame.middle();
    for (axis, x, way, anchor) in [
        (Some(y), left, -1.0, Anchor::End),
        (y2, right, 1.0, Anchor::Start),
    ] {
        let Some(axis) = axis else { continue };
        for (at, text) in &axis.ticks {
            // Text hangs from its baseline; half a digit's height centres it.
            let at = [
                x + way * (TICK + 3.0),
                frame.y(&axis.span, *at) + 0.36 * NUMBER,
            ];
            svg.text(at, anchor, &look, text);
        }
        for (k, line) in (0..).map(f64::from).zip(&axis.name) {
            // The first line is the outermost; text reads upwards on the left, downwards on the right.
            let x = x + way * (axis.room() - (k + 0.5) * LEADING * NAME - 2.0);
            let turn = way * 90.0;
            let look =
                format!("font-size=\"{NAME}\" transform=\"rotate({turn},{x:.2},{middle:.2})\"");
            svg.text([x, middle + 0.36 * NAME], Anchor::Middle, &look, line);
        }
    }
}

fn valid<'a>(series: &'a [Series]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let points = series.iter().flat_map(|s| &s.points).copied();
    points.filter(|p| usable(p.0) && usable(p.1))
}

/// Lines fill the width; dots get a margin.
fn x_span(axes: &Axes, left: &[Series], right: &[Series]) -> Span {
    let (lo, hi) = range(valid(left).chain(valid(right)).map(|p| p.0));
    if left.iter().chain(right).any(|s| s.style == Style::Dots) {
        return Span::of((lo, hi));
    }
    let mut angles = [15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0].into_iter();
    let nice = angles.find(|step| axes.x.degrees && (60.0..=9.0 * step).contains(&(hi - lo)));
    Span::tight(lo, hi, nice.unwrap_or_else(|| nice_step((hi - lo) / 8.0)))
}

/// The points that a curve needs; a point on the line between its neighbours is left out.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    /// Largest number of points that are replaced by one line.
    const REACH: usize = 40;
    let mut kept: Vec<[f64; 2]> = points.first().copied().into_iter().collect();
    let mut from = 0;
    while from + 1 < points.len() {
        let fits = |to: &usize| {
            let (a, b) = (points[from], points[*to]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = math::hypot(dx, dy);
            points[from + 1..*to].iter().all(|p| {
                let (px, py) = (p[0] - a[0], p[1] - a[1]);
                let along = px * dx + py * dy;
                (px * dy - py * dx).abs() <= THINNING * length
                    && (0.0..=length * length).contains(&along)
            })
        };
        let last = points.len().min(from + REACH);
        let to = (from + 2..last).take_while(fits).last();
        from = to.unwrap_or(from + 1);
        kept.push(points[from]);
    }
    kept
}

/// Colour of curve number `index`.
pub(crate) fn colour(index: usize) -> &'static str {
    PALETTE[index % PALETTE.len()]
}

/// Lengths of the dashes and gaps of curve number `index` (px); empty for a solid line.
pub(crate) const fn dashes(index: usize, style: Style) -> &'static [u32] {
    match style {
        Style::Dashed => &[5, 5],
        Style::Line if index >= PALETTE.len() => &SECOND_ROUND,
        Style::Line | Style::Dots => &[],
    }
}

/// Lines of at most `length` letters, broken at spaces; empty for an empty text.
fn wrapped(text: &str, length: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|_| !text.is_empty()) {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= length => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Approximate width of a text at a font size (px), independent of the reader's font.
fn width(text: &str, size: f64) -> f64 {
    let share = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '|' | '!' | '\'' | '′' => 0.26,
        ' ' | 'f' | 't' | 'r' | 'I' | '(' | ')' | '[' | ']' | '/' | '·' | '-' => 0.33,
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 0.86,
        c if c.is_uppercase() => 0.7,
        _ => 0.56,
    };
    text.chars().map(share).sum::<f64>() * size
}
