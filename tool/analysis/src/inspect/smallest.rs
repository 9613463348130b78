//! The smallest transmission index of a mechanism.

use jred::Domain;
use jred::error::Error;
use jred::machine::{Frames, Jointed as _, Joints, Mechanism as _};
use jred_file::math;
use serde::Serialize;

use super::joints::size;
use super::transmission::{Index, Structure};
use jred_file::model::coordinate::whole_range;
use jred_file::model::machine::MachineFile;
use jred_file::number::numerics;

/// An index that changes by less is constant.
const CONSTANT: f64 = 1e-9;

/// The smallest transmission index.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Transmission {
    /// The index, 0 (dead point) to 1.
    pub index: f64,
    /// The transmission angle of a dyad with this index (deg); `None` for a contact or a mesh.
    #[serde(rename = "angle [deg]")]
    pub angle: Option<f64>,
    /// Position of the drive link (rad or m); `None` if the index is the same everywhere.
    pub at: Option<f64>,
    /// The links of the group.
    pub links: Vec<String>,
    /// Whether the determinant of every group keeps its sign, and so its branch.
    pub branch_kept: bool,
}

/// The smallest index over the motion, or over the whole range without one.
pub(super) fn transmission(file: &MachineFile) -> Result<Option<Transmission>, Error> {
    const STEPS: usize = 1440;
    const SAMPLES: usize = 24;
    let mechanism = file.machine.mechanism();
    if !mechanism.change_points().is_empty() {
        // It passes its dead points, guided.
        return Ok(None);
    }
    let drive = mechanism.drive();
    let start = mechanism.domain().position(0.0);
    let joints = mechanism.joints(start, &mechanism.frames(start)?)?;
    let placed = |phi: f64| -> Result<(Joints, Frames, f64), Error> {
        let frames = mechanism.frames(phi)?;
        let joints = mechanism.joints(phi, &frames)?;
        let length = size(&joints, &frames);
        Ok((joints, frames, length))
    };
    let samples = whole_range(mechanism.domain(), SAMPLES)
        .map(placed)
        .collect::<Result<Vec<_>, Error>>()?;
    let structure = Structure::new(&joints, drive, mechanism.links().len(), &samples);
    let at = |phi: f64| -> Result<Vec<Index>, Error> {
        let (joints, frames, length) = placed(phi)?;
        Ok(structure.indices(&joints, &frames, length))
    };
    let places: Vec<f64> = match &file.motion {
        Some(motion) => (0..=STEPS)
            .map(|k| motion.at(motion.duration() * k as f64 / STEPS as f64).phi)
            .collect(),
        None => whole_range(mechanism.domain(), STEPS).collect(),
    };
    let values = places
        .iter()
        .map(|&phi| at(phi))
        .collect::<Result<Vec<_>, Error>>()?;
    let mut worst: Option<(f64, usize, usize)> = None;
    let mut branch_kept = true;
    for (k, row) in values.iter().enumerate() {
        for (block, index) in row.iter().enumerate() {
            if worst.is_none_or(|(least, ..)| index.value.abs() < least) {
                worst = Some((index.value.abs(), k, block));
            }
            let first = values.first().and_then(|first| first.get(block));
            let same = first.is_some_and(|first| first.value * index.value > 0.0);
            branch_kept &= !index.bilateral || same;
        }
    }
    let Some((_, k, block)) = worst else {
        return Ok(None);
    };
    let [low, high] = [places[k.saturating_sub(1)], places[(k + 1).min(STEPS)]];
    let index = |phi: f64| -> Result<f64, Error> {
        Ok(at(phi)?.get(block).map_or(1.0, |index| index.value.abs()))
    };
    let middle = numerics::least(index, low, high)?;
    let (phi, least) = if index(middle)? < index(places[k])? {
        (middle, index(middle)?)
    } else {
        (places[k], index(places[k])?)
    };
    let names = mechanism.link_names();
    let here = values[k].get(block).copied();
    let group = here.map_or(0, |index| index.group);
    let most = values
        .iter()
        .filter_map(|row| Some(row.get(block)?.value.abs()))
        .fold(0.0, f64::max);
    let shown = if mechanism.domain() == Domain::Turn {
        phi.rem_euclid(std::f64::consts::TAU)
    } else {
        phi
    };
    let links = structure.links(group);
    Ok(Some(Transmission {
        index: least,
        angle: here
            .is_some_and(|index| index.bilateral)
            .then(|| math::asin(least.min(1.0)).to_degrees()),
        at: (most - least > CONSTANT).then_some(shown),
        links: links
            .iter()
            .filter_map(|&k| names.get(k).cloned())
            .collect(),
        branch_kept,
    }))
}
