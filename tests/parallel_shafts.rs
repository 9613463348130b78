//! Several driven shafts on one drive shaft.

use crate::support::{assert_near, budget, config, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism, PoseError, Reducible};
use jred::mechanism::{BuildError, DimensionError, DrivenShaft, ParallelShafts, Stage, Train};
use jred::number::RangeError;
use proptest::prelude::*;

fn shaft(ratio: f64, inertia: f64) -> DrivenShaft {
    DrivenShaft {
        ratio,
        link: rotor(inertia),
    }
}

fn rotor(inertia: f64) -> Link {
    Link::rotor(inertia).unwrap()
}

#[test]
fn fan_textbook() {
    let driven = [(2.0, 0.4), (-3.0, 0.9), (0.5, 0.02)].map(|(ratio, j)| shaft(ratio, j));
    let machine = Machine::new(ParallelShafts::new(rotor(0.01), &driven).unwrap())
        .with_load(Load::new(2, Action::Moment(6.0)).unwrap())
        .unwrap();
    let reduced = machine.reduction(1.0).unwrap();
    // 0.01 + 0.4/4 + 0.9/9 + 0.02·4; the load of 6 N·m opposes the drive at a third of its speed.
    assert_near("J", reduced.inertia, 0.29, budget::CLOSED_FORM);
    assert_near("process", reduced.process, -2.0, budget::CLOSED_FORM * 6.0);
    let frames = machine.mechanism().frames(3.0).unwrap();
    assert_near("ψ", frames[2].psi.value, -1.0, budget::CLOSED_FORM * 3.0);
    // Each transmission supplies its shaft: J·α/i − load.
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
    let fan = Machine::new(ParallelShafts::new(rotor(0.03), &[shaft(-2.5, 0.7)]).unwrap());
    let (a, b) = (train.reduction(4.0).unwrap(), fan.reduction(4.0).unwrap());
    assert_near("J", b.inertia, a.inertia, budget::CLOSED_FORM);
    let torque = |forces: &jred::machine::Forces| (forces.drive, forces.reactions[2].moment);
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

prop_compose! {
    pub(crate) fn machines()(
        driven in proptest::collection::vec((0.05..20.0_f64, any::<bool>(), 1e-4..2.0_f64), 1..=15),
        drive in 1e-4..1.0_f64,
        load in [-30.0..30.0_f64, 0.0..10.0, 0.0..2.0],
    ) -> Machine<ParallelShafts> {
        let driven: Vec<DrivenShaft> = driven
            .into_iter()
            .map(|(ratio, back, inertia)| shaft(if back { -ratio } else { ratio }, inertia))
            .collect();
        let last = driven.len();
        let on = |action| Load::new(last, action).unwrap();
        Machine::new(ParallelShafts::new(rotor(drive), &driven).unwrap())
            .with_load(on(Action::Moment(load[0])))
            .and_then(|m| m.with_load(on(Action::OpposingMoment(load[1]))))
            .and_then(|m| m.with_load(on(Action::ViscousMoment(load[2]))))
            .unwrap()
    }
}

proptest! {
    #![proptest_config(config(150, 47))]

    #[test]
    fn inertias_by_the_square_of_the_ratio(machine in machines(), phi in -60.0..60.0_f64) {
        let shafts = machine.mechanism();
        let (drive, driven) = shafts.links().split_first().unwrap();
        let sum: f64 = driven.iter().zip(shafts.ratios()).map(|(link, i)| link.inertia() / (i * i)).sum();
        let found = machine.reduction(phi).unwrap().inertia;
        prop_assert!((found - drive.inertia() - sum).abs() <= budget::CLOSED_FORM * found);
    }
}

#[test]
fn wrong_dimensions_are_refused() {
    let new = |driven: &[DrivenShaft]| ParallelShafts::new(rotor(1.0), driven).unwrap_err();
    assert_eq!(
        new(&[]).to_string(),
        "number of driven shafts is 0, but must be greater than zero"
    );
    assert_eq!(
        new(&[shaft(0.0, 1.0)]).to_string(),
        "size of the ratio is 0, but must be greater than zero"
    );
    assert_eq!(
        new(&[shaft(f64::NAN, 1.0)]),
        BuildError::Range(RangeError::NotFinite("size of the ratio"))
    );
    assert_eq!(
        new(&[shaft(1.0, 1.0); 16]).to_string(),
        "too many driven shafts: at most 15 fit"
    );
    let off = link_of(1.0, 1.0, [0.5, 0.0]);
    let misfit = DimensionError::OffAxis {
        link: "driven shaft",
        distance: 0.5,
    };
    assert_eq!(
        new(&[DrivenShaft {
            ratio: 1.0,
            link: off
        }]),
        BuildError::Dimensions(misfit)
    );
    // The drive shaft turns with φ and may be unbalanced.
    let fan = ParallelShafts::new(off, &[shaft(1.0, 1.0)]).unwrap();
    assert_eq!(
        fan.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("drive shaft angle"))
    );
}
