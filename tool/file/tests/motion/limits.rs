//! Moves as fast as limits allow.

use jred_file::model::motion::{MoveLimits, Phase, TooShort, change, fastest};

use super::{motion, refused, within};

const LIMITS: MoveLimits = MoveLimits {
    speed: 2.0,
    acceleration: 5.0,
    deceleration: 5.0,
    jerk: Some(40.0),
};

fn duration(phases: &[Phase]) -> f64 {
    phases.iter().map(|phase| phase.duration).sum()
}

/// The textbook's durations from rest to rest, one for each of the cases: both limits reached, the speed or the acceleration not, neither.
#[test]
fn durations_in_closed_form() {
    let (v, a, j) = (2.0_f64, 5.0_f64, 40.0_f64);
    for distance in [3.0, -3.0, 1e4] {
        let phases = fastest(distance, [0.0; 2], &LIMITS).unwrap();
        assert_eq!(phases.len(), 7);
        let expected = f64::abs(distance) / v + v / a + a / j;
        within(
            "both reached",
            duration(&phases),
            expected,
            1e-14 * expected,
        );
    }
    // The speed v that is reached: v²/a + v·a/j = D.
    let distance = 0.5_f64;
    let top = 0.5 * a * (-a / j + ((a / j).powi(2) + 4.0 * distance / a).sqrt());
    assert!(top < v && top > a * a / j);
    let phases = fastest(distance, [0.0; 2], &LIMITS).unwrap();
    assert_eq!(phases.len(), 6);
    within("no stay", duration(&phases), 2.0 * (top / a + a / j), 1e-14);
    // Neither: four equal phases of ∛(D/2j).
    for distance in [0.02_f64, 1e-9] {
        let phases = fastest(distance, [0.0; 2], &LIMITS).unwrap();
        assert_eq!(phases.len(), 4);
        let expected = 4.0 * (distance / (2.0 * j)).cbrt();
        within("short", duration(&phases), expected, 1e-14 * expected);
    }
    // The speed, but not the acceleration.
    let gentle = MoveLimits {
        acceleration: 50.0,
        deceleration: 50.0,
        ..LIMITS
    };
    let phases = fastest(3.0, [0.0; 2], &gentle).unwrap();
    assert_eq!(phases.len(), 5);
    within(
        "gentle",
        duration(&phases),
        3.0 / v + 2.0 * (v / j).sqrt(),
        1e-14,
    );
    // Without a limit of the jerk: three phases or two, each acceleration its own.
    let sudden = MoveLimits {
        deceleration: 2.0,
        jerk: None,
        ..LIMITS
    };
    let phases = fastest(3.0, [0.0; 2], &sudden).unwrap();
    assert_eq!(phases.len(), 3);
    let ramps = 0.5 * v * v * (1.0 / a + 1.0 / 2.0);
    within(
        "trapezoid",
        duration(&phases),
        v / a + v / 2.0 + (3.0 - ramps) / v,
        1e-14,
    );
    let phases = fastest(0.7, [0.0; 2], &sudden).unwrap();
    assert_eq!(phases.len(), 2);
    let top = (2.0 * 0.7 / (1.0 / a + 1.0 / 2.0)).sqrt();
    within("triangle", duration(&phases), top / a + top / 2.0, 1e-14);
}

/// Between speeds: the ends are met, the state goes on, every limit is kept and one is reached, whatever the case.
#[test]
fn every_limit_is_kept_and_reached() {
    let mut seed = 0x2143_u64;
    let mut random = |low: f64, high: f64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut refused, mut counts) = (0, [0; 8]);
    for _ in 0..3000 {
        let speed = random(0.1, 3.0);
        let limits = MoveLimits {
            speed,
            acceleration: random(0.5, 20.0),
            deceleration: random(0.5, 20.0),
            jerk: (random(0.0, 1.0) < 0.8).then_some(10f64.powf(random(0.0, 3.0))),
        };
        let sign = if random(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 };
        let ends =
            [random(-0.5, 1.0), random(-0.5, 1.0)].map(|share| sign * speed * share.max(0.0));
        let distance = sign * 10f64.powf(random(-3.0, 1.0));
        let phases = match fastest(distance, ends, &limits) {
            Ok(phases) => phases,
            Err(TooShort { least }) => {
                // The direct change of speed, whose way is the mean speed times its duration.
                let (way, phases) = change(ends, &limits);
                within(
                    "mean speed",
                    way,
                    0.5 * (ends[0] + ends[1]) * duration(&phases),
                    1e-14,
                );
                assert!(least.abs() > distance.abs() && (least - way).abs() <= 1e-12 * way.abs());
                refused += 1;
                continue;
            }
        };
        counts[phases.len()] += 1;
        let mut state = [0.0, ends[0], 0.0];
        let mut most = [0.0_f64; 3];
        for phase in &phases {
            let [_, v, a, _] = phase.polynomial.at(0.0);
            within("speed goes on", v, state[1], 1e-11);
            if limits.jerk.is_some() {
                within("acceleration goes on", a, state[2], 1e-9);
            }
            let growing = phase.polynomial.at(0.5 * phase.duration)[2] * sign > 0.0;
            let allowed = if growing {
                limits.acceleration
            } else {
                limits.deceleration
            };
            for k in 0..=20 {
                let [_, v, a, j] = phase.polynomial.at(phase.duration * f64::from(k) / 20.0);
                for (most, share) in most.iter_mut().zip([
                    v.abs() / speed,
                    a.abs() / allowed,
                    limits.jerk.map_or(0.0, |limit| j.abs() / limit),
                ]) {
                    *most = most.max(share);
                }
            }
            let [s, v, a, _] = phase.polynomial.at(phase.duration);
            state = [state[0] + s, v, a];
        }
        within(
            "distance",
            state[0],
            distance,
            1e-11 * distance.abs().max(1.0),
        );
        within("end speed", state[1], ends[1], 1e-11);
        assert!(most.iter().all(|share| *share <= 1.0 + 1e-9), "{most:?}");
        // Something limits: the speed, or both accelerations, or the jerk.
        let reached = most.iter().any(|share| *share >= 1.0 - 1e-9);
        assert!(reached, "{most:?}: {limits:?}, {ends:?}, {distance}");
    }
    assert!(
        refused > 100 && counts[4] > 50 && counts[7] > 50,
        "{refused}, {counts:?}"
    );
}

/// Through the file: the duration is the result, and the corners of the acceleration and the jerk are corners of the motion.
#[test]
fn limits_in_a_file() {
    let speed = std::f64::consts::TAU;
    let motion = motion(
        "cycle",
        &[
            "law = \"jerk-limited\"; move = \"720 deg\"; max_speed = \"60 rpm\"; max_acceleration = \"40 rad/s^2\"; \
             max_jerk = \"800 rad/s^3\"",
            "dwell = \"0.1 s\"",
        ],
    );
    let expected = 2.0 + speed / 40.0 + 40.0 / 800.0;
    within("duration", motion.duration(), expected + 0.1, 1e-13);
    let corners: Vec<f64> = motion.stretches().iter().map(|(from, _)| *from).collect();
    let (ramp, rise) = (0.05, speed / 40.0);
    for (found, expected) in corners.iter().zip([
        0.0,
        ramp,
        rise,
        rise + ramp,
        2.0,
        2.0 + ramp,
        2.0 + rise,
        expected,
    ]) {
        within("corner", *found, expected, 1e-13);
    }
    assert_eq!(corners.len(), 8);
}

#[test]
fn limits_that_no_profile_keeps() {
    let limits =
        "max_speed = \"60 rpm\"; max_acceleration = \"1 rad/s^2\"; max_jerk = \"800 rad/s^3\"";
    refused(
        "point-to-point",
        &[
            "law = \"constant-speed\"; speed = \"50 rpm\"; move = \"90 deg\"",
            &format!("law = \"jerk-limited\"; move = \"90 deg\"; {limits}"),
        ],
        &[
            "is 90 deg, but the change of speed from 50 rpm to 0 rpm takes 785.5",
            "too short",
        ],
    );
    refused(
        "point-to-point",
        &[
            "law = \"constant-speed\"; speed = \"80 rpm\"; move = \"90 deg\"",
            &format!("law = \"jerk-limited\"; move = \"90 deg\"; {limits}"),
        ],
        &[
            "starts at 80 rpm, the speed at which the segment before it ends",
            "`max_speed` is 60 rpm",
        ],
    );
    refused(
        "point-to-point",
        &[&format!(
            "law = \"jerk-limited\"; move = \"90 deg\"; end_speed = \"-20 rpm\"; {limits}"
        )],
        &["ends at -20 rpm, against its move of 90 deg"],
    );
    refused(
        "point-to-point",
        &[&format!(
            "law = \"jerk-limited\"; move = \"90 deg\"; duration = \"1 s\"; {limits}"
        )],
        &["`duration`", "follows from the limits"],
    );
    refused(
        "point-to-point",
        &[
            "law = \"trapezoid\"; move = \"90 deg\"; max_speed = \"60 rpm\"; max_acceleration = \"0 rad/s^2\"",
        ],
        &["`max_acceleration`", "greater than zero"],
    );
    refused(
        "point-to-point",
        &["law = \"trapezoid\"; max_acceleration = \"3 rad/s^2\""],
        &["has no `move`, and the speed is 0 rpm at both ends"],
    );
}
