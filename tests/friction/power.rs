//! Power and energy of drives in motion, with ratios over time and angle.

use jred::friction::{
    Arrangement, Contact, Drive, Flow, Motion, Ramp, RampShape, Shaft, Sine, SineShape, Stage,
    State, Variable,
};
use proptest::prelude::*;

use crate::support::{assert_near, budget, config, derivative};

/// A chain or a fan of two stages with ratios over time and angle, in motion.
#[derive(Clone, Debug)]
struct Case {
    fan: bool,
    slipping: bool,
    printed: bool,
    courses: [f64; 6],
    inertias: [f64; 3],
    torques: [f64; 3],
    at: [f64; 4],
}

fn cases() -> impl Strategy<Value = Case> {
    let choices = prop::array::uniform3(any::<bool>());
    let numbers = (
        prop::array::uniform6(0.3f64..1.0),
        prop::array::uniform3(0.01f64..1.0),
        prop::array::uniform3(-20.0f64..20.0),
        prop::array::uniform4(-3.0f64..3.0),
    );
    (choices, numbers).prop_map(
        |([fan, slipping, printed], (courses, inertias, torques, at))| Case {
            fan,
            slipping,
            printed,
            courses,
            inertias,
            torques,
            at,
        },
    )
}

#[test]
fn power_is_balanced() {
    let mut runner = proptest::test_runner::TestRunner::new(config(300, 71));
    runner
        .run(&cases(), |case| {
            case.check();
            Ok(())
        })
        .unwrap();
}

impl Case {
    fn check(&self) {
        let c = self.courses;
        let first = Sine::new(
            Variable::Time,
            SineShape {
                mean: 1.5,
                amplitude: c[0],
                frequency: 3.0 * c[1],
                phase: c[2],
            },
        )
        .unwrap();
        let second = Sine::new(
            Variable::Angle,
            SineShape {
                mean: -1.3,
                amplitude: c[3],
                frequency: 2.0,
                phase: c[4],
            },
        )
        .unwrap();
        let slip = Ramp::linear(
            Variable::Time,
            RampShape {
                start: -4.0,
                length: 8.0,
                values: [0.0, 0.3 * c[5]],
            },
        )
        .unwrap();
        let flow = if self.printed {
            Flow::SecondDrives
        } else {
            Flow::FirstDrives
        };
        let stages = [
            Stage::new(&first).unwrap().with_slip(&slip, flow).unwrap(),
            Stage::new(&second)
                .unwrap()
                .with_slip(0.1 * c[0], flow)
                .unwrap(),
        ];
        let arrangement = if self.fan {
            Arrangement::Fan
        } else {
            Arrangement::Chain
        };
        let contact = if self.slipping {
            Contact::Slipping
        } else {
            Contact::Ideal
        };
        let drive = Drive::new(arrangement, contact, &stages).unwrap();
        let shafts: [Shaft; 3] = std::array::from_fn(|k| Shaft {
            inertia: [self.inertias[k] + 0.01, 0.3 * self.inertias[k]],
            torque: self.torques[k],
            viscous: 0.2 * self.inertias[k],
            coulomb: 0.1,
        });
        let [t, a, b, omega] = [self.at[0], self.at[1], self.at[2], 10.0 * self.at[3]];
        let angles = [a, b, a - b];
        let state = State {
            t,
            angles: &angles,
            omega,
        };
        let motion = drive.forward(state, &shafts).unwrap();
        energy_balance(&motion, contact);
        rates_of_coefficients(&drive, &shafts, &state, &motion);
        // There and back.
        let mut without = shafts;
        without[0].torque = 0.0;
        let back = drive.inverse(state, motion.alpha, &without).unwrap();
        let size = 1.0 + terms(&motion);
        assert_near(
            "torque",
            back.drive,
            shafts[0].torque,
            budget::POWER_BALANCE * size,
        );
    }
}

/// Magnitude of the powers.
fn terms(motion: &Motion) -> f64 {
    let (j, rate) = (motion.inertia, motion.inertia_rate);
    let omega = motion.shafts[0].omega;
    let external: f64 = motion
        .shafts
        .iter()
        .map(|s| (s.torque * s.omega).abs())
        .sum();
    (j * omega * motion.alpha).abs() + (0.5 * rate * omega * omega).abs() + external
}

/// d(½Jω²)/dt = power − loss, and (A) with the loss torque on the right: J·ω̇ + ½·dJ/dt·ω = Σ j_k·M_k − loss/ω.
fn energy_balance(motion: &Motion, contact: Contact) {
    let (j, rate) = (motion.inertia, motion.inertia_rate);
    let (omega, size) = (motion.shafts[0].omega, terms(motion));
    let energy_rate = j * omega * motion.alpha + 0.5 * rate * omega * omega;
    let power = motion.power() - motion.loss;
    assert_near("power", energy_rate, power, budget::POWER_BALANCE * size);
    if contact == Contact::Ideal {
        assert_near("loss", motion.loss, 0.0, 0.0);
    }
    if omega.abs() > 0.1 {
        let reduced: f64 = motion
            .shafts
            .iter()
            .map(|s| s.coefficient[0] * s.torque)
            .sum();
        let found = j * motion.alpha + 0.5 * rate * omega;
        let expected = reduced - motion.loss / omega;
        assert_near(
            "(A)",
            found,
            expected,
            budget::POWER_BALANCE * 10.0 * (1.0 + size),
        );
    }
}

/// The rate of each coefficient is its derivative along the motion.
fn rates_of_coefficients(drive: &Drive, shafts: &[Shaft; 3], state: &State, motion: &Motion) {
    let along = |dt: f64| -> [f64; 3] {
        let moved: [f64; 3] =
            std::array::from_fn(|k| state.angles[k] + motion.shafts[k].omega * dt);
        let there = State {
            t: state.t + dt,
            angles: &moved,
            omega: state.omega,
        };
        let found = drive.forward(there, shafts).unwrap();
        std::array::from_fn(|k| found.shafts[k].coefficient[0])
    };
    for (k, shaft) in motion.shafts.iter().enumerate() {
        let rate = derivative(|dt| along(dt)[k], 0.0, 1e-3);
        let size = 1.0 + shaft.coefficient[1].abs();
        assert_near(
            "dj/dt",
            shaft.coefficient[1],
            rate,
            budget::RICHARDSON * size,
        );
    }
}
