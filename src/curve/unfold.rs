//! Signs for a magnitude: |v′| has a kink where v′ changes its sign; v′ does not.

use crate::math;

/// Gives samples of a magnitude the signs of the smoothest curve with this magnitude: each sample takes the sign predicted by the cubic through the
/// four before it. So a sign can be wrong only where the sample is as small as the error of the fit. On a turn the signs must close; otherwise the
/// samples stay unchanged.
pub(crate) fn unfold(samples: &mut [f64], periodic: bool) {
    let count = samples.len();
    let magnitude = |samples: &[f64], k: usize| samples.get(k).map_or(0.0, |s| math::abs(*s));
    // The sign is certain at and near the largest magnitude.
    let start = (0..count)
        .max_by(|a, b| magnitude(samples, *a).total_cmp(&magnitude(samples, *b)))
        .unwrap_or(0);
    let next = |before: [f64; 4], magnitude: f64| {
        let [f4, f3, f2, f1] = before;
        let predicted = 4.0 * f1 - 6.0 * f2 + 4.0 * f3 - f4;
        [
            f3,
            f2,
            f1,
            if predicted < 0.0 {
                -magnitude
            } else {
                magnitude
            },
        ]
    };
    if periodic {
        let at = |k: usize| (start + count + k - 3) % count;
        let before = [0, 1, 2, 3].map(|k| magnitude(samples, at(k)));
        // A first pass over one turn plus one sample checks whether the signs close.
        let end = (4..count + 4).fold(before, |before, k| next(before, magnitude(samples, at(k))));
        if end.iter().any(|sample| *sample < 0.0) {
            return;
        }
        let mut before = before;
        for k in 4..count + 4 {
            before = next(before, magnitude(samples, at(k)));
            if let Some(slot) = samples.get_mut(at(k)) {
                *slot = before[3];
            }
        }
        return;
    }
    for step in [1isize, -1] {
        // At an end of the stroke the largest value replaces the samples beyond it.
        let mut before = [3isize, 2, 1, 0].map(|back| {
            let neighbour = start.checked_add_signed(-step * back);
            magnitude(samples, neighbour.filter(|k| *k < count).unwrap_or(start))
        });
        let mut at = start.checked_add_signed(step);
        while let Some(k) = at.filter(|k| *k < count) {
            before = next(before, magnitude(samples, k));
            if let Some(slot) = samples.get_mut(k) {
                *slot = before[3];
            }
            at = k.checked_add_signed(step);
        }
    }
}
