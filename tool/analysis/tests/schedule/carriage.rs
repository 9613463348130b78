//! `[[carriage]]`: a mass whose place on its link is prescribed in time.

use std::f64::consts::TAU;
use std::path::Path;

use crate::reader;
use jred::machine::Mechanism as _;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::columns::Columns;

use super::duty;
use crate::support::{near, rows, within};

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
    reader::parse("machine.toml", text, Path::new("")).unwrap()
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
        let now = ScheduleInstant::of(t, state.omega);
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
    // Its own motion adds more than rounding.
    assert!(largest > 1.0 && relative > 0.2, "{largest} {relative}");
}

/// A carriage that goes out along the arm and comes back while it makes one turn.
const OUT_AND_BACK: &str = r#"
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
"#;

/// Rows over the time of the motion, and the numbers of a column.
fn over_time(file: &MachineFile) -> (Columns, impl Fn(&Columns, &str) -> Vec<f64>) {
    let request = Request {
        over: Over::Time,
        positions: 97,
        sets: Sets {
            curves: true,
            links: true,
            ..Sets::default()
        },
        state: None,
    };
    let columns = reduce(file, &request).unwrap();
    let pick = |columns: &Columns, name: &str| {
        let k = columns.names().iter().position(|known| known == name);
        let k = k.unwrap_or_else(|| panic!("{name}: {:?}", columns.names()));
        columns.rows().iter().map(|row| row[k].unwrap()).collect()
    };
    (columns, pick)
}

/// The force of the carriage's own axis, on an arm that turns evenly under gravity: s̈ − r·ω² along the guide and its weight; what the arm's
/// drive must do: 2·m·r·ṙ·ω and the weight's lever. J is 2 kg·m² and m·r².
#[test]
fn columns_size_the_second_axis() {
    let arm = ARM.replace("\"0 m/s^2\"]", "\"-9 m/s^2\"]");
    let file = parse(&format!("{arm}{OUT_AND_BACK}"));
    let (columns, pick) = over_time(&file);
    let part = |symbol: &str| pick(&columns, &format!("carriage on table {symbol}"));
    let (places, speeds) = (part("s [m]"), part("v [m/s]"));
    let (accelerations, forces) = (part("a [m/s^2]"), part("F [N]"));
    let [times, torques, whole] =
        ["t [s]", "T_drive [N m]", "J_red [kg m^2]"].map(|name| pick(&columns, name));
    let [table, own] = ["table", "carriage on table"]
        .map(|part| pick(&columns, &format!("J_red {part} [kg m^2]")));
    let (mut farthest, mut fastest) = (0.0f64, 0.0f64);
    for (k, t) in times.iter().enumerate() {
        // The law 3-4-5 of the move out, h·(10·z³ − 15·z⁴ + 6·z⁵), and back.
        let (z, h, from, lasts) = if *t < 0.4 {
            (t / 0.4, 0.8, 0.0, 0.4)
        } else {
            ((t - 0.4) / 0.6, -0.8, 0.8, 0.6)
        };
        let s = from + h * z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z);
        let v = h / lasts * 30.0 * z * z * (1.0 - z).powi(2);
        let a = h / (lasts * lasts) * 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z);
        within("s", places[k], s, 1e-12);
        within("v", speeds[k], v, 1e-11);
        within("a", accelerations[k], a, 1e-9);
        let r = 0.2 + s;
        let (sin, cos) = (TAU * t).sin_cos();
        within("F", forces[k], MASS * (a - r * TAU * TAU + 9.0 * sin), 1e-8);
        let torque = 2.0 * MASS * r * v * TAU + MASS * 9.0 * r * cos;
        within("T", torques[k], torque, 1e-8);
        within("J table", table[k], 2.0, 1e-12);
        within("J own", own[k], MASS * r * r, 1e-11);
        within("J", whole[k], table[k] + own[k], 1e-12);
        (farthest, fastest) = (farthest.max(s), fastest.max(v.abs()));
    }
    assert!(farthest > 0.79 && fastest > 3.0, "{farthest} {fastest}");
}

/// Its force does the work that its own energy and the arm's drive do not: both powers are the rate of the whole energy.
#[test]
fn both_drives_give_the_energy() {
    let file = parse(&rod(LEANING));
    let (columns, pick) = over_time(&file);
    let part = |symbol: &str| pick(&columns, &format!("tool slide {symbol}"));
    let [force, speed] = ["F [N]", "v [m/s]"].map(part);
    let motion = file.motion.as_ref().unwrap();
    let energy = |t: f64| {
        let [kinetic, potential] = energy(&file, motion.at(t).phi, motion.at(t).omega, t);
        let bare = parse(&rod("")).bare_reduction(motion.at(t).phi).unwrap();
        let own = 0.5 * bare.inertia * motion.at(t).omega.powi(2) + bare.potential_energy;
        kinetic + potential + own
    };
    let [torque, omega] = ["T_drive [N m]", "omega [rad/s]"].map(|name| pick(&columns, name));
    let mut most = 0.0f64;
    for (k, t) in pick(&columns, "t [s]").into_iter().enumerate() {
        // Away from the corners of both motions.
        let corners = [0.0, 0.45, 0.55, 0.8, 0.9, 1.0];
        if corners.iter().any(|corner| (t - corner).abs() < 4e-3) {
            continue;
        }
        let e = 1e-3;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| energy(t + k * e));
        let rate = (8.0 * (c - b) - (d - a)) / (12.0 * e);
        let power = torque[k] * omega[k] + force[k] * speed[k];
        assert!((power - rate).abs() < 2e-5, "t = {t}: {power} {rate}");
        most = most.max((force[k] * speed[k]).abs());
    }
    assert!(most > 5.0, "{most}");
}

/// `jred check` counts it: over the time of the motion, J is that of the arm and m·r².
#[test]
fn the_check_counts_it() {
    let file = parse(&format!("{ARM}{OUT_AND_BACK}"));
    let inertia = Findings::of(&file).unwrap().inertia;
    let [least, mean, largest] = inertia.laden.unwrap();
    within("least", least, 2.0 + MASS * 0.04, 1e-12);
    within("largest", largest, 2.0 + MASS, 1e-12);
    // ∫(0.2 + 0.8·p(z))²dz of p = 10·z³ − 15·z⁴ + 6·z⁵: ∫p = ½, ∫p² = 181/462.
    let square = 0.04 + 0.16 + 0.64 * 181.0 / 462.0;
    within("mean", mean, 2.0 + MASS * square, 1e-4);
    for own in inertia.reduced {
        within("of the arm alone", own, 2.0, 1e-12);
    }
    let bare = parse(&rod(""));
    assert!(Findings::of(&bare).unwrap().inertia.laden.is_none());
}

/// Along a turning arm at constant speed: d(J·ω)/dt = T, so T = 2·m·r·ṙ·ω.
#[test]
fn on_a_turning_arm_the_momentum_changes() {
    let text = format!("{ARM}{OUT_AND_BACK}");
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

/// An impossible carriage is refused with its place.
#[test]
fn contradictions_are_refused() {
    let refused = |from: &str, to: &str| {
        let text = rod(&LEANING.replacen(from, to, 1));
        format!(
            "{:?}",
            reader::parse("machine.toml", &text, Path::new("")).unwrap_err()
        )
    };
    let cases = r#"
        duration = "0.35 s" => duration = "0.5 s" => lasts 1.05 s
        move = "-130 mm" => move = "-120 mm" => 10 mm
        move = "130 mm" => move = "145 mm" => ends at s = 155 mm
        on = "rod" => on = "rot" => rod
        type = "cycle" => type = "constant-speed" => cycle
        mass = "3 kg" => mass = "0 kg" => mass
        duration = "0.45 s" => => [[carriage.motion.segment]]
    "#;
    for [from, to, words] in rows(cases) {
        let found = refused(&from, &to);
        assert!(found.contains(&words), "{from}: {found}");
    }
    // Its message names no key of loads.
    let why = parse(&rod(LEANING))
        .refuse_scheduled("fastest")
        .unwrap_err();
    let cure = why.cure().unwrap().to_string();
    assert!(
        cure.starts_with("remove the carriage, or fix it to the link with a [[mass]]")
            && !cure.contains("segments"),
        "{cure}"
    );
    let (_, without) = LEANING.split_once("[[carriage]]").unwrap();
    let text = format!("gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n{}", {
        let machine = rod("");
        let (machine, _) = machine.split_once("[motion]").unwrap();
        let (_, machine) = machine.split_once("[mechanism]").unwrap();
        format!("[mechanism]{machine}[[carriage]]{without}")
    });
    let found = format!(
        "{:?}",
        reader::parse("machine.toml", &text, Path::new("")).unwrap_err()
    );
    assert!(found.contains("has no [motion]"), "{found}");
}
