//! Finer pieces: from a first mesh, or from another motion, until the time is settled.

use super::limits::Margins;
use super::mesh::Border;
use super::{Asked, FINER, Found, PIECES, RANGES, Warm, inner};
use crate::fastest::NoMotion;
use crate::gentlest::shape::Shape;

/// Rounds of finer pieces.
const ROUNDS: u32 = 24;

/// Change of the time, as a share, at which finer pieces gain nothing.
const SETTLED: f64 = 2e-9;

/// How often borders are moved to where the limit changes.
const MOVES: u32 = 3;

/// How often pieces longer than this are halved after that.
const HALVED: u32 = 3;
const LONGEST: f64 = 0.006;

/// More borders; `None`: there are none.
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

impl Asked<'_> {
    /// Load over which bends of the torque are rounded beside a motion.
    fn range(&self, found: &Found) -> f64 {
        let problem = self.problem(&found.mesh, &[], found.range);
        problem.ranged(&found.point.x, RANGES[0]).range
    }

    /// On the pieces of another motion; `None`: it is too far away.
    pub(super) fn beside(&self, shape: &Shape, warm: &Warm) -> Result<Option<Warm>, NoMotion> {
        let next = self.next(
            shape,
            &warm.borders,
            &warm.found,
            &warm.margins,
            FINER,
            warm.found.range,
        )?;
        Ok(next.ok().map(|found| Warm {
            found,
            ..warm.clone()
        }))
    }

    /// On pieces that are made finer until the time is settled.
    pub(super) fn refined(&self, shape: &Shape, warm: Option<&Warm>) -> Result<Warm, NoMotion> {
        let started = match warm {
            Some(warm) => {
                let plain = |border: &Border| Border {
                    is_plain: false,
                    ..*border
                };
                let borders: Vec<Border> = warm.borders.iter().map(plain).collect();
                let found = self.next(
                    shape,
                    &borders,
                    &warm.found,
                    &[],
                    FINER,
                    self.range(&warm.found),
                )?;
                found.ok().map(|found| (borders, found))
            }
            None => None,
        };
        let (mut borders, mut found) = if let Some(started) = started {
            started
        } else {
            self.first(shape, self.first_borders(shape))?
        };
        let mut change = warm.map_or(f64::INFINITY, |warm| warm.change);
        let mut rounds = [ROUNDS, MOVES, HALVED];
        while let Some(round) = rounds.iter().position(|left| *left > 0) {
            rounds[round] -= 1;
            let next = match round {
                0 => with(&borders, self.finer(&found)),
                1 => self.moved(&borders, &found, &self.trace(shape, &found)),
                _ => with(&borders, longest_halved(&borders)),
            };
            let next = next.filter(|next| next.len() <= PIECES[1]);
            let solved = match next {
                Some(next) => {
                    let range = self.range(&found);
                    match self.next(shape, &next, &found, &[], FINER, range)? {
                        Ok(solved) => Some((next, solved)),
                        // Between the places at which coarse pieces are looked at their motion may be none.
                        Err(_) if round == 0 => self.first(shape, next).ok(),
                        Err(_) => None,
                    }
                }
                None => None,
            };
            let Some((next, solved)) = solved else {
                rounds[round] = 0;
                continue;
            };
            change = (solved.time - found.time).abs() / solved.time;
            (borders, found) = (next, solved);
            if round == 0 && change < SETTLED {
                rounds[round] = 0;
            }
        }
        // What rounding leaves of the time falls with the square of its range.
        if found.range > 0.0 {
            let range = self.range(&found) * RANGES[1] / RANGES[0];
            if let Ok(fine) = self.next(shape, &borders, &found, &[], FINER, range)? {
                found = fine;
            }
        }
        for (border, changes) in borders.iter_mut().zip(self.changes(&found)) {
            border.is_plain = changes[1];
        }
        Ok(Warm {
            margins: vec![Margins::default(); borders.len() - 1],
            borders,
            found,
            change,
        })
    }
}
