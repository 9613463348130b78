//! The motion in fixed steps: its energy over a hundred thousand turns, its order, closed forms, and friction.
// Bit-exact results are compared bit by bit.
#![allow(clippy::float_cmp)]

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::support::machines::Spec;
use crate::support::{assert_near, budget};
use jred::Domain;
use jred::machine::{FreeMotion, PoseError, Reducible, Reduction};

/// A rotor: J, U and the loads as functions of φ.
struct Rotor<F>(F);

impl<F: Fn(f64) -> Reduction> Reducible for Rotor<F> {
    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        Ok((self.0)(phi))
    }
}

/// J = 2 + 0.8·cos 2φ, U = 5·sin φ.
fn uneven(phi: f64) -> Reduction {
    let (sin, cos) = (2.0 * phi).sin_cos();
    Reduction::new([2.0 + 0.8 * cos, -1.6 * sin, -3.2 * cos])
        .with_potential_energy([5.0 * phi.sin(), 5.0 * phi.cos()])
}

/// Time for a turn of the uneven rotor at the energy `energy`: ∮ dφ/ω, exact to rounding by the rectangle rule.
fn period(energy: f64) -> f64 {
    let parts = 4096;
    let place = |k: i32| TAU * f64::from(k) / f64::from(parts);
    let slowness = |phi: f64| {
        let here = uneven(phi);
        (0.5 * here.inertia / (energy - here.potential_energy)).sqrt()
    };
    (0..parts).map(|k| slowness(place(k))).sum::<f64>() * TAU / f64::from(parts)
}

/// Without torques the energy of the state is bit-exact over a hundred thousand turns, and speed and position match it. Where turns are counted by
/// time, the method's error is the same after the last as after the first.
#[test]
fn a_hundred_thousand_turns_without_a_torque_keep_the_energy() {
    let rotor = Rotor(uneven);
    let mut motion = FreeMotion::new(&rotor, 0.0, 10.0).unwrap();
    let energy = motion.energy();
    let turn = period(energy);
    let step = turn / 12.0;
    let turns = |phi: f64, steps: u32| phi / TAU - f64::from(steps) / 12.0;
    let mut early = 0.0;
    let steps = 1_200_000;
    for k in 1..=steps {
        motion.advance(&rotor, 0.0, step).unwrap();
        if k == 12_000 {
            early = turns(motion.phi(), k) / 1000.0;
        }
    }
    assert_eq!(motion.energy(), energy);
    let here = uneven(motion.phi());
    let found = 0.5 * here.inertia * motion.omega().powi(2) + here.potential_energy;
    assert_near(
        "energy of the speed",
        found,
        energy,
        4.0 * f64::EPSILON * energy,
    );
    let late = turns(motion.phi(), steps) / 1e5;
    assert!(early.abs() < 0.02 && early != 0.0, "{early} of a turn");
    assert_near("lag of a turn", late, early, budget::FREE_MOTION_LAG);
}

/// Half the step, a quarter of the error of the position after ten turns.
#[test]
fn the_order_is_two() {
    let rotor = Rotor(uneven);
    let error = |parts: u32| {
        let mut motion = FreeMotion::new(&rotor, 0.3, 8.0).unwrap();
        let time = 10.0 * period(motion.energy());
        for _ in 0..10 * parts {
            motion
                .advance(&rotor, 0.0, time / f64::from(10 * parts))
                .unwrap();
        }
        (motion.phi() - 0.3 - 10.0 * TAU).abs()
    };
    let errors = [64, 128, 256].map(error);
    for pair in errors.windows(2) {
        assert_near("ratio", pair[0] / pair[1], 4.0, budget::ORDER_SHARE * 4.0);
    }
}

/// A pendulum swings through its turning points with the period of the complete elliptic integral, and keeps its energy.
#[test]
fn a_pendulum_swings() {
    let (inertia, moment) = (0.7, 3.0);
    let rotor = Rotor(|phi: f64| {
        Reduction::new([inertia, 0.0, 0.0])
            .with_potential_energy([-moment * phi.cos(), moment * phi.sin()])
    });
    let largest = 1.2f64;
    // K(k) by the arithmetic-geometric mean: π/(2·agm(1, cos(φ₀/2))).
    let (mut a, mut b) = (1.0, (0.5 * largest).cos());
    for _ in 0..20 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let period = 4.0 * FRAC_PI_2 / a * (inertia / moment).sqrt();
    let mut motion = FreeMotion::new(&rotor, largest, 0.0).unwrap();
    let energy = motion.energy();
    let parts = 20_000;
    for _ in 0..5 * parts {
        motion
            .advance(&rotor, 0.0, period / f64::from(parts))
            .unwrap();
    }
    assert_eq!(motion.energy(), energy);
    assert_near(
        "after five swings",
        motion.phi(),
        largest,
        budget::FREE_MOTION,
    );
}

/// Torque against viscous friction: ω = T/b·(1 − e^(−b·t/J)); its energy is the work minus the losses.
#[test]
fn a_torque_against_viscous_friction() {
    let rotor = Rotor(|_| Reduction::new([0.5, 0.0, 0.0]).with_viscous(0.8));
    let mut motion = FreeMotion::new(&rotor, 0.0, 0.0).unwrap();
    let steps = 20_000;
    for _ in 0..steps {
        motion.advance(&rotor, 6.0, 2.0 / f64::from(steps)).unwrap();
    }
    let fading = 1.0 - (-0.8f64 * 2.0 / 0.5).exp();
    let omega = 6.0 / 0.8 * fading;
    let phi = 6.0 / 0.8 * (2.0 - 0.5 / 0.8 * fading);
    assert_near("omega", motion.omega(), omega, budget::FREE_MOTION * omega);
    assert_near("phi", motion.phi(), phi, budget::FREE_MOTION * phi);
}

/// Coasting under Coulomb friction ends at rest after J·ω₀²/(2·c), and friction holds against smaller torques.
#[test]
fn friction_stops_and_holds() {
    let (inertia, friction) = (0.5, 2.0);
    let rotor = Rotor(|_| Reduction::new([inertia, 0.0, 0.0]).with_coulomb(friction));
    for sign in [1.0, -1.0] {
        let mut motion = FreeMotion::new(&rotor, 0.0, 3.0 * sign).unwrap();
        let mut time = 0.0;
        while motion.omega() != 0.0 {
            motion.advance(&rotor, 0.0, 0.013).unwrap();
            time += 0.013;
            assert!(time < 1.0);
        }
        let way = sign * 0.5 * inertia * 9.0 / friction;
        assert_near("way", motion.phi(), way, budget::FREE_MOTION);
        assert!((0.75..0.75 + 0.013).contains(&time), "{time} s");
        for torque in [1.99, -1.99] {
            motion.advance(&rotor, torque, 0.1).unwrap();
            assert_eq!(motion.omega(), 0.0);
            assert_near("held", motion.phi(), way, budget::FREE_MOTION);
        }
        motion.advance(&rotor, 3.0 * sign, 0.1).unwrap();
        assert_near(
            "breakaway",
            motion.omega(),
            sign * 0.1 / inertia,
            budget::FREE_MOTION,
        );
    }
}

/// A whole machine with weight and process loads: the energy changes by the work of torque and loads, for which the mean of both ends is also of
/// order 2.
#[test]
fn a_press_does_the_work_that_is_put_into_it() {
    let spec = Spec {
        crank: 0.05,
        rod_ratio: 3.0,
        offset_ratio: 0.2,
        left: false,
        mass: [1.0, 0.8, 3.0],
        com: [0.3, 0.1, 0.8, 0.0],
        down: 0.7,
        loads: [40.0, 10.0, 5.0, 0.05],
        flywheel: 2.0,
    };
    let machine = spec.machine();
    let error = |parts: u32| {
        let mut motion = FreeMotion::new(&machine, 0.4, 20.0).unwrap();
        let (mut works, before) = (0.0, motion.energy());
        for _ in 0..parts {
            let from = motion.phi();
            motion
                .advance(&machine, 5.0, 0.5 / f64::from(parts))
                .unwrap();
            let way = motion.phi() - from;
            let middle = machine.reduction(from + 0.5 * way).unwrap();
            let omega = way * f64::from(parts) / 0.5;
            works += (5.0 + middle.process - middle.viscous * omega - middle.coulomb) * way;
        }
        (motion.energy() - before - works).abs() / before.abs()
    };
    let [coarse, fine] = [2000, 4000].map(error);
    assert!(coarse < 1e-3, "{coarse:e}");
    assert_near("ratio", coarse / fine, 4.0, budget::ORDER_SHARE * 4.0);
}

/// Invalid steps are refused, and the state is unchanged.
#[test]
fn bad_steps_are_refused() {
    let rotor = Rotor(uneven);
    let start = FreeMotion::new(&rotor, 0.0, 10.0).unwrap();
    for (torque, step) in [
        (f64::NAN, 1e-3),
        (0.0, f64::NAN),
        (0.0, 0.0),
        (0.0, f64::INFINITY),
        (f64::INFINITY, 1e-3),
    ] {
        let mut motion = start;
        let error = motion.advance(&rotor, torque, step).unwrap_err();
        let what = if torque.is_finite() { "step" } else { "torque" };
        assert!(error.to_string().contains(what), "{error}");
        assert_eq!(motion, start);
    }
}
