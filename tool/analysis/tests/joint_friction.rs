//! Friction by a coefficient in joints: duty, simulation and checks of a machine file, against the forces in the joints.

use jred::machine::{Jointed as _, Mechanism as _};
use jred_analysis::duty::Duty;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_file::model::machine::MachineFile;

use crate::reading::{parse, refuses, text_of};
use crate::simulate::{imbalance, simulate};
use crate::support::{edited, near, press_text, within};

/// μ, and radius or length, of the press's joints.
const CRANK_PIVOT: [f64; 2] = [0.08, 0.03];
const GUIDE: [f64; 2] = [0.12, 0.15];
const PRELOAD: f64 = 40.0;

/// The press with friction by coefficients, an offset and lateral load: its guide carries a moment, too.
fn text() -> String {
    let press = edited(&press_text(), "offset = \"0 mm\"", "offset = \"6 mm\"");
    let press = edited(
        &press,
        "opposing_force = \"150 N\"",
        "force = [\"0 N\", \"300 N\"]\nat = [\"20 mm\", \"0 mm\"]",
    );
    let [[mu, radius], [coefficient, length]] = [CRANK_PIVOT, GUIDE];
    format!(
        "{press}
[[friction]]
joint = \"crank pivot\"
coefficient = {mu}
pin_radius = \"{radius} m\"
[[friction]]
joint = \"guide\"
coefficient = {coefficient}
guide_length = \"{length} m\"
preload = \"{PRELOAD} N\"
"
    )
}

/// The drive's torque against the friction, from the forces in the joints.
fn by_forces(file: &MachineFile, [phi, omega, alpha]: [f64; 3]) -> f64 {
    let mechanism = file.machine.mechanism();
    let frames = mechanism.frames(phi).unwrap();
    let joints = mechanism.joints(phi, &frames).unwrap();
    let forces = file.machine.forces(phi, omega, alpha).unwrap();
    let slope = |k: usize| joints[k].coordinate(&frames).d1.abs();
    let [x, y] = forces.reactions[0].force;
    let pivot = CRANK_PIVOT[0] * CRANK_PIVOT[1] * x.hypot(y) * slope(0);
    let guide = &forces.reactions[3];
    let pads = guide.force[1]
        .abs()
        .max(2.0 * guide.moment.abs() / GUIDE[1]);
    let rubbing = GUIDE[0] * (pads + PRELOAD);
    // The force along the guide is its friction, except at the very dead centre.
    if slope(3) > 1e-11 {
        within("friction", guide.force[0].abs(), rubbing, 1e-9 * rubbing);
    }
    omega.signum() * (pivot + rubbing * slope(3))
}

/// Every instant has the friction of its own acceleration; over the cycle the work of the drive is that of friction, loads and losses.
#[test]
fn duty_follows_the_forces_and_balances() {
    let file = parse(&text()).unwrap();
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 500).unwrap();
    let mut greatest = 0.0f64;
    for instant in duty.instants.iter().filter(|i| i.omega != 0.0) {
        let state = [instant.phi, instant.omega, instant.alpha];
        let expected = by_forces(&file, state);
        within(
            "T_f",
            instant.joint_friction,
            expected,
            1e-9 * expected.abs(),
        );
        greatest = greatest.max(expected.abs());
    }
    assert!(greatest > 10.0, "{greatest}");
    let train = file.drive_train.ratio();
    let work = duty.integral(|i| i.input_torque * i.input_speed);
    let loads = duty.integral(|i| {
        let terms = &i.terms;
        (terms.process + terms.viscous + terms.coulomb) * i.omega
    });
    let lost = duty.integral(|i| {
        let link = i.terms.total() + file.train_inertia() * i.alpha;
        i.input_torque * i.input_speed - link * i.omega
    });
    assert!(train > 1.0 && lost > 0.0);
    near("work", work, loads + lost, 1e-7);
    // The table of the command has the same terms.
    let request = Request {
        over: Over::Time,
        positions: 41,
        sets: Sets {
            curves: true,
            ..Sets::default()
        },
        state: None,
    };
    let columns = reduce(&file, &request).unwrap();
    let at = |name: &str| {
        columns
            .names()
            .iter()
            .position(|n| n.starts_with(name))
            .unwrap()
    };
    let [phi, coulomb] = [at("phi"), at("T_drive coulomb")];
    let [omega, alpha] = [at("omega"), at("alpha")];
    for row in columns.rows() {
        let value = |k: usize| row[k].unwrap();
        if value(omega) != 0.0 {
            let motion = file.motion.as_ref().unwrap();
            let state = motion.at(row[0].unwrap());
            assert!(value(phi).is_finite() && value(alpha).is_finite());
            let expected = by_forces(&file, [state.phi, state.omega, state.alpha]);
            within("coulomb", value(coulomb), expected, 1e-9 * greatest);
        }
    }
}

/// d'Alembert's forces and the reduced equation agree, and so do work and energy, with friction in both.
#[test]
fn check_holds_with_friction() {
    let file = parse(&text()).unwrap();
    let findings = Findings::of(&file).unwrap();
    assert!(findings.holds(), "{:?}", findings.violations());
    assert!(findings.agreement.energy.unwrap() < 1e-9);
    assert!(
        findings
            .warnings
            .iter()
            .any(|w| w.contains("emergency stops")),
        "{:?}",
        findings.warnings
    );
}

/// What the motor gives in a simulation is what the motion needs: inverse of forward dynamics; and energy is balanced.
#[test]
fn simulation_is_the_inverse_of_the_duty() {
    let text = edited(&text(), "at = \"motor\"", "at = \"crank\"");
    let text = edited(
        &text,
        "rotor_inertia = \"200 kg cm^2\"",
        "rotor_inertia = \"0 kg cm^2\"",
    );
    let text = edited(
        &text,
        "60 N m\"], [\"500 rpm\", \"45 N m\"], [\"800 rpm\"",
        "260 N m\"], [\"150 rpm\", \"150 N m\"], [\"300 rpm\"",
    );
    let (before, after) = text.split_once("# Toothed belt").unwrap();
    let (_, rest) = after.split_once("# One turn").unwrap();
    let text = format!("{before}# One turn{rest}");
    let file = parse(&text).unwrap();
    let columns = simulate(&text);
    assert!(imbalance(&columns) < 1e-9, "{:e}", imbalance(&columns));
    let [phi, omega, alpha] =
        ["phi [deg]", "omega [rad/s]", "alpha [rad/s^2]"].map(|n| columns.get(n));
    let torque = columns.get("motor torque [N m]");
    let mut moving = 0;
    for k in 0..phi.len() {
        let (phi, omega) = (phi[k].to_radians(), omega[k]);
        if omega.abs() > 1e-3 {
            moving += 1;
            let needed = file.machine.torque(phi, omega, alpha[k]).unwrap().total();
            within("T", torque[k], needed, 1e-9 * 260.0);
        }
    }
    assert!(moving > 300, "{moving}");
    // Frictionless it is faster.
    let free = edited(&text, "coefficient = 0.12", "coefficient = 0");
    let free = simulate(&edited(&free, "coefficient = 0.08", "coefficient = 0"));
    let work = free.get("losses [J]");
    assert!(work.last().unwrap() < columns.get("losses [J]").last().unwrap());
}

/// A screw axis with the weight across its guide: F = μ·(m·g·cos β + P).
#[test]
fn guide_of_an_inclined_axis() {
    let text = text_of("vertical-axis.toml");
    let text = edited(
        &text,
        "inclination = \"90 deg\"",
        "inclination = \"30 deg\"",
    );
    let friction = "[[friction]]\njoint = \"nut guide\"\ncoefficient = 0.05\nguide_length = \"200 mm\"\npreload = \"80 N\"\n";
    let file = parse(&edited(&text, "[[load]]", &format!("{friction}[[load]]"))).unwrap();
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 200).unwrap();
    let normal = 62.0 * 9.81 * f64::cos(std::f64::consts::FRAC_PI_6) + 80.0;
    let expected = 0.05 * normal * 0.01 / std::f64::consts::TAU;
    for instant in duty.instants.iter().filter(|i| i.omega != 0.0) {
        within("T_f", instant.joint_friction.abs(), expected, 1e-12);
        assert!(instant.joint_friction * instant.omega > 0.0);
    }
}

#[test]
fn a_jammed_joint_and_a_variator_are_refused() {
    let steep = edited(&text(), "length = \"180 mm\"", "length = \"40 mm\"");
    refuses(
        &edited(&steep, "coefficient = 0.12", "coefficient = 0.9"),
        &[
            "friction jams the mechanism at φ",
            "joint 3 is \"guide\"",
            "lower its coefficient",
        ],
    );
    let text = text_of("variator-press.toml");
    let friction = "[[friction]]\njoint = \"crank pivot\"\ncoefficient = 0.1\npin_radius = \"20 mm\"\n[[drive_train]]";
    let text = edited(&text, "[[drive_train]]", friction);
    let why = crate::simulate::run(&text).err().unwrap();
    assert!(
        why.contains("friction by a coefficient") && why.contains("joint 0"),
        "{why}"
    );
}
