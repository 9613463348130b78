//! Motions over a long time, in which the machine almost stops somewhere.

use std::f64::consts::TAU;

use jred_file::model::motion::{Motion, MotionSegment};
use jred_motion::gentlest::cycle::{Goal, gentlest_cycle};

use super::{example, request, solved};

/// The largest difference between positions and the integral of the speeds, as a share of the range.
fn contradiction(nodes: &[jred_motion::trace::Node]) -> f64 {
    let places = nodes.iter().map(|node| node.phi);
    let range =
        places.clone().fold(f64::NEG_INFINITY, f64::max) - places.fold(f64::INFINITY, f64::min);
    let off = nodes.windows(2).map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        let t = b.t - a.t;
        // The cubic through speeds and accelerations of both.
        let way = 0.5 * t * (a.omega + b.omega) + t * t / 12.0 * (a.alpha[1] - b.alpha[0]);
        (way - (b.phi - a.phi)).abs() / range
    });
    off.fold(0.0, f64::max)
}

/// Positions, speeds and accelerations of a result are consistent; it takes the requested time and is no worse than the file's own motion.
#[test]
fn a_slow_motion_does_not_contradict_itself() {
    for name in [
        "linkage-four-bar",
        "shaper",
        "whitworth",
        "excavator-bucket",
        "load-table",
        "press",
    ] {
        let file = example(name, &[]);
        let motion = file.motion.as_ref().unwrap();
        let found = solved(&file, Goal::Rms, 0.0);
        let off = contradiction(found.trace.nodes());
        assert!(off <= 1e-6, "{name}: {off}");
        let time = found.trace.duration() / motion.duration() - 1.0;
        assert!(time.abs() <= 1e-9, "{name}: {time}");
        assert!(found.best.rms <= found.own.rms, "{name}");
    }
}

/// A press that starts next to its dead centre, where it would have to be held: it waits for any extra time where holding takes nothing. So ∫T² does
/// not grow with the time, and is at least half of that of the motion in its unconstrained time; no other motion of the list is better.
#[test]
#[ignore = "more than five seconds of a processor"]
fn a_press_waits_at_its_dead_centre() {
    for start in [182.0, 200.0] {
        let mut before = f64::INFINITY;
        let mut first = None;
        for duration in [1.0, 1.7, 3.0, 10.0] {
            let file = example(
                "press",
                &[
                    ("start = \"180 deg\"", &format!("start = \"{start} deg\"")),
                    (
                        "duration = \"0.4 s\"",
                        &format!("duration = \"{duration} s\""),
                    ),
                    ("[[motion.segment]]\ndwell = \"0.1 s\"\n", ""),
                ],
            );
            let found = solved(&file, Goal::Rms, 0.0);
            let heat = found.best.rms.powi(2) * duration;
            assert!(
                heat <= before * (1.0 + 2e-3),
                "{start} {duration}: {heat} after {before}"
            );
            before = heat;
            let first = *first.get_or_insert(heat);
            assert!(heat > 0.5 * first, "{start} {duration}: {heat} of {first}");
            assert!(contradiction(found.trace.nodes()) <= 1e-6);
            let time = found.trace.duration() / duration - 1.0;
            assert!(time.abs() <= 1e-9, "{start} {duration}: {time}");
            if let Some(bound) = found.bound {
                assert!(bound <= found.best.rms);
            }
            let gentle = &found.moves[0];
            if duration > 5.0 {
                let centre = (gentle.waits_at.to_degrees() - 540.0).abs();
                assert!(centre < 0.01 && gentle.moving < 5.0, "{gentle:?}");
            }
        }
    }
}

/// A press with zero end accelerations and least peak: the last exponent that converges is used, far below the laws, and not below the torque that
/// the press needs anyway.
#[test]
fn the_peak_of_a_press_with_level_ends_is_found() {
    let file = example("press", &[]);
    let found = solved(&file, Goal::Peak, 0.1);
    let law = found.best_law(Goal::Peak).unwrap();
    assert!(
        found.best.peak < 0.5 * law.figures.peak,
        "{}",
        found.best.peak
    );
    let free = solved(&file, Goal::Peak, 0.0);
    assert!(free.best.peak <= found.best.peak * (1.0 + 1e-2));
}

/// An endless machine with a long time that must be held everywhere except at one position waits there once per turn. The start of the file's motion
/// does not matter: the same figure from every start, in the whole time, and no worse than the file's own motion.
#[test]
fn a_turn_waits_wherever_it_begins() {
    let file = example("shaper", &[]);
    let motion = file.motion.as_ref().unwrap();
    let period = motion.duration();
    let mut first: Option<f64> = None;
    for start in [0.0, 1.0, 2.5, 4.0] {
        let asked = Motion::segments(
            start,
            &[MotionSegment::constant_speed(TAU, period, TAU / period)],
            true,
        );
        let found = gentlest_cycle(&file, &asked.unwrap(), &request(Goal::Rms, 0.0)).unwrap();
        let nodes = found.trace.nodes();
        assert!((nodes[0].phi - start).abs() <= 1e-12);
        assert!(contradiction(nodes) <= 1e-6, "{start}");
        let time = found.trace.duration() / period - 1.0;
        assert!(time.abs() <= 1e-9, "{start}: {time}");
        assert!(found.best.rms < 0.5 * found.own.rms, "{start}");
        let gentle = &found.moves[0];
        assert!(gentle.moving < 0.9 * period, "{start}: {}", gentle.moving);
        let first = *first.get_or_insert(found.best.rms);
        let off = found.best.rms / first - 1.0;
        assert!(off.abs() <= 1e-4, "{start}: {off}");
    }
}
