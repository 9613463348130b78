//! Removes steps of a motion that are only rounding.
//!
//! Where two limits meet, or at a corner of the machine, a sweep leaves a curve and returns to it within the last digits of the place. A step so
//! short has no significant digits for its acceleration: a reader of the motion as positions or speeds could find any value.

use super::sweep::SweepPiece;
use super::track::Track;

/// Share of the total time below which a step is removed: some hundred rounding errors of a time near the end. Its change of speed goes into the
/// neighbouring step, whose acceleration changes in the ratio of the two durations.
const TINY_STEP: f64 = 1e-13;

/// The pieces of a motion with their times, where each step that is too short is merged into the longer of its neighbours.
pub(super) fn without(
    track: &Track,
    pieces: Vec<SweepPiece>,
    times: &[f64],
) -> (Vec<SweepPiece>, Vec<f64>) {
    let short = TINY_STEP * times.iter().sum::<f64>();
    if times.iter().all(|time| *time > short) {
        return (pieces, times.to_vec());
    }
    let mut kept: Vec<(SweepPiece, f64)> = Vec::with_capacity(pieces.len());
    let mut all: Vec<(SweepPiece, f64)> = pieces.into_iter().zip(times.iter().copied()).collect();
    for k in 0..all.len() {
        let sliver = all[k];
        let (_, time) = sliver;
        let after = all.get(k + 1).map(|(_, time)| *time);
        let before = kept.last_mut();
        match (before, after) {
            _ if time > short => kept.push(sliver),
            (Some(before), after) if after.is_none_or(|after| after <= before.1) => {
                extend(track, before, sliver, 1);
            }
            (_, Some(_)) => extend(track, &mut all[k + 1], sliver, 0),
            (_, None) => kept.push(sliver),
        }
    }
    kept.into_iter().unzip()
}

/// Merges a sliver into the piece beside it, which then begins (0) or ends (1) where the sliver does.
fn extend(
    track: &Track,
    (piece, time): &mut (SweepPiece, f64),
    (sliver, its_time): (SweepPiece, f64),
    end: usize,
) {
    let u = sliver.step.u[end];
    piece.step.u[end] = if sliver.cell == piece.cell {
        u
    } else {
        let [own, other] = [piece.cell, sliver.cell].map(|cell| &track.cells[cell]);
        (other.x + u * other.length - own.x) / own.length
    };
    piece.step.z[end] = sliver.step.z[end];
    *time += its_time;
    piece.step.time = Some(*time);
}
