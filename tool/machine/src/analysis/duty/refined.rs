//! Instants between those of the time steps: where the torque bends sharply, and at extremes.

use jred::Error;

use super::{Instant, Moving, Smooth};
use crate::number::parabola;

/// Most parts of a step where the torque bends sharply.
pub(super) const MOST_PARTS: f64 = 64.0;

/// Most instants of a motion, unless it has more stretches and steps: those of two cycles fit into 500 MB.
pub(super) const MOST_INSTANTS: f64 = 1e6;

/// Inserts instants of zero weight where the input torque bends sharply, starting at index `first`. Between instants at a
/// distance h any peak stands out by at most T″·h²/8, whatever a motor's own inertia, which bends little, adds to it. A step is
/// cut into at most so many parts.
pub(super) fn refine_bends(
    moving: &mut Moving,
    first: usize,
    (missed, most_parts): (f64, f64),
    instants: &mut Vec<Instant>,
) -> Result<(), Error> {
    let stretch = instants.get(first..).unwrap_or_default();
    let torques = stretch.iter().map(|i| i.input_torque.abs());
    let most = missed * torques.fold(0.0, f64::max);
    let mut fine = Vec::new();
    let bend = |three: &[Instant]| {
        let [x, y, z] = three else {
            return 0.0;
        };
        (x.input_torque - 2.0 * y.input_torque + z.input_torque).abs()
    };
    // Of three instants only, the bend over them is that of both steps.
    let least = usize::from(stretch.len() != 3);
    for k in least..stretch.len().saturating_sub(1 + least) {
        let [b, c] = [&stretch[k], &stretch[k + 1]];
        let bends = stretch[k.saturating_sub(1)..].windows(3).take(2).map(bend);
        let missed = bends.fold(0.0, f64::max) / 8.0;
        // A stretch without torque misses nothing.
        let parts = if missed > most {
            (missed / most).sqrt().ceil().min(most_parts) as u32
        } else {
            1
        };
        for k in 1..parts {
            let t = b.t + (c.t - b.t) * f64::from(k) / f64::from(parts);
            fine.push(Instant::new(moving, t, 0.0)?);
        }
    }
    instants.extend(fine);
    if let Some(stretch) = instants.get_mut(first..) {
        // Stable sorting takes half as much memory again.
        stretch.sort_unstable_by(|a, b| a.t.total_cmp(&b.t));
    }
    Ok(())
}

/// Inserts instants of zero weight at the extremes of what no motor changes, each where it is between the instants.
pub(super) fn insert_extremes(
    moving: &mut Moving,
    instants: &mut Vec<Instant>,
    smooth: &mut Smooth,
) -> Result<(), Error> {
    let quantities: [fn(&Instant) -> f64; 6] = [
        |i| i.terms.total(),
        |i| i.input_inertia,
        |i| i.input_speed,
        |i| i.input_alpha,
        |i| i.input_torque,
        |i| i.input_torque * i.input_speed,
    ];
    for quantity in quantities {
        for sign in [-1.0, 1.0] {
            let value = |instant: &Instant| sign * quantity(instant);
            let most = instants.iter().map(value).max_by(f64::total_cmp);
            let count = instants.len();
            let found = parabola::highest(
                (count, |k| value(&instants[k])),
                |k| smooth.around(k, count),
                |k| instants[k].t,
                |t| Ok::<_, Error>(value(&Instant::new(moving, t, 0.0)?)),
                most.unwrap_or(f64::INFINITY),
            )?;
            if let Some((_, t)) = found {
                let peak = Instant::new(moving, t, 0.0)?;
                let place = instants.partition_point(|i| i.t < t);
                smooth.insert(place);
                instants.insert(place, peak);
            }
        }
    }
    Ok(())
}
