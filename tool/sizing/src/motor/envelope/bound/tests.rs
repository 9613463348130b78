//! Bounds of limits with pieces of every shape, against the limits themselves.

use super::*;
use crate::catalogue::Motor;

const LEVEL: LimitPiece = LimitPiece::level(0.0, 10.0, 8.0);

fn limits() -> Vec<Limit> {
    let line = |a, b| LimitPiece::line(a, b);
    vec![
        Limit::level(5.0, 100.0),
        Limit::new([LEVEL, line([10.0, 8.0], [40.0, 2.0])]),
        // Bends down at 10 and up at 30.
        Limit::new([
            LEVEL,
            line([10.0, 8.0], [30.0, 3.0]),
            line([30.0, 3.0], [60.0, 0.0]),
        ]),
        // Falls to zero before its end, in a step, and rises again.
        Limit::new([
            LEVEL,
            line([10.0, 8.0], [20.0, 0.0]),
            LimitPiece::level(20.0, 30.0, 0.0),
        ]),
        Limit::new([LEVEL, LimitPiece::level(10.0, 30.0, 3.0)]),
        Limit::new([
            line([0.0, 2.0], [20.0, 6.0]),
            line([20.0, 6.0], [50.0, 1.0]),
        ]),
        Limit::new([]),
    ]
}

/// The chord is nowhere above the limit, and meets it at both ends where the limit does not bend up.
#[test]
fn no_torque_is_below_the_floor() {
    let mut exact = 0;
    for limit in limits() {
        for (from, to) in (0..70).flat_map(|a| (a..70).map(move |b| (f64::from(a), f64::from(b)))) {
            let [start, end] = limit.floor([from, to]);
            for k in 0..=40 {
                let share = f64::from(k) / 40.0;
                let speed = from + share * (to - from);
                let chord = start + share * (end - start);
                assert!(limit.torque(speed) >= chord - 1e-12, "{from} {to}: {speed}");
            }
            let ends = [limit.torque(from), limit.torque(to)];
            // Straight between them: no corner inside.
            let inside = limit.pieces().iter().all(|p| p.to <= from || p.to >= to);
            if inside && to <= limit.end() && from < to {
                let near = [start - ends[0], end - ends[1]]
                    .iter()
                    .all(|d| d.abs() < 1e-12);
                assert!(
                    near || limit.pieces().iter().any(|p| (p.to - from).abs() < 1e-12),
                    "{from} {to}: {start} {end}"
                );
                exact += 1;
            }
        }
    }
    assert!(exact > 1000, "{exact}");
}

#[track_caller]
fn near(found: [f64; 2], expected: [f64; 2]) {
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    assert!(
        off.fold(0.0, f64::max) < 1e-12,
        "{found:?}, not {expected:?}"
    );
}

/// Over a concave corner the chord from end to end is the floor, over a convex one the least torque.
#[test]
fn chords_over_corners() {
    let limit = &limits()[2];
    // At 5, 20 and 45 rad/s: 8, 5.5 and 1.5 N·m.
    near(limit.floor([5.0, 20.0]), [8.0, 5.5]);
    near(limit.floor([20.0, 45.0]), [1.5; 2]);
    near(limit.floor([20.0, 61.0]), [0.0; 2]);
}

/// Below that speed torque is available; at it, or just beyond, it is zero.
#[test]
fn torque_up_to_its_end() {
    for (limit, end) in limits()
        .iter()
        .zip([100.0, 40.0, 60.0, 20.0, 30.0, 50.0, 0.0])
    {
        let found = limit.positive_below();
        assert!((found - end).abs() <= 1e-8 * end, "{found} {end}");
        for k in 0..if found > 0.0 { 100 } else { 0 } {
            let speed = found * f64::from(k) / 100.0;
            assert!(limit.torque(speed) > 0.0, "{speed}");
        }
    }
}

/// Only a limit without slope from rest up to that speed is level, at that torque.
#[test]
fn levels() {
    let of = |driving: &Limit, braking: &Limit| Envelope {
        driving: driving.clone(),
        braking: braking.clone(),
        ..Envelope::of(&Motor::default())
    };
    let all = limits();
    assert_eq!(of(&all[0], &all[0]).level_up_to(100.0), Some(5.0));
    assert_eq!(of(&all[0], &all[0]).level_up_to(100.1), None);
    assert_eq!(of(&all[1], &all[2]).level_up_to(10.0), Some(8.0));
    assert_eq!(of(&all[0], &all[1]).level_up_to(5.0), None);
    assert_eq!(of(&all[5], &all[5]).level_up_to(5.0), None);
    let none = Limit::level(0.0, 10.0);
    assert_eq!(of(&none, &none).level_up_to(5.0), None);
}
