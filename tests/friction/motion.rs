//! Energy, power and the factor ½.

use jred::friction::{
    Arrangement, Contact, Drive, Flow, Motion, Ramp, RampShape, Shaft, Sine, SineShape, Stage,
    State, Variable,
};
use jred::machine::motion::Law;
use jred::machine::{Link, Machine, Reducible};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};

use super::integrate;
use crate::support::{assert_near, budget, link_of};

/// From 0.6 to 1.9 within a second.
fn shift() -> Ramp {
    Ramp::new(
        Variable::Time,
        RampShape {
            start: 0.2,
            length: 1.0,
            values: [0.6, 1.9],
        },
        Law::Polynomial345,
    )
    .unwrap()
}

/// States of a drive: angles and ω.
fn rates<const N: usize>(motion: &Motion) -> [f64; N] {
    let mut rates = [0.0; N];
    for (rate, shaft) in rates.iter_mut().zip(&motion.shafts) {
        *rate = shaft.omega;
    }
    rates[N - 1] = motion.alpha;
    rates
}

fn state<const N: usize>(t: f64, y: &[f64; N]) -> State<'_> {
    State {
        t,
        angles: &y[..N - 1],
        omega: y[N - 1],
    }
}

#[test]
fn free_run_keeps_the_energy() {
    let ratio = shift();
    let other = Sine::new(
        Variable::Time,
        SineShape {
            mean: 1.2,
            amplitude: 0.3,
            frequency: 4.0,
            phase: 0.5,
        },
    )
    .unwrap();
    for arrangement in [Arrangement::Chain, Arrangement::Fan] {
        let stages = [
            Stage::new(&ratio).unwrap(),
            Stage::new(&other)
                .unwrap()
                .with_slip(0.03, Flow::default())
                .unwrap(),
        ];
        let drive = Drive::new(arrangement, Contact::Ideal, &stages).unwrap();
        let shafts = [0.02, 0.05, 0.03].map(|j| Shaft::new(j, 0.0));
        let run = |t: f64, y: &[f64; 4]| drive.forward(state(t, y), &shafts).unwrap();
        let start = [0.0, 0.0, 0.0, 40.0];
        let before = run(0.0, &start);
        let steps = 4000;
        let end = integrate(
            |t, y| rates(&run(t, y)),
            0.0,
            start,
            1.3 / steps as f64,
            steps,
        );
        let after = run(1.3, &end);
        let energy = before.kinetic_energy();
        assert_near(
            "energy",
            after.kinetic_energy(),
            energy,
            budget::FREE_RUN * energy,
        );
        // Neither the momentum (factor 1) nor the speed (factor 0) is conserved: both differ clearly.
        let [j0, j1] = [before.inertia, after.inertia];
        assert!(
            (end[3] * j1 / (40.0 * j0) - 1.0).abs() > 0.2,
            "momentum kept"
        );
        assert!((end[3] / 40.0 - 1.0).abs() > 0.2, "speed kept");
        assert_near(
            "ω·√J",
            end[3] * j1.sqrt(),
            40.0 * j0.sqrt(),
            budget::FREE_RUN * 40.0 * j0.sqrt(),
        );
    }
}

#[test]
fn two_shafts_by_the_formula() {
    let (i, rate, slip) = (1.4, -0.7, 0.05);
    let ratio = Ramp::linear(
        Variable::Time,
        RampShape {
            start: 0.0,
            length: 1.0,
            values: [i, i + rate],
        },
    )
    .unwrap();
    let stage = Stage::new(&ratio)
        .unwrap()
        .with_slip(slip, Flow::FirstDrives)
        .unwrap();
    let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &[stage]).unwrap();
    let (j1, j2, t1, t2, omega) = (0.04, 0.11, 30.0, 8.0, 25.0);
    let shafts = [Shaft::new(j1, t1), Shaft::new(j2, -t2)];
    let motion = drive
        .forward(
            State {
                t: 0.0,
                angles: &[0.0, 0.0],
                omega,
            },
            &shafts,
        )
        .unwrap();
    let (j, j_rate) = (i * (1.0 - slip), rate * (1.0 - slip));
    // (J1 + i·j·J2)·ω̇ + i·j′·J2·ω = T1 − i·T2, L = J2·(jω)˙ + T2, loss = L·i·ε·ω
    let alpha = (t1 - i * t2 - i * j_rate * j2 * omega) / (j1 + i * j * j2);
    let torque = j2 * (j * alpha + j_rate * omega) + t2;
    assert_near("α", motion.alpha, alpha, budget::CLOSED_FORM * alpha.abs());
    assert_near(
        "L",
        motion.contacts[0].torque,
        torque,
        budget::CLOSED_FORM * 10.0 * torque.abs(),
    );
    let loss = torque * i * slip * omega;
    assert_near(
        "loss",
        motion.loss,
        loss,
        budget::CLOSED_FORM * 10.0 * loss.abs(),
    );
}

#[test]
fn slip_slows_the_driven_shaft() {
    let at = |flow: Flow, torques: [f64; 2]| {
        let stage = Stage::new(2.0).unwrap().with_slip(0.04, flow).unwrap();
        let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &[stage]).unwrap();
        let shafts = [Shaft::new(0.1, torques[0]), Shaft::new(0.1, torques[1])];
        drive
            .forward(
                State {
                    t: 0.0,
                    angles: &[0.0, 0.0],
                    omega: 10.0,
                },
                &shafts,
            )
            .unwrap()
    };
    // As printed: the second shaft drives, the first is slower than 1/i of it.
    let printed = at(Flow::SecondDrives, [-12.0, 6.0]);
    assert_near(
        "ω2",
        printed.shafts[1].omega,
        20.0 / 0.96,
        budget::CLOSED_FORM * 20.0,
    );
    assert!(printed.loss > 0.0);
    let first = at(Flow::FirstDrives, [12.0, -6.0]);
    assert_near(
        "ω2",
        first.shafts[1].omega,
        20.0 * 0.96,
        budget::CLOSED_FORM * 20.0,
    );
    assert!(first.loss > 0.0);
    // Reverse power flow has a negative sign.
    assert!(at(Flow::SecondDrives, [12.0, -6.0]).loss < 0.0);
    assert!(at(Flow::FirstDrives, [-12.0, 6.0]).loss < 0.0);
}

/// A press with a variator that is shifted during free motion: kinetic plus potential energy is conserved.
#[test]
fn any_machine_behind_a_variator() {
    let links = [
        link_of(9.0, 0.018, [0.006, 0.0]),
        link_of(6.5, 0.03, [0.055, 0.0]),
        Link::point_mass(42.0).unwrap(),
    ];
    let press = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.03,
            rod: 0.18,
            offset: 0.0,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    let machine = Machine::new(press).with_gravity([9.81, 0.0]).unwrap();
    let ratio = shift();
    let stage = Stage::new(&ratio).unwrap();
    let drive = Drive::new(Arrangement::Chain, Contact::Ideal, &[stage]).unwrap();
    let run = |t: f64, y: &[f64; 3]| {
        let crank = machine.reduction(y[1]).unwrap();
        let shafts = [Shaft::new(0.04, 0.0), Shaft::from(crank).with_inertia(0.02)];
        (
            drive.forward(state(t, y), &shafts).unwrap(),
            crank.potential_energy,
        )
    };
    let start = [0.0, 1.0, 15.0];
    let steps = 20_000;
    let end = integrate(
        |t, y| rates(&run(t, y).0),
        0.0,
        start,
        1.5 / f64::from(steps),
        steps as usize,
    );
    let energy = |t: f64, y: &[f64; 3]| {
        let (motion, potential) = run(t, y);
        motion.kinetic_energy() + potential
    };
    let before = energy(0.0, &start);
    assert_near(
        "energy",
        energy(1.5, &end),
        before,
        budget::FREE_RUN * before.abs(),
    );
    // The crank is not at the position of the present ratio: α₂ is not j(t)·α₁.
    let drift = end[1] - (start[1] + 1.9 * end[0]);
    assert!(drift.abs() > 1.0, "{drift}");
}
