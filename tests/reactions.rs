//! Forces in the joints: d'Alembert's principle against golden data and against the reduced equation.

use crate::support::golden::Case;
use crate::support::machines::{golden_slider_crank, spec};
use crate::support::{assert_near, budget, config, derivative, forces, jointed};
use jred::machine::{Element, Jointed, Machine, Marker, Mechanism, PoseError, Reducible};
use proptest::prelude::*;

#[test]
fn slider_crank_reactions_golden() {
    let case = Case::new(include_str!("data/01_slider_crank_A.json"));
    let machine = golden_slider_crank(&case);
    let table = case.table("motion");
    let forces = forces::golden(&machine, &table, &["F_0_1", "F_1_2", "F_2_3"]);
    let across: Vec<f64> = forces.iter().map(|f| f.reactions[3].force[1]).collect();
    table.compare("N_0_3", &across, budget::REACTIONS);
    // The force in the guide passes through B, where the slider's mass and load are: no moment.
    assert_near(
        "M_0_3",
        crate::support::largest(table.column("M_0_3")),
        0.0,
        0.0,
    );
    let moments = forces.iter().map(|f| f.reactions[3].moment);
    let force = crate::support::largest(table.column("N_0_3"));
    assert_near(
        "M_0_3",
        crate::support::largest(moments),
        0.0,
        budget::REACTIONS * force,
    );
}

proptest! {
    #![proptest_config(config(200, 0x02b1))]

    #[test]
    fn dalembert_is_the_reduced_equation(
        spec in spec(),
        phi in 0.0..6.3,
        omega in -40.0..40.0,
        alpha in -500.0..500.0,
        spring in [0.0..0.5, 50.0..5000.0, 0.0..0.3],
        torsion in [0.1..50.0, -1.0..1.0],
        damping in [0.0..20.0, 0.0..0.3],
    ) {
        let machine = spec.machine();
        let mechanism = machine.mechanism().clone();
        jointed::joints_close(&mechanism, phi);
        // From the ground to a point of the rod, and from the crank to the rod.
        let far = [Marker::ground([-0.3, 0.4]), Marker::on(1, [spring[0] * 0.1, 0.02])];
        let pin = [Marker::on(0, [0.0, 0.0]), Marker::on(1, [0.0, 0.0])];
        let machine = machine
            .with_element(Element::spring(far, spring[1], spring[2]).unwrap())
            .and_then(|m| m.with_element(Element::torsion_spring(pin, torsion[0], torsion[1])?))
            .and_then(|m| m.with_element(Element::damper(far, damping[0])?))
            .and_then(|m| m.with_element(Element::torsion_damper(pin, damping[1])?))
            .unwrap();
        forces::dalembert(&machine, phi, omega, alpha);
        jointed::energy(&machine, phi, omega);
        let energy = |phi| machine.reduction(phi).unwrap().potential_energy;
        let found = machine.reduction(phi).unwrap().potential_slope;
        let slope = derivative(energy, phi, 1e-2);
        assert_near("U′", found, slope, budget::ENERGY_SLOPE * (1.0 + slope.abs() + energy(phi).abs()));
    }
}

/// Newton's law for the whole: the ground's reactions, gravity, loads and inertia forces balance.
#[test]
fn the_ground_takes_what_the_links_give() {
    let case = Case::new(include_str!("data/01_slider_crank_A.json"));
    let machine = golden_slider_crank(&case);
    let links = machine.mechanism().links();
    let gravity = machine.gravity();
    let force = [case.input("/F_slider/F/0"), case.input("/F_slider/F/1")];
    for k in 0..24 {
        let (phi, omega, alpha) = (0.3 * f64::from(k), 30.0, -200.0);
        let forces = machine.forces(phi, omega, alpha).unwrap();
        for axis in 0..2 {
            let weight: f64 = links.iter().map(|l| l.mass() * gravity[axis]).sum();
            let ground = forces.reactions[0].force[axis] + forces.reactions[3].force[axis];
            let sum = ground + weight + force[axis] + forces.shaking_force[axis];
            assert_near("sum of forces", sum, 0.0, budget::DALEMBERT * 1e3);
        }
        // A force proportional to ω² only: without gravity and loads, twice the speed gives four times the shaking force.
        let twice = machine.forces(phi, 2.0 * omega, 4.0 * alpha).unwrap();
        assert_near(
            "shaking moment",
            twice.shaking_moment,
            4.0 * forces.shaking_moment,
            1e-9,
        );
    }
}

/// A spring stores energy: a machine with a spring and no loss conserves ½Jω² + U.
#[test]
fn a_spring_pulls_when_longer_and_pushes_when_shorter() {
    let case = Case::new(include_str!("data/01_slider_crank_A.json"));
    let mechanism = golden_slider_crank(&case).mechanism().clone();
    let frames = mechanism.frames(0.0).unwrap();
    let slider = frames[2].x.value;
    let joints = mechanism.joints(0.0, &frames).unwrap();
    assert_eq!(joints.len(), 4);
    let between = [
        Marker::ground([slider + 0.5, frames[2].y.value]),
        Marker::on(2, [0.0, 0.0]),
    ];
    for (free, expected) in [(0.5, 0.0), (0.3, 200.0), (0.7, -200.0)] {
        let spring = Element::spring(between, 1000.0, free).unwrap();
        let [on_ground, on_slider] = spring.wrenches(&frames, 0.0).unwrap();
        assert_near("on the slider", on_slider.force[0], expected, 1e-9);
        assert_near("on the ground", on_ground.force[0], -expected, 1e-9);
        assert_near("across", on_slider.force[1], 0.0, 1e-9);
        let machine = Machine::new(mechanism.clone())
            .with_element(spring)
            .unwrap();
        let energy = machine.reduction(0.0).unwrap().potential_energy;
        assert_near("U", energy, 500.0 * (0.5 - free) * (0.5 - free), 1e-9);
    }
    assert!(
        Element::spring(between, -1.0, 0.1)
            .unwrap_err()
            .to_string()
            .contains("spring stiffness is -1")
    );
    assert!(Element::spring(between, 1.0, -0.1).is_err());
    assert!(Element::damper(between, f64::NAN).is_err());
    let nowhere = [Marker::ground([0.0, 0.0]), Marker::on(3, [0.0, 0.0])];
    let spring = Element::spring(nowhere, 1.0, 0.1).unwrap();
    let refused = Machine::new(mechanism).with_element(spring).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "there is no link 3: the mechanism has links 0 to 2"
    );
}

/// A spring has the same length after a turn, so the table of one turn is valid for all; one that is wound up turn by turn has not.
#[test]
fn a_spring_repeats_and_a_wound_one_does_not() {
    let case = Case::new(include_str!("data/01_slider_crank_A.json"));
    let bare = || golden_slider_crank(&case);
    assert_eq!(bare().check_repeats(), Ok(()));
    let ends = [Marker::ground([-0.3, 0.4]), Marker::on(0, [0.01, 0.02])];
    let spring = Element::spring(ends, 800.0, 0.1).unwrap();
    assert_eq!(bare().with_element(spring).unwrap().check_repeats(), Ok(()));
    let wound = [Marker::ground([0.0, 0.0]), Marker::on(0, [0.0, 0.0])];
    let spring = Element::torsion_spring(wound, 3.0, 0.2).unwrap();
    let refused = bare().with_element(spring).unwrap().check_repeats();
    assert!(
        matches!(refused, Err(PoseError::NotPeriodic { .. })),
        "{refused:?}"
    );
}
