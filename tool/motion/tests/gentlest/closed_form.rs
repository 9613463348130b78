//! Against closed forms.

use std::f64::consts::TAU;

use jred_file::model::motion::Motion;
use jred_motion::gentlest::cycle::{Goal, gentlest_cycle};
use jred_motion::gentlest::{Objective, Travel};

use super::{best, crank, is_global, machine, request, table, travel};
use crate::support::near;

/// Constant inertia: φ = D·(3τ² − 2τ³), ∫T² = 12·J²·D²/T³, equal to the bound.
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

/// Between speeds the acceleration is also linear over the time, also from a kept speed to rest; a coarse mesh is sufficient.
#[test]
fn between_speeds_it_is_a_cubic_as_well() {
    let file = table(2.0, 0.0);
    let (d, t) = (2.0, 0.5);
    for [v, w] in [[1.0, 2.0], [3.0, 3.0], [6.0, 0.0], [0.0, 6.0], [3.0, 0.0]] {
        let travel = Travel {
            speeds: [v, w],
            ..travel(0.0, d, t)
        };
        let gentle = best(&file, &travel, Objective::Rms);
        let exact = 4.0
            * (4.0 * (v * v + v * w + w * w) / t - 12.0 * d * (v + w) / (t * t)
                + 12.0 * d * d / (t * t * t));
        near("∫T²", gentle.cost, exact, 1e-9);
        near("bound", gentle.bound.unwrap(), exact, 1e-9);
        assert!(gentle.discretisation < 1e-8, "{}", gentle.discretisation);
        is_global(&gentle);
    }
}

/// Against Coulomb friction C a second more costs C² − 36·J²·D²/T⁴. At rest nothing is held, so the motion takes the time at which this is zero, and
/// waits.
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

/// A weight is held while waiting too, so waiting saves nothing: 12·J²·D²/T³ + G²·T in any time, and the optimum is global although a longer time
/// costs more.
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

/// Without friction and load an endless turn at constant kinetic energy takes no torque.
#[test]
fn an_endless_turn_keeps_its_energy() {
    let file = crank("");
    let motion = Motion::constant_speed(0.0, TAU, TAU);
    let found = gentlest_cycle(&file, &motion, &request(Goal::Rms, 0.0)).unwrap();
    assert!(found.chain.endless);
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
