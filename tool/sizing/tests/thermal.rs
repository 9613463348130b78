//! Temperature: closed forms, an independent integration, duty types, and texts about missing data.
// Zeros and copied figures are exact.
#![allow(clippy::float_cmp)]

mod drives;
mod duty_types;
mod mean;
mod relative;

use crate::brute;
use crate::support::{budget, near, within};
use jred_file::model::operation::Operation;
use jred_sizing::judge::overload;
use jred_sizing::thermal::loss_curve::{LossCurve, LossSample, PeakRise};
use jred_sizing::thermal::network::{Losses, Network, Transition, steady};

const COLD: Losses = Losses {
    copper: 0.0,
    other: 0.0,
};

/// A course of constant losses: (from (s), copper (W), other (W)).
fn steps(steps: &[(f64, f64, f64)], duration: f64) -> LossCurve {
    let ends = steps.iter().skip(1).map(|s| s.0).chain([duration]);
    let points = steps
        .iter()
        .zip(ends)
        .flat_map(|(&(t, copper, other), end)| {
            [t, end].map(|t| LossSample {
                t,
                root: copper.sqrt(),
                other,
            })
        });
    LossCurve::new(&points.collect::<Vec<_>>(), duration)
}

fn rise(course: &LossCurve, network: &Network, operation: &Operation) -> [f64; 2] {
    match course.hottest(network, operation, COLD) {
        PeakRise::Rise(rise) => rise,
        PeakRise::Runaway => panic!("runaway"),
    }
}

/// One body, constant losses from cold: θ = P·R·(1 − e^(−t/τ)).
#[test]
fn a_step_from_cold() {
    let network = Network::one(0.8, 900.0, 0.0);
    let course = steps(&[(0.0, 120.0, 15.0)], 7.0);
    for operating in [3.0, 7.0, 100.0, 3600.0, 1e5] {
        let found = rise(&course, &network, &Operation::Short { operating })[0];
        let expected = 135.0 * 0.8 * -(-operating / 900.0f64).exp_m1();
        near("rise", found, expected, budget::THERMAL);
    }
    let found = rise(&course, &network, &Operation::Continuous)[0];
    near("S1", found, 135.0 * 0.8, budget::THERMAL);
}

/// One body under a load that is on for t₁ and off for t₂: θ_max = P·R·(1 − e^(−t₁/τ))/(1 − e^(−(t₁+t₂)/τ)), with the rest in the cycle or in the
/// operation.
#[test]
fn a_rectangular_load() {
    for (on, off, tau) in [
        (1.0, 3.0, 60.0f64),
        (200.0, 100.0, 60.0),
        (0.1, 0.2, 3000.0),
    ] {
        let network = Network::one(1.5, tau, 0.0);
        let expected = 80.0 * 1.5 * (-on / tau).exp_m1() / (-(on + off) / tau).exp_m1();
        let cycle = steps(&[(0.0, 80.0, 0.0), (on, 0.0, 0.0)], on + off);
        let found = rise(&cycle, &network, &Operation::Continuous)[0];
        near("in the cycle", found, expected, budget::THERMAL);
        let cycle = steps(&[(0.0, 80.0, 0.0)], on / 4.0);
        let operation = Operation::Intermittent {
            operating: on,
            rest: off,
            holding: false,
        };
        let found = rise(&cycle, &network, &operation)[0];
        near("in the operation", found, expected, budget::THERMAL);
    }
}

/// Copper loss that grows with temperature: P·(1 + g·θ) changes the rise and its time constant, θ = R·P/(1 − g·R·P), τ′ = τ/(1 − g·R·P).
#[test]
fn growing_resistance_in_closed_form() {
    let (r, tau, growth) = (0.5, 400.0, 0.003_64);
    let network = Network::one(r, tau, growth);
    for copper in [40.0, 200.0, 500.0] {
        let course = steps(&[(0.0, copper, 0.0)], 3.0);
        let left = 1.0 - growth * r * copper;
        let end = r * copper / left;
        let found = rise(&course, &network, &Operation::Continuous)[0];
        near("steady", found, end, budget::THERMAL);
        let found = rise(&course, &network, &Operation::Short { operating: 250.0 })[0];
        let expected = end * -(-250.0 * left / tau).exp_m1();
        near("from cold", found, expected, budget::THERMAL);
    }
    // g·R·P = 1: the last watt before the runaway, and the first beyond.
    let limit = 1.0 / (growth * r);
    let at = |copper| {
        let course = steps(&[(0.0, copper, 0.0)], 3.0);
        course.hottest(&network, &Operation::Continuous, COLD)
    };
    assert!(matches!(at(0.999 * limit), PeakRise::Rise([hot, _]) if hot > 1e5));
    assert_eq!(at(1.001 * limit), PeakRise::Runaway);
    // For a limited time any motor bears it.
    let course = steps(&[(0.0, 2.0 * limit, 0.0)], 3.0);
    let found = rise(&course, &network, &Operation::Short { operating: 30.0 })[0];
    near(
        "runaway from cold",
        found,
        -(r * 2.0 * limit) * -(30.0f64 / tau).exp_m1(),
        budget::THERMAL,
    );
}

/// Two bodies at constant losses: θ_h = R_h·(P_v + Q), θ_w = θ_h + R_w·P_v with P_v = P·(1 + g·θ_w).
#[test]
fn two_bodies_at_rest() {
    let (growth, [rw, rh]) = (0.003_64, [0.3, 0.7]);
    let network = Network::two([rw, rh], [25.0, 1800.0], growth);
    let course = steps(&[(0.0, 90.0, 30.0)], 2.0);
    let [winding, housing] = rise(&course, &network, &Operation::Continuous);
    let loss = 90.0 * (1.0 + growth * winding);
    near("housing", housing, rh * (loss + 30.0), budget::THERMAL);
    near("winding", winding, housing + rw * loss, budget::THERMAL);
}

/// A network of the test: resistances, capacities, growth.
#[derive(Clone, Copy)]
struct Known {
    r: [f64; 2],
    c: [f64; 2],
    growth: f64,
}

impl Known {
    fn network(&self) -> Network {
        let times = [self.r[0] * self.c[0], self.r[1] * self.c[1]];
        Network::two(self.r, times, self.growth)
    }

    fn slope(&self, x: [f64; 2], copper: f64, other: f64) -> [f64; 2] {
        let across = (x[0] - x[1]) / self.r[0];
        [
            (copper * (1.0 + self.growth * x[0]) - across) / self.c[0],
            (across - x[1] / self.r[1] + other) / self.c[1],
        ]
    }

    /// The classical Runge-Kutta method over losses given as functions of time and of the middle of the step (which selects the side of a jump
    /// between steps); the largest rises on the way, and the last.
    fn integrate(
        &self,
        losses: impl Fn(f64, f64) -> [f64; 2],
        duration: f64,
        count: u32,
        mut x: [f64; 2],
    ) -> ([f64; 2], [f64; 2]) {
        let h = duration / f64::from(count);
        let mut most = x;
        for k in 0..count {
            let t = h * f64::from(k);
            let middle = t + 0.5 * h;
            let f = |t: f64, x: [f64; 2]| {
                let [copper, other] = losses(t, middle);
                self.slope(x, copper, other)
            };
            let step = |x: [f64; 2], k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
            let k1 = f(t, x);
            let k2 = f(t + h / 2.0, step(x, k1, h / 2.0));
            let k3 = f(t + h / 2.0, step(x, k2, h / 2.0));
            let k4 = f(t + h, step(x, k3, h));
            for i in 0..2 {
                x[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
                most[i] = most[i].max(x[i]);
            }
        }
        (most, x)
    }
}

/// Continuously changing losses, two bodies, growing copper loss: against the Runge-Kutta method over enough cycles to be periodic.
#[test]
fn two_bodies_by_another_integration() {
    let known = Known {
        r: [0.4, 0.6],
        c: [40.0, 300.0],
        growth: 0.003_64,
    };
    let duration = 20.0;
    let root = |t: f64| 6.0 + 7.0 * (std::f64::consts::TAU * t / duration).sin();
    let other = |t: f64| 12.0 - 0.4 * t;
    let losses = |t: f64| [root(t).powi(2), other(t)];
    let mut x = [0.0; 2];
    let mut most = x;
    for _ in 0..300 {
        (most, x) = known.integrate(|t, _| losses(t), duration, 4000, x);
    }
    let course = |count: u32| {
        let points = (0..=count).map(|k| {
            let t = duration * f64::from(k) / f64::from(count);
            LossSample {
                t,
                root: root(t),
                other: other(t),
            }
        });
        LossCurve::new(&points.collect::<Vec<_>>(), duration)
    };
    let found = rise(&course(2000), &known.network(), &Operation::Continuous);
    near("winding", found[0], most[0], budget::THERMAL_STEPS);
    near("housing", found[1], most[1], budget::THERMAL_STEPS);
    // The ripple matters: the mean losses alone give less.
    let mean = steady(known.r, course(2000).mean(), known.growth).unwrap();
    assert!(most[0] > 1.05 * mean[0], "{most:?} {mean:?}");
    // Second order in the steps.
    let off =
        |count| (rise(&course(count), &known.network(), &Operation::Continuous)[0] - most[0]).abs();
    within(
        "order",
        (off(50) / off(100)).log2(),
        2.0,
        budget::THERMAL_ORDER,
    );
}

/// From cold for a non-integer number of cycles, and with rests, by the same integration.
#[test]
fn operations_by_another_integration() {
    let known = Known {
        r: [0.5, 0.3],
        c: [8.0, 90.0],
        growth: 0.003_64,
    };
    let (on, duration) = (1.3, 2.0);
    let losses = |t: f64| [if t % duration < on { 140.0 } else { 10.0 }, 5.0];
    let course = steps(&[(0.0, 140.0, 5.0), (on, 10.0, 5.0)], duration);
    let count = |time: f64| (time * 1000.0).round() as u32;
    let run = |time: f64, x: [f64; 2]| known.integrate(|_, t| losses(t), time, count(time), x);
    let (most, end) = run(31.7, [0.0; 2]);
    // The housing is warmest after the run.
    let (after, _) = known.integrate(|_, _| [0.0, 0.0], 30.0, count(30.0), end);
    assert!(after[1] > 1.01 * most[1]);
    let most = [most[0], after[1]];
    let found = rise(
        &course,
        &known.network(),
        &Operation::Short { operating: 31.7 },
    );
    near("winding, S2", found[0], most[0], budget::RUNGE_KUTTA);
    near("housing, S2", found[1], most[1], budget::RUNGE_KUTTA);

    let mut x = [0.0; 2];
    let mut most = x;
    for _ in 0..60 {
        (most, x) = run(13.2, x);
        let (rest, after) = known.integrate(|_, _| [0.0, 0.0], 6.0, count(6.0), x);
        most = [most[0].max(rest[0]), most[1].max(rest[1])];
        x = after;
    }
    let operation = Operation::Intermittent {
        operating: 13.2,
        rest: 6.0,
        holding: false,
    };
    let found = rise(&course, &known.network(), &operation);
    near("winding, S3", found[0], most[0], budget::RUNGE_KUTTA);
    near("housing, S3", found[1], most[1], budget::RUNGE_KUTTA);
}

/// The housing keeps warming up after the load has ended: its hottest point is inside a piece of constant losses.
#[test]
fn the_housing_is_hottest_after_the_load() {
    let known = Known {
        r: [1.0, 2.0],
        c: [30.0, 20.0],
        growth: 0.0,
    };
    let course = steps(&[(0.0, 200.0, 0.0), (5.0, 0.0, 0.0)], 400.0);
    let losses = |t: f64| [if t < 5.0 { 200.0 } else { 0.0 }, 0.0];
    let mut x = [0.0; 2];
    let mut most = x;
    for _ in 0..8 {
        (most, x) = known.integrate(|_, t| losses(t), 400.0, 400_000, x);
    }
    let found = rise(&course, &known.network(), &Operation::Continuous);
    near("housing", found[1], most[1], budget::RUNGE_KUTTA);
    let network = known.network();
    let at_ends = course.periodic(&network).unwrap();
    let ends = at_ends.iter().fold(0.0f64, |m, (_, x)| m.max(x[1]));
    assert!(found[1] > 1.05 * ends, "{} at the ends, {}", ends, found[1]);
}

/// A cycle that is short compared with the time constants: its temperature is that of its mean losses, without loss of digits in the many small
/// steps.
#[test]
fn short_cycles_lose_no_digits() {
    let (resistances, growth) = ([0.3, 0.7], 0.003_64);
    let network = Network::two(resistances, [30.0, 3600.0], growth);
    let points = (0..=2000).map(|k| {
        let t = 1e-3 * f64::from(k) / 2000.0;
        LossSample {
            t,
            root: 9.0,
            other: 4.0,
        }
    });
    let course = LossCurve::new(&points.collect::<Vec<_>>(), 1e-3);
    let found = rise(&course, &network, &Operation::Continuous);
    let expected = steady(resistances, course.mean(), growth).unwrap();
    near("winding", found[0], expected[0], budget::MANY_STEPS);
    near("housing", found[1], expected[1], budget::MANY_STEPS);
}

/// I²t of a rectangular load: on for t₁ at I₁ it fills by (I₁² − I_r²)·t₁, and empties while the current is low.
#[test]
fn the_overload_integral() {
    let cycle = |high: f64, on: f64, low: f64, duration: f64| {
        vec![[0.0, high], [on, high], [on, low], [duration, low]]
    };
    let found = overload::largest(&cycle(9.0, 0.2, 1.0, 2.0), 2.0, 5.0);
    near("rectangle", found, (81.0 - 25.0) * 0.2, budget::OVERLOAD);
    // The sign does not matter.
    let found = overload::largest(&cycle(-9.0, 0.2, 1.0, 2.0), 2.0, 5.0);
    near("negative", found, (81.0 - 25.0) * 0.2, budget::OVERLOAD);
    // Two loads, the second before the first has decayed, across the end of the cycle.
    let points = vec![
        [0.0, 8.0],
        [0.5, 8.0],
        [0.5, 0.0],
        [4.0, 0.0],
        [4.0, -8.0],
        [4.8, -8.0],
        [4.8, 2.0],
        [5.0, 2.0],
    ];
    let found = overload::largest(&points, 5.0, 5.0);
    let expected = 39.0 * 0.8 + (4.0 - 25.0) * 0.2 + 39.0 * 0.5;
    near("across the end", found, expected, budget::OVERLOAD);
    // A ramp from −a to a exceeds the rated current at both ends: ∫(I² − I_r²) from I_r to a is (a³/3 − I_r²·a + 2/3·I_r³)/slope.
    let (a, rated) = (6.0f64, 4.0f64);
    let ramp = vec![[0.0, -a], [3.0, a], [3.0, 0.0], [9.0, 0.0]];
    let found = overload::largest(&ramp, 9.0, rated);
    let expected =
        (a.powi(3) / 3.0 - rated * rated * a + 2.0 / 3.0 * rated.powi(3)) / (2.0 * a / 3.0);
    near("ramp", found, expected, budget::OVERLOAD);
    // Never above the rated current, and more than it bears endlessly.
    assert_eq!(overload::largest(&cycle(5.0, 0.2, 1.0, 2.0), 2.0, 5.0), 0.0);
    assert_eq!(
        overload::largest(&cycle(9.0, 1.9, 1.0, 2.0), 2.0, 5.0),
        f64::INFINITY
    );
    near(
        "allowed",
        overload::allowed(5.0, 15.0, 3.0),
        600.0,
        budget::OVERLOAD,
    );
}

#[test]
fn bodies_and_their_times() {
    let one = Network::one(0.5, 400.0, 0.0);
    assert!(!one.has_housing());
    near("one", one.fastest(), 400.0, 1e-15);
    near("one", one.slowest(), 400.0, 1e-15);
    // With thermal resistances 0.3 and 0.7 K/W and time constants 60 and 1400 s: capacities of 200 and 2000 J/K.
    let two = Network::two([0.3, 0.7], [60.0, 1400.0], 0.0);
    assert!(two.has_housing());
    near("two", two.fastest(), 60.0, 1e-12);
    near("two", two.slowest(), 200.0 + 1400.0, 1e-12);
}

/// A change of zero has no rise of its own.
#[test]
fn a_change_of_nothing_has_no_rise_of_its_own() {
    assert_eq!(Transition::default().periodic(), None);
}

/// A ramp of the current or of another loss, long compared with the winding's time constant, heats like the same ramp in a thousand pieces.
#[test]
fn a_ramp_is_followed() {
    let network = Network::one(0.5, 4.0, 0.0);
    let course = |pieces: u32, roots: [f64; 2], others: [f64; 2]| {
        let points = (0..=pieces).map(|k| {
            let share = f64::from(k) / f64::from(pieces);
            let at = |[from, to]: [f64; 2]| from + (to - from) * share;
            LossSample {
                t: 100.0 * share,
                root: at(roots),
                other: at(others),
            }
        });
        LossCurve::new(&points.collect::<Vec<_>>(), 100.0)
    };
    for (roots, others) in [
        ([0.0, 10.0], [20.0, 20.0]),
        ([5.0, 5.0], [0.0, 100.0]),
        ([0.0, 10.0], [0.0, 100.0]),
    ] {
        let [coarse, fine] = [1, 1000].map(|pieces| {
            let course = course(pieces, roots, others);
            rise(&course, &network, &Operation::Continuous)[0]
        });
        near("rise", coarse, fine, 1e-3);
        // The mean of the losses would give less.
        assert!(fine > 40.0, "{fine}");
    }
}
