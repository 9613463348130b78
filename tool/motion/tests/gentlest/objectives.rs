//! RMS torque, energy and peak torque of the motion against those of the laws, and against its duty.

use std::f64::consts::TAU;

use jred_file::model::motion::Motion;
use jred_motion::gentlest::cycle::{Goal, Obstacle, gentlest_cycle};
use jred_motion::gentlest::{Fault, Objective, Optimum};

use super::{best, crank, example, machine, request, solved, table, travel};
use crate::support::near;

/// A slider-crank at one turn per second with friction at its slider and bearings: compared with constant speed both objectives reduce the peak
/// torque by more than 60 %, and the least peak is below that of the least RMS.
#[test]
fn a_slider_crank_takes_a_fraction_of_the_peak() {
    let file = crank(
        "[[load]]\non = \"slider\"\nopposing_force = \"4 N\"\n[[load]]\non = \"crank\"\nopposing_moment = \"0.05 N m\"\n",
    );
    let motion = Motion::constant_speed(0.0, TAU, TAU);
    let [rms, peak] = [Goal::Rms, Goal::Peak]
        .map(|goal| gentlest_cycle(&file, &motion, &request(goal, 0.0)).unwrap());
    assert!(rms.best.peak < 0.4 * rms.own.peak, "{:?}", rms.best);
    assert!(peak.best.peak < 0.4 * peak.own.peak, "{:?}", peak.best);
    assert!(peak.best.peak <= rms.best.peak * 1.001);
    assert!(rms.best.rms <= peak.best.rms);
}

/// ∫T² of the solver equals that of the duty of its motion, for machines with losses, friction, edges of loads and dwells; no row of the table is
/// below the bound.
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
        let found = solved(&file, Goal::Rms, 0.0);
        let duration = found.motion.duration();
        let moves: f64 = found.moves.iter().map(|gentle| gentle.cost).sum();
        // The share of the file's dwells: its own motion without the moves.
        let duty = jred_analysis::duty::Duty::new(&file, &found.motion, 4000).unwrap();
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
                let held = file.bare_reduction(gentle.waits_at).unwrap();
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

/// Energy and peak: each gentlest motion has the smallest value of its own figure in the table.
#[test]
fn each_objective_is_least_in_its_own_figure() {
    for name in ["press", "rotary-table", "four-bar"] {
        let file = example(name, &[]);
        let all =
            [Goal::Rms, Goal::Energy, Goal::Peak].map(|goal| (goal, solved(&file, goal, 0.0)));
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
/// The least peak with constant inertia is that of constant acceleration, 4·J·D/T², from below to 1 %.
#[test]
fn the_least_peak_is_that_of_the_parabola() {
    let gentle = best(&table(2.0, 0.0), &travel(0.0, 2.0, 0.5), Objective::Peak);
    let parabola = 4.0 * 2.0 * 2.0 / 0.25;
    let least = gentle.least_peak.unwrap();
    assert!(least < parabola && least > 0.99 * parabola, "{least}");
}
/// The least peak of a table from rest to rest is that of constant acceleration, 4·J·D/T²; for any machine no law of the list with the requested ends
/// has a lower one.
#[test]
#[ignore = "more than five seconds of a processor"]
fn no_law_has_a_lower_peak() {
    let text = "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\n\
                inertia = \"2 kg m^2\"\n[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"90 deg\"\nduration = \"0.5 s\"\n\
                [[motion.segment]]\ndwell = \"0.2 s\"\n";
    let found = solved(&machine(text), Goal::Peak, 0.0);
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
        // With ramps the search for the peak finds no motion for some machines, and reports so.
        for ramp in [0.0, 0.1] {
            let motion = file.motion.as_ref().unwrap();
            let found = match gentlest_cycle(file, motion, &request(Goal::Peak, ramp)) {
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

/// If the search for the lowest peak of a turn does not converge, its best motion is returned, at least as good as the classical laws, and is not
/// called global.
#[test]
fn a_search_that_does_not_end_gives_its_best() {
    for name in ["shaper", "whitworth", "linkage-four-bar"] {
        let found = solved(&example(name, &[]), Goal::Peak, 0.0);
        assert!(found.best.peak <= found.own.peak * (1.0 + 1e-9), "{name}");
        for row in &found.laws {
            assert!(found.best.peak <= row.figures.peak * (1.0 + 1e-9), "{name}");
        }
        assert_ne!(found.optimum(), Optimum::Global, "{name}");
    }
}
