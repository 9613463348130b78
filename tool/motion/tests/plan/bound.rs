//! The stated errors of a plan bound the errors of firmware.

use std::f64::consts::TAU;

use jred::axis::Plan as Read;
use jred::table::{Constants, Shape, Table};
use jred::{Domain, Model, Scale, Spline, curves};
use jred_analysis::checked;
use jred_file::model::coordinate::Coordinate;
use jred_motion::fastest::{MoveLimits, Task, solve};
use jred_motion::path_dynamics::Actuator;
use jred_motion::plan::{Plan, SHARE};
use jred_motion::trace::{Node, Trace};
use jred_sizing::catalogue::Motor;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;

use super::cycloid;
use crate::support::press_text;

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

/// The largest errors of firmware at random times: its integer arithmetic against the motion.
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

/// The errors in the header are upper bounds, and close ones: cycloids of few and many steps, steps with random bends, and the fastest stroke of a
/// press. Errors beyond the requested one are reported.
#[test]
fn what_is_stated_is_a_bound() {
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
    let press = checked::parse("press.toml", &press_text(), none).unwrap();
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
            limits: MoveLimits::default(),
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
            // Many steps reach that accuracy.
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
