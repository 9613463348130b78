//! Numbers only: a gear train by another name.

use jred::friction::{Arrangement, Contact, Drive, Flow, Shaft, Stage, State};
use jred::mechanism::{FrictionDrive, Stage as Gear, Train};
use jred::{Jointed, Load, Machine, Mechanism, Reducible};
use proptest::prelude::*;

use crate::support::jointed::{dalembert, joints_close, turns};
use crate::support::{assert_near, budget, config};

#[test]
fn constant_ratios_are_a_train() {
    let ratio = || prop_oneof![0.2f64..5.0, -5.0f64..-0.2];
    let strategy = (
        prop::array::uniform3(ratio()),
        prop::array::uniform3(0.0f64..0.2),
        prop::array::uniform4(0.001f64..2.0),
        any::<bool>(),
        -10.0f64..10.0,
        -40.0f64..40.0,
    );
    let mut runner = proptest::test_runner::TestRunner::new(config(200, 72));
    let test =
        |(i, slips, inertias, fan, phi, omega): ([f64; 3], [f64; 3], [f64; 4], bool, f64, f64)| {
            let arrangement = if fan {
                Arrangement::Fan
            } else {
                Arrangement::Chain
            };
            let stages: Vec<Stage> = (0..3)
                .map(|k| {
                    Stage::new(i[k])
                        .unwrap()
                        .with_slip(slips[k], Flow::SecondDrives)
                        .unwrap()
                })
                .collect();
            let mechanism = FrictionDrive::new(arrangement, &stages, &inertias).unwrap();
            assert_eq!(mechanism.arrangement(), arrangement);
            // j = i/(1 − ε), (III.12), (III.19)
            let j: Vec<f64> = (0..3).map(|k| i[k] / (1.0 - slips[k])).collect();
            let all = match arrangement {
                Arrangement::Chain => [1.0, j[0], j[0] * j[1], j[0] * j[1] * j[2]],
                Arrangement::Fan => [1.0, j[0], j[1], j[2]],
            };
            for (found, expected) in mechanism.coefficients().iter().zip(all) {
                assert_near("j", *found, expected, budget::CLOSED_FORM * expected.abs());
            }
            joints_close(&mechanism, phi);
            turns(&mechanism, 24);
            let load = Load::new(2, jred::Action::Moment(3.0)).unwrap();
            let machine = Machine::new(&mechanism).with_load(load).unwrap();
            dalembert(&machine, phi, omega, 7.0);
            let inertia: f64 = all.iter().zip(inertias).map(|(j, own)| own * j * j).sum();
            let reduction = machine.reduction(phi).unwrap();
            assert_near(
                "J",
                reduction.inertia[0],
                inertia,
                budget::CLOSED_FORM * inertia,
            );
            // The equation of motion of the drive is that of the mechanism.
            let drive = Drive::new(arrangement, Contact::Ideal, &stages).unwrap();
            let mut shafts: Vec<Shaft> = inertias.iter().map(|j| Shaft::new(*j, 0.0)).collect();
            shafts[2].torque = 3.0;
            let angles: Vec<f64> = all.iter().map(|j| j * phi).collect();
            let motion = drive
                .inverse(
                    State {
                        t: 1.0,
                        angles: &angles,
                        omega,
                    },
                    7.0,
                    &shafts,
                )
                .unwrap();
            let torque = reduction.torque(omega, 7.0).total();
            assert_near(
                "torque",
                motion.drive,
                torque,
                budget::CLOSED_FORM * 10.0 * (inertia * 7.0 + 3.0 * all[2].abs()),
            );
            if arrangement == Arrangement::Chain {
                // A train counts its ratios the other way round; an inertia lies on either side of a stage.
                let gears: Vec<Gear> = (0..3)
                    .map(|k| {
                        Gear::new(
                            1.0 / j[k],
                            [if k == 0 { inertias[0] } else { 0.0 }, inertias[k + 1]],
                        )
                        .unwrap()
                    })
                    .collect();
                let train = Train::new(&gears).unwrap();
                assert_near(
                    "(6.9)",
                    train.inertia_at_input(),
                    inertia,
                    budget::CLOSED_FORM * inertia,
                );
                let (a, b) = (mechanism.frames(phi).unwrap(), train.frames(phi).unwrap());
                for (a, b) in a.iter().zip(&b) {
                    assert_near(
                        "ψ",
                        a.psi.value,
                        b.psi.value,
                        budget::CLOSED_FORM * (1.0 + b.psi.value.abs()),
                    );
                    assert_near(
                        "ψ′",
                        a.psi.d1,
                        b.psi.d1,
                        budget::CLOSED_FORM * b.psi.d1.abs(),
                    );
                }
                let frames = mechanism.frames(phi).unwrap();
                assert_eq!(
                    mechanism.joints(phi, &frames).unwrap().len(),
                    train.joints(phi, &frames).unwrap().len()
                );
            }
            Ok(())
        };
    runner.run(&strategy, test).unwrap();
}
