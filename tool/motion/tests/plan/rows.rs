//! Start and number of a plan's rows.

use std::f64::consts::TAU;

use jred::Domain;
use jred::axis::plan::HEADER_WORDS;
use jred_file::model::coordinate::Coordinate;
use jred_motion::plan::{MotionQuantity, Plan, SHARE};
use jred_motion::trace::{Node, Trace};

use super::{cycloid, motion};

/// The fewest rows for the error. The error of the acceleration grows with the fourth power of their length.
#[test]
fn a_smooth_motion_takes_few_rows() {
    let trace = cycloid(1000);
    let [most_speed, most] = [TAU, 0.5 * TAU * TAU];
    let mut before = 0;
    for share in [1e-1, 1e-2, SHARE, 1e-4, 1e-5] {
        let plan = Plan::new(&trace, Domain::Turn, 0, share).unwrap();
        assert_eq!(plan.words.len(), HEADER_WORDS + 8 * plan.rows + 1);
        let error = f64::from(plan.errors.acceleration);
        assert!(error <= 1.05 * share * most, "{share}: {error}");
        // No more rows than needed, except perhaps the last one.
        assert!(error >= 0.3 * share * most, "{share}: {error}");
        assert!(f64::from(plan.errors.speed) <= share * most_speed);
        // A tenth of the error needs 10^(1/4) = 1.8 times the rows.
        let rows = plan.rows - 1;
        let grown = if before == 0 {
            1.8
        } else {
            rows as f64 / before as f64
        };
        assert!(
            (1.2..2.4).contains(&grown),
            "{share}: {rows} after {before}"
        );
        before = rows;
        let missed = (f64::from(plan.most[0]) / most_speed - 1.0).abs();
        assert!(missed < share, "{share}: {missed}");
    }
}

/// A row starts at each jump of the acceleration: three rows and an end for a trapezoid of the speed, without loss; a rest takes one.
#[test]
fn corners_and_rests_take_a_row_each() {
    let node = |t: f64, step: f64, phi: f64, omega: f64, alpha: [f64; 2]| Node {
        t,
        step,
        phi,
        omega,
        alpha,
    };
    let mut trace = Trace::new(
        Coordinate::Angle,
        vec![
            node(0.0, 0.0, 1.0, 0.0, [0.0, 8.0]),
            node(0.25, 0.25, 1.25, 2.0, [8.0, 8.0]),
            node(0.5, 0.25, 2.0, 4.0, [8.0, 0.0]),
            node(1.5, 1.0, 6.0, 4.0, [0.0, -4.0]),
            node(2.5, 1.0, 8.0, 0.0, [-4.0, 0.0]),
        ],
    );
    trace.dwell(0.5);
    let plan = Plan::new(&trace, Domain::Turn, 3, SHARE).unwrap();
    assert_eq!(plan.rows, 5);
    let errors = plan.errors;
    assert!(
        // Ten units of the coefficients of 4 rad/s², over a window of 2 s: 10·4·2⁻²⁹·2² and less.
        errors.position < 3e-7 && errors.speed < 4e-7 && errors.acceleration < 1e-6,
        "{errors:?}"
    );
    assert_eq!(plan.bytes().len(), 4 * plan.words.len());
    assert_eq!(&plan.bytes()[..4], b"JRPL");
    // The identifier of the machine.
    assert_eq!(plan.words[7], 3);
}

/// A jump that a table of equal steps would smear stays in place, even if its node is close to another.
#[test]
fn two_nodes_at_nearly_one_time_are_one() {
    let node = |t: f64, step: f64, phi: f64, omega: f64, alpha: [f64; 2]| Node {
        t,
        step,
        phi,
        omega,
        alpha,
    };
    let tiny = 1e-12;
    let trace = Trace::new(
        Coordinate::Angle,
        vec![
            node(0.0, 0.0, 0.0, 0.0, [0.0, 2.0]),
            node(1.0, 1.0, 1.0, 2.0, [2.0, 1.0]),
            node(1.0 + tiny, tiny, 1.0 + 2.0 * tiny, 2.0, [1.0, -2.0]),
            node(2.0, 1.0 - tiny, 2.0, 0.0, [-2.0, 0.0]),
        ],
    );
    let plan = Plan::new(&trace, Domain::Turn, 0, SHARE).unwrap();
    assert_eq!(plan.rows, 3);
    assert!(plan.errors.acceleration < 1e-6, "{:?}", plan.errors);
}

/// Constant speed is a single row for any accuracy, alone and between two ramps; a rest or rounding in the accelerations does not split it.
#[test]
fn constant_speed_takes_one_row() {
    for share in [1e-1, SHARE, 1e-6] {
        for noise in [0.0, 1e-13] {
            let trace = motion(1000, 10.0, |t| {
                [0.3 + 2.0 * t, 2.0, noise * (1e3 * t).sin()]
            });
            let plan = Plan::new(&trace, Domain::Turn, 0, share).unwrap();
            assert_eq!((plan.rows, plan.excess), (2, None), "{share}");
            // The position in a row of 10 s is resolved to 16 s·2⁻³².
            assert!(plan.errors.position < 2e-8, "{:?}", plan.errors);
            assert!(plan.errors.speed < 3e-7, "{:?}", plan.errors);
        }
    }
    // 2 rad/s² up and down, each for a second, with 2 rad/s for 8 s between.
    let trace = motion(1000, 10.0, |t| match t {
        ..1.0 => [t * t, 2.0 * t, 2.0],
        ..9.0 => [2.0 * t - 1.0, 2.0, 0.0],
        _ => [18.0 - (10.0 - t).powi(2), 2.0 * (10.0 - t), -2.0],
    });
    let mut nodes = trace.nodes().to_vec();
    nodes[100].alpha = [2.0, 0.0];
    nodes[900].alpha = [0.0, -2.0];
    let plan = Plan::new(
        &Trace::new(Coordinate::Angle, nodes),
        Domain::Turn,
        0,
        SHARE,
    )
    .unwrap();
    assert_eq!((plan.rows, plan.excess), (4, None));
}

/// A motion of many short steps takes few rows, even if the requested error is as small as the rounding of positions: rows have a minimum length.
#[test]
fn fine_steps_do_not_make_short_rows() {
    let plan = Plan::new(&cycloid(20_000), Domain::Turn, 0, 1e-6).unwrap();
    assert!((20..60).contains(&plan.rows), "{}", plan.rows);
    // By rounding, the 2e-5 rad/s² of the share need a row of √(6·2π·2⁻³²/2e-5) = 21 ms; the last one would have 5 ms, and is made at least half of
    // 21 ms.
    let error = f64::from(plan.errors.acceleration);
    assert!(error < 4.0 * 1e-6 * 0.5 * TAU * TAU, "{error}");
    assert!((plan.most[1] / (0.5 * TAU * TAU) as f32 - 1.0).abs() < 1e-3);
}

/// Linear speeds between given times, with constant acceleration in between.
fn steps(parts: &[(f64, f64)]) -> Trace {
    let mut nodes = vec![Node {
        t: 0.0,
        step: 0.0,
        phi: 1.0,
        omega: 0.0,
        alpha: [0.0; 2],
    }];
    for (length, alpha) in parts {
        let before = nodes.last_mut().unwrap();
        before.alpha[1] = *alpha;
        let node = Node {
            t: before.t + length,
            step: *length,
            phi: before.phi + length * (before.omega + 0.5 * alpha * length),
            omega: before.omega + alpha * length,
            alpha: [*alpha, 0.0],
        };
        nodes.push(node);
    }
    Trace::new(Coordinate::Angle, nodes)
}

/// A part between two jumps that is too short for a row is left out if its change of the speed is below the permitted error: inside, at the start, at
/// the end, and two side by side. A longer one is kept, and so is one with a larger change.
#[test]
fn slivers_between_jumps_are_left_out() {
    let tiny = 1e-6;
    let whole = [(0.5, 8.0), (1.0, 0.0), (1.0, -4.0)];
    let with = |at: usize, parts: &[(f64, f64)]| {
        let mut all = whole.to_vec();
        all.splice(at..at, parts.iter().copied());
        Plan::new(&steps(&all), Domain::Turn, 0, SHARE).unwrap()
    };
    assert_eq!(with(0, &[]).rows, 4);
    let middle = [(tiny, -3.0)];
    let two = [(tiny, -3.0), (tiny, 5.0)];
    for (at, parts, beside) in [
        (0, middle.as_slice(), 8.0),
        (1, &middle, 0.0),
        (2, &two, -4.0),
        (3, &[(tiny, 3.0)], -4.0),
    ] {
        let plan = with(at, parts);
        assert_eq!(plan.excess, None, "{parts:?} at {at}");
        assert_eq!(plan.rows, 4, "{parts:?} at {at}");
        // The missing speed is regained along the neighbouring row, of 0.5 s or more.
        let missed: f64 = parts.iter().map(|(t, a)| t * (a - beside)).sum();
        let missed = missed.abs();
        let errors = [plan.errors.speed, plan.errors.acceleration].map(f64::from);
        assert!(
            (0.5..1.1).contains(&(errors[0] / missed)),
            "{at}: {errors:?} {missed}"
        );
        assert!(errors[1] < 4.5 * missed / 0.5, "{at}: {errors:?} {missed}");
    }
    // 8e-3 rad/s² are rounding in a row of 1.05 ms; the permitted error of a speed is 4e-3 rad/s.
    assert_eq!(with(1, &[(1.2e-3, -3.0)]).rows, 5);
    let stays = with(1, &[(0.9e-3, -6.0)]);
    assert_eq!(stays.rows, 5);
    let excess = stays.excess.unwrap();
    assert_eq!(excess.quantity, MotionQuantity::Acceleration);
    assert!(excess.error > 8e-3, "{excess:?}");
    assert!(stays.errors.acceleration < 1.5 * 8e-3, "{:?}", stays.errors);
}
