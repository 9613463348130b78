//! The bound of a stretch: never below the value of a sample, and reached where loads deviate as far as they may.

use super::*;

const C: Coefficients = Coefficients([0.7, 0.4, -0.9, 0.03, 1.1]);
const RATIO: f64 = 2.0;

/// Samples of acceleration, torque and speed, at equal time steps.
fn samples(states: &[[f64; 3]]) -> Vec<LoadSample> {
    let at = |(k, [alpha, output_torque, speed]): (usize, &[f64; 3])| LoadSample {
        t: k as f64,
        weight: 1.0,
        alpha: *alpha,
        output_torque: *output_torque,
        speed: *speed,
    };
    states.iter().enumerate().map(at).collect()
}

fn mirrored(states: &[[f64; 3]]) -> Vec<[f64; 3]> {
    states.iter().map(|state| state.map(|x| -x)).collect()
}

/// For these samples as one stretch and the best share `used`: the bound, and the largest |T| − u·M of a sample, computed directly.
fn bound<F: Floor>(c: &Coefficients, states: &[[f64; 3]], floor: F, used: f64) -> [f64; 2] {
    let samples = samples(states);
    let largest = [1.0; LOADS];
    let mut tree = Tree { nodes: Vec::new() };
    tree.nodes.push(Node::leaf(&samples, 0, samples.len() - 1));
    let front = Front::new(&tree, &samples, &largest);
    let stretches = Stretches {
        samples: &samples,
        tree: &tree,
        front: &front,
        smooth: &Smooth::default(),
        largest: &largest,
    };
    let mut search = PeakSearch::new(stretches, c, RATIO, floor);
    search.best.used = used;
    let above = |sample: &LoadSample| {
        let torque = c.torque(&sample.loads());
        torque.abs() - used * floor.limit(torque, sample.speed() * RATIO)
    };
    let most = samples.iter().map(above).fold(f64::NEG_INFINITY, f64::max);
    [search.excess(&tree.nodes[0]), most]
}

#[track_caller]
fn reached([bound, most]: [f64; 2]) {
    assert!(most > 0.0, "the case shows nothing: {most}");
    assert!(
        (bound - most).abs() <= 1e-13 * most.max(10.0),
        "{bound} instead of {most}"
    );
}

/// Driving and braking lines that fall with the speed, differently.
fn straight() -> LinearLimit {
    LinearLimit {
        lines: [[20.0, -0.1], [15.0, -0.05]],
        line: [15.0, -0.15],
        least: 1.0,
    }
}

/// The sample in the middle deviates in every load at once, always so that it adds to the torque: the bound is that sample. Both ends are equal, so
/// nothing else can add to it.
#[test]
fn every_load_that_strays_counts() {
    // From driving at 5 rad/s to braking at −4: α, the driving and the braking torque, speed and its sign all change.
    let states = [[100.0, 8.0, 5.0], [159.0, 3.0, -4.0], [100.0, 8.0, 5.0]];
    let adding = [0.7, -0.4, 0.9, -0.03, -1.1];
    for load in 0..LOADS {
        let mut c = Coefficients(adding);
        c.0[load] *= 10.0;
        reached(bound(&c, &states, ConstantLimit(10.0), 0.6));
        let opposite = Coefficients(c.0.map(|c| -c));
        reached(bound(&opposite, &states, ConstantLimit(10.0), 0.6));
    }
}

/// Under a limit that falls with the speed, a deviating speed changes torque and limit: forwards and backwards, driving and braking, for either of
/// the two changing more.
#[test]
fn a_speed_that_strays_moves_the_limit_too() {
    let most = 0.9;
    for torque in [40.0, -40.0] {
        for viscous in [0.03, 3.0, -3.0] {
            let c = Coefficients([0.7, 0.4, 0.9, viscous, 1.1]);
            for middle in [[9.0, 28.0], [9.0, 12.0]] {
                let rise = middle[0] * f64::signum(torque);
                let states = [
                    [1.0, torque, 20.0],
                    [rise, torque, middle[1]],
                    [1.0, torque, 20.0],
                ];
                for states in [states.to_vec(), mirrored(&states)] {
                    let [bound, brute] = bound(&c, &states, straight(), most);
                    assert!(
                        bound >= brute - 1e-12,
                        "{c:?} {states:?}: {bound} below {brute}"
                    );
                }
            }
        }
    }
    // Faster: the torque rises by 3 per rad/s and the limit falls by 0.1·2·0.9. The sample in the middle has both.
    let fast = [[1.0, 40.0, 20.0], [9.0, 40.0, 28.0], [1.0, 40.0, 20.0]];
    let c = Coefficients([0.7, 0.4, 0.9, 3.0, 1.1]);
    reached(bound(&c, &fast, straight(), 0.9));
    reached(bound(&c, &mirrored(&fast), straight(), 0.9));
    // Braking: T opposes the speed, and friction of the wrong sign adds to it as the speed grows.
    let c = Coefficients([0.7, 0.4, 0.9, -3.0, -1.1]);
    let fast = [
        [-1.0, -40.0, 20.0],
        [-9.0, -40.0, 28.0],
        [-1.0, -40.0, 20.0],
    ];
    reached(bound(&c, &fast, straight(), 0.9));
    reached(bound(&c, &mirrored(&fast), straight(), 0.9));
    // Slower: the torque rises by 0.5 per rad/s and the limit by 0.1·2·0.9.
    let slow = [[1.0, 80.0, 20.0], [1.0, 80.0, 12.0], [1.0, 80.0, 20.0]];
    let c = Coefficients([0.7, 0.4, 0.9, -0.5, 1.1]);
    reached(bound(&c, &slow, straight(), 0.9));
}

/// Without deviating loads the larger end is the bound: the first or the last, under a falling limit, in each quadrant.
#[test]
fn the_larger_end_is_the_bound() {
    let at = |torques: [f64; 2], speeds: [f64; 2]| {
        vec![[0.0, torques[0], speeds[0]], [0.0, torques[1], speeds[1]]]
    };
    let c = Coefficients([0.7, 0.5, 0.9, 0.02, 1.1]);
    for torques in [[60.0, 50.0], [50.0, 60.0], [-60.0, -50.0], [-50.0, -60.0]] {
        for speeds in [[10.0, 30.0], [30.0, 10.0], [20.0, 20.0]] {
            for states in [at(torques, speeds), mirrored(&at(torques, speeds))] {
                reached(bound(&c, &states, straight(), 0.8));
            }
        }
    }
}

/// Where the speed reverses, or where braking begins at rest, the lowest of all limits applies: driving and braking, at both ends.
#[test]
fn in_both_directions_the_lowest_limit_counts() {
    let c = Coefficients([0.0, 0.5, 0.5, 0.0, 0.0]);
    // Driving 20 − 0.1·2·30 = 14 at the fastest, braking 15 − 0.05·2·30 = 12.
    let used = 0.8;
    for (torque, speeds) in [
        (60.0, [-30.0, 10.0]),
        (-60.0, [-30.0, 10.0]),
        (-60.0, [0.0, 30.0]),
    ] {
        let states = [[0.0, torque, speeds[0]], [0.0, torque, speeds[1]]];
        let [found, _] = bound(&c, &states, straight(), used);
        // The loads τ₊ and τ₋ go from one to zero and from zero to one: nothing deviates from the chord.
        let expected = 30.0 - used * 12.0;
        assert!(
            (found - expected).abs() < 1e-12,
            "{found} instead of {expected}"
        );
    }
    // A motor that brakes better than it drives: braking that begins at rest is bounded by the driving limit there, 10.
    let brakes_better = LinearLimit {
        lines: [[10.0, 0.1], [15.0, -0.01]],
        line: [10.0, 0.0],
        least: 10.0,
    };
    let states = [[0.0, -60.0, 0.0], [0.0, -60.0, 30.0]];
    let [found, _] = bound(&c, &states, brakes_better, used);
    assert!((found - (30.0 - used * 10.0)).abs() < 1e-12, "{found}");
    // Braking that does not begin at rest has its own line: 15 − 0.05·2·10 = 14 at the slow end.
    let states = [[0.0, -60.0, 10.0], [0.0, -50.0, 30.0]];
    let [found, _] = bound(&c, &states, straight(), used);
    assert!((found - (30.0 - used * 14.0)).abs() < 1e-12, "{found}");
}

/// A limit without data anywhere; its line carries no information.
#[derive(Clone, Copy)]
struct NoLimit;
impl Floor for NoLimit {
    fn line(&self) -> [f64; 2] {
        [0.0, 0.0]
    }
    fn least(&self) -> f64 {
        0.0
    }
    fn chord(&self, _driving: bool, _speeds: [f64; 2]) -> [f64; 2] {
        [f64::INFINITY; 2]
    }
    fn limit(&self, _torque: f64, _speed: f64) -> f64 {
        f64::INFINITY
    }
}

/// Before any sample is weighed, every stretch is examined. Without any torque the bound is not above zero. An unknown limit excludes a stretch.
#[test]
fn the_ends_of_the_range_of_bounds() {
    let states = [[1.0, 8.0, 5.0], [2.0, 8.0, 6.0]];
    let [before, _] = bound(&C, &states, ConstantLimit(10.0), f64::NEG_INFINITY);
    assert!(before > f64::MAX, "{before}");
    let [at_zero, most] = bound(&C, &states, ConstantLimit(10.0), 0.0);
    assert!(
        (at_zero - most).abs() < 1e-12 && at_zero.is_finite(),
        "{at_zero}"
    );

    let [unknown, _] = bound(&C, &states, NoLimit, 0.5);
    assert!(unknown <= 0.0, "{unknown}");
}

/// A stretch that even the lowest limit excludes is not examined further: its bound is the one by the lowest limit.
#[test]
fn the_lowest_limit_excludes_first() {
    let states = [[0.0, 4.0, 10.0], [0.0, 4.0, 30.0]];
    let c = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
    // The lower line: 15 − 0.15·30 = 10.5 at the faster end.
    let [found, _] = bound(&c, &states, straight(), 0.8);
    assert!((found - (4.0 - 0.8 * 10.5)).abs() < 1e-12, "{found}");
    // A rising line is smallest at the slower end.
    let rising = LinearLimit {
        lines: [[20.0, 0.1], [15.0, 0.05]],
        line: [15.0, 0.05],
        least: 15.0,
    };
    let [found, _] = bound(&c, &states, rising, 0.8);
    assert!((found - (4.0 - 0.8 * 15.5)).abs() < 1e-12, "{found}");
}
