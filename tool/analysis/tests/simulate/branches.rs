//! Branches beside the chain of the drive train: each with its own direction of power.

use super::{J, imbalance, run, simulate, turntable};
use crate::reading::{parse, says};
use crate::support::{budget, edited, near, phrases, rows, within};
use jred::friction::{Arrangement, Contact, Drive, Flow, Shaft, Stage, State};
use jred::mechanism::TrainOutput;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;

/// A belt from the motor, and two rollers on friction wheels beside the drive link's shaft.
const FAN: &str = r#"
[[drive_train]]
type = "belt"
driver = { radius = "20 mm", inertia = "0.0003 kg m^2" }
driven = { radius = "60 mm", inertia = "0.004 kg m^2" }
efficiency = 0.9
[[drive_train.branch]]
name = "first roller"
type = "friction"
ratio = -2
slip = "4 %"
input_inertia = "0.001 kg m^2"
output_inertia = "0.002 kg m^2"
inertia = "0.003 kg m^2"
opposing_moment = "0.5 N m"
viscous_moment = "0.02 N m s/rad"
[[drive_train.branch]]
type = "belt"
driver = { radius = "50 mm", inertia = "0.0005 kg m^2" }
driven = { radius = "40 mm", inertia = "0.006 kg m^2" }
efficiency = "80 %"
"#;

/// One branch and its shaft: ratio j of its speed, efficiency, inertia at its end, and friction there.
fn side(
    [j, eta, inertia]: [f64; 3],
    [opposing, viscous]: [f64; 2],
    [omega, alpha]: [f64; 2],
) -> f64 {
    let own = j * omega;
    let torque = inertia * j * alpha + opposing * own.signum() + viscous * own;
    if torque * own >= 0.0 {
        torque * j / eta
    } else {
        torque * j * eta
    }
}

/// The whole by hand: link, both branches, the belt.
fn by_hand(asked: f64, omega: f64, alpha: f64) -> f64 {
    let first = side([-2.0 * 0.96, 0.96, 0.005], [0.5, 0.02], [omega, alpha]);
    let second = side([1.25, 0.8, 0.006], [0.0; 2], [omega, alpha]);
    let shaft = asked + first + second + (0.001 + 0.0005 + 0.004) * alpha;
    let through = if shaft * omega >= 0.0 {
        shaft / 0.9
    } else {
        shaft * 0.9
    };
    through / 3.0 + 0.0003 * 3.0 * alpha
}

fn file(more: &str) -> MachineFile {
    let motion = "duration = \"1 s\"\noutput_step = \"0.1 s\"\ntorque = \"1 N m\"";
    parse(&turntable(more, motion)).unwrap()
}

/// Driving and braking, forward and backward; while the machine brakes, one branch feeds back and the other still takes power.
#[test]
fn each_branch_has_its_own_direction_of_power() {
    let train = file(FAN).drive_train;
    let mut flows = std::collections::BTreeSet::new();
    for omega in [-12.0, 7.0f64] {
        for alpha in [-400.0, -90.0, -20.0, 3.0, 20.0, 90.0, 400.0f64] {
            for asked in [-3.0, 0.4, 6.0] {
                let at = |alpha: f64| {
                    let output = TrainOutput {
                        torque: asked + J * alpha,
                        torque_per_alpha: J,
                        omega,
                        alpha,
                        direction: omega,
                    };
                    train.input(&output)
                };
                let expected = by_hand(asked + J * alpha, omega, alpha);
                near("torque", at(alpha).torque, expected, 1e-14);
                let slope = (at(alpha + 1e-3).torque - at(alpha - 1e-3).torque) / 2e-3;
                near("slope", at(alpha).torque_per_alpha, slope, 1e-8);
                // The input comes out, is lost, or accelerates.
                let inner =
                    0.0003 * 9.0 + 0.004 + 0.001 + 0.005 * 1.92 * 1.92 + 0.0005 + 0.006 * 1.5625;
                let power = at(alpha).torque * 3.0 * omega;
                let out = (asked + J * alpha + inner * alpha) * omega;
                within("power", power - out, at(alpha).loss, 1e-10);
                assert!(at(alpha).loss > 0.0);
                let feeds = |j: f64, inertia: f64, friction: f64| {
                    inertia * j.abs() * alpha * omega.signum() + friction < 0.0
                };
                flows.insert((
                    feeds(1.92, 0.005, 0.5 + 0.02 * 1.92 * omega.abs()),
                    feeds(1.25, 0.006, 0.0),
                ));
            }
        }
    }
    assert_eq!(flows.len(), 3, "{flows:?}");
    let inner = 0.0003 + (0.004 + 0.001 + 0.005 * 1.92 * 1.92 + 0.0005 + 0.006 * 1.5625) / 9.0;
    near("inertia", train.inertia_at_input(), inner, 1e-15);
}

/// Against the library's friction drive, which knows shafts and contact forces: a fan, and a chain in the drive train.
#[test]
fn fans_and_chains_are_those_of_the_library() {
    let wheels = [(-2.0, 0.04), (1.5, 0.02), (0.7, 0.0)];
    let inertias = [0.002, 0.004, 0.01];
    let table = |head: &str, k: usize| {
        let ((ratio, slip), inertia) = (wheels[k], inertias[k]);
        format!(
            "{head}\ntype = \"friction\"\nratio = {ratio:?}\nslip = \"{} %\"\ninput_inertia = \"0 kg m^2\"\noutput_inertia = \"{inertia} kg m^2\"\n",
            slip * 100.0
        )
    };
    let stages: Vec<Stage> = (wheels.iter())
        .map(|(i, slip)| {
            Stage::new(*i)
                .unwrap()
                .with_slip(*slip, Flow::FirstDrives)
                .unwrap()
        })
        .collect();
    let state = |angles| State {
        t: 0.0,
        angles,
        omega: 9.0,
    };
    let alpha = 25.0;

    let belt = "[[drive_train]]\ntype = \"belt\"\ndriver = { radius = \"20 mm\", inertia = \"0 kg m^2\" }\ndriven = { radius = \"20 mm\", inertia = \"0 kg m^2\" }\n";
    let fan: String = (0..3)
        .map(|k| table("[[drive_train.branch]]", k) + "opposing_moment = \"0.3 N m\"\n")
        .collect();
    let shafts: Vec<Shaft> = [(J, 0.0)]
        .into_iter()
        .chain(inertias.map(|inertia| (inertia, 0.3)))
        .map(|(inertia, coulomb)| Shaft {
            coulomb,
            ..Shaft::new(inertia, 0.0)
        })
        .collect();
    let drive = Drive::new(Arrangement::Fan, Contact::Slipping, &stages).unwrap();
    let expected = drive.inverse(state(&[0.0; 4]), alpha, &shafts).unwrap();
    let found = file(&format!("{belt}{fan}"))
        .drive_train
        .input(&TrainOutput {
            torque: J * alpha,
            omega: 9.0,
            alpha,
            direction: 9.0,
            ..TrainOutput::default()
        });
    near("fan", found.torque, expected.drive, 1e-13);
    let friction: f64 = expected
        .shafts
        .iter()
        .skip(1)
        .map(|s| 0.3 * s.omega.abs())
        .sum();
    near(
        "losses of the fan",
        found.loss,
        expected.loss + friction,
        1e-13,
    );

    // The chain from the motor to the link, which is its last shaft.
    let chain: String = (0..3).map(|k| table("[[drive_train]]", k)).collect();
    let train = file(&chain).drive_train;
    let drive = Drive::new(Arrangement::Chain, Contact::Slipping, &stages).unwrap();
    let shafts: Vec<Shaft> = [0.0, inertias[0], inertias[1], inertias[2] + J]
        .map(|inertia| Shaft::new(inertia, 0.0))
        .to_vec();
    let expected = drive.inverse(state(&[0.0; 4]), alpha, &shafts).unwrap();
    let last = expected.shafts[3];
    let found = train.input(&TrainOutput {
        torque: J * last.alpha,
        omega: last.omega,
        alpha: last.alpha,
        direction: last.omega,
        ..TrainOutput::default()
    });
    near("chain", found.torque, expected.drive, 1e-13);
    near("ratio", train.ratio(), 9.0 / last.omega, 1e-14);
    near("losses of the chain", found.loss, expected.loss, 1e-13);
}

/// A constant torque without viscous friction: constant acceleration, and the energy balance with every loss.
#[test]
fn a_fan_accelerates_as_by_hand() {
    let steady = edited(FAN, "viscous_moment = \"0.02 N m s/rad\"\n", "");
    let found = simulate(&turntable(
        &steady,
        "duration = \"1 s\"\noutput_step = \"0.1 s\"\ntorque = \"3 N m\"\nrotor_inertia = \"0.0002 kg m^2\"",
    ));
    // 3·0.9·(3 − (0.0003 + 0.0002)·3·α) = J·α + (0.0055)·α + 1.92/0.96·(0.005·1.92·α + 0.5) + 1.25/0.8·0.006·1.25·α
    let inertia = J + 0.0055 + 2.0 * 0.005 * 1.92 + 1.25 * 1.25 * 0.006 / 0.8 + 2.7 * 0.0005 * 3.0;
    let alpha = (2.7 * 3.0 - 2.0 * 0.5) / inertia;
    let end = *found.get("omega [rad/s]").last().unwrap();
    near("omega", end, alpha, budget::CLOSED_MOTION);
    assert!(imbalance(&found) <= budget::BALANCE);
    // With the viscous friction, and coasting to rest.
    let coasting = simulate(&turntable(
        FAN,
        "duration = \"1 s\"\noutput_step = \"0.01 s\"\ntorque = \"0 N m\"\nstart_speed = \"60 rpm\"",
    ));
    assert!(imbalance(&coasting) <= budget::BALANCE);
    let rest = *coasting.get("omega [rad/s]").last().unwrap();
    within("at rest", rest, 0.0, 1e-12);
}

/// The motor torque of sizing equals that by hand, through acceleration and braking.
#[test]
fn the_duty_is_that_by_hand() {
    let motion = r#"
[motion]
type = "cycle"
[[motion.segment]]
law = "modified-sine"
move = "720 deg"
duration = "0.5 s"
[[motion.segment]]
dwell = "0.2 s"
"#;
    let file = file(&format!("{FAN}{motion}"));
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 400).unwrap();
    let (mut driving, mut back) = (0, 0);
    for instant in duty.instants.iter().filter(|i| i.omega != 0.0) {
        let expected = by_hand(J * instant.alpha, instant.omega, instant.alpha);
        within("torque", instant.input_torque, expected, 1e-12);
        driving += usize::from(expected > 0.0);
        back += usize::from(expected < 0.0);
    }
    assert!(driving > 100 && back > 100, "{driving} {back}");
}

#[test]
fn wrong_branches_are_refused() {
    let table = turntable(
        FAN,
        "duration = \"1 s\"\noutput_step = \"0.1 s\"\ntorque = \"1 N m\"",
    );
    let cases = r#"
        type = "friction" => type = "rack" => "rack" | "friction"
        ratio = -2 => ratio = 0 => `ratio` | is 0, too close to zero
        slip = "4 %" => slip = "100 %" => must be below 100 %
        inertia = "0.003 kg m^2"\n => inertia = "-1 kg m^2"\n => `inertia` | negative
        name = "first roller" => at = "middle" => "middle" | "driven", "driver"
        opposing_moment = "0.5 N m" => moment = "0.5 N m" => unknown key `moment` | [[drive_train.branch]]
    "#;
    for [from, to, words] in rows(cases) {
        match run(&edited(&table, &from, &to)) {
            Err(message) => says(&message, &phrases(&words)),
            Ok(_) => panic!("simulated, though the report should contain {words:?}"),
        }
    }
    let before = edited(&table, "name = \"first roller\"", "at = \"driver\"");
    let train = parse(&before).unwrap().drive_train;
    let [shaft, behind] = [0, 1].map(|k| train.branches()[k].shaft);
    assert_eq!([shaft, behind], [0, 1]);
}
