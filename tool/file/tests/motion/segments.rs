//! Segments between speeds: what they take from their neighbours, and what does not fit.

use std::f64::consts::TAU;

use super::{motion, refused, within};
use crate::support::{phrases, rows};

/// Run-up, constant speed, run-down: the polynomials take speed and acceleration from their neighbours. Between rest and the speed v
/// over v·T/2, the polynomial of fifth degree is that of the speed v·(3z² − 2z³).
#[test]
fn polynomials_take_their_ends_from_their_neighbours() {
    let motion = motion(
        "cycle",
        &[
            "law = \"polynomial-5\"; move = \"90 deg\"; duration = \"0.5 s\"",
            "law = \"constant-speed\"; speed = \"60 rpm\"; move = \"180 deg\"",
            "law = \"polynomial-5\"; move = \"90 deg\"; duration = \"0.5 s\"",
        ],
    );
    within("duration", motion.duration(), 1.5, 1e-15);
    for k in 0..=50 {
        let z = f64::from(k) / 50.0;
        let state = motion.at(0.5 * z - 1e-12);
        within("speed", state.omega, TAU * z * z * (3.0 - 2.0 * z), 1e-10);
        let after = motion.at(1.0 + 0.5 * z);
        within(
            "speed",
            after.omega,
            TAU - TAU * z * z * (3.0 - 2.0 * z),
            1e-12,
        );
    }
    for t in [0.5, 0.75, 1.0] {
        within("constant speed", motion.at(t).omega, TAU, 1e-13);
        within("constant speed", motion.at(t).alpha, 0.0, 1e-10);
    }
    within("end", motion.at(1.5).phi, TAU, 1e-14);
}

/// Accelerations and jerks at the ends, as given.
#[test]
fn polynomials_meet_what_is_given() {
    let motion = motion(
        "point-to-point",
        &[
            "law = \"polynomial-7\"; move = \"1 rad\"; duration = \"1 s\"; start_speed = \"0.5 rad/s\"; end_speed = \"2 rad/s\"; \
             start_acceleration = \"3 rad/s^2\"; end_acceleration = \"-4 rad/s^2\"; start_jerk = \"10 rad/s^3\"",
            "law = \"polynomial-6\"; move = \"2 rad\"; duration = \"1 s\"; end_jerk = \"0 rad/s^3\"",
        ],
    );
    let state = motion.at(0.0);
    within("start speed", state.omega, 0.5, 1e-14);
    within("start acceleration", state.alpha, 3.0, 1e-13);
    let step = 1e-5;
    within(
        "start jerk",
        (motion.at(step).alpha - state.alpha) / step,
        10.0,
        0.1,
    );
    for t in [1.0 - 1e-13, 1.0] {
        within("end speed", motion.at(t).omega, 2.0, 1e-11);
        within("end acceleration", motion.at(t).alpha, -4.0, 1e-9);
    }
    let end = motion.at(2.0);
    within("rest", end.omega, 0.0, 1e-12);
    within("rest", end.alpha, 0.0, 1e-11);
    within("jerk", motion.at(2.0 - step).alpha / step, 0.0, 0.1);
    within("way", end.phi, 3.0, 1e-13);
}

/// The shares of a trapezoid between speeds: mean speed 1 rad/s, ends 0.5 and 0; the middle speed by hand.
#[test]
fn a_trapezoid_between_speeds() {
    let motion = motion(
        "point-to-point",
        &[
            "law = \"trapezoid\"; move = \"2 rad\"; duration = \"2 s\"; accelerate = \"25 %\"; decelerate = \"50 %\"; \
             start_speed = \"0.5 rad/s\"",
        ],
    );
    // 2·(0.25·(0.5 + v)/2 + 0.25·v + 0.5·v/2) = 2
    let middle = (1.0 - 0.0625) / 0.625;
    within("middle speed", motion.at(0.6).omega, middle, 1e-14);
    within(
        "acceleration",
        motion.at(0.2).alpha,
        (middle - 0.5) / 0.5,
        1e-14,
    );
    within("deceleration", motion.at(1.5).alpha, -middle, 1e-14);
    within("way", motion.at(2.0).phi, 2.0, 1e-14);
    assert_eq!(motion.stretches().len(), 3);
}

/// A change of speed, whose distance follows: half the sum of the speeds times the duration.
#[test]
fn a_change_of_speed_has_no_move() {
    let motion = motion(
        "point-to-point",
        &[
            "law = \"trapezoid\"; end_speed = \"4 rad/s\"; max_acceleration = \"8 rad/s^2\"",
            "law = \"constant-speed\"; speed = \"4 rad/s\"; duration = \"1 s\"",
            "law = \"jerk-limited\"; end_speed = \"0 rad/s\"; max_acceleration = \"8 rad/s^2\"; max_jerk = \"64 rad/s^3\"",
        ],
    );
    within("way up", motion.at(0.5).phi, 1.0, 1e-14);
    within("way at speed", motion.at(1.5).phi, 5.0, 1e-14);
    within("duration", motion.duration(), 1.5 + 0.5 + 0.125, 1e-14);
    within(
        "way down",
        motion.at(motion.duration()).phi,
        5.0 + 2.0 * 0.625,
        1e-13,
    );
}

#[test]
fn speeds_that_jump_are_refused() {
    let law = "law = \"cycloidal\"; move = \"180 deg\"; duration = \"1 s\"";
    let steady = "law = \"constant-speed\"; speed = \"60 rpm\"; move = \"180 deg\"";
    refused(
        "point-to-point",
        &[law, steady],
        &[
            "number 1 ends at rest, but number 2 starts at 60 rpm",
            "polynomial-5",
        ],
    );
    refused(
        "cycle",
        &[
            steady,
            "law = \"polynomial-5\"; move = \"180 deg\"; duration = \"1 s\"; end_speed = \"30 rpm\"",
        ],
        &["number 2 ends at 30 rpm, but number 1 starts the next cycle at 60 rpm"],
    );
    // The same open at the end of the cycle.
    motion(
        "cycle",
        &[
            steady,
            "law = \"polynomial-5\"; move = \"180 deg\"; duration = \"1 s\"",
        ],
    );
}

#[test]
fn keys_of_other_laws_are_refused() {
    let cases = r#"
        law = "cycloidal"; move = "180 deg"; duration = "1 s"; end_speed = "30 rpm" => `end_speed` | "polynomial-5"
        law = "polynomial-5"; move = "180 deg"; duration = "1 s"; end_jerk = "30 rad/s^3" =>
            `end_jerk` | is for law = "polynomial-6", "polynomial-7"
        law = "polynomial-6"; move = "180 deg"; duration = "1 s" =>
            needs the jerk at one of its ends | start_jerk = "0 rad/s^3"
        law = "constant-speed"; move = "180 deg"; duration = "1 s"; speed = "30 rpm" => one too many | two of the three
        law = "constant-speed"; move = "180 deg"; speed = "-30 rpm" =>
            is -30 rpm, against the move of 180 deg | the same sign
        law = "constant-speed"; move = "180 deg" => `speed` | is missing
        law = "cycloidal"; move = "180 deg"; duration = "1 s"; max_speed = "30 rpm" =>
            `max_speed` | is for law = "trapezoid", "jerk-limited"
    "#;
    for [segment, words] in rows(cases) {
        refused("point-to-point", &[&segment], &phrases(&words));
    }
}

/// A polynomial that turns back beyond the stroke, although both its ends lie within it.
#[test]
fn a_polynomial_stays_within_the_stroke() {
    let text = crate::reading::text_of("linear-gripper.toml");
    let head = text.split("[motion]").next().unwrap();
    let segment = |more: &str| {
        format!(
            "{head}\n[motion]\ntype = \"point-to-point\"\n[[motion.segment]]\nlaw = \"polynomial-5\"\nmove = \"1 mm\"\nduration = \"1 s\"\n{more}"
        )
    };
    crate::reading::read(&segment(""));
    crate::reading::refuses(
        &segment("start_speed = \"-1 m/s\""),
        &["number 1 turns back at s = ", "outside the stroke"],
    );
}
