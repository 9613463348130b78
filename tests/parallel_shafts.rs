//! Several driven shafts on one drive shaft.

use crate::support::{assert_near, budget, config, jointed};
use jred::mechanism::{Misfit, ParallelShafts, Stage, Train};
use jred::{Action, Error, Link, Load, Machine, Mechanism, Reducible};
use proptest::prelude::*;

fn rotor(inertia: f64) -> Link {
    Link::rotor(inertia).unwrap()
}

#[test]
fn fan_textbook() {
    let driven = [(2.0, rotor(0.4)), (-3.0, rotor(0.9)), (0.5, rotor(0.02))];
    let machine = Machine::new(ParallelShafts::new(rotor(0.01), &driven).unwrap())
        .with_load(Load::new(2, Action::Moment(6.0)).unwrap())
        .unwrap();
    let reduced = machine.reduction(1.0).unwrap();
    // 0.01 + 0.4/4 + 0.9/9 + 0.02·4; the load of 6 N·m turns against the drive at a third of its speed.
    assert_near("J", reduced.inertia[0], 0.29, budget::CLOSED_FORM);
    assert_near("process", reduced.process, -2.0, budget::CLOSED_FORM * 6.0);
    let frames = machine.mechanism().frames(3.0).unwrap();
    assert_near("ψ", frames[2].psi.value, -1.0, budget::CLOSED_FORM * 3.0);
    // Each transmission gives its shaft what it needs: J·α/i − load.
    let forces = machine.forces(1.0, 2.0, 30.0).unwrap();
    for (k, moment) in [(4, 0.4 * 15.0), (5, -0.9 * 10.0 - 6.0), (6, 0.02 * 60.0)] {
        assert_near(
            "moment",
            forces.reactions[k].moment,
            moment,
            budget::REACTIONS * 15.0,
        );
    }
}

/// With one driven shaft it is a train of one stage.
#[test]
fn one_shaft_is_a_stage() {
    let stage = Stage::new(-2.5, [0.03, 0.7]).unwrap();
    let train = Machine::new(Train::new(&[stage]).unwrap());
    let fan = Machine::new(ParallelShafts::new(rotor(0.03), &[(-2.5, rotor(0.7))]).unwrap());
    let (a, b) = (train.reduction(4.0).unwrap(), fan.reduction(4.0).unwrap());
    assert_near("J", b.inertia[0], a.inertia[0], budget::CLOSED_FORM);
    let torque = |forces: &jred::Forces| (forces.drive, forces.reactions[2].moment);
    let (a, b) = (
        train.forces(4.0, 5.0, 60.0).unwrap(),
        fan.forces(4.0, 5.0, 60.0).unwrap(),
    );
    assert_near(
        "drive",
        torque(&b).0,
        torque(&a).0,
        budget::REACTIONS * 10.0,
    );
    assert_near("mesh", torque(&b).1, torque(&a).1, budget::REACTIONS * 20.0);
}

proptest! {
    #![proptest_config(config(150, 47))]

    #[test]
    fn joints_close_and_forces_balance(
        driven in proptest::collection::vec((0.05..20.0_f64, any::<bool>(), 1e-4..2.0_f64), 1..=15),
        drive in 1e-4..1.0_f64,
        load in [-30.0..30.0_f64, 0.0..10.0, 0.0..2.0],
        phi in -60.0..60.0_f64,
        omega in -15.0..15.0_f64,
        alpha in -100.0..100.0_f64,
    ) {
        let driven: Vec<(f64, Link)> = driven
            .into_iter()
            .map(|(ratio, back, inertia)| (if back { -ratio } else { ratio }, rotor(inertia)))
            .collect();
        let last = driven.len();
        let on = |action| Load::new(last, action).unwrap();
        let machine = Machine::new(ParallelShafts::new(rotor(drive), &driven).unwrap())
            .with_load(on(Action::Moment(load[0])))
            .and_then(|m| m.with_load(on(Action::OpposingMoment(load[1]))))
            .and_then(|m| m.with_load(on(Action::ViscousMoment(load[2]))))
            .unwrap();
        jointed::holds(&machine, phi, omega, alpha);
        jointed::turns(machine.mechanism(), 50);
        let sum: f64 = driven.iter().map(|(i, link)| link.inertia() / (i * i)).sum();
        let found = machine.reduction(phi).unwrap().inertia[0];
        prop_assert!((found - drive - sum).abs() <= budget::CLOSED_FORM * found);
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |driven: &[(f64, Link)]| ParallelShafts::new(rotor(1.0), driven).unwrap_err();
    assert_eq!(
        new(&[]).to_string(),
        "number of driven shafts is 0, but must be greater than zero"
    );
    assert_eq!(
        new(&[(0.0, rotor(1.0))]).to_string(),
        "size of the ratio is 0, but must be greater than zero"
    );
    assert_eq!(
        new(&[(f64::NAN, rotor(1.0))]),
        Error::NotFinite("size of the ratio")
    );
    assert_eq!(
        new(&[(1.0, rotor(1.0)); 16]).to_string(),
        "too many driven shafts: at most 15 fit"
    );
    let off = Link::new(1.0, 1.0, [0.5, 0.0]).unwrap();
    let misfit = Misfit::OffAxis {
        link: "driven shaft",
        distance: 0.5,
    };
    assert_eq!(new(&[(1.0, off)]), Error::Misfit(misfit));
    // The drive shaft turns with φ and may be unbalanced.
    let fan = ParallelShafts::new(off, &[(1.0, rotor(1.0))]).unwrap();
    assert_eq!(
        fan.frames(f64::NAN).unwrap_err(),
        Error::NotFinite("drive shaft angle")
    );
}
