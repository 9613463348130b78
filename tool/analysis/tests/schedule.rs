//! Loads that act in a part of the motion, and payloads: against the work and the torque in closed form.

mod carriage;
mod payload;

use std::path::Path;

use crate::reader;
use jred_analysis::duty::Duty;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, not_contained, reduce};
use jred_analysis::steady;
use jred_file::model::machine::MachineFile;

use crate::support::{near, within};

/// Pitch radius (m), distance of a move (rad), masses, gravity down the rack.
const RADIUS: f64 = 0.05;
const WAY: f64 = 12.0;
const RACK: f64 = 20.0;
const PINION: f64 = 0.01;
const G: f64 = 9.81;

/// Up in a second, half a second of dwell, down in 0.8 s, 0.4 s of dwell.
fn lift(gravity: &str, more: &str) -> String {
    format!(
        r#"
gravity = ["-{gravity} m/s^2", "0 m/s^2"]
[mechanism]
type = "rack-and-pinion"
pinion = {{ radius = "50 mm", mass = "1 kg", inertia = "0.01 kg m^2" }}
rack = {{ mass = "20 kg" }}
{more}
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "12 rad"
duration = "1 s"
[[motion.segment]]
dwell = "0.5 s"
[[motion.segment]]
law = "polynomial-345"
move = "-12 rad"
duration = "0.8 s"
[[motion.segment]]
dwell = "0.4 s"
"#
    )
}

fn machine(gravity: &str, more: &str) -> MachineFile {
    let text = lift(gravity, more);
    reader::parse("machine.toml", &text, Path::new("")).unwrap_or_else(|e| panic!("{e:?}"))
}

fn duty(file: &MachineFile) -> Duty {
    Duty::new(file, file.motion.as_ref().unwrap(), 2000).unwrap()
}

/// Work of the drive over the cycle (J).
fn work(duty: &Duty) -> f64 {
    duty.integral(|i| i.input_torque * i.input_speed)
}

/// Position of the polynomial 3-4-5 as a share of its way.
fn share(z: f64) -> f64 {
    z * z * z * (10.0 + z * (6.0 * z - 15.0))
}

fn load(keys: &str) -> String {
    format!("[[load]]\nname = \"load\"\non = \"rack\"\n{keys}\n")
}

/// A force along the rack acts in its segments only: torque at every instant, and work over the cycle, F·s.
#[test]
fn a_force_acts_in_its_segments() {
    let file = machine(
        "0",
        &load("force = [\"-300 N\", \"0 N\"]\nsegments = [1, 2]"),
    );
    let duty = duty(&file);
    let inertia = PINION + RACK * RADIUS * RADIUS;
    for i in &duty.instants {
        let force = if i.t < 1.5 { 300.0 } else { 0.0 };
        let expected = inertia * i.alpha + force * RADIUS;
        assert!((i.input_torque - expected).abs() < 1e-10, "{i:?}");
    }
    near("work", work(&duty), 300.0 * WAY * RADIUS, 1e-9);
    near("holding", duty.hold_torque, 300.0 * RADIUS, 1e-12);
}

/// Times cut a move: the work is the force times the way in between, also of a time so short that no step of the motion falls into it, and
/// over the end of the cycle.
#[test]
fn times_cut_the_motion_where_they_are() {
    for [from, to] in [[0.2, 0.7], [0.4004, 0.4005]] {
        let keys = format!("force = [\"-300 N\", \"0 N\"]\nduring = [\"{from} s\", \"{to} s\"]");
        let way = WAY * RADIUS * (share(to) - share(from));
        let duty = duty(&machine("0", &load(&keys)));
        near("work", work(&duty), 300.0 * way, 1e-8);
    }
    let keys = "force = [\"-300 N\", \"0 N\"]\nduring = [\"1.9 s\", \"0.3 s\"]";
    let down = share(1.0) - share(0.5);
    let up = share(0.3);
    let duty = duty(&machine("0", &load(keys)));
    near(
        "work",
        work(&duty),
        300.0 * WAY * RADIUS * (up - down),
        1e-6,
    );
}

/// Friction and a force that differ with the direction of travel: every edge is in the duty.
#[test]
fn a_load_may_act_in_one_direction() {
    let loads = load("opposing_force = \"100 N\"\ndirection = \"forward\"")
        + &load("opposing_force = \"30 N\"\ndirection = \"backward\"");
    let duty_of = duty(&machine("0", &loads));
    near("work", work(&duty_of), 130.0 * WAY * RADIUS, 1e-9);
    // A polynomial that turns back within the segment.
    let text = lift("0", &loads);
    let (head, _) = text.split_once("[motion]").unwrap();
    let swing = format!(
        "{head}[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"polynomial-5\"\nmove = \"1 rad\"\nduration = \"1 s\"\n\
         start_speed = \"4 rad/s\"\nend_speed = \"-4 rad/s\"\n[[motion.segment]]\nlaw = \"polynomial-5\"\nmove = \"-1 rad\"\nduration = \"1 s\"\n"
    );
    let file = reader::parse("machine.toml", &swing, Path::new("")).unwrap();
    let motion = file.motion.as_ref().unwrap();
    let duty = duty(&file);
    // The way forward and the way back, by the turning points that bisection of the speed finds.
    let mut turns = vec![0.0];
    let steps = 4000;
    let speed = |t: f64| motion.at(t).omega;
    for k in 0..steps {
        let [a, b] = [k, k + 1].map(|k| 2.0 * f64::from(k) / f64::from(steps));
        if speed(a) * speed(b) < 0.0 {
            let (mut low, mut high) = (a, b);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if speed(middle) * speed(a) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            turns.push(low);
        }
    }
    turns.push(2.0);
    assert_eq!(turns.len(), 4);
    let expected: f64 = turns
        .windows(2)
        .map(|pair| motion.at(pair[1]).phi - motion.at(pair[0]).phi)
        .map(|way| if way > 0.0 { 100.0 * way } else { -30.0 * way })
        .sum();
    near("work", work(&duty), expected * RADIUS, 1e-8);
}

/// At rest a load has a value of its own; it is in the holding torque, and in no move.
#[test]
fn a_load_has_a_value_of_its_own_at_rest() {
    let file = machine(
        "0",
        &load("force = [\"-300 N\", \"0 N\"]\nat_rest = [\"-450 N\", \"0 N\"]"),
    );
    let duty = duty(&file);
    near("holding", duty.hold_torque, 450.0 * RADIUS, 1e-12);
    for i in &duty.instants {
        let force = if i.omega == 0.0 { 450.0 } else { 300.0 };
        near("process", i.terms.process, force * RADIUS, 1e-12);
    }
    // The instants at the ends of a stretch lie a billionth of it inside.
    within("work", work(&duty), 0.0, 1e-9 * 300.0 * WAY * RADIUS);
}

/// Static friction is a peak where a move begins: once at the start of each move, either way, without a share in the RMS.
#[test]
fn static_friction_is_overcome_where_a_move_begins() {
    let still = duty(&machine(
        "9.81",
        &load("opposing_force = \"100 N\"\nat_rest = \"2000 N\""),
    ));
    let without = duty(&machine("9.81", &load("opposing_force = \"100 N\"")));
    let weight = RACK * G * RADIUS;
    let peaks: Vec<_> = (still.instants.iter())
        .filter(|i| i.terms.coulomb.abs() > 99.0)
        .collect();
    assert_eq!(peaks.len(), 2);
    for (peak, (t, direction)) in peaks.into_iter().zip([(0.0, 1.0), (1.5, -1.0)]) {
        near("time", peak.t + 1.0, t + 1.0, 1e-12);
        let expected = weight + direction * 2000.0 * RADIUS;
        near("torque", peak.input_torque, expected, 1e-12);
        assert!(peak.weight == 0.0 && peak.omega == 0.0 && peak.alpha == 0.0);
    }
    let rms = |duty: &Duty| duty.figures(|i| i.input_torque).rms;
    near("rms", rms(&still), rms(&without), 1e-12);
    assert!(still.figures(|i| i.input_torque).max > without.figures(|i| i.input_torque).max + 10.0);
    // It helps to hold, which is not counted on.
    near("holding", still.hold_torque, without.hold_torque, 1e-12);
}

/// Work against energy over the whole motion, by d'Alembert's forces, with everything at once.
#[test]
fn the_energy_balance_closes() {
    let more = load("force = [\"-300 N\", \"0 N\"]\nsegments = [1, 2]")
        + &load("opposing_force = \"70 N\"\ndirection = \"backward\"")
            .replace("\"load\"", "\"other\"")
        + "[[payload]]\non = \"rack\"\nmass = \"7 kg\"\nduring = [\"0.3 s\", \"1.2 s\"]\nwhile_moving = true\n";
    let findings = Findings::of(&machine("9.81", &more)).unwrap();
    assert!(findings.agreement.dalembert < 1e-12);
    let energy = findings.agreement.energy.unwrap();
    assert!(energy < 1e-11, "{energy:e}");
    assert!(findings.holds());
    let notes: Vec<&str> = (findings.scheduled.iter())
        .map(|part| part.what.as_str())
        .collect();
    for words in [
        "load \"load\" acts in segments 1 and 2",
        "load \"other\" acts backward",
        "payload \"payload on rack\" of 7 kg is carried from 0.3 s to 1.2 s",
    ] {
        assert!(notes.contains(&words), "{notes:?}");
    }
}

/// Over time, curves, forces and energies contain what acts then; over the position they say what they do not contain.
#[test]
fn curves_contain_what_acts_or_say_so() {
    let file = machine("0", &load("force = [\"-300 N\", \"0 N\"]\nsegments = [1]"));
    let sets = Sets {
        curves: true,
        reactions: true,
        energy: true,
        ..Sets::default()
    };
    let mut request = Request {
        over: Over::Time,
        positions: 28,
        sets,
        state: None,
    };
    let columns = reduce(&file, &request).unwrap();
    let column = |name: &str| {
        let heads = columns.heads();
        let k = heads.iter().position(|head| head.name == name);
        k.unwrap_or_else(|| {
            panic!(
                "{name}: {:?}",
                heads.iter().map(|h| &h.name).collect::<Vec<_>>()
            )
        })
    };
    let (t, process, force) = (column("t"), column("T_process"), column("Q load"));
    let mut seen = [0; 2];
    for row in columns.rows() {
        let acts = row[t].unwrap() < 1.0;
        let expected = if acts { -300.0 * RADIUS } else { 0.0 };
        for column in [process, force] {
            assert!((row[column].unwrap() - expected).abs() < 1e-12);
        }
        seen[usize::from(acts)] += 1;
    }
    assert!(seen.iter().all(|count| *count > 5));
    assert!(not_contained(&file, &request).is_empty());
    request.over = Over::Angle;
    assert_eq!(
        not_contained(&file, &request),
        ["load \"load\" acts in segment 1"]
    );
    assert!(file.bare_reduction(0.3).unwrap().process == 0.0);
    // A speed is enough for a direction.
    let file = machine(
        "0",
        &load("opposing_force = \"9 N\"\ndirection = \"backward\""),
    );
    request.state = Some([-3.0, 0.0]);
    assert!(not_contained(&file, &request).is_empty());
    let columns = reduce(&file, &request).unwrap();
    let k = columns
        .heads()
        .iter()
        .position(|h| h.name == "c_coulomb")
        .unwrap();
    assert!(
        columns
            .rows()
            .iter()
            .all(|row| (row[k].unwrap() - 9.0 * RADIUS).abs() < 1e-12)
    );
}

/// A command that does not follow the motion refuses to leave it out.
#[test]
fn the_steady_cycle_refuses() {
    let motor = "[simulation]\nstart_angle = \"0 deg\"\nduration = \"1 s\"\noutput_step = \"0.1 s\"\ntorque = \"20 N m\"\n";
    let file = machine(
        "0",
        &(load("opposing_force = \"9 N\"\ndirection = \"backward\"") + motor),
    );
    let simulation = file.simulation.as_ref().unwrap();
    let request = steady::SteadyRequest::default();
    let why = steady::steady(&file, simulation, &request).unwrap_err();
    let steady::SteadyError::Scheduled(part) = why else {
        panic!("{why:?}");
    };
    assert_eq!(part.what, "load \"load\" acts backward");
}
