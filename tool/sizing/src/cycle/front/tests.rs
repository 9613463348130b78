//! Whether a torque opposes the speed, by the ends of stretches and by bounds between them.

use super::*;
use crate::cycle::form::Coefficients;

const C: [f64; LOADS] = [0.5, 0.25, 0.4, 0.02, 1.5];

/// The front of stretches of three states each: acceleration, torque and speed.
fn front(stretches: &[[[f64; 3]; 3]]) -> (Front, Vec<LoadSample>) {
    let states = stretches.iter().flatten().enumerate();
    let sample = |(k, [alpha, output_torque, speed]): (usize, &[f64; 3])| LoadSample {
        t: k as f64,
        weight: 1.0,
        alpha: *alpha,
        output_torque: *output_torque,
        speed: *speed,
    };
    let samples: Vec<LoadSample> = states.map(sample).collect();
    // Nodes in sequence, each joined to all before it.
    let mut tree = Tree { nodes: Vec::new() };
    let count = stretches.len();
    let mut nodes = (0..count).map(|k| Node::leaf(&samples, 3 * k, 3 * k + 2));
    for k in 0..count - 1 {
        let whole = Node {
            second: 2 * k as u32 + 2,
            ..Node::leaf(&samples, 3 * k, samples.len() - 1)
        };
        tree.nodes.push(whole);
        tree.nodes.extend(nodes.next());
    }
    tree.nodes.extend(nodes.next());
    let front = Front::new(&tree, &samples, &[1.0; LOADS]);
    assert_eq!(front.len, count);
    (front, samples)
}

/// T·sgn n; not positive at rest.
fn along(sample: &LoadSample) -> f64 {
    let speed = sample.speed();
    let direction = if speed == 0.0 { 0.0 } else { speed.signum() };
    Coefficients(C).torque(&sample.loads()) * direction
}

/// Forwards and driven throughout.
const DRIVEN: [[f64; 3]; 3] = [[1.0, 20.0, 10.0], [2.0, 25.0, 12.0], [3.0, 30.0, 14.0]];
/// The same at its ends; between them it brakes.
const BRAKES_BETWEEN: [[f64; 3]; 3] = [[1.0, 20.0, 10.0], [-60.0, 20.0, 12.0], [1.0, 20.0, 14.0]];
/// The torque opposes the speed at its first sample, or at its last.
const BRAKES_FIRST: [[f64; 3]; 3] = [[-60.0, 20.0, 10.0], [0.0, 20.0, 12.0], [60.0, 20.0, 14.0]];
const BRAKES_LAST: [[f64; 3]; 3] = [[60.0, 20.0, 10.0], [0.0, 20.0, 12.0], [-60.0, 20.0, 14.0]];
/// At rest under a torque.
const RESTS: [[f64; 3]; 3] = [[0.0, -20.0, 0.0]; 3];
/// Driven forwards and back.
const TURNS: [[f64; 3]; 3] = [[9.0, 20.0, 10.0], [0.0, 0.0, 0.0], [-9.0, -20.0, -10.0]];

fn mirrored(stretch: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    stretch.map(|state| state.map(|x| -x))
}

#[test]
fn an_end_that_brakes_is_known() {
    for brakes in [BRAKES_FIRST, BRAKES_LAST] {
        for stretch in [brakes, mirrored(brakes)] {
            for stretches in [
                vec![stretch],
                vec![DRIVEN, stretch],
                vec![RESTS, stretch, DRIVEN],
            ] {
                assert_eq!(front(&stretches).0.against_speed(&C, 1e-9), Ok(true));
            }
        }
    }
}

#[test]
fn what_drives_and_what_rests_is_known() {
    for driven in [DRIVEN, mirrored(DRIVEN)] {
        assert_eq!(front(&[driven]).0.against_speed(&C, 1e-9), Ok(false));
        assert_eq!(
            front(&[driven, RESTS, driven]).0.against_speed(&C, 1e-9),
            Ok(false)
        );
    }
    // Without any torque nothing opposes the speed, and there is no rounding either.
    for still in [DRIVEN, RESTS] {
        assert_eq!(
            front(&[still]).0.against_speed(&[0.0; LOADS], 0.0),
            Ok(false)
        );
    }
    // A torque against the speed by less than the rounding allowance, here −8.3 N·m, does not count.
    let (front, _) = front(&[[[-30.0, 20.0, 10.0]; 3]]);
    let found = [7.0, 9.0].map(|slack| front.against_speed(&C, slack));
    assert_eq!(found, [Ok(true), Ok(false)]);
}

/// A stretch that neither its ends nor its bound decide is marked by its bit, and no other stretch is.
#[test]
fn what_is_open_is_named() {
    for open in [BRAKES_BETWEEN, mirrored(BRAKES_BETWEEN), TURNS] {
        let places = |stretches: &[_]| front(stretches).0.against_speed(&C, 1e-9);
        assert_eq!(places(&[open]), Err(0b1));
        assert_eq!(places(&[DRIVEN, open]), Err(0b10));
        assert_eq!(places(&[open, RESTS, DRIVEN, open]), Err(0b1001));
    }
    // Backwards for a moment, under a constant torque: the ends are driven, and nothing deviates.
    let moment = [[20.0, 0.0, 10.0], [20.0, 0.0, -10.0], [20.0, 0.0, 10.0]];
    let c = [0.5, 0.0, 0.0, 0.0, 0.0];
    assert_eq!(front(&[moment]).0.against_speed(&c, 1e-9), Err(0b1));
}

/// Least T·sgn n at an end, and its lower bound between the ends: the sample that deviates by as much as the bound allows.
#[test]
fn the_signs_are_those_of_the_samples() {
    let cases = [DRIVEN, BRAKES_BETWEEN, BRAKES_FIRST, BRAKES_LAST];
    for stretch in cases
        .into_iter()
        .flat_map(|stretch| [stretch, mirrored(stretch)])
    {
        let (front, samples) = front(&[stretch]);
        let (lowest, least) = front.signs(&C);
        let ends = along(&samples[0]).min(along(&samples[2]));
        assert!(
            (lowest - ends.min(0.0)).abs() < 1e-12,
            "{lowest} instead of {ends}"
        );
        let brute = samples.iter().map(along).fold(f64::INFINITY, f64::min);
        assert!(least[0] <= brute + 1e-12, "{} above {brute}", least[0]);
    }
    // Equal ends, and only α deviates, to where it brakes: the bound is reached.
    let (front, samples) = front(&[[[1.0, 20.0, 10.0], [-60.0, 20.0, 10.0], [1.0, 20.0, 10.0]]]);
    let (_, least) = front.signs(&C);
    assert!(
        (least[0] - along(&samples[1])).abs() < 1e-12,
        "{}",
        least[0]
    );
    // Nothing deviates, and the ends differ: the bound is the lower one.
    let (front, samples) =
        self::front(&[[[1.0, 20.0, 10.0], [3.0, 25.0, 11.0], [5.0, 30.0, 12.0]]]);
    let (_, least) = front.signs(&C);
    assert!(
        (least[0] - along(&samples[0])).abs() < 1e-12,
        "{}",
        least[0]
    );
}

/// The least of a line over the speeds of each stretch, falling and rising.
#[test]
fn floors_are_the_least_of_a_line() {
    let backwards = mirrored(DRIVEN);
    let (front, _) = front(&[DRIVEN, backwards, RESTS]);
    for (line, expected) in [
        // At the largest speed, 14 rad/s in either direction, and at rest.
        ([50.0, -2.0], [22.0, 22.0, 50.0]),
        // At the least, 10 rad/s.
        ([50.0, 3.0], [80.0, 80.0, 50.0]),
        ([50.0, 0.0], [50.0, 50.0, 50.0]),
    ] {
        for (floor, expected) in front.floors(line).iter().zip(expected) {
            assert!((floor - expected).abs() < 1e-12, "{floor} of {line:?}");
        }
    }
}
