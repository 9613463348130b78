//! The overshoot of a law beyond its end, or an initial backward motion, is not kept.

use std::f64::consts::TAU;
use std::path::Path;

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Motion, Node};
use jred_motion::gentlest::cycle::{GentlestResult, Goal, Request, gentlest_cycle};
use jred_motion::gentlest::{Optimum, without_drive};
use jred_motion::moves::{Chain, Part, chain};

use crate::support::near;

/// 20 kg of 600 mm diameter: ½·m·r².
const INERTIA: f64 = 0.9;
/// 60 rpm, 140 deg in 1 s.
const SPEED: f64 = TAU;
const DISTANCE: f64 = TAU * 140.0 / 360.0;
const TIME: f64 = 1.0;

const STEADY: &str = "law = \"constant-speed\"; speed = \"60 rpm\"; move = \"20 deg\"";
const STOP: &str = "law = \"polynomial-5\"; move = \"140 deg\"; duration = \"1 s\"";

/// A table with viscous friction (N·m·s/rad) and segments, each "key = value" by "; ".
fn table(viscous: f64, segments: &[&str]) -> MachineFile {
    let mut text = "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n\
         table = { diameter = \"600 mm\", mass = \"20 kg\" }\n"
        .to_owned();
    if viscous > 0.0 {
        let load = [
            "[[load]]\non = \"table\"\nviscous_moment = \"",
            " N m s/rad\"\n",
        ];
        text += &load.join(&viscous.to_string());
    }
    text += "[motion]\ntype = \"point-to-point\"\nstart = \"200 deg\"\n";
    for segment in segments {
        text += "[[motion.segment]]\n";
        text += &segment.replace("; ", "\n");
        text += "\n";
    }
    checked::parse("machine.toml", &text, Path::new("")).unwrap()
}

fn of(file: &MachineFile) -> Chain {
    chain(file.motion.as_ref().unwrap(), &file.process()).unwrap()
}

fn solved(file: &MachineFile) -> GentlestResult {
    let request = Request {
        actuator: without_drive(),
        copper: None,
        goal: Goal::Rms,
        ramp: 0.0,
        sampling: 4000.into(),
    };
    gentlest_cycle(file, file.motion.as_ref().unwrap(), &request).unwrap()
}

/// Least ∫(J·a)² from a speed to rest and the reverse: the speed is a parabola, v ≥ 0 as long as D ≥ v₀·T/3.
#[test]
fn a_stop_ends_where_it_is_asked_to() {
    let start = "law = \"polynomial-5\"; move = \"140 deg\"; duration = \"1 s\"";
    let [v, d, t] = [SPEED, DISTANCE, TIME];
    assert!(d > v * t / 3.0);
    let heat =
        INERTIA * INERTIA * 4.0 / t.powi(3) * (3.0 * d * d - 3.0 * d * v * t + v * v * t * t);
    for (segments, beyond_end) in [([STEADY, STOP], true), ([start, STEADY], false)] {
        let file = table(0.0, &segments);
        let chain = of(&file);
        assert_eq!(chain.parts.len(), 2, "{:?}", chain.parts);
        let [overshoot] = chain.overshoots.as_slice() else {
            panic!("{:?}", chain.overshoots);
        };
        assert_eq!(overshoot.segment, usize::from(beyond_end));
        let [before, beyond] = overshoot.by;
        assert!((before > 0.0, beyond > 0.0) == (!beyond_end, beyond_end));
        let (step, ends) = chain.parts.iter().find_map(Part::step).unwrap();
        near("distance", step.to - step.from, d, 1e-12);
        near("time", step.duration, t, 1e-12);
        // The speed of the kept part, and rest.
        near("speeds", ends.speeds[0] + ends.speeds[1], v, 1e-12);
        let found = solved(&file);
        assert_eq!(found.optimum(), Optimum::Global);
        // The search uses parabolas, so only roundings remain.
        near("heat", found.moves[0].cost, heat, 1e-9 * heat);
        let cycle = t + 20.0 / 360.0;
        let rms = (heat / cycle).sqrt();
        near("RMS", found.best.rms, rms, 1e-9 * rms);
        let motion = &found.motion;
        let times = (0..=1000).map(|k| cycle * f64::from(k) / 1000.0);
        let least = times.map(|t| motion.at(t).omega).fold(v, f64::min);
        assert!(least > -1e-9 * v, "{least}");
    }
}

/// The same with viscous friction c: v = A·exp(k·t) + B·exp(−k·t) + C with k = c/J, so the torque is 2·c·A·exp(k·t) + c·C.
#[test]
fn a_stop_with_viscous_friction() {
    let c = 0.8;
    let [v, d, t, k] = [SPEED, DISTANCE, TIME, c / INERTIA];
    let e = (k * t).exp();
    // A + B + C = v, A·e + B/e + C = 0, A·(e − 1)/k + B·(1 − 1/e)/k + C·t = d: B and C by A, then A.
    let [p, q] = [(e - 1.0) / k, (1.0 - 1.0 / e) / k];
    let fall = 1.0 - 1.0 / e;
    // B·fall = v + A·(e − 1); C = v − A − B.
    let b = |a: f64| (v + a * (e - 1.0)) / fall;
    let rest = |a: f64| a * p + b(a) * q + (v - a - b(a)) * t - d;
    let a = -rest(0.0) / (rest(1.0) - rest(0.0));
    let level = v - a - b(a);
    let heat = c
        * c
        * (2.0 * a * a * (e * e - 1.0) / k + 4.0 * a * level * (e - 1.0) / k + level * level * t);
    // From an independent computation.
    near("heat", heat, 14.252, 5e-4);
    let found = solved(&table(c, &[STEADY, STOP]));
    assert_eq!(found.moves.len(), 1);
    near("found", found.moves[0].cost, heat, 1e-6 * heat);
}

/// Requested reversals are kept: a turn between speeds of opposite directions, a law that goes back farther than the length of its move, and a
/// recorded motion.
#[test]
fn turns_that_are_asked_for_stay() {
    let turn = "law = \"polynomial-5\"; move = \"10 deg\"; duration = \"0.5 s\"";
    let back = "law = \"constant-speed\"; speed = \"-60 rpm\"; move = \"-30 deg\"";
    let rest = "law = \"polynomial-5\"; move = \"-140 deg\"; duration = \"0.8 s\"";
    let chained = of(&table(0.0, &[STEADY, turn, back, rest]));
    let mut kinds = chained.parts.iter().map(|part| part.step().is_some());
    assert!(kinds.by_ref().eq([false, true, true, false, true]));
    assert!(chained.overshoots.is_empty());
    let short = "law = \"polynomial-5\"; move = \"1 deg\"; duration = \"1 s\"";
    let chained = of(&table(0.0, &[STEADY, short]));
    assert_eq!((chained.parts.len(), chained.overshoots.len()), (3, 0));
    // Speeds that rise and fall as cubics with zero end slopes: the distance is that at the mean of both.
    let node = |t: f64, step: f64, phi: f64, omega: f64| Node {
        t,
        step,
        phi,
        omega,
        alpha: [0.0; 2],
    };
    let recorded = [
        node(0.0, 0.0, 0.0, 0.0),
        node(1.0, 1.0, 0.5, 1.0),
        node(2.0, 1.0, 1.0, 0.0),
        node(2.5, 0.5, 0.995, -0.02),
        node(3.0, 0.5, 0.99, 0.0),
    ];
    let chained = chain(&Motion::nodes(&recorded, false), &[]).unwrap();
    assert_eq!((chained.parts.len(), chained.overshoots.len()), (2, 0));
}
