//! Constant ratios: equivalent to a gear train.

use jred::friction::{Arrangement, Contact, Drive, Flow, FrictionDrive, Shaft, Stage, State};
use jred::machine::{Jointed, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{Stage as Gear, Train};
use proptest::prelude::*;

use crate::support::forces::dalembert;
use crate::support::jointed::{joints_close, turns};
use crate::support::{assert_near, budget, config};

/// Three stages, four shafts.
#[derive(Clone, Debug)]
struct Case {
    ratios: [f64; 3],
    slips: [f64; 3],
    inertias: [f64; 4],
    fan: bool,
    phi: f64,
    omega: f64,
}

fn cases() -> impl Strategy<Value = Case> {
    let ratio = prop_oneof![0.2f64..5.0, -5.0f64..-0.2];
    let strategy = (
        prop::array::uniform3(ratio),
        prop::array::uniform3(0.0f64..0.2),
        prop::array::uniform4(0.001f64..2.0),
        any::<bool>(),
        -10.0f64..10.0,
        -40.0f64..40.0,
    );
    strategy.prop_map(|(ratios, slips, inertias, fan, phi, omega)| Case {
        ratios,
        slips,
        inertias,
        fan,
        phi,
        omega,
    })
}

#[test]
fn constant_ratios_are_a_train() {
    let mut runner = proptest::test_runner::TestRunner::new(config(200, 72));
    runner
        .run(&cases(), |case| {
            case.check();
            Ok(())
        })
        .unwrap();
}

const ALPHA: f64 = 7.0;
const MOMENT: f64 = 3.0;

impl Case {
    /// j = i/(1 − ε), (III.12), (III.19)
    fn speeds(&self) -> [f64; 3] {
        std::array::from_fn(|k| self.ratios[k] / (1.0 - self.slips[k]))
    }

    fn stages(&self) -> [Stage<'static>; 3] {
        std::array::from_fn(|k| {
            let stage = Stage::new(self.ratios[k]).unwrap();
            stage.with_slip(self.slips[k], Flow::SecondDrives).unwrap()
        })
    }

    fn check(&self) {
        let (phi, j) = (self.phi, self.speeds());
        let (arrangement, all) = if self.fan {
            (Arrangement::Fan, [1.0, j[0], j[1], j[2]])
        } else {
            (
                Arrangement::Chain,
                [1.0, j[0], j[0] * j[1], j[0] * j[1] * j[2]],
            )
        };
        let stages = self.stages();
        let mechanism = FrictionDrive::new(arrangement, &stages, &self.inertias).unwrap();
        assert_eq!(mechanism.arrangement(), arrangement);
        for (found, expected) in mechanism.coefficients().iter().zip(all) {
            assert_near("j", *found, expected, budget::CLOSED_FORM * expected.abs());
        }
        joints_close(&mechanism, phi);
        turns(&mechanism, 24);
        let load = Load::new(2, jred::machine::Action::Moment(MOMENT)).unwrap();
        let machine = Machine::new(&mechanism).with_load(load).unwrap();
        dalembert(&machine, phi, self.omega, ALPHA);
        let own = all.iter().zip(self.inertias);
        let inertia: f64 = own.map(|(j, own)| own * j * j).sum();
        let found = machine.reduction(phi).unwrap().inertia;
        assert_near("J", found, inertia, budget::CLOSED_FORM * inertia);

        // The equation of motion of the drive equals that of the mechanism.
        let drive = Drive::new(arrangement, Contact::Ideal, &stages).unwrap();
        let mut shafts = self.inertias.map(|inertia| Shaft::new(inertia, 0.0));
        shafts[2].torque = MOMENT;
        let state = State {
            t: 1.0,
            angles: &all.map(|j| j * phi),
            omega: self.omega,
        };
        let found = drive.inverse(state, ALPHA, &shafts).unwrap().drive;
        let torque = machine
            .reduction(phi)
            .unwrap()
            .torque(self.omega, ALPHA)
            .total();
        let size = inertia * ALPHA + MOMENT * all[2].abs();
        assert_near("torque", found, torque, budget::CLOSED_FORM * 10.0 * size);
        if !self.fan {
            self.against_train(&mechanism, inertia);
        }
    }

    /// A train counts its ratios the other way round; an inertia is on either side of a stage.
    fn against_train(&self, mechanism: &FrictionDrive, inertia: f64) {
        let j = self.speeds();
        let first = |k: usize| if k == 0 { self.inertias[0] } else { 0.0 };
        let gear = |k: usize| Gear::new(1.0 / j[k], [first(k), self.inertias[k + 1]]).unwrap();
        let train = Train::new(&[0, 1, 2].map(gear)).unwrap();
        let found = train.inertia_at_input();
        assert_near("(6.9)", found, inertia, budget::CLOSED_FORM * inertia);
        let frames = mechanism.frames(self.phi).unwrap();
        for (a, b) in frames.iter().zip(&train.frames(self.phi).unwrap()) {
            let size = 1.0 + b.psi.value.abs();
            assert_near("ψ", a.psi.value, b.psi.value, budget::CLOSED_FORM * size);
            assert_near(
                "ψ′",
                a.psi.d1,
                b.psi.d1,
                budget::CLOSED_FORM * b.psi.d1.abs(),
            );
        }
        let joints = mechanism.joints(self.phi, &frames).unwrap();
        assert_eq!(joints.len(), train.joints(self.phi, &frames).unwrap().len());
    }
}

/// Dry friction has no direction at standstill (sgn 0 = 0), and viscous friction is zero: α = Σ j·T/Σ j²·J.
#[test]
fn at_standstill_friction_makes_no_torque() {
    let (ratio, inertias, torques) = (-2.5, [0.3, 0.04], [7.0, -1.5]);
    let drive = [Stage::new(ratio).unwrap()];
    let drive = Drive::new(Arrangement::Chain, Contact::Ideal, &drive).unwrap();
    let shafts = [0, 1].map(|k| {
        let mut shaft = Shaft::new(inertias[k], torques[k]);
        (shaft.viscous, shaft.coulomb) = (0.2, 3.0);
        shaft
    });
    let at = |omega| State {
        t: 0.0,
        angles: &[0.0; 2],
        omega,
    };
    let inertia = inertias[0] + ratio * ratio * inertias[1];
    let torque = torques[0] + ratio * torques[1];
    let resting = drive.forward(at(0.0), &shafts).unwrap();
    assert_near(
        "α at rest",
        resting.alpha,
        torque / inertia,
        budget::CLOSED_FORM * torque / inertia,
    );
    // In motion, with shaft 2 in the other direction: each friction reduces the driving torque.
    let omega = 4.0;
    let friction = |speed: f64| 0.2 * speed + 3.0 * speed.signum();
    let braking = friction(omega) + ratio * friction(ratio * omega);
    let expected = (torque - braking) / inertia;
    let turning = drive.forward(at(omega), &shafts).unwrap();
    assert_near(
        "α in motion",
        turning.alpha,
        expected,
        budget::CLOSED_FORM * 10.0 * (torque + braking) / inertia,
    );
}
