//! A rotation without end in so long a time that it is best to stand still somewhere: a turn from rest to rest, and a pause.
//!
//! A motion that all but stands somewhere costs what one costs that stands there, so that nothing is lost. Where it stands is sought: at places all
//! along the way, and at those where holding takes the least; then about the best of them.

use jred_machine::number::numerics::edge;

use crate::gentlest::{self, Fault, Gentle, Objective, Travel};
use crate::way::Way;

/// Places at which it may stand, all along the way.
const PLACES: u32 = 6;

/// Places at which the torque that holds the machine is looked at, and how many of the least are taken.
const LOOKS: usize = 360;
const LEAST: usize = 3;

/// Halvings of the distance between the best place and those beside it.
const HALVINGS: u32 = 6;

/// The gentlest turn with one pause, wherever that is; `None`: there is none.
///
/// # Errors
/// The machine cannot be placed somewhere.
pub(super) fn turn(
    way: &Way,
    travel: &Travel,
    objective: Objective,
) -> Result<Option<Gentle>, Fault> {
    let place = |share: f64| travel.start + share * travel.distance;
    let at = |share: f64| -> Result<Option<(f64, Gentle)>, Fault> {
        let travel = Travel {
            start: place(share),
            speeds: [0.0; 2],
            ring: false,
            ..*travel
        };
        match gentlest::gentlest(way, &travel, objective) {
            Ok(gentle) => Ok(Some((share, gentle))),
            Err(Fault::NotFound) => Ok(None),
            Err(fault) => Err(fault),
        }
    };
    let mut best: Option<(f64, Gentle)> = None;
    let see = |share: f64, best: &mut Option<(f64, Gentle)>| -> Result<bool, Fault> {
        let Some(own) = at(share)? else {
            return Ok(false);
        };
        let better = best
            .as_ref()
            .is_none_or(|(_, best)| own.1.measure < best.measure);
        if better {
            *best = Some(own);
        }
        Ok(better)
    };
    for k in 0..PLACES {
        see(f64::from(k) / f64::from(PLACES), &mut best)?;
    }
    for share in least_held(way, place)? {
        see(share, &mut best)?;
    }
    let mut width = 0.5 / f64::from(PLACES);
    for _ in 0..HALVINGS {
        let Some((middle, _)) = best else { break };
        for share in [middle - width, middle + width] {
            if see(share, &mut best)? {
                break;
            }
        }
        width *= 0.5;
    }
    Ok(best.map(|(_, gentle)| gentle))
}

/// Shares of the way at which holding takes less than beside them, those with the least first: where it changes its sign, it takes nothing.
fn least_held(way: &Way, place: impl Fn(f64) -> f64) -> Result<Vec<f64>, Fault> {
    let held = |share: f64| Ok::<_, Fault>(way.holding(&way.place_at_rest(place(share))?));
    let share = |k: usize| k as f64 / LOOKS as f64;
    let all = (0..LOOKS).map(|k| held(share(k)));
    let all: Vec<f64> = all.collect::<Result<_, Fault>>()?;
    let mut least: Vec<(f64, f64)> = Vec::new();
    for k in 0..LOOKS {
        let [before, own, after] = [k + LOOKS - 1, k, k + 1].map(|k| all[k % LOOKS]);
        if own * after < 0.0 {
            let side = |at: f64| Ok::<_, Fault>(held(at)? * own > 0.0);
            let zero = edge(side, share(k), share(k + 1))?;
            least.push((zero, 0.0));
        } else if own.abs() < before.abs() && own.abs() <= after.abs() && before * own >= 0.0 {
            least.push((share(k), own.abs()));
        }
    }
    least.sort_by(|a, b| a.1.total_cmp(&b.1));
    let places = least.into_iter().take(LEAST);
    Ok(places.map(|(share, _)| share).collect())
}
