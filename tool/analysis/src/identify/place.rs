//! Where curves lie against others: their shift, and whether they are mirrored.
//!
//! ```text
//! F(δ) = Σ(J(φ + δ) − J₀(φ))²/Σ(J² + J₀²) + Σ(V′(φ + δ) − V′₀(φ))²/Σ(V′² + V′₀²)        without their means
//! ```

use std::f64::consts::TAU;

use super::{CurvePoint, Fault, Identified};

/// Share of the deviation that a shift, or a reversed position, must leave to be the cause.
const CAUSE: f64 = 0.25;

/// J and V′ at equal steps of a turn, without their means.
struct Curves([Vec<f64>; 2]);

/// The best shift (rad), its F, and F without a shift.
struct Place {
    shift: f64,
    best: f64,
    here: f64,
}

impl Curves {
    fn new(values: impl Iterator<Item = [f64; 2]>) -> Self {
        let [mut j, mut v]: [Vec<f64>; 2] = Default::default();
        for [inertia, slope] in values {
            j.push(inertia);
            v.push(slope);
        }
        for curve in [&mut j, &mut v] {
            let mean = curve.iter().sum::<f64>() / curve.len().max(1) as f64;
            for y in curve.iter_mut() {
                *y -= mean;
            }
        }
        Self([j, v])
    }

    fn of(points: &[CurvePoint]) -> Self {
        Self::new(
            points
                .iter()
                .map(|p| [p.inertia.value, p.potential_slope.value]),
        )
    }

    /// The curves over −φ, with these factors.
    fn mirrored(&self, factors: [f64; 2]) -> Self {
        let [j, v] = &self.0;
        let of = |curve: &[f64], factor: f64| {
            let count = curve.len();
            (0..count)
                .map(|k| factor * curve[(count - k) % count])
                .collect()
        };
        Self([of(j, factors[0]), of(v, factors[1])])
    }

    fn scaled(&self, factor: f64) -> Self {
        let [j, v] = &self.0;
        Self([j, v].map(|curve| curve.iter().map(|y| factor * y).collect()))
    }

    /// F with the place `by` of these curves at φ = 0 of the others.
    fn deviation(&self, others: &Self, by: usize) -> f64 {
        let each = self.0.iter().zip(&others.0).map(|(own, other)| {
            let shifted = own.iter().cycle().skip(by);
            let off: f64 = shifted.zip(other).map(|(a, b)| (a - b).powi(2)).sum();
            let size: f64 = own.iter().chain(other).map(|y| y * y).sum();
            off / size.max(1e-300)
        });
        each.sum()
    }

    fn place(&self, others: &Self) -> Place {
        let count = self.0[0].len();
        let all: Vec<f64> = (0..count).map(|by| self.deviation(others, by)).collect();
        let at = (0..count)
            .min_by(|a, b| all[*a].total_cmp(&all[*b]))
            .unwrap_or(0);
        let [before, here, after] =
            [count - 1, 0, 1].map(|k| all.get((at + k) % count.max(1)).copied().unwrap_or(0.0));
        let curvature = before - 2.0 * here + after;
        let part = if curvature > 0.0 {
            0.5 * (before - after) / curvature
        } else {
            0.0
        };
        let turns = (at as f64 + part) / count.max(1) as f64;
        Place {
            shift: (turns - turns.round()) * TAU,
            best: here - 0.25 * (before - after) * part,
            here: all.first().copied().unwrap_or(0.0),
        }
    }
}

/// The shift (rad) by which the first curves are later than the second, if it is the cause of most of their deviation and larger than their bands explain.
pub fn shift(points: &[CurvePoint], others: &[CurvePoint]) -> Option<f64> {
    let bands = others.iter().map(|point| point.inertia.band);
    caused(
        &Curves::of(points),
        &Curves::of(others),
        points,
        bands.fold(0.0, f64::max),
    )
}

fn caused(own: &Curves, others: &Curves, points: &[CurvePoint], band: f64) -> Option<f64> {
    let place = own.place(others);
    let count = points.len().max(1) as f64;
    let slopes = points
        .iter()
        .map(|point| point.inertia_slope.powi(2))
        .sum::<f64>()
        / count;
    let bands = points
        .iter()
        .map(|point| point.inertia.band)
        .fold(band, f64::max);
    let sure = bands / slopes.sqrt().max(1e-300);
    (place.best < CAUSE * place.here && place.shift.abs() > sure.max(TAU / 1440.0))
        .then_some(place.shift)
}

/// Adds the faults that only the design (J, V′ at the angles of the curves) shows: the other zero, the mirrored position, and what is reversed.
pub fn against_design(found: &mut Identified, designed: &[[f64; 2]]) {
    let (own, design) = (
        Curves::of(&found.curves),
        Curves::new(designed.iter().copied()),
    );
    let reversed = found
        .faults
        .iter()
        .position(|fault| matches!(fault, Fault::Reversed { .. }));
    if let Some(at) = reversed {
        let torque = own.scaled(-1.0).place(&design).best;
        let position = own.mirrored([-1.0, 1.0]).place(&design).best;
        found.faults[at] = Fault::Reversed {
            position: position < torque,
        };
    } else if own.mirrored([1.0, -1.0]).place(&design).best < CAUSE * own.place(&design).best {
        found.faults.push(Fault::Mirrored);
    } else if let Some(by) = caused(&own, &design, &found.curves, 0.0) {
        found.faults.push(Fault::Zero { by });
    }
}
