//! The smooth stretches of a motion. They are cut where its law bends, where the drive link turns back or comes to rest, where it passes an edge of a
//! load or a cam, where a load begins or ends in time or with the direction of travel, and where a payload is picked up or set down.

use jred::Domain;
use jred::machine::Reducible as _;

use super::INSIDE;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;

/// Cuts closer than this share of the time are one, within rounding.
const SHORTEST: f64 = 8.0 * f64::EPSILON;

/// Share of the largest speed below which a speed is rounding.
const SPEED_ROUNDING: f64 = 1e-13;

/// Largest share of a stretch that is omitted at an end: a law of seventh degree reaches that speed after 3e-5.
const MOST_INSET: f64 = 1e-3;

/// The side of an edge on which the drive link is at φ; on a turn, the number of passages.
fn side(file: &MachineFile, phi: f64, edge: f64) -> i64 {
    let beyond = phi - edge;
    if file.machine.domain() == Domain::Turn {
        (beyond / std::f64::consts::TAU).floor() as i64
    } else {
        i64::from(beyond >= 0.0)
    }
}

/// Positions at which a load begins or ends, or a cam's segments meet.
fn edges(file: &MachineFile) -> Vec<f64> {
    (0..).map_while(|k| file.machine.edge(k)).collect()
}

/// Least number of passages of the drive link over edges: there and back within a piece of the motion is not counted.
pub(crate) fn passages(file: &MachineFile, motion: &Motion) -> u64 {
    let edges = edges(file);
    let sides = |t: f64| {
        let phi = motion.at(t).phi;
        edges.iter().map(move |&edge| side(file, phi, edge))
    };
    let passed = motion.stretches().into_iter().flat_map(|(from, to)| {
        let sides = sides(from).zip(sides(to));
        sides.map(|(from, to)| from.abs_diff(to))
    });
    passed.fold(0, u64::saturating_add)
}

/// Adds the times at which an integer changes, by bisection, one for each value between those at both ends. `from` and `to` are times with their
/// numbers.
fn crossings(
    number: &impl Fn(f64) -> i64,
    [from, to]: [(f64, i64); 2],
    least: f64,
    cuts: &mut Vec<f64>,
) {
    if from.1 == to.1 {
        return;
    }
    let middle = 0.5 * (from.0 + to.0);
    if to.0 - from.0 <= least || middle <= from.0 || middle >= to.0 {
        cuts.push(to.0);
        return;
    }
    let middle = (middle, number(middle));
    crossings(number, [from, middle], least, cuts);
    crossings(number, [middle, to], least, cuts);
}

/// Distance (s) by which the first end of a stretch is moved inside. Where a move comes to rest with a soft law, the speed near its end is rounding,
/// and friction would take its sign.
pub(super) fn start_inset(motion: &Motion, [end, other]: [f64; 2]) -> f64 {
    let (length, inwards) = ((other - end).abs(), (other - end).signum());
    let speed = |share: f64| motion.at(end + inwards * share * length).omega.abs();
    let most = [0.25, 0.5, 0.75].map(speed).into_iter().fold(0.0, f64::max);
    let mut share = INSIDE;
    // A recorded motion defines its own standstill.
    if motion.is_recorded() {
        return share * length;
    }
    while speed(share) < SPEED_ROUNDING * most && share < MOST_INSET {
        share *= 2.0;
    }
    share * length
}

/// Number of turns or strokes of the drive link in a smooth stretch.
pub(crate) fn turns(file: &MachineFile, motion: &Motion, (from, to): (f64, f64)) -> f64 {
    let [a, b] = [from, to].map(|t| motion.at(t).phi);
    (b - a).abs() / file.machine.domain().span()
}

/// The direction of the drive link.
fn direction(motion: &Motion, t: f64) -> i64 {
    let omega = motion.at(t).omega;
    i64::from(omega > 0.0) - i64::from(omega < 0.0)
}

/// The stretches of the motion in which the drive link moves in one direction or rests. They are also cut where it passes an edge of a load's window,
/// so that a short load has its own instants, and where the machine changes by its schedule.
pub(crate) fn smooth_stretches(file: &MachineFile, motion: &Motion) -> Vec<(f64, f64)> {
    let edges = edges(file);
    let times = file.schedule.times();
    let mut stretches = Vec::new();
    for (from, to) in motion.stretches() {
        let least = SHORTEST * to.abs();
        // The end of a stretch may belong to the next.
        let last = to.next_down().max(from);
        let inside = |t: f64| t.min(last);
        let mut cuts: Vec<f64> = times.clone();
        let way = |t: f64| direction(motion, inside(t));
        let places = motion.turning([from, to]);
        let mut turns = Vec::new();
        for pair in places.windows(2) {
            let ends = [pair[0], pair[1]].map(|t| (t, way(t)));
            crossings(&way, ends, least, &mut turns);
        }
        let [first, end] = [[from, to], [to, from]].map(|ends| start_inset(motion, ends));
        turns.retain(|t| *t > from + first && *t < to - end);
        let one_way: Vec<f64> = ([from].into_iter().chain(turns.iter().copied()))
            .chain([to])
            .collect();
        for pair in one_way.windows(2) {
            for &edge in &edges {
                let at = |t: f64| side(file, motion.at(inside(t)).phi, edge);
                let ends = [pair[0], pair[1]].map(|t| (t, at(t)));
                crossings(&at, ends, least, &mut cuts);
            }
        }
        cuts.extend(turns);
        cuts.sort_by(f64::total_cmp);
        let mut start = from;
        for cut in cuts {
            if cut - start > least && to - cut > least {
                stretches.push((start, cut));
                start = cut;
            }
        }
        stretches.push((start, to));
    }
    stretches
}
