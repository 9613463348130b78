//! Disc cams against closed forms: the eccentric circle, textbook formulas, arcs in the dwells.

use std::f64::consts::TAU;

use crate::support::cams::{eccentric, follower, four, links};
use crate::support::{assert_near, budget};
use jred::mechanism::{DiscCam, Follower, Roller, RollerDimensions};

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
    let roller = Roller::new(RollerDimensions {
        radius: r,
        mass: 0.1,
        inertia: 1e-5,
    })
    .unwrap();
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
        // The sign is that of the angle from the follower's direction up to the normal: a rise leans it forward (clockwise cam).
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
