//! Parts of motions.

use jred::machine::motion::Law;
use jred_file::model::motion::{Motion, MotionSegment};
use jred_motion::moves::{Move, NoMoves, Part, chain};

/// Moves, a pause, a move through a joint of two segments in motion, and an immediate return.
#[test]
fn segments_become_moves_and_pauses() {
    let law = Law::Polynomial345;
    let segments = [
        MotionSegment::law(1.0, 0.5, law),
        MotionSegment::dwell(0.25),
        MotionSegment::law(0.5, 0.25, law),
        MotionSegment::law(-1.5, 1.0, Law::default()),
        MotionSegment::dwell(0.1),
    ];
    let motion = Motion::segments(0.2, &segments, true).unwrap();
    let found = chain(&motion, &[]).unwrap().parts;
    let a_move = |from, to, duration| Part::Move(Move { from, to, duration });
    let expected = [
        a_move(0.2, 1.2, 0.5),
        Part::Dwell {
            at: 1.2,
            duration: 0.25,
        },
        a_move(1.2, 1.7, 0.25),
        a_move(1.7, 0.2, 1.0),
        Part::Dwell {
            at: 0.2,
            duration: 0.1,
        },
    ];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(&expected) {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
        let same = match (found, expected) {
            (Part::Move(a), Part::Move(b)) => {
                near(a.from, b.from) && near(a.to, b.to) && near(a.duration, b.duration)
            }
            (Part::Dwell { at, duration }, Part::Dwell { at: a, duration: d }) => {
                near(*at, *a) && near(*duration, *d)
            }
            _ => false,
        };
        assert!(same, "{found:?}, not {expected:?}");
    }
}

#[test]
fn a_motion_without_rest_has_no_moves() {
    let motion = Motion::constant_speed(0.0, 3.0, 6.0);
    let chained = chain(&motion, &[]).unwrap();
    assert!(chained.endless && chained.given_up.is_none());
    assert_eq!(chained.parts.len(), 1);
    let steady = MotionSegment::constant_speed(6.0, 2.0, 3.0);
    let once = Motion::segments(0.0, &[steady], false).unwrap();
    let expected = NoMoves::NotAtRest {
        speed: 3.0,
        at_end: false,
    };
    assert_eq!(chain(&once, &[]), Err(expected));
    let still = Motion::segments(0.0, &[MotionSegment::dwell(1.0)], true).unwrap();
    assert_eq!(chain(&still, &[]), Err(NoMoves::Still));
}
