//! Motion prescribed at the tool: what comes out at the tool is what was asked for, in position, speed and acceleration.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use jred::Domain;
use jred::machine::{Jointed as _, Mechanism as _, Reducible as _};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Measure, Motion, MotionSegment, ToolCoordinate};

use super::within;
use crate::reading::{machines, read, refuses, text_of, with_motion};
use crate::support::press::slider_derivatives;

/// Speed and acceleration of a coordinate with these derivatives, by the chain rule.
fn carried([_, d1, d2]: [f64; 3], omega: f64, alpha: f64) -> [f64; 2] {
    [d1 * omega, d1 * alpha + d2 * omega * omega]
}

const STROKE: &str = "type = \"cycle\"; of = { point = \"slider\", along = \"x\" }; near = \"90 deg\"; start = \"205 mm\"; \
    [[motion.segment]]; law = \"modified-sine\"; move = \"-50 mm\"; duration = \"0.2 s\"; \
    [[motion.segment]]; dwell = \"0.1 s\"; \
    [[motion.segment]]; law = \"polynomial-5\"; move = \"50 mm\"; duration = \"0.3 s\"";

/// Through the press, against the closed form of its slider.
#[test]
fn a_press_follows_its_ram() {
    let motion = read(&with_motion("press.toml", STROKE)).motion.unwrap();
    let law = jred::machine::motion::Law::<f64>::ModifiedSine;
    let stroke = 0.05;
    for k in 0..=1000 {
        let z = f64::from(k) / 1000.0;
        let state = motion.at(0.2 * z);
        let [s, v, a] = law.at(z);
        let asked = [0.205 - stroke * s, -stroke / 0.2 * v, -stroke / 0.04 * a];
        let slider = slider_derivatives(state.phi);
        let [speed, acceleration] = carried(slider, state.omega, state.alpha);
        assert!((0.0..PI).contains(&state.phi), "{}", state.phi);
        within("x", slider[0], asked[0], 1e-14);
        within("speed", speed, asked[1], 1e-12);
        // The last instant of the move is the first of the dwell.
        if k < 1000 {
            within("acceleration", acceleration, asked[2], 1e-10);
        }
        // The law of cosines gives the crank's angle at once.
        let (r, l, x) = (0.03_f64, 0.18_f64, asked[0]);
        within(
            "φ",
            state.phi,
            ((x * x + r * r - l * l) / (2.0 * r * x)).acos(),
            1e-12,
        );
    }
    let (dwell, back) = (motion.at(0.25), motion.at(motion.duration()));
    assert!(dwell.omega == 0.0 && dwell.alpha == 0.0);
    within("back", slider_derivatives(back.phi)[0], 0.205, 1e-14);
    // The other branch is its mirror image.
    let other = STROKE.replace("90 deg", "270 deg");
    let other = read(&with_motion("press.toml", &other)).motion.unwrap();
    for t in [0.0, 0.07, 0.2, 0.4] {
        let (a, b) = (motion.at(t), other.at(t));
        within("mirrored φ", b.phi, TAU - a.phi, 1e-12);
        within("mirrored ω", b.omega, -a.omega, 1e-10);
    }
}

/// Through the four-bar, against the closure of its loop: crank pin and rocker pin stay a coupler's length apart.
#[test]
fn a_crank_rocker_follows_its_rocker() {
    let text = with_motion(
        "four-bar.toml",
        "type = \"point-to-point\"; of = { link = \"rocker\" }; near = \"90 deg\"; start = \"70 deg\"; \
         [[motion.segment]]; law = \"polynomial-7\"; move = \"45 deg\"; duration = \"0.4 s\"; start_speed = \"5 rpm\"",
    );
    let file = read(&text);
    let motion = file.motion.as_ref().unwrap();
    let mechanism = file.machine.mechanism();
    let joints = |phi: f64| {
        let frames = mechanism.frames(phi).unwrap();
        mechanism.joints(phi, &frames).unwrap()[1..3]
            .iter()
            .map(|joint| match joint {
                jred::machine::Joint::Revolute([a, _]) => a.position(&frames).map(|c| c.value),
                _ => panic!("{joint:?}"),
            })
            .collect::<Vec<_>>()
    };
    let length = |phi: f64| {
        let pins = joints(phi);
        (pins[1][0] - pins[0][0]).hypot(pins[1][1] - pins[0][1])
    };
    let coupler = length(1.0);
    for k in 0..=100 {
        let t = 0.4 * f64::from(k) / 100.0;
        let (asked, state) = (motion.prescribed(t), motion.at(t));
        let rocker = mechanism.frames(state.phi).unwrap()[2].psi;
        within("rocker", rocker.value, asked.phi, 1e-13);
        within(
            "rocker's speed",
            rocker.velocity(state.omega),
            asked.omega,
            1e-12,
        );
        let bend = rocker.acceleration(state.omega, state.alpha);
        within("rocker's acceleration", bend, asked.alpha, 1e-10);
        within("coupler", length(state.phi), coupler, 1e-14);
    }
    within(
        "start",
        motion.prescribed(0.0).omega,
        5.0 * PI / 30.0,
        1e-12,
    );
}

/// Every link of every machine, in x, y, angle and along its path, and every guide: forwards through the mechanism it is what was asked for.
#[test]
fn every_mechanism_is_inverted() {
    let law = MotionSegment::law(1.0, 1.0, jred::machine::motion::Law::Cycloidal);
    let mut counts = std::collections::BTreeMap::new();
    for (path, file) in machines() {
        let mechanism = file.machine.mechanism();
        let mut measures: Vec<(Measure, &str)> = Vec::new();
        for link in 0..mechanism.own_links() {
            let at = [0.013, -0.007];
            for axis in 0..2 {
                measures.push((Measure::Position { link, at, axis }, "position"));
            }
            measures.push((Measure::Path { link, at }, "path"));
            measures.push((Measure::Angle { link }, "angle"));
        }
        for joint in 0..mechanism.joint_names().len() {
            measures.push((Measure::Slide { joint }, "slide"));
        }
        // A seventh of them, each on another branch: all take two minutes.
        for (index, (measure, kind)) in measures.into_iter().enumerate() {
            if index % 7 == 0 {
                let share = [0.11, 0.52, 0.83][index / 7 % 3];
                let place = mechanism.domain().position(share);
                let Ok(tool) = ToolCoordinate::new(mechanism, measure, kind.to_owned(), place)
                else {
                    continue;
                };
                // From a tenth to nine tenths of the branch, or over 2.3 turns.
                let (start, way) = match (tool.ends(), tool.per_turn()) {
                    (Some([[_, low], [_, high]]), _) => {
                        (low + 0.1 * (high - low), 0.8 * (high - low))
                    }
                    (None, turn) => (tool.value_near(), 2.3 * turn.unwrap()),
                };
                if way.abs() < 1e-6 {
                    continue;
                }
                let segment = MotionSegment {
                    distance: way,
                    ..law.clone()
                };
                let motion = Motion::segments(start, &[segment], false)
                    .unwrap()
                    .of_tool(tool.clone());
                check(
                    &file,
                    &motion,
                    &tool,
                    way,
                    &format!("{} {measure:?}", path.display()),
                );
                *counts.entry(kind).or_insert(0) += 1;
            }
        }
    }
    println!("{counts:?}");
    for kind in ["position", "path", "angle", "slide"] {
        assert!(
            counts.get(kind).is_some_and(|count| *count >= 5),
            "{counts:?}"
        );
    }
}

fn check(file: &MachineFile, motion: &Motion, tool: &ToolCoordinate, way: f64, what: &str) {
    let domain = file.machine.domain();
    for k in 1..20 {
        let t = f64::from(k) / 20.0;
        let (asked, state) = (motion.prescribed(t), motion.at(t));
        if let Domain::Stroke { from, to } = domain {
            assert!((from..=to).contains(&state.phi), "{what}");
        }
        let found = tool.at(state.phi).unwrap();
        within(what, found.value, asked.phi, 1e-11 * way.abs());
        within(
            what,
            found.velocity(state.omega),
            asked.omega,
            1e-11 * way.abs(),
        );
        let size = way.abs() * 10.0 + (found.d2 * state.omega * state.omega).abs();
        within(
            what,
            found.acceleration(state.omega, state.alpha),
            asked.alpha,
            1e-11 * size,
        );
    }
}

/// The distance of a crank pin is its radius times the angle; that of a slider, the difference of its positions.
#[test]
fn distances_along_a_path() {
    let file = read(&text_of("press.toml"));
    let mechanism = file.machine.mechanism();
    let along = |link: usize, at: [f64; 2], place: f64| {
        ToolCoordinate::new(mechanism, Measure::Path { link, at }, String::new(), place).unwrap()
    };
    let pin = along(0, [0.03, 0.0], 0.4);
    within("a turn", pin.per_turn().unwrap(), TAU * 0.03, 1e-15);
    within(
        "three turns",
        pin.drive_at(3.0 * TAU * 0.03),
        0.4 + 3.0 * TAU,
        1e-13,
    );
    within("backwards", pin.drive_at(-0.03), 0.4 - 1.0, 1e-13);
    let ram = along(2, [0.0, 0.0], 1.0);
    let way = 0.02;
    let expected = slider_derivatives(1.0)[0] - way;
    within(
        "ram",
        slider_derivatives(ram.drive_at(way))[0],
        expected,
        1e-14,
    );
    assert!(ram.per_turn().is_none());
    // A point of the rod: its path by the trapezoidal rule over closed-form places.
    let rod = along(1, [0.05, 0.02], 1.0);
    let place = |phi: f64| {
        let [x, y] = mechanism.frames(phi).unwrap()[1].point([0.05, 0.02]);
        [x.value, y.value]
    };
    let (mut length, steps) = (0.0, 20_000);
    for k in 0..steps {
        let at = |k: i32| place(1.0 + 2.0 * f64::from(k) / f64::from(steps));
        let ([x, y], [u, v]) = (at(k), at(k + 1));
        length += (u - x).hypot(v - y);
    }
    within("rod", rod.drive_at(length), 3.0, 1e-8);
}

/// The table behind gears goes on without end; what its motor shaft does is the ratio times as much.
#[test]
fn an_endless_tool() {
    let steady = "type = \"constant-speed\"; of = { link = \"shaft-3\" }; speed = \"10 rpm\"";
    let motion = read(&with_motion("turntable.toml", steady)).motion.unwrap();
    let omega = motion.at(0.3).omega;
    within("speed", omega.abs(), 12.0 * 10.0 * PI / 30.0, 1e-12);
    within("one turn", motion.duration() * omega.abs(), TAU, 1e-12);
    let index = "type = \"cycle\"; of = { link = \"shaft-3\" }; [[motion.segment]]; law = \"modified-sine\"; move = \"60 deg\"; \
         duration = \"0.6 s\"; [[motion.segment]]; dwell = \"0.4 s\"";
    let motion = read(&with_motion("turntable.toml", index)).motion.unwrap();
    let way = motion.at(1.0).phi - motion.at(0.0).phi;
    within("way", way.abs(), 12.0 * PI / 3.0, 1e-12);
}

/// A drive of the tool is the drive of the machine: at constant crank speed, a recording of the ram alone gives the crank's motion back.
#[test]
fn a_recording_of_the_ram() {
    let omega = 3.0;
    let mut csv = String::from("t [s],x [m]\n");
    for k in 0..=400 {
        let t = 0.6 * f64::from(k) / 400.0;
        writeln!(csv, "{t},{:e}", slider_derivatives(0.6 + omega * t)[0]).unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ram.csv"), csv).unwrap();
    let text = with_motion(
        "press.toml",
        "type = \"profile\"; of = { point = \"slider\", along = \"x\" }; near = \"90 deg\"; file = \"ram.csv\"; cyclic = false",
    );
    let file = crate::reading::parse_in(&text, folder.path());
    let motion = file.unwrap_or_else(|e| panic!("{e:?}")).motion.unwrap();
    for k in 1..60 {
        let t = 0.01 * f64::from(k);
        let state = motion.at(t);
        within("φ", state.phi, 0.6 + omega * t, 1e-9);
        within("ω", state.omega, omega, 1e-5);
        // The spline's second derivative is good to h²/12 of the fourth.
        within("α", state.alpha, 0.0, 2e-2);
    }
}

#[test]
fn what_no_drive_can_do_is_refused() {
    let ram = |motion: &str| {
        with_motion(
            "press.toml",
            &format!("type = \"cycle\"; of = {{ point = \"slider\", along = \"x\" }}; {motion}"),
        )
    };
    let law = "[[motion.segment]]; law = \"cycloidal\"; move = \"10 mm\"; duration = \"0.1 s\"";
    refuses(
        &ram(law),
        &[
            "at φ = 0 deg, x of slider is at a dead centre",
            "near = \"…\"",
        ],
    );
    refuses(
        &ram(&format!("near = \"90 deg\"; start = \"205 mm\"; {law}")),
        &[
            "number 1 leads x of slider to 215 mm: at t = 0.05 s it reaches its dead centre at φ = 0 deg, x = 210 mm",
            "keep x of slider between 150 mm and 210 mm",
        ],
    );
    // The end of the move, not the first piece of it that is out of reach.
    let pieces = law
        .replace("cycloidal", "trapezoid")
        .replace("10 mm", "30 mm");
    refuses(
        &ram(&format!("near = \"90 deg\"; start = \"205 mm\"; {pieces}")),
        &["leads x of slider to 235 mm: at t = "],
    );
    // A full stroke begins and ends at dead centres.
    let back = law.replace("10 mm", "-60 mm");
    refuses(
        &ram(&format!("near = \"90 deg\"; start = \"210 mm\"; {back}")),
        &[
            "number 1 starts with x of slider at its dead centre, at φ = 0 deg, x = 210 mm",
            "a full stroke, and whatever passes a dead centre, is a motion of the drive link",
        ],
    );
    let back = law.replace("10 mm", "-30 mm");
    refuses(
        &ram(&format!("near = \"90 deg\"; start = \"180 mm\"; {back}")),
        &[
            "number 1 leads x of slider to its dead centre, at φ = 180 deg, x = 150 mm, at t = 0.1 s",
        ],
    );
    refuses(
        &ram(&format!("near = \"90 deg\"; start = \"215 mm\"; {law}")),
        &[
            "`start` in [motion] is 215 mm, but between two dead centres x of slider goes from 150 mm to 210 mm",
        ],
    );
    refuses(
        &ram(&format!("near = \"90 deg\"; start = \"180 mm\"; {law}")),
        &[
            "add up to 10 mm, so it does not end where it started",
            "add a move of -10 mm",
        ],
    );
    refuses(
        &with_motion(
            "press.toml",
            "type = \"constant-speed\"; of = { point = \"slider\", along = \"x\" }; near = \"90 deg\"; speed = \"1 m/s\"",
        ),
        &["x of slider goes from 150 mm to 210 mm only: it cannot move on forever"],
    );
    refuses(
        &with_motion("press.toml", "type = \"cycle\"; of = { link = \"slider\" }"),
        &["is angle of slider, which does not change when the drive link moves"],
    );
    refuses(
        &with_motion(
            "press.toml",
            "type = \"cycle\"; of = { slide = \"crank pin\" }",
        ),
        &["`slide` in [motion.of] is not a guide"],
    );
    refuses(
        &with_motion(
            "press.toml",
            "type = \"cycle\"; of = { point = \"slider\" }",
        ),
        &["`along` in [motion.of] is missing"],
    );
    refuses(
        &with_motion(
            "press.toml",
            "type = \"cycle\"; of = { link = \"rod\", point = \"slider\" }",
        ),
        &["[motion.of] has both `point` and `link`"],
    );
    refuses(
        &with_motion("press.toml", "type = \"cycle\"; near = \"90 deg\""),
        &["`near` in [motion] is given without `of`"],
    );
}
