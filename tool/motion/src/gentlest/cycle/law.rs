//! A motion law as polynomials.

use jred::machine::motion::{End, Law, Polynomial};
use jred_file::model::motion::Phase;

use crate::moves::INSIDE;

/// Parts of a smooth stretch of a law.
const PARTS: u32 = 64;

/// Polynomials of fifth degree through position, speed and acceleration of a law; exact where the law is such a polynomial.
pub(super) fn phases(law: Law, distance: f64, duration: f64) -> Vec<Phase> {
    let mut ends = vec![0.0, 1.0];
    ends.extend(law.breaks().into_iter().flatten());
    ends.retain(|z| (0.0..=1.0).contains(z));
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let mut phases = Vec::new();
    for stretch in ends.windows(2) {
        let &[first, last] = stretch else { continue };
        let width = (last - first) / f64::from(PARTS);
        for k in 0..PARTS {
            let [from, to] = [k, k + 1].map(|k| first + f64::from(k) * width);
            let [start, end] = [from, to].map(|z| law.at(z));
            let inside = [from + INSIDE * width, to - INSIDE * width];
            let accelerations = inside.map(|z| law.at(z)[2]);
            let state = |speed: f64, acceleration: f64| {
                End::new(
                    distance * speed / duration,
                    distance * acceleration / (duration * duration),
                )
            };
            let span = width * duration;
            phases.push(Phase {
                duration: span,
                polynomial: Polynomial::between(
                    distance * (end[0] - start[0]),
                    span,
                    state(start[1], accelerations[0]),
                    state(end[1], accelerations[1]),
                ),
            });
        }
    }
    phases
}
