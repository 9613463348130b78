//! Synchronous phases of the tool, and joins of the drive link between them.

use std::f64::consts::{PI, TAU};

use super::within;
use crate::reading::{machine, read, refuses, with_motion};

/// The knife's x runs with the strip while it cuts, exactly; the drums come round in the time of a plate without a jump of speed or
/// acceleration, and slow down between.
#[test]
fn a_flying_shear_runs_with_the_strip() {
    let motion = machine("flying-shear.toml").motion.unwrap();
    within("a plate", motion.duration(), 0.75, 1e-15);
    for k in 0..=40 {
        let t = 0.001 * f64::from(k);
        let state = motion.at(t - 1e-13);
        let (sin, cos) = state.phi.sin_cos();
        within("x", 0.16 * cos, -0.04 + 2.0 * t, 1e-12);
        within("speed", -0.16 * sin * state.omega, 2.0, 1e-11);
        let acceleration = -0.16 * (sin * state.alpha + cos * state.omega.powi(2));
        within("acceleration", acceleration, 0.0, 1e-9);
    }
    let [before, after] = [0.04 - 1e-9, 0.04 + 1e-9].map(|t| motion.at(t));
    within("φ goes on", after.phi, before.phi, 1e-7);
    within("ω goes on", after.omega, before.omega, 1e-6);
    within("α goes on", after.alpha, before.alpha, 1e-4);
    let (start, end) = (motion.at(0.0), motion.at(0.75));
    within("one turn", end.phi - start.phi, TAU, 1e-13);
    within("ω comes round", end.omega, start.omega, 1e-11);
    within("α comes round", end.alpha, start.alpha, 1e-9);
    // The closed form at the start: sin φ = −√(1 − 1/16).
    within(
        "ω",
        start.omega,
        2.0 / (0.16 * (15.0_f64 / 16.0).sqrt()),
        1e-12,
    );
    let slowest = (40..750).map(|k| motion.at(0.001 * f64::from(k)).omega);
    let slowest = slowest.fold(f64::INFINITY, f64::min);
    assert!(slowest > 0.0 && slowest < 8.0, "{slowest}");
    assert_eq!(motion.stretches().len(), 2);
}

/// Down at constant speed, through bottom dead centre, rest at top dead centre, and back to the part.
#[test]
fn a_drawing_press_rests_at_the_top() {
    let motion = machine("drawing-press.toml").motion.unwrap();
    let end = 0.011 / 0.08 + 0.5;
    within("length", motion.duration(), end + 0.2 + 0.4, 1e-14);
    for t in [end, end + 0.1, end + 0.2] {
        let state = motion.at(t);
        within("top", state.phi, 3.0 * PI, 1e-12);
        within("rest", state.omega, 0.0, 1e-11);
        within("rest", state.alpha, 0.0, 1e-9);
    }
    let (start, last) = (motion.at(0.0), motion.at(motion.duration()));
    within("a turn", last.phi - start.phi, TAU, 1e-12);
    within("speed", last.omega, start.omega, 1e-10);
}

#[test]
fn joins_that_lead_nowhere_are_refused() {
    let sync =
        "[[motion.segment]]; law = \"constant-speed\"; speed = \"80 mm/s\"; move = \"11 mm\"";
    let join = "[[motion.segment]]; law = \"join\"; duration = \"0.4 s\"";
    let ram = "of = { point = \"slider\", along = \"x\" }; near = \"300 deg\"; start = \"195 mm\"";
    let press = |kind: &str, segments: &[&str]| {
        with_motion(
            "press.toml",
            &format!("type = \"{kind}\"; {ram}; {}", segments.join("; ")),
        )
    };
    read(&press("cycle", &[sync, join]));
    read(&press(
        "point-to-point",
        &[sync, &format!("{join}; to = \"360 deg\"")],
    ));
    let top = format!("{join}; to = \"180 deg\"");
    for (kind, segments, words) in [
        ("cycle", vec![join, sync], "cannot begin with a join"),
        ("point-to-point", vec![sync, join], "leads nowhere"),
        (
            "cycle",
            vec![sync, &top, sync],
            "moves the tool behind a join",
        ),
        ("cycle", vec![sync, join, join], "but other segments follow"),
    ] {
        refuses(&press(kind, &segments), &[words]);
    }
    refuses(
        &press("cycle", &[sync, &top]),
        &["must end with one that leads back to its start"],
    );
    refuses(
        &press("cycle", &[sync, &format!("{join}; move = \"3 mm\"")]),
        &["`move`", "is not used by the law \"join\""],
    );
    refuses(
        &press("cycle", &[sync, &format!("{join}; end_speed = \"3 mm/s\"")]),
        &[
            "`end_speed`",
            "a join has the speed and acceleration of what it joins",
        ],
    );
}

/// Of the drive link itself: from 60 rpm round to 60 rpm, after a stop on the way.
#[test]
fn a_join_of_the_drive_link() {
    let motion = super::motion(
        "cycle",
        &[
            "law = \"constant-speed\"; speed = \"60 rpm\"; move = \"90 deg\"",
            "law = \"join\"; to = \"200 deg\"; duration = \"0.4 s\"",
            "dwell = \"0.1 s\"",
            "law = \"join\"; duration = \"0.6 s\"",
        ],
    );
    within("stop", motion.at(0.7).phi, 200_f64.to_radians(), 1e-13);
    within("stop", motion.at(0.7).omega, 0.0, 1e-12);
    within("round", motion.at(1.35).phi, TAU, 1e-13);
    within("speed", motion.at(1.35).omega, TAU, 1e-12);
}
