//! A wait on the path, where holding costs less than at the ends and less than moving slowly.
//!
//! A motion that waits at a place consists of a motion to it and one from it, each in its unconstrained time; it waits for the rest. One more second
//! of either costs as much as holding there. The place is one of least holding torque. The bound is that of all motions.
//!
//! An endlessly turning motion waits once in its period: it is the move from that place round to it, with its start shifted. Among endlessly turning
//! motions it has no separate bound.

use jred::machine::motion::{End, Polynomial};
use jred_file::model::motion::Phase;
use jred_file::number::numerics::{least, zero};

use super::{
    Fault, GAP, LeastEffortMove, Objective, Optimum, Reason, Travel, Waiting, from_end_to_end,
};
use crate::path_dynamics::PathDynamics;

/// Places at which the holding torque is evaluated.
const HOLDING_PLACES: u32 = 360;

/// Most places that are tried, in order of least holding torque.
const MOST: usize = 4;

/// Share by which a wait must be better.
const LEAST_GAIN: f64 = 1e-6;

/// Share of the time, or of the path, that is rounding.
const ROUNDING: f64 = 1e-9;

/// Relative accuracy of a zero's position.
const ZERO_TOLERANCE: f64 = 1e-15;

/// The given motion, or a better one that waits on its path.
///
/// # Errors
/// Those of the given motion, if no other motion is found.
pub(super) fn on_the_way(
    dynamics: &PathDynamics,
    travel: &Travel,
    objective: Objective,
    found: Result<LeastEffortMove, Fault>,
) -> Result<LeastEffortMove, Fault> {
    let per_square = match objective {
        Objective::Rms => 1.0,
        Objective::Energy { copper } => copper,
        // The largest torque is independent of where it waits.
        Objective::Peak => return found,
    };
    let mut best = found;
    for (place, torque) in places(dynamics, travel)? {
        let rate = per_square * torque * torque;
        let made = if travel.ring {
            turning_from(dynamics, travel, objective, place)
        } else {
            waiting_at(dynamics, travel, objective, place, rate)
        };
        let Some(made) = made else {
            continue;
        };
        best = match best {
            Ok(best) if made.cost >= best.cost * (1.0 - LEAST_GAIN) => Ok(best),
            Ok(best) => Ok(judged(made, best.bound, best.optimum)),
            Err(_) => Ok(judged(made, None, Optimum::Local(Reason::LongTime))),
        };
    }
    best
}

/// The motion with a bound of all motions, and its optimum. `of_other` is the optimum of the motion from end to end.
fn judged(made: LeastEffortMove, bound: Option<f64>, of_other: Optimum) -> LeastEffortMove {
    // A cost below a bound refutes the bound.
    let bound = bound.filter(|bound| *bound <= made.cost * (1.0 + ROUNDING));
    let proved = bound.is_some_and(|bound| made.cost - bound <= GAP * made.cost);
    let optimum = match of_other {
        _ if proved => Optimum::Global,
        Optimum::Global => Optimum::Local(Reason::LongTime),
        local @ Optimum::Local(_) => local,
    };
    LeastEffortMove {
        bound,
        optimum,
        ..made
    }
}

/// Positions of least holding torque, with the torque (N·m): zeros, local minima, and the better end, where there are ends.
fn places(dynamics: &PathDynamics, travel: &Travel) -> Result<Vec<(f64, f64)>, Fault> {
    let at = |k: u32| travel.start + travel.distance * f64::from(k) / f64::from(HOLDING_PLACES);
    let torques: Vec<f64> = (0..=HOLDING_PLACES)
        .map(|k| dynamics.holding_at(at(k)))
        .collect::<Result<_, _>>()?;
    let mut found = Vec::new();
    let first = u32::from(!travel.ring);
    for k in first..HOLDING_PLACES {
        // On a ring, the place before the start is the last one before the end.
        let before = k.checked_sub(1).unwrap_or(HOLDING_PLACES - 1);
        let [before, here, after] = [before, k, k + 1].map(|k| torques[k as usize]);
        if here * after < 0.0 {
            let phi = zero(
                |phi| dynamics.holding_at(phi),
                [at(k), at(k + 1)],
                [here, after],
                ZERO_TOLERANCE,
            )?;
            found.push(phi);
        } else if here.abs() <= before.abs() && here.abs() < after.abs() && before * here >= 0.0 {
            let size = |phi: f64| dynamics.holding_at(phi).map(f64::abs);
            let aside = travel.distance / f64::from(HOLDING_PLACES);
            found.push(least(size, at(k) - aside, at(k + 1))?);
        }
    }
    let rest = travel.ends().rest;
    let at_ends = [torques[0], torques[HOLDING_PLACES as usize]];
    let [first, last] = [0, 1].map(|end| {
        if rest[end] {
            at_ends[end].abs()
        } else {
            f64::INFINITY
        }
    });
    let (end, at_end) = if last <= first {
        (travel.start + travel.distance, last)
    } else {
        (travel.start, first)
    };
    let mut all = Vec::with_capacity(found.len());
    for phi in found {
        all.push((phi, dynamics.holding_at(phi)?.abs()));
    }
    // A place with more holding torque than an end is dropped.
    all.retain(|(_, torque)| *torque <= at_end);
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all.truncate(MOST);
    if at_end.is_finite() {
        all.push((end, at_end));
    } else if all.is_empty() && !travel.ring {
        // Where holding takes the same everywhere, any place will do.
        let middle = travel.start + 0.5 * travel.distance;
        all.push((middle, dynamics.holding_at(middle)?.abs()));
    }
    Ok(all)
}

fn is(place: f64, other: f64) -> bool {
    place.total_cmp(&other).is_eq()
}

/// The motion that waits at a place where a second costs this much; `None` where it takes longer than the time of the move.
fn waiting_at(
    dynamics: &PathDynamics,
    travel: &Travel,
    objective: Objective,
    place: f64,
    rate: f64,
) -> Option<LeastEffortMove> {
    let end = travel.start + travel.distance;
    // The whole has the bound of all motions; its parts need no bound.
    let part = |ends: [f64; 2], duration: f64, waiting: Waiting| {
        let at = |values: [f64; 2]| {
            let kept = |k: usize, whole: f64| if is(ends[k], whole) { values[k] } else { 0.0 };
            [kept(0, travel.start), kept(1, end)]
        };
        let part = Travel {
            start: ends[0],
            distance: ends[1] - ends[0],
            duration,
            speeds: at(travel.speeds),
            accelerations: at(travel.accelerations),
            ..*travel
        };
        from_end_to_end(dynamics, &part, objective, waiting, false).ok()
    };
    if is(place, travel.start) || is(place, end) {
        return part([travel.start, end], travel.duration, Waiting::Required);
    }
    let ways = [[travel.start, place], [place, end]];
    let [mut to, mut from] = [
        part(ways[0], travel.duration, Waiting::Required)?,
        part(ways[1], travel.duration, Waiting::Required)?,
    ];
    if to.moving + from.moving > travel.duration {
        // The longer part gets the time that the other leaves: near its unconstrained time that costs hardly more.
        if to.moving > from.moving {
            to = part(ways[0], travel.duration - from.moving, Waiting::Allowed)?;
        } else {
            from = part(ways[1], travel.duration - to.moving, Waiting::Allowed)?;
        }
    }
    let rest = travel.duration - to.moving - from.moving;
    if rest < -ROUNDING * travel.duration {
        return None;
    }
    let near = ROUNDING * travel.distance.abs();
    let mut phases = [moving(&to, place, near, true)?, &[]].concat();
    if rest > 0.0 {
        phases.push(Phase {
            duration: rest,
            polynomial: Polynomial::constant_jerk([0.0; 3]),
        });
    }
    phases.extend_from_slice(moving(&from, place, near, false)?);
    let cost = |part: &LeastEffortMove| part.cost - rate * (part.travel.duration - part.moving);
    Some(LeastEffortMove {
        travel: *travel,
        moving: travel.duration - rest.max(0.0),
        waits_at: place,
        cost: cost(&to) + cost(&from) + rate * rest,
        bound: None,
        least_peak: None,
        per_second: rate,
        optimum: Optimum::Local(Reason::LongTime),
        discretisation: to.discretisation.max(from.discretisation),
        elements: to.elements + from.elements,
        law: None,
        phases,
    })
}

/// The endlessly turning motion that waits at a place once in its period.
fn turning_from(
    dynamics: &PathDynamics,
    travel: &Travel,
    objective: Objective,
    place: f64,
) -> Option<LeastEffortMove> {
    let turn = Travel {
        start: place,
        ramp: 0.0,
        ring: false,
        ..*travel
    };
    let made = from_end_to_end(dynamics, &turn, objective, Waiting::Required, false).ok()?;
    let offset = (travel.start - place) / travel.distance;
    let phases = begun_at(&made.phases, offset.rem_euclid(1.0) * travel.distance)?;
    Some(LeastEffortMove {
        travel: *travel,
        waits_at: place,
        phases,
        ..made
    })
}

/// A periodic motion with its start shifted by an offset.
fn begun_at(phases: &[Phase], offset: f64) -> Option<Vec<Phase>> {
    let time: f64 = phases.iter().map(|phase| phase.duration).sum();
    let mut passed = 0.0;
    for (k, phase) in phases.iter().enumerate() {
        let [rise, ..] = phase.polynomial.at(phase.duration);
        let beyond =
            |t: f64| Ok::<_, Fault>((passed + phase.polynomial.at(t)[0] - offset) * rise.signum());
        let ends = [0.0, phase.duration];
        let values = [beyond(ends[0]).ok()?, beyond(ends[1]).ok()?];
        if rise != 0.0 && values[1] >= 0.0 {
            let at = zero(beyond, ends, values, ZERO_TOLERANCE).ok()?;
            let short = ROUNDING * time;
            // No phase as short as rounding.
            let (before, behind) = if at <= short {
                (None, Some(*phase))
            } else if phase.duration - at <= short {
                (Some(*phase), None)
            } else {
                let [before, behind] = halves(phase, at);
                (Some(before), Some(behind))
            };
            let whole = behind.into_iter().chain(phases[k + 1..].iter().copied());
            let whole = whole.chain(phases[..k].iter().copied()).chain(before);
            return Some(whole.collect());
        }
        passed += rise;
    }
    None
}

/// A phase in two parts. All three are polynomials of fifth degree.
fn halves(phase: &Phase, at: f64) -> [Phase; 2] {
    let polynomial = &phase.polynomial;
    let [start, middle, end] = [0.0, at, phase.duration].map(|t| (t, polynomial.at(t)));
    [[start, middle], [middle, end]].map(|[(from, first), (to, last)]| {
        let [first_end, last_end] = [first, last].map(|[_, v, a, _]| End::new(v, a));
        Phase {
            duration: to - from,
            polynomial: Polynomial::between(last[0] - first[0], to - from, first_end, last_end),
        }
    })
}

/// The motion of a part without the wait at its end, or at its start; `None` if it waits farther than `near` from the place.
fn moving(part: &LeastEffortMove, place: f64, near: f64, at_end: bool) -> Option<&[Phase]> {
    let phases = part.phases.as_slice();
    if part.moving >= part.travel.duration {
        return Some(phases);
    }
    if (part.waits_at - place).abs() > near {
        return None;
    }
    let (before, behind) = (phases.split_last()?.1, phases.split_first()?.1);
    Some(if at_end { before } else { behind })
}
