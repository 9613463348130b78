//! Lines of a curve keep within the bounds.

use super::*;

/// A tunnel between a limit that falls, is level and falls again, and a bound by a shortfall below it.
fn tunnel() -> Tunnel {
    let at = |speed: f64| (10.0 - speed).max(6.0).min(14.0 - speed);
    let speeds: Vec<f32> = (0..13_u8).map(f32::from).collect();
    let between = speeds.windows(2).map(|pair| Interval {
        ends: [pair[0], pair[1]].map(|speed| at(f64::from(speed))),
        loose: 0.0,
    });
    Tunnel {
        most: speeds.iter().map(|speed| at(f64::from(*speed))).collect(),
        between: between.collect(),
        speeds,
    }
}

/// Every line from a place, by every slope: `reach` gives exactly the places at which the line lies below the limit so far, and no further below it
/// than allowed before.
#[test]
fn a_line_that_is_taken_keeps_within_the_bounds() {
    let (tunnel, shortfall) = (tunnel(), 0.2);
    let count = tunnel.speeds.len();
    let speed = |place: usize| f64::from(tunnel.speeds[place]);
    for from in 0..count {
        for share in [0.0, 0.5, 1.0] {
            let lowest = tunnel.least(from, shortfall);
            let start = tunnel.most[from] + share * (lowest - tunnel.most[from]);
            let mut taken = vec![None; count];
            tunnel.reach(from, start, shortfall, |place, slopes, span| {
                assert!(
                    (span - (speed(place) - speed(from))).abs() < 1e-12,
                    "{span}"
                );
                assert!(taken[place].replace(slopes).is_none(), "{place} twice");
            });
            for (to, taken) in taken.iter().enumerate().skip(from + 1) {
                for step in -300..=100 {
                    // No line ends exactly on a bound, because the two sides may round differently.
                    let slope = 0.01 * f64::from(step) + 1.7e-4;
                    let line = |place: usize| start + slope * (speed(place) - speed(from));
                    let below = (from + 1..=to).all(|place| line(place) <= tunnel.most[place]);
                    let above =
                        (from + 1..to).all(|place| line(place) >= tunnel.least(place, shortfall));
                    let found = taken.is_some_and(|[least, most]| least <= slope && slope <= most);
                    assert_eq!(found, below && above, "{from} to {to}, {start} by {slope}");
                }
            }
        }
    }
}

/// A line on a level limit is accepted although both round: from speed 4 to 8 the limit is 6.
#[test]
fn a_line_on_the_limit_is_taken() {
    for limit in [6.0, 0.1, 1e5 / 3.0] {
        let mut tunnel = tunnel();
        for interval in &mut tunnel.between[4..8] {
            interval.ends = [limit; 2];
        }
        let mut taken = Vec::new();
        tunnel.reach(4, limit, 0.0, |place, [least, most], _| {
            if least <= 0.0 && 0.0 <= most {
                taken.push(place);
            }
        });
        assert!(taken.starts_with(&[5]), "{taken:?}");
        // The same by one unit of the last place above it.
        let mut above = Vec::new();
        tunnel.reach(4, limit.next_up(), 1.0, |place, slopes, _| {
            if slopes[0] <= 0.0 && 0.0 <= slopes[1] {
                above.push(place);
            }
        });
        assert!(above.starts_with(&[5, 6, 7, 8]), "{limit}: {above:?}");
    }
}

/// Where the limit jumps between two intervals the lower side counts on both: a line may pass neither.
#[test]
fn both_sides_of_a_jump_bound_a_line() {
    let mut tunnel = tunnel();
    // From place 3 on the interval begins lower than the previous one ends.
    tunnel.between[3].ends[0] = 5.0;
    let mut most = Vec::new();
    tunnel.reach(0, 10.0, 1.0, |place, slopes, _| {
        most.push((place, slopes[1]));
    });
    let at = |place: usize| most.iter().find(|(other, _)| *other == place).unwrap().1;
    assert!((at(3) + 1.0).abs() < 1e-6, "{most:?}");
    assert!((at(4) + 5.0 / 3.0).abs() < 1e-6, "{most:?}");
}

/// Points may lie at 32 equal steps from rest, at the end, and on both sides of each corner between them, in order and without duplicates.
#[test]
fn speeds_are_even_with_both_sides_of_each_corner() {
    let end = 321.7;
    let corners = [-1.0, 0.0, 100.3, 321.7, 400.0];
    let found = speeds(end, &corners);
    assert!(found.is_sorted_by(|a, b| a < b), "{found:?}");
    let last = rounded_down(end);
    let mut expected: Vec<f32> = (0..=32_u8).map(|k| last * (f32::from(k) / 32.0)).collect();
    let below = rounded_down(100.3);
    expected.extend([below, below.next_up(), f32::from_bits(1)]);
    expected.sort_by(f32::total_cmp);
    assert_eq!(found, expected);
    assert!(f64::from(below) <= 100.3 && f64::from(below.next_up()) > 100.3);
    // A motor that does not turn has one speed.
    assert_eq!(speeds(0.0, &corners), [0.0]);
}

/// A limit of zero gives a curve of zero, without shortfall.
#[test]
fn a_limit_of_zero_is_a_level_curve() {
    let found = below(300.0, &[100.0], |_| [0.0; 2]).unwrap();
    assert!(found.points.iter().all(|[_, torque]| *torque == 0.0));
    assert!(found.shortfall == 0.0, "{}", found.shortfall);
    assert_eq!(below(300.0, &[], |_| [f64::INFINITY; 2]), None);
}

/// For a limit a thousand times as high the curve is a thousand times as high; for a power of two, to the last bit.
#[test]
fn curves_are_to_scale() {
    let of = |scale: f64| {
        // A quarter of an ellipse: concave, so no chord lies above it.
        let limit = move |speed: f64| scale * (1.0 - (speed / 300.0).powi(2)).max(0.0).sqrt();
        below(300.0, &[], |speeds| speeds.map(limit)).unwrap()
    };
    let one = of(1.0);
    assert!(one.points.len() > 2 && one.shortfall > 0.0);
    for scale in [1.0 / 1024.0, 1024.0] {
        let other = of(scale);
        let expected = one
            .points
            .iter()
            .map(|[speed, torque]| [*speed, torque * scale as f32]);
        assert_eq!(other.points, expected.collect::<Vec<_>>(), "{scale}");
        assert_eq!(
            other.shortfall.to_bits(),
            one.shortfall.to_bits(),
            "{scale}"
        );
    }
}
