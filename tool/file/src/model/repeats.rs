//! Whether a machine repeats: whether its curves are the same after the drive link has advanced by an angle.

use crate::math;
use std::f64::consts::TAU;

use jred::machine::{Machine, Mechanism as _, PoseError, Reducible as _};

use crate::model::coordinate;
use crate::model::mechanism::AnyMechanism;

/// Positions per turn that are compared, besides the edges of loads and cams.
const POSITIONS: usize = 720;

/// Curves that differ by less than this share of their size are the same.
const CURVE_TOLERANCE: f64 = 1e-9;

/// The curves that are compared, with their units.
const CURVES: [(&str, &str); 6] = [
    ("J_red", "kg m^2"),
    ("dJ_red/dφ", "kg m^2/rad"),
    ("the torque of weight and springs", "N m"),
    ("the torque of the process loads", "N m"),
    ("the viscous coefficient", "N m s/rad"),
    ("the friction torque", "N m"),
];

/// A difference of a curve at two positions that should be equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The curve.
    pub curve: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The position (rad).
    pub phi: f64,
    /// The values there and after the advance.
    pub values: [f64; 2],
}

/// The largest difference, relative to the curve's size, between the machine at φ and at φ + `advance` (rad); `None` if it repeats.
///
/// # Errors
/// The machine cannot be placed.
pub fn difference(
    machine: &Machine<AnyMechanism>,
    advance: f64,
) -> Result<Option<Difference>, PoseError> {
    let mut places: Vec<f64> = coordinate::positions(machine.domain(), POSITIONS).collect();
    // Between two edges the curves are smooth, however close the edges are.
    let mut edges: Vec<f64> = (0..).map_while(|k| machine.edge(k)).collect();
    edges.extend_from_within(..);
    let shifted = edges.len() / 2;
    for edge in edges.iter_mut().skip(shifted) {
        *edge -= advance;
    }
    for edge in &mut edges {
        *edge = edge.rem_euclid(TAU);
    }
    edges.sort_by(f64::total_cmp);
    places.extend(edges.windows(2).map(|pair| pair[0].midpoint(pair[1])));
    let mut sizes = [0.0_f64; CURVES.len()];
    let mut rows = Vec::with_capacity(places.len());
    for phi in places {
        let [here, there] = [curves(machine, phi)?, curves(machine, phi + advance)?];
        for (size, values) in sizes.iter_mut().zip(here.1.iter().zip(&there.1)) {
            *size = size.max(values.0.abs()).max(values.1.abs());
        }
        rows.push((phi, here.0, there.0));
    }
    let mut worst: Option<(f64, Difference)> = None;
    for (phi, here, there) in rows {
        for (k, (curve, unit)) in CURVES.into_iter().enumerate() {
            let share = (there[k] - here[k]).abs() / sizes[k].max(f64::MIN_POSITIVE);
            if share > worst.map_or(CURVE_TOLERANCE, |(most, _)| most) {
                let values = [here[k], there[k]];
                let difference = Difference {
                    curve,
                    unit,
                    phi,
                    values,
                };
                worst = Some((share, difference));
            }
        }
    }
    Ok(worst.map(|(_, difference)| difference))
}

/// The curves at a position, and the size of their terms, the scale of rounding where they cancel.
fn curves(
    machine: &Machine<AnyMechanism>,
    phi: f64,
) -> Result<([f64; CURVES.len()], [f64; CURVES.len()]), PoseError> {
    let reduction = machine.bare_reduction(phi)?;
    let values = [
        reduction.inertia,
        reduction.inertia_slope,
        reduction.potential_slope,
        reduction.process,
        reduction.viscous,
        reduction.coulomb,
    ];
    let mut sizes = values;
    // J′ has the scale of J per radian, …
    sizes[1] = sizes[1].abs().max(reduction.inertia);
    // … and balanced weights have the scale of each.
    let [g_x, g_y] = machine.gravity();
    let mechanism = machine.mechanism();
    let frames = mechanism.frames(phi)?;
    let weight = mechanism.links().iter().zip(&frames).map(|(link, frame)| {
        let [x, y] = frame.point(link.com());
        link.mass() * math::hypot(g_x, g_y) * math::hypot(x.d1, y.d1)
    });
    sizes[2] = sizes[2].abs() + weight.sum::<f64>();
    Ok((values, sizes))
}
