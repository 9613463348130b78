//! Slip that grows with the load.

use jred::friction::{
    Arrangement, Contact, Creep, CreepContact, CreepLimit, Drive, Flow, Ramp, RampShape, Shaft,
    Stage, State, Variable,
};
use jred::machine::motion::Law;

use super::integrate;
use crate::support::{assert_near, budget};

const LIMIT: f64 = 60.0;

#[test]
fn load_and_slip_agree() {
    let creep = Creep::new(CreepLimit {
        slip: 0.04,
        torque: LIMIT,
    })
    .unwrap();
    for flow in [Flow::SecondDrives, Flow::FirstDrives] {
        for (ratio, omega) in [(1.7, 30.0), (-1.7, 30.0), (1.7, -30.0), (-1.7, -30.0)] {
            for torque in [-25.0, 25.0] {
                let stage = Stage::new(ratio).unwrap().with_slip(&creep, flow).unwrap();
                let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &[stage]).unwrap();
                let shafts = [Shaft::new(0.05, 3.0), Shaft::new(0.2, torque)];
                let state = State {
                    t: 0.0,
                    angles: &[0.0, 0.0],
                    omega,
                };
                let motion = drive.forward(state, &shafts).unwrap();
                let contact = motion.contacts[0];
                let along = if flow == Flow::FirstDrives { 1.0 } else { -1.0 };
                let load = along * contact.torque * (ratio * omega).signum();
                assert_near("ε", contact.slip, 0.04 * load / LIMIT, budget::SETTLED);
                assert!(
                    contact.loss > 0.0,
                    "a contact never gives power: {contact:?}"
                );
                // The driven side is the slower one, in any convention.
                let (first, second) = ((ratio * omega).abs(), motion.shafts[1].omega.abs());
                let drives = contact.torque * ratio * omega > 0.0;
                assert_eq!(drives, first > second);
            }
        }
    }
}

/// Loads on both shafts for a given speed: the power flows from shaft 1 to shaft 2.
fn steady(creep: f64) -> (Drive<'static>, [Shaft; 2]) {
    let course: &'static Creep = Box::leak(Box::new(
        Creep::new(CreepLimit {
            slip: creep,
            torque: LIMIT,
        })
        .unwrap(),
    ));
    let stage = Stage::new(1.5)
        .unwrap()
        .with_slip(course, Flow::FirstDrives)
        .unwrap();
    let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &[stage]).unwrap();
    (drive, [Shaft::new(0.03, 45.0), Shaft::new(0.08, -30.0)])
}

#[test]
fn steady_load_is_the_creeping_contact() {
    let (drive, shafts) = steady(0.05);
    let state = State {
        t: 0.0,
        angles: &[0.0, 0.0],
        omega: 80.0,
    };
    let motion = drive.forward(state, &shafts).unwrap();
    assert_near("α", motion.alpha, 0.0, budget::IDENTITY);
    let contact = CreepContact::new(CreepLimit {
        slip: 0.05,
        torque: LIMIT,
    })
    .unwrap();
    let found = contact.traction(1.5 * 80.0, motion.shafts[1].omega);
    assert_near("L", found.torque, 30.0, budget::SETTLED * 1e4);
    assert_near("ε", found.slip, motion.contacts[0].slip, budget::SETTLED);
    assert_near("loss", found.loss, motion.loss, budget::SETTLED * 1e5);
}

/// The quasi-static form neglects the rate of the load: halving the creep quarters the difference from the model with two speeds.
#[test]
fn quasi_static_creep_approaches_two_speeds() {
    let difference = |creep: f64| {
        let course = Creep::new(CreepLimit {
            slip: creep,
            torque: LIMIT,
        })
        .unwrap();
        let ratio = Ramp::new(
            Variable::Time,
            RampShape {
                start: 0.05,
                length: 1.0,
                values: [1.0, 1.6],
            },
            Law::Polynomial345,
        )
        .unwrap();
        let stage = Stage::new(&ratio)
            .unwrap()
            .with_slip(&course, Flow::FirstDrives)
            .unwrap();
        let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &[stage]).unwrap();
        let shafts = [Shaft::new(0.03, 22.0), Shaft::new(0.08, -15.0)];
        let start = drive
            .forward(
                State {
                    t: 0.0,
                    angles: &[0.0, 0.0],
                    omega: 60.0,
                },
                &shafts,
            )
            .unwrap();
        let contact = CreepContact::new(CreepLimit {
            slip: creep,
            torque: LIMIT,
        })
        .unwrap();
        let (h, steps) = (2e-5, 60_000);
        let one = integrate(
            |t, y: &[f64; 3]| {
                let state = State {
                    t,
                    angles: &y[..2],
                    omega: y[2],
                };
                let found = drive.forward(state, &shafts).unwrap();
                [found.shafts[0].omega, found.shafts[1].omega, found.alpha]
            },
            0.0,
            [0.0, 0.0, 60.0],
            20.0 * h,
            steps / 20,
        );
        let two = integrate(
            |t, y: &[f64; 4]| {
                use jred::friction::{Course, OperatingPoint};
                let i = ratio.at(OperatingPoint::at_time(t)).value;
                let l = contact.traction(i * y[2], y[3]).torque;
                [y[2], y[3], (22.0 - i * l) / 0.03, (l - 15.0) / 0.08]
            },
            0.0,
            [0.0, 0.0, 60.0, start.shafts[1].omega],
            h,
            steps,
        );
        (one[2] - two[2]).abs() / two[2]
    };
    let [coarse, fine] = [0.04, 0.02].map(difference);
    assert!(coarse < 2e-2, "{coarse:e}");
    assert!(fine < 0.62 * coarse, "{fine:e} of {coarse:e}");
}

#[test]
fn the_contact_covers_both_conventions() {
    let contact = CreepContact::new(CreepLimit {
        slip: 0.05,
        torque: LIMIT,
    })
    .unwrap();
    // Shaft 1 drives: ω₂ = i·ω₁·(1 − ε). Shaft 2 drives, as printed: ω₂ = i·ω₁/(1 − ε).
    let (first, slip) = (100.0, 0.02);
    let forward = contact.traction(first, first * (1.0 - slip));
    assert_near("ε", forward.slip, slip, budget::SETTLED);
    let printed = contact.traction(first, first / (1.0 - slip));
    assert_near("ε", printed.slip, -slip, budget::SETTLED);
    assert_near(
        "L",
        printed.torque,
        -forward.torque,
        budget::SETTLED * LIMIT,
    );
    for (a, b) in [
        (100.0, 99.0),
        (99.0, 100.0),
        (-100.0, -99.0),
        (1.0, -1.0),
        (0.0, 0.05),
    ] {
        assert!(contact.traction(a, b).loss > 0.0);
    }
    // Sliding: exactly the limit.
    assert_near("limit", contact.traction(100.0, 20.0).torque, LIMIT, 0.0);
    assert_near("limit", contact.traction(20.0, 100.0).torque, -LIMIT, 0.0);
    // At standstill there is no division by zero; below SLOW it is viscous.
    assert_near("rest", contact.traction(0.0, 0.0).torque, 0.0, 0.0);
    let slow = 1e-3;
    let viscous = LIMIT / 0.05 / CreepContact::SLOW * slow;
    assert_near(
        "viscous",
        contact.traction(slow, 0.0).torque,
        viscous,
        budget::SETTLED * LIMIT,
    );
}
