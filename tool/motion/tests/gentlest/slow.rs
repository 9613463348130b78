//! Motions in a long time, in which the machine all but stands still somewhere.

use jred_motion::gentlest::Fault;
use jred_motion::retime::{Goal, Obstacle, retime};

use super::{example, machine, request, retimed};

/// The largest share of the range by which positions differ from the speeds between them.
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

/// Positions, speeds and accelerations of what is found are those of one motion, that takes the time asked for and is no worse than the file's own; or
/// nothing is found, and nothing is written.
#[test]
fn a_slow_motion_does_not_contradict_itself() {
    let (mut found, mut refused) = (0, 0);
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
        match retime(&file, motion, &request(Goal::Rms, 0.0)) {
            Ok(retimed) => {
                found += 1;
                let off = contradiction(retimed.trace.nodes());
                assert!(off <= 1e-6, "{name}: {off}");
                let time = retimed.trace.duration() / motion.duration() - 1.0;
                assert!(time.abs() <= 1e-9, "{name}: {time}");
                assert!(retimed.best.rms <= retimed.own.rms, "{name}");
            }
            Err(Obstacle::Move(_, _, Fault::NotFound)) => refused += 1,
            Err(why) => panic!("{name}: {why:?}"),
        }
    }
    assert!(found >= 3 && found + refused == 6, "{found} {refused}");
}

/// A table with the friction C turns without end, a turn in T. It moves for t and rests: ∫T² = C²·t + 12·J²·D²/t³ is least with t² = 6·J·D/C, 4/3·C²·t,
/// and evenly it would be C²·T.
#[test]
fn an_endless_turn_rests_where_that_takes_less() {
    let (inertia, friction, period) = (2.0_f64, 3.0_f64, 20.0);
    let text = |period: f64| {
        format!(
            "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"{inertia} kg m^2\"\n[[load]]\non = \"table\"\nopposing_moment = \"{friction} N m\"\n[motion]\ntype = \"constant-speed\"\nspeed = \"{} rpm\"\n",
            60.0 / period
        )
    };
    let found = retimed(&machine(&text(period)), Goal::Rms, 0.0);
    let moving = (6.0 * inertia * std::f64::consts::TAU / friction).sqrt();
    let squares = 4.0 / 3.0 * friction * friction * moving;
    let rms = (squares / period).sqrt();
    assert!(
        (found.best.rms / rms - 1.0).abs() < 1e-4,
        "{} {rms}",
        found.best.rms
    );
    assert!((found.moves[0].moving / moving - 1.0).abs() < 1e-3);
    assert!((found.trace.duration() / period - 1.0).abs() < 1e-12);
    // Where the turn takes less time than that the speed is even.
    let found = retimed(&machine(&text(1.2 * moving)), Goal::Rms, 0.0);
    assert!(
        (found.best.rms / friction - 1.0).abs() < 1e-6,
        "{}",
        found.best.rms
    );
}

/// A press that turns without end in so long a time that it would all but stand: it stands, and the longer the time, the less is taken. The RMS torque is that of
/// the move, spread over the time.
#[test]
fn a_slow_press_stands_somewhere_in_its_turn() {
    let mut before: Option<(f64, f64)> = None;
    for period in [3.0, 30.0] {
        let mut file = example("press", &[]);
        let speed = std::f64::consts::TAU / period;
        file.motion = Some(jred_machine::model::motion::Motion::constant_speed(
            0.0,
            speed,
            std::f64::consts::TAU,
        ));
        let found = retimed(&file, Goal::Rms, 0.0);
        assert!(found.endless && found.moves[0].moving < 0.5 * period);
        assert!(contradiction(found.trace.nodes()) <= 1e-6);
        let squares = found.best.rms * found.best.rms * period;
        if let Some((rms, earlier)) = before {
            assert!(found.best.rms < rms);
            // It may stand where nothing is to be held, or nearly.
            let more = squares / earlier - 1.0;
            assert!((-1e-4..0.02).contains(&more), "{squares} {earlier}");
        }
        before = Some((found.best.rms, squares));
    }
}

/// A press with level ends and the least peak: the last power that comes to its end is taken, far below the laws, and no lower than what the press asks for anyway.
#[test]
fn the_peak_of_a_press_with_level_ends_is_found() {
    let file = example("press", &[]);
    let found = retimed(&file, Goal::Peak, 0.1);
    let law = found.best_law(Goal::Peak).unwrap();
    assert!(
        found.best.peak < 0.5 * law.figures.peak,
        "{}",
        found.best.peak
    );
    let free = retimed(&file, Goal::Peak, 0.0);
    assert!(free.best.peak <= found.best.peak * (1.0 + 1e-2));
}
