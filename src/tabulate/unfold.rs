//! Signs for a magnitude: |v′| has a kink where v′ changes its sign, and v′ has none.

use crate::math;

/// Gives samples of a magnitude the signs of the smoothest curve that has this magnitude: each takes the sign that a straight
/// line through the two before it predicts. On a turn the signs must meet; if not, the samples stay as they are.
pub(crate) fn unfold(samples: &mut [f64], periodic: bool) {
    let sign = |before: [f64; 2], magnitude: f64| {
        let predicted = 2.0 * before[1] - before[0];
        if predicted < 0.0 { -magnitude } else { magnitude }
    };
    let magnitude = |samples: &[f64], k: usize| samples.get(k).map_or(0.0, |s| math::abs(*s));
    // Where the magnitude is greatest the sign is sure.
    let start = (0..samples.len())
        .max_by(|a, b| magnitude(samples, *a).total_cmp(&magnitude(samples, *b)))
        .unwrap_or(0);
    let count = samples.len();
    let mut before = [magnitude(samples, start); 2];
    if periodic {
        // One turn and one more sample from there, first only to see whether the signs meet.
        let end = (1..=count).fold(before, |before, k| {
            [before[1], sign(before, magnitude(samples, (start + k) % count))]
        });
        if end[1] < 0.0 {
            return;
        }
        for k in 1..count {
            let at = (start + k) % count;
            before = [before[1], sign(before, magnitude(samples, at))];
            if let Some(slot) = samples.get_mut(at) {
                *slot = before[1];
            }
        }
        return;
    }
    for step in [1isize, -1] {
        let mut before = before;
        let mut at = start.checked_add_signed(step);
        while let Some(k) = at.filter(|k| *k < count) {
            before = [before[1], sign(before, magnitude(samples, k))];
            if let Some(slot) = samples.get_mut(k) {
                *slot = before[1];
            }
            at = k.checked_add_signed(step);
        }
    }
}
