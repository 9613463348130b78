//! Moves of every length: also between its nodes a motion stays within the motor's torque, in steps of any length.

use jred_file::model::machine::MachineFile;
use jred_motion::fastest::{Fastest, NoMotion, solve};

use super::{fastest, machine, motor, scales, table, task};
use crate::support::press_text;

/// Numbers from 0 to 1, the same each time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// The largest share by which torque and speed exceed the limits of a motor with linearly falling torque. The torque is computed here from the
/// equation of motion.
fn exceeded(
    file: &MachineFile,
    found: &Fastest,
    [rest, end]: [f64; 2],
    top: f64,
    seed: u64,
) -> f64 {
    let mut random = Random(seed);
    let mut largest = 0.0_f64;
    for pair in found.trace.nodes().windows(2) {
        for _ in 0..4 {
            let state = pair[1].after(&pair[0], random.next());
            let point = file.machine.bare_reduction(state.phi).unwrap();
            let (speed, sense) = (state.omega.abs(), (pair[1].phi - pair[0].phi).signum());
            let torque = point.inertia * state.alpha
                + 0.5 * point.inertia_slope * state.omega * state.omega
                + point.viscous * state.omega
                + sense * point.coulomb
                - point.load_torque();
            let limit = rest + (end - rest) * (speed / top).min(1.0);
            largest = largest.max((torque.abs() - limit) / rest);
            largest = largest.max(speed / top - 1.0);
        }
    }
    largest
}

/// A table, an unbalanced table, an upright crank and a press, with random motors, over 0.001° to 10,000,000°.
#[test]
#[ignore = "more than five seconds of a processor"]
fn the_torque_keeps_its_limit_on_every_way() {
    let press = {
        let text = press_text();
        let begin = text.find("[mechanism]").unwrap();
        let end = text.find("# Toothed belt").unwrap();
        machine(&format!(
            "title = \"press\"\ngravity = [\"9.81 m/s^2\", \"0 m/s^2\"]\n{}",
            &text[begin..end]
        ))
    };
    let crank = scales::lossless_press();
    let mut random = Random(20_261_123);
    let (mut made, mut refused) = (0, 0);
    for round in 0..60 {
        let degrees = random.between(1e-3, 1e7);
        let rubbing = format!(
            "[[load]]\non = \"table\"\nviscous_moment = \"{} N m s/rad\"\n[[load]]\non = \"table\"\nopposing_moment = \"{} N m\"\n",
            random.between(1e-4, 0.5),
            random.between(1e-3, 3.0)
        );
        let constant = table(random.between(0.01, 10.0), &rubbing);
        // The motor can hold every load: 10 kN at 30 mm, and less.
        let (file, least) = match round % 3 {
            0 => (&constant, 5.0),
            1 => (&crank, 1.0),
            _ => (&press, 400.0),
        };
        let torques = [
            random.between(least, 20.0 * least),
            random.between(0.9 * least, least),
        ];
        let torques = [torques[0].max(torques[1]), torques[1]];
        let top = random.between(1.0, 100.0);
        let from = 7.0 * random.next();
        let to = from + degrees.to_radians() * if random.next() < 0.5 { -1.0 } else { 1.0 };
        match solve(file, &motor(torques, top), &task(from, to)) {
            Ok(found) => {
                made += 1;
                let excess = exceeded(file, &found, torques, top, round);
                assert!(
                    excess <= 3.0 * found.excess.max(1e-9),
                    "{round}: {degrees}°: exceeded by {excess:e} ({torques:?}, {top})"
                );
            }
            Err(NoMotion::TooLong { turns, most }) => {
                refused += 1;
                assert!(turns > most && most > 500.0, "{round}: {turns} {most}");
            }
            // A crank whose inertia takes a thousand times the motor's torque, over hundreds of turns.
            Err(NoMotion::NotAccurate { excess, .. }) => {
                refused += 1;
                assert!(excess > 1e-6 && round % 3 != 0, "{round}: {excess}");
            }
            Err(why) => panic!("{round}: {degrees}°: {why}"),
        }
    }
    assert!(made >= 45 && refused >= 1, "{made} {refused}");
}

/// A table that turns for hours at its largest speed starts and stops as over 90°.
#[test]
fn a_long_run_does_not_hide_the_start() {
    let file = table(2.0, "");
    for turns in [1.0, 1e3, 1e6] {
        let way = turns * std::f64::consts::TAU;
        let found = fastest(&file, &motor([200.0; 2], 10.0), &task(1.0, 1.0 + way));
        // 200 N m on 2 kg m²: 0.1 s up and down, and the rest at 10 rad/s.
        super::close(found.time, 0.1 + way / 10.0, 1e-12);
        let nodes = found.trace.nodes();
        let ends = [nodes[1].alpha[0], nodes[nodes.len() - 2].alpha[1]];
        for (alpha, expected) in ends.into_iter().zip([100.0, -100.0]) {
            assert!((alpha - expected).abs() < 1e-9, "{alpha}");
        }
        assert!(exceeded(&file, &found, [200.0; 2], 10.0, 5) <= 1e-9);
    }
}

/// A machine that varies within a turn is refused at once for more turns than its cells can resolve.
#[test]
fn too_many_turns_are_refused() {
    let file = scales::lossless_press();
    let found = solve(&file, &motor([60.0; 2], 12.0), &task(0.0, 1e6));
    let Err(why @ NoMotion::TooLong { .. }) = found else {
        panic!("{found:?}")
    };
    assert!(
        why.to_string().contains("159200 turns is too long"),
        "{why}"
    );
    assert!(why.cure().contains("--to-speed"));
}
