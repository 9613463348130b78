//! A limit of the tool's speed in a range.

use jred::machine::Mechanism as _;
use jred_motion::fastest::{Binding, MoveLimits, Task, ToolSpeed, ToolSpeeds};

use super::{close, fastest, machine, motor, task};

/// Constant inertia: from rest over the distance a to the speed w, over b at that speed, and over the remainder to rest. With the acceleration α for
/// driving and braking the peak before is v² = α·a + w²/2.
#[test]
fn a_tool_is_slow_in_a_part_of_its_way() {
    let file = machine(
        "title = \"rack\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rack-and-pinion\"\n\
         pinion = { radius = \"50 mm\", mass = \"1 kg\", inertia = \"2 kg m^2\" }\nrack = { mass = \"3 kg\" }\n",
    );
    let inertia = file.machine.bare_reduction(0.0).unwrap().inertia;
    let alpha = 10.0 / inertia;
    let slow = 0.8;
    let mechanism = file.machine.mechanism();
    let rack = mechanism
        .link_names()
        .iter()
        .position(|name| name == "rack")
        .unwrap();
    for [a, b, end] in [[2.0, 3.5, 5.0], [0.9, 1.0, 4.0], [1.0, 6.0, 6.25]] {
        let limit = ToolSpeed::new(mechanism, rack, [0.0; 2], 0.05 * slow, [a, b]).unwrap();
        let asked = Task {
            limits: MoveLimits {
                tool: limit.unwrap().into(),
                ..MoveLimits::default()
            },
            ..task(0.0, end)
        };
        let found = fastest(&file, &motor([10.0; 2], 100.0), &asked);
        let beside = |dynamics: f64| {
            let peak = (alpha * dynamics + 0.5 * slow * slow).sqrt();
            (2.0 * peak - slow) / alpha
        };
        close(
            found.time,
            beside(a) + (b - a) / slow + beside(end - b),
            1e-9,
        );
        let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
        assert_eq!(
            limits,
            [
                Binding::Driving,
                Binding::Braking,
                Binding::ToolSpeed,
                Binding::Driving,
                Binding::Braking
            ]
        );
    }
}

/// Through the work of a press, to its dead centre: where the limit is followed the slide has its speed and takes distance over v; it is nowhere
/// faster in the range, but faster outside.
#[test]
fn a_press_is_slow_through_the_work() {
    let file = machine(
        "title = \"press\"\ngravity = [\"9.81 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\nflywheel = \"3 kg m^2\"\n\
         crank = { length = \"90 mm\", mass = \"10 kg\", inertia = \"0.1 kg m^2\" }\n\
         rod = { length = \"400 mm\", mass = \"12 kg\", inertia = \"0.2 kg m^2\", com = [\"150 mm\", \"0 mm\"] }\n\
         slider = { mass = \"40 kg\" }\n",
    );
    let mechanism = file.machine.mechanism();
    let slider = mechanism
        .link_names()
        .iter()
        .position(|name| name == "slider")
        .unwrap();
    let degrees = |x: f64| x.to_radians();
    let between = [degrees(300.0), degrees(360.0)];
    let asked = |limit| Task {
        limits: MoveLimits {
            speed: Some(6.0),
            tool: limit,
            ..MoveLimits::default()
        },
        ..task(degrees(180.0), degrees(540.0))
    };
    let press = motor([400.0; 2], 100.0);
    let free = fastest(&file, &press, &asked(ToolSpeeds::default()));
    let x = |phi: f64| mechanism.frames(phi).unwrap()[slider].x;
    // A slow tool needs a crank speed that grows a thousandfold within a cell at the dead centre.
    for speed in [0.06, 0.01, 0.001, 0.0001] {
        let limit = ToolSpeed::new(mechanism, slider, [0.0; 2], speed, between).unwrap();
        let found = fastest(&file, &press, &asked(limit.unwrap().into()));
        let mut slow = 0.0;
        for phase in found
            .phases
            .iter()
            .filter(|phase| phase.limit == Binding::ToolSpeed)
        {
            let dynamics = x(phase.phi[1]).value - x(phase.phi[0]).value;
            close(phase.t[1] - phase.t[0], dynamics.abs() / speed, 1e-7);
            slow += dynamics.abs();
        }
        assert!(
            slow > 0.8 * (x(between[1]).value - x(between[0]).value),
            "{slow}"
        );
        let (mut inside, mut outside) = (0.0f64, 0.0f64);
        for node in found.trace.nodes() {
            let tool = (x(node.phi).d1 * node.omega).abs();
            let hair = 1e-6;
            if node.phi > between[0] + hair && node.phi < between[1] - hair {
                inside = inside.max(tool);
            } else if node.phi < between[0] - hair || node.phi > between[1] + hair {
                outside = outside.max(tool);
            }
        }
        assert!(
            inside <= speed * (1.0 + 1e-8) && outside > 4.0 * speed,
            "{inside} {outside}"
        );
        assert!(
            found.time > free.time + 0.5 * slow / speed,
            "{} {}",
            found.time,
            free.time
        );
    }
}

/// Constant inertia, through two adjacent ranges with different speeds, the second in the second turn only: α·(s + o) = slow² is the braking between
/// them.
#[test]
fn a_programme_of_speeds_over_two_turns() {
    let file = machine(
        "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rack-and-pinion\"\n\
         pinion = { radius = \"50 mm\", mass = \"1 kg\", inertia = \"2 kg m^2\" }\nrack = { mass = \"3 kg\" }\n",
    );
    let inertia = file.machine.bare_reduction(0.0).unwrap().inertia;
    let alpha = 10.0 / inertia;
    let mechanism = file.machine.mechanism();
    let names = mechanism.link_names();
    let rack = names.iter().position(|name| name == "rack").unwrap();
    let slow = |speed: f64, between: [f64; 2]| {
        let limit = ToolSpeed::new(mechanism, rack, [0.0; 2], 0.05 * speed, between);
        limit.unwrap().unwrap().once()
    };
    let turn = std::f64::consts::TAU;
    let [fast, slower] = [0.8, 0.5];
    let [a, b, c, end] = [2.0, 3.5, turn + 1.0, turn + 3.0];
    // The two overlap: from b on the slower one applies.
    let both = ToolSpeeds::from(slow(fast, [a, c])).with(slow(slower, [c, b]));
    let asked = Task {
        limits: MoveLimits {
            tool: both.unwrap(),
            ..MoveLimits::default()
        },
        ..task(0.0, end)
    };
    let found = fastest(&file, &motor([10.0; 2], 100.0), &asked);
    let beside = |dynamics: f64, speed: f64| {
        let peak = (alpha * dynamics + 0.5 * speed * speed).sqrt();
        (2.0 * peak - speed) / alpha
    };
    // Before b it brakes from one to the other.
    let braking = (fast * fast - slower * slower) / (2.0 * alpha);
    let time = beside(a, fast)
        + (b - a - braking) / fast
        + (fast - slower) / alpha
        + (c - b) / slower
        + beside(end - c, slower);
    close(found.time, time, 1e-9);
    // With a repeating range the second turn is slow as well.
    let again = ToolSpeed::new(mechanism, rack, [0.0; 2], 0.05 * fast, [2.0, 3.0]);
    let again = again.unwrap().unwrap();
    let at = |limit: ToolSpeed, phi: f64| limit.at(mechanism, phi).unwrap();
    assert!(at(again, 2.5 + turn) < 1.0 && at(again.once(), 2.5 + turn).is_infinite());
}
