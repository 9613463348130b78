//! The required peak torque over speed.

use super::{Inquiry, Requirement};
use crate::catalogue::Motor;
use crate::motor::envelope::Envelope;
use jred_file::model::rule::Rule;

/// Most points of the limit.
const MOST: usize = 6;

/// Reserve of the limit: the peak between two samples is found at the closest sample only, and in a symmetric motion two are equally close.
const RESERVE: f64 = 1e-5;

/// A point is left out if that adds less than this share to the area below the limit.
const FINE: f64 = 2e-3;

impl Inquiry<'_> {
    /// The least concave limit of the peak torque over speed, as a few points. Between the samples it is scaled until the duty touches it, as judged
    /// by the rule itself.
    pub(super) fn envelope(&self, found: &Requirement, rotors: [f64; 2]) -> Vec<[f64; 2]> {
        let ratio = found.ratio.unwrap_or(1.0);
        let share = self.share(Rule::PeakTorque);
        // At the mean speed the S1 torque is required, and no motor has less peak torque.
        let mut points = vec![
            [found.mean_speed, found.s1_torque],
            [0.0, found.standstill_torque],
        ];
        for rotor in rotors {
            let drawn = self.points(found.ratio, rotor);
            points.extend(drawn.map(|[speed, torque]| [speed, torque / share]));
        }
        let mut limit = simplified(hull(points, found.max_speed));
        let motor = Motor {
            peak_curve: limit.clone(),
            ..self.motor(1.0)
        };
        let envelope = Envelope::at(&motor, None, &self.file.site);
        let used = rotors.map(|rotor| {
            let coefficients = self.coefficients(found.ratio, rotor);
            self.cycle.peak(&coefficients, ratio, &envelope).used
        });
        let used = used.into_iter().fold(0.0, f64::max) / share;
        let mean = envelope.peak_torque(1.0, found.mean_speed);
        let scale = used.max(found.s1_torque / mean) * (1.0 + RESERVE);
        if scale.is_finite() {
            for point in &mut limit {
                // The constant peak torque is sufficient everywhere.
                point[1] = (point[1] * scale).min(found.peak_torque);
                if point[1] < 1e-9 * found.peak_torque {
                    point[1] = 0.0;
                }
            }
        }
        limit
    }
}

/// The upper hull of points over speed from its highest point on, level from standstill up to there, and level from the last one to `end`.
fn hull(mut points: Vec<[f64; 2]>, end: f64) -> Vec<[f64; 2]> {
    let top = |points: &[[f64; 2]], by: usize| {
        let largest = points.iter().max_by(|a, b| a[by].total_cmp(&b[by]));
        largest.map_or(0.0, |point| point[1])
    };
    let end = points.iter().map(|p| p[0]).fold(end, f64::max);
    let (highest, last) = (top(&points, 1), top(&points, 0));
    points.push([0.0, highest]);
    points.push([end, last]);
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
    let mut hull: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = hull[..]
            && (b[1] - a[1]) * (point[0] - a[0]) <= (point[1] - a[1]) * (b[0] - a[0])
        {
            hull.pop();
        }
        // Of points at one speed the first is the highest.
        if hull.last().is_none_or(|last| point[0] > last[0]) {
            hull.push(point);
        }
    }
    hull
}

/// A concave limit above a hull with at most [`MOST`] points: edges whose neighbours, extended to their intersection, add least area are left out.
fn simplified(mut hull: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let below = hull
        .windows(2)
        .map(|pair| (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]));
    let fine = FINE * below.sum::<f64>();
    while hull.len() > 3 {
        let merged = (1..hull.len() - 2).filter_map(|k| {
            let corners = [hull[k - 1], hull[k], hull[k + 1], hull[k + 2]];
            let point = meeting(corners)?;
            Some((k, point, area([hull[k], point, hull[k + 1]])))
        });
        let Some((k, point, added)) = merged.min_by(|a, b| a.2.total_cmp(&b.2)) else {
            break;
        };
        if hull.len() <= MOST && added > fine {
            break;
        }
        hull[k] = point;
        hull.remove(k + 1);
    }
    hull
}

/// The intersection of the line through the first two points with that through the last two, between the inner ones.
fn meeting([a, b, c, d]: [[f64; 2]; 4]) -> Option<[f64; 2]> {
    let slope = |p: [f64; 2], q: [f64; 2]| (q[1] - p[1]) / (q[0] - p[0]);
    let (first, last) = (slope(a, b), slope(c, d));
    let speed = (c[1] - b[1] + first * b[0] - last * c[0]) / (first - last);
    let is_between = speed >= b[0] && speed <= c[0];
    is_between.then(|| [speed, b[1] + first * (speed - b[0])])
}

/// Twice the area of a triangle.
fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs()
}
