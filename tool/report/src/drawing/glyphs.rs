//! Shape of each part.

use super::QUIET;
use super::sketch::BodyPart;
use crate::plot::svg::{Ink, Svg};
use jred_file::math;

/// Radius of a pin (px).
const PIN: f64 = 4.5;
/// Half length and half width of a block (px).
const BLOCK: [f64; 2] = [17.0, 10.0];
/// Width of a bar (px).
const BAR: f64 = 9.0;
const INK: &str = "#1d2733";
const PAPER: &str = "#ffffff";
/// Colour of faint copies.
const GHOST: &str = "#cdd4da";

/// Draws parts in a link's frame, scaled, with v up.
pub(super) struct Pen<'c> {
    pub(super) svg: &'c mut Svg,
    /// Pixels per metre.
    pub(super) scale: f64,
}

impl Pen<'_> {
    fn local(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [u * self.scale, -v * self.scale]
    }

    /// A part of a link.
    pub(super) fn part(&mut self, part: &BodyPart, colour: &str) {
        match part {
            BodyPart::Bar(ends) => {
                let ends = ends.map(|at| self.local(at));
                self.svg.path(&ends, false, &Ink::line(colour, BAR));
            }
            BodyPart::Plate(points) | BodyPart::Outline(points) => {
                let points: Vec<[f64; 2]> = points.iter().map(|&at| self.local(at)).collect();
                let ink = Ink::line(colour, 2.5).filled(colour);
                self.svg.path(&points, true, &ink.faint(0.3));
                self.svg.path(&points, true, &Ink::line(colour, 2.0));
            }
            BodyPart::Wheel(at, radius) => {
                let (at, radius) = (self.local(*at), radius * self.scale);
                let ink = Ink::line(colour, 2.0).filled(colour);
                self.svg.circle(at, radius, &ink.faint(0.15));
                let rim = [at[0] + radius, at[1]];
                self.svg.path(&[at, rim], false, &Ink::line(colour, 2.0));
            }
            BodyPart::Block(at, angle) => {
                let corners = block(self.local(*at), *angle);
                let ink = Ink::line(colour, 2.0).filled(PAPER);
                self.svg.path(&corners, true, &ink);
                let ink = Ink::line(colour, 2.0).filled(colour);
                self.svg.path(&corners, true, &ink.faint(0.3));
            }
            BodyPart::Slot(ends) => {
                let ends = overrun(ends.map(|at| self.local(at)), 8.0);
                self.svg.path(&ends, false, &Ink::line(colour, 14.0));
                self.svg.path(&ends, false, &Ink::line(PAPER, 10.0));
            }
            BodyPart::Pin(at) => {
                let at = self.local(*at);
                self.svg.circle(at, PIN, &Ink::line(INK, 1.6).filled(PAPER));
            }
        }
    }

    /// A faint copy.
    pub(super) fn ghost(&mut self, part: &BodyPart) {
        let ink = Ink::line(GHOST, 1.0);
        match part {
            BodyPart::Bar(ends) => {
                let ends = ends.map(|at| self.local(at));
                self.svg.path(&ends, false, &ink);
            }
            BodyPart::Plate(points) => {
                let points: Vec<[f64; 2]> = points.iter().map(|&at| self.local(at)).collect();
                self.svg.path(&points, true, &ink);
            }
            BodyPart::Block(at, angle) => {
                let corners = block(self.local(*at), *angle);
                self.svg.path(&corners, true, &ink);
            }
            _ => {}
        }
    }

    /// A part of the ground; `page` maps its points to the page.
    pub(super) fn ground(&mut self, part: &BodyPart, page: &dyn Fn([f64; 2]) -> [f64; 2]) {
        let ink = Ink::line(QUIET, 1.5);
        match part {
            BodyPart::Pin(at) => {
                let [x, y] = page(*at);
                let base = y + 20.0;
                let triangle = [[x, y], [x - 12.0, base], [x + 12.0, base]];
                self.svg.path(&triangle, true, &ink.filled("#eef1f4"));
                self.hatch([x - 18.0, base], [x + 18.0, base]);
            }
            BodyPart::Slot(ends) => {
                let [a, b] = overrun(ends.map(page), 2.0 * BLOCK[0] - 8.0);
                let ([x, y], length) = unit(a, b);
                let side = BLOCK[1] + 1.0;
                // Hatched below if it is horizontal, at the side if it is vertical.
                let down = if x < 0.0 { -1.0 } else { 1.0 };
                let (n_x, n_y) = (-y * side * down, x * side * down);
                let shift = |at: [f64; 2], k: f64| [at[0] + k * n_x, at[1] + k * n_y];
                if length > 0.0 {
                    let (from, to) = if down > 0.0 { (a, b) } else { (b, a) };
                    self.hatch(shift(from, 1.0), shift(to, 1.0));
                    self.svg
                        .path(&[shift(a, -1.0), shift(b, -1.0)], false, &ink);
                }
            }
            BodyPart::Block(at, angle) => {
                let corners = block(page(*at), *angle);
                self.svg.path(&corners, true, &ink.filled("#eef1f4"));
            }
            _ => {}
        }
    }

    /// A line with hatching on its right-hand side, seen from `a` to `b` on the page; below a line that runs to the right.
    fn hatch(&mut self, a: [f64; 2], b: [f64; 2]) {
        self.svg.path(&[a, b], false, &Ink::line(QUIET, 1.5));
        let ([x, y], length) = unit(a, b);
        let count = (length / 6.0).floor().max(1.0) as usize;
        for k in 0..=count {
            let way = length * k as f64 / count as f64;
            let at = [a[0] + way * x, a[1] + way * y];
            let foot = [at[0] - 5.0 * (x + y), at[1] - 5.0 * (y - x)];
            self.svg.path(&[at, foot], false, &Ink::line(QUIET, 1.0));
        }
    }
}

/// The corners of a block; `angle` counts counter-clockwise, y down.
fn block([x, y]: [f64; 2], angle: f64) -> [[f64; 2]; 4] {
    let (sin, cos) = math::sin_cos(angle);
    let [l, w] = BLOCK;
    [[l, w], [-l, w], [-l, -w], [l, -w]]
        .map(|[u, v]| [x + u * cos - v * sin, y - u * sin - v * cos])
}

/// The unit vector from `a` to `b`, and their distance.
fn unit(a: [f64; 2], b: [f64; 2]) -> ([f64; 2], f64) {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = math::hypot(x, y);
    if length > 0.0 {
        ([x / length, y / length], length)
    } else {
        ([1.0, 0.0], 0.0)
    }
}

/// Extends both ends by `by` (px).
fn overrun([a, b]: [[f64; 2]; 2], by: f64) -> [[f64; 2]; 2] {
    let ([x, y], _) = unit(a, b);
    [
        [a[0] - by * x, a[1] - by * y],
        [b[0] + by * x, b[1] + by * y],
    ]
}
