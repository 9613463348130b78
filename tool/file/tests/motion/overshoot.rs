//! Segments whose law goes beyond its end and comes back.

use std::f64::consts::TAU;

use super::motion;

fn steady(from: f64) -> String {
    format!("law = \"constant-speed\"; speed = \"60 rpm\"; move = \"{from} deg\"")
}

/// From v₀ to rest, with accelerations of zero, the speed is v₀·(1 − s)²·(1 + 2·s + (30·D/(v₀·T) − 15)·s²): it turns back where D < 0.4·v₀·T, at the zero of the last factor.
#[test]
fn the_overshoot_of_fifth_degree() {
    for distance in [143.0_f64, 140.0, 120.0, 100.0] {
        let stop = format!("law = \"polynomial-5\"; move = \"{distance} deg\"; duration = \"1 s\"");
        let found = motion("point-to-point", &[&steady(20.0), &stop]).overshoots();
        let share = distance / 360.0;
        let bend = 30.0 * share - 15.0;
        let s = (-1.0 - (1.0 - bend).sqrt()) / bend;
        assert!(0.5 < s && s < 1.0);
        let place = s - 6.0 * s.powi(3) + 8.0 * s.powi(4) - 3.0 * s.powi(5)
            + share * (10.0 * s.powi(3) - 15.0 * s.powi(4) + 6.0 * s.powi(5));
        let beyond = TAU * (place - share);
        assert_eq!(found.len(), 1, "{distance}");
        assert!(found[0].segment == 1 && found[0].by[0] == 0.0);
        // Roundings of positions of some radians.
        assert!((found[0].by[1] - beyond).abs() < 1e-13, "{distance}");
        assert!((found[0].back - beyond).abs() < 1e-13, "{distance}");
    }
    let stop = "law = \"polynomial-5\"; move = \"144.1 deg\"; duration = \"1 s\"";
    let found = motion("point-to-point", &[&steady(20.0), stop]).overshoots();
    assert!(found.is_empty());
}
