//! Stops at instants over a cycle.

use jred_analysis::simulate::{SimulationError, Stop, simulate, stops};

use crate::reading::parse;
use crate::steady::rotor;
use crate::support::{edited, near, press_text};

fn all(text: &str, count: u32) -> Result<Vec<Stop>, SimulationError> {
    let file = parse(text).unwrap();
    let simulation = file.simulation.as_ref().unwrap();
    stops(&file, simulation, count, |simulation| {
        simulate(&file, simulation)
    })
}

/// A rotor that turns evenly at 20 rad/s: the instants lie over one turn, and each stop takes J·ω/(M + B) under friction and brake.
#[test]
fn an_even_rotor_stops_the_same_everywhere() {
    let load = "[[load]]\non = \"shaft-1\"\nopposing_moment = \"3 N m\"";
    let text = rotor(
        load,
        "torque = \"3 N m\"\nstart_speed = \"20 rad/s\"\nstop = { time = \"0.9 s\", brake_torque = \"17 N m\" }",
    )
    .replace("duration = \"1 s\"", "duration = \"2 s\"");
    let found = all(&text, 6).unwrap();
    let turn = std::f64::consts::TAU / 20.0;
    for (k, stop) in found.iter().enumerate() {
        near("time", stop.time, 0.9 - turn * (5 - k) as f64 / 6.0, 1e-9);
        near("position", stop.position, 20.0 * stop.time, 1e-9);
        let rest = stop.rest.unwrap();
        near("to rest", rest.time, 0.4 * 20.0 / 20.0, 1e-9);
        near("way", rest.way, 0.4 * 400.0 / 40.0, 1e-9);
    }
}

/// A press under its controller: each stop is that of a file with that instant, and the worst takes much longer than the best.
#[test]
fn a_press_stops_as_a_file_with_that_instant() {
    let motor = press_text();
    let text = edited(
        &motor,
        "rotor_inertia = \"200 kg cm^2\"",
        "rotor_inertia = \"200 kg cm^2\"\ncontrol = { speed_gain = \"4 N m s/rad\", position_gain = \"25 1/s\", feed_forward = \"model\" }\nstop = { time = \"1.2 s\", brake_torque = \"30 N m\", brake_delay = \"20 ms\" }",
    );
    let found = all(&text, 12).unwrap();
    for stop in &found {
        let one = text.replace("\"1.2 s\"", &format!("\"{:?} s\"", stop.time));
        let file = parse(&one).unwrap();
        let alone = simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
        assert_eq!(alone.rest, stop.rest);
        assert_eq!(alone.halted_at, Some(stop.position));
    }
    let ways = found.iter().map(|stop| stop.rest.unwrap().way.abs());
    let [least, most] = ways.fold([f64::INFINITY, 0.0], |[a, b], way| {
        [a.min(way), f64::max(b, way)]
    });
    assert!(most > 2.0 * least, "{least} {most}");
}

#[test]
fn without_a_stop_or_a_cycle_there_are_none() {
    let none = all(&rotor("", "torque = \"3 N m\""), 4);
    assert!(matches!(none, Err(SimulationError::NoStop)), "{none:?}");
    let early = rotor("", "torque = \"3 N m\"\nstop = { time = \"0.5 s\" }");
    let early = all(&early, 4);
    assert!(matches!(early, Err(SimulationError::NoCycle)), "{early:?}");
}
