//! The square of the pace in pieces of fifth degree, and the stations at which limits are imposed.
//!
//! Along the path s = L·g(u) of [`Parametrization`], w = (du/dτ)², with τ the time in the programme's own unit. w and w′ are continuous, and so is the
//! acceleration. w″, and with it the jerk, may jump where two pieces meet. With the fifth degree w″ is a cubic in each piece, which follows an arc of
//! constant jerk or of constant torque with an error of order 4.

use jred::error::Error;

use crate::collocation::pieces::{Value, dot, first_columns, hermite};
use crate::collocation::shape::Parametrization;
use crate::fastest::field::Field;
use crate::fastest::track::CORNER_INSET;
use crate::path_dynamics::Place;
use crate::skyline::Skyline;

/// Unknowns of a piece: w and w′ at its start, factors of two functions that are zero with zero slope at both ends, w and w′ at its end.
pub(super) const VALUES: usize = 6;

/// Coefficients of the values of one piece.
pub(super) type Local = [f64; VALUES];

/// Least distance of a corner from the end as a share of u: in a short piece, rounding of u must not move it outside.
const CORNER_SPACING: f64 = 1e-13;

/// Conditions at the ends of the motion, and jumps that are allowed inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundaryConditions {
    /// Whether each end is at rest.
    pub(super) rest: [bool; 2],
    /// w at an end that moves.
    pub(super) pace: [f64; 2],
    /// Whether the acceleration is zero at the ends.
    pub(super) level: bool,
    /// Whether it is continuous inside.
    pub(super) smooth: bool,
}

/// Where two pieces meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Border {
    pub(super) u: f64,
    /// Whether the machine is not smooth there.
    pub(super) is_corner: bool,
    /// Whether it must stay where it is: at a corner, or where two pieces of the path meet.
    pub(super) stays: bool,
    /// Whether the piece that begins here is a cubic: the active limit changes in it, and a higher degree would oscillate.
    pub(super) is_plain: bool,
}

/// A piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) span: [f64; 2],
    pub(super) values: [Value; VALUES],
}

/// A place at which limits are imposed, and a point of the quadrature.
#[derive(Clone, Debug)]
pub(super) struct Station {
    pub(super) element: usize,
    pub(super) u: f64,
    pub(super) weight: f64,
    pub(super) place: Place,
    /// The drive link's speed at the tool's speed limit (rad/s, or m/s).
    pub(super) tool: f64,
    /// L·g′, L·g″, L·g‴.
    pub(super) path: [f64; 3],
    /// Coefficients of the piece's values in w, w′, w″.
    pub(super) basis: [Local; 3],
    /// Slopes of the machine by u.
    pub(super) change: Slopes,
}

/// Slopes of the machine by u.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slopes {
    pub(super) inertia: f64,
    pub(super) inertia_slope: f64,
    /// Slope of the load with Coulomb friction.
    pub(super) load: f64,
    pub(super) viscous: f64,
}

/// Stations of a piece as shares of it, and their weights: Lobatto's seven points, which include both ends. Exact to degree 11.
pub(super) const SHARES: [[f64; 2]; 7] = [
    [0.0, 1.0 / 42.0],
    [0.084_888_051_860_716_54, 0.138_413_023_680_782_97],
    [0.265_575_603_264_642_9, 0.215_872_690_604_931_3],
    [0.5, 128.0 / 525.0],
    [0.734_424_396_735_357_1, 0.215_872_690_604_931_3],
    [0.915_111_948_139_283_5, 0.138_413_023_680_782_97],
    [1.0, 1.0 / 42.0],
];

/// Slopes at the stations of a piece of length h, from the polynomial through the values at all stations.
fn changes(places: &[Place], h: f64) -> impl Iterator<Item = Slopes> {
    let at = move |k: usize, value: fn(&Place) -> f64| {
        let each = (0..SHARES.len()).filter(|j| *j != k).map(|j| {
            let [zk, zj] = [SHARES[k][0], SHARES[j][0]];
            // Slope of Lagrange's polynomial of the station j at k; the slopes of all j add up to zero.
            let others = (0..SHARES.len()).filter(|i| *i != j && *i != k);
            let slope = others.fold(1.0 / (zj - zk), |slope, i| {
                slope * (zk - SHARES[i][0]) / (zj - SHARES[i][0])
            });
            slope * (value(&places[j]) - value(&places[k]))
        });
        each.sum::<f64>() / h
    };
    (0..places.len()).map(move |k| Slopes {
        inertia: at(k, |place| place.inertia),
        inertia_slope: at(k, |place| place.inertia_slope),
        load: at(k, |place| place.load + place.coulomb),
        viscous: at(k, |place| place.viscous),
    })
}

/// The pieces of a path.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) elements: Vec<Element>,
    pub(super) stations: Vec<Station>,
    pub(super) unknowns: usize,
}

/// Coefficients of the six values in w, w′ and w″ at the share z of a piece of length h.
pub(super) fn basis(z: f64, h: f64) -> [Local; 3] {
    let cubic = hermite(z, h);
    // 16·z²·(1 − z)² and the same times (2z − 1), with their derivatives.
    let q = 16.0;
    let even = [
        q * z * z * (1.0 - z) * (1.0 - z),
        q * 2.0 * z * (1.0 - z) * (1.0 - 2.0 * z) / h,
        q * (2.0 - 12.0 * z + 12.0 * z * z) / (h * h),
    ];
    let lean = 2.0 * z - 1.0;
    let odd = [
        even[0] * lean,
        even[1] * lean + 2.0 * even[0] / h,
        even[2] * lean + 4.0 * even[1] / h,
    ];
    [0, 1, 2].map(|k| {
        let [a, b, c, d] = cubic[k];
        [a, b, even[k], odd[k], c, d]
    })
}

impl Mesh {
    /// Pieces between borders, from 0 to 1. At corners the acceleration may jump unless it must be continuous.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub(super) fn new(
        field: &Field,
        course: [f64; 2],
        shape: &Parametrization,
        form: BoundaryConditions,
        borders: &[Border],
    ) -> Result<Self, Error> {
        let (elements, unknowns) = elements(shape, form, borders);
        let [start, distance] = course;
        let mut stations = Vec::with_capacity(elements.len() * SHARES.len());
        for (index, element) in elements.iter().enumerate() {
            let [from, to] = element.span;
            let h = to - from;
            for [z, weight] in SHARES {
                let u = from + z * h;
                let near = (CORNER_SPACING / h).clamp(CORNER_INSET, 0.1);
                let inside = from + z.clamp(near, 1.0 - near) * h;
                let [_, slope, bend, jerk] = shape.series(u, from.midpoint(to));
                let [g, ..] = shape.series(inside, inside);
                let place = field.dynamics.place(start + distance * g)?;
                stations.push(Station {
                    element: index,
                    u,
                    weight: weight * h,
                    place,
                    tool: field.tool_speed(place.phi)?,
                    path: [slope, bend, jerk].map(|derivative| derivative * distance.abs()),
                    basis: basis(z, h),
                    change: Slopes::default(),
                });
            }
            if form.smooth {
                let own = &mut stations[index * SHARES.len()..];
                let places: Vec<Place> = own.iter().map(|station| station.place).collect();
                for (station, change) in own.iter_mut().zip(changes(&places, h)) {
                    station.change = change;
                }
            }
        }
        Ok(Self {
            elements,
            stations,
            unknowns,
        })
    }

    /// The values of a piece.
    pub(super) fn values(&self, x: &[f64], element: usize) -> Local {
        self.elements[element].values.map(|value| value.of(x))
    }

    /// w, w′, w″ at a share of a piece.
    pub(super) fn pace(&self, x: &[f64], element: usize, z: f64) -> [f64; 3] {
        let [from, to] = self.elements[element].span;
        let values = self.values(x, element);
        basis(z, to - from).map(|basis| dot(&basis, &values))
    }

    /// The unknowns that approximate the motion of another mesh as closely as these pieces can.
    pub(super) fn refined(&self, other: &Self, x: &[f64]) -> Vec<f64> {
        let mut fine = vec![0.0; self.unknowns];
        for element in &self.elements {
            let [from, to] = element.span;
            let h = to - from;
            let middle = from.midpoint(to);
            let pace = |u: f64| {
                let within = u + CORNER_INSET * (middle - u);
                let at = other.elements.partition_point(|e| e.span[1] <= within);
                let at = at.min(other.elements.len() - 1);
                let [start, end] = other.elements[at].span;
                other.pace(x, at, (u - start) / (end - start))
            };
            let [[w0, s0, _], [w1, s1, _]] = [pace(from), pace(to)];
            // The remainder from the cubic at two places gives the other two values.
            let left = |z: f64| {
                let [b, ..] = basis(z, h);
                pace(from + z * h)[0] - dot(&b, &[w0, s0, 0.0, 0.0, w1, s1])
            };
            let [p, q] = [0.25, 0.75].map(left);
            let bump = 16.0 * (0.25f64 * 0.75).powi(2);
            let all = [w0, s0, 0.5 * (p + q) / bump, (q - p) / bump, w1, s1];
            for (value, own) in element.values.iter().zip(all) {
                if let Value::Free(index) = value {
                    fine[*index] = own;
                }
            }
        }
        fine
    }

    /// The same where the other motion's polynomials fall below zero: between its stations w is interpolated linearly.
    pub(super) fn levelled(&self, other: &Self, x: &[f64]) -> Vec<f64> {
        let stations = other.stations.iter();
        let at: Vec<[f64; 2]> = stations
            .map(|station| {
                let values = other.values(x, station.element);
                [station.u, dot(&station.basis[0], &values)]
            })
            .collect();
        let mut fine = vec![0.0; self.unknowns];
        for element in &self.elements {
            for (k, u) in [(0, element.span[0]), (4, element.span[1])] {
                if let Value::Free(index) = element.values[k] {
                    let next = at.partition_point(|[from, _]| *from <= u);
                    let [[u0, w0], [u1, w1]] = [at[next.max(1) - 1], at[next.min(at.len() - 1)]];
                    let share = if u1 > u0 { (u - u0) / (u1 - u0) } else { 0.0 };
                    fine[index] = w0 + share * (w1 - w0);
                }
            }
        }
        fine
    }

    /// The unknowns of a constant pace.
    pub(super) fn even(&self, w: f64) -> Vec<f64> {
        let mut x = vec![0.0; self.unknowns];
        for element in &self.elements {
            for k in [0, 4] {
                if let Value::Free(index) = element.values[k] {
                    x[index] = w;
                }
            }
        }
        x
    }

    /// An empty matrix over the unknowns.
    pub(super) fn matrix(&self) -> Skyline {
        let elements = self.elements.iter();
        let first = first_columns(self.unknowns, elements.map(|element| &element.values[..]));
        Skyline::new(first)
    }
}

fn elements(
    shape: &Parametrization,
    form: BoundaryConditions,
    borders: &[Border],
) -> (Vec<Element>, usize) {
    let mut unknowns = 0;
    let mut next = || {
        unknowns += 1;
        Value::Free(unknowns - 1)
    };
    let last = borders.len() - 1;
    // w and w′ at the start of a piece.
    let mut before = [Value::Fixed(0.0); 2];
    let mut elements: Vec<Element> = Vec::with_capacity(last);
    for (k, border) in borders.iter().enumerate() {
        let u = border.u;
        let inner = if k > 0 && !borders[k - 1].is_plain {
            [next(), next()]
        } else {
            [Value::Fixed(0.0); 2]
        };
        let end = match k {
            0 => Some(0),
            _ if k == last => Some(1),
            _ => None,
        };
        let at = match end.filter(|end| !form.rest[*end]) {
            Some(end) => {
                let [_, slope, bend, _] = shape.series(u, u);
                let w = form.pace[end];
                let change = if form.level {
                    Value::Fixed(-2.0 * bend * w / slope)
                } else {
                    next()
                };
                [Value::Fixed(w), change]
            }
            None => [next(), next()],
        };
        if k > 0 {
            let [w0, s0] = before;
            let [w1, s1] = at;
            elements.push(Element {
                span: [borders[k - 1].u, u],
                values: [w0, s0, inner[0], inner[1], w1, s1],
            });
        }
        let jumps = border.is_corner && !form.smooth && k > 0 && k < last;
        before = if jumps { [at[0], next()] } else { at };
    }
    (elements, unknowns)
}
