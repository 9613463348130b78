//! Disc cams: the general properties of a mechanism, the profile as an envelope, textbook forms, and what cannot be made.

mod support;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use jred::cam::{CamError, Program, Segment};
use jred::mechanism::{DiscCam, Follower, Roller, Swing};
use jred::motion::Law;
use jred::{
    Action, Error, Joint, Jointed as _, Link, Load, Machine, Mechanism as _, Reducible as _,
};
use proptest::prelude::*;
use support::cams::{build, cam, eccentric, follower, four, links};
use support::{assert_near, budget, config, derivative, jointed};

fn loaded(mechanism: DiscCam) -> Machine<DiscCam> {
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

    #[test]
    fn joints_close_with_every_derivative(mechanism in cam(), phi in -7.0f64..14.0) {
        jointed::joints_close(&mechanism, phi);
    }

    #[test]
    fn cams_turn(mechanism in cam()) {
        jointed::turns(&mechanism, 1440);
    }

    #[test]
    fn dalembert_proves_the_normal(
        mechanism in cam(), phi in -7.0f64..14.0, omega in -60.0f64..60.0, alpha in -300.0f64..300.0,
    ) {
        let machine = loaded(mechanism);
        jointed::dalembert(&machine, phi, omega, alpha);
        jointed::energy(&machine, phi, omega);
    }

    /// The roller, or the face, touches the drawn profile at the point of contact and overlaps it nowhere; and the
    /// profile's tangent is square to the normal there.
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
        // How far a point of the profile is inside the roller, or beyond the face.
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
        // Curvature: the normal's turning over the way, both from the drawn curve. It runs clockwise.
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

/// The rim of the roller moves along with the cam, and its angle is the way rolled over its radius.
#[test]
fn rollers_roll() {
    let roller = Roller::new(0.012, 0.2, 2e-5).unwrap();
    let follower = Follower::TranslatingRoller {
        offset: 0.006,
        roller,
    };
    let mechanism = DiscCam::new(four(0.015), 0.04, follower, links()).unwrap();
    let steps = 20_000;
    let quarter = steps / 4;
    let (mut way, mut before) = (0.0, mechanism.pitch_curve(0.0));
    for k in 1..=steps {
        let phi = TAU * f64::from(k) / f64::from(steps);
        let now = mechanism.pitch_curve(phi);
        let chord = (now[0] - before[0]).hypot(now[1] - before[1]);
        // An arc is longer than its chord by κ²·chord²/24 of it.
        let profile = mechanism.contact(phi - PI / f64::from(steps)).curvature;
        let curvature = profile / (1.0 + roller.radius() * profile);
        way += chord * (1.0 + (curvature * chord).powi(2) / 24.0);
        before = now;
        if k % quarter == 0 {
            let angle = mechanism.frames(phi).unwrap()[DiscCam::ROLLER].psi.value;
            let expected = phi - way / roller.radius();
            assert_near("rolled", angle, expected, budget::PITCH_LENGTH);
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

/// A flat face on an eccentric circle moves exactly as e·(1 − cos φ): the profile of that motion is the circle.
#[test]
fn flat_face_on_an_eccentric_circle() {
    let (e, base) = (0.01, 0.03);
    let mechanism = DiscCam::new(
        eccentric(e),
        base,
        Follower::TranslatingFace { offset: 0.004 },
        links(),
    )
    .unwrap();
    for k in 0..360 {
        let phi = 0.02 * f64::from(k);
        let [x, y] = mechanism.profile(phi);
        assert_near(
            "circle",
            x.hypot(y + e),
            base + e,
            budget::CAM_PROFILE * base,
        );
        let contact = mechanism.contact(phi);
        assert_near(
            "1/κ",
            1.0 / contact.curvature,
            base + e,
            budget::CAM_CURVATURE * base,
        );
        assert_near(
            "touches at s'",
            contact.point[0],
            e * phi.sin(),
            budget::CAM_PROFILE * base,
        );
        assert_near("pressure angle", contact.pressure_angle, 0.0, 0.0);
    }
    let [hollow, sharp] = mechanism.curvatures();
    assert_near(
        "κ",
        hollow.value,
        1.0 / (base + e),
        budget::CAM_CURVATURE / base,
    );
    assert_near(
        "κ",
        sharp.value,
        1.0 / (base + e),
        budget::CAM_CURVATURE / base,
    );
}

/// R. L. Norton, *Cam Design and Manufacturing Handbook*, chapter 7: pressure angle and radius of curvature of a radial
/// roller follower, and of a flat face.
#[test]
fn textbook_forms_of_angle_and_radius() {
    let (base, lift, r, e) = (0.035, 0.012, 0.01, 0.007);
    let roller = Roller::new(r, 0.1, 1e-5).unwrap();
    let built = |offset| {
        DiscCam::new(
            four(lift),
            base,
            Follower::TranslatingRoller { offset, roller },
            links(),
        )
        .unwrap()
    };
    let (central, offset) = (built(0.0), built(e));
    let flat_base = 0.06;
    let flat = DiscCam::new(
        four(lift),
        flat_base,
        Follower::TranslatingFace { offset: 0.0 },
        links(),
    )
    .unwrap();
    let prime: f64 = base + r;
    for k in 0..720 {
        let phi = TAU * (f64::from(k) + 0.5) / 720.0;
        let s = central.program().displacement(phi);
        let (v, a) = (s.d1, s.d2);
        // The sign is that of the angle from the follower's way up to the normal: a rise leans it forward (clockwise cam).
        let tan = v / (prime + s.value);
        assert_near(
            "tan α",
            central.contact(phi).pressure_angle,
            tan.atan(),
            budget::CAM_PROFILE,
        );
        let tan = (v - e) / ((prime * prime - e * e).sqrt() + s.value);
        assert_near(
            "tan α",
            offset.contact(phi).pressure_angle,
            tan.atan(),
            budget::CAM_PROFILE,
        );
        let q = prime + s.value;
        let pitch = (q * q + v * v).powf(1.5) / (q * q + 2.0 * v * v - q * a);
        let curvature = central.contact(phi).curvature;
        assert_near(
            "ρ",
            (1.0 / curvature + r) / pitch,
            1.0,
            budget::CAM_CURVATURE,
        );
        assert_near(
            "ρ",
            1.0 / flat.contact(phi).curvature,
            flat_base + s.value + a,
            budget::CAM_CURVATURE * base,
        );
    }
    // The extremes are those of the curve.
    let dense = |f: &dyn Fn(f64) -> f64| {
        (0..200_000)
            .map(|k| f(TAU * f64::from(k) / 2e5))
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let [low, high] = offset.pressure_angles();
    let most = dense(&|phi| offset.contact(phi).pressure_angle);
    assert_near(
        "largest",
        high.value,
        most,
        budget::EXTREME_PLACE.powi(2) + 1e-9,
    );
    assert_near(
        "at it",
        offset.contact(high.phi).pressure_angle,
        high.value,
        0.0,
    );
    let least = -dense(&|phi| -offset.contact(phi).pressure_angle);
    assert_near("smallest", low.value, least, 1e-9);
}

/// A dwell is an arc about the cam's axis, for every kind of follower.
#[test]
fn dwells_are_arcs() {
    for kind in 0..6 {
        let (follower, _) = follower(kind, 0.01, [0.01, 0.09], 0.0);
        let angular = follower.pivot().is_some();
        let lift = if angular { 0.12 } else { 0.012 };
        let mechanism = DiscCam::new(four(lift), 0.05, follower, links()).unwrap();
        for phi in [0.1, 0.3, 0.6] {
            let [x, y] = mechanism.profile(phi);
            assert_near("base circle", x.hypot(y), 0.05, budget::CAM_PROFILE * 0.05);
            assert_near(
                "κ",
                mechanism.contact(phi).curvature,
                20.0,
                20.0 * budget::CAM_CURVATURE,
            );
        }
    }
}

/// Without losses the drive's work over a turn is zero, whatever the spring and the weight do in between.
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

/// The spring's force is preload + stiffness·s on the cam.
#[test]
fn closing_springs_press() {
    let (stiffness, preload) = (7e3, 150.0);
    let face = Follower::TranslatingFace { offset: 0.003 };
    let mechanism = DiscCam::new(eccentric(0.01), 0.03, face, links()).unwrap();
    let spring = mechanism.closing_spring(stiffness, preload).unwrap();
    let machine = Machine::new(&mechanism).with_element(spring).unwrap();
    for phi in [0.0, 0.7, 3.0, 4.4] {
        let s = 0.01 * (1.0 - f64::cos(phi));
        let force = jred::cam::contact_force(&machine, DiscCam::CONTACT, phi, 0.0, 0.0).unwrap();
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

/// Undercut names the place, the radius and the base radius that cures it: a flat face needs r_b > −min(s + s″).
#[test]
fn undercut_is_cured_by_the_radius_told() {
    let (beta, lift) = (2.0 * PI / 3.0, 0.03);
    let program = four(lift);
    // Of the cycloidal rise s + s″ is smallest past its middle: found on a dense grid.
    let least = (0..400_000)
        .map(|k| {
            let s = program.displacement(TAU * f64::from(k) / 4e5);
            s.value + s.d2
        })
        .fold(0.0, f64::min);
    assert!(least < -0.01, "{least} of a rise over {beta}");
    let face = Follower::TranslatingFace { offset: 0.0 };
    let Err(Error::Cam(CamError::Undercut {
        phi,
        radius,
        limit,
        base_radius,
    })) = DiscCam::new(program.clone(), 0.01, face, links())
    else {
        panic!("not refused")
    };
    let cure = base_radius.unwrap();
    assert_near("cure", cure, -least, 1e-9);
    assert_near("radius", radius, 0.01 + least, 1e-9);
    let s = program.displacement(phi);
    assert_near("radius", radius, 0.01 + s.value + s.d2, 1e-15);
    assert_near("limit", limit, 0.0, 0.0);
    assert!(DiscCam::new(program.clone(), cure * 1.000_001, face, links()).is_ok());
    assert!(DiscCam::new(program.clone(), cure * 0.999_999, face, links()).is_err());

    for kind in 0..6 {
        let (follower, lift) = follower(kind, 0.05, [0.02, 0.2], 0.0);
        // A steep rise.
        let steep = Program::new(&[
            Segment::dwell(PI),
            Segment::law(Law::Cycloidal, PI / 3.0, 1.5 * lift),
            Segment::law(Law::Cycloidal, 2.0 * PI / 3.0, -1.5 * lift),
        ])
        .unwrap();
        let Err(error) = DiscCam::new(steep.clone(), 0.012, follower, links()) else {
            panic!("{kind} is not refused")
        };
        let Error::Cam(CamError::Undercut {
            base_radius: Some(cure),
            radius,
            limit,
            ..
        }) = error
        else {
            panic!("{kind}: {error}")
        };
        assert!(radius <= limit, "{kind}: {error}");
        let fits = |base| {
            !matches!(
                DiscCam::new(steep.clone(), base, follower, links()),
                Err(Error::Cam(CamError::Undercut { .. }))
            )
        };
        assert!(
            fits(cure * 1.000_001) && !fits(cure * 0.999_999),
            "{kind}: {cure}"
        );
    }
}

fn refused(program: Program, base_radius: f64, follower: Follower) -> String {
    DiscCam::new(program, base_radius, follower, links())
        .unwrap_err()
        .to_string()
}

#[test]
fn impossible_cams_are_refused() {
    let roller = Roller::new(0.01, 0.1, 1e-5).unwrap();
    let face = Follower::TranslatingFace { offset: 0.0 };
    let sliding = |offset| Follower::TranslatingRoller { offset, roller };
    let arm = |pivot, arm| Follower::OscillatingRoller {
        pivot,
        arm,
        swing: Swing::Clockwise,
        roller,
    };
    let swinging = |x, offset| Follower::OscillatingFace {
        pivot: [x, 0.0],
        offset,
        swing: Swing::CounterClockwise,
    };
    assert_eq!(
        refused(four(0.01), 0.0, face),
        "base radius is 0, but must be greater than zero"
    );
    assert_eq!(
        refused(four(0.01), f64::NAN, face),
        "base radius is not a finite number"
    );
    assert_eq!(
        refused(
            four(0.01),
            0.03,
            Follower::TranslatingFace {
                offset: f64::INFINITY
            }
        ),
        "offset of the guide is not a finite number"
    );
    assert_eq!(
        refused(four(0.01), 0.03, sliding(-0.04)),
        "the base radius is too small for the guide's offset of -0.04 m: make it larger than 0.03 m, or reduce the offset"
    );
    assert_eq!(
        refused(four(0.1), 0.03, arm([0.1, 0.0], 0.05)),
        "the arm cannot hold the roller on the base circle: with its pivot 0.1 m from the cam's, base radius + roller \
         radius must lie between 0.05 m and 0.15000000000000002 m"
    );
    assert_eq!(
        refused(four(0.1), 0.03, arm([0.0, 0.0], 0.05)),
        "distance of the pivots is 0, but must be greater than zero"
    );
    assert_eq!(
        refused(four(0.1), 0.03, arm([0.1, 0.0], -0.05)),
        "length of the arm is -0.05, but must be greater than zero"
    );
    assert_eq!(
        refused(four(0.1), 0.03, swinging(0.04, 0.02)),
        "the face cannot lie on the base circle: its pivot is 0.04 m from the cam's, but must be farther than base radius \
         + face offset = 0.05 m"
    );
    assert_eq!(
        refused(four(2.9), 0.03, arm([0.1, 0.0], 0.09)),
        "the follower swings too far at φ = 180.00°: beyond the line of the two pivots, or square to it; reduce the rise \
         or move the pivot"
    );
    assert_eq!(
        refused(four(1.5), 0.03, swinging(0.1, 0.0)),
        "the follower swings too far at φ = 180.00°: beyond the line of the two pivots, or square to it; reduce the rise \
         or move the pivot"
    );
    let below = Program::new(&[
        Segment::law(Law::Cycloidal, PI, -0.02),
        Segment::law(Law::Cycloidal, PI, 0.02),
    ]);
    assert_eq!(
        refused(below.unwrap(), 0.02, face),
        "the follower goes down to the cam's axis at φ = 180.00°: make the base radius larger"
    );
    // A rise of 1 rad within 0.9 rad by a law with C_v = 2: twice as fast as the cam.
    let fast = Program::new(&[
        Segment::law(Law::Cycloidal, 0.9, 1.0),
        Segment::law(Law::Cycloidal, TAU - 0.9, -1.0),
    ]);
    let message = refused(fast.unwrap(), 0.03, swinging(0.1, 0.0));
    assert!(
        message.starts_with("the face turns 2.222 times as fast as the cam at φ = 25.78°"),
        "{message}"
    );
    for (radius, mass, inertia) in [(0.0, 1.0, 1.0), (0.01, -1.0, 1.0), (0.01, 1.0, f64::NAN)] {
        assert!(Roller::new(radius, mass, inertia).is_err());
    }
    let message = refused(four(0.03), 0.01, face);
    assert!(message.starts_with("undercut at φ = "), "{message}");
    assert!(
        message.contains("but must be larger than 0 m; make the base radius larger than 0."),
        "{message}"
    );
}

/// The joints are the documented ones, and the guide carries no force along itself.
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

/// A cutter's path is the equidistant of the profile, and with the roller's size the pitch curve.
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
