//! Where curves lie against others: their shift, and whether they are mirrored.
//!
//! ```text
//! F(δ) = Σ(J(φ + δ) − J₀(φ))²/band² + Σ(V′(φ + δ) − V′₀(φ))²/band²        without their means, by the widest bands of J and V′
//! ```

use std::f64::consts::TAU;

use super::{CurvePoint, Fault, Identified};

/// Share of the deviation that a shift, or a reversed position, must leave to be the cause.
const CAUSE: f64 = 0.25;

/// J and V′ at equal steps of a turn, without their means.
struct Curves([Vec<f64>; 2]);

/// The best shift (rad), its F, F without a shift, and the shift (rad) by which F rises by twice a band squared.
struct Place {
    shift: f64,
    best: f64,
    here: f64,
    sure: f64,
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
    fn deviation(&self, others: &Self, by: usize, bands: [f64; 2]) -> f64 {
        let each = self.0.iter().zip(&others.0).zip(bands);
        let each = each.map(|((own, other), band)| {
            let shifted = own.iter().cycle().skip(by);
            let off: f64 = shifted.zip(other).map(|(a, b)| (a - b).powi(2)).sum();
            off / (band * band)
        });
        each.sum()
    }

    fn place(&self, others: &Self, bands: [f64; 2]) -> Place {
        let count = self.0[0].len();
        let all: Vec<f64> = (0..count)
            .map(|by| self.deviation(others, by, bands))
            .collect();
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
            sure: 2.0 * TAU / count.max(1) as f64 / curvature.max(1e-300).sqrt(),
        }
    }
}

/// The widest bands of J and V′.
fn bands<'a>(points: impl Iterator<Item = &'a CurvePoint>) -> [f64; 2] {
    points.fold([1e-150, 1e-150], |[j, v], point| {
        [j.max(point.inertia.band), v.max(point.potential_slope.band)]
    })
}

/// The shift (rad) by which the first curves are later than the second, if it is the cause of most of their deviation and larger than their bands explain.
pub fn shift(points: &[CurvePoint], others: &[CurvePoint]) -> Option<f64> {
    let bands = bands(points.iter().chain(others));
    caused(&Curves::of(points), &Curves::of(others), bands)
}

/// The shift that leaves a quarter of the deviation at most, if it is larger than 2/√F″, which the bands alone may cause.
fn caused(own: &Curves, others: &Curves, bands: [f64; 2]) -> Option<f64> {
    let place = own.place(others, bands);
    (place.best < CAUSE * place.here && place.shift.abs() > place.sure.max(TAU / 1440.0))
        .then_some(place.shift)
}

/// Positions of a log that are this many times too small: encoders are counted by one, two or four edges.
const SCALES: [f64; 4] = [0.25, 0.5, 2.0, 4.0];

/// A deviation of J from the design above this share of its maximum is no tolerance.
pub const OTHER: f64 = 0.5;

/// A root mean square deviation of J and V′ below this share of their largest values is that of the same machine.
const SAME: f64 = 0.2;

/// Torques of this share are those of the design: masses differ as much.
const ALIKE: std::ops::RangeInclusive<f64> = 0.7..=1.4;

/// Another way to read a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// With positions times a factor.
    Scaled(f64),
    /// As that of the motor instead of the drive link, or the other way round.
    OtherShaft,
}

/// The sum of squares by which J and V′ are off the design, at the best shift, as shares of its largest values.
fn off(own: impl Iterator<Item = [f64; 2]>, designed: &[[f64; 2]]) -> f64 {
    let own: Vec<[f64; 2]> = own.collect();
    let size = |of: fn(&[f64; 2]) -> f64| designed.iter().map(of).fold(0.0, f64::max);
    // Without weight and springs J alone tells.
    let most = [size(|[j, _]| j.abs()), size(|[_, v]| v.abs())];
    let most = most.map(|most| if most > 0.0 { most } else { f64::INFINITY });
    let at = |by: usize| -> f64 {
        let shifted = own.iter().cycle().skip(by);
        let square = |(a, b): (&[f64; 2], &[f64; 2])| {
            ((a[0] - b[0]) / most[0]).powi(2) + ((a[1] - b[1]) / most[1]).powi(2)
        };
        shifted.zip(designed).map(square).sum()
    };
    (0..own.len()).map(at).fold(f64::INFINITY, f64::min)
}

fn curves_of(found: &Identified) -> impl Iterator<Item = [f64; 2]> {
    let each = found.curves.iter();
    each.map(|p| [p.inertia.value, p.potential_slope.value])
}

/// Replaces the faults by that of wrong counts, of the wrong shaft or of a wrong torque, if such a log of the design would give these curves. `read`
/// identifies the machine with the log read in another way; `design` gives J and V′ to compare with: of the direction of a log of one.
pub fn judge_reading(
    found: &mut Identified,
    design: impl Fn(&Identified) -> Vec<[f64; 2]>,
    read: impl Fn(Reading) -> Option<Identified>,
) {
    if found
        .faults
        .iter()
        .any(|fault| matches!(fault, Fault::Reversed { .. }))
    {
        return;
    }
    let designed = &design(found)[..];
    let here = off(curves_of(found), designed);
    let same = SAME.powi(2) * designed.len() as f64;
    let both = || curves_of(found).zip(designed);
    let most = designed.iter().fold(0.0, |most: f64, [j, _]| most.max(*j));
    let other = both().any(|([j, _], [designed, _])| (j - designed).abs() > OTHER * most);
    let noisy = |fault: &Fault| matches!(fault, Fault::Noisy { .. });
    let mut causes = Vec::new();
    if other || found.faults.iter().any(noisy) {
        let scales = SCALES.map(Reading::Scaled);
        let readings = scales.into_iter().chain([Reading::OtherShaft]);
        causes.extend(readings.filter_map(|reading| {
            let fault = match reading {
                Reading::Scaled(by) => Fault::Scale { by },
                Reading::OtherShaft => Fault::Shaft,
            };
            let read = read(reading)?;
            Some((fault, off(curves_of(&read), &design(&read))))
        }));
    }
    let squares: f64 = designed.iter().map(|[j, _]| j * j).sum();
    let by = both().map(|([j, _], [d, _])| j * d).sum::<f64>() / squares;
    if by > 0.0 && !ALIKE.contains(&by) {
        let scaled = curves_of(found).map(|[j, v]| [j / by, v / by]);
        let more = both().map(|([j, _], [d, _])| j - d).sum::<f64>() / designed.len() as f64;
        // A rotor that was not taken out is a constant more.
        let constant = off(curves_of(found).map(|[j, v]| [j - more, v]), designed);
        let scaled = off(scaled, designed);
        if scaled < CAUSE * constant && constant > same {
            causes.push((Fault::Torque { by }, scaled));
        }
    }
    let best = causes.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((fault, _)) = best.filter(|best| best.1 < same.min(CAUSE * here)) {
        found.faults = vec![fault];
    }
}

/// Adds the faults that only the design (J, V′ at the angles of the curves) shows: the other zero, the mirrored position, and what is reversed.
pub fn against_design(found: &mut Identified, designed: &[[f64; 2]]) {
    let (own, design) = (
        Curves::of(&found.curves),
        Curves::new(designed.iter().copied()),
    );
    let bands = bands(found.curves.iter());
    let reversed = found
        .faults
        .iter()
        .position(|fault| matches!(fault, Fault::Reversed { .. }));
    if let Some(at) = reversed {
        let torque = own.scaled(-1.0).place(&design, bands);
        let position = own.mirrored([-1.0, 1.0]).place(&design, bands);
        // Of two that fit alike at some zero, the one that fits at this zero.
        let better = |a: f64, b: f64| a < CAUSE * b;
        let pairs = [(position.best, torque.best), (position.here, torque.here)];
        let decided = pairs.iter().find(|(a, b)| better(*a, *b) || better(*b, *a));
        found.faults[at] = Fault::Reversed {
            position: decided.map(|(position, torque)| position < torque),
        };
    } else if own.mirrored([1.0, -1.0]).place(&design, bands).best
        < CAUSE * own.place(&design, bands).best
    {
        found.faults.push(Fault::Mirrored);
    } else if let Some(by) = caused(&own, &design, bands) {
        found.faults.push(Fault::Zero { by });
    }
}
