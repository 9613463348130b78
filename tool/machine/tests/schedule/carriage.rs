//! `[[carriage]]`: a mass whose place on its link is prescribed in time.

use std::f64::consts::TAU;
use std::path::Path;

use jred::machine::Mechanism as _;
use jred_machine::analysis::inspect::Findings;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::schedule::Now;
use jred_machine::read;

use super::duty;
use crate::support::{near, within};

const MASS: f64 = 3.0;

/// An arm of 2 kg·m² that turns in a horizontal plane at constant speed, with a carriage that goes out and comes back.
const ARM: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "2 m", mass = "4 kg" }
"#;

/// A slider-crank in a vertical plane, whose rod carries a carriage on a guide that leans against it.
fn rod(carriage: &str) -> String {
    format!(
        r#"
gravity = ["3 m/s^2", "-9 m/s^2"]
[mechanism]
type = "slider-crank"
crank = {{ length = "90 mm", mass = "1 kg", inertia = "20 kg cm^2" }}
rod = {{ length = "300 mm", mass = "0.8 kg", inertia = "80 kg cm^2", com = ["120 mm", "0 mm"] }}
slider = {{ mass = "4 kg" }}
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "360 deg"
duration = "0.8 s"
[[motion.segment]]
dwell = "0.2 s"
{carriage}
"#
    )
}

const LEANING: &str = r#"
[[carriage]]
name = "tool slide"
on = "rod"
mass = "3 kg"
inertia = "0.02 kg m^2"
at = ["60 mm", "30 mm"]
direction = "25 deg"
stroke = ["0 mm", "150 mm"]
[carriage.motion]
type = "cycle"
start = "10 mm"
[[carriage.motion.segment]]
law = "modified-sine"
move = "130 mm"
duration = "0.45 s"
[[carriage.motion.segment]]
dwell = "0.1 s"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "-130 mm"
duration = "0.35 s"
"#;

fn parse(text: &str) -> MachineFile {
    read::parse("machine.toml", text, Path::new("")).unwrap()
}

/// Kinetic and potential energy of the carriage, from where it is alone: its place at (φ, t) is written down anew, and its speeds are
/// differences of places.
fn energy(file: &MachineFile, phi: f64, omega: f64, t: f64) -> [f64; 2] {
    let carriage = &file.schedule.carriages()[0];
    let place = |phi: f64, t: f64| {
        let frame = file.machine.mechanism().frames(phi).unwrap()[1];
        let s = carriage.motion.at(t).phi;
        let (psi, lean) = (frame.psi.value, 25f64.to_radians());
        let [u, v] = [0.06 + s * lean.cos(), 0.03 + s * lean.sin()];
        [
            frame.x.value + u * psi.cos() - v * psi.sin(),
            frame.y.value + u * psi.sin() + v * psi.cos(),
            psi,
        ]
    };
    // Of fourth order, so that differences of its results keep their digits.
    let h = 2e-4;
    let [a, b, c, d] = [2.0, 1.0, -1.0, -2.0].map(|k| place(phi + k * h * omega, t + k * h));
    let speed = [0, 1, 2].map(|k| (8.0 * (b[k] - c[k]) - (a[k] - d[k])) / (12.0 * h));
    let kinetic =
        0.5 * MASS * (speed[0].powi(2) + speed[1].powi(2)) + 0.5 * 0.02 * speed[2].powi(2);
    let here = place(phi, t);
    [kinetic, -MASS * (3.0 * here[0] - 9.0 * here[1])]
}

/// Lagrange's equation of the carriage, d/dt(∂E/∂ω) − ∂E/∂φ + ∂U/∂φ, by differences of energies of places.
fn lagrange(file: &MachineFile, t: f64) -> f64 {
    let motion = file.motion.as_ref().unwrap();
    // Exact for a quadratic form, and of fourth order.
    let (d, e) = (0.5, 5e-4);
    let momentum = |t: f64| {
        let state = motion.at(t);
        let kinetic = |by: f64| energy(file, state.phi, state.omega + by, t)[0];
        (kinetic(d) - kinetic(-d)) / (2.0 * d)
    };
    let [a, b, c, f] = [2.0, 1.0, -1.0, -2.0].map(|k| momentum(t + k * e));
    let rate = (8.0 * (b - c) - (a - f)) / (12.0 * e);
    let state = motion.at(t);
    let slope = |k: usize| {
        let at = |by: f64| energy(file, state.phi + by, state.omega, t)[k];
        let h = 1e-3;
        (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
    };
    rate - slope(0) + slope(1)
}

/// The torque that a carriage adds is that of Lagrange's equation with its place prescribed in time, (B) of the theory.
#[test]
fn its_torque_is_lagranges() {
    let file = parse(&rod(LEANING));
    let bare = parse(&rod(""));
    let motion = file.motion.as_ref().unwrap();
    let (mut largest, mut relative) = (0.0f64, 0.0f64);
    for k in 0..40 {
        // Away from the corners of both motions.
        let t = 0.013 + 0.76 * f64::from(k) / 40.0;
        if [0.45, 0.55].iter().any(|corner| (t - corner).abs() < 6e-3) {
            continue;
        }
        let state = motion.at(t);
        let now = Now::of(t, state.omega);
        let torque = |file: &MachineFile| {
            let machine = file.machine_at(&now, state.phi).unwrap();
            let forces = machine.forces(state.phi, state.omega, state.alpha).unwrap();
            let reduced = file.bare_reduction_at(&now, state.phi).unwrap();
            let reduced = reduced.torque(state.omega, state.alpha).total();
            within("d'Alembert", forces.drive, reduced, 1e-9);
            reduced
        };
        let added = torque(&file) - torque(&bare);
        let machine = file.machine_at(&now, state.phi).unwrap();
        let own = file.carriage_torque(&machine, state.phi).unwrap();
        let expected = lagrange(&file, t);
        assert!(
            (added - expected).abs() < 2e-6,
            "t = {t}: {added} {expected}"
        );
        (largest, relative) = (largest.max(expected.abs()), relative.max(own.abs()));
    }
    // What its own motion adds is no rounding.
    assert!(largest > 1.0 && relative > 0.2, "{largest} {relative}");
}

/// Along a turning arm at constant speed: d(J·ω)/dt = T, so T = 2·m·r·ṙ·ω.
#[test]
fn on_a_turning_arm_the_momentum_changes() {
    let text = format!(
        r#"{ARM}
[motion]
type = "constant-speed"
speed = "60 rpm"
[[carriage]]
on = "table"
mass = "3 kg"
at = ["0.2 m", "0 mm"]
stroke = ["0 mm", "800 mm"]
[carriage.motion]
type = "cycle"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "800 mm"
duration = "0.4 s"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "-800 mm"
duration = "0.6 s"
"#
    );
    let file = parse(&text);
    let found = duty(&file);
    let carriage = &file.schedule.carriages()[0];
    let mut most = 0.0f64;
    for i in &found.instants {
        let state = carriage.motion.at(i.t);
        let r = 0.2 + state.phi;
        let expected = 2.0 * MASS * r * state.omega * TAU;
        within("torque", i.terms.total(), expected, 1e-9);
        near("inertia", i.inertia, 2.0 + MASS * r * r, 1e-12);
        most = most.max(expected.abs());
    }
    assert!(most > 50.0);
    // Angular momentum comes back with the cycle.
    within("momentum", found.integral(|i| i.terms.total()), 0.0, 1e-6);
    // The cross slide of a rotary table: s̈ across the arm is a torque of its own.
    let across = parse(&text.replace("stroke =", "direction = \"90 deg\"\nstroke ="));
    let carriage = &across.schedule.carriages()[0];
    for i in &duty(&across).instants {
        let s = carriage.motion.at(i.t);
        let expected = MASS * (0.2 * s.alpha + 2.0 * s.phi * s.omega * TAU);
        within("across", i.terms.total(), expected, 1e-9);
    }
}

/// The drive's work and that of the second axis are the gain of energy, and d'Alembert's torque is the reduced one.
#[test]
fn energy_balances_with_the_second_axis() {
    let found = Findings::of(&parse(&rod(LEANING))).unwrap();
    assert!(found.agreement.dalembert < 1e-10, "{:?}", found.agreement);
    assert!(
        found.agreement.energy.unwrap() < 1e-9,
        "{:?}",
        found.agreement
    );
}

/// At rest it holds the carriage wherever it goes: an arm that stands upright and level by turns.
#[test]
fn it_is_held_where_it_is() {
    let text = format!(
        r#"{}
[motion]
type = "cycle"
[[motion.segment]]
dwell = "1 s"
[[carriage]]
on = "table"
mass = "3 kg"
stroke = ["0 mm", "800 mm"]
[carriage.motion]
type = "cycle"
[[carriage.motion.segment]]
law = "modified-sine"
move = "800 mm"
duration = "0.3 s"
[[carriage.motion.segment]]
law = "modified-sine"
move = "-800 mm"
duration = "0.3 s"
"#,
        ARM.replace("\"0 m/s^2\"]", "\"-10 m/s^2\"]")
    );
    let found = duty(&parse(&text));
    near("holding", found.hold_torque, MASS * 10.0 * 0.8, 1e-9);
    // After its own motion it stands.
    let last = found.instants.last().unwrap();
    within("stands", last.terms.total(), 0.0, 1e-12);
}

/// What cannot be is refused with its place.
#[test]
fn contradictions_are_refused() {
    let refused = |from: &str, to: &str| {
        let text = rod(&LEANING.replacen(from, to, 1));
        format!(
            "{:?}",
            read::parse("machine.toml", &text, Path::new("")).unwrap_err()
        )
    };
    for (from, to, words) in [
        (
            "duration = \"0.35 s\"",
            "duration = \"0.5 s\"",
            "lasts 1.05 s",
        ),
        ("move = \"-130 mm\"", "move = \"-120 mm\"", "10 mm"),
        (
            "move = \"130 mm\"",
            "move = \"145 mm\"",
            "leaves the stroke",
        ),
        ("on = \"rod\"", "on = \"rot\"", "rod"),
        ("type = \"cycle\"", "type = \"constant-speed\"", "cycle"),
        ("mass = \"3 kg\"", "mass = \"0 kg\"", "mass"),
        ("duration = \"0.45 s\"", "", "[[carriage.motion.segment]]"),
    ] {
        let found = refused(from, to);
        assert!(found.contains(words), "{from}: {found}");
    }
    let (_, without) = LEANING.split_once("[[carriage]]").unwrap();
    let text = format!("gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n{}", {
        let machine = rod("");
        let (machine, _) = machine.split_once("[motion]").unwrap();
        let (_, machine) = machine.split_once("[mechanism]").unwrap();
        format!("[mechanism]{machine}[[carriage]]{without}")
    });
    let found = format!(
        "{:?}",
        read::parse("machine.toml", &text, Path::new("")).unwrap_err()
    );
    assert!(found.contains("has no [motion]"), "{found}");
}
