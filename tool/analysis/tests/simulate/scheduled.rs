//! Machines of which something goes by [motion]: against closed forms, the required torque of the motion, and their energy balance.

mod carriage;
mod payload;

use jred_analysis::simulate::{CoupledMachines, SimulationError, TorqueDeficit};
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;

use super::{J, imbalance, simulate, turntable};
use crate::reading::parse;
use crate::support::{edited, near, within};

/// Motions whose pieces are parabolas, at the default tolerance: an instant of rest is found to some 1e-12 s, at 40 rad/s² [4e-11].
const PARABOLA: f64 = 1e-10;

/// Energy balance at the default tolerance, as a share of the energy turned over [4e-12].
const BALANCE: f64 = 1e-9;

/// A swing to and fro, each in half a second.
const SWING: &str = r#"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "1 rad"
duration = "0.25 s"
[[motion.segment]]
law = "polynomial-345"
move = "-1 rad"
duration = "0.25 s"
"#;

fn load(keys: &str) -> String {
    format!("[[load]]\nname = \"load\"\non = \"shaft-1\"\n{keys}\n")
}

/// The turntable with loads on its first shaft, and a motor of constant torque.
fn under(loads: &str, motion: &str, [torque, speed]: [f64; 2], more: &str) -> String {
    let simulation = format!(
        "start_speed = \"{speed} rad/s\"\noutput_step = \"10 ms\"\ntorque = \"{torque} N m\"\n{more}"
    );
    turntable(&format!("{loads}\n{motion}"), &simulation)
}

/// φ and ω at a time, of a motion from `from` whose acceleration is constant between these times, where each piece begins.
fn parabolas(pieces: &[(f64, f64)], from: [f64; 2], t: f64) -> [f64; 2] {
    let [mut phi, mut omega] = from;
    for (k, (start, alpha)) in pieces.iter().enumerate() {
        let end = pieces.get(k + 1).map_or(t, |(end, _)| end.min(t));
        let span = end - start;
        if span <= 0.0 {
            break;
        }
        phi += omega * span + 0.5 * alpha * span * span;
        omega += alpha * span;
    }
    [phi, omega]
}

/// Compares φ and ω of all rows.
#[track_caller]
fn follows(text: &str, pieces: &[(f64, f64)], from: [f64; 2]) {
    let found = simulate(text);
    let (phis, omegas) = (found.get("phi [deg]"), found.get("omega [rad/s]"));
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        let [phi, omega] = parabolas(pieces, from, t);
        within("phi", phis[k].to_radians(), phi, PARABOLA);
        within("omega", omegas[k], omega, PARABOLA);
    }
    if omegas.iter().any(|omega| *omega != 0.0) {
        let imbalance = imbalance(&found);
        assert!(imbalance < BALANCE, "{imbalance:e}");
    }
}

/// A moment against a constant torque acts from 0.1 s to 0.3 s of a cycle of 0.5 s: the speed is a broken line, over several cycles, whatever
/// the output step is.
#[test]
fn a_load_acts_at_its_times_in_every_cycle() {
    let motion = "[motion]\ntype = \"cycle\"\n[[motion.segment]]\ndwell = \"0.5 s\"\n";
    let text = under(
        &load("moment = \"-0.6 N m\"\nduring = [\"0.1 s\", \"0.3 s\"]"),
        motion,
        [1.0, 2.0],
        "duration = \"1.3 s\"",
    );
    let (free, loaded) = (1.0 / J, 0.4 / J);
    let starts = [0.0, 0.1, 0.3, 0.6, 0.8, 1.1];
    let pieces: Vec<(f64, f64)> = (starts.iter().enumerate())
        .map(|(k, t)| (*t, if k % 2 == 0 { free } else { loaded }))
        .collect();
    let pieces = [&pieces[..], &[(1.3, free)]].concat();
    follows(&text, &pieces, [0.0, 2.0]);
    follows(
        &edited(&text, "\"10 ms\"", "\"6.7 ms\"").replace("1.3 s", "1.273 s"),
        &pieces,
        [0.0, 2.0],
    );
    // Over the end of the cycle.
    let over = edited(&text, "[\"0.1 s\", \"0.3 s\"]", "[\"0.4 s\", \"0.1 s\"]");
    let pieces = [
        (0.0, loaded),
        (0.1, free),
        (0.4, loaded),
        (0.6, free),
        (0.9, loaded),
        (1.1, free),
        (1.4, loaded),
    ];
    follows(&over, &pieces, [0.0, 2.0]);
}

/// Behind the end of a motion that does not repeat, what acts at its end goes on.
#[test]
fn behind_the_end_what_acts_there_goes_on() {
    let motion = |kind: &str| {
        format!(
            "[motion]\ntype = \"{kind}\"\n[[motion.segment]]\ndwell = \"0.3 s\"\n[[motion.segment]]\nlaw = \"polynomial-345\"\n\
             move = \"360 deg\"\nduration = \"0.1 s\"\n"
        )
    };
    let text = |kind: &str, segment: u32| {
        under(
            &load(&format!("moment = \"-0.6 N m\"\nsegments = [{segment}]")),
            &motion(kind),
            [1.0, 0.0],
            "duration = \"0.7 s\"",
        )
    };
    let (free, loaded) = (1.0 / J, 0.4 / J);
    let start = [0.0, 0.0];
    follows(
        &text("point-to-point", 2),
        &[(0.0, free), (0.3, loaded)],
        start,
    );
    follows(
        &text("point-to-point", 1),
        &[(0.0, loaded), (0.3, free)],
        start,
    );
    follows(
        &text("cycle", 2),
        &[(0.0, free), (0.3, loaded), (0.4, free)],
        start,
    );
}

/// Friction and a moment of one direction: the link comes to rest and turns back, each way under what acts in it.
#[test]
fn a_load_of_one_direction_acts_as_the_link_moves() {
    let friction = load("opposing_moment = \"0.4 N m\"\ndirection = \"forward\"")
        + &load("opposing_moment = \"1 N m\"\ndirection = \"backward\"");
    let turn = |forward: f64| 10.0 / -forward;
    let [forward, backward] = [-1.9 / J, -0.5 / J];
    follows(
        &under(&friction, SWING, [-1.5, 10.0], "duration = \"1 s\""),
        &[(0.0, forward), (turn(forward), backward)],
        [0.0, 10.0],
    );
    let signed = load("moment = \"-0.5 N m\"\ndirection = \"forward\"");
    let [forward, backward] = [-2.0 / J, -1.5 / J];
    follows(
        &under(&signed, SWING, [-1.5, 10.0], "duration = \"1 s\""),
        &[(0.0, forward), (turn(forward), backward)],
        [0.0, 10.0],
    );
    // It holds what it stops: 0.9 N m do not overcome the friction backward.
    let held = under(&friction, SWING, [-0.9, 10.0], "duration = \"1 s\"");
    let forward = -1.3 / J;
    follows(&held, &[(0.0, forward), (turn(forward), 0.0)], [0.0, 10.0]);
}

/// Static friction holds until the torque has grown to it; then the friction in motion leaves an acceleration at once.
#[test]
fn static_friction_is_broken_away() {
    let friction = load("opposing_moment = \"2 N m\"\nat_rest = \"3 N m\"");
    let motion = "[motion]\ntype = \"constant-speed\"\nspeed = \"10 rad/s\"\n";
    let text = under(
        &friction,
        motion,
        [1000.0, 0.0],
        "duration = \"0.25 s\"\ncontrol = { speed_gain = \"0.1 N m s/rad\", integral_time = \"100 ms\" }",
    );
    let found = simulate(&edited(&text, "10 ms", "1 ms"));
    let (omegas, alphas) = (found.get("omega [rad/s]"), found.get("alpha [rad/s^2]"));
    // 0.1·10·(1 + t/0.1) = 3.
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        if t < 0.2 - 1e-9 {
            within("held", omegas[k], 0.0, 0.0);
        } else if t < 0.203 && t > 0.2 + 1e-9 {
            let after = t - 0.2;
            // α = 1 N m / J at first, and rises with the integral, 10 N m/s.
            let expected = (1.0 + 10.0 * after) / J;
            within("alpha", alphas[k], expected, 0.02 * expected);
            within("omega", omegas[k], 20.0 * after, 0.02 * 20.0 * after);
        }
    }
    assert!(*omegas.last().unwrap() > 0.5);
    // A constant torque between both does not start the machine, and keeps it in motion.
    let between = |speed: f64| under(&friction, SWING, [2.5, speed], "duration = \"0.4 s\"");
    follows(&between(0.0), &[(0.0, 0.0)], [0.0, 0.0]);
    follows(&between(1.0), &[(0.0, 0.5 / J)], [0.0, 1.0]);
}

/// A moment that is larger at rest holds: the motor would drive the machine on in motion only, and turn back at rest only.
#[test]
fn a_load_with_a_value_at_rest_holds_between_both() {
    let moment = load("moment = \"-1 N m\"\nat_rest = \"-3 N m\"");
    let text = |speed: f64| under(&moment, SWING, [2.0, speed], "duration = \"0.4 s\"");
    follows(&text(0.0), &[(0.0, 0.0)], [0.0, 0.0]);
    follows(&text(1.0), &[(0.0, 1.0 / J)], [0.0, 1.0]);
    let file = parse(&text(0.0)).unwrap();
    let found =
        jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
    let TorqueDeficit { given, needed, .. } = found.missing.unwrap().missing;
    near("given", given, 2.0, 1e-12);
    near("needed", needed, 3.0, 1e-12);
}

/// Two turntables on one shaft, each with a load by the clock of its own file.
#[test]
fn machines_on_one_shaft_each_go_by_their_own_clock() {
    let motion = |cycle: &str| {
        format!("[motion]\ntype = \"cycle\"\n[[motion.segment]]\ndwell = \"{cycle}\"\n")
    };
    let text = |from: &str, cycle: &str| {
        let keys = format!("moment = \"-0.6 N m\"\nduring = [\"{from}\", \"{cycle}\"]");
        under(
            &load(&keys),
            &motion(cycle),
            [1.0, 0.0],
            "duration = \"0.75 s\"",
        )
    };
    let [first, second] =
        [text("0.2 s", "0.3 s"), text("0.1 s", "0.5 s")].map(|text| parse(&text).unwrap());
    let simulation = first.simulation.as_ref().unwrap();
    let machines = CoupledMachines::alone(&first)
        .with([(&second, 0.0)], simulation)
        .unwrap();
    let found = jred_analysis::simulate::simulate_together(&machines, simulation).unwrap();
    let at = |loads: f64| (1.0 - 0.6 * loads) / (2.0 * J);
    let pieces = [
        (0.0, at(0.0)),
        (0.1, at(1.0)),
        (0.2, at(2.0)),
        (0.3, at(1.0)),
        (0.5, at(1.0)),
        (0.6, at(1.0)),
    ];
    for ([phi, omega, _], row) in found.states.iter().zip(found.columns.rows()) {
        let expected = parabolas(&pieces, [0.0; 2], row[0].unwrap());
        within("phi", *phi, expected[0], PARABOLA);
        within("omega", *omega, expected[1], PARABOLA);
    }
}

/// d'Alembert's drive torque of the motion of the file at a time.
fn required(file: &MachineFile, t: f64) -> f64 {
    let motion = file.motion.as_ref().unwrap();
    let t = t % motion.duration();
    let state = motion.at(t);
    let machine = file
        .machine_at(&ScheduleInstant::of(t, state.omega), state.phi)
        .unwrap();
    let forces = machine.forces(state.phi, state.omega, state.alpha);
    forces.unwrap().drive
}

/// A controller that knows the model drives the machine along its motion, over more than one cycle, and its torque is that of d'Alembert's
/// principle at every instant; returns the largest.
#[track_caller]
fn inverse_and_forward(text: &str) -> f64 {
    let file = parse(text).unwrap();
    let simulation = file.simulation.as_ref().unwrap();
    assert!(simulation.duration > 1.2 * file.motion.as_ref().unwrap().duration());
    let found = jred_analysis::simulate::simulate(&file, simulation).unwrap();
    assert!(
        found.following.unwrap().error.abs() < 1e-9,
        "{:?}",
        found.following
    );
    let names = found.columns.names();
    let column = |name: &str| names.iter().position(|known| known == name).unwrap();
    let columns = ["t [s]", "motor torque [N m]", "energy balance [J]"].map(column);
    let mut most = [0.0f64; 2];
    let corners = corners(&file);
    for row in found.columns.rows() {
        let [t, torque, balance] = columns.map(|k| row[k].unwrap());
        most[1] = most[1].max(balance.abs());
        let here = t % file.motion.as_ref().unwrap().duration();
        if corners.iter().any(|at| (here - at).abs() < 1e-9) {
            continue;
        }
        let expected = required(&file, t);
        most[0] = most[0].max(expected.abs());
        assert!(
            (torque - expected).abs() < 1e-7,
            "t = {t}: {torque} {expected}"
        );
    }
    assert!(most[1] < 1e-9 * most[0].max(1.0), "{most:?}");
    most[0]
}

/// Where torques may jump.
fn corners(file: &MachineFile) -> Vec<f64> {
    let motion = file.motion.as_ref().unwrap();
    let mut all = file.schedule.times();
    all.extend(motion.stretches().into_iter().flat_map(|(a, b)| [a, b]));
    all
}

const CONTROL: &str = "control = { speed_gain = \"20 N m s/rad\", position_gain = \"20 1/s\", feed_forward = \"model\" }";

/// The shipped lift, whose guide does not stick here: payload, loads by segment and direction.
#[test]
fn the_shipped_lift_follows_its_motion() {
    let shipped = include_str!("../../../../machines/pick-and-place.toml");
    let (machine, _) = shipped.split_once("[simulation]").unwrap_or((shipped, ""));
    let smooth = edited(machine, "at_rest = \"60 N\"", "# at_rest");
    let simulation = |keys: &str| {
        format!("[simulation]\nduration = \"2.5 s\"\noutput_step = \"5 ms\"\n{keys}\n")
    };
    let controlled = simulation(&format!("torque = \"500 N m\"\n{CONTROL}"));
    let most = inverse_and_forward(&format!("{smooth}\n{controlled}"));
    assert!(most > 10.0, "{most}");
    // Sticking, under a controller, and free, up and down under two motors: the energies balance.
    let free = |torque: &str| format!("start_angle = \"0 deg\"\ntorque = \"{torque}\"");
    let own = [
        controlled,
        simulation(&free("14 N m")),
        simulation(&free("4 N m")),
    ];
    for simulation in own {
        let found = simulate(&format!("{machine}\n{simulation}"));
        let imbalance = imbalance(&found);
        assert!(imbalance < BALANCE, "{imbalance:e}");
    }
}

/// Behind a variator what goes by the motion is refused.
#[test]
fn behind_a_variator_it_is_refused() {
    let shipped = include_str!("../../../../machines/variator-press.toml");
    let load = "[[load]]\nname = \"punch\"\non = \"slider\"\nforce = [\"-1 N\", \"0 N\"]\ndirection = \"forward\"\n[motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n";
    let file = parse(&format!("{shipped}\n{load}")).unwrap();
    let refused = jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap());
    let Err(SimulationError::Scheduled(part)) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(part.what, "load \"punch\" acts forward");
}
