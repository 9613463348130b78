//! A rod that does not reach.

use std::f64::consts::PI;

use jred::error::Error;
use jred::machine::Mechanism;
use jred::mechanism::{BuildError, RotationError};

use super::{says, slider_crank};
use crate::support::{assert_near, budget};

/// l < r + |e|: where the rod no longer reaches the guide, by geometry, for each sign of e and l − |e|.
#[test]
fn short_rod_names_its_angle() {
    for (r, l, e) in [
        (0.1, 0.08, 0.01),
        (0.1, 0.08, -0.01),
        (0.1, 0.12, 0.05),
        (0.1, 0.12, -0.05),
        (0.2, 0.2, 0.0),
    ] {
        let error = says(
            slider_crank(r, l, e),
            &["make the rod longer than", "shorten the crank"],
        );
        let Error::Build(BuildError::Rotation(RotationError::TooShort {
            phi,
            shortest,
            reach,
            ..
        })) = error
        else {
            panic!("{error:?}")
        };
        // The other end of the reach is the mirror image at φ = 90° or 270°, or that of the other side.
        let [before, after] = reach.unwrap();
        assert_near("reach", after, phi, budget::CLOSED_FORM);
        assert!(before < 0.0 && (e - r * before.sin()).abs() <= l * (1.0 + budget::IDENTITY));
        assert_near("shortest rod", shortest, r + e.abs(), f64::EPSILON);
        let degrees = format!("φ = {:.2}°", phi.to_degrees());
        assert!(
            error.to_string().contains(&degrees),
            "{error} does not say {degrees}"
        );
        // Scan: the rod reaches up to φ, and not just after (exactly at the end if l = r + |e|).
        let reaches = |phi: f64| (e - r * phi.sin()).abs() <= l * (1.0 + budget::IDENTITY);
        let steps = 10_000;
        assert!(
            (0..=steps).all(|k| reaches(phi * f64::from(k) / f64::from(steps))),
            "fails before {phi}"
        );
        assert_near(
            "at the end of its reach",
            (e - r * phi.sin()).abs(),
            l,
            budget::CLOSED_FORM,
        );
        assert!(
            l >= r + e.abs() || !reaches(phi + 1e-3),
            "goes on after {phi}"
        );
    }
    // A guide farther away than the rod's length is not reached at φ = 0.
    let error = says(slider_crank(0.1, 0.3, -0.4), &["φ = 0.00°", "0.500000 m"]);
    let blocked = RotationError::TooShort {
        link: "rod",
        phi: 0.0,
        shortest: 0.5,
        reach: None,
    };
    assert_eq!(error, Error::Build(BuildError::Rotation(blocked)));
}

/// l = r + |e| exactly, up to rounding: the angle is 270°, not a full turn.
#[test]
fn rod_of_the_limit_length_names_its_angle() {
    let (r, e) = (0.1, 0.2);
    let error = slider_crank(r, r + e, e).unwrap_err();
    let BuildError::Rotation(RotationError::TooShort { phi, .. }) = error else {
        panic!("{error:?}")
    };
    assert_near("φ", phi, 1.5 * PI, budget::LIMIT_ANGLE);
}

/// The constructor refuses lengths that roundings could turn into a dead point: an accepted rod has a position at every angle.
#[test]
fn a_rod_of_a_hair_more_than_the_limit_turns_fully_or_is_refused() {
    let r = 0.807_812_5; // chosen so that l·(1/l) rounds to r/l = 1
    let refused = slider_crank(r, f64::next_up(r), 0.0).unwrap_err();
    assert!(
        matches!(
            refused,
            BuildError::Rotation(RotationError::TooShort { .. })
        ),
        "{refused:?}"
    );
    let mechanism = slider_crank(r, r * (1.0 + 2e-12), 0.0).unwrap();
    for phi in [0.5 * PI, 1.5 * PI] {
        let frames = mechanism.frames(phi).unwrap();
        assert!(frames[1].psi.d3.is_finite(), "φ = {phi}");
    }
}
