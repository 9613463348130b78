//! Andrews' squeezing mechanism against its published initial values and its published solution.

use crate::reader;
use jred::machine::Mechanism;
use jred::machine::Reducible;
use jred_analysis::simulate::simulate;
use jred_file::model::machine::MachineFile;

use super::{columns, folder};
use crate::reading::rendered;
use crate::support::{budget, within};

/// Torque of the motor on the crank (N·m), constant.
const TORQUE: f64 = 0.033;

/// The angles of the source are relative where one link carries another.
const ANGLES: [(&str, &[&str]); 7] = [
    ("K1", &["beta"]),
    ("K2", &["beta", "theta"]),
    ("K3", &["gamma"]),
    ("K4", &["phi", "delta"]),
    ("K5", &["delta"]),
    ("K6", &["omega", "epsilon"]),
    ("K7", &["epsilon"]),
];

/// The constraints are F of K2 less F of the other link: a multiplier is the force of K2 on the other.
const PINS: [(&str, [&str; 2]); 3] = [
    ("F-K3", ["lambda1", "lambda2"]),
    ("F-K4", ["lambda3", "lambda4"]),
    ("F-K6", ["lambda5", "lambda6"]),
];

fn mechanism() -> MachineFile {
    reader::read(&folder().join("andrews.toml"))
        .unwrap_or_else(|report| panic!("{}", rendered(&report)))
}

/// A published figure by the name of its quantity.
fn published(instant: &str) -> impl Fn(&str) -> f64 {
    let (names, figures) = columns("andrews.csv");
    let values = figures.get(instant);
    move |name| values[place(&names, name)]
}

fn place(names: &[String], name: &str) -> usize {
    names.iter().position(|n| n == name).unwrap()
}

#[test]
fn andrews_mechanism_has_its_published_states() {
    let file = mechanism();
    let mechanism = file.machine.mechanism();
    for (instant, [angles, speeds, accelerations]) in [
        ("t=0", [budget::PUBLISHED; 3]),
        (
            "t=0.03",
            [
                budget::PUBLISHED,
                budget::PUBLISHED_SPEED,
                budget::PUBLISHED_ACCELERATION,
            ],
        ),
    ] {
        let named = published(instant);
        let (beta, speed) = (named("beta"), named("beta'"));
        let reduced = file.machine.reduction(beta).unwrap();
        let alpha = reduced.acceleration(speed, TORQUE);
        let frames = mechanism.frames(beta).unwrap();
        for (link, parts) in ANGLES {
            let psi = frames[place(mechanism.link_names(), link)].psi;
            let fastest = alpha.abs() + named("phi''").abs();
            for (marks, found, most) in [
                ("", psi.value, angles),
                ("'", psi.velocity(speed), speeds * speed.abs()),
                (
                    "''",
                    psi.acceleration(speed, alpha),
                    accelerations * fastest,
                ),
            ] {
                let expected: f64 = parts.iter().map(|p| named(&format!("{p}{marks}"))).sum();
                within(&format!("{instant}: {link}{marks}"), found, expected, most);
            }
        }
        let forces = file.machine.forces(beta, speed, alpha).unwrap();
        within("drive", forces.drive, TORQUE, budget::CROSS_CHECK * TORQUE);
        for (pin, pair) in PINS {
            let force = forces.reactions[place(mechanism.joint_names(), pin)].force;
            for (found, name) in force.into_iter().zip(pair) {
                let most = accelerations * named("lambda1").abs();
                within(&format!("{instant}: {name}"), -found, named(name), most);
            }
        }
    }
}

#[test]
fn andrews_mechanism_arrives_where_it_is_published_to_arrive() {
    let file = mechanism();
    let run = simulate(&file, file.simulation.as_ref().unwrap())
        .unwrap()
        .whole()
        .unwrap();
    let end = run.rows().last().unwrap();
    let named = published("t=0.03");
    for (column, name, unit) in [
        ("phi [deg]", "beta", 1.0_f64.to_radians()),
        ("omega [rad/s]", "beta'", 1.0),
    ] {
        let found = end[place(&run.names(), column)].unwrap() * unit;
        let expected = named(name);
        let most = budget::PUBLISHED_MOTION * expected.abs();
        within(name, found, expected, most);
    }
}
