//! The voltage limit as pieces: cut where it leaves the current limit, where it is straight, where it is concave.

use super::circuit::Circuit;
use super::limit::{Curvature, Limit, LimitPiece, TorqueCurve};
use crate::motor::winding::CurrentCurve;

/// Steps in which a smooth stretch is evaluated.
const STEPS: u32 = 128;

/// Limit by the circuit up to the speed `end` (rad/s), in or against the direction of speed.
pub(super) fn limit(circuit: &Circuit, torques: &CurrentCurve, braking: bool, end: f64) -> Limit {
    if !(end > 0.0 && end.is_finite()) {
        return Limit::new([]);
    }
    if circuit.reactance == 0.0 && !circuit.weakens {
        straight(circuit, torques, braking, end)
    } else {
        bent(circuit, torques, braking, end)
    }
}

/// Without reactance the relation of current and speed is linear: i = (V ∓ k_e·n)/r.
fn straight(circuit: &Circuit, torques: &CurrentCurve, braking: bool, end: f64) -> Limit {
    let Circuit {
        voltage,
        flux,
        drop,
        current,
        ..
    } = *circuit;
    let current_at = |speed: f64| {
        let back = flux * speed;
        let left = if braking {
            voltage + back
        } else {
            voltage - back
        };
        (left / drop).clamp(0.0, current)
    };
    let speed_at = |i: f64| {
        let left = voltage - drop * i;
        (if braking { -left } else { left }) / flux
    };
    let corners = [current, torques.knee_current()];
    let corners = corners.into_iter().filter(|i| i.is_finite()).map(speed_at);
    let mut speeds: Vec<f64> = corners.filter(|n| *n > 0.0 && *n < end).collect();
    speeds.extend([0.0, end]);
    speeds.sort_by(f64::total_cmp);
    let points = speeds.iter().map(|&n| [n, torques.torque(current_at(n))]);
    let points: Vec<[f64; 2]> = points.collect();
    Limit::new(points.windows(2).filter_map(|pair| {
        let &[from, to] = pair else { return None };
        Some(LimitPiece::line(from, to))
    }))
}

fn bent(circuit: &Circuit, torques: &CurrentCurve, braking: bool, end: f64) -> Limit {
    let current = |speed: f64| circuit.largest_current(speed, braking);
    let torque = |speed: f64| torques.torque(current(speed));
    // Kinks: where the current limit is left or met, where saturation begins, at maximum torque per volt.
    let limited = |speed: f64| current(speed) >= circuit.current;
    let saturated = |speed: f64| current(speed) > torques.knee_current();
    let mut cuts = changes(&limited, 0.0, end);
    cuts.extend(changes(&saturated, 0.0, end));
    if circuit.weakens {
        let at_top = |speed: f64| circuit.torque_per_volt(speed, braking).is_some();
        cuts.extend(changes(&at_top, 0.0, end));
    }
    // The resistance matters up to this speed, which may be a small part of the range.
    let resistive = 2.0 * circuit.drop / circuit.reactance;
    cuts.extend([resistive].into_iter().filter(|n| *n < end));
    cuts.extend([0.0, end]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let mut pieces = Vec::new();
    for pair in cuts.windows(2) {
        let &[from, to] = pair else { continue };
        if limited(0.5 * (from + to)) {
            pieces.push(LimitPiece::level(from, to, torques.torque(circuit.current)));
            continue;
        }
        // The braking limit rises up to its maximum: cut there, so that every piece is monotonic.
        let step = (to - from) / f64::from(STEPS);
        let rises = |speed: f64| torque((speed + step).min(to)) > torque(speed);
        let mut tops = changes(&rises, from, to);
        tops.extend([from, to]);
        tops.sort_by(f64::total_cmp);
        for pair in tops.windows(2) {
            let &[from, to] = pair else { continue };
            for (from, to, shape) in shapes(&torque, from, to) {
                pieces.push(LimitPiece {
                    from,
                    to,
                    curve: TorqueCurve::Winding {
                        circuit: *circuit,
                        torques: *torques,
                        braking,
                    },
                    shape,
                });
            }
        }
    }
    Limit::new(pieces)
}

/// The speed at step `k`; the last step is exactly the end.
fn place(from: f64, to: f64, k: u32) -> f64 {
    match k {
        STEPS => to,
        _ => from + (to - from) * (f64::from(k) / f64::from(STEPS)),
    }
}

/// Changes of a condition, by bisection between equal steps.
fn changes(yes: &impl Fn(f64) -> bool, from: f64, to: f64) -> Vec<f64> {
    let place = |k: u32| place(from, to, k);
    let mut found = Vec::new();
    let mut before = yes(from);
    for k in 0..STEPS {
        let after = yes(place(k + 1));
        if after != before {
            let (mut low, mut high) = (place(k), place(k + 1));
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if yes(middle) == before {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            found.push(high);
        }
        before = after;
    }
    found
}

/// A smooth stretch, cut into runs that are concave throughout and runs that are not. A run counts as concave only if every second difference, also
/// half a step beyond its ends, is clearly below zero.
fn shapes(torque: &impl Fn(f64) -> f64, from: f64, to: f64) -> Vec<(f64, f64, Curvature)> {
    const CURVATURE_TOLERANCE: f64 = 1e-9;
    let place = |k: u32| place(from, to, k);
    let values: Vec<f64> = (0..=STEPS).map(|k| torque(place(k))).collect();
    let size = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    let bends: Vec<bool> = values
        .windows(3)
        .map(|w| matches!(w, [a, b, c] if a - 2.0 * b + c < -CURVATURE_TOLERANCE * size))
        .collect();
    let bend = |k: u32| bends.get(k as usize).copied();
    // Step k lies between the differences k − 1 and k.
    let concave = |k: u32| {
        let before = if k == 0 { bend(0) } else { bend(k - 1) };
        let after = if k + 1 == STEPS { bend(k - 1) } else { bend(k) };
        before == Some(true) && after == Some(true)
    };
    let mut runs: Vec<(f64, f64, Curvature)> = Vec::new();
    for k in 0..STEPS {
        let shape = if concave(k) {
            Curvature::Concave
        } else {
            Curvature::Monotone
        };
        match runs.last_mut() {
            Some(last) if last.2 == shape => last.1 = place(k + 1),
            _ => runs.push((place(k), place(k + 1), shape)),
        }
    }
    runs
}
