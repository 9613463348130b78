//! The time of a motion, cut where the drive link turns back and where pauses or kept parts begin or end.

use std::convert::Infallible;

use jred_file::model::motion::{Motion, Overshoot, Steady};
use jred_file::number::numerics::edge;

use super::{Chain, EndStates, INSTANT_SHARE, KeptMotion, Move, NoMoves, Part};

/// Parts of a smooth stretch at whose ends the direction is evaluated.
const SAMPLES: u32 = 256;

/// A speed below this share of the largest speed counts as rest: at the ends of motion laws it is rounding.
const REST_SPEED: f64 = 1e-12;

/// A span of time in which the drive link moves in one direction: backward (−1) or forward (+1), or is at rest (0).
#[derive(Clone, Copy, Debug)]
struct Span {
    from: f64,
    to: f64,
    sign: i8,
    /// Index of the stretch in `process`, if this span is kept.
    kept: Option<usize>,
}

/// A motion with the spans of its time.
pub(super) struct Timeline<'a> {
    motion: &'a Motion,
    process: &'a [Steady],
    /// Its largest speed.
    largest: f64,
    spans: Vec<Span>,
    /// The segments whose overshoot is removed.
    overshoots: Vec<Overshoot>,
}

impl<'a> Timeline<'a> {
    pub(super) fn new(motion: &'a Motion, process: &'a [Steady]) -> Result<Self, NoMoves> {
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
        let mut line = Self {
            motion,
            process,
            largest,
            spans: Vec::new(),
            overshoots: Vec::new(),
        };
        line.overshoots = line.overshoots();
        let mut spans = Vec::new();
        for stretch in stretches {
            let (from, to) = stretch;
            let middle = from.midpoint(to);
            let within = |steady: &Steady| steady.span[0] < middle && middle < steady.span[1];
            let kept = process.iter().position(within);
            if kept.is_some() {
                let sign = line.sign(middle);
                spans.push(Span {
                    from,
                    to,
                    sign,
                    kept,
                });
                continue;
            }
            if let Some(sign) = line.straight(middle) {
                spans.push(Span {
                    from,
                    to,
                    sign,
                    kept: None,
                });
                continue;
            }
            for k in 0..SAMPLES {
                let [from, to] = [time(stretch, k), time(stretch, k + 1)];
                let (starts_inside, ends_inside) = (k > 0, k + 1 < SAMPLES);
                let sign = |t: f64| line.sign(t);
                split(&sign, [from, to], starts_inside, ends_inside, &mut spans);
            }
        }
        let shortest = INSTANT_SHARE * motion.duration();
        spans.retain(|span| span.sign != 0 || span.to - span.from > shortest);
        line.spans = spans;
        Ok(line)
    }

    /// The overshoots to remove: blemishes of laws, in segments without kept parts.
    fn overshoots(&self) -> Vec<Overshoot> {
        let untouched = |overshoot: &Overshoot| {
            let [from, to] = overshoot.span;
            let apart = |steady: &Steady| steady.span[1] <= from || to <= steady.span[0];
            self.process.iter().all(apart)
        };
        let all = self.motion.overshoots().into_iter();
        all.filter(|overshoot| overshoot.is_of_law() && untouched(overshoot))
            .collect()
    }

    /// The direction of the segment at this time, if its overshoot is removed.
    fn straight(&self, t: f64) -> Option<i8> {
        let within = |overshoot: &&Overshoot| overshoot.span[0] < t && t < overshoot.span[1];
        let overshoot = self.overshoots.iter().find(within)?;
        let [from, to] = overshoot.span.map(|t| self.state(t)[0]);
        Some(if to > from { 1 } else { -1 })
    }

    fn sign(&self, t: f64) -> i8 {
        let omega = self.state(t)[1];
        if omega.abs() <= REST_SPEED * self.largest {
            0
        } else if omega > 0.0 {
            1
        } else {
            -1
        }
    }

    /// Position and speed; after the end of the motion those of the next cycle.
    fn state(&self, t: f64) -> [f64; 2] {
        let duration = self.motion.duration();
        let (t, further) = if t > duration {
            (t - duration, self.advance())
        } else {
            (t, 0.0)
        };
        let state = self.motion.at(t);
        [state.phi + further, state.omega]
    }

    /// Travel of the drive link in one cycle.
    fn advance(&self) -> f64 {
        self.motion.at(self.motion.duration()).phi - self.motion.at(0.0).phi
    }

    /// The first span with which the chain of an endless motion may begin: a kept part, a pause, or a move from rest.
    fn beginning(&self) -> Option<usize> {
        let begins = |k: usize| {
            let span = &self.spans[k];
            let turned = k > 0 && self.spans[k - 1].sign != span.sign;
            span.kept.is_some() || span.sign == 0 || self.sign(span.from) == 0 || turned
        };
        (0..self.spans.len()).find(|k| begins(*k))
    }

    pub(super) fn chain(mut self, turns: bool, given_up: Option<Steady>) -> Result<Chain, NoMoves> {
        let duration = self.motion.duration();
        let mut first = 0;
        if turns {
            let Some(begins) = self.beginning() else {
                let step = Move {
                    from: self.state(0.0)[0],
                    to: self.state(duration)[0],
                    duration,
                };
                return Ok(Chain {
                    parts: vec![Part::Move(step)],
                    endless: true,
                    begins: 0.0,
                    overshoots: self.overshoots,
                    given_up,
                });
            };
            first = begins;
        } else {
            let ends = [
                (0.0, self.spans.first(), false),
                (duration, self.spans.last(), true),
            ];
            for (t, span, at_end) in ends {
                if self.sign(t) != 0 && span.is_none_or(|span| span.kept.is_none()) {
                    let [_, speed] = self.state(t);
                    return Err(NoMoves::NotAtRest { speed, at_end });
                }
            }
        }
        let begins = if first == 0 {
            0.0
        } else {
            self.spans[first].from
        };
        for span in &mut self.spans[..first] {
            span.from += duration;
            span.to += duration;
        }
        self.spans.rotate_left(first);
        Ok(Chain {
            parts: self.parts(begins, turns),
            endless: false,
            begins,
            overshoots: self.overshoots,
            given_up,
        })
    }

    fn parts(&self, begins: f64, turns: bool) -> Vec<Part> {
        let end = begins + self.motion.duration();
        let mut runs: Vec<(Span, [f64; 2])> = Vec::new();
        let mut rest = self.spans.as_slice();
        while let [first, ..] = rest {
            let goes_on = |pair: &[Span]| {
                let &[a, b] = pair else { return false };
                a.kept == b.kept
                    && a.sign == b.sign
                    && (a.kept.is_some() || a.sign == 0 || self.sign(a.to) != 0)
            };
            let count = 1 + rest.windows(2).take_while(|pair| goes_on(pair)).count();
            let (_, after) = rest.split_at(count);
            let from = if runs.is_empty() { begins } else { first.from };
            let to = after.first().map_or(end, |next| next.from);
            runs.push((*first, [from, to]));
            rest = after;
        }
        let kept = |k: usize| {
            runs.get(k)
                .and_then(|(span, times)| self.kept(span, *times))
        };
        let last = runs.len() - 1;
        let part = |k: usize| {
            let (span, [from, to]) = runs[k];
            let duration = to - from;
            if let Some(kept) = kept(k) {
                return Part::Kept(kept);
            }
            let [[at, _], [end, _]] = [from, to].map(|t| self.state(t));
            if span.sign == 0 {
                return Part::Dwell { at, duration };
            }
            let step = Move {
                from: at,
                to: end,
                duration,
            };
            let before = if k > 0 {
                kept(k - 1)
            } else {
                kept(last).filter(|_| turns)
            };
            let after = if k < last {
                kept(k + 1)
            } else {
                kept(0).filter(|_| turns)
            };
            if before.is_none() && after.is_none() {
                return Part::Move(step);
            }
            let direction = f64::from(span.sign);
            let [first, last] = [
                before.map_or([0.0; 2], |kept| kept.ends()[1]),
                after.map_or([0.0; 2], |kept| kept.ends()[0]),
            ];
            Part::Passing(
                step,
                EndStates {
                    speeds: [first[0], last[0]].map(|speed| (direction * speed).max(0.0)),
                    accelerations: [first[1], last[1]].map(|a| direction * a),
                },
            )
        };
        (0..runs.len()).map(part).collect()
    }

    /// The kept part of a span; `None` if the span is not kept.
    fn kept(&self, span: &Span, [from, to]: [f64; 2]) -> Option<KeptMotion> {
        let steady = self.process.get(span.kept?)?;
        let duration = self.motion.duration();
        let shift = if from >= duration { duration } else { 0.0 };
        let further = if shift > 0.0 { self.advance() } else { 0.0 };
        Some(KeptMotion::new(
            self.motion,
            steady,
            [from - shift, to - shift],
            further,
        ))
    }
}

/// Adds the spans between two samples, each of them inside its stretch or at an end of it. Inside, a zero of the speed is where a pause begins or
/// ends; at the end of a stretch it may come from a motion law.
fn split(
    sign: &impl Fn(f64) -> i8,
    [from, to]: [f64; 2],
    starts_inside: bool,
    ends_inside: bool,
    spans: &mut Vec<Span>,
) {
    let middle = sign(from.midpoint(to));
    let [before, after] = [sign(from), sign(to)];
    let mut push = |from: f64, to: f64, sign: i8| {
        spans.push(Span {
            from,
            to,
            sign,
            kept: None,
        });
    };
    let keeps = |own: i8| move |t: f64| Ok::<_, Infallible>(sign(t) == own);
    if before * after < 0 {
        let Ok(turn) = edge(keeps(before), from, to);
        push(from, turn, before);
        push(turn, to, after);
    } else if before == 0 && after == 0 {
        push(from, to, middle);
    } else if before == 0 && starts_inside {
        let Ok(start) = edge(keeps(0), from, to);
        push(from, start, 0);
        push(start, to, after);
    } else if after == 0 && ends_inside {
        let Ok(end) = edge(keeps(before), from, to);
        push(from, end, before);
        push(end, to, 0);
    } else {
        push(from, to, if before == 0 { after } else { before });
    }
}
