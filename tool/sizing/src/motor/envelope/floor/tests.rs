//! The chord below the S1 torque in the range of constant power.

use super::*;
use crate::catalogue::Motor;

/// 1 kW of constant power above 100 rad/s, far below what the motor gives for a short time.
fn weakened() -> Envelope {
    Envelope::of(&Motor {
        rated_torque: Some(10.0),
        rated_speed: Some(100.0),
        peak_torque: Some(200.0),
        peak_curve: vec![[0.0, 200.0], [600.0, 200.0]],
        max_speed: Some(600.0),
        ..Motor::default()
    })
}

/// Below the hyperbola everywhere. Over a short range it is the tangent in the middle, P/m·(2 − n/m): it touches there, and at the ends it lies
/// P/n·(n/m − 1)² below. Over a long range, where a tangent would fall to zero, it is level at the torque of the largest speed.
#[test]
fn constant_power_has_its_tangent_or_its_end() {
    let envelope = weakened();
    let power = 1000.0;
    let mut seen = [false; 2];
    for from in [101.0, 150.0, 240.0] {
        for share in [1.0, 1.01, 1.1, 1.3, 1.49, 1.51, 1.7, 2.4] {
            let to: f64 = share * from;
            let (ends, middle) = ([from, to], 0.5 * (from + to));
            let chord = envelope.continuous_floor(ends);
            let long = share > 1.5;
            seen[usize::from(long)] = true;
            for (torque, speed) in chord.into_iter().zip(ends) {
                let expected = if long {
                    power / to
                } else {
                    power / speed * (1.0 - (speed / middle - 1.0).powi(2))
                };
                let error = (torque - expected).abs();
                assert!(error < 1e-12 * expected, "{ends:?}: {torque} {expected}");
            }
            for k in 0..=20 {
                let share = f64::from(k) / 20.0;
                let speed = from + share * (to - from);
                let below = chord[0] + share * (chord[1] - chord[0]);
                let torque = envelope.continuous_torque(speed);
                assert!(below <= torque * (1.0 + 1e-12), "{ends:?} at {speed}");
            }
        }
    }
    assert_eq!(seen, [true; 2]);
}
