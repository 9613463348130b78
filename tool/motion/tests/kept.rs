//! Prescribed process parts of a motion are kept; the parts between are recomputed.

use std::f64::consts::TAU;
use std::path::Path;

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_motion::fastest::cycle::cycle;
use jred_motion::fastest::{MoveLimits, Rms};
use jred_motion::gentlest::cycle::{GentlestResult, Goal, Request, gentlest_cycle};
use jred_motion::gentlest::without_drive;
use jred_motion::moves::{Chain, NoMoves, Part, chain};
use jred_motion::path_dynamics::Actuator;
use jred_sizing::catalogue::Motor;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;

use crate::support::near;

fn example(name: &str) -> MachineFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    checked::read(&folder.join(format!("{name}.toml"))).unwrap()
}

/// A table of 2 kg·m² with friction (N·m), and segments, each "key = value" by "; ".
fn table(friction: f64, segments: &[&str]) -> MachineFile {
    let mut text = "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n\
         [mechanism.table]\ninertia = \"2 kg m^2\"\n"
        .to_owned();
    if friction > 0.0 {
        let load = ["[[load]]\non = \"table\"\nopposing_moment = \"", " N m\"\n"];
        text += &load.join(&friction.to_string());
    }
    text += "[motion]\ntype = \"cycle\"\n";
    for segment in segments {
        text += "[[motion.segment]]\n";
        text += &segment.replace("; ", "\n");
        text += "\n";
    }
    checked::parse("machine.toml", &text, Path::new("")).unwrap()
}

fn of(file: &MachineFile) -> (&Motion, Chain) {
    let motion = file.motion.as_ref().unwrap();
    (motion, chain(motion, &file.process()).unwrap())
}

fn solved(file: &MachineFile, goal: Goal, ramp: f64) -> GentlestResult {
    let request = Request {
        actuator: without_drive(),
        copper: Some(2.0),
        goal,
        ramp,
        sampling: 4000.into(),
    };
    gentlest_cycle(file, file.motion.as_ref().unwrap(), &request).unwrap()
}

/// 100 N·m up to 60 rad/s.
fn motor() -> Actuator {
    let motor = Motor {
        peak_torque: Some(100.0),
        peak_curve: vec![[0.0, 100.0], [60.0, 100.0]],
        max_speed: Some(60.0),
        ..Motor::default()
    };
    Actuator {
        coefficients: Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]),
        ratio: 1.0,
        envelope: Envelope::of(&motor),
    }
}

/// The knives of a flying shear run with the strip: that part is kept, and the remaining turn begins and ends with its speed.
#[test]
fn a_flying_shear_keeps_its_synchrony() {
    let file = example("flying-shear");
    let (motion, chain) = of(&file);
    let [Part::Kept(kept), Part::Passing(step, ends)] = chain.parts.as_slice() else {
        panic!("{:?}", chain.parts);
    };
    assert_eq!((kept.segment, kept.speed, chain.endless), (0, 2.0, false));
    near("time", kept.duration, 0.04, 1e-12);
    near("round", step.to - kept.from, TAU, 1e-12);
    near("from there", step.from, kept.to, 1e-15);
    for speed in ends.speeds {
        near("speed", speed, motion.at(0.0).omega, 1e-9);
    }
    let made = [
        solved(&file, Goal::Rms, 0.0).trace,
        solved(&file, Goal::Rms, 0.1).trace,
        solved(&file, Goal::Peak, 0.0).trace,
        cycle(&file, &motor(), MoveLimits::default(), None, &chain.parts)
            .unwrap()
            .trace,
    ];
    for trace in made {
        for k in 0..=200 {
            let t = 0.04 * (f64::from(k) * 0.00499 + 0.001);
            let (own, found) = (motion.at(t), trace.at(t));
            near("position", found.phi, own.phi, 1e-9);
            near("speed", found.omega, own.omega, 1e-8);
            assert!((found.alpha - own.alpha).abs() < 1e-5 * 12.5 * 12.5);
        }
    }
}

/// A move with a ramp starts from a kept part with its acceleration; one with free ends jumps.
#[test]
fn ramps_begin_with_the_acceleration_of_the_kept_part() {
    let file = example("flying-shear");
    let jumps = |ramp: f64| {
        let trace = solved(&file, Goal::Rms, ramp).trace;
        let border = trace
            .nodes()
            .iter()
            .find(|node| (node.t - 0.04).abs() < 1e-9);
        let [before, after] = border.unwrap().alpha;
        (after - before).abs() / before.abs()
    };
    assert!(jumps(0.1) < 1e-9, "{}", jumps(0.1));
    assert!(jumps(0.0) > 0.1, "{}", jumps(0.0));
}

/// The ram of a drawing press: its pause is inside a cycle that begins in motion, and is kept as well.
#[test]
fn a_drawing_press_keeps_its_stroke_and_its_pause() {
    let file = example("drawing-press");
    let (motion, chain) = of(&file);
    let [
        Part::Kept(kept),
        Part::Passing(_, first),
        Part::Dwell { duration, .. },
        Part::Passing(_, last),
    ] = chain.parts.as_slice()
    else {
        panic!("{:?}", chain.parts);
    };
    assert!(first.speeds[0] > 0.0 && first.speeds[1] == 0.0);
    assert!(last.speeds[0] == 0.0 && last.speeds[1] > 0.0);
    near("pause", *duration, 0.2, 1e-9);
    near("stroke", kept.duration, 0.011 / 0.08, 1e-9);
    let whole: f64 = chain.parts.iter().map(Part::duration).sum();
    near("whole", whole, motion.duration(), 1e-12);
    let found = solved(&file, Goal::Rms, 0.0);
    assert!(found.best.rms < found.own.rms && found.bound.unwrap() <= found.best.rms);
    near("bound", found.bound.unwrap(), found.best.rms, 1e-4);
}

/// A constant inertia that passes on at v, with a distance D in a time T in between: 12·J²·(D − v·T)²/T³, and friction throughout.
#[test]
fn a_kept_part_counts_in_full() {
    let steady = "law = \"constant-speed\"; speed = \"2 rad/s\"; move = \"1 rad\"";
    let round = "law = \"polynomial-5\"; move = \"5.283185307179586 rad\"; duration = \"1 s\"";
    let file = table(0.0, &[steady, round]);
    let found = solved(&file, Goal::Rms, 0.0);
    let cost = 12.0 * 4.0 * (TAU - 1.0 - 2.0_f64).powi(2);
    near("RMS", found.best.rms, (cost / 1.5).sqrt(), 1e-5);
    near("bound", found.bound.unwrap(), (cost / 1.5).sqrt(), 1e-6);
    // C added to a torque of zero mean, as between equal speeds.
    let file = table(3.0, &[steady, round]);
    let found = solved(&file, Goal::Rms, 0.0);
    let exact = (cost / 1.5 + 9.0).sqrt();
    near("RMS", found.best.rms, exact, 1e-5);
    near("bound", found.bound.unwrap(), exact, 1e-6);
    assert_eq!(found.laws.len(), 1);
    let peak = solved(&file, Goal::Peak, 0.0);
    assert!(peak.bound.unwrap() <= peak.best.peak && peak.best.peak < peak.own.peak);
}

/// A cycle that begins inside a move is started at a kept part.
#[test]
fn a_cycle_begins_with_what_is_kept() {
    let segments = [
        "law = \"polynomial-5\"; move = \"1 rad\"; duration = \"0.4 s\"; start_speed = \"3 rad/s\"",
        "law = \"constant-speed\"; speed = \"2 rad/s\"; move = \"1 rad\"",
        "law = \"polynomial-5\"; move = \"4.283185307179586 rad\"; duration = \"1 s\"; end_speed = \"3 rad/s\"",
    ];
    let file = table(0.0, &segments);
    let (motion, chain) = of(&file);
    let [Part::Kept(kept), Part::Passing(step, ends)] = chain.parts.as_slice() else {
        panic!("{:?}", chain.parts);
    };
    near("begins", chain.begins, 0.4, 1e-12);
    near("kept", kept.from, motion.at(0.4).phi, 1e-12);
    near("time", step.duration, 1.4, 1e-12);
    near("round", step.to - kept.from, TAU, 1e-12);
    for speed in ends.speeds {
        near("speed", speed, 2.0, 1e-12);
    }
    let found = solved(&file, Goal::Rms, 0.0);
    near("whole", found.motion.duration(), motion.duration(), 1e-9);
    near("speed", found.motion.at(0.2).omega, 2.0, 1e-9);
}

/// Without a kept part it starts at a rest, so that the pause is kept.
#[test]
fn a_cycle_that_begins_in_motion_keeps_its_pause() {
    let segments = [
        "law = \"polynomial-5\"; move = \"3 rad\"; duration = \"1 s\"; start_speed = \"3 rad/s\"; end_speed = \"0 rad/s\"",
        "dwell = \"0.5 s\"",
        "law = \"polynomial-5\"; move = \"3.283185307179586 rad\"; duration = \"1 s\"; end_speed = \"3 rad/s\"",
    ];
    let file = table(0.0, &segments);
    let (_, chain) = of(&file);
    let [Part::Dwell { duration, .. }, Part::Move(step)] = chain.parts.as_slice() else {
        panic!("{:?}", chain.parts);
    };
    near("pause", *duration, 0.5, 1e-9);
    near("move", step.to - step.from, TAU, 1e-9);
    near("begins", chain.begins, 1.0, 1e-9);
}

/// A motion of constant speed only: if it is endless, the fastest and the gentlest turn are computed, and the constant speed is reported as not kept;
/// otherwise nothing is left to compute.
#[test]
fn a_constant_speed_alone_is_no_process() {
    let file = example("shaper");
    let (_, chain) = of(&file);
    assert!(chain.endless && chain.given_up.is_some());
    let once = table(
        0.0,
        &["law = \"constant-speed\"; speed = \"2 rad/s\"; move = \"1 rad\""],
    );
    let motion = once.motion.as_ref().map(|motion| {
        let mut once = motion.clone();
        once.cyclic = false;
        once
    });
    let found = chain_of(motion.as_ref().unwrap(), &once);
    assert_eq!(found, Err(NoMoves::AllKept));
}

fn chain_of(motion: &Motion, file: &MachineFile) -> Result<Chain, NoMoves> {
    chain(motion, &file.process())
}

/// The web of a winder runs at its speed, with any law leading to it; only start and stop are computed.
#[test]
fn a_winder_keeps_the_speed_of_its_web() {
    let file = example("winder");
    let (_, chain) = of(&file);
    let [Part::Passing(..), Part::Kept(kept), Part::Passing(..)] = chain.parts.as_slice() else {
        panic!("{:?}", chain.parts);
    };
    near("web", kept.speed, 4.0, 1e-12);
    let found = solved(&file, Goal::Rms, 0.0);
    let (own, best) = (found.own, found.best);
    assert!(
        best.rms <= own.rms && best.speed < 2.0 * own.speed,
        "{own:?} {best:?}"
    );
}

/// A kept part that exceeds the drive is reported; the RMS torque over the cycle can still be limited.
#[test]
fn a_kept_part_beside_the_limits() {
    let steady = "law = \"constant-speed\"; speed = \"2 rad/s\"; move = \"1 rad\"";
    let round = "law = \"polynomial-5\"; move = \"5.283185307179586 rad\"; duration = \"1 s\"";
    let file = table(3.0, &[steady, round]);
    let (_, chain) = of(&file);
    let made = |limits: MoveLimits, rms| cycle(&file, &motor(), limits, rms, &chain.parts).unwrap();
    let free = made(MoveLimits::default(), None);
    assert!(!free.kept[0].exceeds());
    near(
        "time",
        free.trace.duration(),
        0.5 + free.moves[0].fastest.time,
        1e-12,
    );
    let slow = MoveLimits {
        speed: Some(1.9),
        ..MoveLimits::default()
    };
    let found = cycle(&file, &motor(), slow, None, &chain.parts);
    assert!(found.is_err(), "a start beyond the limit of the speed");
    let cool = made(MoveLimits::default(), Some(Rms::Torque(20.0)));
    near("RMS", cool.load.rms, 20.0, 1e-6);
    near("kept", cool.trace.at(0.25).omega, 2.0, 1e-9);
}
