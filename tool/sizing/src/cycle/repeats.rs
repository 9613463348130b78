//! A cycle without its repeats: the many turns at constant speed have one peak each, and a search over all of them could not exclude any.

use std::collections::HashMap;
use std::ops::Range;

use super::LoadSample;
use super::front::Front;
use super::tree::Tree;
use crate::cycle::form::LOADS;
use jred_analysis::duty::Smooth;

/// Two values are equal if they differ by less than this share of the largest: rounding of a position after many turns.
const VALUE_TOLERANCE: f64 = 1e-10;

/// Panels are compared if their values are equal after rounding to this share, so coarse that rounding seldom separates equal panels.
const KEY_ROUNDING: f64 = 1e-5;

/// Multiplier of the hash of a panel's values (D. Knuth's 2⁶⁴/golden ratio).
const MIX: u64 = 0x9e37_79b9_7f4a_7c15;

/// The most panels that one panel is compared with.
const COMPARED: usize = 8;

/// Largest share of the remaining samples for which a separate tree is worthwhile.
const WORTHWHILE_SHARE: f64 = 0.5;

/// The rest of a cycle whose panels repeat. Any result that depends on a single sample, not on a sum, is found in it.
#[derive(Clone, Debug)]
pub(super) struct Distinct {
    pub(super) tree: Tree,
    pub(super) front: Front,
}

impl Distinct {
    /// The cycle without repeats; `None` if little is repeated.
    pub(super) fn of(
        samples: &[LoadSample],
        smooth: &Smooth,
        largest: &[f64; LOADS],
    ) -> Option<Self> {
        let left = left(samples, smooth);
        let count: usize = left.iter().map(Range::len).sum();
        if count as f64 > WORTHWHILE_SHARE * samples.len() as f64 {
            return None;
        }
        let tree = Tree::of_parts(samples, &left, largest);
        Some(Self {
            front: Front::new(&tree, samples, largest),
            tree,
        })
    }
}

/// The samples without the panels that repeat an earlier one.
fn left(samples: &[LoadSample], smooth: &Smooth) -> Vec<Range<usize>> {
    let values = |s: &LoadSample| [s.alpha, s.output_torque, s.speed];
    let mut largest = [0.0_f64; 3];
    for sample in samples {
        for (most, value) in largest.iter_mut().zip(values(sample)) {
            *most = most.max(value.abs());
        }
    }
    // At constant speed the acceleration is only rounding.
    largest[0] = largest[0].max(largest[2] * largest[2]);
    let shares = |sample: &LoadSample| {
        let values = values(sample);
        std::array::from_fn::<f64, 3, _>(|k| values[k] / largest[k].max(f64::MIN_POSITIVE))
    };
    let are_one = |a: &LoadSample, b: &LoadSample| {
        let pairs = shares(a).into_iter().zip(shares(b));
        pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs())) < VALUE_TOLERANCE
    };
    let mut seen: HashMap<u64, Vec<Range<usize>>> = HashMap::new();
    let mut left: Vec<Range<usize>> = Vec::new();
    let mut keep = |part: Range<usize>| match left.last_mut() {
        Some(last) if last.end == part.start => last.end = part.end,
        _ if part.is_empty() => {}
        _ => left.push(part),
    };
    let mut end = 0;
    for panel in smooth.panels(samples.len()) {
        keep(end..panel.start.max(end));
        end = panel.end;
        let own = &samples[panel.clone()];
        let coarse = own
            .iter()
            .flat_map(shares)
            .map(|share| (share / KEY_ROUNDING).round() as i64);
        let mark = coarse.fold(0, |mark: u64, x| {
            (mark.rotate_left(5) ^ x as u64).wrapping_mul(MIX)
        });
        let like = seen.entry(mark).or_default();
        let is_known = like.iter().any(|other| {
            let other = &samples[other.clone()];
            own.iter().zip(other).all(|(a, b)| are_one(a, b))
        });
        if !is_known {
            if like.len() < COMPARED {
                like.push(panel.clone());
            }
            keep(panel);
        }
    }
    keep(end..samples.len());
    left
}
