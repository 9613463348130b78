//! What a prescribed motion is made of: moves one way from rest to rest, and the pauses between them.

use std::convert::Infallible;

use jred_machine::model::motion::Motion;
use jred_machine::number::numerics::edge;

/// Parts of a smooth stretch at whose ends the direction is looked at.
const SAMPLES: u32 = 256;

/// Share of the largest speed below which the drive link is at rest: rounding at the ends of a law.
const REST: f64 = 1e-12;

/// Share of the whole motion below which a pause is a point of rest only.
const POINT: f64 = 1e-9;

/// Share of the speed by which start and end of an endless motion may differ.
const CLOSED: f64 = 1e-6;

/// One part of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// From rest to rest in one direction.
    Move(Move),
    /// At rest.
    Dwell {
        /// Position of the drive link (rad, or m).
        at: f64,
        /// How long (s).
        duration: f64,
    },
}

impl Part {
    /// How long it takes (s).
    pub const fn duration(&self) -> f64 {
        match self {
            Self::Move(Move { duration, .. }) | Self::Dwell { duration, .. } => *duration,
        }
    }
}

/// A move of the drive link in one direction, at rest at both ends but where it turns for ever.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Where it begins (rad, or m).
    pub from: f64,
    /// Where it ends (rad, or m).
    pub to: f64,
    /// How long it takes in the motion (s).
    pub duration: f64,
}

/// Why a motion is not made of moves and pauses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMoves {
    /// It begins or ends in motion, at this speed (rad/s, or m/s).
    NotAtRest {
        /// Speed at the start or at the end.
        speed: f64,
        /// Whether at its end.
        at_end: bool,
    },
    /// Nothing moves.
    Still,
}

/// A time in which the direction stays: −1, 0 or +1.
#[derive(Clone, Copy, Debug)]
struct Span {
    from: f64,
    to: f64,
    sign: i8,
}

/// The moves and pauses of the drive link, one after another, as long as the motion.
///
/// # Errors
/// A motion that begins or ends in motion, or in which nothing moves.
pub fn parts(motion: &Motion) -> Result<Vec<Part>, NoMoves> {
    let stretches = motion.stretches();
    let time = |(from, to): (f64, f64), k: u32| match k {
        SAMPLES => to,
        k => from + (to - from) * f64::from(k) / f64::from(SAMPLES),
    };
    let samples = |stretch| (0..=SAMPLES).map(move |k| motion.at(time(stretch, k)).omega);
    let speeds = stretches.iter().flat_map(|stretch| samples(*stretch));
    let largest = speeds.fold(0.0_f64, |most, omega| most.max(omega.abs()));
    if largest == 0.0 {
        return Err(NoMoves::Still);
    }
    let sign = |t: f64| {
        let omega = motion.at(t).omega;
        if omega.abs() <= REST * largest {
            0
        } else if omega > 0.0 {
            1
        } else {
            -1
        }
    };
    for (t, at_end) in [(0.0, false), (motion.duration(), true)] {
        if sign(t) != 0 {
            let speed = motion.at(t).omega;
            return Err(NoMoves::NotAtRest { speed, at_end });
        }
    }
    let mut spans: Vec<Span> = Vec::new();
    for stretch in stretches {
        for k in 0..SAMPLES {
            let [from, to] = [time(stretch, k), time(stretch, k + 1)];
            let inner = [k > 0, k + 1 < SAMPLES];
            split(&sign, [from, to], inner, &mut spans);
        }
    }
    let shortest = POINT * motion.duration();
    spans.retain(|span| span.sign != 0 || span.to - span.from > shortest);
    let mut parts = Vec::new();
    let mut rest = spans.as_slice();
    while let [first, ..] = rest {
        let goes_on = |pair: &[Span]| {
            let &[a, b] = pair else { return false };
            a.sign == b.sign && (a.sign == 0 || sign(a.to) != 0)
        };
        let count = 1 + rest.windows(2).take_while(|pair| goes_on(pair)).count();
        let (run, after) = rest.split_at(count);
        let from = if parts.is_empty() { 0.0 } else { first.from };
        let to = after.first().map_or(motion.duration(), |next| next.from);
        parts.push(part(motion, first.sign, [from, to]));
        debug_assert!(!run.is_empty());
        rest = after;
    }
    Ok(parts)
}

/// A motion that turns for ever, as one move of its period; `None`: it rests, or its end is not its start.
pub fn ring(motion: &Motion) -> Option<Move> {
    let duration = motion.duration();
    let [start, end] = [motion.at(0.0), motion.at(duration)];
    let closed = (end.omega - start.omega).abs() <= CLOSED * start.omega.abs();
    (motion.cyclic && closed && start.omega != 0.0).then_some(Move {
        from: start.phi,
        to: end.phi,
        duration,
    })
}

fn part(motion: &Motion, sign: i8, [from, to]: [f64; 2]) -> Part {
    let duration = to - from;
    if sign == 0 {
        let at = motion.at(from).phi;
        return Part::Dwell { at, duration };
    }
    Part::Move(Move {
        from: motion.at(from).phi,
        to: motion.at(to).phi,
        duration,
    })
}

/// The spans between two samples; `inner`: whether a sample lies inside its stretch, where a zero is the beginning or the end of a pause,
/// not of a law.
fn split(sign: &impl Fn(f64) -> i8, [from, to]: [f64; 2], inner: [bool; 2], spans: &mut Vec<Span>) {
    let middle = sign(from.midpoint(to));
    let [before, after] = [sign(from), sign(to)];
    let mut push = |from: f64, to: f64, sign: i8| spans.push(Span { from, to, sign });
    let keeps = |own: i8| move |t: f64| Ok::<_, Infallible>(sign(t) == own);
    if before * after < 0 {
        let Ok(turn) = edge(keeps(before), from, to);
        push(from, turn, before);
        push(turn, to, after);
    } else if before == 0 && after == 0 {
        push(from, to, middle);
    } else if before == 0 && inner[0] {
        let Ok(start) = edge(keeps(0), from, to);
        push(from, start, 0);
        push(start, to, after);
    } else if after == 0 && inner[1] {
        let Ok(end) = edge(keeps(before), from, to);
        push(from, end, before);
        push(end, to, 0);
    } else {
        push(from, to, if before == 0 { after } else { before });
    }
}
