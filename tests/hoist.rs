//! The hoist: drum, load on falls, counterweight.

use jred::machine::PoseError;
use jred::mechanism::RopeLoad;
use jred::number::RangeError;
use std::f64::consts::TAU;

use crate::support::machines::loaded;
use crate::support::{assert_near, budget, config, link_of};
use jred::machine::{Action, Link, Machine, Mechanism, Reducible};
use jred::mechanism::{Hoist, Rope};
use proptest::prelude::*;

const G: f64 = 9.81;

fn mass(mass: f64) -> Link {
    Link::point_mass(mass).unwrap()
}

fn upright(hoist: Hoist) -> Machine<Hoist> {
    Machine::new(hoist).with_gravity([0.0, -G]).unwrap()
}

#[test]
fn hoist_textbook() {
    let drum = link_of(80.0, 1.5, [0.0, 0.0]);
    let (load, counter) = (600.0, 250.0);
    let (rope, other) = (Rope::new(0.2, 2).unwrap(), Rope::new(0.3, 1).unwrap());
    assert_near("radius", rope.radius(), 0.2, 0.0);
    assert_eq!([rope, other].map(|rope| rope.falls()), [2, 1]);
    let plain = upright(Hoist::new(
        drum,
        RopeLoad {
            rope,
            link: mass(load),
        },
    ));
    let balanced = upright(Hoist::with_counterweight(
        drum,
        RopeLoad {
            rope,
            link: mass(load),
        },
        RopeLoad {
            rope: other,
            link: mass(counter),
        },
    ));
    for phi in [-10.0_f64, 0.0, 1.0, 60.0] {
        let size = budget::CLOSED_FORM * 1e3 * (1.0 + phi.abs());
        let frames = balanced.mechanism().frames(phi).unwrap();
        assert_near("load", frames[Hoist::LOAD].y.value, 0.1 * phi, size);
        assert_near(
            "counterweight",
            frames[Hoist::COUNTERWEIGHT].y.value,
            -0.3 * phi,
            size,
        );
        let one = plain.reduction(phi).unwrap();
        assert_near("J", one.inertia, 1.5 + load * 0.01, size);
        assert_near("U", one.potential_energy, load * G * 0.1 * phi, size);
        assert_near("U'", one.potential_slope, load * G * 0.1, size);
        let two = balanced.reduction(phi).unwrap();
        assert_near("J", two.inertia, 1.5 + load * 0.01 + counter * 0.09, size);
        assert_near(
            "U'",
            two.potential_slope,
            G * (load * 0.1 - counter * 0.3),
            size,
        );

        // Ropes: each fall of the load carries half of m·(g + a); the counterweight is carried with m·(g − a).
        let (omega, alpha) = (2.0, 5.0);
        let forces = balanced.forces(phi, omega, alpha).unwrap();
        let (s1, s2) = (load * (G + 0.1 * alpha) / 2.0, counter * (G - 0.3 * alpha));
        let near = |what: &str, found: f64, expected: f64| {
            assert_near(what, found, expected, budget::REACTIONS * 6e3);
        };
        near("rope of the load", forces.reactions[3].force[1], -s1);
        near("its place", forces.reactions[3].point[0], 0.2);
        near(
            "rope of the counterweight",
            forces.reactions[4].force[1],
            -s2,
        );
        near("its place", forces.reactions[4].point[0], -0.3);
        near("bearing", forces.reactions[0].force[1], s1 + s2 + 80.0 * G);
        near("guides", forces.reactions[1].force[0], 0.0);
        near("drive", forces.drive, 1.5 * alpha + s1 * 0.2 - s2 * 0.3);
    }
}

/// A machine with equal loads on one sheave is Atwood's: a = T/(R·(m1 + m2) + J/R).
#[test]
fn equal_loads_need_no_holding_torque() {
    let rope = Rope::new(0.25, 1).unwrap();
    let elevator = upright(Hoist::with_counterweight(
        Link::rotor(0.8).unwrap(),
        RopeLoad {
            rope,
            link: mass(400.0),
        },
        RopeLoad {
            rope,
            link: mass(400.0),
        },
    ));
    let reduced = elevator.reduction(3.0).unwrap();
    assert_near(
        "U'",
        reduced.potential_slope,
        0.0,
        budget::CLOSED_FORM * 1e3,
    );
    let alpha = reduced.acceleration(0.0, 40.0);
    let expected = 40.0 / (0.25 * 800.0 + 0.8 / 0.25) / 0.25;
    assert_near("Atwood", alpha, expected, budget::CLOSED_FORM * expected);
}

prop_compose! {
    pub(crate) fn machines()(
        radius in [0.05..0.5_f64, 0.05..0.5_f64],
        falls in [1..=8_u32, 1..=4_u32],
        counterweight in any::<bool>(),
        inertia in 0.01..5.0_f64,
        masses in [0.1..50.0, 1.0..900.0, 1.0..900.0],
        com in [-0.1..0.1, -0.1..0.1, -1.0..1.0, -1.0..1.0],
        down in 0.0..6.2_f64,
        load in [-300.0..300.0, 0.0..100.0, 0.0..20.0],
    ) -> Machine<Hoist> {
        let [u0, v0, u1, v1] = com;
        let drum = link_of(masses[0], inertia, [u0, v0]);
        let hook = RopeLoad {
            rope: Rope::new(radius[0], falls[0]).unwrap(),
            link: link_of(masses[1], 0.0, [u1, v1]),
        };
        let hoist = if counterweight {
            let rope = Rope::new(radius[1], falls[1]).unwrap();
            Hoist::with_counterweight(drum, hook, RopeLoad { rope, link: mass(masses[2]) })
        } else {
            Hoist::new(drum, hook)
        };
        let loads = [Action::Force([0.2 * load[0], load[0]]), Action::OpposingForce(load[1]), Action::ViscousForce(load[2])];
        loaded(hoist, down, Hoist::LOAD, loads)
    }
}

proptest! {
    #![proptest_config(config(150, 46))]

    #[test]
    fn what_is_reduced_repeats(machine in machines(), phi in -60.0..60.0_f64) {
        // All terms of the reduced equation repeat, though the load does not return.
        let (now, later) = (machine.reduction(phi).unwrap(), machine.reduction(phi + TAU).unwrap());
        prop_assert!((now.inertia - later.inertia).abs() <= budget::A_TURN_LATER * now.inertia);
        prop_assert!((now.load_torque() - later.load_torque()).abs() <= budget::A_TURN_LATER);
        // U is U′ integrated, over any number of turns.
        let drum = machine.mechanism().links()[0];
        let far = machine.reduction(phi + 40.0 * TAU).unwrap().potential_energy;
        let mean: f64 = machine.mechanism().links()[1..]
            .iter()
            .zip(machine.mechanism().frames(phi).unwrap().iter().skip(1))
            .map(|(link, frame)| link.potential_energy(frame, machine.gravity())[1])
            .sum();
        let expected = now.potential_energy + 40.0 * TAU * mean;
        prop_assert!((far - expected).abs() <= budget::A_TURN_LATER * (1e3 + expected.abs() + drum.mass()));
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |radius, falls| Rope::new(radius, falls).unwrap_err();
    assert_eq!(
        new(-0.1, 1).to_string(),
        "drum radius is -0.1, but must be greater than zero"
    );
    assert_eq!(new(f64::NAN, 1), RangeError::NotFinite("drum radius"));
    assert_eq!(
        new(0.1, 0).to_string(),
        "number of falls is 0, outside 1 to 24"
    );
    assert_eq!(
        new(0.1, 25).to_string(),
        "number of falls is 25, outside 1 to 24"
    );
    let hoist = Hoist::new(
        mass(1.0),
        RopeLoad {
            rope: Rope::new(0.1, 1).unwrap(),
            link: mass(1.0),
        },
    );
    assert_eq!(
        hoist.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("drum angle"))
    );
}
