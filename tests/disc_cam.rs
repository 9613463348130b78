//! Disc cams: the general properties of a mechanism, the profile as an envelope, the rolling, the spring.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::support::cams::{build, cam, eccentric, follower, four, links};
use crate::support::{assert_near, budget, config, derivative};
use jred::machine::motion::Law;
use jred::machine::{
    Action, Joint, Jointed as _, Link, Load, Machine, Mechanism as _, Reducible as _,
};
use jred::mechanism::cam::{CamError, Program, Segment};
use jred::mechanism::{DiscCam, Follower, Roller, RollerDimensions, Swing};
use proptest::prelude::*;

pub(crate) fn loaded(mechanism: DiscCam) -> Machine<DiscCam> {
    let spring = mechanism.closing_spring(8e3, 120.0).unwrap();
    let follower = DiscCam::FOLLOWER;
    Machine::new(mechanism)
        .with_gravity([1.3, -9.7])
        .and_then(|m| m.with_element(spring))
        .and_then(|m| {
            let pull = Load::new(follower, Action::Force([-40.0, 25.0]))?.at([0.01, 0.02])?;
            m.with_load(pull)
        })
        .and_then(|m| m.with_load(Load::new(follower, Action::ViscousForce(3.0))?))
        .and_then(|m| {
            m.with_load(Load::new(follower, Action::OpposingForce(12.0))?.at([0.01, 0.0])?)
        })
        .unwrap()
}

proptest! {
    #![proptest_config(config(60, 0x0ca1))]

    /// The roller, or the face, touches the drawn profile at the contact point and overlaps it nowhere; the profile's tangent is perpendicular to the
    /// normal there.
    #[test]
    fn roller_touches_the_profile_all_round(mechanism in cam(), phi in 0.0f64..TAU) {
        let size = mechanism.base_radius();
        let profile = |at: f64| mechanism.profile(at);
        let touching = profile(phi);
        let (sin, cos) = phi.sin_cos();
        let [n_x, n_y] = mechanism.contact(phi).normal;
        let normal = [cos * n_x + sin * n_y, cos * n_y - sin * n_x];
        let centre = mechanism.pitch_curve(phi);
        let radius = mechanism.follower().roller().map_or(0.0, Roller::radius);
        // Depth of a point of the profile inside the roller, or beyond the face.
        let overlap = |[x, y]: [f64; 2]| match radius {
            0.0 => (x - centre[0]) * normal[0] + (y - centre[1]) * normal[1],
            radius => radius - (x - centre[0]).hypot(y - centre[1]),
        };
        assert_near("touches", overlap(touching), 0.0, budget::CAM_PROFILE * size);
        for k in 0..2000 {
            let depth = overlap(profile(TAU * f64::from(k) / 2000.0));
            prop_assert!(depth <= budget::CAM_PROFILE * size, "{} m too deep", depth);
        }
        // Away from the ends of smooth pieces.
        let near = |at: f64| (phi - at).abs() < 2e-3;
        prop_assume!(!mechanism.program().pieces().any(|p| near(p.from) || near(p.to)));
        let slope = [0, 1].map(|c| derivative(|at| profile(at)[c], phi, 1e-3));
        let across = slope[0] * normal[0] + slope[1] * normal[1];
        assert_near("tangent", across, 0.0, budget::CAM_TANGENT * size);
        // Curvature: change of the normal's direction over the distance, both from the drawn curve, which runs clockwise.
        let speed = slope[0].hypot(slope[1]);
        let heading = |at: f64| {
            let ([x, y], (s, c)) = (mechanism.contact(at).normal, at.sin_cos());
            let turned = [c * x + s * y, c * y - s * x];
            (turned[1] * normal[0] - turned[0] * normal[1]).atan2(turned[0] * normal[0] + turned[1] * normal[1])
        };
        let turning = -derivative(heading, phi, 1e-3);
        let curvature = mechanism.contact(phi).curvature;
        assert_near("curvature", curvature * speed, turning, budget::CAM_TANGENT * (1.0 + turning.abs()) * 10.0);
    }
}

/// The rim of the roller moves with the cam, and its angle is the rolled distance over its radius.
#[test]
fn rollers_roll() {
    for kind in [0, 2, 3] {
        let (follower, lift) = follower(kind, 0.012, [0.01, 0.09], 0.006);
        rolls(&build(lift, 0.04, follower).unwrap());
    }
}

#[track_caller]
fn rolls(mechanism: &DiscCam) {
    let radius = mechanism.follower().roller().unwrap().radius();
    let steps = 20_000;
    let quarter = steps / 4;
    let (mut way, mut before) = (0.0, mechanism.pitch_curve(0.0));
    for k in 1..=steps {
        let phi = TAU * f64::from(k) / f64::from(steps);
        let now = mechanism.pitch_curve(phi);
        let chord = (now[0] - before[0]).hypot(now[1] - before[1]);
        // An arc is longer than its chord by the share κ²·chord²/24.
        let profile = mechanism
            .contact(phi - 0.5 * TAU / f64::from(steps))
            .curvature;
        let curvature = profile / (1.0 + radius * profile);
        way += chord * (1.0 + (curvature * chord).powi(2) / 24.0);
        before = now;
        if k % quarter == 0 {
            let angle = mechanism.frames(phi).unwrap()[DiscCam::ROLLER].psi.value;
            assert_near("rolled", angle, phi - way / radius, budget::PITCH_LENGTH);
        }
    }
    // Every derivative matches the one before.
    let psi = |phi: f64| mechanism.frames(phi).unwrap()[DiscCam::ROLLER].psi;
    for phi in [0.5, 1.3, 2.2, 4.4, 5.0] {
        let found = psi(phi);
        let chain = |at: f64| {
            let psi = psi(at);
            [psi.value, psi.d1, psi.d2]
        };
        for (order, found) in [found.d1, found.d2, found.d3].into_iter().enumerate() {
            let expected = derivative(|at| chain(at)[order], phi, 1e-3);
            let size = 1.0 + expected.abs();
            assert_near(
                "ψ's derivative",
                found,
                expected,
                budget::CAM_TANGENT * size,
            );
        }
    }
    let frames = mechanism.frames(1.1).unwrap();
    let at = mechanism.contact(1.1).point;
    let [cam, rim] = [DiscCam::CAM, DiscCam::ROLLER].map(|k| {
        let frame = &frames[k];
        let arm = [at[0] - frame.x.value, at[1] - frame.y.value];
        [
            frame.x.d1 - frame.psi.d1 * arm[1],
            frame.y.d1 + frame.psi.d1 * arm[0],
        ]
    });
    assert_near("rim x", rim[0], cam[0], budget::CAM_PROFILE);
    assert_near("rim y", rim[1], cam[1], budget::CAM_PROFILE);
}

/// Without losses the drive's work over a turn is zero, with any spring and weight.
#[test]
fn a_turn_without_losses_needs_no_work() {
    for kind in 0..6 {
        let (follower, lift) = follower(kind, 0.01, [0.01, 0.09], 0.004);
        let mechanism = build(lift, 0.05, follower).unwrap();
        let spring = mechanism.closing_spring(9e3, 200.0).unwrap();
        let machine = Machine::new(mechanism)
            .with_gravity([0.0, -9.81])
            .unwrap()
            .with_element(spring)
            .unwrap();
        let (omega, steps) = (50.0, 7200);
        let (mut work, mut size) = (0.0, 0.0);
        for k in 0..steps {
            let phi = TAU * (f64::from(k) + 0.5) / f64::from(steps);
            let torque = machine.forces(phi, omega, 0.0).unwrap().drive * TAU / f64::from(steps);
            work += torque;
            size += torque.abs();
        }
        assert!(size > 1.0, "{size}");
        // The sum over equal steps of a curve with a continuous first derivative.
        assert_near("work", work, 0.0, budget::WINDOW_WORK * size);
    }
}

/// The spring's force on the cam is preload + stiffness·s.
#[test]
fn closing_springs_press() {
    let (stiffness, preload) = (7e3, 150.0);
    let face = Follower::TranslatingFace { offset: 0.003 };
    let mechanism = DiscCam::new(eccentric(0.01), 0.03, face, links()).unwrap();
    let spring = mechanism.closing_spring(stiffness, preload).unwrap();
    let machine = Machine::new(&mechanism).with_element(spring).unwrap();
    for phi in [0.0, 0.7, 3.0, 4.4] {
        let s = 0.01 * (1.0 - f64::cos(phi));
        let force =
            jred::mechanism::cam::contact_force(&machine, DiscCam::CONTACT, phi, 0.0, 0.0).unwrap();
        assert_near(
            "N",
            force,
            preload + stiffness * s,
            budget::DALEMBERT * preload,
        );
    }
    for kind in 2..6 {
        let (follower, lift) = follower(kind, 0.01, [0.01, 0.09], 0.0);
        if follower.pivot().is_none() {
            continue;
        }
        let mechanism = build(lift, 0.05, follower).unwrap();
        let spring = mechanism.closing_spring(40.0, 5.0).unwrap();
        for phi in [0.2, 1.5, 2.9] {
            let s = mechanism.program().displacement(phi).value;
            let frames = mechanism.frames(phi).unwrap();
            let (_, swing) = follower.pivot().unwrap();
            let moment = spring.effort(&frames, 0.0) * -swing.sign();
            assert_near("moment", moment, 5.0 + 40.0 * s, budget::DALEMBERT);
        }
    }
}

/// The joints are the documented ones, and the guide carries no force along its direction.
#[test]
fn joints_are_in_order() {
    let (roller, _) = follower(0, 0.01, [0.01, 0.09], 0.0);
    let mechanism = build(0.01, 0.05, roller).unwrap();
    assert_eq!(mechanism.links().len(), 3);
    let frames = mechanism.frames(1.0).unwrap();
    let joints = mechanism.joints(1.0, &frames).unwrap();
    assert!(matches!(
        joints.as_slice(),
        [
            Joint::Revolute(_),
            Joint::Prismatic(_),
            Joint::Transmission(_),
            Joint::Revolute(_),
            Joint::Transmission(_)
        ]
    ));
    let face = DiscCam::new(
        four(0.01),
        0.05,
        Follower::TranslatingFace { offset: 0.0 },
        links(),
    )
    .unwrap();
    let frames = face.frames(1.0).unwrap();
    let joints = face.joints(1.0, &frames).unwrap();
    assert!(matches!(
        joints.as_slice(),
        [
            Joint::Revolute(_),
            Joint::Prismatic(_),
            Joint::Transmission(_)
        ]
    ));
    let forces = Machine::new(face).forces(1.0, 30.0, 5.0).unwrap();
    let guide = forces.reactions[1].force;
    assert_near(
        "along the guide",
        guide[1],
        0.0,
        1e-12 * (1.0 + guide[0].abs()),
    );
    assert_near("π/2", FRAC_PI_2, PI / 2.0, 0.0);
}

/// A cutter's path is the equidistant of the profile; with the roller's size it is the pitch curve.
#[test]
fn cutter_paths() {
    let (roller, _) = follower(0, 0.01, [0.01, 0.09], 0.004);
    let mechanism = build(0.01, 0.05, roller).unwrap();
    for phi in [0.0, 1.0, 2.0, 4.0] {
        let (p, cutter) = (mechanism.profile(phi), mechanism.equidistant(phi, 0.025));
        assert_near(
            "distance",
            (p[0] - cutter[0]).hypot(p[1] - cutter[1]),
            0.025,
            budget::CAM_PROFILE,
        );
        let (pitch, same) = (mechanism.pitch_curve(phi), mechanism.equidistant(phi, 0.01));
        assert_near("u", pitch[0], same[0], 0.0);
        assert_near("v", pitch[1], same[1], 0.0);
        // The roller's centre, seen from the cam.
        let frames = mechanism.frames(phi).unwrap();
        let [x, y] = frames[DiscCam::CAM].point(pitch).map(|c| c.value);
        let roller = &frames[DiscCam::ROLLER];
        assert_near("x", roller.x.value, x, budget::CAM_PROFILE);
        assert_near("y", roller.y.value, y, budget::CAM_PROFILE);
    }
    let still = Link::rotor(0.0).unwrap();
    assert!(
        Machine::new(DiscCam::new(four(0.01), 0.05, roller, [still; 2]).unwrap())
            .reduction(0.1)
            .is_ok()
    );
}

/// A cam that would cover the axis of its own follower is refused, and is not offered as a cure for undercut.
#[test]
fn a_cam_does_not_cover_the_followers_pivot() {
    let roller = Roller::new(RollerDimensions {
        radius: 0.01,
        mass: 0.1,
        inertia: 5e-6,
    })
    .unwrap();
    let pivot = [0.1, 0.0];
    let swing = Swing::CounterClockwise;
    let follower = |arm| Follower::OscillatingRoller {
        pivot,
        arm,
        swing,
        roller,
    };
    let refused = DiscCam::new(four(0.14), 0.105, follower(0.15), links()).unwrap_err();
    let CamError::CoversPivot {
        reach,
        pivot: distance,
        ..
    } = refused
    else {
        panic!("{refused}")
    };
    assert_near("pivot", distance, 0.1, 1e-15);
    assert!((0.105..0.13).contains(&reach), "{reach}");
    assert!(
        refused
            .cure()
            .to_string()
            .contains("make the base radius smaller"),
        "{refused}"
    );
    // 18° in 25° of the cam: a cam without undercut would be larger than the distance of the pivots.
    let [steep, rest] = [25.0_f64, 335.0].map(f64::to_radians);
    let rise = 18.0_f64.to_radians();
    let program = Program::new(&[
        Segment::law(Law::Cycloidal, steep, rise),
        Segment::law(Law::Cycloidal, rest, -rise),
    ]);
    let refused = DiscCam::new(program.unwrap(), 0.03, follower(0.09), links()).unwrap_err();
    let CamError::Undercut { base_radius, .. } = refused else {
        panic!("{refused}")
    };
    assert_eq!(base_radius, None);
    assert!(
        refused
            .cure()
            .to_string()
            .contains("no base radius cures it here"),
        "{refused}"
    );
}
