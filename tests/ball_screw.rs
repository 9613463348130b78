//! The screw drive: formula, joints, thrust.

use jred::machine::PoseError;
use jred::mechanism::BuildError;
use jred::number::RangeError;
use std::f64::consts::TAU;

use crate::support::machines::loaded;
use crate::support::{assert_near, budget, config, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{BallScrew, DimensionError};
use proptest::prelude::*;

const NUT: usize = BallScrew::NUT;

fn links(inertia: f64, mass: f64) -> [Link; 2] {
    [
        link_of(3.0, inertia, [0.0, 0.0]),
        Link::point_mass(mass).unwrap(),
    ]
}

#[test]
fn ball_screw_textbook() {
    let (inertia, mass, force) = (0.0008, 120.0, -900.0);
    for lead in [0.01, -0.02] {
        let screw = BallScrew::new(lead, links(inertia, mass)).unwrap();
        assert_near("h", screw.lead(), lead, 0.0);
        let load = Load::new(NUT, Action::Force([force, 0.0])).unwrap();
        let machine = Machine::new(screw)
            .with_gravity([0.0, -9.81])
            .and_then(|m| m.with_load(load))
            .unwrap();
        let expected = inertia + mass * (lead / TAU).powi(2);
        for phi in [-100.0_f64, 0.0, 2.0, 700.0] {
            let x = machine.mechanism().frames(phi).unwrap()[NUT].x;
            assert_near(
                "x",
                x.value,
                lead * phi / TAU,
                budget::CLOSED_FORM * (1.0 + phi.abs()),
            );
            let reduced = machine.reduction(phi).unwrap();
            assert_near(
                "J",
                reduced.inertia,
                expected,
                budget::CLOSED_FORM * expected,
            );
            assert_eq!(reduced.inertias()[1..], [0.0, 0.0]);
            assert_near("U'", reduced.potential_slope, 0.0, 0.0);

            // Thrust = m·ẍ − F, on the nut by the thread and on the screw by the bearings; weights are carried elsewhere.
            let alpha = 500.0;
            let forces = machine.forces(phi, 50.0, alpha).unwrap();
            let thrust = mass * alpha * lead / TAU - force;
            let size = budget::REACTIONS * 1300.0;
            assert_near("thread", forces.reactions[2].force[0], thrust, size);
            assert_near("thrust bearing", forces.reactions[0].force[0], thrust, size);
            assert_near(
                "screw's weight",
                forces.reactions[0].force[1],
                3.0 * 9.81,
                size,
            );
            assert_near(
                "nut's weight",
                forces.reactions[1].force[1],
                mass * 9.81,
                size,
            );
            let drive = inertia * alpha + thrust * lead / TAU;
            assert_near("drive", forces.drive, drive, budget::REACTIONS * 4.0);
        }
    }
}

prop_compose! {
    pub(crate) fn machines()(
        lead in 0.001..0.06_f64,
        left in any::<bool>(),
        inertia in 1e-5..1e-2_f64,
        mass in 0.1..500.0_f64,
        com in [-1.0..1.0, -1.0..1.0],
        down in 0.0..6.2_f64,
        load in [-300.0..300.0, 0.0..100.0, 0.0..20.0],
    ) -> Machine<BallScrew> {
        let links = [
            link_of(2.0, inertia, [0.0, 0.0]),
            link_of(mass, 0.0, com),
        ];
        let lead = if left { -lead } else { lead };
        let loads = [Action::Force([load[0], 0.3 * load[0]]), Action::OpposingForce(load[1]), Action::ViscousForce(load[2])];
        loaded(BallScrew::new(lead, links).unwrap(), down, NUT, loads)
    }
}

proptest! {
    #![proptest_config(config(150, 45))]

    #[test]
    fn what_is_reduced_repeats(machine in machines(), phi in -200.0..200.0_f64) {
        let (now, later) = (machine.reduction(phi).unwrap(), machine.reduction(phi + TAU).unwrap());
        assert_near("J", later.inertia, now.inertia, budget::CLOSED_FORM * now.inertia);
        assert_near("load", later.load_torque(), now.load_torque(), budget::CLOSED_FORM * now.load_torque().abs());
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |lead| BallScrew::new(lead, links(1.0, 1.0)).unwrap_err();
    assert_eq!(
        new(0.0).to_string(),
        "size of the lead is 0, but must be greater than zero"
    );
    assert_eq!(
        new(f64::INFINITY),
        BuildError::Range(RangeError::NotFinite("size of the lead"))
    );
    let off = link_of(1.0, 1.0, [0.0, -0.25]);
    assert_eq!(
        BallScrew::new(0.01, [off, off]).unwrap_err(),
        BuildError::Dimensions(DimensionError::OffAxis {
            link: "screw",
            distance: 0.25
        })
    );
    let screw = BallScrew::new(0.1, links(1.0, 1.0)).unwrap();
    assert_eq!(
        screw.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("screw angle"))
    );
}
