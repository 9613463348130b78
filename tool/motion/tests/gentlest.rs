//! The gentlest motion against closed forms, against the duty and against a search of its own.

use std::f64::consts::TAU;
use std::path::Path;

use jred_machine::model::machine::MachineFile;
use jred_machine::model::motion::Motion;
use jred_machine::read;
use jred_motion::gentlest::{Fault, Gentle, Objective, Optimum, Travel, gentlest, without_drive};
use jred_motion::retime::{Goal, Obstacle, Request, Retimed, retime};
use jred_motion::way::{Actuator, Way};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::motor::envelope::Envelope;
use jred_sizing::study::common::named;

use crate::support::near;

mod polynomials;
mod slow;

/// A disc that turns freely, with an opposing moment if there is one.
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
    read::parse("machine.toml", text, Path::new("")).unwrap()
}

/// One of the machines that come with the tool, its text edited.
fn example(name: &str, edits: &[(&str, &str)]) -> MachineFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut text = std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
    for (from, to) in edits {
        assert!(text.contains(from), "{name} has no {from}");
        text = text.replace(from, to);
    }
    read::parse(name, &text, folder.as_path()).unwrap()
}

fn travel(start: f64, distance: f64, duration: f64) -> Travel {
    Travel {
        start,
        distance,
        duration,
        speeds: [0.0; 2],
        ramp: 0.0,
        ring: false,
    }
}

fn best(file: &MachineFile, travel: &Travel, objective: Objective) -> Gentle {
    let way = Way::new(file, without_drive(), travel.distance.signum());
    gentlest(&way, travel, objective).unwrap()
}

fn request(goal: Goal, ramp: f64) -> Request {
    Request {
        actuator: without_drive(),
        copper: Some(2.0),
        goal,
        ramp,
        steps: 2000,
    }
}

fn retimed(file: &MachineFile, goal: Goal, ramp: f64) -> Retimed {
    let motion = file.motion.as_ref().unwrap();
    retime(file, motion, &request(goal, ramp)).unwrap()
}

fn is_global(gentle: &Gentle) {
    assert_eq!(gentle.optimum, Optimum::Global);
    if let Some(gap) = gentle.gap() {
        assert!(gap < 1e-6, "gap {gap:e}");
    }
}

/// Constant inertia: φ = D·(3τ² − 2τ³), ∫T² = 12·J²·D²/T³, which is also the bound.
#[test]
fn constant_inertia_is_the_cubic() {
    let file = table(2.0, 0.0);
    for (distance, duration) in [(2.0, 0.5), (-40.0, 3.0), (1e-6, 1e-3), (1e3, 50.0)] {
        let gentle = best(&file, &travel(0.3, distance, duration), Objective::Rms);
        let exact = 12.0 * 4.0 * distance * distance / duration.powi(3);
        near("∫T²", gentle.cost, exact, 1e-9);
        near("bound", gentle.bound.unwrap(), exact, 1e-9);
        near(
            "per second",
            gentle.per_second,
            -3.0 * exact / duration,
            1e-6,
        );
        is_global(&gentle);
        let (mut t, mut way) = (0.0, 0.0);
        for phase in &gentle.phases {
            let share = (t + 0.5 * phase.duration) / duration;
            let middle = way + phase.polynomial.at(0.5 * phase.duration)[0];
            let cubic = distance * share * share * (3.0 - 2.0 * share);
            assert!((middle - cubic).abs() < 1e-9 * distance.abs());
            t += phase.duration;
            way += phase.polynomial.at(phase.duration)[0];
        }
        near("time", t, duration, 1e-12);
        near("way", way, distance, 1e-12);
    }
}

/// Between speeds the acceleration is a straight line over the time too.
#[test]
fn between_speeds_it_is_a_cubic_as_well() {
    let file = table(2.0, 0.0);
    let (d, t, [v, w]) = (2.0, 0.5, [1.0, 2.0]);
    let travel = Travel {
        speeds: [v, w],
        ..travel(0.0, d, t)
    };
    let gentle = best(&file, &travel, Objective::Rms);
    let exact = 4.0
        * (4.0 * (v * v + v * w + w * w) / t - 12.0 * d * (v + w) / (t * t)
            + 12.0 * d * d / (t * t * t));
    near("∫T²", gentle.cost, exact, 1e-9);
    is_global(&gentle);
}

/// Against Coulomb friction C a second more costs C² − 36·J²·D²/T⁴. At rest nothing is held, so the motion takes the time at which this
/// is zero, and waits.
#[test]
fn a_long_time_against_friction_is_waited() {
    let (j, c, d) = (2.0f64, 3.0f64, 2.0f64);
    let own = (36.0 * j * j * d * d / (c * c)).powf(0.25);
    let file = table(j, c);
    let cost = |t: f64| 12.0 * j * j * d * d / t.powi(3) + c * c * t;
    for share in [0.3, 0.9, 1.1, 3.0] {
        let time = share * own;
        let gentle = best(&file, &travel(0.0, d, time), Objective::Rms);
        let moving = time.min(own);
        near("moving", gentle.moving, moving, 1e-5);
        near("∫T²", gentle.cost, cost(moving), 1e-9);
        is_global(&gentle);
        let whole: f64 = gentle.phases.iter().map(|phase| phase.duration).sum();
        near("time", whole, time, 1e-12);
    }
}

/// A weight is held while waiting too, so that waiting saves nothing: 12·J²·D²/T³ + G²·T in any time, and the optimum is global although
/// a longer time costs more.
#[test]
fn a_weight_is_moved_all_the_time() {
    let file = machine(
        "title = \"hoist\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"hoist\"\n[mechanism.drum]\n\
         mass = \"1 kg\"\ninertia = \"0.5 kg m^2\"\n[mechanism.load]\nradius = \"100 mm\"\nmass = \"40 kg\"\n",
    );
    let (j, g) = (0.5 + 40.0 * 0.01, 40.0 * 9.81 * 0.1);
    for time in [0.5f64, 2.0, 20.0] {
        for distance in [6.0, -6.0] {
            let gentle = best(&file, &travel(0.0, distance, time), Objective::Rms);
            let exact = 12.0 * j * j * distance * distance / time.powi(3) + g * g * time;
            near("∫T²", gentle.cost, exact, 1e-9);
            near("moving", gentle.moving, time, 1e-12);
            is_global(&gentle);
        }
    }
}

/// Without friction and load a machine that turns for ever takes no torque at constant kinetic energy.
#[test]
fn an_endless_turn_keeps_its_energy() {
    let file = crank("");
    let motion = Motion::constant_speed(0.0, TAU, TAU);
    let found = retime(&file, &motion, &request(Goal::Rms, 0.0)).unwrap();
    assert!(found.endless);
    assert!(found.best.rms < 1e-5 * found.own.rms, "{:?}", found.best);
    let even = &found.laws[1].figures;
    assert!(even.rms < 1e-6 * found.own.rms, "{even:?}");
    let energy = |t: f64| {
        let state = found.motion.at(t);
        let inertia = file.machine.bare_reduction(state.phi).unwrap().inertia;
        inertia * state.omega * state.omega
    };
    let first = energy(0.0);
    for k in 1..50 {
        near("energy", energy(f64::from(k) / 50.0), first, 1e-5);
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

/// A slider-crank at one turn a second, friction at its slider and in its bearings: against constant speed both objectives take more than
/// 60 % off the peak torque, and the least peak is below that of the least RMS.
#[test]
fn a_slider_crank_takes_a_fraction_of_the_peak() {
    let file = crank(
        "[[load]]\non = \"slider\"\nopposing_force = \"4 N\"\n[[load]]\non = \"crank\"\nopposing_moment = \"0.05 N m\"\n",
    );
    let motion = Motion::constant_speed(0.0, TAU, TAU);
    let [rms, peak] =
        [Goal::Rms, Goal::Peak].map(|goal| retime(&file, &motion, &request(goal, 0.0)).unwrap());
    assert!(rms.best.peak < 0.4 * rms.own.peak, "{:?}", rms.best);
    assert!(peak.best.peak < 0.4 * peak.own.peak, "{:?}", peak.best);
    assert!(peak.best.peak <= rms.best.peak * 1.001);
    assert!(rms.best.rms <= peak.best.rms);
}

/// ∫T² of the solver is that of the duty of the motion that it returns, for machines with losses, friction, edges of loads and dwells;
/// and nothing in the table is below the bound.
#[test]
fn the_duty_confirms_the_torque() {
    for name in [
        "press",
        "rotary-table",
        "vertical-axis",
        "four-bar",
        "hoist",
        "six-link",
    ] {
        let file = example(name, &[]);
        let found = retimed(&file, Goal::Rms, 0.0);
        let duration = found.motion.duration();
        let moves: f64 = found.moves.iter().map(|gentle| gentle.cost).sum();
        // What the dwells of the file take: the own motion without its moves.
        let duty = jred_machine::analysis::duty::Duty::new(&file, &found.motion, 4000).unwrap();
        let still = duty.instants.iter().filter(|instant| instant.omega == 0.0);
        let dwells: f64 = still
            .map(|instant| instant.weight * instant.input_torque * instant.input_torque)
            .sum();
        let waits: f64 = found
            .moves
            .iter()
            .map(|gentle| (gentle.travel.duration - gentle.moving, gentle))
            .filter(|(wait, _)| *wait > 0.0)
            .map(|(wait, gentle)| {
                let at = if gentle.waits_at_end {
                    gentle.travel.distance
                } else {
                    0.0
                };
                let held = file.bare_reduction(gentle.travel.start + at).unwrap();
                let torque = held.torque(0.0, 0.0).total() / file.drive_train.ratio();
                wait * torque * torque / file.drive_train.efficiency().powi(2)
            })
            .sum();
        let expected = moves + dwells - waits;
        near(name, found.best.rms.powi(2) * duration, expected, 1e-6);
        let bound = found.bound.unwrap();
        for figures in found
            .laws
            .iter()
            .map(|row| &row.figures)
            .chain([&found.own])
        {
            assert!(figures.rms >= bound * (1.0 - 1e-9), "{name}: {figures:?}");
            assert!(figures.rms >= found.best.rms * (1.0 - 1e-9), "{name}");
        }
        assert_eq!(found.optimum(), Optimum::Global, "{name}");
        let gap = (found.best.rms - bound) / found.best.rms;
        assert!(gap < 1e-4, "{name}: gap {gap:e}");
    }
}

/// Energy and peak: the gentlest of each is the least of the table in its own figure.
#[test]
fn each_objective_is_least_in_its_own_figure() {
    for name in ["press", "rotary-table", "four-bar"] {
        let file = example(name, &[]);
        let all =
            [Goal::Rms, Goal::Energy, Goal::Peak].map(|goal| (goal, retimed(&file, goal, 0.0)));
        for (goal, found) in &all {
            for (_, other) in &all {
                let [own, other] = [found, other].map(|found| found.best.of(*goal));
                assert!(
                    own <= other * 1.003,
                    "{name}, {goal}: {own}, with another objective {other}"
                );
            }
            let law = found.best_law(*goal).unwrap().figures.of(*goal);
            assert!(found.best.of(*goal) <= law * (1.0 + 1e-9), "{name}, {goal}");
        }
    }
}

/// With ramps the acceleration is zero at rest and has no jump; a tenth costs little, and less than the law of fifth degree.
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
    // ∫S″² of the law of fifth degree is 120/7.
    assert!(
        gentle.cost > 1.001 * least && gentle.cost < 1.1 * least,
        "{}",
        gentle.cost / least
    );
    assert!(gentle.cost < 120.0 / 7.0 / 12.0 * least);
    assert_eq!(gentle.optimum, Optimum::Global);
    let press = retimed(&example("press", &[]), Goal::Rms, 0.1);
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

/// Without friction and losses the motion backwards over the same way is the one forwards, run in reverse.
#[test]
fn backwards_is_the_same_in_reverse() {
    let file = crank("");
    let [there, back] = [travel(0.4, 2.0, 0.3), travel(2.4, -2.0, 0.3)]
        .map(|travel| best(&file, &travel, Objective::Rms));
    near("∫T²", back.cost, there.cost, 1e-7);
    is_global(&there);
    is_global(&back);
}

/// The least peak of a constant inertia is that of constant acceleration, 4·J·D/T², from below to 1 %.
#[test]
fn the_least_peak_is_that_of_the_parabola() {
    let gentle = best(&table(2.0, 0.0), &travel(0.0, 2.0, 0.5), Objective::Peak);
    let parabola = 4.0 * 2.0 * 2.0 / 0.25;
    let least = gentle.least_peak.unwrap();
    assert!(least < parabola && least > 0.99 * parabola, "{least}");
}

/// What cannot be made is refused by its name.
#[test]
fn bad_input_is_named() {
    let file = table(2.0, 0.0);
    let way = Way::new(&file, without_drive(), 1.0);
    let fault = |travel: Travel| gentlest(&way, &travel, Objective::Rms).unwrap_err();
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
        gentlest(&way, &good, zero).unwrap_err(),
        Fault::Figure("copper loss", 0.0)
    );
    let unknown = Request {
        copper: None,
        ..request(Goal::Energy, 0.0)
    };
    let motion = Motion::constant_speed(0.0, 1.0, TAU);
    assert_eq!(
        retime(&file, &motion, &unknown).unwrap_err(),
        Obstacle::NoCopper
    );
}

/// The least peak of a table from rest to rest is that of constant acceleration, 4·J·D/T²; and no law of the list has a lower one, of any
/// machine, as far as it has the ends that are asked for.
#[test]
fn no_law_has_a_lower_peak() {
    let text = "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\n\
                inertia = \"2 kg m^2\"\n[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"90 deg\"\nduration = \"0.5 s\"\n\
                [[motion.segment]]\ndwell = \"0.2 s\"\n";
    let found = retimed(&machine(text), Goal::Peak, 0.0);
    assert_eq!(found.moves[0].law, Some("parabola"));
    near(
        "peak",
        found.best.peak,
        4.0 * 2.0 * (TAU / 4.0) / 0.25,
        1e-9,
    );
    let nodes = found.trace.nodes();
    near("way", nodes[nodes.len() - 1].phi, TAU / 4.0, 1e-12);
    let machines = vec![
        machine(text),
        example("press", &[]),
        example("four-bar", &[]),
        example("vertical-axis", &[]),
        example("rack", &[]),
    ];
    for file in &machines {
        // With ramps the search for the peak finds no motion of some machines, and says so.
        for ramp in [0.0, 0.1] {
            let motion = file.motion.as_ref().unwrap();
            let found = match retime(file, motion, &request(Goal::Peak, ramp)) {
                Ok(found) => found,
                Err(Obstacle::Move(_, _, Fault::NotFound)) if ramp > 0.0 => continue,
                Err(why) => panic!("{why:?}"),
            };
            for law in &found.laws {
                let jumps = ["parabola", "trapezoid", "simple-sine"].contains(&law.name);
                if ramp > 0.0 && jumps {
                    continue;
                }
                let [best, other] = [found.best.peak, law.figures.peak];
                assert!(
                    best <= other * (1.0 + 1e-9),
                    "{} {}: {best} {other}",
                    file.title,
                    law.name
                );
            }
        }
    }
}

/// The table of an indexing cam rests while the cam turns through its dwell: the gentlest motion hurries through it, and says so.
#[test]
fn a_dwell_of_a_cam_that_is_lost_is_named() {
    let found = retimed(&example("indexing-cam", &[]), Goal::Rms, 0.0);
    let (name, [own, best]) = &found.standing[0];
    assert!(name.contains("table") || name.contains("turret"), "{name}");
    assert!(
        *own > 0.0 && (own - best).abs() > 0.01 * own,
        "{own} {best}"
    );
    assert!(
        retimed(&example("press", &[]), Goal::Rms, 0.0)
            .standing
            .is_empty()
    );
}

/// A large gearbox with losses, at whose output the torque bends twice within the roundings of the far lines between which its bends are sought: the
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
        let way = Way::new(&file, Actuator::new(&drive, envelope), 1.0);
        let found = gentlest(&way, &travel(0.5 * TAU, TAU, 0.4), Objective::Rms).unwrap();
        let gap = found.gap();
        assert!(gap.is_some_and(|gap| gap < 1e-4), "{name}: {gap:?}");
    }
}
