//! The contact force of a cam, and the speed at which it becomes zero.

use jred::machine::MachineError;
use std::f64::consts::{PI, TAU};

use crate::support::cams::{cam, eccentric};
use crate::support::{assert_near, budget, config};
use jred::Domain;
use jred::machine::{Action, Element, Link, Load, Machine, Marker, Window};
use jred::mechanism::cam::{LiftOff, Piece, contact_force, lift_off};
use jred::mechanism::{DiscCam, Follower};
use proptest::prelude::*;

const MASS: f64 = 0.8;
const E: f64 = 0.01;

/// A flat face on an eccentric circle, guided without offset; only the follower has mass.
fn eccentric_machine(stiffness: f64, preload: f64) -> Machine<DiscCam> {
    let links = [Link::rotor(0.01).unwrap(), Link::point_mass(MASS).unwrap()];
    let face = Follower::TranslatingFace { offset: 0.0 };
    let mechanism = DiscCam::new(eccentric(E), 0.03, face, links).unwrap();
    let spring = mechanism.closing_spring(stiffness, preload).unwrap();
    Machine::new(mechanism).with_element(spring).unwrap()
}

fn limit(machine: &Machine<DiscCam>, direction: f64) -> Option<LiftOff> {
    let pieces = machine.mechanism().program().pieces();
    lift_off(machine, DiscCam::CONTACT, pieces, direction).unwrap()
}

fn force(machine: &Machine<DiscCam>, phi: f64, omega: f64, alpha: f64) -> f64 {
    contact_force(machine, DiscCam::CONTACT, phi, omega, alpha).unwrap()
}

/// N = F₀ + k·s + m·g + m·(s″·ω² + s′·α) with s = e·(1 − cos φ): it becomes zero first at the top, φ = 180°, at ω² = (F₀ + 2·k·e + m·g)/(m·e).
#[test]
fn lift_off_of_a_circular_cam() {
    let (k, preload, g) = (4e3, 60.0, 9.81);
    let machine = eccentric_machine(k, preload)
        .with_gravity([0.0, -g])
        .unwrap();
    for step in 0..60 {
        let (phi, omega, alpha) = (0.11 * f64::from(step), 20.0, -150.0);
        let (sin, cos) = phi.sin_cos();
        let expected =
            preload + k * E * (1.0 - cos) + MASS * (g + E * cos * omega * omega + E * sin * alpha);
        let found = force(&machine, phi, omega, alpha);
        assert_near("N", found, expected, budget::DALEMBERT * preload);
    }
    for direction in [1.0, -1.0] {
        let found = limit(&machine, direction).unwrap();
        let omega = ((preload + 2.0 * k * E + MASS * g) / (MASS * E)).sqrt();
        assert_near("ω", found.omega, omega, budget::LIFT_OFF * omega);
        assert_near("φ", found.phi, PI, budget::EXTREME_PLACE);
    }
}

/// The closed form is met from a lightly to a strongly pressed follower, far from the starting speed of the search.
#[test]
fn slow_and_fast_limits_are_exact() {
    for (k, preload) in [
        (1e-9, 1e-9),
        (1e-5, 1e-4),
        (1.0, 2.0),
        (4e6, 1e5),
        (1e9, 1e7),
    ] {
        let omega = ((preload + 2.0 * k * E) / (MASS * E)).sqrt();
        let found = limit(&eccentric_machine(k, preload), 1.0).unwrap();
        assert_near("ω", found.omega, omega, budget::LIFT_OFF * omega);
    }
}

/// With a damper d on the follower N = F₀ + k·s + d·s′·ω + m·s″·ω²: the root of a quadratic at every φ, whose position alone depends on the
/// direction.
#[test]
fn damping_moves_the_place() {
    let (k, preload, damping) = (4e3, 60.0, 30.0);
    let machine = eccentric_machine(k, preload);
    let on_follower = Marker::on(DiscCam::FOLLOWER, [0.0, 0.0]);
    let damper = Element::damper([Marker::ground([0.0, 1.0]), on_follower], damping).unwrap();
    let machine = machine.with_element(damper).unwrap();
    // On a grid of φ, the smaller positive root.
    let dense = (0..200_000).map(|step| {
        let phi = TAU * f64::from(step) / 2e5;
        let (sin, cos) = phi.sin_cos();
        let (a, c, b) = (
            preload + k * E * (1.0 - cos),
            damping * E * sin,
            MASS * E * cos,
        );
        let root = (c * c - 4.0 * a * b).sqrt();
        let roots = [(-c - root) / (2.0 * b), (-c + root) / (2.0 * b)];
        let first = roots.into_iter().filter(|w| *w > 0.0);
        (first.fold(f64::INFINITY, f64::min), phi)
    });
    let (omega, phi) = dense.fold((f64::INFINITY, 0.0), |a, b| if b.0 < a.0 { b } else { a });
    let found = limit(&machine, 1.0).unwrap();
    assert_near("ω", found.omega, omega, 1e-8 * omega);
    assert_near("φ", found.phi, phi, 1e-4);
    assert!(found.phi > PI + 0.1, "it falls there");
    let back = limit(&machine, -1.0).unwrap();
    assert_near("ω", back.omega, found.omega, budget::LIFT_OFF * omega);
    assert_near("φ", back.phi, TAU - found.phi, budget::EXTREME_PLACE);
}

/// A load over a part of the turn is found, however narrow it is.
#[test]
fn short_loads_are_seen() {
    let machine = eccentric_machine(4e3, 60.0);
    let window = Window::new(Domain::Turn, [1.000, 1.002], 0.001).unwrap();
    let pull = Load::new(DiscCam::FOLLOWER, Action::Force([0.0, 70.0]))
        .unwrap()
        .within(window);
    let found = limit(&machine.clone().with_load(pull).unwrap(), 1.0);
    // F₀ + k·s is above 70 N there; the inertia presses on (cos φ > 0).
    assert!(found.unwrap().phi > 3.0);
    let pull = Load::new(DiscCam::FOLLOWER, Action::Force([0.0, 90.0]))
        .unwrap()
        .within(window);
    let found = limit(&machine.with_load(pull).unwrap(), 1.0).unwrap();
    assert_near("ω", found.omega, 0.0, 0.0);
    assert!((1.0..1.002).contains(&found.phi), "{found:?}");
}

#[test]
fn nothing_presses_without_a_spring() {
    let bare = Machine::new(eccentric_machine(1.0, 0.0).mechanism().clone());
    let found = limit(&bare, 1.0).unwrap();
    assert_near("ω", found.omega, 0.0, 0.0);
    assert_eq!(
        found.to_string(),
        format!(
            "nothing presses the follower on the cam at φ = {:.2}°: add a spring, or more preload",
            found.phi.to_degrees()
        )
    );
    let pulled = bare.with_gravity([0.0, 9.81]).unwrap();
    assert_near("ω", limit(&pulled, 1.0).unwrap().omega, 0.0, 0.0);
}

#[test]
fn the_message_names_place_and_speed() {
    let found = LiftOff {
        phi: PI / 3.0,
        omega: 20.0 * PI,
    };
    assert_eq!(
        found.to_string(),
        "the follower lifts off at φ = 60.00° above 600.0 rpm: stiffer spring, more preload, or a slower machine"
    );
}

/// A massless follower stays in contact at any speed.
#[test]
fn no_mass_never_lifts_off() {
    let still = Link::rotor(0.0).unwrap();
    let face = Follower::TranslatingFace { offset: 0.0 };
    let mechanism = DiscCam::new(
        eccentric(E),
        0.03,
        face,
        [Link::rotor(0.01).unwrap(), still],
    )
    .unwrap();
    let spring = mechanism.closing_spring(1e3, 20.0).unwrap();
    let machine = Machine::new(mechanism).with_element(spring).unwrap();
    assert_eq!(limit(&machine, 1.0), None);
}

#[test]
fn other_joints_are_no_contacts() {
    let machine = eccentric_machine(1e3, 20.0);
    for joint in [0, 1, 3] {
        assert_eq!(
            contact_force(&machine, joint, 1.0, 1.0, 0.0).unwrap_err(),
            MachineError::NoSuchJoint { joint, joints: 3 }
        );
        let turn = Piece { from: 0.0, to: TAU };
        assert!(lift_off(&machine, joint, std::iter::once(turn), 1.0).is_err());
    }
    assert!(contact_force(&machine, DiscCam::CONTACT, f64::NAN, 1.0, 0.0).is_err());
}

proptest! {
    #![proptest_config(config(16, 0x0ca2))]

    /// At the limit speed the force is zero at the reported position, and positive everywhere just below that speed.
    #[test]
    fn contact_vanishes_at_lift_off(mechanism in cam(), stiffness in 0.5f64..2.0, preload in 0.5f64..2.0, forward in any::<bool>()) {
        let swings = mechanism.follower().pivot().is_some();
        let (k, f) = if swings { (60.0, 12.0) } else { (5e3, 120.0) };
        let spring = mechanism.closing_spring(k * stiffness, f * preload).unwrap();
        let machine = Machine::new(mechanism).with_element(spring).unwrap();
        let machine = machine.with_gravity([2.0, -9.0]).unwrap();
        let direction = if forward { 1.0 } else { -1.0 };
        let Some(found) = limit(&machine, direction) else {
            return Ok(());
        };
        if found.omega == 0.0 {
            prop_assert!(force(&machine, found.phi, 0.0, 0.0) <= 0.0);
            return Ok(());
        }
        let size = force(&machine, found.phi, 0.0, 0.0);
        let at = |phi: f64, share: f64| force(&machine, phi, direction * share * found.omega, 0.0);
        assert_near("N", at(found.phi, 1.0), 0.0, budget::LIFT_OFF * size);
        prop_assert!(at(found.phi, 1.001) < 0.0);
        for k in 0..720 {
            let phi = TAU * f64::from(k) / 720.0;
            prop_assert!(at(phi, 1.0 - 1e-6) > 0.0, "φ = {}", phi);
        }
    }
}
