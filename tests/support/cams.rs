//! Disc cams for tests.

use std::f64::consts::PI;

use super::link_of;
use jred::machine::Link;
use jred::machine::motion::Law;
use jred::mechanism::cam::{CamError, Program, Segment};
use jred::mechanism::{DiscCam, Follower, Roller, RollerDimensions, Swing};
use proptest::prelude::*;

/// Cam and follower with eccentric centres of mass.
pub(crate) fn links() -> [Link; 2] {
    [
        link_of(2.0, 0.003, [0.004, -0.002]),
        link_of(0.8, 0.0011, [0.015, 0.03]),
    ]
}

/// s = e·(1 − cos φ).
pub(crate) fn eccentric(e: f64) -> Program {
    Program::new(&[
        Segment::law(Law::SimpleSine, PI, 2.0 * e),
        Segment::law(Law::SimpleSine, PI, -2.0 * e),
    ])
    .unwrap()
}

/// Dwell 60°, cycloidal rise 120°, dwell 30°, return 150°.
pub(crate) fn four(lift: f64) -> Program {
    program(
        Law::Cycloidal,
        Law::ModifiedSine,
        lift,
        [60.0, 120.0, 30.0, 150.0],
    )
}

fn program(up: Law, down: Law, lift: f64, degrees: [f64; 4]) -> Program {
    let [dwell, rise, high, fall] = degrees.map(f64::to_radians);
    Program::new(&[
        Segment::dwell(dwell),
        Segment::law(up, rise, lift),
        Segment::dwell(high),
        Segment::law(down, fall, -lift),
    ])
    .unwrap()
}

/// A follower of each kind (0 to 5: rollers first, both swinging directions), and a suitable rise. The pivot is at `pivot` from the cam's, the arm
/// 0.9 times as long.
pub(crate) fn follower(kind: u32, radius: f64, pivot: [f64; 2], offset: f64) -> (Follower, f64) {
    let roller = Roller::new(RollerDimensions {
        radius,
        mass: 0.15,
        inertia: 8e-6,
    })
    .unwrap();
    let swing = [Swing::CounterClockwise, Swing::Clockwise][kind as usize % 2];
    let arm = 0.9 * pivot[0].hypot(pivot[1]);
    match kind {
        0 => (Follower::TranslatingRoller { offset, roller }, 0.012),
        1 => (Follower::TranslatingFace { offset }, 0.012),
        2 | 3 => (
            Follower::OscillatingRoller {
                pivot,
                arm,
                swing,
                roller,
            },
            0.14,
        ),
        _ => (
            Follower::OscillatingFace {
                pivot,
                offset,
                swing,
            },
            0.12,
        ),
    }
}

/// The cam, with its base circle enlarged as required.
pub(crate) fn build(lift: f64, base_radius: f64, follower: Follower) -> Result<DiscCam, CamError> {
    enlarged(&four(lift), base_radius, follower)
}

fn enlarged(program: &Program, base_radius: f64, follower: Follower) -> Result<DiscCam, CamError> {
    match DiscCam::new(program.clone(), base_radius, follower, links()) {
        Err(CamError::Undercut {
            base_radius: Some(cure),
            ..
        }) => DiscCam::new(program.clone(), 1.2 * cure, follower, links()),
        other => other,
    }
}

const LAWS: [Law; 6] = [
    Law::Polynomial345,
    Law::Polynomial4567,
    Law::Cycloidal,
    Law::ModifiedSine,
    Law::ModifiedTrapezoid,
    Law::SimpleSine,
];

/// Random valid cams with every kind of follower.
pub(crate) fn cam() -> impl Strategy<Value = DiscCam> {
    let parts = (
        (0u32..6, 0usize..6, 0usize..6),
        0.5f64..1.3,
        [0.2f64..1.0, 0.7..1.0, 0.1..1.0, 0.7..1.0],
        0.03f64..0.06,
        0.004f64..0.02,
        (0.09f64..0.14, -PI..PI),
        -0.01f64..0.01,
    );
    parts.prop_filter_map("a cam that can be made", |parts| {
        let ((kind, up, down), size, shares, base, radius, (distance, direction), offset) = parts;
        let pivot = [distance * direction.cos(), distance * direction.sin()];
        let (follower, lift) = follower(kind, radius, pivot, offset);
        let sum: f64 = shares.iter().sum();
        let program = program(
            LAWS[up],
            LAWS[down],
            size * lift,
            shares.map(|s| 360.0 * s / sum),
        );
        enlarged(&program, base, follower).ok()
    })
}
