//! A part of the turn as the range of the drive link, and the reduction at single states.

use std::f64::consts::TAU;
use std::path::Path;

use crate::reader;
use jred::Domain;
use jred::machine::{Mechanism, Reducible};
use jred_analysis::duty::Duty;
use jred_analysis::reduce::{DrivePoint, Over, Request, Sets, reduce_at};
use jred_file::argument;
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

use crate::reading::oblique_slider_crank;
use crate::support::{edited, near, press_text};

fn parse(text: &str) -> Result<MachineFile, String> {
    reader::parse("machine.toml", text, Path::new("")).map_err(|report| format!("{report:?}"))
}

fn crank(stroke: &str, more: &str) -> String {
    let kind = "type = \"slider-crank\"";
    let text = oblique_slider_crank("4 kg", &format!("{more}\n"));
    edited(&text, kind, &format!("{kind}\n{stroke}"))
}

const SWING: &str = "[motion]\ntype = \"cycle\"\nstart = \"300 deg\"\n\
    [[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"110 deg\"\nduration = \"0.4 s\"\n\
    [[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"-110 deg\"\nduration = \"0.3 s\"\n";

const STROKE: &str = "stroke = [\"290 deg\", \"420 deg\"]";

/// A crank that swings needs what the same crank needs that could turn fully; a load on its stroke is the load on the turn.
#[test]
fn a_crank_that_swings_needs_what_a_crank_needs() {
    let load = |between: &str| {
        format!(
            "[[load]]\non = \"slider\"\nforce = [\"-500 N\", \"0 N\"]\nbetween = {between}\nramp = \"10 deg\"\n{SWING}"
        )
    };
    let whole = parse(&crank("", &load("[\"0 deg\", \"40 deg\"]"))).unwrap();
    let part = parse(&crank(STROKE, &load("[\"360 deg\", \"400 deg\"]"))).unwrap();
    let [from, to] = [290.0, 420.0].map(f64::to_radians);
    assert_eq!(part.machine.domain(), Domain::Stroke { from, to });
    for k in 0..200 {
        let phi = part.machine.domain().position(f64::from(k) / 199.0);
        let [a, b] = [&whole, &part].map(|file| file.machine.forces(phi, 5.0, -20.0).unwrap());
        near("drive", a.drive, b.drive, 1e-12);
        let [a, b] = [&whole, &part].map(|file| file.machine.reduction(phi).unwrap());
        near("inertia", a.inertia, b.inertia, 1e-12);
        assert!((a.process - b.process).abs() < 1e-9);
    }
    let duty = |file: &MachineFile| Duty::new(file, file.motion.as_ref().unwrap(), 1000).unwrap();
    let figures = |file: &MachineFile| duty(file).figures(|i| i.input_torque);
    let (a, b) = (figures(&whole), figures(&part));
    near("rms", a.rms, b.rms, 1e-9);
    near("most", a.max, b.max, 1e-9);
    assert!(a.max.max(-a.min) > 5.0);
    // Only over its stroke is the weight held.
    assert!(duty(&part).hold_torque <= duty(&whole).hold_torque);
}

/// The edges of a mechanism lie on the stroke where the turn passes them.
#[test]
fn edges_lie_on_the_stroke() {
    let geneva = include_str!("../../../machines/geneva.toml");
    let (head, motion) = geneva.split_once("[motion]").unwrap();
    assert!(!motion.contains("[mechanism]"));
    let edges = |text: &str| -> Vec<f64> {
        let file = parse(text).unwrap();
        (0..)
            .map_while(|k| file.machine.mechanism().edge(k))
            .collect()
    };
    let own = edges(head);
    assert_eq!(own.len(), 2);
    let stroke = "type = \"geneva\"\nstroke = [\"350 deg\", \"700 deg\"]";
    let on_stroke = edges(&head.replacen("type = \"geneva\"", stroke, 1));
    assert_eq!(on_stroke.len(), 2);
    for edge in &on_stroke {
        assert!((350f64.to_radians()..700f64.to_radians()).contains(edge));
        let off = own.iter().map(|own| {
            let turns = (edge - own) / TAU;
            (turns - turns.round()).abs()
        });
        assert!(off.fold(1.0, f64::min) < 1e-12, "{edge}");
    }
}

#[test]
fn strokes_that_cannot_be_are_refused() {
    let says = |text: &str, words: &str| {
        let message = parse(text).expect_err(words);
        let plain: String = message.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            plain.replace(" │ ", " ").contains(words),
            "{words}:\n{message}"
        );
    };
    let turned = "stroke = [\"90 deg\", \"10 deg\"]";
    says(&crank(turned, ""), "runs from 90 deg to 10 deg");
    let turn = "stroke = [\"0 deg\", \"360 deg\"]";
    says(&crank(turn, ""), "runs from 0 deg to 360 deg");
    says(
        &crank("stroke = [\"310 deg\", \"420 deg\"]", SWING),
        "outside the stroke",
    );
    let cam = include_str!("../../../machines/cam-translating.toml");
    let stroke = "type = \"disc-cam\"\nstroke = [\"10 deg\", \"90 deg\"]";
    says(
        &cam.replacen("type = \"disc-cam\"", stroke, 1),
        "is not for a cam",
    );
}

/// Each row is the machine in the state that is given; without one, that of the motion.
#[test]
fn single_states_are_reduced() {
    let file = parse(&press_text()).unwrap();
    let domain = file.machine.domain();
    let link = Axis::of_drive(Coordinate::Angle);
    let at = argument::drive_states(
        "30 deg, 60 rpm, -5 rad/s^2, 200 deg, 390 deg, -2 rad/s",
        domain,
        [&link; 2],
    )
    .unwrap();
    let given = |phi: f64, state: Option<[f64; 2]>| DrivePoint {
        phi: phi.to_radians(),
        state,
    };
    assert_eq!(
        at,
        [
            given(30.0, Some([TAU, -5.0])),
            given(200.0, None),
            given(390.0, Some([-2.0, 0.0]))
        ]
    );
    let request = Request {
        over: Over::Angle,
        positions: 2,
        sets: Sets {
            reactions: true,
            ..Sets::default()
        },
        state: None,
    };
    let columns = reduce_at(&file, &request, &at).unwrap();
    let drive = columns
        .heads()
        .iter()
        .position(|head| head.name == "T_drive");
    let machine = file.with_drive_train().unwrap();
    let rows: Vec<f64> = columns
        .rows()
        .iter()
        .map(|row| row[drive.unwrap()].unwrap())
        .collect();
    let torque = |phi: f64, [omega, alpha]: [f64; 2]| {
        let reduction = machine.reduction(phi).unwrap();
        reduction.torque(omega, alpha).total()
    };
    near("first", rows[0], torque(at[0].phi, [TAU, -5.0]), 1e-10);
    near("last", rows[2], torque(at[2].phi, [-2.0, 0.0]), 1e-10);
    // The press turns once in its cycle: the motion passes 200 degrees once.
    let motion = file.motion.as_ref().unwrap();
    let (mut low, mut high) = (0.0, motion.duration());
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if motion.at(middle).phi < at[1].phi {
            low = middle;
        } else {
            high = middle;
        }
    }
    let state = motion.at(high);
    near(
        "between",
        rows[1],
        torque(at[1].phi, [state.omega, state.alpha]),
        1e-8,
    );

    for (text, words) in [
        ("60 rpm", "does not follow a position"),
        ("30 deg, 5 rad/s^2", "does not follow a position"),
        ("30 deg, 1 rpm, 2 rpm", "does not follow a position"),
        ("30 deg, far", "\"far\""),
    ] {
        let why = argument::drive_states(text, domain, [&link; 2]).unwrap_err();
        assert!(why.contains(words), "{text}: {why}");
    }
}
