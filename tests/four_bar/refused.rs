//! Four-bars that cannot turn: the reason, and their possible stroke.

use jred::Domain;
use jred::machine::{Jointed, Mechanism, PoseError};
use jred::mechanism::{BuildError, FourBar, FourBarDimensions, Side};
use jred::number::RangeError;

use super::links;
use crate::support::{assert_near, spoken};

fn refused(lengths: [f64; 3], pivot: [f64; 2]) -> String {
    let error = FourBar::new(
        FourBarDimensions {
            crank: lengths[0],
            coupler: lengths[1],
            rocker: lengths[2],
            pivot,
        },
        Side::Left,
        links(),
    )
    .unwrap_err();
    spoken(error)
}

#[test]
fn what_cannot_turn_is_refused_with_its_reason() {
    assert_eq!(
        refused([0.3, 0.25, 0.18], [0.4, 0.0]),
        "the crank cannot turn fully: by Grashof's condition no link can: rocker + ground (shortest and longest) = 0.580000 \
         m, but must be less than coupler + crank = 0.550000 m; shorten the rocker or the ground, or drive it over a \
         stroke that stays inside φ = -74.26° and 74.26°, its dead points"
    );
    assert_eq!(
        refused([0.18, 0.25, 0.08], [0.3, 0.0]),
        "the crank cannot turn fully: by Grashof's condition only the shortest link can, the rocker of 0.080000 m; make the \
         crank or the ground the shortest link, or drive it over a stroke that stays inside φ = 30.03° and 82.82°, its dead points"
    );
    // Parallelogram: a = c, b = d.
    assert_eq!(
        refused([0.1, 0.3, 0.1], [0.3, 0.0]),
        "the crank cannot turn fully: crank + ground = rocker + coupler = 0.400000 m, so the linkage flattens into one line, \
         a dead point where its motion is not determined (parallelogram, kite); shorten the crank or the ground, or drive \
         it over a stroke that stays inside φ = 0.00° and 180.00°, its dead points"
    );
    assert_eq!(
        refused([0.1, 0.2, 0.1], [0.5, 0.0]),
        "the links cannot be joined: the ground of 0.500000 m is not shorter than the other three together, 0.400000 m; \
         shorten it, or make the others longer"
    );
    assert_eq!(
        refused([0.0, 0.2, 0.1], [0.5, 0.0]),
        "crank length is 0, but must be greater than zero"
    );
    assert_eq!(
        refused([0.1, f64::NAN, 0.1], [0.5, 0.0]),
        "coupler length is not a finite number"
    );
    assert_eq!(
        refused([0.1, 0.2, 0.1], [0.0, 0.0]),
        "distance of the pivots is 0, but must be greater than zero"
    );
    assert_eq!(
        refused([0.1, 0.2, 0.1], [0.0, f64::INFINITY]),
        "rocker pivot y is not a finite number"
    );
    let four_bar = FourBar::new(
        FourBarDimensions {
            crank: 0.08,
            coupler: 0.25,
            rocker: 0.18,
            pivot: [0.3, 0.0],
        },
        Side::Left,
        links(),
    )
    .unwrap();
    assert_eq!(
        four_bar.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("crank angle"))
    );
}

/// A parallelogram moves as one while it stays clear of the flat positions.
#[test]
fn a_parallelogram_swings_in_parallel() {
    let lengths = [0.1, 0.3, 0.1];
    let swing = |stroke| {
        FourBar::over_stroke(
            FourBarDimensions {
                crank: lengths[0],
                coupler: lengths[1],
                rocker: lengths[2],
                pivot: [0.3, 0.0],
            },
            Side::Left,
            stroke,
            links(),
        )
    };
    let parallel = swing([0.2, 3.0]).unwrap();
    assert_eq!(parallel.domain(), Domain::Stroke { from: 0.2, to: 3.0 });
    assert_eq!(
        parallel
            .joints(0.2, &parallel.frames(0.2).unwrap())
            .unwrap()
            .len(),
        4
    );
    for phi in [0.2, 1.0, 2.2, 3.0] {
        let frames = parallel.frames(phi).unwrap();
        let [coupler, rocker] = [frames[1].psi, frames[2].psi];
        assert_near("ψ2", coupler.value, 0.0, 1e-13);
        assert_near("ψ2′", coupler.d1, 0.0, 1e-12);
        assert_near("ψ3", rocker.value, phi, 1e-13);
        assert_near("ψ3′", rocker.d1, 1.0, 1e-12);
        assert_near("ψ3″", rocker.d2, 0.0, 1e-11);
    }
    assert_eq!(
        swing([0.2, 3.2]).unwrap_err().to_string(),
        "dead point: the drive cannot move the mechanism at φ = 180.00° (3.141593 rad, or m of a stroke); joint 2 locks"
    );
    assert!(matches!(
        swing([0.0, 1.0]).unwrap_err(),
        BuildError::Pose(PoseError::DeadPoint { joint: 2, .. })
    ));
    assert_eq!(
        swing([1.0, 1.0]).unwrap_err(),
        BuildError::Range(RangeError::NotPositive("length of the stroke", 0.0))
    );
}
