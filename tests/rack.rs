//! Rack and pinion: formula, joints, forces.

use jred::machine::PoseError;
use jred::mechanism::BuildError;
use jred::number::RangeError;
use std::f64::consts::TAU;

use crate::support::machines::loaded;
use crate::support::{assert_near, budget, config, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::RackAndPinion;
use proptest::prelude::*;

const RACK: usize = RackAndPinion::RACK;

fn links(inertia: f64, mass: f64) -> [Link; 2] {
    [
        Link::rotor(inertia).unwrap(),
        link_of(mass, 0.0, [0.1, 0.05]),
    ]
}

#[test]
fn rack_textbook() {
    let (r, inertia, mass, force) = (0.04, 0.002, 25.0, -300.0);
    let rack = RackAndPinion::new(r, links(inertia, mass)).unwrap();
    assert_near("radius", rack.radius(), r, 0.0);
    assert_near("travel", rack.travel(), TAU * r, budget::CLOSED_FORM);
    let load = Load::new(RACK, Action::Force([force, 0.0])).unwrap();
    let machine = Machine::new(rack)
        .with_gravity([-9.81, 0.0])
        .and_then(|m| m.with_load(load))
        .unwrap();
    for phi in [-30.0_f64, -1.0, 0.0, 2.0, 100.0] {
        let x = machine.mechanism().frames(phi).unwrap()[RACK].x;
        assert_near(
            "x",
            x.value,
            r * phi,
            budget::CLOSED_FORM * (1.0 + phi.abs()),
        );
        assert_near("x'", x.d1, r, budget::CLOSED_FORM * r);
        assert_eq!([x.d2, x.d3][..], [0.0, 0.0]);
        let reduced = machine.reduction(phi).unwrap();
        // J1 + m·r²
        assert_near("J", reduced.inertia, 0.042, budget::CLOSED_FORM);
        assert_eq!(reduced.inertias()[1..], [0.0, 0.0]);
        // U = m·g·x grows with every turn, U′ = m·g·r does not.
        let (energy, slope) = (reduced.potential_energy, reduced.potential_slope);
        assert_near(
            "U",
            energy,
            25.0 * 9.81 * (0.1 + r * phi),
            budget::CLOSED_FORM * 2e3,
        );
        assert_near("U'", slope, 25.0 * 9.81 * r, budget::CLOSED_FORM * 10.0);
        assert_near(
            "process",
            reduced.process,
            force * r,
            budget::CLOSED_FORM * 12.0,
        );

        // Tooth force = m·(ẍ + g) − F; the guide takes the moments of weight and inertia about the pitch line.
        let alpha = 40.0;
        let forces = machine.forces(phi, 3.0, alpha).unwrap();
        let tooth = mass * (r * alpha + 9.81) - force;
        assert_near(
            "tooth",
            forces.reactions[2].force[0],
            tooth,
            budget::REACTIONS * tooth,
        );
        assert_near(
            "bearing",
            forces.reactions[0].force[0],
            tooth,
            budget::REACTIONS * tooth,
        );
        assert_near(
            "guide",
            forces.reactions[1].force[1],
            0.0,
            budget::REACTIONS * tooth,
        );
        let moment = -0.05 * mass * (r * alpha + 9.81);
        assert_near(
            "guide moment",
            forces.reactions[1].moment,
            moment,
            budget::REACTIONS * tooth,
        );
        let drive = inertia * alpha + tooth * r;
        assert_near("drive", forces.drive, drive, budget::REACTIONS * drive);
    }
}

prop_compose! {
    pub(crate) fn machines()(
        r in 0.005..0.3_f64,
        mass in [0.1..5.0, 0.1..50.0],
        com in [-0.5..1.0, -0.3..0.3, -1.0..1.0, -1.0..1.0],
        down in 0.0..6.2_f64,
        load in [-300.0..300.0, 0.0..100.0, 0.0..20.0],
    ) -> Machine<RackAndPinion> {
        let [u1, v1, u2, v2] = com.map(|c: f64| c * r);
        let links = [
            link_of(mass[0], 0.4 * mass[0] * r * r, [u1, v1]),
            link_of(mass[1], 0.0, [u2, v2]),
        ];
        let loads = [Action::Force([load[0], 0.3 * load[0]]), Action::OpposingForce(load[1]), Action::ViscousForce(load[2])];
        loaded(RackAndPinion::new(r, links).unwrap(), down, RACK, loads)
    }
}

proptest! {
    #![proptest_config(config(150, 44))]

    #[test]
    fn what_is_reduced_repeats(machine in machines(), phi in -20.0..20.0_f64) {
        // All terms of the reduced equation repeat, though the rack does not return.
        let (now, later) = (machine.reduction(phi).unwrap(), machine.reduction(phi + TAU).unwrap());
        prop_assert!((now.inertia - later.inertia).abs() <= budget::A_TURN_LATER * now.inertia);
        prop_assert!((now.load_torque() - later.load_torque()).abs() <= budget::A_TURN_LATER);
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |r| RackAndPinion::new(r, links(1.0, 1.0)).unwrap_err();
    assert_eq!(
        new(0.0).to_string(),
        "pitch radius is 0, but must be greater than zero"
    );
    assert_eq!(
        new(f64::NAN),
        BuildError::Range(RangeError::NotFinite("pitch radius"))
    );
    let rack = RackAndPinion::new(0.1, links(1.0, 1.0)).unwrap();
    assert_eq!(
        rack.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("pinion angle"))
    );
}
