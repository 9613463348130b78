//! The gentlest motion against closed forms, against the duty and against an independent search.

use std::f64::consts::TAU;
use std::path::Path;

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_motion::gentlest::cycle::{GentlestResult, Goal, Obstacle, Request, gentlest_cycle};
use jred_motion::gentlest::{
    Fault, LeastEffortMove, Objective, Optimum, Travel, gentlest, without_drive,
};
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::motor::envelope::Envelope;
use jred_sizing::select::named::named;

use crate::support::near;

mod closed_form;
mod objectives;
mod passing;
mod polynomials;
mod ramps;
mod slow;

/// A disc that turns freely, with an opposing moment if given.
fn table(inertia: f64, friction: f64) -> MachineFile {
    let mut text = format!(
        "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n\
         [mechanism.table]\ninertia = \"{inertia} kg m^2\"\n"
    );
    if friction > 0.0 {
        let load = ["[[load]]\non = \"table\"\nopposing_moment = \"", " N m\"\n"];
        text += &load.join(&friction.to_string());
    }
    machine(&text)
}

fn machine(text: &str) -> MachineFile {
    checked::parse("machine.toml", text, Path::new("")).unwrap()
}

/// An example machine with edited text.
fn example(name: &str, edits: &[(&str, &str)]) -> MachineFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut text = std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
    for (from, to) in edits {
        assert!(text.contains(from), "{name} has no {from}");
        text = text.replace(from, to);
    }
    checked::parse(name, &text, folder.as_path()).unwrap()
}

fn travel(start: f64, distance: f64, duration: f64) -> Travel {
    Travel {
        start,
        distance,
        duration,
        speeds: [0.0; 2],
        accelerations: [0.0; 2],
        ramp: 0.0,
        ring: false,
    }
}

fn best(file: &MachineFile, travel: &Travel, objective: Objective) -> LeastEffortMove {
    let dynamics = PathDynamics::new(file, without_drive(), travel.distance.signum());
    gentlest(&dynamics, travel, objective).unwrap()
}

fn request(goal: Goal, ramp: f64) -> Request {
    Request {
        actuator: without_drive(),
        copper: Some(2.0),
        goal,
        ramp,
        sampling: 2000.into(),
    }
}

fn solved(file: &MachineFile, goal: Goal, ramp: f64) -> GentlestResult {
    let motion = file.motion.as_ref().unwrap();
    gentlest_cycle(file, motion, &request(goal, ramp)).unwrap()
}

fn is_global(gentle: &LeastEffortMove) {
    assert_eq!(gentle.optimum, Optimum::Global);
    if let Some(gap) = gentle.gap() {
        assert!(gap < 1e-6, "gap {gap:e}");
    }
}
/// A crank of 60 mm with a rod and a slider, one turn a second.
fn crank(loads: &str) -> MachineFile {
    machine(&format!(
        "title = \"slider-crank\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\noffset = \"0 mm\"\n\
         branch = \"right\"\nflywheel = \"0.002 kg m^2\"\n[mechanism.crank]\nlength = \"60 mm\"\nmass = \"0 kg\"\n\
         inertia = \"0 kg m^2\"\n[mechanism.rod]\nlength = \"200 mm\"\nmass = \"1 kg\"\ninertia = \"0.004 kg m^2\"\n\
         com = [\"100 mm\", \"0 mm\"]\n[mechanism.slider]\nmass = \"8 kg\"\n{loads}"
    ))
}
/// With ramps the acceleration is zero at rest and has no jump; a ramp of a tenth costs little, and less than the law of fifth degree.
#[test]
fn ramps_begin_and_end_without_a_jump() {
    let file = table(2.0, 0.0);
    let (distance, duration) = (2.0f64, 0.5f64);
    let ramped = Travel {
        ramp: 0.1,
        ..travel(0.0, distance, duration)
    };
    let gentle = best(&file, &ramped, Objective::Rms);
    let most = 6.0 * distance / (duration * duration);
    let mut before = 0.0;
    for phase in &gentle.phases {
        let [_, _, first, _] = phase.polynomial.at(0.0);
        assert!((first - before).abs() < 1e-6 * most, "{before} to {first}");
        before = phase.polynomial.at(phase.duration)[2];
    }
    assert!(before.abs() < 1e-6 * most, "{before}");
    let least = 12.0 * 4.0 * distance * distance / duration.powi(3);
    // A parabolic rise over a tenth with free height, then the optimum: 1/(2S) with S = (0.1·(1/3 − 1/24))²/(0.1·8/15) + 0.4³/3, 1.118·least.
    // ∫S″² of the law of fifth degree is 120/7.
    assert!(
        gentle.cost > 1.11 * least && gentle.cost < 1.15 * least,
        "{}",
        gentle.cost / least
    );
    assert!(gentle.cost < 120.0 / 7.0 / 12.0 * least);
    assert_eq!(gentle.optimum, Optimum::Global);
    let press = solved(&example("press", &[]), Goal::Rms, 0.1);
    let nodes = press.trace.nodes();
    let largest = nodes
        .iter()
        .fold(0.0f64, |most, node| most.max(node.alpha[1].abs()));
    for node in nodes {
        let [before, after] = node.alpha;
        assert!((after - before).abs() < 1e-6 * largest, "{node:?}");
    }
}
/// The same machine in other units of mass and time: torques ×k/c², times ×c; from 1 µs to a day.
#[test]
fn units_change_nothing() {
    let own = best(&table(2.0, 3.0), &travel(0.0, 2.0, 0.7), Objective::Rms);
    for (mass, time) in [(1e-6, 1e-4), (1e3, 1e2), (1.0, 60.0)] {
        let file = table(2.0 * mass, 3.0 * mass / (time * time));
        let scaled = best(&file, &travel(0.0, 2.0, 0.7 * time), Objective::Rms);
        let unit = mass / (time * time);
        near("∫T²", scaled.cost, own.cost * unit * unit * time, 1e-9);
        assert_eq!(scaled.optimum, own.optimum);
    }
}

/// Without friction and losses the motion back over the same distance is the forward one in reverse.
#[test]
fn backwards_is_the_same_in_reverse() {
    let file = crank("");
    let [there, back] = [travel(0.4, 2.0, 0.3), travel(2.4, -2.0, 0.3)]
        .map(|travel| best(&file, &travel, Objective::Rms));
    near("∫T²", back.cost, there.cost, 1e-7);
    is_global(&there);
    is_global(&back);
}
/// Invalid input is refused with its name.
#[test]
fn bad_input_is_named() {
    let file = table(2.0, 0.0);
    let dynamics = PathDynamics::new(&file, without_drive(), 1.0);
    let fault = |travel: Travel| gentlest(&dynamics, &travel, Objective::Rms).unwrap_err();
    let good = travel(0.0, 1.0, 1.0);
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        let is = |fault: Fault, name: &str| matches!(fault, Fault::Figure(what, _) if what == name);
        assert!(is(
            fault(Travel {
                distance: bad,
                ..good
            }),
            "distance"
        ));
        assert!(is(
            fault(Travel {
                duration: bad,
                ..good
            }),
            "duration"
        ));
    }
    let speeds = [0.0, -1.0];
    assert_eq!(
        fault(Travel { speeds, ..good }),
        Fault::Figure("speed", -1.0)
    );
    assert_eq!(
        fault(Travel { ramp: 0.6, ..good }),
        Fault::Figure("ramp", 0.6)
    );
    let zero = Objective::Energy { copper: 0.0 };
    assert_eq!(
        gentlest(&dynamics, &good, zero).unwrap_err(),
        Fault::Figure("copper loss", 0.0)
    );
    let unknown = Request {
        copper: None,
        ..request(Goal::Energy, 0.0)
    };
    let motion = Motion::constant_speed(0.0, 1.0, TAU);
    assert_eq!(
        gentlest_cycle(&file, &motion, &unknown).unwrap_err(),
        Obstacle::NoCopper
    );
}
/// The table of an indexing cam rests while the cam turns through its dwell: the gentlest motion shortens the dwell and reports it.
#[test]
fn a_dwell_of_a_cam_that_is_lost_is_named() {
    let found = solved(&example("indexing-cam", &[]), Goal::Rms, 0.0);
    let (name, [own, best]) = &found.standing[0];
    assert!(name.contains("table") || name.contains("turret"), "{name}");
    assert!(
        *own > 0.0 && (own - best).abs() > 0.01 * own,
        "{own} {best}"
    );
    assert!(
        solved(&example("press", &[]), Goal::Rms, 0.0)
            .standing
            .is_empty()
    );
}
/// The load table acts on no link of the machine: none is reported as resting while the drive turns.
#[test]
fn a_load_is_no_link_that_stands_still() {
    let found = solved(&example("load-table", &[]), Goal::Rms, 0.0);
    assert!(found.standing.is_empty(), "{:?}", found.standing);
}
/// A large gearbox with losses, at whose output the torque bends twice within the roundings of the wide bracket in which bends are searched: the
/// lower bound is found, and close.
#[test]
fn two_bends_close_to_each_other_have_a_bound() {
    let file = example("press", &[]);
    let catalogue = Catalogue::built_in().unwrap();
    for name in [
        "sgm7a-15a+npt015mf-4",
        "sgm7a-40a+sp100mf-10",
        "sgm7a-40a+npt045mf-64",
    ] {
        let (_, drive) = named(&catalogue, name).unwrap();
        let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
        let dynamics = PathDynamics::new(&file, Actuator::new(&drive, envelope), 1.0);
        let found = gentlest(&dynamics, &travel(0.5 * TAU, TAU, 0.4), Objective::Rms).unwrap();
        let gap = found.gap();
        assert!(gap.is_some_and(|gap| gap < 1e-4), "{name}: {gap:?}");
    }
}
