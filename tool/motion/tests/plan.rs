//! A motion as a plan that firmware follows.

use std::f64::consts::TAU;

use jred::axis::Plan as Read;
use jred::axis::plan::{HEADER_WORDS, PlanError};
use jred::table::{Constants, Shape};
use jred::{Domain, Model, Scale, Spline, Table, curves};
use jred_machine::model::coordinate::Coordinate;
use jred_machine::read;
use jred_motion::fastest::{Limits, Task, solve};
use jred_motion::plan::{Plan, Quantity, SHARE};
use jred_motion::trace::{Node, Trace};
use jred_motion::way::Actuator;
use jred_sizing::catalogue::Motor;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;

use crate::support::press_text;

/// A motion of nodes at equal times.
fn motion(count: usize, length: f64, state: impl Fn(f64) -> [f64; 3]) -> Trace {
    let step = length / count as f64;
    let node = |k: usize| {
        let t = k as f64 * step;
        let [phi, omega, alpha] = state(t);
        Node {
            t,
            step: if k == 0 { 0.0 } else { step },
            phi,
            omega,
            alpha: [alpha; 2],
        }
    };
    Trace::new(Coordinate::Angle, (0..=count).map(node).collect())
}

/// A cycloidal move of half a turn in a second, in a thousand steps.
fn cycloid() -> Trace {
    let (way, angle) = (0.5 * TAU, TAU);
    motion(1000, 1.0, |t| {
        [
            way * (t - (angle * t).sin() / angle),
            way * (1.0 - (angle * t).cos()),
            way * angle * (angle * t).sin(),
        ]
    })
}

/// As few rows as keep it: half of the error takes about the fifth root more rows, as the fourth power of their length is what the acceleration is off by.
#[test]
fn a_smooth_motion_takes_few_rows() {
    let trace = cycloid();
    let [most_speed, most] = [TAU, 0.5 * TAU * TAU];
    let mut before = 0;
    for share in [1e-1, 1e-2, SHARE, 1e-4, 1e-5] {
        let plan = Plan::new(&trace, Domain::Turn, 0, share).unwrap();
        assert_eq!(plan.words.len(), HEADER_WORDS + 8 * plan.rows + 1);
        let error = f64::from(plan.errors.acceleration);
        assert!(error <= 1.05 * share * most, "{share}: {error}");
        // Not a row more than needed, give or take the last one.
        assert!(error >= 0.3 * share * most, "{share}: {error}");
        assert!(f64::from(plan.errors.speed) <= share * most_speed);
        // Four times as many rows are off by a 4⁻⁴th.
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

/// Where the acceleration jumps a row begins: three rows and an end for a trapezoid of the speed, nothing lost; and a rest takes one.
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

/// A jump within a motion that a table of equal steps would smear is where it was, however near its node is to another.
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

/// Constant speed is a row however exact the plan, alone and between two ramps; a rest and rounding in the accelerations do not cut it.
#[test]
fn constant_speed_takes_one_row() {
    for share in [1e-1, SHARE, 1e-6] {
        for noise in [0.0, 1e-13] {
            let trace = motion(1000, 10.0, |t| {
                [0.3 + 2.0 * t, 2.0, noise * (1e3 * t).sin()]
            });
            let plan = Plan::new(&trace, Domain::Turn, 0, share).unwrap();
            assert_eq!((plan.rows, plan.excess), (2, None), "{share}");
            // The place in a row of 10 s is known to 16 s·2⁻³².
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

/// A motion of many short steps takes few rows also where the error asked for is as small as the rounding of positions: rows are not shorter than that allows.
#[test]
fn fine_steps_do_not_make_short_rows() {
    let (way, angle) = (0.5 * TAU, TAU);
    let trace = motion(20_000, 1.0, |t| {
        [
            way * (t - (angle * t).sin() / angle),
            way * (1.0 - (angle * t).cos()),
            way * angle * (angle * t).sin(),
        ]
    });
    let plan = Plan::new(&trace, Domain::Turn, 0, 1e-6).unwrap();
    assert!((20..60).contains(&plan.rows), "{}", plan.rows);
    // Rounding takes the 2e-5 rad/s² of the share in a row of √(6·2π·2⁻³²/2e-5) = 21 ms; the last one would have 5 ms, and has at least half of 21 ms.
    let error = f64::from(plan.errors.acceleration);
    assert!(error < 4.0 * 1e-6 * 0.5 * TAU * TAU, "{error}");
    assert!((plan.most[1] / (0.5 * TAU * TAU) as f32 - 1.0).abs() < 1e-3);
}

/// A plan says which of its three is off more than it may be, where and by how much.
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
    assert_eq!(excess.quantity, Quantity::Speed);
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

/// A motion on a stroke that turns at its end, between two of its nodes, and one that is beyond it there.
#[test]
fn the_stroke_is_kept() {
    let domain = Domain::stroke(0.0, 0.5).unwrap();
    // Up to x = 0.5 − more and back, with −1 m/s² in the middle and a jerk that changes: (1 − cos 2πt)/4.
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
        Plan::new(&cycloid(), outside, 0, SHARE),
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
    // 97 days and more are not counted.
    let long = motion(10, 1e7, |t| [t, 1.0, 0.0]);
    assert_eq!(
        Plan::new(&long, Domain::Turn, 0, SHARE),
        Err(PlanError::Order(0))
    );
}

/// Speeds that change evenly from one time to the next: what the acceleration is between them.
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

/// What lies between two jumps, and is too short for a row, is left out if it changes the speed by less than that may be off: within, at the start, at the end, and two of them side
/// by side. A longer one stays, and one that changes the speed by more.
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
        // The speed that is missed comes back along the neighbouring row, of 0.5 s or more.
        let missed: f64 = parts.iter().map(|(t, a)| t * (a - beside)).sum();
        let missed = missed.abs();
        let errors = [plan.errors.speed, plan.errors.acceleration].map(f64::from);
        assert!(
            (0.5..1.1).contains(&(errors[0] / missed)),
            "{at}: {errors:?} {missed}"
        );
        assert!(errors[1] < 4.5 * missed / 0.5, "{at}: {errors:?} {missed}");
    }
    // 8e-3 rad/s² are rounding in a row of 1.05 ms; a speed may be off by 4e-3 rad/s.
    assert_eq!(with(1, &[(1.2e-3, -3.0)]).rows, 5);
    let stays = with(1, &[(0.9e-3, -6.0)]);
    assert_eq!(stays.rows, 5);
    let excess = stays.excess.unwrap();
    assert_eq!(excess.quantity, Quantity::Acceleration);
    assert!(excess.error > 8e-3, "{excess:?}");
    assert!(stays.errors.acceleration < 1.5 * 8e-3, "{:?}", stays.errors);
}

/// Numbers from 0 to 1, the same each time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// What firmware is off by the most, at random times: its integers beside the motion.
fn found(plan: &Plan, trace: &Trace, times: usize) -> [f64; 3] {
    let table = [1.0 / 6.0; 7];
    let shape = Shape::<Spline<f64>> {
        set: curves::INERTIA,
        cells: 4,
        domain: Domain::Turn,
        scale: Scale::SI,
        constants: Constants::default(),
    };
    let model = Model::<_, { curves::INERTIA }>::new(Table::new(&table, shape).unwrap()).unwrap();
    let read = Read::new(&plan.words, &model).unwrap();
    let mut random = Random(11);
    let mut most = [0.0_f64; 3];
    for _ in 0..times {
        let time = (random.next() * read.end() as f64) as u64;
        let place = read.at(time).value;
        let turned =
            f64::from(place.turns) + f64::from(place.motion.phase.to_bits()) / 4_294_967_296.0;
        let exact = trace.at(time as f64 / 1_099_511_627_776.0);
        let errors = [
            turned * TAU - exact.phi,
            place.motion.omega - exact.omega,
            place.motion.alpha - exact.alpha,
        ];
        for (most, error) in most.iter_mut().zip(errors) {
            *most = most.max(error.abs());
        }
    }
    most
}

/// Nowhere is firmware off by more than the header says, and by little less somewhere: cycloids of few and many steps, steps that bend at random, and the fastest stroke of a press. Where
/// that is more than was asked it is said.
#[test]
fn what_is_stated_is_a_bound() {
    let (way, angle) = (0.5 * TAU, TAU);
    let cycloid = |count| {
        motion(count, 1.0, |t| {
            [
                way * (t - (angle * t).sin() / angle),
                way * (1.0 - (angle * t).cos()),
                way * angle * (angle * t).sin(),
            ]
        })
    };
    let mut random = Random(3);
    let mut walk = |count: usize| {
        let mut nodes = vec![Node {
            t: 0.0,
            step: 0.0,
            phi: 1.0,
            omega: 0.0,
            alpha: [0.0; 2],
        }];
        for _ in 0..count {
            let before = nodes[nodes.len() - 1];
            let step = 0.001 + 0.05 * random.next();
            let alpha = before.alpha[1] + 2.0 * (random.next() - 0.5);
            let missed = 1e-4 * (random.next() - 0.5);
            let [a, b] = [before.alpha[1] * step, alpha * step];
            nodes.push(Node {
                t: before.t + step,
                step,
                phi: before.phi + step * (before.omega + a / 3.0 + b / 6.0 + 0.5 * missed),
                omega: before.omega + 0.5 * (a + b) + missed,
                alpha: [alpha; 2],
            });
        }
        Trace::new(Coordinate::Angle, nodes)
    };
    let none = std::collections::BTreeMap::<String, String>::new();
    let press = read::parse("press.toml", &press_text(), none).unwrap();
    let stroke = |torque: f64| {
        let motor = Motor {
            peak_curve: vec![[0.0, torque], [30.0 * TAU / 2.0, torque]],
            ..Motor::default()
        };
        let actuator = Actuator {
            coefficients: Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]),
            ratio: 1.0,
            envelope: Envelope::of(&motor),
        };
        let task = Task {
            from: 0.5 * TAU,
            to: 1.5 * TAU,
            speeds: [0.0; 2],
            limits: Limits::default(),
            endless: false,
        };
        solve(&press, &actuator, &task).unwrap().trace
    };
    let traces = [
        cycloid(7),
        cycloid(50),
        cycloid(1000),
        walk(40),
        walk(400),
        stroke(25.0),
        stroke(120.0),
    ];
    for (k, trace) in traces.iter().enumerate() {
        for share in [1e-1, 1e-2, SHARE, 1e-4, 1e-5, 1e-6] {
            let plan = Plan::new(trace, Domain::Turn, 0, share).unwrap();
            let errors = [
                plan.errors.position,
                plan.errors.speed,
                plan.errors.acceleration,
            ];
            let errors = errors.map(f64::from);
            let found = found(&plan, trace, 20_000);
            let accelerations = trace.nodes().iter().flat_map(|node| node.alpha);
            let most = accelerations.fold(0.0_f64, |most, alpha| most.max(alpha.abs()));
            if errors[2] > 1.000_001 * share * most {
                assert!(plan.excess.is_some(), "{k} {share}: {errors:?}");
            }
            // Many steps are as exact as that.
            assert!(share < 1e-4 || ![2, 5, 6].contains(&k) || plan.excess.is_none());
            for (found, stated) in found.into_iter().zip(errors) {
                assert!(found <= stated, "{k} {share}: {found} {stated}");
            }
            // Rounding is a bound, not a value.
            assert!(
                share < 1e-5 || found[2] > 0.5 * errors[2],
                "{k} {share}: {found:?} {errors:?}"
            );
        }
    }
}
