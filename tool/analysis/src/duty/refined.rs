//! Instants between the time steps: where the torque bends sharply, and at extremes.

use jred::error::Error;

use super::mechanics::Alteration;
use super::mechanics::elements::force;
use super::moving_machine::MovingMachine;
use super::{Instant, Smooth};
use jred_file::number::parabola;

/// Share of the largest input torque by which linear interpolation between two instants may miss a peak.
const PEAK_ERROR: f64 = 1e-5;

/// Most parts of a step at a sharp bend of the torque.
const MOST_PARTS: f64 = 64.0;

/// Up to this number of instants a step with a bend may have all its parts. Beyond it, peaks between the instants come from the polynomial through
/// them.
const MANY: f64 = 200_000.0;

/// Most parts of a step, for about `count` instants.
pub(super) fn most_parts(count: usize) -> f64 {
    (MANY / count as f64).clamp(1.0, MOST_PARTS)
}

/// Number of parts for each step between instants, from their times and torques. Between instants at a distance h any peak stands out by at most
/// T″·h²/8; a motor's own inertia, which bends little, hardly changes that.
pub(super) fn parts(torques: &[(f64, f64)], largest: f64, most: f64) -> Vec<u32> {
    let bend = |three: &[(f64, f64)]| {
        let [x, y, z] = three else {
            return 0.0;
        };
        let slope = |a: &(f64, f64), b: &(f64, f64)| (b.1 - a.1) / (b.0 - a.0);
        let bend = 2.0 * ((slope(y, z) - slope(x, y)) / (z.0 - x.0)).abs();
        // Two instants at one time have no bend.
        if bend.is_finite() { bend } else { 0.0 }
    };
    let of_step = |k: usize| {
        let bends = torques[k.saturating_sub(1)..].windows(3).take(2).map(bend);
        let step = torques[k + 1].0 - torques[k].0;
        let missed = bends.fold(0.0, f64::max) * step * step / 8.0;
        // A motion without torque misses no peak.
        if missed > PEAK_ERROR * largest {
            (missed / (PEAK_ERROR * largest)).sqrt().ceil().min(most) as u32
        } else {
            1
        }
    };
    (0..torques.len().saturating_sub(1)).map(of_step).collect()
}

/// Inserts instants of zero weight at the extremes of quantities that do not depend on the motor, where they lie between the instants.
pub(super) fn insert_extremes(
    moving: &mut MovingMachine,
    instants: &mut Vec<Instant>,
    smooth: &mut Smooth,
) -> Result<(), Error> {
    type Quantity<'f> = &'f dyn Fn(&Instant) -> f64;
    let file = moving.file;
    let forces: Vec<_> = (file.drive_elements.iter())
        .map(|element| move |i: &Instant| force(file, element, i, Alteration::default()))
        .collect();
    let quantities: [Quantity; 9] = [
        &|i| i.terms.total(),
        &|i| i.input_inertia,
        &|i| i.input_speed,
        &|i| i.input_alpha,
        &|i| i.input_torque,
        &|i| i.input_torque * i.input_speed,
        &|i| i.input_inertia * i.input_speed * i.input_speed,
        &|i| i.terms.potential + i.terms.process,
        &|i| i.terms.potential + i.terms.viscous + i.terms.coulomb,
    ];
    let forces = forces.iter().map(|force| force as Quantity);
    for quantity in quantities.into_iter().chain(forces) {
        for sign in [-1.0, 1.0] {
            let value = |instant: &Instant| sign * quantity(instant);
            let most = instants.iter().map(value).max_by(f64::total_cmp);
            let count = instants.len();
            let found = parabola::highest(
                (count, |k| value(&instants[k])),
                |k| smooth.around(k, count),
                |k| instants[k].t,
                |t| Ok::<_, Error>(value(&moving.at(t)?.instant)),
                most.unwrap_or(f64::INFINITY),
            )?;
            if let Some((_, t)) = found {
                let peak = moving.at(t)?.instant;
                let place = instants.partition_point(|i| i.t < t);
                smooth.insert(place);
                instants.insert(place, peak);
            }
        }
    }
    Ok(())
}
