//! The overload integral I²t of a servo amplifier.
//!
//! An amplifier integrates the excess of its squared current over the rated one, never below zero:
//!
//! ```text
//! q′ = I² − I_r²,  q ≥ 0;   q ≤ (I_p² − I_r²)·t_p
//! ```
//!
//! with rated current I_r, and peak current I_p that may flow for t_p from cold. The current is linear between two instants, where the integral is
//! exact.

/// Current (A, signed) at a time (s).
pub type CurrentSample = [f64; 2];

/// The largest value (A²·s) of the integral over an endlessly repeated cycle. It is infinite if the RMS current exceeds the rated one, because the
/// integral then grows from cycle to cycle.
pub fn largest(points: &[CurrentSample], duration: f64, rated: f64) -> f64 {
    if points.iter().all(|[_, current]| current.abs() <= rated) {
        return 0.0;
    }
    let mut whole = 0.0;
    pieces(points, duration, rated, |part| whole += part);
    // A cycle whose RMS current equals the rated one to rounding neither fills nor empties the integral.
    let scale = rated * rated * duration;
    if whole > 1e-12 * scale {
        return f64::INFINITY;
    }
    // A clamped integral whose mean falls is periodic after its first cycle.
    let (mut q, mut most) = (0.0f64, 0.0f64);
    for _ in 0..2 {
        pieces(points, duration, rated, |part| {
            q = (q + part).max(0.0);
            most = most.max(q);
        });
    }
    most
}

/// Limit of the amplifier: (I_p² − I_r²)·t_p (A²·s).
pub fn allowed(rated: f64, peak: f64, time: f64) -> f64 {
    (peak * peak - rated * rated) * time
}

/// ∫(I² − I_r²) dt over pieces in which the integrand keeps its sign.
fn pieces(points: &[CurrentSample], duration: f64, rated: f64, mut take: impl FnMut(f64)) {
    let Some((first, last)) = points.first().zip(points.last()) else {
        return;
    };
    let mut before = [0.0, first[1]];
    let end = [duration, last[1]];
    for &point in points.iter().chain(std::iter::once(&end)) {
        let ([t, from], [next, to]) = (before, point);
        before = point;
        let time = next - t;
        if time <= 0.0 {
            continue;
        }
        // Where the line crosses ±I_r.
        let mut cuts = [0.0, 1.0, 1.0, 1.0];
        let mut count = 1;
        for level in [rated, -rated] {
            let place = (level - from) / (to - from);
            if place > 0.0 && place < 1.0 {
                cuts[count] = place;
                count += 1;
            }
        }
        cuts[1..count].sort_by(f64::total_cmp);
        cuts[count] = 1.0;
        for pair in cuts[..=count].windows(2) {
            let at = |place: f64| from + place * (to - from);
            let (a, b) = (at(pair[0]), at(pair[1]));
            let mean = (a * a + a * b + b * b) / 3.0;
            take((mean - rated * rated) * time * (pair[1] - pair[0]));
        }
    }
}
