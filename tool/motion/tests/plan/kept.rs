//! Errors of a plan, reports where it cannot meet them, and motions that do not fit a plan.

use std::f64::consts::TAU;

use jred::Domain;
use jred::axis::plan::PlanError;
use jred_file::model::coordinate::Coordinate;
use jred_motion::plan::{MotionQuantity, Plan, SHARE};
use jred_motion::trace::{Node, Trace};

use super::{cycloid, motion};

/// A plan reports which of its three errors is exceeded, where and by how much.
#[test]
fn what_contradicts_itself_is_said() {
    let even = |contradicts: fn(&mut Node)| {
        let mut nodes = motion(10, 1.0, |t| [2.0 * t, 2.0, 0.0]).nodes().to_vec();
        contradicts(&mut nodes[5]);
        let plan = Plan::new(
            &Trace::new(Coordinate::Angle, nodes),
            Domain::Turn,
            0,
            SHARE,
        );
        plan.unwrap().excess
    };
    assert_eq!(even(|_| ()), None);
    // 0.01 rad too far in two steps of 0.1 s: a speed of 0.1·15/8 rad/s, an acceleration beyond that of the motion's cubic by 0.01·5.77/0.1².
    let excess = even(|node| node.phi += 0.01).unwrap();
    assert_eq!(excess.quantity, MotionQuantity::Speed);
    assert!((excess.allowed - 2e-3).abs() < 1e-12, "{excess:?}");
    assert!(
        (excess.error - 0.01 * 15.0 / 8.0 / 0.1).abs() < 1e-5,
        "{excess:?}"
    );
    assert!(
        (excess.t - 0.45).abs() < 1e-9 || (excess.t - 0.55).abs() < 1e-9,
        "{excess:?}"
    );
}

/// A motion on a stroke that reverses at its end between two of its nodes, and one that exceeds it there.
#[test]
fn the_stroke_is_kept() {
    let domain = Domain::stroke(0.0, 0.5).unwrap();
    // Up to x = 0.5 − more and back, with −1 m/s² in the middle and a varying jerk: (1 − cos 2πt)/4.
    let turning = |count: usize, top: f64| {
        motion(count, 1.0, move |t| {
            let angle = TAU * t;
            [
                0.5 * top * (1.0 - angle.cos()),
                0.5 * top * TAU * angle.sin(),
                0.5 * top * TAU * TAU * angle.cos(),
            ]
        })
    };
    // With a node at the top and without.
    for count in [1000, 999, 64, 63] {
        for share in [1e-1, 1e-2, SHARE] {
            let plan = Plan::new(&turning(count, 0.5), domain, 0, share).unwrap();
            assert!(plan.rows < 40, "{count} {share}: {}", plan.rows);
            assert_eq!(plan.excess, None, "{count} {share}");
        }
        let beyond = Plan::new(&turning(count, 0.500_1), domain, 0, SHARE);
        assert!(
            matches!(beyond, Err(PlanError::Number(_) | PlanError::Stroke(_))),
            "{count}: {beyond:?}"
        );
    }
}

#[test]
fn what_no_plan_holds_is_refused() {
    let outside = Domain::stroke(0.0, 3.0).unwrap();
    assert!(matches!(
        Plan::new(&cycloid(1000), outside, 0, SHARE),
        Err(PlanError::Number(_))
    ));
    let still = Trace::from_rest(Coordinate::Angle, 0.0);
    assert_eq!(
        Plan::new(&still, Domain::Turn, 0, SHARE),
        Err(PlanError::Order(0))
    );
    let far = motion(10, 1e6, |t| [100.0 * t, 100.0, 0.0]);
    assert!(matches!(
        Plan::new(&far, Domain::Turn, 0, SHARE),
        Err(PlanError::Number(_))
    ));
    // A plan is shorter than 97 days.
    let long = motion(10, 1e7, |t| [t, 1.0, 0.0]);
    assert_eq!(
        Plan::new(&long, Domain::Turn, 0, SHARE),
        Err(PlanError::Order(0))
    );
}
