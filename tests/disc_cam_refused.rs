//! Impossible cams: the fault, and its cure.

use crate::support::spoken;
use std::f64::consts::{PI, TAU};

use crate::support::assert_near;
use crate::support::cams::{follower, four, links};
use jred::machine::motion::Law;
use jred::mechanism::cam::{CamError, Program, Segment};
use jred::mechanism::{DiscCam, Follower, Roller, RollerDimensions, Swing};
use jred::number::RangeError;

fn roller_of(radius: f64, mass: f64, inertia: f64) -> Result<Roller, RangeError> {
    Roller::new(RollerDimensions {
        radius,
        mass,
        inertia,
    })
}

/// Undercut names the position, the radius and a sufficient base radius: a flat face needs r_b > −min(s + s″).
#[test]
fn undercut_is_cured_by_the_radius_told() {
    let (beta, lift) = (2.0 * PI / 3.0, 0.03);
    let program = four(lift);
    // For the cycloidal rise s + s″ is smallest after its middle: from a dense grid.
    let least = (0..400_000)
        .map(|k| {
            let s = program.displacement(TAU * f64::from(k) / 4e5);
            s.value + s.d2
        })
        .fold(0.0, f64::min);
    assert!(least < -0.01, "{least} of a rise over {beta}");
    let face = Follower::TranslatingFace { offset: 0.0 };
    let Err(CamError::Undercut {
        phi,
        radius,
        limit,
        base_radius,
    }) = DiscCam::new(program.clone(), 0.01, face, links())
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
        let CamError::Undercut {
            base_radius: Some(cure),
            radius,
            limit,
            ..
        } = error
        else {
            panic!("{kind}: {error}")
        };
        assert!(radius <= limit, "{kind}: {error}");
        let fits = |base| {
            !matches!(
                DiscCam::new(steep.clone(), base, follower, links()),
                Err(CamError::Undercut { .. })
            )
        };
        assert!(
            fits(cure * 1.000_001) && !fits(cure * 0.999_999),
            "{kind}: {cure}"
        );
    }
}

fn refused(program: Program, base_radius: f64, follower: Follower) -> String {
    spoken(DiscCam::new(program, base_radius, follower, links()).unwrap_err())
}

#[test]
fn impossible_cams_are_refused() {
    let roller = roller_of(0.01, 0.1, 1e-5).unwrap();
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
        "the base radius is too small for the guide's offset of -0.04 m; make it larger than 0.03 m, or reduce the offset"
    );
    assert_eq!(
        refused(four(0.1), 0.03, arm([0.1, 0.0], 0.05)),
        "the arm cannot hold the roller on the base circle: with its pivot 0.1 m from the cam's, base radius + roller \
         radius must lie between 0.05 m and 0.15000000000000002 m; change the base radius, or move the pivot"
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
         + face offset = 0.05 m; move the pivot outwards, or make the base radius smaller"
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
    // The same on the other side: beyond the line of the pivots, and perpendicular to it, on the side of the return.
    for (follower, fall) in [(arm([0.1, 0.0], 0.09), -2.9), (swinging(0.1, 0.0), -1.9)] {
        let message = refused(four(fall), 0.03, follower);
        assert!(
            message.starts_with("the follower swings too far at φ = 180.00°"),
            "{message}"
        );
    }
    let below = Program::new(&[
        Segment::law(Law::Cycloidal, PI, -0.02),
        Segment::law(Law::Cycloidal, PI, 0.02),
    ]);
    assert_eq!(
        refused(below.unwrap(), 0.02, face),
        "the follower goes down to the cam's axis at φ = 180.00°; make the base radius larger"
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
        assert!(roller_of(radius, mass, inertia).is_err());
    }
    let message = refused(four(0.03), 0.01, face);
    assert!(message.starts_with("undercut at φ = "), "{message}");
    assert!(
        message.contains("but must be larger than 0 m; make the base radius larger than 0."),
        "{message}"
    );
}

/// An arm takes its roller of 10 mm as near to the cam's axis as d² + l² − 2·d·l·cos ψ gives: below its radius it would cover the axis.
#[test]
fn a_roller_does_not_cover_the_axis() {
    let (d, l) = (0.1, 0.105);
    let follower = Follower::OscillatingRoller {
        pivot: [d, 0.0],
        arm: l,
        swing: Swing::Clockwise,
        roller: roller_of(0.01, 0.1, 1e-5).unwrap(),
    };
    let angle = |prime: f64| ((d * d + l * l - prime * prime) / (2.0 * d * l)).acos();
    for (nearest, covers) in [(0.0099, true), (0.0101, false)] {
        let fall = angle(0.03 + 0.01) - angle(nearest);
        let made = DiscCam::new(four(-fall), 0.03, follower, links());
        let found = matches!(made, Err(CamError::BelowAxis { .. }));
        assert_eq!(found, covers, "{nearest}: {made:?}");
    }
}
