//! From metres to pixels.

use jred_file::math;
use std::f64::consts::FRAC_PI_2;

use super::sketch::{BodyPart, Sketch};
use crate::plot::WIDTH;
use crate::plot::svg::{Anchor, Ink, Svg};
use crate::units;
use jred_file::number::rounding::rounded;

/// Margin around the drawing (px) for bearings, blocks and labels.
const MARGIN: f64 = 48.0;
/// Minimum and maximum height (px).
const HEIGHT: [f64; 2] = [220.0, 560.0];

/// Scale and origin of a drawing.
pub(super) struct View {
    pub(super) width: f64,
    pub(super) height: f64,
    /// Pixels per metre.
    pub(super) scale: f64,
    /// Point (m) at the centre of the page.
    middle: [f64; 2],
}

impl View {
    /// A view that shows everything.
    pub(super) fn of(sketch: &Sketch) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut show = |at: [f64; 2], around: f64| {
            for k in 0..2 {
                low[k] = low[k].min(at[k] - around);
                high[k] = high[k].max(at[k] + around);
            }
        };
        for part in &sketch.ground {
            for (at, around) in part.reach() {
                show(at, around);
            }
        }
        for (link, parts) in sketch.links.iter().enumerate() {
            let reach: Vec<([f64; 2], f64)> = parts.iter().flat_map(BodyPart::reach).collect();
            for pose in &sketch.poses {
                for &(at, around) in &reach {
                    show(pose.point(link, at), around);
                }
            }
        }
        sketch.paths.iter().flatten().for_each(|&at| show(at, 0.0));
        let span = [0, 1].map(|k| {
            let span = high[k] - low[k];
            if span.is_finite() { span } else { 0.0 }
        });
        let middle = [0, 1].map(|k| {
            if span[k] > 0.0 {
                low[k].midpoint(high[k])
            } else {
                low[k]
            }
        });
        let middle = middle.map(|m| if m.is_finite() { m } else { 0.0 });
        let room = [WIDTH - 2.0 * MARGIN, HEIGHT[1] - 2.0 * MARGIN];
        let scales = [0, 1].map(|k| {
            if span[k] > 0.0 {
                room[k] / span[k]
            } else {
                f64::INFINITY
            }
        });
        let scale = scales[0].min(scales[1]);
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let height = (span[1] * scale + 2.0 * MARGIN).clamp(HEIGHT[0], HEIGHT[1]);
        Self {
            width: WIDTH,
            height: height.round(),
            scale,
            middle,
        }
    }

    /// A point (m) on the page (px).
    pub(super) fn page(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            0.5 * self.width + (x - self.middle[0]) * self.scale,
            0.5 * self.height - (y - self.middle[1]) * self.scale,
        ]
    }

    /// The axes of the machine file, if they are turned on the page.
    pub(super) fn axes(&self, svg: &mut Svg, turn: f64) {
        let middle = [self.width - 60.0, 60.0];
        for (name, angle) in [("x", turn), ("y", turn + FRAC_PI_2)] {
            if turn == 0.0 {
                continue;
            }
            let (sin, cos) = math::sin_cos(angle);
            let on = |along: f64, across: f64| {
                [
                    middle[0] + along * cos - across * sin,
                    middle[1] - along * sin - across * cos,
                ]
            };
            let ink = Ink::line(super::QUIET, 1.5);
            svg.path(&[middle, on(30.0, 0.0)], false, &ink);
            svg.path(&[on(23.0, 4.0), on(30.0, 0.0), on(23.0, -4.0)], false, &ink);
            let [x, y] = on(42.0, 0.0);
            svg.text(
                [x, y + 4.0],
                Anchor::Middle,
                &super::lettering(super::QUIET),
                name,
            );
        }
    }

    /// Scale bar and position.
    pub(super) fn legend(&self, svg: &mut Svg, schematic: bool, place: &str) {
        let base = self.height - 14.0;
        if schematic {
            let words = "schematic: radii by the ratios, not to scale";
            svg.text(
                [14.0, base],
                Anchor::Start,
                &super::lettering(super::QUIET),
                words,
            );
        } else {
            let length = nice(0.2 * self.width / self.scale);
            let end = 14.0 + length * self.scale;
            let ink = Ink::line(super::QUIET, 1.5);
            svg.path(
                &[
                    [14.0, base - 5.0],
                    [14.0, base],
                    [end, base],
                    [end, base - 5.0],
                ],
                false,
                &ink,
            );
            let words = format!("{} mm", rounded(length * 1e3));
            let words = units::text(&words);
            let middle = [0.5 * (14.0 + end), base - 7.0];
            svg.text(
                middle,
                Anchor::Middle,
                &super::lettering(super::QUIET),
                &words,
            );
        }
        if !place.is_empty() {
            svg.text(
                [14.0, 22.0],
                Anchor::Start,
                &super::lettering(super::QUIET),
                place,
            );
        }
    }
}

impl BodyPart {
    /// Points that must be on the page, with the space (m) around each.
    fn reach(&self) -> Vec<([f64; 2], f64)> {
        match self {
            Self::Bar(ends) | Self::Slot(ends) => ends.map(|at| (at, 0.0)).to_vec(),
            Self::Plate(points) | Self::Outline(points) => {
                points.iter().map(|&at| (at, 0.0)).collect()
            }
            Self::Wheel(at, radius) => vec![(*at, *radius)],
            Self::Block(at, _) | Self::Pin(at) => vec![(*at, 0.0)],
        }
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above `length`.
fn nice(length: f64) -> f64 {
    let power = 10f64.powi(math::log10(length).floor() as i32);
    let factor = [5.0, 2.0, 1.0].into_iter().find(|f| f * power <= length);
    factor.unwrap_or(1.0) * power
}
