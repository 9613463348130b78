//! Starts of the search: constant paces, and motions under eased rate limits.
//!
//! There may be two families of motions. In a fast motion the inertia bears most of the load; in a slow one the torque follows the load. A search
//! finds the best motion of the family in which it starts.

use super::interior::{PrimalDual, StuckStation, minimise};
use super::limits::{Margins, MeshProblem};
use super::mesh::{Border, Mesh};
use super::refine::halved;
use super::{FEASIBLE, MeshMotion, MoveRequest, PIECES, RANGES, ROUGH, STARTS};
use crate::collocation::shape::Parametrization;
use crate::fastest::NoMotion;
use jred_file::math;

/// Largest factor by which the rate limits are eased at the start, and the multipliers from one search to the next: the first one, and the one too
/// close to 1 to go on.
const MOST_EASE: f64 = 1e4;
const EASES: [f64; 2] = [0.1, 0.97];

/// Exponent by which a step between factors grows after a success, and the most steps.
const LONGER: f64 = 1.2;
const MOST_EASES: u32 = 40;

/// Largest ratio of two successive times within one family, and the μ of these searches.
pub(super) const SAME: f64 = 1.2;
const EASED: [f64; 2] = [1e-2, 1e-5];

/// Number of borders from which eased limits are no longer tried on finer pieces.
const MOST_EASED: usize = 3 * PIECES[0];

/// Share by which a motion from eased limits must be faster to be preferred.
const CLEAR_GAIN: f64 = 1e-3;

/// Most repetitions of the search because the range belonged to loads more than twice those of the motion found.
const RANGED: u32 = 8;

impl MoveRequest<'_> {
    /// Searches from a point, with bends rounded over a range that suits the loads of the resulting motion.
    fn from(
        &self,
        mesh: &Mesh,
        start: &[f64],
        ease: f64,
        barrier: [f64; 2],
    ) -> Result<(PrimalDual, f64), StuckStation> {
        let margins = vec![Margins::default(); mesh.elements.len()];
        let ranged = |x: &[f64]| MeshProblem {
            ease,
            ..self.problem(mesh, &margins, 0.0).ranged(x, RANGES[0])
        };
        let mut problem = ranged(start);
        let mut point = minimise(&problem, start, barrier)?;
        for _ in 0..RANGED {
            let next = ranged(&point.x);
            if next.range >= 0.5 * problem.range {
                break;
            }
            problem = next;
            point = minimise(&problem, &point.x, barrier)?;
        }
        Ok((point, problem.range))
    }

    /// Starts with rate limits so eased that they hardly bind, then tightens them step by step to the given limits. So it stays in the family of fast
    /// motions, which slow starts may not find. `None` if the next motion was much slower, so that the family has ended.
    fn eased(&self, mesh: &Mesh) -> Option<(PrimalDual, f64)> {
        let fast = self.unit / self.bound;
        let mut ease = fast.powi(3).min(MOST_EASE);
        if ease <= 1.0 {
            return None;
        }
        let even = |pace: f64| mesh.even((pace * fast).powi(2));
        let mut starts = STARTS.into_iter();
        let mut found = starts.find_map(|pace| self.from(mesh, &even(pace), ease, ROUGH).ok())?;
        let mut time = self.time(mesh, &found.0.x);
        let mut factor = EASES[0];
        for _ in 0..MOST_EASES {
            if ease <= 1.0 {
                return Some(found);
            }
            let next = (ease * factor).max(1.0);
            let solved = self.from(mesh, &found.0.x, next, EASED).ok();
            let solved = solved.map(|solved| (self.time(mesh, &solved.0.x), solved));
            match solved {
                Some((own, solved)) if own < SAME * time => {
                    (found, ease, time) = (solved, next, own);
                    factor = math::pow(factor, LONGER).max(EASES[0]);
                }
                _ if factor < EASES[1] => factor = factor.sqrt(),
                _ => return None,
            }
        }
        None
    }

    /// The best of the motions from several starts, with the borders of its pieces.
    pub(super) fn first(
        &self,
        shape: &Parametrization,
        borders: Vec<Border>,
        from_eased: bool,
    ) -> Result<(Vec<Border>, MeshMotion), NoMotion> {
        let mesh = self.mesh(shape, &borders)?;
        let mut stuck = None;
        // Fast and slow constant paces, for both families.
        let fast = self.unit / self.bound;
        let paces = STARTS.into_iter().flat_map(|pace| [pace * fast, pace]);
        let even = paces.filter_map(|pace| {
            let found = self.from(&mesh, &mesh.even(pace * pace), 1.0, ROUGH);
            found.map_err(|why| stuck = stuck.or(Some(why))).ok()
        });
        let margins = vec![Margins::default(); mesh.elements.len()];
        let cost = |(point, range): &(PrimalDual, f64)| {
            self.problem(&mesh, &margins, *range).whole_cost(&point.x)
        };
        let best = even.min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let best = best.map(|(point, range)| {
            let found = self.found(mesh.clone(), point, range, RANGES[0]);
            (borders.clone(), found)
        });
        // On coarse pieces the faster family may not exist.
        let mut eased = None;
        let mut finer = borders;
        let rates = self.limits().has_rates();
        while from_eased && rates && eased.is_none() && finer.len() < MOST_EASED {
            finer = halved(&finer);
            let mesh = self.mesh(shape, &finer)?;
            let found = self.eased(&mesh);
            eased = found.map(|(point, range)| {
                let found = self.found(mesh, point, range, RANGES[0]);
                (finer.clone(), found)
            });
        }
        let faster = |(_, eased): &(_, MeshMotion)| {
            best.as_ref()
                .is_none_or(|(_, best)| eased.time < (1.0 - CLEAR_GAIN) * best.time)
        };
        if let Some(best) = eased.filter(faster).or(best) {
            return Ok(best);
        }
        let stuck = stuck.filter(|stuck: &StuckStation| stuck.missed > FEASIBLE);
        let phi = stuck.map_or(self.ends.from, |stuck| {
            mesh.stations[stuck.station].place.phi
        });
        let missed = stuck.map_or(0.0, |stuck| stuck.missed);
        Err(self.not_found(stuck.and_then(|stuck| stuck.limit), phi, missed))
    }
}
