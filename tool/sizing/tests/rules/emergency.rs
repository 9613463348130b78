//! The emergency stop: the hull against every state, the formula against the equations of motion.

use jred_analysis::duty::Duty;
use jred_analysis::duty::mechanics::{Braking, Stop};
use jred_file::model::rule::Rule;
use proptest::prelude::*;

use super::{Stand, budget, near, within};
use jred_report::list::rule_words::note;

/// Torque through the gearbox by elimination from the equations of the two bodies, solved as a linear system in the
/// torque and the deceleration.
fn torque_by_cramer(braking: &Braking, [inertia, driving]: [f64; 2]) -> f64 {
    // τ − J·a = d;  τ·η/i + J_1·i·a = T
    let (a11, a12, b1) = (1.0, -inertia, driving);
    let (a21, a22, b2) = (
        braking.back_efficiency / braking.ratio,
        braking.inertia * braking.ratio,
        braking.torque,
    );
    (b1 * a22 - a12 * b2) / (a11 * a22 - a12 * a21)
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(5), ..ProptestConfig::default() })]

    /// The worst state found by bisection along the hull is the worst of all.
    #[test]
    fn the_hull_holds_the_worst_state(
        states in prop::collection::vec((0.01f64..2.0, -50.0f64..50.0), 1..60),
        torque in 1.0f64..60.0, inertia in 1e-4f64..0.01, ratio in 1.0f64..50.0, back in 0.3f64..1.0,
    ) {
        // With constant inertia and load the states of a motion differ by roundings.
        let near = |x: f64, k: u32| x * (1.0 + f64::from(k % 3) * f64::EPSILON);
        let states: Vec<[f64; 2]> = (states.into_iter())
            .flat_map(|(j, d)| (0..9).map(move |k| [near(j, k), near(d, k / 3)]))
            .collect();
        let braking = Braking { torque, inertia, ratio, back_efficiency: back };
        let brute = states.iter().map(|s| braking.torque_at(*s)).fold(f64::NEG_INFINITY, f64::max);
        let [found, _] = Stop::among(states).worst(&braking).unwrap();
        prop_assert!((found - brute).abs() <= budget::SAME_SUMS * brute.abs().max(1.0), "{found} {brute}");
    }

    /// The torque satisfies both equations of motion.
    #[test]
    fn the_torque_moves_both_bodies(
        load in 0.01f64..2.0, driving in -50.0f64..50.0,
        torque in 1.0f64..60.0, inertia in 1e-4f64..0.01, ratio in 1.0f64..50.0, back in 0.3f64..1.0,
    ) {
        let braking = Braking { torque, inertia, ratio, back_efficiency: back };
        let by_system = torque_by_cramer(&braking, [load, driving]);
        let found = braking.torque_at([load, driving]);
        prop_assert!((found - by_system).abs() <= budget::SAME_SUMS * (torque * ratio + driving.abs()), "{found} {by_system}");
    }
}

/// Without a rotor the whole motor torque passes the gearbox; without machine inertia none does.
#[test]
fn the_share_of_the_rotor() {
    let braking = |inertia: f64| Braking {
        torque: 10.0,
        inertia,
        ratio: 4.0,
        back_efficiency: 0.9,
    };
    near(
        "no rotor",
        braking(0.0).torque_at([0.3, 0.0]),
        40.0 / 0.9,
        1e-14,
    );
    within(
        "no machine",
        braking(0.01).torque_at([0.0, 0.0]),
        0.0,
        1e-14,
    );
    // Equal inertias without losses: one half each.
    let lossless = Braking {
        back_efficiency: 1.0,
        ..braking(0.01)
    };
    near("halves", lossless.torque_at([0.16, 0.0]), 20.0, 1e-14);
}

/// A self-locking gearbox of the catalogue, with a back efficiency of zero, passes no work of the machine on to the motor, so the motor brakes only
/// its rotor: T·i·φ = ½·J_1·(i·ω)². On this way the gearbox does the work on the machine: τ·φ = ½·J·ω² + d·φ. So τ = T·J/(J_1·i) + d, at any speed.
#[test]
fn no_torque_flows_back() {
    let locked = Braking {
        torque: 10.0,
        inertia: 0.002,
        ratio: 30.0,
        back_efficiency: 0.0,
    };
    for (inertia, driving, speed) in [(0.3, 0.0, 2.0), (5.0, 40.0, 0.1), (0.01, -20.0, 9.0)] {
        let rotor = locked.ratio * speed;
        let way = 0.5 * locked.inertia * rotor * rotor / (locked.torque * locked.ratio);
        let torque = (0.5 * inertia * speed * speed + driving * way) / way;
        near(
            "torque",
            locked.torque_at([inertia, driving]),
            torque,
            1e-14,
        );
    }
    // Friction that takes more than the whole torque holds the rotor back too: without end from J_1·i² = 0.1·J, J = 18 kg m², on.
    let friction = Braking {
        back_efficiency: -0.1,
        ..locked
    };
    assert!(friction.torque_at([17.9, 0.0]).is_finite());
    assert!(friction.torque_at([18.1, 0.0]).is_infinite());
}

/// The press with a dense set of instants, each at full speed and at standstill.
#[test]
fn the_press_stops() {
    let mut stand = Stand::press();
    stand.motor.friction = [0.2, 0.0];
    let motion = stand.file.motion.as_ref().unwrap();
    let fine = Duty::new(&stand.file, motion, 300_000).unwrap();
    for (back, brake) in [(0.95, None), (0.5, None), (0.95, Some(55.0))] {
        stand.gearbox.back_efficiency = back;
        stand.motor.brake = None;
        if let Some(torque) = brake {
            stand.brake(torque);
        }
        let ratio = 5.0;
        let own = 8e-4 + 0.8e-4;
        let pull = brake.unwrap_or(30.0) + 0.2;
        let mut worst = f64::NEG_INFINITY;
        for instant in fine.instants.iter().filter(|i| i.omega != 0.0) {
            let all = instant.terms.total() - instant.terms.acceleration;
            let slow = all - instant.terms.velocity - instant.terms.viscous;
            for torque in [all, slow] {
                let resists = torque * instant.omega.signum() / 3.0;
                let load = instant.input_inertia;
                // Deceleration of the whole at the output, then the torque for it.
                let sum = load + own * ratio * ratio / back;
                let deceleration = (pull * ratio / back + resists) / sum;
                worst = worst.max(load * deceleration - resists);
            }
        }
        let found = stand.found(true, Rule::GearboxEmergency);
        near("emergency torque", found.value, worst, budget::DUTY);
        assert_eq!(found.rating, 160.0);
    }
    // A locking gearbox with a rotor too light to drag it: rigid bodies have no solution.
    stand.gearbox.back_efficiency = 2.0 - 1.0 / 0.1;
    assert!(!stand.found(true, Rule::GearboxEmergency).is_known());
    let check = stand.check(true, &stand.file.rules, Rule::GearboxEmergency);
    assert!(note(&check).contains("self-locking"), "{}", note(&check));
    // One that does not lock under inertia lacks the peak torque of the motor.
    stand.gearbox.back_efficiency = 0.0;
    stand.motor.peak_torque = None;
    let check = stand.check(true, &stand.file.rules, Rule::GearboxEmergency);
    let words = "no data: peak torque of the motor";
    assert_eq!(note(&check), words);
    stand.gearbox.back_efficiency = 0.9;
    stand.gearbox.emergency_torque = None;
    assert!(!stand.found(true, Rule::GearboxEmergency).is_known());
    assert!(
        stand
            .finding(false, &stand.file.rules, Rule::GearboxEmergency)
            .is_none()
    );
}

/// Friction of the motor also brakes: all of it at the largest speed, c + b·n.
#[test]
fn viscous_friction_of_the_motor_stops_too() {
    let mut stand = Stand::press();
    let with = |stand: &mut Stand, friction: [f64; 2]| {
        stand.motor.friction = friction;
        stand.found(true, Rule::GearboxEmergency).value
    };
    let plain = with(&mut stand, [0.2, 0.0]);
    let fastest = stand
        .duty
        .instants
        .iter()
        .map(|i| i.input_speed.abs())
        .fold(0.0, f64::max);
    let viscous = 0.5 / (5.0 * fastest);
    let both = with(&mut stand, [0.2, viscous]);
    let coulomb = with(&mut stand, [0.7, 0.0]);
    near("friction", both, coulomb, budget::SAME_SUMS);
    assert!(both > plain * 1.001, "{both} {plain}");
}
