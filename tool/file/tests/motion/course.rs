//! The figures of a motion: those of its laws, and what its limits say.

use jred::machine::motion::Law;

use super::{motion, within};
use crate::reading::machine;

#[test]
fn segments_have_the_values_of_their_laws() {
    let scca = Law::SineConstantCosine {
        sine: 0.2,
        constant: 0.1,
        cosine: 0.6,
    };
    let laws: [(&str, Law); 8] = [
        ("polynomial-345", Law::Polynomial345),
        ("polynomial-4567", Law::Polynomial4567),
        ("cycloidal", Law::Cycloidal),
        ("modified-sine", Law::ModifiedSine),
        ("modified-trapezoid", Law::ModifiedTrapezoid),
        ("simple-sine", Law::SimpleSine),
        ("gutman", Law::Gutman),
        (
            "sine-constant-cosine\"; sine = \"20 %\"; constant = 0.1; cosine = \"60 %",
            scca,
        ),
    ];
    for (name, law) in laws {
        let segment = format!("law = \"{name}\"; move = \"-120 deg\"; duration = \"0.35 s\"");
        let motion = motion("cycle", &[&segment, "dwell = \"0.2 s\""]);
        let [course, dwell] = motion.courses()[..] else {
            panic!("{name}");
        };
        assert!(dwell.coefficients().is_none() && course.of_drive);
        let values = law.characteristic();
        let found = course.coefficients().unwrap();
        let expected = [
            Some(values.velocity),
            Some(values.acceleration),
            values.jerk,
            Some(values.dynamic_torque),
        ];
        for (found, expected) in found.into_iter().zip(expected) {
            assert_eq!(found.is_some(), expected.is_some(), "{name}");
            within(
                name,
                found.unwrap_or(0.0),
                expected.unwrap_or(0.0),
                1e-9 * 100.0,
            );
        }
    }
}

#[test]
fn limits_are_what_is_reached() {
    let motion = motion(
        "cycle",
        &[
            "law = \"jerk-limited\"; move = \"8 rad\"; max_speed = \"4 rad/s\"; max_acceleration = \"20 rad/s^2\"; max_jerk = \"300 rad/s^3\"",
            "law = \"trapezoid\"; move = \"-8 rad\"; max_speed = \"4 rad/s\"; max_acceleration = \"20 rad/s^2\"",
        ],
    );
    let [smooth, sudden] = motion.courses()[..] else {
        panic!();
    };
    for course in [smooth, sudden] {
        within("speed", course.speed, 4.0, 1e-9);
        within("acceleration", course.acceleration, 20.0, 1e-9);
    }
    // Its neighbour's acceleration jumps where they meet.
    assert!(sudden.jerk.is_none() && smooth.jerk.is_none());
    within("power", sudden.dynamic, 80.0, 1e-9);
    let peaks = motion.drive_peaks();
    within("speed of the drive", peaks[0], 4.0, 1e-8);
    within("acceleration of the drive", peaks[1], 20.0, 1e-6);
}

/// The tool's figures and those of the drive link.
#[test]
fn a_shear_in_figures() {
    let motion = machine("flying-shear.toml").motion.unwrap();
    let [sync, join] = motion.courses()[..] else {
        panic!();
    };
    assert!(!sync.of_drive && join.of_drive);
    within("speed", sync.speed, 2.0, 1e-12);
    within("acceleration", sync.acceleration, 0.0, 1e-12);
    // The knife leaves the strip with an acceleration of the drum, which goes on for a while in the join.
    let speeds = (0..=75_000).map(|k| motion.at(1e-5 * f64::from(k)).omega);
    let most = speeds.fold(0.0, f64::max);
    within("drive", motion.drive_peaks()[0], most, 1e-6);
    within("join", join.speed, most, 1e-6);
    within("C_v", sync.coefficients().unwrap()[0].unwrap(), 1.0, 1e-12);
}

/// From rest to a speed v by a jerk-limited law takes v/a + a/j, on the way ½·v of it; there the acceleration ends at zero, and that of
/// the constant speed behind it is zero: nothing jumps, whatever the size of the numbers.
#[test]
fn a_constant_speed_behind_a_soft_end_has_no_jerk() {
    let (v, a, j) = (5.5_f64, 20.0_f64, 300.0_f64);
    for scale in [1e-4_f64, 1.0, 55.0 / 54.0, 1e4] {
        let [v, a, j] = [v, a, j].map(|value| value * scale);
        let soft = |end: f64| {
            format!(
                "law = \"jerk-limited\"; end_speed = \"{end} rad/s\"; max_acceleration = \"{a} rad/s^2\"; max_jerk = \"{j} rad/s^3\""
            )
        };
        let steady =
            format!("law = \"constant-speed\"; speed = \"{v} rad/s\"; duration = \"0.45 s\"");
        let motion = motion("point-to-point", &[&soft(v), &steady, &soft(0.0)]);
        let [up, level, down] = motion.courses()[..] else {
            panic!();
        };
        let t = v / a + a / j;
        for course in [up, down] {
            within("duration", course.duration, t, 1e-12);
            within("jerk", course.jerk.unwrap(), j, 1e-9 * j);
            let due = j * t.powi(3) / (0.5 * v * t);
            within(
                "C_j",
                course.coefficients().unwrap()[2].unwrap(),
                due,
                1e-8 * due,
            );
        }
        within("jerk of the constant speed", level.jerk.unwrap(), 0.0, 0.0);
        // A jump of a thousandth of the largest acceleration is one.
        let sudden = format!(
            "law = \"trapezoid\"; end_speed = \"{} rad/s\"; max_acceleration = \"{} rad/s^2\"",
            1.001 * v,
            1e-3 * a
        );
        let courses = self::motion("point-to-point", &[&soft(v), &steady, &sudden]).courses();
        assert!(courses[0].jerk.is_some() && courses[1].jerk.is_none());
    }
}
