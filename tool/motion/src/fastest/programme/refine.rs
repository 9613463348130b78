//! Refines the pieces, from a first mesh or from another motion, until the time no longer changes.

use super::borders::inner;
use super::limits::Margins;
use super::mesh::Border;
use super::starts::SAME;
use super::{FINER, MeshMotion, MoveRequest, PIECES, RANGES, WIDER, WarmStart};
use crate::collocation::shape::Parametrization;
use crate::fastest::NoMotion;

/// Most rounds of refinement.
const ROUNDS: u32 = 24;

/// Relative change of the time at which the pieces are fine enough.
const SETTLED: f64 = 2e-9;

/// Factor from round to round of the range over which bends of the torque are rounded.
const NARROWER: f64 = 0.5;

/// How often the first pieces may be halved if no motion is found on them.
const FINER_STARTS: u32 = 2;

/// How often borders are moved to where the active limit changes.
const MOVES: u32 = 3;

/// How often pieces longer than `LONGEST`, a share of u, are halved after that.
const HALVED: u32 = 3;
const LONGEST: f64 = 0.006;

/// The borders with more of them; `None` if there are no more.
fn with(borders: &[Border], more: Vec<Border>) -> Option<Vec<Border>> {
    if more.is_empty() {
        return None;
    }
    let mut all: Vec<Border> = borders.iter().copied().chain(more).collect();
    all.sort_by(|a, b| a.u.total_cmp(&b.u));
    Some(all)
}

/// Every piece halved.
pub(super) fn halved(borders: &[Border]) -> Vec<Border> {
    let middles = borders.windows(2);
    let middles = middles.map(|piece| inner(piece[0].u.midpoint(piece[1].u)));
    with(borders, middles.collect()).unwrap_or_default()
}

/// The middles of long pieces.
fn longest_halved(borders: &[Border]) -> Vec<Border> {
    let longer = |piece: &&[Border]| piece[1].u - piece[0].u > LONGEST;
    let pieces = borders.windows(2).filter(longer);
    pieces
        .map(|piece| inner(piece[0].u.midpoint(piece[1].u)))
        .collect()
}

impl MoveRequest<'_> {
    /// The range over which bends of the torque are rounded in a search from a motion, and its share of that motion's largest load.
    fn range(&self, found: &MeshMotion, share: f64) -> [f64; 2] {
        let problem = self.problem(&found.mesh, &[], found.range);
        [problem.ranged(&found.point.x, share).range, share]
    }

    /// The motion on the pieces of another one; `None` if the motions differ too much.
    pub(super) fn beside(
        &self,
        shape: &Parametrization,
        warm: &WarmStart,
    ) -> Result<Option<WarmStart>, NoMotion> {
        let WarmStart {
            borders,
            found,
            margins,
            ..
        } = warm;
        let range = [found.range, found.share];
        let next = self.next(shape, borders, found, margins, FINER, range)?;
        Ok(next.ok().map(|found| WarmStart {
            found,
            ..warm.clone()
        }))
    }

    /// The motion on other borders, with bends of the torque rounded over a share of the loads, or over a larger share if no motion is found.
    fn narrowed(
        &self,
        shape: &Parametrization,
        borders: &[Border],
        found: &MeshMotion,
        share: f64,
    ) -> Result<Option<MeshMotion>, NoMotion> {
        let wider = WIDER.map(|factor| factor * found.share);
        for share in [share].into_iter().chain(wider) {
            let range = self.range(found, share);
            let next = self.next(shape, borders, found, &[], FINER, range)?;
            if next.is_ok() || found.range == 0.0 {
                return Ok(next.ok());
            }
        }
        Ok(None)
    }

    /// The first motion. If coarse pieces give no motion, finer ones are tried.
    fn first_of_all(
        &self,
        shape: &Parametrization,
        eased: bool,
    ) -> Result<(Vec<Border>, MeshMotion), NoMotion> {
        let mut borders = self.first_borders(shape);
        let mut first = self.first(shape, borders.clone(), eased);
        for _ in 0..FINER_STARTS {
            if !matches!(first, Err(NoMotion::NotFound { .. })) {
                break;
            }
            borders = halved(&borders);
            first = self.first(shape, borders.clone(), eased).or(first);
        }
        first
    }

    /// The motion on pieces that are refined until the time no longer changes.
    pub(super) fn refined(
        &self,
        shape: &Parametrization,
        warm: Option<&WarmStart>,
        eased: bool,
    ) -> Result<WarmStart, NoMotion> {
        let started = match warm {
            Some(warm) => {
                let plain = |border: &Border| Border {
                    is_plain: false,
                    ..*border
                };
                let borders: Vec<Border> = warm.borders.iter().map(plain).collect();
                let found = self.narrowed(shape, &borders, &warm.found, warm.found.share)?;
                found.map(|found| (borders, found))
            }
            None => None,
        };
        let (mut borders, mut found) = if let Some(started) = started {
            started
        } else {
            self.first_of_all(shape, eased)?
        };
        let mut change = warm.map_or(f64::INFINITY, |warm| warm.change);
        let mut rounds = [ROUNDS, MOVES, HALVED];
        while let Some(round) = rounds.iter().position(|left| *left > 0) {
            rounds[round] -= 1;
            let share = if round == 0 && found.range > 0.0 {
                (NARROWER * found.share).max(RANGES[1])
            } else {
                found.share
            };
            let next = match round {
                0 => with(&borders, self.finer(&found))
                    .or_else(|| (share < found.share).then(|| borders.clone())),
                1 => self.moved(&borders, &found, &self.trace(shape, &found)),
                _ => with(&borders, longest_halved(&borders)),
            };
            let next = next.filter(|next| next.len() <= PIECES[1]);
            let solved = match next {
                Some(next) => match self.narrowed(shape, &next, &found, share)? {
                    Some(solved) => Some((next, solved)),
                    // A motion on coarse pieces may violate limits between the stations, and finer pieces may then have no similar motion.
                    None if round == 0 => {
                        let first = self.first(shape, next, eased).ok();
                        first.filter(|(_, first)| first.time < SAME * found.time)
                    }
                    None => None,
                },
                None => None,
            };
            let Some((next, solved)) = solved else {
                rounds[round] = 0;
                continue;
            };
            change = (solved.time - found.time).abs() / solved.time;
            let is_narrower = solved.share < found.share;
            (borders, found) = (next, solved);
            if round == 0 && change < SETTLED && !is_narrower {
                rounds[round] = 0;
            }
        }
        for (border, changes) in borders.iter_mut().zip(self.changes(&found)) {
            border.is_plain = changes[1];
        }
        Ok(WarmStart {
            margins: vec![Margins::default(); borders.len() - 1],
            borders,
            found,
            change,
        })
    }
}
