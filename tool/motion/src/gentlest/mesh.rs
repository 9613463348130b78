//! Elements and stations of a move: w(u), the square of the pace, in cubic pieces.
//!
//! With the path s = D·g(u), v = D·g′·√w and a = D·(g″·w + ½·g′·w′). The acceleration and the squared speed are linear in w and w′, so a function
//! that is convex in v² and a stays convex in the unknowns. w and its slope are continuous, except at an edge of a load or a cam, where the
//! acceleration jumps: there each side has its own slope.

use jred::error::Error;
use jred_file::number::quadrature::GAUSS_5;

use super::{EndConditions, Travel};
use crate::collocation::pieces::{Value, dot, first_columns, hermite};
use crate::collocation::shape::Parametrization;
use crate::path_dynamics::Place;
use crate::skyline::Skyline;

/// A piece of the path: w, w′ at its start, w, w′ at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) span: [f64; 2],
    pub(super) values: [Value; 4],
}

/// A point of the quadrature.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub(super) element: usize,
    /// u
    pub(super) u: f64,
    /// Weight in the integral over u.
    pub(super) weight: f64,
    pub(super) place: Place,
    /// D·g′, D·g″
    pub(super) path: [f64; 2],
    /// Coefficients of the four values in w, and in w′.
    pub(super) basis: [[f64; 4]; 2],
}

impl Station {
    /// Speed and acceleration for w and w′, in a move of this duration (s).
    pub(super) fn state(&self, [w, change]: [f64; 2], duration: f64) -> [f64; 2] {
        let [slope, bend] = self.path;
        [
            slope * w.sqrt() / duration,
            (bend * w + 0.5 * slope * change) / (duration * duration),
        ]
    }
}

/// The elements of a move.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) shape: Parametrization,
    pub(super) elements: Vec<Element>,
    /// Parts of the elements, each with its own Gauss points: the element and its span.
    pub(super) cells: Vec<(usize, [f64; 2])>,
    pub(super) stations: Vec<Station>,
    pub(super) unknowns: usize,
    ring: bool,
}

/// Form of a ramp: it rises ever more slowly, as the acceleration of the laws does, linearly through these [share of its length, share of its
/// height].
const RISE: [[f64; 2]; 1] = [[0.5, 0.75]];

/// Slopes at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Continuity {
    /// One slope.
    Smooth,
    /// A slope on each side.
    Edge,
}

/// Elements of a motion with continuous acceleration: the ramps, and between them elements about as long as the requested ramp.
fn ramped([first, last]: [f64; 2], asked: f64) -> Vec<(f64, Continuity)> {
    let between = 1.0 - first - last;
    let count = (1.0 / asked - 2.0).round().max(2.0);
    let inner = (0..=count as usize).map(|k| first + between * k as f64 / count);
    let all = std::iter::once(0.0).chain(inner).chain([1.0]);
    all.map(|u| (u, Continuity::Smooth)).collect()
}

impl Mesh {
    /// About `parts` elements for a move, or as many cells of the quadrature where the acceleration is continuous. `edges` are the shares of the path
    /// at which a load begins or ends.
    pub(super) fn new(
        place: impl Fn(f64) -> Result<Place, Error>,
        travel: &Travel,
        ramps: [f64; 2],
        edges: &[f64],
        parts: usize,
    ) -> Result<Self, Error> {
        let ends = travel.ends();
        let shape = Parametrization::with_ramps(ends.rest, ramps, &RISE);
        let marks = edges.iter().map(|share| shape.place(*share));
        let bends = shape.knots().filter(|_| ends.ramp > 0.0);
        let marks = marks.chain(bends);
        let fine = nodes(marks.collect(), parts);
        let nodes = if ends.ramp > 0.0 {
            ramped(ramps, ends.ramp)
        } else {
            fine.clone()
        };
        let (elements, unknowns) = elements(&shape, travel, ends, &nodes);
        let cells = if ends.ramp > 0.0 {
            cells(&elements, &fine)
        } else {
            (0..elements.len()).map(|k| (k, elements[k].span)).collect()
        };
        let mut stations = Vec::with_capacity(GAUSS_5.len() * cells.len());
        let way_length = travel.distance.abs();
        for &(element, [from, to]) in &cells {
            let [start, end] = elements[element].span;
            let h = to - from;
            for [z, weight] in GAUSS_5 {
                let u = from + z * h;
                let [g, slope, bend] = shape.at(u);
                let [value, change, _] = hermite((u - start) / (end - start), end - start);
                stations.push(Station {
                    element,
                    u,
                    weight: weight * h,
                    place: place(travel.start + travel.distance * g)?,
                    path: [slope, bend].map(|derivative| derivative * way_length),
                    basis: [value, change],
                });
            }
        }
        Ok(Self {
            shape,
            elements,
            cells,
            stations,
            unknowns,
            ring: ends.ring,
        })
    }

    /// Whether the end is the start.
    pub(super) const fn is_ring(&self) -> bool {
        self.ring
    }

    /// w and w′ at a station.
    pub(super) fn pace(&self, x: &[f64], station: &Station) -> [f64; 2] {
        let values = self.values(x, station.element);
        station.basis.map(|basis| dot(&basis, &values))
    }

    /// The four values of an element.
    pub(super) fn values(&self, x: &[f64], element: usize) -> [f64; 4] {
        self.elements[element].values.map(|value| value.of(x))
    }

    /// Whether w is positive between all stations, too.
    pub(super) fn moves(&self, x: &[f64]) -> bool {
        let mut elements = self.elements.iter().enumerate();
        elements.all(|(index, element)| {
            let [from, to] = element.span;
            let [start, slope, end, last] = self.values(x, index);
            let (slope, last) = (slope * (to - from), last * (to - from));
            // w = start + slope·z + c₂·z² + c₃·z³, and the zeros of its slope.
            let c2 = 3.0 * (end - start) - 2.0 * slope - last;
            let c3 = 2.0 * (start - end) + slope + last;
            let root = c2 * c2 - 3.0 * c3 * slope;
            let pivot = -(c2 + root.max(0.0).sqrt().copysign(c2));
            let bottoms = [pivot / (3.0 * c3), slope / pivot];
            let is_free = |z: f64| start + z * (slope + z * (c2 + z * c3)) > 0.0;
            start >= 0.0
                && end >= 0.0
                && (root < 0.0
                    || bottoms
                        .into_iter()
                        .filter(|z| *z > 0.0 && *z < 1.0)
                        .all(is_free))
        })
    }

    /// The unknowns of a function of u and its slope.
    pub(super) fn sample(&self, f: impl Fn(usize, f64) -> [f64; 2]) -> Vec<f64> {
        let mut x = vec![0.0; self.unknowns];
        for (index, element) in self.elements.iter().enumerate() {
            for (end, u) in element.span.into_iter().enumerate() {
                for (k, value) in f(index, u).into_iter().enumerate() {
                    if let Value::Free(at) = element.values[2 * end + k] {
                        x[at] = value;
                    }
                }
            }
        }
        x
    }

    /// An empty matrix over the unknowns, bordered by one row for the time.
    pub(super) fn matrix(&self) -> Skyline {
        let elements = self.elements.iter();
        let mut first = first_columns(self.unknowns, elements.map(|element| &element.values[..]));
        first.push(0);
        Skyline::new(first)
    }
}

/// Shortest distance of an edge from another node, as a share of u.
const EDGE_SPACING: f64 = 1e-7;

/// About `parts` equal pieces, cut at marks.
fn nodes(mut marks: Vec<f64>, parts: usize) -> Vec<(f64, Continuity)> {
    marks.extend([0.0, 1.0]);
    marks.sort_by(f64::total_cmp);
    marks.dedup_by(|a, b| *a - *b < EDGE_SPACING);
    let mut nodes = Vec::new();
    for pair in marks.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let count = ((parts as f64 * (to - from)).ceil() as usize).max(2);
        nodes.push((from, Continuity::Edge));
        for k in 1..count {
            let u = from + (to - from) * k as f64 / count as f64;
            nodes.push((u, Continuity::Smooth));
        }
    }
    nodes.push((1.0, Continuity::Edge));
    nodes
}

/// The elements cut at the nodes of a finer mesh.
fn cells(elements: &[Element], fine: &[(f64, Continuity)]) -> Vec<(usize, [f64; 2])> {
    let mut cells = Vec::new();
    for (index, element) in elements.iter().enumerate() {
        let [mut from, to] = element.span;
        for (u, _) in fine {
            if *u > from + EDGE_SPACING && *u < to - EDGE_SPACING {
                cells.push((index, [from, *u]));
                from = *u;
            }
        }
        cells.push((index, [from, to]));
    }
    cells
}

/// The values at a node: slope on the left, w, slope on the right.
type NodeValues = [Value; 3];

fn elements(
    shape: &Parametrization,
    travel: &Travel,
    ends: EndConditions,
    nodes: &[(f64, Continuity)],
) -> (Vec<Element>, usize) {
    let last = nodes.len() - 1;
    let mut unknowns = 0;
    let mut next = || {
        unknowns += 1;
        Value::Free(unknowns - 1)
    };
    let level = Value::Fixed(0.0);
    let mut all: Vec<NodeValues> = Vec::with_capacity(nodes.len());
    for (k, (u, kind)) in nodes.iter().enumerate() {
        let end = match k {
            0 => Some(0),
            _ if k == last => Some(1),
            _ => None,
        };
        if let (Some(_), true) = (end, ends.ring) {
            all.push([level; 3]);
            continue;
        }
        if let Some(end) = end.filter(|end| !ends.rest[*end]) {
            // At a moving end the speed is given, and with ramps the acceleration.
            let [_, slope, bend] = shape.at(*u);
            let per_way = travel.duration / travel.distance.abs();
            let pace = travel.speeds[end] * per_way / slope;
            let w = pace * pace;
            let change = if ends.ramp > 0.0 {
                let rise = travel.accelerations[end] * travel.duration * per_way;
                Value::Fixed(2.0 * (rise - bend * w) / slope)
            } else {
                next()
            };
            all.push([change, Value::Fixed(w), change]);
            continue;
        }
        let of_ramp = [(k <= 1, 1, 0), (k + 1 >= last, last - 1, 1)];
        let is_ramp = |end: usize| ends.ramp > 0.0 && ends.rest[end];
        let mut of_ramp = of_ramp.into_iter();
        if let Some((_, border, end)) = of_ramp.find(|(near, _, end)| *near && is_ramp(*end)) {
            // In a ramp the pace is constant, from the share of the time that the ramp takes.
            let length = (nodes[border].0 - end as f64).abs();
            let pace = length / ends.ramp;
            all.push([level, Value::Fixed(pace * pace), level]);
            continue;
        }
        all.push(match kind {
            Continuity::Smooth => {
                let w = next();
                let slope = next();
                [slope, w, slope]
            }
            Continuity::Edge => {
                let left = if k == 0 { level } else { next() };
                let w = next();
                let right = if k == last { level } else { next() };
                [left, w, right]
            }
        });
    }
    if ends.ring {
        let (w, left, right) = (next(), next(), next());
        all[0] = [left, w, right];
        all[last] = [left, w, right];
    }
    let elements = all.windows(2).zip(nodes.windows(2)).map(|(values, nodes)| {
        let [[_, w0, s0], [s1, w1, _]] = [values[0], values[1]];
        Element {
            span: [nodes[0].0, nodes[1].0],
            values: [w0, s0, w1, s1],
        }
    });
    (elements.collect(), unknowns)
}
